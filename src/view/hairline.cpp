/* SPDX-License-Identifier: Apache-2.0 */
#include "view/hairline.h"

#include "view/colour_shader.h"
#include "view/hairline_shader.h"
#include "view/program.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace {

constexpr double height_of_widths = 1080, thinnest = 1;
constexpr float dash_period = 9; /* pixels at that height, along x + y */

std::array<GLint, 4> viewport()
{
    std::array<GLint, 4> v{};
    glGetIntegerv(GL_VIEWPORT, v.data());
    return v;
}

void fill(GLuint buffer, const std::vector<hairline_line> &lines, GLenum use)
{
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(lines.size() * sizeof lines[0]), lines.data(), use);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void set(const hairline &h, const snapshot &s, const projection &p, const glm::dmat4 &eye_from_lines,
         const hairline_look &look)
{
    const std::array<GLint, 4> v = viewport();
    const glm::mat4 eye(eye_from_lines), clip(p.clip_from_eye);
    const glm::mat3 normal(glm::transpose(glm::inverse(glm::dmat3(eye_from_lines))));
    const double scale = hairline_picture_height(s, p) / height_of_widths;
    glUseProgram(h.program);
    glUniformMatrix4fv(h.eye_from_lines, 1, GL_FALSE, glm::value_ptr(eye));
    glUniformMatrix3fv(h.eye_normal, 1, GL_FALSE, glm::value_ptr(normal));
    glUniformMatrix4fv(h.clip_from_eye, 1, GL_FALSE, glm::value_ptr(clip));
    glUniform2f(h.viewport, static_cast<float>(v[2]), static_cast<float>(v[3]));
    glUniform1f(h.width, static_cast<float>(std::max(look.width * scale, thinnest)));
    glUniform1f(h.away, look.away);
    glUniform1f(h.dash, look.dashed ? std::max(dash_period * static_cast<float>(scale), 6.0f) : 0.0f);
}

} // namespace

bool hairline_open(hairline *h, const std::vector<hairline_line> &keep, std::string *trouble_out)
{
    *h = hairline{};
    if (!program_open("lines", {hairline_shader_vertex}, {colour_shader_text, hairline_shader_fragment}, &h->program,
                      trouble_out))
        return false;
    h->eye_from_lines = program_uniform(h->program, "u_eye_from_lines");
    h->eye_normal = program_uniform(h->program, "u_eye_normal");
    h->clip_from_eye = program_uniform(h->program, "u_clip_from_eye");
    h->viewport = program_uniform(h->program, "u_viewport");
    h->width = program_uniform(h->program, "u_width");
    h->away = program_uniform(h->program, "u_away");
    h->dash = program_uniform(h->program, "u_dash");
    glGenBuffers(1, &h->kept);
    glGenBuffers(1, &h->fleeting);
    fill(h->kept, keep, GL_STATIC_DRAW);
    h->kept_count = static_cast<GLsizei>(keep.size());
    glGenVertexArrays(1, &h->array);
    glBindVertexArray(h->array);
    const GLuint offsets[3] = {offsetof(hairline_line, from), offsetof(hairline_line, into),
                               offsetof(hairline_line, colour)};
    for (GLuint n = 0; n < 3; n++) {
        glEnableVertexAttribArray(n);
        glVertexAttribFormat(n, n < 2 ? 3 : 4, GL_FLOAT, GL_FALSE, offsets[n]);
        glVertexAttribBinding(n, 0);
    }
    glVertexBindingDivisor(0, 1);
    glBindVertexArray(0);
    return true;
}

void hairline_close(hairline *h)
{
    program_close(h->program);
    if (h->array != 0) {
        glDeleteVertexArrays(1, &h->array);
        glDeleteBuffers(1, &h->kept);
        glDeleteBuffers(1, &h->fleeting);
    }
    *h = hairline{};
}

void hairline_draw_kept(const hairline &h, const snapshot &s, const projection &p, const glm::dmat4 &eye_from_lines,
                        const glm::vec4 &colour, const hairline_look &look)
{
    set(h, s, p, eye_from_lines, look);
    glBindVertexArray(h.array);
    glBindVertexBuffer(0, h.kept, 0, sizeof(hairline_line));
    glDisableVertexAttribArray(2);
    glVertexAttrib4fv(2, glm::value_ptr(colour));
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, h.kept_count);
    glEnableVertexAttribArray(2);
    glBindVertexArray(0);
}

void hairline_draw(const hairline &h, const snapshot &s, const projection &p, const std::vector<hairline_line> &lines,
                   const hairline_look &look)
{
    if (lines.empty())
        return;
    set(h, s, p, glm::dmat4(1), look);
    fill(h.fleeting, lines, GL_STREAM_DRAW);
    glBindVertexArray(h.array);
    glBindVertexBuffer(0, h.fleeting, 0, sizeof(hairline_line));
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(lines.size()));
    glBindVertexArray(0);
}

double hairline_picture_height(const snapshot &s, const projection &p)
{
    return viewport()[3] * p.clip_from_eye[1][1] * std::tan(0.5 * s.field_of_view);
}
