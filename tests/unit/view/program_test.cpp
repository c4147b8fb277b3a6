/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a shader that does not compile or link says which one and why, and leaves nothing behind.
 * Method: wrong texts on purpose, in each stage and between them. */
#include "view_stage.h"

#include "view/program.h"

namespace {

using view_program = view_stage;

constexpr char good_vertex[] = "out vec2 v_a;\nvoid main() { v_a = vec2(0.5); gl_Position = vec4(0.0); }\n";
constexpr char good_fragment[] =
    "in vec2 v_a;\nuniform float u_b;\nlayout(location = 0) out vec4 f;\nvoid main() { f = vec4(v_a, u_b, 1.0); }\n";

TEST_F(view_program, links_what_is_right)
{
    GLuint program = 0;
    ASSERT_TRUE(program_open("right", {good_vertex}, {good_fragment}, &program, &trouble)) << trouble;
    EXPECT_TRUE(glIsProgram(program));
    EXPECT_GE(program_uniform(program, "u_b"), 0);
    program_close(program);
    EXPECT_FALSE(glIsProgram(program));
    program_close(0);
}

TEST_F(view_program, says_which_stage_does_not_compile)
{
    GLuint program = 1;
    EXPECT_FALSE(program_open("lamp", {"void main() { nonsense; }"}, {good_fragment}, &program, &trouble));
    EXPECT_EQ(program, 0u);
    EXPECT_NE(trouble.find("lamp"), std::string::npos) << trouble;
    EXPECT_NE(trouble.find("vertex"), std::string::npos) << trouble;
    EXPECT_NE(trouble.find("nonsense"), std::string::npos) << trouble;
    EXPECT_FALSE(program_open("lamp", {good_vertex}, {"void main() { gibberish; }"}, &program, &trouble));
    EXPECT_NE(trouble.find("fragment"), std::string::npos) << trouble;
    EXPECT_NE(trouble.find("gibberish"), std::string::npos) << trouble;
}

TEST_F(view_program, says_what_does_not_link)
{
    GLuint program = 1;
    const char other[] = "in vec3 v_a;\nlayout(location = 0) out vec4 f;\nvoid main() { f = vec4(v_a, 1.0); }\n";
    EXPECT_FALSE(program_open("lamp", {good_vertex}, {other}, &program, &trouble));
    EXPECT_EQ(program, 0u);
    EXPECT_NE(trouble.find("lamp does not link"), std::string::npos) << trouble;
    EXPECT_NE(trouble.find("v_a"), std::string::npos) << trouble;
}

} // namespace
