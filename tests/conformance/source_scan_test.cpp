/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the laws rest on this scanner, so what it finds in known texts is exactly what is there.
 * Method: small texts in the manner of the tree, each with the traps of C declarations; names compared one by one. */
#include "source_scan.h"
#include "source_token.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

std::string names(std::string_view text)
{
    std::string all;
    for (const source_scan_name &name : source_scan_text(text).names) {
        all += std::string(1, source_scan_kind_text(name.kind)[0]) + ":" + name.name + " ";
    }
    return all;
}

std::string mutables(std::string_view text)
{
    std::string all;
    for (const source_scan_mutable &one : source_scan_text(text).mutables) {
        all += one.name + "@" + std::to_string(one.line) + " ";
    }
    return all;
}

TEST(source_token, comments_and_literals_hide_what_they_hold)
{
    const std::vector<source_token> tokens =
        source_token_cut_code("a /* b */ // c\n\"d /* e\" 'f' R\"x(g \" h)x\" 1'000u 0x1p-3f i");
    std::string all;
    for (const source_token &token : tokens) {
        all += token.text + "|";
    }
    EXPECT_EQ(all, "a|\"d /* e\"|'f'|R\"x(g \" h)x\"|1'000u|0x1p-3f|i|");
}

TEST(source_token, lines_are_counted_through_comments_and_continuations)
{
    const std::vector<source_token> tokens = source_token_cut("/* 1\n2 */\n#define A \\\n  b\nc");
    ASSERT_EQ(tokens.size(), 3u);
    EXPECT_EQ(tokens[1].line, 3);
    EXPECT_EQ(tokens[2].text, "c");
    EXPECT_EQ(tokens[2].line, 5);
}

TEST(source_token, includes_are_found_and_commented_ones_are_not)
{
    const auto includes = source_token_includes("#include \"a/b.h\"\n#  include <c.h> /* why */\n"
                                                "/* #include \"d.h\" */\n// #include \"e.h\"\n\"#include <f.h>\"\n");
    ASSERT_EQ(includes.size(), 2u);
    EXPECT_EQ(includes[0].path, "a/b.h");
    EXPECT_TRUE(includes[0].quoted);
    EXPECT_EQ(includes[1].path, "c.h");
    EXPECT_FALSE(includes[1].quoted);
    EXPECT_EQ(includes[1].line, 2);
}

TEST(source_scan, functions_declared_and_defined)
{
    EXPECT_EQ(names("int box_size(const struct box *b);"), "f:box_size ");
    EXPECT_EQ(names("[[nodiscard]] bool box_is(struct box b, int (*f)(int));"), "f:box_is ");
    EXPECT_EQ(names("static inline struct box box_of(int a) { struct box b = {a}; return b; }"), "f:box_of ");
    EXPECT_EQ(names("extern \"C\" {\nvoid box_a(void);\n}\nextern \"C\" void box_b(void);"), "f:box_a f:box_b ");
    EXPECT_EQ(names("__attribute__((warn_unused_result)) int box_c(void) __attribute__((pure));"), "f:box_c ");
    EXPECT_EQ(names("template <typename T, int N = (1 > 2)> T box_d(std::array<T, N> a);"), "f:box_d ");
    EXPECT_EQ(names("std::vector<std::pair<int, int>> box_e(int n = 3);"), "f:box_e ");
    EXPECT_EQ(names("bool operator==(const box &a, const box &b);\nbox::box(int a) : a_(a), b_{2} {}\n"), "");
}

TEST(source_scan, types_and_what_is_in_them)
{
    EXPECT_EQ(names("struct box { int lo[3], hi[3]; int (*f)(void); };"), "t:box ");
    EXPECT_EQ(names("typedef struct box { struct { int a; } in; } box, *box_pointer;"), "t:box t:box t:box_pointer ");
    EXPECT_EQ(names("typedef int (*box_visit)(void *user, int n);\ntypedef float box_row[8];"),
              "t:box_visit t:box_row ");
    EXPECT_EQ(names("enum box_side { BOX_LEFT, BOX_RIGHT = (1 << 3), BOX_SIDES };"),
              "t:box_side e:BOX_LEFT e:BOX_RIGHT e:BOX_SIDES ");
    EXPECT_EQ(names("enum { BOX_MAX = 3 };"), "e:BOX_MAX ");
    EXPECT_EQ(names("enum class box_kind : int { a, b };"), "t:box_kind ");
    EXPECT_EQ(names("class box {\npublic:\n box();\n int f() const { return a; }\nprivate:\n int a = 0;\n};"),
              "t:box ");
    EXPECT_EQ(names("struct box;\ntypedef struct box box;"), "f:box f:box ");
    EXPECT_EQ(names("using box_list = std::vector<int>;"), "t:box_list ");
}

TEST(source_scan, constants_macros_and_namespaces)
{
    EXPECT_EQ(names("static const int box_table[2][2] = {{1, 2}, {3, 4}};"), "v:box_table ");
    EXPECT_EQ(names("inline constexpr float box_size_world{1.0f};"), "v:box_size_world ");
    EXPECT_EQ(names("extern const char *const box_names[3];"), "v:box_names ");
    EXPECT_EQ(names("#define BOX_MAX(a, b) \\\n ((a) > (b))\n"), "m:BOX_MAX ");
    EXPECT_EQ(names("_Static_assert(sizeof(int) == 4, \"x\");"), "");
    EXPECT_EQ(names("namespace thing { int a(int b); }"), "n:thing f:a ");
    EXPECT_EQ(names("namespace { int b(int c); }\nusing namespace std;"), "f:b n:using std ");
}

TEST(source_scan, bodies_have_their_lines)
{
    const source_scan scan = source_scan_text("int a(void)\n{\n    return 1;\n}\n\nstruct b {\n    int c()\n    {\n"
                                              "        auto f = [] { return 1; };\n        return f();\n    }\n};\n"
                                              "b::b() : x(1), y{2}\n{\n}\n");
    ASSERT_EQ(scan.bodies.size(), 3u);
    EXPECT_EQ(scan.bodies[0].name, "a");
    EXPECT_EQ(scan.bodies[0].first_line, 1);
    EXPECT_EQ(scan.bodies[0].last_line, 4);
    EXPECT_EQ(scan.bodies[1].name, "c");
    EXPECT_EQ(scan.bodies[1].last_line - scan.bodies[1].first_line, 4);
    EXPECT_EQ(scan.bodies[2].first_line, 13);
    EXPECT_EQ(scan.bodies[2].last_line, 15);
}

TEST(source_scan, mutable_state_is_found_wherever_it_hides)
{
    EXPECT_EQ(mutables("static int a;\nint b = 3, c[2];\nextern float d;"), "a@1 b@2 c@2 d@3 ");
    EXPECT_EQ(mutables("static const char *e = \"x\";\nstatic const char *const ok = \"y\";"), "e@1 ");
    EXPECT_EQ(mutables("static struct box f = {1};\nstatic const struct box ok = {2};"), "f@1 ");
    EXPECT_EQ(mutables("void g(void)\n{\n    static int calls;\n    static const int table[] = {1, 2};\n}"),
              "calls@3 ");
    EXPECT_EQ(mutables("static int (*h)(void);\nstatic int (*const ok[])(void) = {a, b};"), "h@1 ");
    EXPECT_EQ(mutables("_Thread_local int i;\nconstexpr const char *ok = \"z\";"), "i@1 ");
    EXPECT_EQ(mutables("struct s { int a; };\nint f(int a);\ntypedef int t;\nenum { A };"), "");
}

TEST(source_scan, what_stands_between_declarations_is_not_lost)
{
    EXPECT_EQ(names("#ifdef __cplusplus\nextern \"C\" {\n#endif\nint box_a(void);\n#ifdef __cplusplus\n}\n#endif\n"
                    "int box_b(void);"),
              "f:box_a f:box_b ");
    EXPECT_EQ(names("int box_c(void) { if (1) { return '}'; } return 0; } /* } */ int box_d(void);"),
              "f:box_c f:box_d ");
}

} // namespace
