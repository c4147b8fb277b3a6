/* SPDX-License-Identifier: Apache-2.0 */
#include "view/projection.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace {

constexpr double room = 1.02; /* a little air before and behind what is held */

bool all_finite(const double *values, size_t n)
{
    return std::all_of(values, values + n, [](double x) { return std::isfinite(x); });
}

glm::dquat turn_of(const snapshot &s)
{
    return glm::dquat(s.scene_turn[0], s.scene_turn[1], s.scene_turn[2], s.scene_turn[3]);
}

} // namespace

std::string projection_trouble(const snapshot &s)
{
    if (!all_finite(s.scene_turn.data(), 4) || std::abs(glm::length(turn_of(s)) - 1) > 1e-3)
        return "snapshot: scene_turn is not a unit quaternion";
    if (!all_finite(s.scene_shift.data(), 3))
        return "snapshot: scene_shift is not finite";
    if (!std::isfinite(s.camera_distance) || s.camera_distance <= 0)
        return "snapshot: camera_distance must be more than 0 mm";
    if (!(s.field_of_view >= PROJECTION_FIELD_OF_VIEW_MIN && s.field_of_view <= PROJECTION_FIELD_OF_VIEW_MAX))
        return "snapshot: field_of_view must be " + std::to_string(PROJECTION_FIELD_OF_VIEW_MIN) + " to " +
               std::to_string(PROJECTION_FIELD_OF_VIEW_MAX) + " radians";
    if (!std::isfinite(s.step_mm) || s.step_mm <= 0)
        return "snapshot: step_mm must be more than 0";
    return "";
}

glm::dmat4 projection_eye_from_world(const snapshot &s)
{
    const glm::dvec3 shift(s.scene_shift[0], s.scene_shift[1], s.scene_shift[2] - s.camera_distance);
    return glm::translate(glm::dmat4(1), shift) * glm::mat4_cast(glm::normalize(turn_of(s)));
}

glm::dmat4 projection_of_frame(const frame &f)
{
    glm::dmat4 m(1);
    for (int a = 0; a < 3; a++)
        m[a] = glm::dvec4(f.axis[a][0], f.axis[a][1], f.axis[a][2], 0);
    m[3] = glm::dvec4(f.origin[0], f.origin[1], f.origin[2], 1);
    return m;
}

projection_ball projection_ball_of_box(const glm::dmat4 &eye_from_world, const glm::dvec3 &lo, const glm::dvec3 &hi)
{
    return {glm::dvec3(eye_from_world * glm::dvec4(0.5 * (lo + hi), 1)), 0.5 * glm::length(hi - lo)};
}

projection projection_make(const snapshot &s, int width, int height, const std::vector<projection_ball> &held)
{
    assert(width > 0 && height > 0);
    double nearest = s.camera_distance, farthest = s.camera_distance;
    for (const projection_ball &b : held) {
        if (!std::isfinite(b.middle_eye.z) || !std::isfinite(b.radius))
            continue;
        nearest = std::min(nearest, -b.middle_eye.z - b.radius);
        farthest = std::max(farthest, -b.middle_eye.z + b.radius);
    }
    projection p;
    p.eye_from_world = projection_eye_from_world(s);
    p.near_mm = std::max(nearest / room, PROJECTION_NEAR_MIN * s.camera_distance);
    p.far_mm = std::max(farthest, p.near_mm) * room;
    p.clip_from_eye =
        glm::perspectiveRH_NO(s.field_of_view, static_cast<double>(width) / height, p.near_mm, p.far_mm);
    return p;
}

projection projection_of_part(projection p, int width, int height, const projection_part &part)
{
    const double across = static_cast<double>(width) / part.width, down = static_cast<double>(height) / part.height;
    glm::dmat4 enlarged(1);
    enlarged[0][0] = across;
    enlarged[1][1] = down;
    enlarged[3][0] = across - 1 - 2.0 * part.x / part.width;
    enlarged[3][1] = 1 - down + 2.0 * part.y / part.height;
    p.clip_from_eye = enlarged * p.clip_from_eye;
    return p;
}

projection projection_mirrored(projection p)
{
    for (int column = 0; column < 4; column++)
        p.clip_from_eye[column][0] = -p.clip_from_eye[column][0];
    return p;
}

bool projection_is_mirrored(const projection &p) { return p.clip_from_eye[0][0] < 0; }

double projection_pixels_per_mm(const snapshot &s, int height, double ahead)
{
    return 0.5 * height / (std::tan(0.5 * s.field_of_view) * ahead);
}
