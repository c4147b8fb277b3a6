/* SPDX-License-Identifier: Apache-2.0 */
#include "view/lens.h"

#include "view/colour_shader.h"
#include "view/lens_shader.h"
#include "view/program.h"
#include "view/screen_shader.h"

bool lens_open(lens *l, std::string *trouble_out)
{
    *l = {};
    if (!program_open("lens", {screen_shader_vertex}, {colour_shader_text, lens_shader_fragment}, &l->program,
                      trouble_out))
        return false;
    l->depth_range = program_uniform(l->program, "u_depth_range");
    l->origin = program_uniform(l->program, "u_origin");
    l->at = program_uniform(l->program, "u_lens");
    glUseProgram(l->program);
    glUniform1i(program_uniform(l->program, "u_sharp"), 0);
    glUniform1i(program_uniform(l->program, "u_hollow"), 1);
    glUseProgram(0);
    glGenVertexArrays(1, &l->empty_array);
    return true;
}

void lens_close(lens *l)
{
    program_close(l->program);
    if (l->empty_array != 0)
        glDeleteVertexArrays(1, &l->empty_array);
    *l = {};
}

void lens_draw(const lens &l, GLuint sharp, GLuint hollow, const projection &p, double focus_mm, double blur,
               int height, const glm::vec2 &origin)
{
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glUseProgram(l.program);
    glUniform2f(l.depth_range, static_cast<float>(p.near_mm), static_cast<float>(p.far_mm));
    glUniform2f(l.origin, origin.x, origin.y);
    glUniform3f(l.at, static_cast<float>(focus_mm), static_cast<float>(blur * LENS_WIDEST * height),
                static_cast<float>(LENS_LIMIT * height));
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, hollow);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, sharp);
    glBindVertexArray(l.empty_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glBindTexture(GL_TEXTURE_2D, 0);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, 0);
    glActiveTexture(GL_TEXTURE0);
    glUseProgram(0);
    glEnable(GL_DEPTH_TEST);
}
