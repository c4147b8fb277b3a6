/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the walk covers the box it promises, refuses what it must, and is clipped where the lattice ends.
 * Method: axis-parallel frames counted by hand, ends of the lattice, each refusal. Random frames are in
 *         tests/property/walk_test.cpp, the paper's table in paper_table_test.cpp. */
#include "tool/walk.h"

#include "clay/capacity.h"
#include "tool/ellipsoid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

const ellipsoid ball = {ELLIPSOID_WYVILL, 0.1f};

frame upright(double x, double y, double z, double a, double b, double c)
{
    return {{x, y, z}, {{a, 0, 0}, {0, b, 0}, {0, 0, c}}};
}

walk begin(const frame &f)
{
    const shape s = ellipsoid_shape(&ball);
    walk w;
    EXPECT_EQ(walk_begin(&w, &f, &s), STATUS_OK);
    return w;
}

status try_begin(const frame &f)
{
    const shape s = ellipsoid_shape(&ball);
    walk w;
    return walk_begin(&w, &f, &s);
}

TEST(walk_box, runs_from_floor_to_floor)
{
    const walk w = begin(upright(0.25, -3, 10.9, 2.96, 1, 0.05));
    EXPECT_TRUE(key_equal(w.corners.min, {-3, -4, 10}));
    EXPECT_TRUE(key_equal(w.corners.max, {3, -2, 10}));
    EXPECT_EQ(w.visited, 7 * 3 * 1);
    EXPECT_TRUE(key_equal(w.bricks.min, {-1, -1, 1}));
    EXPECT_TRUE(key_equal(w.bricks.max, {0, -1, 1}));
}

TEST(walk_box, is_that_of_the_oriented_box)
{
    const double h = std::sqrt(0.5);
    const frame f = {{0, 0, 0}, {{10 * h, 10 * h, 0}, {-2 * h, 2 * h, 0}, {0, 0, 1}}};
    const walk w = begin(f);
    EXPECT_TRUE(key_equal(w.corners.min, {-9, -9, -1})); /* 12 h = 8.485 */
    EXPECT_TRUE(key_equal(w.corners.max, {8, 8, 1}));
}

TEST(walk_box, follows_a_support_that_is_not_centred)
{
    shape s = ellipsoid_shape(&ball);
    const double lo[3] = {-1, 0, 2}, hi[3] = {3, 1, 2.5};
    for (int a = 0; a < 3; a++) {
        s.lo[a] = lo[a];
        s.hi[a] = hi[a];
    }
    walk w;
    const frame f = upright(100, 200, -300, 2, 4, -8); /* mirrored: lo and hi change places in key space */
    ASSERT_EQ(walk_begin(&w, &f, &s), STATUS_OK);
    EXPECT_TRUE(key_equal(w.corners.min, {98, 200, -320}));
    EXPECT_TRUE(key_equal(w.corners.max, {106, 204, -316}));
}

TEST(walk_inside, is_strict_and_stays_in_the_range)
{
    const walk w = begin(upright(0, 0, 0, 4, 4, 4));
    int inside = 0;
    key b;
    for (b.i = -1; b.i <= 0; b.i++)
        for (b.j = -1; b.j <= 0; b.j++)
            for (b.k = -1; b.k <= 0; b.k++) {
                float start[3], x[8], y[8], z[8];
                walk_start(&w, b, start);
                for (int row = 0; row < 64; row++) {
                    walk_row(&w, start, row >> 3, row & 7, x, y, z);
                    const unsigned mask = walk_inside(&w, b, row >> 3, row & 7, x, y, z);
                    for (int n = 0; n < 8; n++) {
                        const key at = key_add(key_of_brick(b), row >> 3, row & 7, n);
                        const bool wanted = std::abs(at.i) < 4 && std::abs(at.j) < 4 && std::abs(at.k) < 4;
                        ASSERT_EQ(mask >> n & 1, wanted) << at.i << " " << at.j << " " << at.k;
                        ASSERT_EQ(x[n], static_cast<float>(at.i) / 4);
                        ASSERT_EQ(y[n], static_cast<float>(at.j) / 4);
                        ASSERT_EQ(z[n], static_cast<float>(at.k) / 4);
                        inside += wanted;
                    }
                }
            }
    EXPECT_EQ(inside, 343);
}

TEST(walk_touches, rejects_bricks_the_tool_cannot_reach)
{
    const double h = std::sqrt(0.5);
    const frame needle = {{0, 0, 0}, {{80 * h, 80 * h, 0}, {-1 * h, 1 * h, 0}, {0, 0, 1}}};
    const walk w = begin(needle);
    EXPECT_TRUE(walk_touches(&w, {0, 0, 0}));
    EXPECT_TRUE(walk_touches(&w, {5, 5, 0}));
    EXPECT_FALSE(walk_touches(&w, {5, -5, 0})) << "in the grid's box, far from the needle";
    int touched = 0, all = 0;
    key b;
    for (b.i = w.bricks.min.i; b.i <= w.bricks.max.i; b.i++)
        for (b.j = w.bricks.min.j; b.j <= w.bricks.max.j; b.j++)
            for (b.k = w.bricks.min.k; b.k <= w.bricks.max.k; b.k++, all++)
                touched += walk_touches(&w, b);
    EXPECT_LT(touched, all / 3) << "rejecting must be worth it";
}

TEST(walk_begin, is_clipped_where_the_lattice_ends)
{
    const walk w = begin(upright(KEY_MAX, KEY_MIN, 0, 20, 20, 2));
    EXPECT_TRUE(key_equal(w.corners.min, {KEY_MAX - 20, KEY_MIN, -2}));
    EXPECT_TRUE(key_equal(w.corners.max, {KEY_MAX, KEY_MIN + 20, 2}));
    EXPECT_EQ(w.visited, 21.0 * 21 * 5);
    const walk beside = begin(upright(KEY_MAX + 19.5, 0, 0, 20, 2, 2));
    EXPECT_EQ(beside.corners.max.i, KEY_MAX);
    EXPECT_EQ(beside.corners.min.i, KEY_MAX - 1);
}

TEST(walk_begin, refuses_what_lies_beyond_the_lattice)
{
    EXPECT_EQ(try_begin(upright(KEY_MAX + 30.0, 0, 0, 20, 2, 2)), STATUS_OUT_OF_RANGE);
    EXPECT_EQ(try_begin(upright(0, KEY_MIN - 30.0, 0, 2, 20, 2)), STATUS_OUT_OF_RANGE);
    EXPECT_EQ(try_begin(upright(0, 0, 1e300, 2, 2, 2)), STATUS_OUT_OF_RANGE);
    EXPECT_EQ(try_begin(upright(0, -1e300, 0, 2, 2, 2)), STATUS_OUT_OF_RANGE);
    EXPECT_EQ(try_begin(upright(KEY_MAX + 3.0, 0, 0, 2, 2, 2)), STATUS_OUT_OF_RANGE);
    EXPECT_EQ(try_begin(upright(KEY_MAX + 2.0, 0, 0, 2, 2, 2)), STATUS_OK);
}

TEST(walk_begin, refuses_what_is_too_large)
{
    const double edge = std::cbrt(CAPACITY_DAB_BRICKS) * 8; /* keys along each side */
    EXPECT_EQ(try_begin(upright(0, 0, 0, edge / 2 * 0.95, edge / 2 * 0.95, edge / 2 * 0.95)), STATUS_OK);
    EXPECT_EQ(try_begin(upright(0, 0, 0, edge / 2 * 1.05, edge / 2 * 1.05, edge / 2 * 1.05)), STATUS_TOO_LARGE);
    EXPECT_EQ(try_begin(upright(0, 0, 0, 1e6, 1e6, 1e6)), STATUS_TOO_LARGE);
    EXPECT_EQ(try_begin(upright(0, 0, 0, 1e6, 1, 1)), STATUS_TOO_LARGE);
}

TEST(walk_begin, refuses_a_bad_frame_before_anything_else)
{
    EXPECT_EQ(try_begin(upright(0, 0, 0, 1, 1, 0)), STATUS_BAD_POSE);
    EXPECT_EQ(try_begin(upright(std::nan(""), 0, 0, 1, 1, 1)), STATUS_BAD_POSE);
}

TEST(walk_begin, refuses_an_endless_shape)
{
    shape s = ellipsoid_shape(&ball);
    s.hi[1] = std::numeric_limits<double>::infinity();
    const frame f = upright(0, 0, 0, 2, 2, 2);
    walk w;
    EXPECT_NE(walk_begin(&w, &f, &s), STATUS_OK);
    s.lo[1] = -s.hi[1];
    EXPECT_NE(walk_begin(&w, &f, &s), STATUS_OK);
}

} // namespace
