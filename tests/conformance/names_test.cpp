/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a name says where it lives: what a header declares begins with the header's stem, stems are unique, no room
 *       or file is called after nothing in particular, include guards follow from the path.
 * Method: source_scan.h lists what every header declares; each law is first broken on purpose in a planted text. */
#include "source_scan.h"
#include "source_token.h"
#include "source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace {

const std::set<std::string> empty_words = {"utils", "util",    "common",   "misc", "helper", "helpers",
                                           "core",  "manager", "managers", "shared"};

std::string upper(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c); });
    return text;
}

std::string spelled(std::string text)
{
    std::replace_if(text.begin(), text.end(), [](char c) { return c == '-' || c == '.'; }, '_');
    return text;
}

std::string guard_of(const std::string &path)
{
    return "GLAISE_" + upper(spelled(source_tree_room(path))) + "_" + upper(spelled(source_tree_stem(path))) + "_H";
}

/* Words of a path that name nothing: "src/mesh_utils.c" -> "utils". */
source_tree_complaints empty_names(const std::string &path)
{
    source_tree_complaints complaints;
    std::string word;
    for (const char c : path + "/") {
        if (c != '/' && c != '_' && c != '-' && c != '.') {
            word += c;
            continue;
        }
        if (empty_words.count(word) != 0) {
            complaints.push_back(path + ":1: \"" + word + "\" names nothing");
        }
        word.clear();
    }
    return complaints;
}

/* One stem, one folder. */
source_tree_complaints doubled_stems(const std::vector<std::string> &paths)
{
    std::map<std::string, std::string> homes;
    source_tree_complaints complaints;
    for (const std::string &path : paths) {
        const auto [home, is_new] = homes.emplace(source_tree_stem(path), source_tree_folder(path));
        if (!is_new && home->second != source_tree_folder(path)) {
            complaints.push_back(path + ":1: the stem is taken by " + home->second);
        }
    }
    return complaints;
}

bool begins_with_stem(const std::string &name, const std::string &stem)
{
    return name == stem || name.starts_with(stem + "_");
}

bool is_snake(const std::string &name)
{
    return std::none_of(name.begin(), name.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
}

std::string name_trouble(const source_scan_name &name, const std::string &stem, const std::string &guard,
                         const std::set<std::string> &stems)
{
    switch (name.kind) {
    case source_scan_kind::function:
    case source_scan_kind::type:
        if (!is_snake(name.name)) {
            return "is not snake_case";
        }
        return begins_with_stem(name.name, stem) ? "" : "does not begin with " + stem;
    case source_scan_kind::variable:
        return begins_with_stem(name.name, stem) || begins_with_stem(name.name, upper(stem))
                   ? ""
                   : "does not begin with " + stem;
    case source_scan_kind::enumerator:
        return begins_with_stem(name.name, upper(stem)) ? "" : "does not begin with " + upper(stem);
    case source_scan_kind::macro:
        /* What a library's own header asks to be told. */
        if (name.name.starts_with("GLM_") || name.name.starts_with("XXH_")) {
            return "";
        }
        return name.name == guard || begins_with_stem(name.name, upper(stem)) ? ""
                                                                             : "does not begin with " + upper(stem);
    case source_scan_kind::forward:
        /* Another header's type: that header must exist. */
        return std::any_of(stems.begin(), stems.end(),
                           [&](const std::string &other) { return begins_with_stem(name.name, other); })
                   ? ""
                   : "is no type of any header here";
    case source_scan_kind::name_space:
        return "rooms are told apart by folders, names by stems";
    }
    return "";
}

source_tree_complaints foreign_names(const source_tree_file &header, const std::set<std::string> &stems)
{
    const std::string stem = spelled(source_tree_stem(header.path));
    source_tree_complaints complaints;
    for (const source_scan_name &name : source_scan_text(header.text).names) {
        const std::string trouble = name_trouble(name, stem, guard_of(header.path), stems);
        if (!trouble.empty()) {
            complaints.push_back(header.path + ":" + std::to_string(name.line) + ": " +
                                 source_scan_kind_text(name.kind) + " " + name.name + " " + trouble);
        }
    }
    return complaints;
}

source_tree_complaints wrong_guard(const source_tree_file &header)
{
    std::vector<source_token> directives;
    for (const source_token &token : source_token_cut_code(header.text)) {
        directives.push_back(token);
    }
    const std::string guard = guard_of(header.path);
    const std::string complaint = header.path + ":1: the include guard is not " + guard;
    std::string opening;
    std::string defined;
    if (directives.size() < 3 || source_token_directive(directives[0], &opening) != "ifndef" || opening != guard ||
        source_token_directive(directives[1], &defined) != "define" || defined != guard ||
        source_token_directive(directives.back(), nullptr) != "endif") {
        return {complaint};
    }
    return {};
}

const std::vector<source_tree_file> &tree()
{
    static const std::vector<source_tree_file> files = source_tree_read({"src", "platform"});
    return files;
}

std::vector<source_tree_file> headers()
{
    std::vector<source_tree_file> all;
    std::copy_if(tree().begin(), tree().end(), std::back_inserter(all),
                 [](const source_tree_file &file) { return source_tree_is_header(file.path); });
    return all;
}

std::set<std::string> header_stems()
{
    std::set<std::string> stems;
    for (const source_tree_file &header : headers()) {
        stems.insert(spelled(source_tree_stem(header.path)));
    }
    return stems;
}

void append(source_tree_complaints &all, const source_tree_complaints &more)
{
    all.insert(all.end(), more.begin(), more.end());
}

TEST(names, no_file_or_room_names_nothing)
{
    source_tree_complaints complaints;
    for (const source_tree_file &file : source_tree_read({"src", "platform", "config", "systemd", "tests"})) {
        append(complaints, empty_names(file.path));
    }
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

TEST(names, stems_are_unique)
{
    std::vector<std::string> paths;
    for (const source_tree_file &file : tree()) {
        if (source_tree_is_code(file.path)) {
            paths.push_back(file.path);
        }
    }
    EXPECT_GT(paths.size(), 20u) << "the tree was not read";
    const source_tree_complaints complaints = doubled_stems(paths);
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

TEST(names, what_a_header_declares_begins_with_its_stem)
{
    const std::set<std::string> stems = header_stems();
    source_tree_complaints complaints;
    size_t count = 0;
    for (const source_tree_file &header : headers()) {
        append(complaints, foreign_names(header, stems));
        count += source_scan_text(header.text).names.size();
    }
    EXPECT_GT(count, 100u) << "the headers were not read";
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

TEST(names, include_guards_follow_from_the_path)
{
    source_tree_complaints complaints;
    for (const source_tree_file &header : headers()) {
        append(complaints, wrong_guard(header));
    }
    EXPECT_FALSE(headers().empty());
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

TEST(names, planted_empty_names_are_seen)
{
    EXPECT_EQ(empty_names("src/common/box.h").size(), 1u);
    EXPECT_EQ(empty_names("src/clay/mesh_utils.c").size(), 1u);
    EXPECT_EQ(empty_names("platform/desk/key-manager.cpp").size(), 1u);
    EXPECT_EQ(empty_names("src/clay/commonly.c").size(), 0u);
    EXPECT_EQ(empty_names("src/clay/score.c").size(), 0u);
}

TEST(names, planted_doubled_stems_are_seen)
{
    EXPECT_EQ(doubled_stems({"src/clay/box.c", "src/clay/box.h", "src/tool/bow.h"}).size(), 0u);
    EXPECT_EQ(doubled_stems({"src/clay/box.c", "platform/desk/box.h"}).size(), 1u);
}

size_t planted(const std::string &text)
{
    return foreign_names({"src/lattice/box.h", text}, {"box", "clay"}).size();
}

TEST(names, planted_foreign_names_are_seen)
{
    EXPECT_EQ(planted("int size(void);"), 1u);
    EXPECT_EQ(planted("int boxes(void);"), 1u);
    EXPECT_EQ(planted("static inline int thing(void) { return 1; }"), 1u);
    EXPECT_EQ(planted("struct thing { int a; };"), 1u);
    EXPECT_EQ(planted("typedef struct box { int a; } Box;"), 1u);
    EXPECT_EQ(planted("int box_getSize(void);"), 1u);
    EXPECT_EQ(planted("#define MAX 3"), 1u);
    EXPECT_EQ(planted("enum { LEFT };"), 1u);
    EXPECT_EQ(planted("static const int limit = 3;"), 1u);
    EXPECT_EQ(planted("struct stranger;"), 1u);
    EXPECT_EQ(planted("namespace glaise { }"), 1u);
    EXPECT_EQ(planted("#define GLAISE_LATTICE_BOX_H\nstruct clay;\nint box_size(struct box *b);\nenum { BOX_A };\n"
                      "struct box { int size; };"),
              0u);
}

TEST(names, planted_wrong_guards_are_seen)
{
    const std::string path = "src/lattice/box.h";
    EXPECT_EQ(wrong_guard({path, "/* x */\n#ifndef GLAISE_LATTICE_BOX_H\n#define GLAISE_LATTICE_BOX_H\nint a;\n"
                                 "#endif\n"}).size(),
              0u);
    EXPECT_EQ(wrong_guard({path, "#ifndef GLAISE_CLAY_BOX_H\n#define GLAISE_CLAY_BOX_H\n#endif\n"}).size(), 1u);
    EXPECT_EQ(wrong_guard({path, "#ifndef GLAISE_LATTICE_BOX_H\n#define GLAISE_LATTICE_BOX\n#endif\n"}).size(), 1u);
    EXPECT_EQ(wrong_guard({path, "int a;\n#ifndef GLAISE_LATTICE_BOX_H\n#define GLAISE_LATTICE_BOX_H\n#endif\n"})
                  .size(),
              1u);
    EXPECT_EQ(wrong_guard({path, "#pragma once\nint box;\n"}).size(), 1u);
    EXPECT_EQ(wrong_guard({path, ""}).size(), 1u);
}

} // namespace
