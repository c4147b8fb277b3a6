/* SPDX-License-Identifier: Apache-2.0 */
#include "view/marker.h"

#include "view/colour_shader.h"
#include "view/marker_shader.h"
#include "view/patch_shader.h"
#include "view/plumb.h"
#include "view/program.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace {

/* As marker_shader.h has them. */
enum style { STYLE_PLAIN, STYLE_LINE, STYLE_GLASS, STYLE_GLOW, STYLE_HALO, STYLE_SHADOW };

constexpr int ball_slices = 32, ball_stacks = 16;
constexpr int circle_sides = 72, latitudes = 7, longitudes = 8; /* great circles through the poles */

const glm::vec3 working_colour(1.0f, 0.36f, 0.06f);
const glm::vec3 hidden_colour(0.04f, 0.16f, 0.85f); /* clay is warm: blue stands out on it */
constexpr float hidden_part = 0.88f;             /* of it in the colour of what clay hides */
const glm::vec3 box_colour(0.42f, 0.40f, 0.37f);
constexpr float box_alpha = 0.75f, box_far_side = 0.4f, tick_part = 0.9f;
constexpr double tick_length = 0.16, tick_fifth = 2;   /* of MARKER_TICK_MM; every fifth is as much longer */
constexpr double tick_count_max = 100;                 /* along a side */
constexpr double tick_pixels_least = 3, tick_pixels = 9; /* apart; below the first none is drawn */
constexpr float wire_alpha = 0.85f, wire_alpha_working = 1.0f;
constexpr float wire_behind_clay = 0.55f;        /* part of the alpha that stays where clay hides the tool */
constexpr float wire_far_side = 0.30f;           /* and on the tool's own far side */
constexpr float wire_far_side_hidden = 0.65f;    /* there less: what is in clay is mostly that */
constexpr double wire_step_pixels = 12, wire_thinnest = 0.10;
constexpr float glass_alpha = 0.24f, glass_alpha_working = 0.38f;
constexpr float wire_fill = 0.10f;               /* of what clay hides */
constexpr float glass_rim = 2.6f, glass_far_side = 0.45f, glass_behind_clay = 1.2f;
constexpr double hatch_pixels = 11;              /* from stripe to stripe, at 1080 */
constexpr float line_width_at_1080 = 1.25f, line_width_working = 1.5f; /* pixels; factor */
constexpr float meeting_alpha = 0.9f, meeting_pixels = 1.5f, meeting_units = 64; /* of polygon offset */
constexpr float shadow_alpha = 0.45f;
constexpr double ring_part = 1.9; /* of a light's radius */
constexpr float halo_alpha = 0.5f;
constexpr int ring_sides = 40;

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

std::vector<hairline_line> circles()
{
    using std::numbers::pi;
    std::vector<hairline_line> lines;
    for (int side = 0; side < circle_sides; side++) {
        const double from = 2 * pi * side / circle_sides, into = 2 * pi * (side + 1) / circle_sides;
        for (int n = 1; n <= latitudes; n++) {
            const double polar = pi * n / (latitudes + 1);
            lines.push_back({on_ball(polar, from), on_ball(polar, into)});
        }
        for (int n = 0; n < longitudes; n++)
            lines.push_back({on_ball(from, pi * n / longitudes), on_ball(into, pi * n / longitudes)});
    }
    return lines;
}

void make_geometry(marker *m)
{
    std::vector<glm::vec3> points;
    std::vector<uint16_t> indices;
    add_ball(&points, &indices);
    m->ball_indices = static_cast<GLsizei>(indices.size());
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
    p->hatch = program_uniform(p->program, "u_hatch");
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
    glUniform1f(p.hatch, 0);
}

void hatch(const marker_program &p, double height)
{
    glUniform1f(p.hatch, std::max(static_cast<float>(hatch_pixels * height / 1080), 6.0f));
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

/* Which way front faces wind: turned by a frame that turns left into right, and by a mirrored picture. */
GLenum front_of(const glm::dmat4 &eye_from_marker, const projection &p)
{
    return (glm::determinant(glm::dmat3(eye_from_marker)) < 0) != projection_is_mirrored(p) ? GL_CW : GL_CCW;
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
    GLenum front;

    void triangles() const
    {
        if (patches) {
            upload_draw_triangles(*patches);
            return;
        }
        glBindVertexArray(of->array);
        glDrawElements(GL_TRIANGLES, of->ball_indices, GL_UNSIGNED_SHORT, nullptr);
    }
};

/* Triangles' sides lie about a step apart. Where that is a few pixels they would fill the tool up: thin them out. */
float thinned(const tool_geometry &g, const snapshot &s, const glm::dmat4 &eye_from_tool, double height)
{
    if (!g.patches)
        return 1;
    const double step_mm = std::cbrt(std::abs(glm::determinant(glm::dmat3(eye_from_tool))));
    const double ahead = std::max(-eye_from_tool[3].z, PROJECTION_NEAR_MIN * s.camera_distance);
    const double step_pixels = step_mm * height * projection_pixels_per_mm(s, 1, ahead);
    return static_cast<float>(std::clamp(step_pixels / wire_step_pixels, wire_thinnest, 1.0));
}

/* What is drawn of the tool, wherever it is drawn from. */
struct tool_picture {
    const snapshot &s;
    const projection &p;
    const marker_program &program;
    tool_geometry geometry;
    glm::dmat4 eye_from_tool;
    double height; /* pixels of the whole picture */

    void lines(const glm::vec3 &colour, float alpha, bool hidden) const
    {
        const float width = line_width_at_1080 * (s.tool_working ? line_width_working : 1);
        const float away = hidden ? wire_far_side_hidden : wire_far_side;
        if (!geometry.patches) {
            hairline_draw_kept(geometry.of->lines, s, p, eye_from_tool, glm::vec4(colour, alpha),
                               {width, away, hidden});
            return;
        }
        glLineWidth(std::clamp(width * static_cast<float>(height / 1080), 1.0f, geometry.of->line_width_max));
        paint(program, STYLE_LINE, colour, alpha, away, 1);
        if (hidden)
            hatch(program, height);
        upload_draw_lines(*geometry.patches);
        glLineWidth(1);
    }
};

glm::vec3 hidden_tool_colour(const snapshot &s) { return glm::mix(marker_tool_colour(s), hidden_colour, hidden_part); }

/* The near side of what clay hides, in stripes. */
void draw_hidden(const tool_picture &t, float alpha)
{
    glEnable(GL_CULL_FACE);
    glFrontFace(t.geometry.front);
    glCullFace(GL_BACK);
    glDepthFunc(GL_GREATER);
    paint(t.program, STYLE_GLASS, hidden_tool_colour(t.s), alpha * glass_behind_clay, 1, glass_rim);
    hatch(t.program, t.height);
    t.geometry.triangles();
    glFrontFace(GL_CCW);
    glDisable(GL_CULL_FACE);
    glDepthFunc(GL_LEQUAL);
}

void draw_wire(const tool_picture &t)
{
    draw_hidden(t, wire_fill);
    const float alpha = (t.s.tool_working ? wire_alpha_working : wire_alpha) *
                        thinned(t.geometry, t.s, t.eye_from_tool, t.height);
    glDepthFunc(GL_GREATER);
    t.lines(hidden_tool_colour(t.s), alpha * wire_behind_clay, true);
    glDepthFunc(GL_LEQUAL);
    t.lines(marker_tool_colour(t.s), alpha, false);
}

void draw_glass(const tool_picture &t)
{
    const glm::vec3 colour = marker_tool_colour(t.s);
    const tool_geometry &g = t.geometry;
    const float alpha = t.s.tool_working ? glass_alpha_working : glass_alpha;
    draw_hidden(t, alpha);
    glEnable(GL_CULL_FACE);
    glFrontFace(g.front);
    glCullFace(GL_FRONT);
    paint(t.program, STYLE_GLASS, colour, alpha, glass_far_side, glass_rim);
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

/* Pixels where the clay lies between the tool moved towards the eye and the tool moved away: the stencil is set by the
   first, taken back by the second. Front and back apart, or one would take back what the other set. */
void draw_meeting(const tool_picture &t)
{
    GLint bits = 0;
    glGetIntegerv(GL_STENCIL_BITS, &bits);
    if (bits == 0)
        return;
    glEnable(GL_STENCIL_TEST);
    glStencilMask(0xff);
    glClearStencil(0);
    glClear(GL_STENCIL_BUFFER_BIT);
    glEnable(GL_CULL_FACE);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glDepthFunc(GL_LEQUAL);
    paint(t.program, STYLE_PLAIN, marker_tool_colour(t.s), meeting_alpha, 1, 1);
    for (const GLenum hidden_side : {GL_BACK, GL_FRONT}) {
        glCullFace(hidden_side);
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glStencilFunc(GL_ALWAYS, 1, 0xff);
        glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
        glPolygonOffset(-meeting_pixels, -meeting_units);
        t.geometry.triangles();
        glStencilOp(GL_KEEP, GL_KEEP, GL_ZERO);
        glPolygonOffset(meeting_pixels, meeting_units);
        t.geometry.triangles();
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glStencilFunc(GL_EQUAL, 1, 0xff);
        glPolygonOffset(-meeting_pixels, -meeting_units);
        t.geometry.triangles();
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_CULL_FACE);
    glDisable(GL_STENCIL_TEST);
}

void draw_plumb(const marker &m, const snapshot &s, const projection &p)
{
    plumb l;
    if (!plumb_of(s, &l))
        return;
    glm::dmat4 eye_from_shadow = glm::translate(p.eye_from_world, l.foot);
    eye_from_shadow *= glm::dmat4(glm::dmat3(l.reach[0], glm::dvec3(0, 1e-3 * glm::length(l.reach[0]), 0), l.reach[1]));
    glEnable(GL_POLYGON_OFFSET_FILL); /* before a floor that lies in the same plane */
    glPolygonOffset(-2, -8);
    if (is_drawable(eye_from_shadow)) {
        glEnable(GL_CULL_FACE);
        glFrontFace(front_of(eye_from_shadow, p));
        glCullFace(GL_BACK);
        place(m.globes, eye_from_shadow, p);
        const glm::mat3 as_it_is(1);
        glUniformMatrix3fv(m.globes.eye_normal, 1, GL_FALSE, glm::value_ptr(as_it_is));
        paint(m.globes, STYLE_SHADOW, glm::vec3(0), shadow_alpha, 1, 1);
        glBindVertexArray(m.array);
        glDrawElements(GL_TRIANGLES, m.ball_indices, GL_UNSIGNED_SHORT, nullptr);
        glFrontFace(GL_CCW);
        glDisable(GL_CULL_FACE);
    }
    hairline_draw(m.lines, s, p, plumb_lines(l, p.eye_from_world, marker_tool_colour(s)), {});
    glDisable(GL_POLYGON_OFFSET_FILL);
}

/* --- the box --- */

struct box_picture {
    glm::dmat4 eye_from_world;
    glm::dvec3 corner[2], eye_world;
    float ticks_alpha;
    std::vector<hairline_line> lines;

    void add(const glm::dvec3 &from, const glm::dvec3 &into, float alpha)
    {
        lines.push_back({glm::vec3(eye_from_world * glm::dvec4(from, 1)),
                         glm::vec3(eye_from_world * glm::dvec4(into, 1)), glm::vec4(box_colour, alpha)});
    }
    bool shows(int axis, int end) const
    {
        return end == 0 ? eye_world[axis] < corner[0][axis] : eye_world[axis] > corner[1][axis];
    }
    /* Along `axis`, at these ends of the two others. Marks point inwards, level where they can. */
    void side(int axis, int first_end, int second_end)
    {
        const int first = (axis + 1) % 3, second = (axis + 2) % 3, inwards = axis == 0 ? 2 : 0;
        glm::dvec3 from(corner[0]), into(corner[1]);
        from[first] = into[first] = corner[first_end][first];
        from[second] = into[second] = corner[second_end][second];
        const bool is_far = !shows(first, first_end) && !shows(second, second_end);
        const float alpha = box_alpha * (is_far ? box_far_side : 1);
        add(from, into, alpha);
        const double length = corner[1][axis] - corner[0][axis];
        const double apart = length > tick_count_max * MARKER_TICK_MM ? 10 * MARKER_TICK_MM : MARKER_TICK_MM;
        const double tick = from[inwards] == corner[0][inwards] ? tick_length * apart : -tick_length * apart;
        for (int n = 1; n * apart < length && n < tick_count_max && ticks_alpha > 0; n++) {
            glm::dvec3 at(from), end(from);
            at[axis] = end[axis] = corner[0][axis] + n * apart;
            end[inwards] += tick * (n % 5 == 0 ? tick_fifth : 1);
            add(at, end, alpha * tick_part * ticks_alpha);
        }
    }
};

/* --- lights --- */

/* The light's own colour, as bright as a screen can. */
glm::vec3 bright(const snapshot_light &light)
{
    const glm::vec3 own = glm::max(glm::vec3(light.colour[0], light.colour[1], light.colour[2]), glm::vec3(0));
    const float most = std::max({own.r, own.g, own.b});
    return most > 0 ? own / most : glm::vec3(0.5f);
}

void draw_light(const marker &m, const snapshot &s, const projection &p, const snapshot_light &light)
{
    const glm::dvec3 at(light.position[0], light.position[1], light.position[2]);
    const glm::dvec3 middle(light.with_viewer ? glm::dvec4(at, 1) : p.eye_from_world * glm::dvec4(at, 1));
    const double radius = MARKER_LIGHT_RADIUS * s.camera_distance;
    const glm::dmat4 eye_from_ball = glm::scale(glm::translate(glm::dmat4(1), middle), glm::dvec3(radius));
    if (!is_drawable(eye_from_ball))
        return;
    const glm::vec3 colour = bright(light);
    glBindVertexArray(m.array);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(front_of(eye_from_ball, p));
    place(m.globes, eye_from_ball, p);
    paint(m.globes, STYLE_GLOW, colour * 1.6f, 1, 1, 1);
    glDrawElements(GL_TRIANGLES, m.ball_indices, GL_UNSIGNED_SHORT, nullptr);
    begin_blending();
    place(m.globes, glm::scale(eye_from_ball, glm::dvec3(MARKER_LIGHT_REACH / MARKER_LIGHT_RADIUS)), p);
    paint(m.globes, STYLE_HALO, colour, halo_alpha, 1, 1);
    glDrawElements(GL_TRIANGLES, m.ball_indices, GL_UNSIGNED_SHORT, nullptr);
    glFrontFace(GL_CCW);
    glDisable(GL_CULL_FACE);
    if (light.with_viewer) {
        std::vector<hairline_line> ring;
        const auto on_ring = [&](int n) {
            const double a = 2 * std::numbers::pi * n / ring_sides;
            return glm::vec3(middle + ring_part * radius * glm::dvec3(std::cos(a), std::sin(a), 0));
        };
        for (int n = 0; n < ring_sides; n++)
            ring.push_back({on_ring(n), on_ring(n + 1), glm::vec4(colour, 1)});
        hairline_draw(m.lines, s, p, ring, {});
    }
    end_blending();
}

} // namespace

bool marker_open(marker *m, std::string *trouble_out)
{
    *m = marker{};
    if (!open_program(&m->globes, "marker", {marker_shader_vertex}, false, trouble_out) ||
        !open_program(&m->patches, "freeform tool", {colour_shader_text, patch_shader_vertex}, true, trouble_out) ||
        !hairline_open(&m->lines, circles(), trouble_out)) {
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
    hairline_close(&m->lines);
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
    if (!s.box_shown || !is_drawable(glm::scale(glm::translate(p.eye_from_world, lo), hi - lo)))
        return;
    const double apart = MARKER_TICK_MM * projection_pixels_per_mm(s, 1, s.camera_distance) *
                         hairline_picture_height(s, p);
    const double ticks = std::clamp((apart - tick_pixels_least) / (tick_pixels - tick_pixels_least), 0.0, 1.0);
    box_picture b = {p.eye_from_world,
                     {lo, hi},
                     glm::dvec3(glm::inverse(p.eye_from_world) * glm::dvec4(0, 0, 0, 1)),
                     static_cast<float>(ticks),
                     {}};
    for (int axis = 0; axis < 3; axis++)
        for (int ends = 0; ends < 4; ends++)
            b.side(axis, ends & 1, ends >> 1);
    begin_blending();
    hairline_draw(m.lines, s, p, b.lines, {});
    end_blending();
}

void marker_draw_lights(const marker &m, const snapshot &s, const projection &p)
{
    if (!s.lights_shown)
        return;
    for (const snapshot_light &light : s.lights)
        if (light.lit)
            draw_light(m, s, p, light);
    glBindVertexArray(0);
}

void marker_draw_tool(const marker &m, const snapshot &s, const projection &p, const upload *patches)
{
    glm::dmat4 eye_from_tool;
    if (s.tool_style == SNAPSHOT_TOOL_HIDDEN || !marker_eye_from_tool(s, p, &eye_from_tool))
        return;
    begin_blending();
    draw_plumb(m, s, p);
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
    const tool_picture t = {s,
                            p,
                            program,
                            {&m, patches, front_of(eye_from_tool, p)},
                            eye_from_tool,
                            hairline_picture_height(s, p)};
    if (patches)
        draw_meeting(t); /* first: glass leaves its own depth */
    if (s.tool_style == SNAPSHOT_TOOL_WIREFRAME)
        draw_wire(t);
    else
        draw_glass(t);
    glBindVertexArray(0);
    end_blending();
}
