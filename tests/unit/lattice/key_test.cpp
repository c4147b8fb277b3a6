/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: keys are ordered like tuples, and bricks and slots are floor division by eight and its remainder, on both
 *       sides of zero and at the ends of the range.
 * Method: every pair of a set of awkward numbers, and random keys, against std::tuple and std::floor. */
#include "lattice/key.h"

#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

namespace {

const std::vector<int32_t> awkward = {INT32_MIN, KEY_MIN - 1, KEY_MIN, -17, -9, -8, -7, -1, 0,
                                      1,         7,           8,       9,   15, 16, KEY_MAX, KEY_MAX + 1, INT32_MAX};

std::vector<key> awkward_keys()
{
    std::vector<key> all;
    for (int32_t i : awkward)
        for (int32_t j : awkward)
            for (int32_t k : awkward)
                all.push_back({i, j, k});
    return all;
}

int tuple_compare(key a, key b)
{
    const auto x = std::make_tuple(a.i, a.j, a.k), y = std::make_tuple(b.i, b.j, b.k);
    return x < y ? -1 : x > y;
}

TEST(key_order, is_that_of_tuples)
{
    const std::vector<key> all = awkward_keys();
    size_t wrong = 0;
    for (const key &a : all)
        for (size_t n = 0; n < all.size(); n += 7)
            wrong += key_compare(a, all[n]) != tuple_compare(a, all[n]);
    EXPECT_EQ(wrong, 0u);
}

TEST(key_order, equal_is_compare_zero)
{
    const std::vector<key> all = awkward_keys();
    for (size_t n = 0; n < all.size(); n++) {
        EXPECT_TRUE(key_equal(all[n], all[n]));
        EXPECT_EQ(key_compare(all[n], all[n]), 0);
        EXPECT_FALSE(key_equal(all[n], all[(n + 1) % all.size()]));
    }
    EXPECT_FALSE(key_equal({1, 2, 3}, {0, 2, 3}));
    EXPECT_FALSE(key_equal({1, 2, 3}, {1, 0, 3}));
    EXPECT_FALSE(key_equal({1, 2, 3}, {1, 2, 0}));
}

int32_t floor_eighth(int32_t x) { return static_cast<int32_t>(std::floor(x / 8.0)); }

void expect_brick_maths(key c)
{
    const key b = key_brick(c), first = key_of_brick(b);
    ASSERT_EQ(b.i, floor_eighth(c.i));
    ASSERT_EQ(b.j, floor_eighth(c.j));
    ASSERT_EQ(b.k, floor_eighth(c.k));
    const int64_t di = int64_t{c.i} - first.i, dj = int64_t{c.j} - first.j, dk = int64_t{c.k} - first.k;
    ASSERT_TRUE(di >= 0 && di < 8 && dj >= 0 && dj < 8 && dk >= 0 && dk < 8);
    ASSERT_EQ(key_slot(c), di * 64 + dj * 8 + dk);
}

TEST(key_brick, is_floor_division_and_slot_its_remainder)
{
    for (const key &c : awkward_keys())
        expect_brick_maths(c);
    seeded chance = {1};
    for (int n = 0; n < 100000; n++)
        expect_brick_maths(seeded_key(chance, INT32_MIN, INT32_MAX));
}

TEST(key_range, ends_where_bricks_end)
{
    EXPECT_EQ(KEY_MIN, INT32_MIN + 16);
    EXPECT_EQ(KEY_MAX, INT32_MAX - 16);
    EXPECT_EQ(key_slot({KEY_MIN, KEY_MIN, KEY_MIN}), 0);
    EXPECT_EQ(key_slot({KEY_MAX, KEY_MAX, KEY_MAX}), 511);
    for (const key &c : awkward_keys()) {
        bool in = true;
        for (int32_t x : {c.i, c.j, c.k})
            in = in && x >= KEY_MIN && x <= KEY_MAX;
        ASSERT_EQ(key_in_range(c), in) << c.i << " " << c.j << " " << c.k;
        ASSERT_EQ(key_brick_in_range(key_brick(c)), in);
    }
}

TEST(key_range, hostile_brick_keys_are_outside)
{
    for (int32_t x : {INT32_MIN, INT32_MAX, (INT32_MAX >> 3) + 1, (KEY_MAX >> 3) + 1, (KEY_MIN >> 3) - 1}) {
        EXPECT_FALSE(key_brick_in_range({x, 0, 0}));
        EXPECT_FALSE(key_brick_in_range({0, x, 0}));
        EXPECT_FALSE(key_brick_in_range({0, 0, x}));
    }
}

TEST(key_add, moves_each_axis_by_its_own_step)
{
    const key moved = key_add({10, 20, 30}, -1, 2, -3);
    EXPECT_TRUE(key_equal(moved, {9, 22, 27}));
    /* A cube's far corner, and a brick's, are keys at both ends of the range. */
    const key beyond = key_add({KEY_MAX, KEY_MAX, KEY_MAX}, 8, 8, 8);
    const key before = key_add({KEY_MIN, KEY_MIN, KEY_MIN}, -8, -8, -8);
    EXPECT_TRUE(key_equal(beyond, {INT32_MAX - 8, INT32_MAX - 8, INT32_MAX - 8}));
    EXPECT_TRUE(key_equal(before, {INT32_MIN + 8, INT32_MIN + 8, INT32_MIN + 8}));
}

} // namespace
