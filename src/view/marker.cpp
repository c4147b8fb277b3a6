/* SPDX-License-Identifier: Apache-2.0 */
#include "view/marker.h"

#include "view/colour_shader.h"
#include "view/marker_shader.h"
#include "view/patch_shader.h"
#include "view/program.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

enum style { STYLE_PLAIN, STYLE_LINE, STYLE_GLASS, STYLE_GLOW }; /* as marker_shader.h has them */

constexpr int ball_slices = 32, ball_stacks = 16;
constexpr int circle_sides = 72, latitudes = 7, longitudes = 8; /* great circles through the poles */

const glm::vec3 working_colour(1.0f, 0.36f, 0.06f);
const glm::vec3 light_yellow(1.0f, 0.76f, 0.20f);
const glm::vec3 box_colour(0.42f, 0.40f, 0.37f);
constexpr float box_alpha = 0.55f;
constexpr float wire_alpha = 0.85f, wire_alpha_working = 1.0f;
constexpr float wire_behind_clay = 0.22f;        /* part of the alpha that stays where clay hides the tool */
constexpr float wire_far_side = 0.30f;           /* and on the tool's own far side */
constexpr double wire_step_pixels = 12, wire_thinnest = 0.10;
constexpr float glass_alpha = 0.24f, glass_alpha_working = 0.38f;
constexpr float glass_rim = 2.6f, glass_far_side = 0.45f, glass_behind_clay = 0.25f;
constexpr float line_width_at_1080 = 1.25f, line_width_working = 1.5f; /* pixels; factor */

/* --- geometry: one buffer of points --- */

glm::vec3 on_ball(double polar, double azimuth)
{
    return glm::vec3(std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth));
}

void add_ball(std::vector<glm::vec3> *points, std::vector<uint16_t> *indices)
{
    using std::numbers::pi;
    for (int y = 0; y <= ball_stacks; y++)
        for (int x = 0; x <= ball_slices; x++)
            points->push_back(on_ball(pi * y / ball_stacks, 2 * pi * x / ball_slices));
    for (int y = 0; y < ball_stacks; y++) {
        for (int x = 0; x < ball_slices; x++) {
            const int a = y * (ball_slices + 1) + x, b = a + ball_slices + 1;
            for (int n : {a, a + 1, b, a + 1, b + 1, b})
                indices->push_back(static_cast<uint16_t>(n));
        }
    }
}

void add_circles(std::vector<glm::vec3> *points)
{
    using std::numbers::pi;
    for (int n = 1; n <= latitudes; n++) {
        for (int side = 0; side < circle_sides; side++) {
            points->push_back(on_ball(pi * n / (latitudes + 1), 2 * pi * side / circle_sides));
            points->push_back(on_ball(pi * n / (latitudes + 1), 2 * pi * (side + 1) / circle_sides));
        }
    }
    for (int n = 0; n < longitudes; n++) {
        for (int side = 0; side < circle_sides; side++) {
            points->push_back(on_ball(2 * pi * side / circle_sides, pi * n / longitudes));
            points->push_back(on_ball(2 * pi * (side + 1) / circle_sides, pi * n / longitudes));
        }
    }
}

void add_box(std::vector<glm::vec3> *points)
{
    for (int corner = 0; corner < 8; corner++) {
        for (int axis = 0; axis < 3; axis++) {
            if (corner >> axis & 1)
                continue;
            const int other = corner | 1 << axis;
            points->emplace_back(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
            points->emplace_back(other & 1, other >> 1 & 1, other >> 2 & 1);
        }
    }
}

void make_geometry(marker *m)
{
    std::vector<glm::vec3> points;
    std::vector<uint16_t> indices;
    add_ball(&points, &indices);
    m->ball_indices = static_cast<GLsizei>(indices.size());
    m->circles_first = static_cast<GLint>(points.size());
    add_circles(&points);
    m->circles_count = static_cast<GLsizei>(points.size()) - m->circles_first;
    m->box_first = static_cast<GLint>(points.size());
    add_box(&points);
    m->box_count = static_cast<GLsizei>(points.size()) - m->box_first;
    glGenVertexArrays(1, &m->array);
    glBindVertexArray(m->array);
    glGenBuffers(1, &m->vertices);
    glBindBuffer(GL_ARRAY_BUFFER, m->vertices);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(points.size() * sizeof points[0]), points.data(),
                 GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof points[0], nullptr);
    glGenBuffers(1, &m->indices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, m->indices);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof indices[0]), indices.data(),
                 GL_STATIC_DRAW);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

/* --- programs --- */

bool open_program(marker_program *p, const char *name, const program_text &vertex, bool of_patches,
                  std::string *trouble_out)
{
    if (!program_open(name, vertex, {colour_shader_text, marker_shader_fragment}, &p->program, trouble_out))
        return false;
    p->eye_from_marker = program_uniform(p->program, of_patches ? "u_eye_from_steps" : "u_eye_from_marker");
    p->eye_normal = program_uniform(p->program, "u_eye_normal");
    p->clip_from_eye = program_uniform(p->program, "u_clip_from_eye");
    p->style = program_uniform(p->program, "u_style");
    p->colour = program_uniform(p->program, "u_colour");
    p->alpha = program_uniform(p->program, "u_alpha");
    p->middle = of_patches ? program_uniform(p->program, "u_middle") : -1;
    if (of_patches) {
        glUseProgram(p->program);
        glUniform1i(program_uniform(p->program, "u_bricks"), 0);
    }
    return true;
}

void place(const marker_program &p, const glm::dmat4 &eye_from_marker, const projection &view)
{
    glUseProgram(p.program);
    const glm::mat4 eye(eye_from_marker), clip(view.clip_from_eye);
    const glm::mat3 normal(glm::transpose(glm::inverse(glm::dmat3(eye_from_marker))));
    glUniformMatrix4fv(p.eye_from_marker, 1, GL_FALSE, glm::value_ptr(eye));
    glUniformMatrix3fv(p.eye_normal, 1, GL_FALSE, glm::value_ptr(normal));
    glUniformMatrix4fv(p.clip_from_eye, 1, GL_FALSE, glm::value_ptr(clip));
}

void paint(const marker_program &p, style how, const glm::vec3 &colour, float alpha, float away, float rim)
{
    glUniform1i(p.style, how);
    glUniform4f(p.colour, colour.r, colour.g, colour.b, alpha);
    glUniform2f(p.alpha, away, rim);
}

void begin_blending()
{
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
}

void end_blending()
{
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LEQUAL);
}

bool is_drawable(const glm::dmat4 &m)
{
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++)
            if (!std::isfinite(m[column][row]))
                return false;
    const glm::dmat3 axes(m);
    const double lengths = glm::length(axes[0]) * glm::length(axes[1]) * glm::length(axes[2]);
    return lengths > 0 && std::abs(glm::determinant(axes)) > FRAME_FLAT * lengths;
}

/* --- the tool: a ball or patches, the same passes --- */

struct tool_geometry {
    const marker *of;
    const upload *patches;
    bool mirrored; /* the frame turns left into right: front faces wind the other way */

    void triangles() const
    {
        if (patches) {
            upload_draw_triangles(*patches);
            return;
        }
        glBindVertexArray(of->array);
        glDrawElements(GL_TRIANGLES, of->ball_indices, GL_UNSIGNED_SHORT, nullptr);
    }

    void lines() const
    {
        if (patches) {
            upload_draw_lines(*patches);
            return;
        }
        glBindVertexArray(of->array);
        glDrawArrays(GL_LINES, of->circles_first, of->circles_count);
    }
};

/* Triangles' sides lie about a step apart. Where that is a few pixels they would fill the tool up: thin them out. */
float thinned(const tool_geometry &g, const snapshot &s, const glm::dmat4 &eye_from_tool, int height)
{
    if (!g.patches)
        return 1;
    const double step_mm = std::cbrt(std::abs(glm::determinant(glm::dmat3(eye_from_tool))));
    const double ahead = std::max(-eye_from_tool[3].z, PROJECTION_NEAR_MIN * s.camera_distance);
    const double step_pixels = step_mm * projection_pixels_per_mm(s, height, ahead);
    return static_cast<float>(std::clamp(step_pixels / wire_step_pixels, wire_thinnest, 1.0));
}

void draw_wire(const marker_program &p, const tool_geometry &g, const snapshot &s, float thin)
{
    const glm::vec3 colour = marker_tool_colour(s);
    const float alpha = (s.tool_working ? wire_alpha_working : wire_alpha) * thin;
    glDepthFunc(GL_GREATER);
    paint(p, STYLE_LINE, colour, alpha * wire_behind_clay, wire_far_side, 1);
    g.lines();
    glDepthFunc(GL_LEQUAL);
    paint(p, STYLE_LINE, colour, alpha, wire_far_side, 1);
    g.lines();
}

void draw_glass(const marker_program &p, const tool_geometry &g, const snapshot &s)
{
    const glm::vec3 colour = marker_tool_colour(s);
    const float alpha = s.tool_working ? glass_alpha_working : glass_alpha;
    glEnable(GL_CULL_FACE);
    glFrontFace(g.mirrored ? GL_CW : GL_CCW);
    glCullFace(GL_BACK);
    glDepthFunc(GL_GREATER);
    paint(p, STYLE_GLASS, colour, alpha * glass_behind_clay, 1, glass_rim);
    g.triangles();
    glCullFace(GL_FRONT);
    glDepthFunc(GL_LEQUAL);
    paint(p, STYLE_GLASS, colour, alpha, glass_far_side, glass_rim);
    g.triangles();
    /* Depth first, so that of a folded tool only the nearest layer is blended: the order of patches must not show. */
    glCullFace(GL_BACK);
    glDepthMask(GL_TRUE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    g.triangles();
    glDepthMask(GL_FALSE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    g.triangles();
    glFrontFace(GL_CCW);
    glDisable(GL_CULL_FACE);
}

} // namespace

bool marker_open(marker *m, std::string *trouble_out)
{
    *m = marker{};
    if (!open_program(&m->globes, "marker", {marker_shader_vertex}, false, trouble_out) ||
        !open_program(&m->patches, "freeform tool", {colour_shader_text, patch_shader_vertex}, true, trouble_out)) {
        marker_close(m);
        return false;
    }
    make_geometry(m);
    GLfloat range[2] = {1, 1};
    glGetFloatv(GL_ALIASED_LINE_WIDTH_RANGE, range);
    m->line_width_max = range[1];
    return true;
}

void marker_close(marker *m)
{
    program_close(m->globes.program);
    program_close(m->patches.program);
    if (m->array != 0) {
        glDeleteVertexArrays(1, &m->array);
        glDeleteBuffers(1, &m->vertices);
        glDeleteBuffers(1, &m->indices);
    }
    *m = marker{};
}

bool marker_eye_from_tool(const snapshot &s, const projection &p, glm::dmat4 *eye_from_tool_out)
{
    *eye_from_tool_out = p.eye_from_world * projection_of_frame(s.tool_world);
    return is_drawable(*eye_from_tool_out);
}

glm::vec3 marker_tool_colour(const snapshot &s)
{
    const glm::vec3 own(s.tool_colour[0], s.tool_colour[1], s.tool_colour[2]);
    const glm::vec3 lifted = 0.62f * own + glm::vec3(0.34f, 0.33f, 0.31f);
    return s.tool_working ? glm::mix(lifted, working_colour, 0.8f) : lifted;
}

void marker_draw_box(const marker &m, const snapshot &s, const projection &p)
{
    const glm::dvec3 lo(s.box_lo[0], s.box_lo[1], s.box_lo[2]), hi(s.box_hi[0], s.box_hi[1], s.box_hi[2]);
    const glm::dmat4 eye_from_box = glm::scale(glm::translate(p.eye_from_world, lo), hi - lo);
    if (!s.box_shown || !is_drawable(eye_from_box))
        return;
    begin_blending();
    glLineWidth(1);
    place(m.globes, eye_from_box, p);
    paint(m.globes, STYLE_PLAIN, box_colour, box_alpha, 1, 1);
    glBindVertexArray(m.array);
    glDrawArrays(GL_LINES, m.box_first, m.box_count);
    glBindVertexArray(0);
    end_blending();
}

void marker_draw_lights(const marker &m, const snapshot &s, const projection &p)
{
    if (!s.lights_shown)
        return;
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glBindVertexArray(m.array);
    for (const snapshot_light &light : s.lights) {
        const glm::dvec3 at(light.position[0], light.position[1], light.position[2]);
        const glm::dmat4 eye_from_place = light.with_viewer ? glm::dmat4(1) : p.eye_from_world;
        const glm::dmat4 eye_from_ball =
            glm::scale(glm::translate(eye_from_place, at), glm::dvec3(MARKER_LIGHT_RADIUS * s.camera_distance));
        if (!light.lit || !is_drawable(eye_from_ball))
            continue;
        place(m.globes, eye_from_ball, p);
        const glm::vec3 own(light.colour[0], light.colour[1], light.colour[2]);
        paint(m.globes, STYLE_GLOW, light_yellow * glm::mix(glm::vec3(1), own, 0.5f) * 1.6f, 1, 1, 1);
        glDrawElements(GL_TRIANGLES, m.ball_indices, GL_UNSIGNED_SHORT, nullptr);
    }
    glBindVertexArray(0);
    glDisable(GL_CULL_FACE);
}

void marker_draw_tool(const marker &m, const snapshot &s, const projection &p, const upload *patches, int height)
{
    glm::dmat4 eye_from_tool;
    if (s.tool_style == SNAPSHOT_TOOL_HIDDEN || !marker_eye_from_tool(s, p, &eye_from_tool))
        return;
    const marker_program &program = patches ? m.patches : m.globes;
    if (patches) {
        const key middle = {static_cast<int32_t>(std::floor(s.tool_middle[0] / 8)),
                            static_cast<int32_t>(std::floor(s.tool_middle[1] / 8)),
                            static_cast<int32_t>(std::floor(s.tool_middle[2] / 8))};
        const glm::dvec3 shift(8.0 * middle.i - s.tool_middle[0], 8.0 * middle.j - s.tool_middle[1],
                               8.0 * middle.k - s.tool_middle[2]);
        place(program, glm::translate(eye_from_tool, shift), p);
        glUniform3i(program.middle, middle.i, middle.j, middle.k);
    } else {
        place(program, eye_from_tool, p);
    }
    begin_blending();
    const tool_geometry geometry = {&m, patches, glm::determinant(glm::dmat3(eye_from_tool)) < 0};
    if (s.tool_style == SNAPSHOT_TOOL_WIREFRAME) {
        const float width =
            line_width_at_1080 * static_cast<float>(height) / 1080 * (s.tool_working ? line_width_working : 1);
        glLineWidth(std::clamp(width, 1.0f, m.line_width_max));
        draw_wire(program, geometry, s, thinned(geometry, s, eye_from_tool, height));
        glLineWidth(1);
    } else {
        draw_glass(program, geometry, s);
    }
    glBindVertexArray(0);
    end_blending();
}
