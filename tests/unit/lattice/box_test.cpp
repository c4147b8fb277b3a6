/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a box holds what lies between its ends, both included; counting it neither overflows nor lies; its bricks are
 *       those of its corners.
 * Method: small boxes against enumeration, the largest by arithmetic. */
#include "lattice/box.h"

#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace {

box random_box(seeded &chance, int reach)
{
    const key a = seeded_key(chance, -reach, reach), b = seeded_key(chance, -reach, reach);
    return box_include(box_include(box_empty(), a), b);
}

TEST(box_empty, holds_nothing)
{
    const box b = box_empty();
    EXPECT_TRUE(box_is_empty(b));
    EXPECT_EQ(box_count(b), 0);
    EXPECT_FALSE(box_contains(b, {0, 0, 0}));
    EXPECT_FALSE(box_contains(b, {INT32_MAX, INT32_MAX, INT32_MAX}));
    EXPECT_TRUE(box_is_empty(box_of_bricks(b)));
}

TEST(box_empty, one_bad_axis_is_enough)
{
    EXPECT_TRUE(box_is_empty({{1, 0, 0}, {0, 5, 5}}));
    EXPECT_TRUE(box_is_empty({{0, 1, 0}, {5, 0, 5}}));
    EXPECT_TRUE(box_is_empty({{0, 0, 1}, {5, 5, 0}}));
    EXPECT_FALSE(box_is_empty({{0, 0, 0}, {0, 0, 0}}));
    EXPECT_EQ(box_count({{5, 0, 0}, {4, 9, 9}}), 0);
    /* Its ends lie in one brick, which it does not hold all the same. */
    EXPECT_TRUE(box_is_empty(box_of_bricks({{5, 0, 0}, {4, 9, 9}})));
}

TEST(box_include, grows_no_more_than_needed)
{
    seeded chance = {2};
    for (int n = 0; n < 1000; n++) {
        const key a = seeded_key(chance, -50, 50), b = seeded_key(chance, -50, 50), c = seeded_key(chance, -50, 50);
        const box all = box_include(box_include(box_include(box_empty(), a), b), c);
        for (const key &p : {a, b, c})
            ASSERT_TRUE(box_contains(all, p));
        ASSERT_EQ(all.min.i, std::min({a.i, b.i, c.i}));
        ASSERT_EQ(all.min.j, std::min({a.j, b.j, c.j}));
        ASSERT_EQ(all.min.k, std::min({a.k, b.k, c.k}));
        ASSERT_EQ(all.max.i, std::max({a.i, b.i, c.i}));
        ASSERT_EQ(all.max.j, std::max({a.j, b.j, c.j}));
        ASSERT_EQ(all.max.k, std::max({a.k, b.k, c.k}));
    }
}

TEST(box_count, is_what_enumeration_finds)
{
    seeded chance = {3};
    for (int n = 0; n < 200; n++) {
        const box b = random_box(chance, 9);
        int inside = 0;
        std::set<std::tuple<int, int, int>> bricks;
        for (int i = -12; i <= 12; i++)
            for (int j = -12; j <= 12; j++)
                for (int k = -12; k <= 12; k++)
                    if (box_contains(b, {i, j, k})) {
                        inside++;
                        const key at = key_brick({i, j, k});
                        bricks.insert({at.i, at.j, at.k});
                    }
        ASSERT_EQ(box_count(b), inside);
        ASSERT_EQ(box_count(box_of_bricks(b)), static_cast<double>(bricks.size()));
        for (const auto &[i, j, k] : bricks)
            ASSERT_TRUE(box_contains(box_of_bricks(b), {i, j, k}));
    }
}

TEST(box_count, of_the_whole_lattice_does_not_overflow)
{
    const box all = {{INT32_MIN, INT32_MIN, INT32_MIN}, {INT32_MAX, INT32_MAX, INT32_MAX}};
    EXPECT_EQ(box_count(all), std::ldexp(1.0, 96));
    const box line = {{INT32_MIN, 0, 0}, {INT32_MAX, 0, 0}};
    EXPECT_EQ(box_count(line), std::ldexp(1.0, 32));
}

} // namespace
