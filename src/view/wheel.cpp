/* SPDX-License-Identifier: Apache-2.0 */
#include "view/wheel.h"

#include "view/colour_shader.h"
#include "view/hollow_shader.h"
#include "view/lighting_shader.h"
#include "view/program.h"
#include "view/wheel_shader.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace {

double radius_of(const snapshot &s)
{
    return WHEEL_WIDER * std::max(s.box_hi[0] - s.box_lo[0], s.box_hi[2] - s.box_lo[2]);
}

glm::dvec3 middle_of(const snapshot &s)
{
    return {0.5 * (s.box_lo[0] + s.box_hi[0]), s.box_lo[1], 0.5 * (s.box_lo[2] + s.box_hi[2])};
}

bool open_program(wheel_program *p, const char *name, const program_text &fragment, std::string *trouble_out)
{
    if (!program_open(name, {wheel_shader_vertex}, fragment, &p->program, trouble_out))
        return false;
    p->eye_from_wheel = program_uniform(p->program, "u_eye_from_wheel");
    p->eye_normal = program_uniform(p->program, "u_eye_normal");
    p->clip_from_eye = program_uniform(p->program, "u_clip_from_eye");
    glUseProgram(p->program);
    glUniform1i(program_uniform(p->program, "u_sides"), WHEEL_SIDES);
    glUseProgram(0);
    return true;
}

void draw(const wheel &w, const wheel_program &program, const snapshot &s, const projection &p)
{
    const double radius = radius_of(s);
    const glm::dmat4 eye_from_wheel = glm::scale(glm::translate(p.eye_from_world, middle_of(s)),
                                                 glm::dvec3(radius, WHEEL_THICK * radius, radius));
    const glm::mat4 eye(eye_from_wheel), clip(p.clip_from_eye);
    const glm::mat3 normal{glm::dmat3(p.eye_from_world)};
    glUniformMatrix4fv(program.eye_from_wheel, 1, GL_FALSE, glm::value_ptr(eye));
    glUniformMatrix3fv(program.eye_normal, 1, GL_FALSE, glm::value_ptr(normal));
    glUniformMatrix4fv(program.clip_from_eye, 1, GL_FALSE, glm::value_ptr(clip));
    glBindVertexArray(w.empty_array);
    glDrawArrays(GL_TRIANGLES, 0, 3 * 3 * WHEEL_SIDES);
    glBindVertexArray(0);
}

} // namespace

bool wheel_open(wheel *w, std::string *trouble_out)
{
    *w = {};
    if (!open_program(&w->shown, "turntable", {colour_shader_text, lighting_shader_text, wheel_shader_fragment},
                      trouble_out) ||
        !open_program(&w->relief, "turntable's relief", {hollow_shader_relief}, trouble_out)) {
        wheel_close(w);
        return false;
    }
    w->light = lighting_find(w->shown.program);
    w->ambient = program_uniform(w->shown.program, "u_ambient");
    w->look = program_uniform(w->shown.program, "u_look");
    w->depth_range = program_uniform(w->relief.program, "u_depth_range");
    glGenVertexArrays(1, &w->empty_array);
    return true;
}

void wheel_close(wheel *w)
{
    program_close(w->shown.program);
    program_close(w->relief.program);
    if (w->empty_array != 0)
        glDeleteVertexArrays(1, &w->empty_array);
    *w = {};
}

bool wheel_is_wanted(const snapshot &s)
{
    const bool look = s.look == SNAPSHOT_LOOK_CLAY || s.look == SNAPSHOT_LOOK_RAKING;
    return look && s.effects.floor && radius_of(s) > 0;
}

bool wheel_is_seen(const snapshot &s, const projection &p)
{
    const glm::dvec3 up(p.eye_from_world[1]);
    const glm::dvec3 middle(p.eye_from_world * glm::dvec4(middle_of(s), 1));
    return wheel_is_wanted(s) && glm::dot(up, middle) < 0;
}

projection_ball wheel_ball(const snapshot &s, const glm::dmat4 &eye_from_world)
{
    return {glm::dvec3(eye_from_world * glm::dvec4(middle_of(s), 1)), radius_of(s)};
}

void wheel_draw(const wheel &w, const snapshot &s, const projection &p, const lighting &light)
{
    glUseProgram(w.shown.program);
    lighting_set(w.light, light);
    glUniform1f(w.ambient, s.material.ambient);
    glUniform1i(w.look, s.look);
    draw(w, w.shown, s, p);
}

void wheel_draw_relief(const wheel &w, const snapshot &s, const projection &p)
{
    glUseProgram(w.relief.program);
    glUniform2f(w.depth_range, static_cast<float>(p.near_mm), static_cast<float>(p.far_mm));
    draw(w, w.relief, s, p);
}
