/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the top of the repository stays a table of contents, and the tree holds neither promises of later work nor
 *       addresses nor files that a build made.
 * Method: git's own list of files, where there is a repository; the texts of the tree for the words. Each is
 *         planted. */
#include "source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace {

const std::set<std::string> top_names = {"CMakeLists.txt", "src",     "platform",  "config",
                                         "tests",          "systemd", "README.md", "LICENSE"};

source_tree_complaints out_of_place(const std::vector<std::string> &paths)
{
    source_tree_complaints complaints;
    for (const std::string &path : paths) {
        const std::string top = path.substr(0, path.find('/'));
        if (top_names.count(top) == 0 && !top.starts_with(".")) {
            complaints.push_back(path + ": not a place of the design");
        }
    }
    return complaints;
}

/* Cut in two so that this file does not complain about itself. */
const std::vector<std::string> promises = {"TO" "DO", "FIX" "ME", "XX" "X", "HA" "CK"};
const std::vector<std::string> addresses = {"http" "://", "https" "://", "ftp" "://"};

bool is_word_at(const std::string &line, size_t at, size_t size)
{
    const auto is_letter = [](char c) { return isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    const bool is_joined_before = at > 0 && is_letter(line[at - 1]);
    const bool is_joined_after = at + size < line.size() && is_letter(line[at + size]);
    return !is_joined_before && !is_joined_after;
}

bool is_binary(const source_tree_file &file) { return file.text.find('\0') != std::string::npos; }

/* In text alone: a picture's bytes spell what they like. */
source_tree_complaints unwanted_words(const source_tree_file &file)
{
    source_tree_complaints complaints;
    if (is_binary(file)) {
        return complaints;
    }
    const std::vector<std::string> lines = source_tree_lines(file.text);
    for (size_t i = 0; i < lines.size(); ++i) {
        const std::string at = file.path + ":" + std::to_string(i + 1) + ": ";
        for (const std::string &word : promises) {
            const size_t found = lines[i].find(word);
            if (found != std::string::npos && is_word_at(lines[i], found, word.size())) {
                complaints.push_back(at + word);
            }
        }
        for (const std::string &address : addresses) {
            if (lines[i].find(address) != std::string::npos) {
                complaints.push_back(at + "an address: " + address);
            }
        }
    }
    return complaints;
}

source_tree_complaints wrong_kind(const source_tree_file &file)
{
    static const std::set<std::string> strange = {".cc", ".cxx", ".hh", ".hpp", ".hxx", ".o", ".a", ".so", ".pyc"};
    if (strange.count(source_tree_extension(file.path)) != 0) {
        return {file.path + ": sources are .c, .cpp and .h"};
    }
    if (is_binary(file) && file.text.size() > 200'000) {
        return {file.path + ": a binary of more than 200 kB"};
    }
    if (source_tree_is_code(file.path) && !file.text.empty() && file.text.back() != '\n') {
        return {file.path + ": the last line has no end"};
    }
    return {};
}

TEST(layout, the_top_is_a_table_of_contents)
{
    const auto listed = source_tree_listed();
    if (!listed) {
        GTEST_SKIP() << "no git repository here";
    }
    EXPECT_GT(listed->size(), 40u) << "git listed nothing";
    const source_tree_complaints complaints = out_of_place(*listed);
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

TEST(layout, nothing_is_promised_and_nothing_is_fetched)
{
    source_tree_complaints complaints;
    for (const source_tree_file &file : source_tree_read({"src", "platform", "config", "systemd", "tests"})) {
        const source_tree_complaints more = unwanted_words(file);
        complaints.insert(complaints.end(), more.begin(), more.end());
    }
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

TEST(layout, files_are_of_the_kinds_we_write)
{
    source_tree_complaints complaints;
    for (const source_tree_file &file : source_tree_read({"src", "platform", "config", "systemd", "tests"})) {
        const source_tree_complaints more = wrong_kind(file);
        complaints.insert(complaints.end(), more.begin(), more.end());
    }
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

TEST(layout, planted_strangers_are_seen)
{
    EXPECT_EQ(out_of_place({"src/a.c", "README.md", ".gitignore", ".ci/run"}).size(), 0u);
    EXPECT_EQ(out_of_place({"NOTES.md"}).size(), 1u);
    EXPECT_EQ(out_of_place({"docs/a.md", "build/a.o"}).size(), 2u);
}

TEST(layout, planted_words_are_seen)
{
    EXPECT_EQ(unwanted_words({"a.c", "int a;\n/* " + promises[0] + ": more */\n"}).size(), 1u);
    EXPECT_EQ(unwanted_words({"a.c", "// " + promises[1] + "\n"}).size(), 1u);
    EXPECT_EQ(unwanted_words({"a.c", "curl " + addresses[1] + "x.org\n"}).size(), 1u);
    EXPECT_EQ(unwanted_words({"a.png", std::string(1, '\0') + "// " + promises[1] + "\n"}).size(), 0u);
    EXPECT_EQ(unwanted_words({"a.c", "int MAS" + promises[0] + "N;\n"}).size(), 0u);
}

TEST(layout, planted_kinds_are_seen)
{
    EXPECT_EQ(wrong_kind({"src/a.hpp", "int a;\n"}).size(), 1u);
    EXPECT_EQ(wrong_kind({"src/a.c", "int a;"}).size(), 1u);
    EXPECT_EQ(wrong_kind({"tests/a.bin", std::string(200'001, '\0')}).size(), 1u);
    EXPECT_EQ(wrong_kind({"tests/a.bin", std::string(2'000, '\0')}).size(), 0u);
    EXPECT_EQ(wrong_kind({"src/a.c", "int a;\n"}).size(), 0u);
}

} // namespace
