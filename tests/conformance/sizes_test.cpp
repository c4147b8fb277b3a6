/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a file serves one noun, a function fits a screen, a line fits beside another; main stays a composition root.
 * Method: lines and bodies are counted over the whole tree; texts one line too long are planted. */
#include "source_scan.h"
#include "source_tree.h"

#include <gtest/gtest.h>

namespace {

constexpr size_t file_lines_max = 600;
constexpr size_t line_columns_max = 120;
constexpr int function_lines_max = 70;
constexpr size_t main_lines_max = 149;

/* Characters of UTF-8, not bytes. */
size_t columns(const std::string &line)
{
    size_t n = 0;
    for (const char c : line) {
        n += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    }
    return n;
}


source_tree_complaints too_long(const source_tree_file &file)
{
    source_tree_complaints complaints;
    const std::vector<std::string> lines = source_tree_lines(file.text);
    const size_t limit = file.path == "src/main.cpp" ? main_lines_max : file_lines_max;
    if (lines.size() > limit) {
        complaints.push_back(file.path + ":" + std::to_string(lines.size()) + ": more than " +
                             std::to_string(limit) + " lines");
    }
    for (size_t i = 0; i < lines.size(); ++i) {
        if (columns(lines[i]) > line_columns_max) {
            complaints.push_back(file.path + ":" + std::to_string(i + 1) + ": " + std::to_string(columns(lines[i])) +
                                 " columns");
        }
    }
    if (source_tree_is_code(file.path)) {
        for (const source_scan_body &body : source_scan_text(file.text).bodies) {
            if (body.last_line - body.first_line + 1 > function_lines_max) {
                complaints.push_back(file.path + ":" + std::to_string(body.first_line) + ": " + body.name + " has " +
                                     std::to_string(body.last_line - body.first_line + 1) + " lines");
            }
        }
    }
    return complaints;
}

TEST(sizes, files_functions_and_lines_fit)
{
    source_tree_complaints complaints;
    size_t bodies = 0;
    for (const source_tree_file &file : source_tree_read({"src", "platform"})) {
        const source_tree_complaints more = too_long(file);
        complaints.insert(complaints.end(), more.begin(), more.end());
        bodies += source_tree_is_code(file.path) ? source_scan_text(file.text).bodies.size() : 0;
    }
    EXPECT_GT(bodies, 50u) << "the tree was not read";
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

std::string repeated(const std::string &line, size_t times)
{
    std::string all;
    for (size_t i = 0; i < times; ++i) {
        all += line;
    }
    return all;
}

TEST(sizes, planted_long_ones_are_seen)
{
    EXPECT_EQ(too_long({"src/clay/a.c", repeated("\n", 600)}).size(), 0u);
    EXPECT_EQ(too_long({"src/clay/a.c", repeated("\n", 601)}).size(), 1u);
    EXPECT_EQ(too_long({"src/main.cpp", repeated("\n", 149)}).size(), 0u);
    EXPECT_EQ(too_long({"src/main.cpp", repeated("\n", 150)}).size(), 1u);
    EXPECT_EQ(too_long({"platform/run", repeated("#", 120) + "\n"}).size(), 0u);
    EXPECT_EQ(too_long({"platform/run", repeated("#", 121) + "\n"}).size(), 1u);
    EXPECT_EQ(too_long({"platform/run", repeated("\xc3\xa9", 120) + "\n"}).size(), 0u);
    EXPECT_EQ(too_long({"src/clay/a.c", "int f(void)\n{\n" + repeated("    g();\n", 67) + "}\n"}).size(), 0u);
    EXPECT_EQ(too_long({"src/clay/a.c", "int f(void)\n{\n" + repeated("    g();\n", 68) + "}\n"}).size(), 1u);
    EXPECT_EQ(too_long({"src/view/a.h", "class a {\n int f()\n{\n" + repeated("    g();\n", 68) + "}\n};\n"}).size(),
              1u);
}

} // namespace
