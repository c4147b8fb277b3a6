/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a header is the manual of its file and stands on its own; every source says its licence first.
 * Method: the opening comment of each header is read for its headings; each header is compiled alone, twice over, by
 *         the compiler that builds these tests, as C17 where C may use it and as C++20. Poor ones are planted. */
#include "source_scan.h"
#include "source_token.h"
#include "source_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>
#include <sys/wait.h>

namespace {

const std::string licence = "SPDX-License-Identifier: Apache-2.0";

/* "* Is not:  more" begins with "Is not". */
bool has_heading(const std::string &comment, const std::string &heading)
{
    for (const std::string &line : source_tree_lines(comment)) {
        const size_t at = line.find_first_not_of(" \t/*");
        if (at != std::string::npos && line.compare(at, heading.size(), heading) == 0) {
            const char next = at + heading.size() < line.size() ? line[at + heading.size()] : ':';
            if (next == ':' || next == '.' || next == ' ') {
                return true;
            }
        }
    }
    return false;
}

/* The first comment that is more than the licence; nothing but the include guard may stand before it. */
std::string opening_comment(const std::string &text)
{
    for (const source_token &token : source_token_cut(text)) {
        if (token.kind == source_token_kind::comment && token.text.find("SPDX") == std::string::npos) {
            return token.text;
        }
        const std::string directive =
            token.kind == source_token_kind::directive ? source_token_directive(token, nullptr) : "";
        if (token.kind != source_token_kind::comment && directive != "ifndef" && directive != "define") {
            return "";
        }
    }
    return "";
}

source_tree_complaints poor_manual(const source_tree_file &header)
{
    const std::string manual = opening_comment(header.text);
    source_tree_complaints complaints;
    for (const char *heading : {"What", "Is not"}) {
        if (!has_heading(manual, heading)) {
            complaints.push_back(header.path + ":1: the opening comment has no \"" + heading + "\"");
        }
    }
    const std::array<const char *, 5> others = {"Shape", "Units", "Owner", "Errors", "Cost"};
    if (std::none_of(others.begin(), others.end(), [&](const char *one) { return has_heading(manual, one); })) {
        complaints.push_back(header.path + ":1: the opening comment has none of Shape, Units, Owner, Errors, Cost");
    }
    return complaints;
}

/* Text files this project writes itself, in languages with comments. */
bool is_source(const source_tree_file &file)
{
    static const std::set<std::string> known = {".c", ".cpp", ".h", ".sh", ".py", ".cmake"};
    return known.count(source_tree_extension(file.path)) != 0 || file.text.starts_with("#!");
}

/* First line, or the second of a script. */
source_tree_complaints no_licence(const source_tree_file &file)
{
    const std::vector<std::string> lines = source_tree_lines(file.text);
    const size_t at = !lines.empty() && lines[0].starts_with("#!") ? 1 : 0;
    if (lines.size() > at && lines[at].find(licence) != std::string::npos) {
        return {};
    }
    return {file.path + ":" + std::to_string(at + 1) + ": no " + licence};
}

/* Compiles "#include HEADER" twice over and nothing else. Returns what the compiler said, empty when it was content. */
std::string compiled_alone(const std::string &language, const std::string &include, const std::string &folder)
{
    const bool is_c = language == "c";
    const std::string compiler = is_c ? GLAISE_C_COMPILER : GLAISE_CXX_COMPILER;
    const std::string flags = std::string(is_c ? "-std=c17" : "-std=c++20") +
                              " -fsyntax-only -Wall -Wextra -Wpedantic -Wshadow -Wvla -Werror -D_GNU_SOURCE";
    const std::string line = "#include \"" + include + "\"\\n";
    const std::string command = "printf '" + line + line + "typedef int alone;\\n' | '" + compiler + "' -x " +
                                language + " " + flags + " -I '" + folder + "/src' -I '" + folder + "' - 2>&1";
    FILE *pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) {
        return "no shell";
    }
    std::string said;
    char piece[4096];
    for (size_t n; (n = fread(piece, 1, sizeof piece, pipe)) > 0;) {
        said.append(piece, n);
    }
    const int status = pclose(pipe);
    const bool is_good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    return is_good ? "" : "as " + language + ": " + (said.empty() ? "the compiler failed" : said);
}

bool is_in_c_room(const source_tree_file &header)
{
    static const std::set<std::string> c_rooms = {"src/lattice", "src/clay",  "src/tool",     "src/surface",
                                                  "src/history", "src/solid", "src/particle", "src/sculpture"};
    return c_rooms.count(source_tree_folder(header.path)) != 0;
}

bool has_c_linkage(const source_tree_file &header)
{
    return header.text.find("extern \"C\"") != std::string::npos;
}

/* A header outside the C rooms is for C too where it opens extern "C". */
bool is_for_c(const source_tree_file &header)
{
    return is_in_c_room(header) || has_c_linkage(header);
}

/* Something another file has to be linked for. */
bool has_linkage(const source_tree_file &header)
{
    const source_scan scan = source_scan_text(header.text);
    return std::any_of(scan.names.begin(), scan.names.end(), [&](const source_scan_name &name) {
        return name.kind == source_scan_kind::function &&
               std::none_of(scan.bodies.begin(), scan.bodies.end(),
                            [&](const source_scan_body &body) { return body.name == name.name; });
    });
}

source_tree_complaints closed_to_cpp(const source_tree_file &header)
{
    if (is_in_c_room(header) && has_linkage(header) && !has_c_linkage(header)) {
        return {header.path + ":1: no extern \"C\" for C++ users"};
    }
    return {};
}

bool is_built(const source_tree_file &header)
{
    const std::string folder = source_tree_folder(header.path);
    return GLAISE_HAS_VIEW != 0 || (folder != "src/view" && folder != "src/wiring" && folder != "platform/display");
}

std::vector<source_tree_file> headers()
{
    std::vector<source_tree_file> all;
    for (source_tree_file &file : source_tree_read({"src", "platform"})) {
        if (source_tree_is_header(file.path)) {
            all.push_back(std::move(file));
        }
    }
    return all;
}

TEST(manuals, every_header_opens_with_its_manual)
{
    source_tree_complaints complaints;
    for (const source_tree_file &header : headers()) {
        const source_tree_complaints more = poor_manual(header);
        complaints.insert(complaints.end(), more.begin(), more.end());
    }
    EXPECT_GT(headers().size(), 20u) << "the tree was not read";
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

TEST(manuals, every_source_says_its_licence_first)
{
    source_tree_complaints complaints;
    size_t count = 0;
    for (const source_tree_file &file : source_tree_read({"src", "platform", "tests"})) {
        if (is_source(file)) {
            const source_tree_complaints more = no_licence(file);
            complaints.insert(complaints.end(), more.begin(), more.end());
            ++count;
        }
    }
    EXPECT_GT(count, 40u) << "the tree was not read";
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

TEST(manuals, every_header_compiles_alone)
{
    source_tree_complaints complaints;
    for (const source_tree_file &header : headers()) {
        if (!is_built(header)) {
            continue;
        }
        const std::string include = header.path.starts_with("src/") ? header.path.substr(4) : header.path;
        for (const char *language : {"c", "c++"}) {
            const bool is_wanted = language[1] != '\0' || is_for_c(header);
            const std::string said = is_wanted ? compiled_alone(language, include, SOURCE_ROOT) : "";
            if (!said.empty()) {
                complaints.push_back(header.path + " " + said);
            }
        }
    }
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

TEST(manuals, c_rooms_are_open_to_cpp)
{
    source_tree_complaints complaints;
    for (const source_tree_file &header : headers()) {
        const source_tree_complaints more = closed_to_cpp(header);
        complaints.insert(complaints.end(), more.begin(), more.end());
    }
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

TEST(manuals, planted_poor_manuals_are_seen)
{
    const std::string whole = "/* " + licence + " */\n/*\n * What:   a box.\n * Is not: a bag.\n * Owner: you.\n */\n";
    EXPECT_EQ(poor_manual({"a.h", whole}).size(), 0u);
    EXPECT_EQ(poor_manual({"a.h", "#ifndef A\n#define A\n" + whole + "int a;\n"}).size(), 0u);
    EXPECT_EQ(poor_manual({"a.h", "int a;\n" + whole}).size(), 3u);
    EXPECT_EQ(poor_manual({"a.h", "/* What: a box.\n * Is not: a bag. */\n"}).size(), 1u);
    EXPECT_EQ(poor_manual({"a.h", "/* What: a box.\n * Cost: none. */\n"}).size(), 1u);
    EXPECT_EQ(poor_manual({"a.h", "/* Is not: a bag.\n * Whatever else.\n * Units: mm */\n"}).size(), 1u);
    EXPECT_EQ(poor_manual({"a.h", ""}).size(), 3u);
}

TEST(manuals, planted_missing_licences_are_seen)
{
    EXPECT_EQ(no_licence({"a.c", "/* " + licence + " */\nint a;\n"}).size(), 0u);
    EXPECT_EQ(no_licence({"a.sh", "#!/bin/sh\n# " + licence + "\n"}).size(), 0u);
    EXPECT_EQ(no_licence({"a.c", "\n/* " + licence + " */\n"}).size(), 1u);
    EXPECT_EQ(no_licence({"a.c", ""}).size(), 1u);
}

TEST(manuals, planted_headers_closed_to_cpp_are_seen)
{
    EXPECT_EQ(closed_to_cpp({"src/clay/a.h", "int a_size(void);\n"}).size(), 1u);
    EXPECT_EQ(closed_to_cpp({"src/clay/a.h", "extern \"C\" {\nint a_size(void);\n}\n"}).size(), 0u);
    EXPECT_EQ(closed_to_cpp({"src/clay/a.h", "#define A_SIZE 3\n"}).size(), 0u);
    EXPECT_EQ(closed_to_cpp({"src/clay/a.h", "static inline int a_size(void) { return 3; }\n"}).size(), 0u);
}

class planted_header {
public:
    explicit planted_header(const std::string &text)
    {
        folder_ = testing::TempDir() + "glaise_planted_XXXXXX";
        is_made_ = mkdtemp(folder_.data()) != nullptr;
        FILE *file = is_made_ ? fopen((folder_ + "/planted.h").c_str(), "w") : nullptr;
        is_made_ = file != nullptr && fputs(text.c_str(), file) >= 0;
        is_made_ = file != nullptr && fclose(file) == 0 && is_made_;
    }

    ~planted_header()
    {
        remove((folder_ + "/planted.h").c_str());
        remove(folder_.c_str());
    }

    planted_header(const planted_header &) = delete;
    planted_header &operator=(const planted_header &) = delete;

    bool compiles(const std::string &language) const
    {
        EXPECT_TRUE(is_made_);
        return compiled_alone(language, "planted.h", folder_).empty();
    }

private:
    std::string folder_;
    bool is_made_ = false;
};

TEST(manuals, planted_headers_that_lean_on_others_are_seen)
{
    const planted_header whole("#ifndef P\n#define P\n#include <stdint.h>\nuint8_t planted(void);\n#endif\n");
    EXPECT_TRUE(whole.compiles("c"));
    EXPECT_TRUE(whole.compiles("c++"));
    const planted_header leaning("#ifndef P\n#define P\nuint8_t planted(void);\n#endif\n");
    EXPECT_FALSE(leaning.compiles("c"));
    EXPECT_FALSE(leaning.compiles("c++"));
    const planted_header unguarded("struct planted { int a; };\n");
    EXPECT_FALSE(unguarded.compiles("c"));
    const planted_header c_only("#ifndef P\n#define P\nint planted(int class);\n#endif\n");
    EXPECT_TRUE(c_only.compiles("c"));
    EXPECT_FALSE(c_only.compiles("c++"));
}

} // namespace
