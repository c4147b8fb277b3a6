/* SPDX-License-Identifier: Apache-2.0 */
#include "view/backdrop.h"

#include "view/backdrop_shader.h"
#include "view/colour_shader.h"
#include "view/program.h"
#include "view/screen_shader.h"

#include <array>

namespace {

/* Linear light: about what the program's middle is. */
constexpr std::array<GLfloat, 4> even_ground = {0.05f, 0.046f, 0.041f, 1}, even_paper = {0.7f, 0.69f, 0.67f, 1};

} // namespace

bool backdrop_open(backdrop *b, std::string *trouble_out)
{
    *b = {};
    if (!program_open("backdrop", {screen_shader_vertex}, {colour_shader_text, backdrop_shader_fragment}, &b->program,
                      trouble_out))
        return false;
    b->aspect = program_uniform(b->program, "u_aspect");
    b->part = program_uniform(b->program, "u_part");
    b->look = program_uniform(b->program, "u_look");
    b->shift = program_uniform(b->program, "u_shift");
    glGenVertexArrays(1, &b->empty_array);
    return true;
}

void backdrop_close(backdrop *b)
{
    program_close(b->program);
    if (b->empty_array != 0)
        glDeleteVertexArrays(1, &b->empty_array);
    *b = {};
}

void backdrop_draw(const backdrop &b, snapshot_look look, const backdrop_place &at)
{
    const projection_part &q = at.part;
    const auto share = [](double some, double whole) { return static_cast<float>(some / whole); };
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    if (b.program != 0) {
        glUseProgram(b.program);
        glUniform1f(b.aspect, static_cast<float>(at.aspect));
        glUniform1f(b.shift, static_cast<float>(at.far_shift));
        glUniform4f(b.part, share(2 * q.x + q.width, at.width) - 1, 1 - share(2 * q.y + q.height, at.height),
                    share(q.width, at.width), share(q.height, at.height));
        glUniform1i(b.look, look);
        glBindVertexArray(b.empty_array);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glBindVertexArray(0);
    } else {
        glClearBufferfv(GL_COLOR, 0, (look == SNAPSHOT_LOOK_SILHOUETTE ? even_paper : even_ground).data());
    }
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
}
