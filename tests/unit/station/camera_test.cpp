/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   a piece that is to fit fits, at every angle of the turntable, and not loosely; turning keeps the axis where it is
 *         and comes round.
 * Method: points are projected here by the snapshot's own words; boxes of several shapes, directions, lenses and aspects.
 */
#include "station/camera.h"

#include "station/angle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

/* On the screen: -1..1 across and up; what is behind the eye is far out. */
std::array<double, 2> on_screen(const snapshot &s, const motion_vector &world, double aspect)
{
    motion_vector p = motion_sum(motion_rotate(s.scene_turn, world), s.scene_shift);
    const double ahead = s.camera_distance - p[2], up = std::tan(0.5 * s.field_of_view);
    if (ahead <= 0)
        return {99, 99};
    return {p[0] / (ahead * up * aspect), p[1] / (ahead * up)};
}

/* How far out the outermost corner lies. */
double reach(const snapshot &s, const camera_boxes &boxes, double aspect)
{
    double most = 0;
    for (const camera_box &b : boxes)
        for (unsigned n = 0; n < 8; n++) {
            const auto at = on_screen(
                s, {n & 1 ? b.hi[0] : b.lo[0], n & 2 ? b.hi[1] : b.lo[1], n & 4 ? b.hi[2] : b.lo[2]}, aspect);
            most = std::max({most, std::abs(at[0]), std::abs(at[1])});
        }
    return most;
}

const std::vector<camera_boxes> PIECES = {
    {{{-10, -10, -10}, {10, 10, 10}}},
    {{{100, 20, -300}, {102, 120, -290}}},
    {{{0, 0, 0}, {200, 1, 1}}, {{0, 0, 0}, {1, 1, 80}}},
};

std::vector<snapshot> standpoints()
{
    std::vector<snapshot> all;
    for (const double degrees : {0.0, 35.0, 90.0, 200.0})
        for (const double lens : {0.2, 0.6, 1.5}) {
            snapshot s;
            s.scene_turn = motion_about({1, 2, -0.5}, degrees * ANGLE_PI / 180);
            s.scene_shift = {5, 6, 7};
            s.field_of_view = lens;
            all.push_back(s);
        }
    return all;
}

} // namespace

TEST(camera, a_piece_that_is_to_fit_fills_the_picture_but_for_the_air)
{
    for (const camera_boxes &boxes : PIECES)
        for (const double aspect : {0.3, 1.0, 2.5})
            for (snapshot s : standpoints()) {
                const auto turn = s.scene_turn;
                camera_fit(&s, boxes, aspect);
                EXPECT_NEAR(reach(s, boxes, aspect), 1 - CAMERA_AIR, 1e-9);
                EXPECT_EQ(s.scene_turn, turn);
            }
}

TEST(camera, a_turntable_holds_the_piece_at_every_angle_and_hardly_more)
{
    for (const camera_boxes &boxes : PIECES)
        for (const double aspect : {0.3, 1.0, 2.5})
            for (snapshot s : standpoints()) {
                camera_fit_turning(&s, boxes, aspect);
                double most = 0;
                for (int degrees = 0; degrees < 360; degrees++)
                    most = std::max(most, reach(camera_turned(s, camera_middle(boxes), degrees * ANGLE_PI / 180),
                                                boxes, aspect));
                EXPECT_LE(most, 1 - CAMERA_AIR + 1e-9);
                EXPECT_GT(most, 0.97 * (1 - CAMERA_AIR));
            }
}

TEST(camera, turning_leaves_the_axis_and_comes_round)
{
    for (const snapshot &s : standpoints()) {
        const motion_vector axis = {30, -7, 12}, high = {30, 90, 12}, off = {31, -7, 12};
        const auto before = on_screen(s, axis, 1), above = on_screen(s, high, 1);
        const snapshot third = camera_turned(s, axis, ANGLE_PI * 2 / 3);
        for (size_t a = 0; a < 2; a++) {
            EXPECT_NEAR(on_screen(third, axis, 1)[a], before[a], 1e-9);
            EXPECT_NEAR(on_screen(third, high, 1)[a], above[a], 1e-9 * (1 + std::abs(above[a])));
        }
        /* what points to +x points to -z after a quarter, as seen from above anticlockwise */
        const auto quarter = on_screen(camera_turned(s, axis, ANGLE_PI / 2), off, 1);
        const auto there = on_screen(s, {30, -7, 11}, 1);
        snapshot round = s;
        for (int n = 0; n < 12; n++)
            round = camera_turned(round, axis, ANGLE_PI / 6);
        for (size_t a = 0; a < 2; a++) {
            EXPECT_NEAR(quarter[a], there[a], 1e-9);
            EXPECT_NEAR(on_screen(round, off, 1)[a], on_screen(s, off, 1)[a], 1e-9);
        }
        EXPECT_EQ(third.camera_distance, s.camera_distance);
    }
}

TEST(camera, what_is_looked_at_is_in_the_middle)
{
    for (const snapshot &s : standpoints()) {
        const auto at = on_screen(s, camera_looked_at(s), 1.5);
        EXPECT_NEAR(at[0], 0, 1e-9);
        EXPECT_NEAR(at[1], 0, 1e-9);
    }
}

TEST(camera, nothing_to_look_at_leaves_it_where_it_is)
{
    snapshot s;
    s.camera_distance = 321;
    s.scene_shift = {1, 2, 3};
    camera_fit(&s, {}, 1);
    camera_fit_turning(&s, {}, 1);
    EXPECT_EQ(s.camera_distance, 321);
    EXPECT_EQ(s.scene_shift, (std::array<double, 3>{1, 2, 3}));
    EXPECT_EQ(camera_middle({}), (motion_vector{0, 0, 0}));
}
