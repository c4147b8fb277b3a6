/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: poses move as geometry says; the puck's filter gives rest at rest and is symmetric. */
#include "station/motion.h"

#include "station/angle.h"

#include <cmath>
#include <gtest/gtest.h>

namespace {

void near(const motion_vector &a, const motion_vector &b, double bound = 1e-12)
{
    for (size_t n = 0; n < 3; n++)
        EXPECT_NEAR(a[n], b[n], bound) << n;
}

} // namespace

TEST(motion, a_quarter_turn_about_z_takes_x_to_y)
{
    motion_quaternion q = motion_about({0, 0, 5}, ANGLE_PI / 2);
    near(motion_rotate(q, {1, 0, 0}), {0, 1, 0});
    near(motion_rotate_back(q, motion_rotate(q, {1, 2, 3})), {1, 2, 3});
    near(motion_rotate(motion_product(q, motion_about({1, 0, 0}, ANGLE_PI / 2)), {0, 1, 0}), {0, 0, 1});
}

TEST(motion, many_small_turns_make_the_whole_one)
{
    motion_quaternion q{1, 0, 0, 0};
    for (int n = 0; n < 1000; n++)
        q = motion_turned(q, {0, ANGLE_PI / 2 / 1000, 0});
    near(motion_rotate(q, {0, 0, 1}), {1, 0, 0}, 1e-5);
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-14);
}

TEST(motion, between_takes_the_shorter_way)
{
    motion_pose a{{0, 0, 0}, {1, 0, 0, 0}}, b{{2, 4, 6}, motion_about({0, 0, 1}, 1)};
    for (double &c : b.turn)
        c = -c;
    motion_pose half = motion_between(a, b, 0.5);
    near(half.place, {1, 2, 3});
    near(motion_rotate(half.turn, {1, 0, 0}), {std::cos(0.5), std::sin(0.5), 0});
}

TEST(motion, turn_distance_is_the_arc_for_small_turns)
{
    EXPECT_NEAR(motion_turn_distance({1, 0, 0, 0}, motion_about({0, 1, 0}, 0.01), 50), 0.5, 1e-5);
    EXPECT_EQ(motion_turn_distance({1, 0, 0, 0}, {-1, 0, 0, 0}, 50), 0);
}

TEST(motion, filter_rests_below_the_dead_zone_and_is_symmetric)
{
    motion_filter f{0.1, 0.5};
    motion_speed rest = motion_filtered(f, {20, -20, 10, 34, 0, 0});
    near(rest.shift, {0, 0, 0}, 0);
    near(rest.turn, {0, 0, 0}, 0);
    for (int16_t counts : {40, 100, 350}) {
        motion_speed plus = motion_filtered(f, {counts, 0, 0, 0, 0, 0});
        motion_speed minus = motion_filtered(f, {static_cast<int16_t>(-counts), 0, 0, 0, 0, 0});
        EXPECT_GT(plus.shift[0], 0);
        EXPECT_EQ(plus.shift[0], -minus.shift[0]);
    }
    EXPECT_LT(motion_filtered(f, {36, 0, 0, 0, 0, 0}).shift[0], 0.01); /* starts again from zero */
    EXPECT_EQ(motion_filtered(f, {350, 0, 0, 0, 0, 0}).shift[0], 1);
    EXPECT_EQ(motion_filtered(f, {700, 0, 0, 0, 0, 0}).shift[0], 1); /* beyond full is full */
}

TEST(motion, hid_frame_becomes_the_views)
{
    motion_filter f{0, 0};
    near(motion_filtered(f, {0, 350, 0, 0, 0, 0}).shift, {0, 0, 1});  /* towards the user */
    near(motion_filtered(f, {0, 0, 350, 0, 0, 0}).shift, {0, -1, 0}); /* down */
    near(motion_filtered(f, {0, 0, 0, 0, 0, 350}).turn, {0, -1, 0});  /* about the downward axis */
}
