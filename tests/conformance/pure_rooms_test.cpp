/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the C rooms have no clock, threads, I/O, logging or global state, and between tape and field no mathematics
 *       whose last bit depends on the machine's library.
 * Method: includes, calls and variables of those rooms are read and looked up in the lists below; every entry kind is
 *       planted once. */
#include "source_scan.h"
#include "source_token.h"
#include "source_tree.h"

#include <gtest/gtest.h>

#include <set>

namespace {

const std::set<std::string> c_rooms = {"src/lattice", "src/clay",  "src/tool",     "src/surface",
                                       "src/history", "src/solid", "src/particle", "src/sculpture"};

const std::set<std::string> world_headers = {
    "stdio.h", "time.h",   "pthread.h", "threads.h", "unistd.h", "fcntl.h", "signal.h", "syslog.h", "locale.h",
    "setjmp.h", "poll.h", "iostream", "fstream",  "thread",  "mutex",  "chrono",   "random",   "future"};

const std::set<std::string> world_calls = {"rand",  "srand",  "random", "drand48", "getenv", "time",
                                           "clock",       "printf", "fprintf", "puts",  "perror",  "exit",   "system",
                                           "clock_gettime"};

/* Exactly rounded or exact everywhere: sqrt, floor, ceil, trunc, rint, fabs, copysign, ldexp, frexp and the
 * classifications. fmin and fmax are not: they may return either zero. */
const std::set<std::string> loose_mathematics = {
    "sin",  "cos",   "tan",   "asin", "acos", "atan",  "atan2", "sinh", "cosh",  "tanh", "asinh", "acosh",  "atanh",
    "exp",  "exp2",  "expm1", "log",  "log2", "log10", "log1p", "pow",  "cbrt",  "hypot", "erf",  "erfc",   "tgamma",
    "fmin", "fmax",  "fma",   "fmod", "sincos", "exp10", "lgamma", "remainder"};

bool is_c_room(const std::string &path)
{
    return c_rooms.count(source_tree_folder(path)) != 0;
}

/* Where the field is made: the C rooms, and the station that splits paths into dabs. */
bool is_before_field(const std::string &path)
{
    return is_c_room(path) || source_tree_folder(path) == "src/station";
}

bool is_loose(const std::string &name)
{
    const bool has_suffix = name.size() > 1 && (name.back() == 'f' || name.back() == 'l');
    return loose_mathematics.count(name) != 0 ||
           (has_suffix && loose_mathematics.count(name.substr(0, name.size() - 1)) != 0);
}

source_tree_complaints calls(const source_tree_file &file)
{
    source_tree_complaints complaints;
    const std::vector<source_token> tokens = source_token_cut_code(file.text);
    for (size_t i = 0; i + 1 < tokens.size(); ++i) {
        const bool is_member = i > 0 && (tokens[i - 1].text == "." || tokens[i - 1].text == "->");
        if (tokens[i].kind != source_token_kind::word || tokens[i + 1].text != "(" || is_member) {
            continue;
        }
        const std::string at = file.path + ":" + std::to_string(tokens[i].line) + ": " + tokens[i].text + "() ";
        if (is_before_field(file.path) && is_loose(tokens[i].text)) {
            complaints.push_back(at + "may differ in the last bit from one library to the next");
        }
        if (is_c_room(file.path) && world_calls.count(tokens[i].text) != 0) {
            complaints.push_back(at + "reaches out of the room");
        }
    }
    return complaints;
}

source_tree_complaints impurities(const source_tree_file &file)
{
    source_tree_complaints complaints = calls(file);
    if (!is_c_room(file.path)) {
        return complaints;
    }
    for (const source_token_include &include : source_token_includes(file.text)) {
        if (world_headers.count(include.path) != 0 || include.path.starts_with("sys/") ||
            include.path.starts_with("linux/")) {
            complaints.push_back(file.path + ":" + std::to_string(include.line) + ": <" + include.path +
                                 "> is the world outside");
        }
    }
    for (const source_scan_mutable &one : source_scan_text(file.text).mutables) {
        complaints.push_back(file.path + ":" + std::to_string(one.line) + ": " + one.name + " is global state");
    }
    if (file.path.ends_with(".cpp") && source_tree_room(file.path) != "particle") {
        complaints.push_back(file.path + ":1: C++ in a C room");
    }
    return complaints;
}

TEST(pure_rooms, have_no_world_and_no_state)
{
    source_tree_complaints complaints;
    size_t count = 0;
    for (const source_tree_file &file : source_tree_read({"src"})) {
        if (source_tree_is_code(file.path)) {
            const source_tree_complaints more = impurities(file);
            complaints.insert(complaints.end(), more.begin(), more.end());
            count += is_c_room(file.path);
        }
    }
    EXPECT_GT(count, 20u) << "the C rooms were not read";
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

size_t planted(const std::string &path, const std::string &text)
{
    return impurities({path, text}).size();
}

TEST(pure_rooms, planted_headers_and_calls_are_seen)
{
    EXPECT_EQ(planted("src/clay/a.c", "#include <stdio.h>\n"), 1u);
    EXPECT_EQ(planted("src/history/a.c", "#include <unistd.h>\n"), 1u);
    EXPECT_EQ(planted("src/tool/a.c", "#include <sys/stat.h>\n"), 1u);
    EXPECT_EQ(planted("src/tool/a.c", "int f(void) { return rand(); }"), 1u);
    EXPECT_EQ(planted("src/particle/a.c", "long f(void) { return time(0); }"), 1u);
    EXPECT_EQ(planted("src/clay/a.c", "#include <stdint.h>\n#include <math.h>\n#include <string.h>\n"), 0u);
    EXPECT_EQ(planted("src/station/a.cpp", "#include <fstream>\n"), 0u);
}

TEST(pure_rooms, planted_loose_mathematics_is_seen)
{
    for (const char *name : {"sin", "cosf", "expf", "pow", "powl", "tanf", "atan2", "hypotf", "fmodf", "fmaxf"}) {
        const std::string text = std::string("float f(float x) { return ") + name + "(x); }";
        EXPECT_EQ(planted("src/tool/a.c", text), 1u) << name;
        EXPECT_EQ(planted("src/station/a.cpp", text), 1u) << name;
        EXPECT_EQ(planted("src/view/a.cpp", text), 0u) << name;
    }
    EXPECT_EQ(planted("src/station/a.cpp", "float f(float x) { return std::sin(x); }"), 1u);
    EXPECT_EQ(planted("src/tool/a.c", "float f(float x) { return sqrtf(floorf(fabsf(x))) + ceilf(x) + lrintf(x); }"),
              0u);
    EXPECT_EQ(planted("src/tool/a.c", "float f(struct a *b) { return turn_sin(b->log(b->exp)); } /* sin(x) */"), 0u);
}

TEST(pure_rooms, planted_state_is_seen)
{
    EXPECT_EQ(planted("src/clay/a.c", "static int count;\n"), 1u);
    EXPECT_EQ(planted("src/clay/a.c", "int f(void) { static int count = 0; return ++count; }\n"), 1u);
    EXPECT_EQ(planted("src/clay/a.c", "static const char *names[] = {\"a\"};\n"), 1u);
    EXPECT_EQ(planted("src/clay/a.c", "static const char *const names[] = {\"a\"};\n"), 0u);
    EXPECT_EQ(planted("src/clay/a.cpp", "int f() { return 1; }\n"), 1u);
    EXPECT_EQ(planted("src/station/a.cpp", "static int count;\n"), 0u);
}

} // namespace
