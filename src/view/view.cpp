/* SPDX-License-Identifier: Apache-2.0 */
#include "view/view.h"

#include "view/backdrop_shader.h"
#include "view/canvas.h"
#include "view/clay_shader.h"
#include "view/colour_shader.h"
#include "view/marker.h"
#include "view/patch_shader.h"
#include "view/program.h"
#include "view/projection.h"
#include "view/studio.h"
#include "view/upload.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <memory>

struct clay_uniforms {
    GLint middle, eye_from_steps, eye_normal, clip_from_eye;
    GLint light_count, light_place, light_colour, material;
    GLint environment, environment_strength, tool_from_eye, ring;
};

struct view {
    canvas picture;
    upload clay;
    upload tool; /* of snapshot.tool_surface */
    size_t budget_bytes = VIEW_ALL;
    const surface *tool_surface = nullptr;
    marker markers;
    GLuint studio = 0;
    GLuint backdrop = 0, clay_program = 0;
    GLuint empty_array = 0;
    GLint aspect = -1;
    clay_uniforms at{};
};

namespace {

constexpr double brick_steps = BRICK_EDGE;

bool context_is_good(std::string *trouble_out)
{
    const auto *version = reinterpret_cast<const char *>(glGetString(GL_VERSION));
    int major = 0, minor = 0;
    if (!version || std::sscanf(version, "OpenGL ES %d.%d", &major, &minor) != 2) {
        *trouble_out = "no OpenGL ES context is current";
        return false;
    }
    if (major > 3 || (major == 3 && minor >= 1))
        return true;
    *trouble_out = std::string("OpenGL ES 3.1 is needed, this is ") + version;
    return false;
}

bool open_clay_program(view *v, std::string *trouble_out)
{
    if (!program_open("clay", {colour_shader_text, patch_shader_vertex}, {colour_shader_text, clay_shader_fragment},
                      &v->clay_program, trouble_out))
        return false;
    const GLuint p = v->clay_program;
    v->at = {program_uniform(p, "u_middle"),        program_uniform(p, "u_eye_from_steps"),
             program_uniform(p, "u_eye_normal"),    program_uniform(p, "u_clip_from_eye"),
             program_uniform(p, "u_light_count"),   program_uniform(p, "u_light_place[0]"),
             program_uniform(p, "u_light_colour[0]"), program_uniform(p, "u_material"),
             program_uniform(p, "u_environment"),   program_uniform(p, "u_environment_strength"),
             program_uniform(p, "u_tool_from_eye"), program_uniform(p, "u_ring")};
    glUseProgram(p);
    glUniform1i(program_uniform(p, "u_bricks"), 0);
    glUniform1i(program_uniform(p, "u_studio"), 1);
    return true;
}

bool open_all(view *v, std::string *trouble_out)
{
    if (!open_clay_program(v, trouble_out) ||
        !program_open("backdrop", {backdrop_shader_vertex}, {colour_shader_text, backdrop_shader_fragment},
                      &v->backdrop, trouble_out) ||
        !marker_open(&v->markers, trouble_out) || !studio_open(&v->studio, trouble_out))
        return false;
    v->aspect = program_uniform(v->backdrop, "u_aspect");
    glGenVertexArrays(1, &v->empty_array);
    upload_init(&v->clay, false);
    upload_init(&v->tool, true);
    glUseProgram(0);
    return true;
}

/* --- what must lie between near and far --- */

void hold_clay(const view &v, const snapshot &s, const glm::dmat4 &eye_from_world, std::vector<projection_ball> *held)
{
    const box b = v.clay.bricks;
    if (box_is_empty(b))
        return;
    const double brick = s.step_mm * brick_steps;
    held->push_back(projection_ball_of_box(
        eye_from_world, brick * glm::dvec3(b.min.i, b.min.j, b.min.k),
        brick * (glm::dvec3(b.max.i, b.max.j, b.max.k) + 1.0)));
}

void hold_tool(const view &v, const snapshot &s, const glm::dmat4 &eye_from_world, std::vector<projection_ball> *held)
{
    glm::dvec3 reach(1);
    glm::dvec3 off(0);
    if (s.tool_surface) {
        const box b = v.tool.bricks;
        if (box_is_empty(b))
            return;
        const glm::dvec3 lo = brick_steps * glm::dvec3(b.min.i, b.min.j, b.min.k);
        const glm::dvec3 hi = 8.0 * (glm::dvec3(b.max.i, b.max.j, b.max.k) + 1.0);
        reach = 0.5 * (hi - lo);
        off = 0.5 * (hi + lo) - glm::dvec3(s.tool_middle[0], s.tool_middle[1], s.tool_middle[2]);
    }
    const glm::dmat4 eye_from_tool = eye_from_world * projection_of_frame(s.tool_world);
    double radius = 0;
    for (int a = 0; a < 3; a++)
        radius += reach[a] * glm::length(glm::dvec3(eye_from_tool[a]));
    const glm::dvec3 middle(eye_from_tool * glm::dvec4(off, 1));
    if (std::isfinite(radius) && std::isfinite(middle.z))
        held->push_back({middle, radius});
}

projection project(const view &v, const snapshot &s, int width, int height)
{
    const glm::dmat4 eye_from_world = projection_eye_from_world(s);
    std::vector<projection_ball> held;
    hold_clay(v, s, eye_from_world, &held);
    if (s.tool_style != SNAPSHOT_TOOL_HIDDEN)
        hold_tool(v, s, eye_from_world, &held);
    if (s.box_shown)
        held.push_back(projection_ball_of_box(eye_from_world, glm::dvec3(s.box_lo[0], s.box_lo[1], s.box_lo[2]),
                                              glm::dvec3(s.box_hi[0], s.box_hi[1], s.box_hi[2])));
    for (const snapshot_light &light : s.lights) {
        const glm::dvec4 at(light.position[0], light.position[1], light.position[2], 1);
        if (light.lit && s.lights_shown)
            held.push_back({glm::dvec3(light.with_viewer ? at : eye_from_world * at),
                            MARKER_LIGHT_RADIUS * s.camera_distance});
    }
    return projection_make(s, width, height, held);
}

/* --- the clay --- */

/* The brick under the point the camera looks at: from there offsets are small where precision is wanted. */
key middle_brick(const snapshot &s, const glm::dmat4 &eye_from_world)
{
    const glm::dvec3 target(glm::inverse(eye_from_world) * glm::dvec4(0, 0, -s.camera_distance, 1));
    const glm::dvec3 brick = glm::clamp(glm::floor(target / (s.step_mm * brick_steps)), glm::dvec3(KEY_MIN / 8),
                                        glm::dvec3(KEY_MAX / 8));
    return {static_cast<int32_t>(brick.x), static_cast<int32_t>(brick.y), static_cast<int32_t>(brick.z)};
}

void set_place(const view &v, const snapshot &s, const projection &p)
{
    const key middle = middle_brick(s, p.eye_from_world);
    const glm::dvec3 from = s.step_mm * brick_steps * glm::dvec3(middle.i, middle.j, middle.k);
    const glm::mat4 eye(glm::scale(glm::translate(p.eye_from_world, from), glm::dvec3(s.step_mm)));
    const glm::mat3 normal{glm::dmat3(p.eye_from_world)};
    const glm::mat4 clip(p.clip_from_eye);
    glUniform3i(v.at.middle, middle.i, middle.j, middle.k);
    glUniformMatrix4fv(v.at.eye_from_steps, 1, GL_FALSE, glm::value_ptr(eye));
    glUniformMatrix3fv(v.at.eye_normal, 1, GL_FALSE, glm::value_ptr(normal));
    glUniformMatrix4fv(v.at.clip_from_eye, 1, GL_FALSE, glm::value_ptr(clip));
}

void set_lights(const view &v, const snapshot &s, const projection &p)
{
    std::array<glm::vec3, SNAPSHOT_LIGHTS> place{}, colour{};
    GLint count = 0;
    for (const snapshot_light &light : s.lights) {
        if (!light.lit)
            continue;
        const glm::dvec4 at(light.position[0], light.position[1], light.position[2], 1);
        place[static_cast<size_t>(count)] = glm::vec3(light.with_viewer ? at : p.eye_from_world * at);
        colour[static_cast<size_t>(count)] =
            light.strength * glm::vec3(light.colour[0], light.colour[1], light.colour[2]);
        count++;
    }
    glUniform1i(v.at.light_count, count);
    glUniform3fv(v.at.light_place, SNAPSHOT_LIGHTS, glm::value_ptr(place[0]));
    glUniform3fv(v.at.light_colour, SNAPSHOT_LIGHTS, glm::value_ptr(colour[0]));
}

void set_ring(const view &v, const snapshot &s, const projection &p)
{
    glm::mat4 tool_from_eye(1);
    glm::vec4 ring(0);
    glm::dmat4 eye_from_tool;
    if (s.tool_style != SNAPSHOT_TOOL_HIDDEN && !s.tool_surface && marker_eye_from_tool(s, p, &eye_from_tool)) {
        tool_from_eye = glm::mat4(glm::inverse(eye_from_tool));
        ring = glm::vec4(marker_tool_colour(s), s.tool_working ? 1.0f : 0.7f);
    }
    glUniformMatrix4fv(v.at.tool_from_eye, 1, GL_FALSE, glm::value_ptr(tool_from_eye));
    glUniform4fv(v.at.ring, 1, glm::value_ptr(ring));
}

void draw_backdrop(const view &v, int width, int height)
{
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glUseProgram(v.backdrop);
    glUniform1f(v.aspect, static_cast<float>(width) / static_cast<float>(height));
    glBindVertexArray(v.empty_array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
}

void draw_clay(const view &v, const snapshot &s, const projection &p)
{
    glUseProgram(v.clay_program);
    set_place(v, s, p);
    set_lights(v, s, p);
    set_ring(v, s, p);
    glUniform3f(v.at.material, s.material.specular, std::max(s.material.shininess, 1.0f), s.material.ambient);
    glUniform1i(v.at.environment, s.environment);
    glUniform1f(v.at.environment_strength, std::clamp(s.environment_strength, 0.0f, 1.0f));
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, v.studio);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    upload_draw_triangles(v.clay);
    glDisable(GL_CULL_FACE);
    glActiveTexture(GL_TEXTURE0);
}

} // namespace

view *view_open(std::string *trouble_out)
{
    if (!context_is_good(trouble_out))
        return nullptr;
    auto v = std::make_unique<view>();
    if (open_all(v.get(), trouble_out))
        return v.release();
    view_close(v.release());
    return nullptr;
}

void view_close(view *v)
{
    if (!v)
        return;
    canvas_close(&v->picture);
    upload_finish(&v->clay);
    upload_finish(&v->tool);
    marker_close(&v->markers);
    program_close(v->backdrop);
    program_close(v->clay_program);
    glDeleteTextures(1, &v->studio);
    glDeleteVertexArrays(1, &v->empty_array);
    delete v;
}

bool view_update(view *v, const sculpture *s, std::string *trouble_out, size_t budget_bytes)
{
    static_assert(VIEW_ALL == UPLOAD_ALL && VIEW_FRAME_BYTES >= UPLOAD_BUDGET_LEAST_BYTES);
    v->budget_bytes = budget_bytes;
    return upload_update(&v->clay, &s->surface, budget_bytes, trouble_out);
}

void view_forget(view *v) { upload_clear(&v->clay); }

bool view_draw(view *v, const snapshot &s, int width, int height, std::string *trouble_out)
{
    return view_draw_part(v, s, width, height, {0, 0, width, height}, trouble_out);
}

bool view_draw_part(view *v, const snapshot &s, int width, int height, const view_part &part, std::string *trouble_out)
{
    v->picture.resolved = false;
    *trouble_out = projection_trouble(s);
    if (!trouble_out->empty() || !canvas_size(&v->picture, part.width, part.height, trouble_out))
        return false;
    if (s.tool_surface != v->tool_surface)
        upload_clear(&v->tool);
    v->tool_surface = s.tool_surface;
    if (s.tool_surface && !upload_update(&v->tool, s.tool_surface, v->budget_bytes, trouble_out))
        return false;
    const projection p = projection_of_part(project(*v, s, width, height), width, height,
                                            {part.x, part.y, part.width, part.height});
    canvas_begin(&v->picture);
    draw_backdrop(*v, width, height);
    draw_clay(*v, s, p);
    marker_draw_box(v->markers, s, p);
    marker_draw_lights(v->markers, s, p);
    marker_draw_tool(v->markers, s, p, s.tool_surface ? &v->tool : nullptr, height);
    marker_draw_keeping(v->markers, s, p);
    glUseProgram(0);
    canvas_end(&v->picture);
    upload_drawn(&v->clay);
    upload_drawn(&v->tool);
    return true;
}

bool view_pixels(view *v, std::vector<uint8_t> *rgba_out, std::string *trouble_out)
{
    return canvas_read(&v->picture, rgba_out, trouble_out);
}

uint32_t view_texture(const view *v) { return v->picture.texture; }

view_counts view_count(const view *v)
{
    return {v->clay.counts.bytes, v->clay.counts.patches, v->clay.counts.held,
            v->clay.counts.waiting + v->tool.counts.waiting, v->picture.samples};
}
