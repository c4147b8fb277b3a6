/* SPDX-License-Identifier: Apache-2.0 */
#include "view/sight.h"

#include "view/marker.h"
#include "view/plumb.h"
#include "view/wheel.h"

#include <cmath>

namespace {

constexpr double brick_steps = BRICK_EDGE;

void hold_tool(const upload &tool_patches, const snapshot &s, const glm::dmat4 &eye_from_world,
               std::vector<projection_ball> *held)
{
    glm::dvec3 reach(1);
    glm::dvec3 off(0);
    if (s.tool_surface) {
        const box b = tool_patches.bricks;
        if (box_is_empty(b))
            return;
        const glm::dvec3 lo = brick_steps * glm::dvec3(b.min.i, b.min.j, b.min.k);
        const glm::dvec3 hi = brick_steps * (glm::dvec3(b.max.i, b.max.j, b.max.k) + 1.0);
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

} // namespace

projection_ball sight_of_bricks(const snapshot &s, const box &b, const glm::dmat4 &eye_from_world)
{
    if (box_is_empty(b))
        return {};
    const double brick_mm = s.step_mm * brick_steps;
    return projection_ball_of_box(eye_from_world, brick_mm * glm::dvec3(b.min.i, b.min.j, b.min.k),
                                  brick_mm * (glm::dvec3(b.max.i, b.max.j, b.max.k) + 1.0));
}

projection sight_of(const snapshot &s, const upload &patches, const upload &tool_patches, const box &cubes_bricks,
                    int width, int height)
{
    const glm::dmat4 eye_from_world = projection_eye_from_world(s);
    std::vector<projection_ball> held;
    for (const box &b : {patches.bricks, cubes_bricks})
        if (!box_is_empty(b))
            held.push_back(sight_of_bricks(s, b, eye_from_world));
    if (s.tool_style != SNAPSHOT_TOOL_HIDDEN)
        hold_tool(tool_patches, s, eye_from_world, &held);
    if (s.box_shown)
        held.push_back(projection_ball_of_box(eye_from_world, glm::dvec3(s.box_lo[0], s.box_lo[1], s.box_lo[2]),
                                              glm::dvec3(s.box_hi[0], s.box_hi[1], s.box_hi[2])));
    if (plumb l; plumb_of(s, &l))
        held.push_back(plumb_ball(l, eye_from_world));
    if (wheel_is_wanted(s))
        held.push_back(wheel_ball(s, eye_from_world));
    for (const snapshot_light &light : s.lights) {
        const glm::dvec4 at(light.position[0], light.position[1], light.position[2], 1);
        if (light.lit && s.lights_shown)
            held.push_back({glm::dvec3(light.with_viewer ? at : eye_from_world * at),
                            MARKER_LIGHT_REACH * s.camera_distance});
    }
    return projection_make(s, width, height, held);
}
