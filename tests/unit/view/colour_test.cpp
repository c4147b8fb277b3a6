/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: sRGB, the film's toe and shoulder and the clear coat's weight are the functions that their headers say.
 * Method: the shaders' own texts run on the device, their results come back as bits; the numbers they are compared with
 *         were worked out by hand from the formulas in the headers, to six digits. */
#include "view/colour_shader.h"
#include "view/layer_shader.h"
#include "view/program.h"
#include "view_stage.h"

#include <cstring>

namespace {

constexpr char vertex[] = R"(
out vec3 v_eye;
centroid out vec3 v_normal;
centroid out vec3 v_colour;
void main()
{
    v_eye = v_normal = v_colour = vec3(1.0);
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

class colour : public view_stage {
  protected:
    /* What `expression` of u_in is on the device. head: texts that it needs. */
    std::array<float, 3> value(const program_text &head, const std::string &expression, std::array<float, 3> in)
    {
        const std::string text = "uniform vec3 u_in;\nlayout(location = 1) out uvec4 f_bits;\n"
                                 "void main() { f_bits = uvec4(floatBitsToUint(vec3(" +
                                 expression + ")), 0u); }\n";
        program_text fragment = head;
        fragment.push_back(text.c_str());
        GLuint program = 0, array = 0, target = 0, framebuffer = 0;
        EXPECT_TRUE(program_open("a formula", {vertex}, fragment, &program, &trouble)) << trouble;
        glGenVertexArrays(1, &array);
        glGenTextures(1, &target);
        glBindTexture(GL_TEXTURE_2D, target);
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32UI, 1, 1);
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, target, 0);
        const std::array<GLenum, 2> second{GL_NONE, GL_COLOR_ATTACHMENT1};
        glDrawBuffers(2, second.data());
        glReadBuffer(GL_COLOR_ATTACHMENT1);
        glViewport(0, 0, 1, 1);
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_BLEND);
        glUseProgram(program);
        glUniform3fv(program_uniform(program, "u_in"), 1, in.data());
        glBindVertexArray(array);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        std::array<uint32_t, 4> bits{};
        glReadPixels(0, 0, 1, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, bits.data());
        EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        glUseProgram(0);
        glBindVertexArray(0);
        glDeleteFramebuffers(1, &framebuffer);
        glDeleteTextures(1, &target);
        glDeleteVertexArrays(1, &array);
        program_close(program);
        std::array<float, 3> out{};
        std::memcpy(out.data(), bits.data(), sizeof out);
        return out;
    }

    void expect(const program_text &head, const std::string &expression, std::array<float, 3> in,
                std::array<double, 3> by_hand)
    {
        const std::array<float, 3> got = value(head, expression, in);
        for (size_t c = 0; c < 3; c++)
            EXPECT_NEAR(got[c], by_hand[c], 2e-5) << expression << " of " << in[c];
    }
};

TEST_F(colour, srgb_is_iec_61966)
{
    /* ((0.5 + 0.055) / 1.055)^2.4; 0.04 / 12.92; 1 */
    expect({colour_shader_text}, "linear_of(u_in)", {0.5f, 0.04f, 1.0f}, {0.214041, 0.003096, 1.0});
    expect({colour_shader_text}, "encoded_of(u_in)", {0.214041f, 0.003096f, 1.0f}, {0.5, 0.04, 1.0});
    expect({colour_shader_text}, "encoded_of(u_in)", {0.0f, 0.18f, 0.002f}, {0.0, 0.461356, 0.02584});
}

TEST_F(colour, film_has_a_toe_and_a_shoulder)
{
    /* toe alone: 0.18^2 / 0.192; 0.02^2 / 0.032; 0 */
    expect({colour_shader_text}, "film(vec3(u_in.x))", {0.18f, 0, 0}, {0.16875, 0.16875, 0.16875});
    expect({colour_shader_text}, "film(u_in)", {0.18f, 0.02f, 0.0f}, {0.16875, 0.0125, 0.0});
    /* grey 2: toe 4 / 2.012 = 1.988072; 0.55 + 0.45 (1 - exp(-1.438072 / 0.45)) = 0.981578 */
    expect({colour_shader_text}, "film(u_in)", {2, 2, 2}, {0.981578, 0.981578, 0.981578});
    /* red 2, green 0.2: after the toe 1.988072, 0.188679; times 0.981578 / 1.988072; then 0.260504 of the way to white */
    expect({colour_shader_text}, "film(u_in)", {2, 0.2f, 0}, {0.981578, 0.324592, 0.255705});
    const std::array<float, 3> dazzling = value({colour_shader_text}, "film(u_in)", {4000, 4000, 9000});
    for (float c : dazzling)
        EXPECT_LE(c, 1.0f);
    expect({colour_shader_text}, "film(u_in)", {-1, 0, 0}, {0, 0, 0});
}

TEST_F(colour, highlight_leaves_ordinary_light_alone)
{
    expect({colour_shader_text}, "highlight(u_in)", {0.1f, 0.55f, 0.3f}, {0.1, 0.55, 0.3});
    /* 0.55 + 0.45 (1 - exp(-1)) */
    expect({colour_shader_text}, "highlight(u_in)", {1, 0, 0}, {0.834454, 0, 0});
}

TEST_F(colour, the_coats_weight_is_schlicks)
{
    /* 0.04 + 0.96 (1 - c)^5: c = 1, 0.5, 0; then 0.2, 0.8, beyond 1 */
    expect({layer_shader_text}, "schlick(u_in.x), schlick(u_in.y), schlick(u_in.z)", {1, 0.5f, 0}, {0.04, 0.07, 1.0});
    expect({layer_shader_text}, "schlick(u_in.x), schlick(u_in.y), schlick(u_in.z)", {0.2f, -0.8f, 1.5f},
           {0.354573, 0.040307, 0.04});
}

TEST_F(colour, a_direction_finds_its_place_on_the_map)
{
    expect({layer_shader_text}, "scenery_place(u_in), 0.0", {0, 0, 1}, {0.5, 0.5, 0.0});
    /* m = 2 sqrt(2) for a direction at right angles to the axis */
    expect({layer_shader_text}, "scenery_place(u_in), 0.0", {1, 0, 0}, {0.853553, 0.5, 0.0});
    expect({layer_shader_text}, "scenery_place(u_in), 0.0", {0, -1, 0}, {0.5, 0.146447, 0.0});
}

} // namespace
