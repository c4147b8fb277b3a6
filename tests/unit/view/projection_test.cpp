/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the matrices put points where the snapshot says, and near and far just hold what is drawn.
 * Method: single points against trigonometry, seeded balls against the planes. No context. */
#include "view/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

glm::dvec3 on_screen(const projection &p, const glm::dvec3 &world)
{
    const glm::dvec4 clip = p.clip_from_eye * (p.eye_from_world * glm::dvec4(world, 1));
    return glm::dvec3(clip) / clip.w;
}

TEST(projection, puts_points_where_trigonometry_does)
{
    snapshot s;
    s.camera_distance = 100;
    s.field_of_view = 0.8;
    const projection p = projection_make(s, 200, 100, {});
    EXPECT_NEAR(on_screen(p, {0, 0, 0}).x, 0, 1e-12);
    EXPECT_NEAR(on_screen(p, {0, 100 * std::tan(0.4), 0}).y, 1, 1e-12);
    EXPECT_NEAR(on_screen(p, {200 * std::tan(0.4), 0, 0}).x, 1, 1e-12) << "twice as wide as high";
    EXPECT_NEAR(on_screen(p, {0, 50 * std::tan(0.4), 50}).y, 1, 1e-12) << "half as far, half as much";
    EXPECT_NEAR(projection_pixels_per_mm(s, 100, 100) * 100 * std::tan(0.4), 50, 1e-9);
}

TEST(projection, turns_before_it_shifts)
{
    snapshot s;
    s.camera_distance = 100;
    s.scene_turn = {std::sqrt(0.5), 0, std::sqrt(0.5), 0}; /* a quarter about y: z goes to x */
    s.scene_shift = {1, 2, 3};
    const glm::dvec4 eye = projection_eye_from_world(s) * glm::dvec4(0, 0, 10, 1);
    EXPECT_NEAR(eye.x, 11, 1e-12);
    EXPECT_NEAR(eye.y, 2, 1e-12);
    EXPECT_NEAR(eye.z, 3 - 100, 1e-12);
}

TEST(projection, near_and_far_just_hold_the_balls)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-80, 80), size(0.1, 30);
    for (int round = 0; round < 500; round++) {
        snapshot s;
        s.camera_distance = 200;
        std::vector<projection_ball> balls;
        double nearest = 200, farthest = 200;
        for (int n = 0; n < 4; n++) {
            balls.push_back({{place(random), place(random), -200 + place(random)}, size(random)});
            nearest = std::min(nearest, -balls.back().middle_eye.z - balls.back().radius);
            farthest = std::max(farthest, -balls.back().middle_eye.z + balls.back().radius);
        }
        const projection p = projection_make(s, 100, 100, balls);
        ASSERT_LE(p.near_mm, nearest);
        ASSERT_GE(p.near_mm, nearest * 0.95);
        ASSERT_GE(p.far_mm, farthest);
        ASSERT_LE(p.far_mm, farthest * 1.05);
    }
}

TEST(projection, balls_at_infinity_are_not_held)
{
    const projection_ball good = {{0, 0, -150}, 10};
    const projection_ball endless[] = {{{0, 0, -INFINITY}, 1}, {{0, 0, NAN}, 1}, {{}, INFINITY}};
    const projection with = projection_make({}, 100, 100, {good, endless[0], endless[1], endless[2]});
    const projection without = projection_make({}, 100, 100, {good});
    EXPECT_EQ(with.near_mm, without.near_mm);
    EXPECT_EQ(with.far_mm, without.far_mm);
}

TEST(projection, near_stays_in_front_of_an_eye_inside_the_clay)
{
    snapshot s;
    s.camera_distance = 10;
    const projection p = projection_make(s, 100, 100, {{{0, 0, -10}, 500}});
    EXPECT_DOUBLE_EQ(p.near_mm, PROJECTION_NEAR_MIN * 10);
    EXPECT_GE(p.far_mm, 510);
}

TEST(projection, a_box_lies_in_its_ball)
{
    snapshot s;
    s.scene_turn = {0.5, 0.5, 0.5, 0.5};
    s.scene_shift = {3, 4, 5};
    const glm::dmat4 eye = projection_eye_from_world(s);
    const glm::dvec3 lo(-1, 2, 3), hi(7, 4, 11);
    const projection_ball ball = projection_ball_of_box(eye, lo, hi);
    for (int c = 0; c < 8; c++) {
        const glm::dvec4 corner(c & 1 ? hi.x : lo.x, c & 2 ? hi.y : lo.y, c & 4 ? hi.z : lo.z, 1);
        EXPECT_NEAR(glm::length(glm::dvec3(eye * corner) - ball.middle_eye), ball.radius, 1e-9);
    }
}

TEST(projection, frames_map_axes_to_columns)
{
    frame f = {{1, 2, 3}, {{4, 5, 6}, {7, 8, 9}, {1, 0, 2}}};
    const glm::dvec4 at = projection_of_frame(f) * glm::dvec4(2, 3, 4, 1);
    EXPECT_DOUBLE_EQ(at.x, 1 + 2 * 4 + 3 * 7 + 4 * 1);
    EXPECT_DOUBLE_EQ(at.y, 2 + 2 * 5 + 3 * 8 + 4 * 0);
    EXPECT_DOUBLE_EQ(at.z, 3 + 2 * 6 + 3 * 9 + 4 * 2);
}

TEST(projection, a_good_snapshot_has_no_trouble)
{
    EXPECT_EQ(projection_trouble(snapshot{}), "");
    snapshot s;
    s.scene_turn = {2, 0, 0, 0};
    EXPECT_NE(projection_trouble(s).find("scene_turn"), std::string::npos);
}

} // namespace
