/* SPDX-License-Identifier: Apache-2.0 */
#include "station/camera.h"

#include "station/angle.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr double NEAREST_MM = 0.1;

camera_box box_of_patch(const patch &p, double step_mm)
{
    camera_box b;
    const int32_t at[3] = {p.at.i, p.at.j, p.at.k};
    b.lo.fill(INFINITY);
    b.hi.fill(-INFINITY);
    for (uint32_t v = 0; v < p.vertex_count; v++)
        for (size_t a = 0; a < 3; a++) {
            const double mm = step_mm * (static_cast<double>(at[a] * int64_t{BRICK_EDGE}) + p.vertices[v].position[a]);
            b.lo[a] = std::min(b.lo[a], mm);
            b.hi[a] = std::max(b.hi[a], mm);
        }
    return b;
}

camera_box box_of_all(const camera_boxes &boxes)
{
    camera_box all = boxes.front();
    for (const camera_box &b : boxes)
        for (size_t a = 0; a < 3; a++) {
            all.lo[a] = std::min(all.lo[a], b.lo[a]);
            all.hi[a] = std::max(all.hi[a], b.hi[a]);
        }
    return all;
}

motion_vector corner_of(const camera_box &b, unsigned n)
{
    return {n & 1 ? b.hi[0] : b.lo[0], n & 2 ? b.hi[1] : b.lo[1], n & 4 ? b.hi[2] : b.lo[2]};
}

/* Looks at a world point. */
void look_at(snapshot *s, const motion_vector &at)
{
    const motion_vector turned = motion_rotate(s->scene_turn, at);
    for (size_t a = 0; a < 3; a++)
        s->scene_shift[a] = -turned[a];
}

/* Half the picture's sides at a distance of 1, without the air. */
struct half_sides {
    double across, up;
};

half_sides sides_of(const snapshot &s, double aspect)
{
    const double up = std::tan(0.5 * s.field_of_view) * (1 - CAMERA_AIR);
    return {up * aspect, up};
}

} // namespace

camera_boxes camera_boxes_of(const sculpture *piece)
{
    camera_boxes boxes;
    for (uint32_t slot = 0; slot < surface_slots(&piece->surface); slot++) {
        const patch *p = surface_patch(&piece->surface, slot);
        if (p && p->vertex_count > 0)
            boxes.push_back(box_of_patch(*p, piece->step_mm));
    }
    return boxes;
}

motion_vector camera_middle(const camera_boxes &boxes)
{
    if (boxes.empty())
        return {};
    const camera_box all = box_of_all(boxes);
    return {0.5 * (all.lo[0] + all.hi[0]), 0.5 * (all.lo[1] + all.hi[1]), 0.5 * (all.lo[2] + all.hi[2])};
}

void camera_fit(snapshot *s, const camera_boxes &boxes, double aspect)
{
    if (boxes.empty())
        return;
    const motion_vector middle = camera_middle(boxes);
    const half_sides half = sides_of(*s, aspect);
    double distance = NEAREST_MM;
    for (const camera_box &b : boxes)
        for (unsigned n = 0; n < 8; n++) {
            const motion_vector p = motion_rotate(s->scene_turn, motion_sum(corner_of(b, n), middle, -1));
            distance = std::max(distance, p[2] + std::max(std::abs(p[0]) / half.across, std::abs(p[1]) / half.up));
        }
    look_at(s, middle);
    s->camera_distance = distance;
}

void camera_fit_turning(snapshot *s, const camera_boxes &boxes, double aspect)
{
    if (boxes.empty())
        return;
    /* What a corner of a box draws is a ring; a polygon round the ring holds it. */
    constexpr int places = 48;
    const motion_vector middle = camera_middle(boxes);
    camera_boxes rings;
    for (const camera_box &b : boxes) {
        double radius = 0;
        for (unsigned n = 0; n < 8; n++) {
            const motion_vector p = motion_sum(corner_of(b, n), middle, -1);
            radius = std::max(radius, std::sqrt(p[0] * p[0] + p[2] * p[2]));
        }
        rings.push_back({{radius, b.lo[1], 0}, {radius, b.hi[1], 0}});
    }
    const double outside = 1 / std::cos(ANGLE_PI / places);
    const half_sides half = sides_of(*s, aspect);
    double distance = NEAREST_MM;
    for (int n = 0; n < places; n++) {
        const double angle = 2 * ANGLE_PI * n / places;
        const double x = outside * std::cos(angle), z = outside * std::sin(angle);
        for (const camera_box &b : rings)
            for (const double y : {b.lo[1] - middle[1], b.hi[1] - middle[1]}) {
                const motion_vector p = motion_rotate(s->scene_turn, {x * b.lo[0], y, z * b.lo[0]});
                distance =
                    std::max(distance, p[2] + std::max(std::abs(p[0]) / half.across, std::abs(p[1]) / half.up));
            }
    }
    look_at(s, middle);
    s->camera_distance = distance;
}

motion_vector camera_looked_at(const snapshot &s)
{
    return motion_rotate_back(s.scene_turn, {-s.scene_shift[0], -s.scene_shift[1], -s.scene_shift[2]});
}

snapshot camera_turned(snapshot s, const motion_vector &at, double radians)
{
    /* turn' * w + shift' = turn * (at + about(w - at)) + shift, for every world point w */
    const motion_quaternion about = motion_about({0, 1, 0}, radians);
    const motion_vector still = motion_sum(at, motion_rotate(about, at), -1);
    s.scene_shift = motion_sum(s.scene_shift, motion_rotate(s.scene_turn, still));
    s.scene_turn = motion_product(s.scene_turn, about);
    return s;
}
