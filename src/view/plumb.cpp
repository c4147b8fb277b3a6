/* SPDX-License-Identifier: Apache-2.0 */
#include "view/plumb.h"

#include "view/wheel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

constexpr int outline_sides = 64;
constexpr int bands_max = 200; /* of a tool far above the floor; those above are one */
constexpr float light_band = 0.85f, faint_band = 0.28f, outline_alpha = 0.7f, cross_alpha = 0.8f;

/* The ellipse that the ball under a 2 x 3 map is, as two half diameters that belong together: the map times its
   transpose, split into a triangle and its transpose. */
void outline_of(const glm::dmat3 &axes, glm::dvec3 reach[2])
{
    double xx = 0, xz = 0, zz = 0;
    for (int a = 0; a < 3; a++) {
        xx += axes[a].x * axes[a].x;
        xz += axes[a].x * axes[a].z;
        zz += axes[a].z * axes[a].z;
    }
    const double x = std::sqrt(xx), z = x > 0 ? xz / x : 0;
    reach[0] = glm::dvec3(x, 0, z);
    reach[1] = glm::dvec3(0, 0, std::sqrt(std::max(zz - z * z, 0.0)));
}

/* Of the cubes that a freeform's surface passes through, about its origin; what an ellipsoid is in its own space. */
bool extent_of(const snapshot &s, glm::dvec3 *half_out, glm::dvec3 *middle_out)
{
    *half_out = glm::dvec3(1);
    *middle_out = glm::dvec3(0);
    if (!s.tool_surface)
        return true;
    box held = box_empty();
    for (uint32_t slot = 0; slot < surface_slots(s.tool_surface); slot++) {
        const patch *p = surface_patch(s.tool_surface, slot);
        for (int i = 0; p && i < BRICK_EDGE; i++) {
            uint64_t across = p->crossing.slab[i];
            if (across == 0)
                continue;
            const int j_lo = __builtin_ctzll(across) / BRICK_EDGE, j_hi = (63 - __builtin_clzll(across)) / BRICK_EDGE;
            for (int fold = 32; fold >= BRICK_EDGE; fold /= 2)
                across |= across >> fold;
            const int k_lo = __builtin_ctzll(across), k_hi = 31 - __builtin_clz(across & 0xff);
            const key from = key_of_brick(p->at);
            held = box_include(box_include(held, key_add(from, i, j_lo, k_lo)), key_add(from, i, j_hi, k_hi));
        }
    }
    if (box_is_empty(held))
        return false;
    const glm::dvec3 lo(held.min.i, held.min.j, held.min.k), hi(held.max.i + 1.0, held.max.j + 1.0, held.max.k + 1.0);
    *half_out = 0.5 * (hi - lo);
    *middle_out = 0.5 * (hi + lo) - glm::dvec3(s.tool_middle[0], s.tool_middle[1], s.tool_middle[2]);
    return true;
}

bool is_finite(const glm::dvec3 &v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

} // namespace

bool plumb_of(const snapshot &s, plumb *out)
{
    glm::dvec3 half, middle_tool;
    if (s.tool_style == SNAPSHOT_TOOL_HIDDEN || !(s.box_shown || wheel_is_wanted(s)) ||
        !extent_of(s, &half, &middle_tool))
        return false;
    const glm::dmat4 world_from_tool = projection_of_frame(s.tool_world);
    glm::dmat3 axes(world_from_tool);
    for (int a = 0; a < 3; a++)
        axes[a] *= half[a];
    out->from = glm::dvec3(world_from_tool * glm::dvec4(middle_tool, 1));
    out->foot = glm::dvec3(out->from.x, s.box_lo[1], out->from.z);
    outline_of(axes, out->reach);
    return is_finite(out->from) && is_finite(out->foot) && is_finite(out->reach[0]) && is_finite(out->reach[1]) &&
           out->from.y > out->foot.y;
}

projection_ball plumb_ball(const plumb &l, const glm::dmat4 &eye_from_world)
{
    const double reach = glm::length(l.reach[0]) + glm::length(l.reach[1]) + PLUMB_BAND_MM;
    return {glm::dvec3(eye_from_world * glm::dvec4(0.5 * (l.from + l.foot), 1)),
            0.5 * glm::length(l.from - l.foot) + reach};
}

std::vector<hairline_line> plumb_lines(const plumb &l, const glm::dmat4 &eye_from_world, const glm::vec3 &colour)
{
    std::vector<hairline_line> lines;
    const auto add = [&](const glm::dvec3 &from, const glm::dvec3 &into, float alpha) {
        lines.push_back({glm::vec3(eye_from_world * glm::dvec4(from, 1)),
                         glm::vec3(eye_from_world * glm::dvec4(into, 1)), glm::vec4(colour, alpha)});
    };
    const double high = l.from.y - l.foot.y;
    const int bands = static_cast<int>(std::min(std::ceil(high / PLUMB_BAND_MM), double{bands_max}));
    for (int n = 0; n < bands; n++) {
        const double top = n + 1 == bands ? high : PLUMB_BAND_MM * (n + 1);
        add(l.foot + glm::dvec3(0, PLUMB_BAND_MM * n, 0), l.foot + glm::dvec3(0, top, 0),
            n % 2 == 0 ? light_band : faint_band);
    }
    for (int n = 0; n < outline_sides; n++) {
        const double a = 2 * std::numbers::pi * n / outline_sides, b = 2 * std::numbers::pi * (n + 1) / outline_sides;
        add(l.foot + std::cos(a) * l.reach[0] + std::sin(a) * l.reach[1],
            l.foot + std::cos(b) * l.reach[0] + std::sin(b) * l.reach[1], outline_alpha);
    }
    const glm::dvec3 x(PLUMB_BAND_MM, 0, 0), z(0, 0, PLUMB_BAND_MM);
    add(l.foot - x, l.foot + x, cross_alpha);
    add(l.foot - z, l.foot + z, cross_alpha);
    return lines;
}
