/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: every cube that shares a dirtied corner is examined once, every cube that touches an aged gradient is aged,
 *       none besides, across brick borders and at negative keys.
 * Method: masks against sets of cubes counted one by one (mesh_oracle), for single corners at every place of a brick
 *         and for random dirt. */
#include "surface/stale.h"

#include "tests/property/mesh_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

struct marked {
    dirt d{};
    stale s{};
    std::vector<key> corners;

    marked()
    {
        EXPECT_EQ(dirt_init(&d, 1000), STATUS_OK);
        EXPECT_EQ(stale_init(&s, 27000), STATUS_OK);
    }
    ~marked()
    {
        stale_finish(&s);
        dirt_finish(&d);
    }
    void add(key corner)
    {
        brick_mask m{};
        brick_mask_set(&m, key_slot(corner));
        EXPECT_EQ(dirt_mark(&d, key_brick(corner), &m), STATUS_OK);
        corners.push_back(corner);
    }
};

/* Cubes of one of the two masks; also sees to it that no brick has two entries. */
std::vector<key> cubes_of(const stale *s, brick_mask stale_entry::*which)
{
    std::set<key, mesh_oracle_less> cubes, bricks;
    for (uint32_t n = 0; n < stale_count(s); n++) {
        const stale_entry *e = stale_at(s, n);
        EXPECT_TRUE(bricks.insert(e->at).second);
        EXPECT_EQ(e->slot, POOL_NONE);
        for (int c = 0; c < BRICK_CORNERS; c++)
            if (brick_mask_has(&(e->*which), c))
                cubes.insert(key_add(key_of_brick(e->at), c >> 6, c >> 3 & 7, c & 7));
    }
    return {cubes.begin(), cubes.end()};
}

bool same(const std::vector<key> &a, const std::vector<key> &b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), key_equal);
}

void expect_right(marked *m)
{
    ASSERT_EQ(stale_mark(&m->s, &m->d), STATUS_OK);
    const std::vector<key> examined = mesh_oracle_cubes(m->corners);
    EXPECT_TRUE(same(cubes_of(&m->s, &stale_entry::examined), examined));
    EXPECT_TRUE(same(cubes_of(&m->s, &stale_entry::aged), mesh_oracle_cubes(mesh_oracle_with_six(m->corners))));
    EXPECT_EQ(stale_examined(&m->s), examined.size());
}

TEST(stale, one_corner_has_eight_cubes_wherever_it_lies)
{
    for (int n = 0; n < BRICK_CORNERS; n++)
        for (const int32_t base : {0, -8, 8 * 1000, -8 * 1000}) {
            marked m;
            m.add({base + (n >> 6), base + (n >> 3 & 7), base + (n & 7)});
            expect_right(&m);
            EXPECT_EQ(stale_examined(&m.s), 8u);
        }
}

TEST(stale, the_ends_of_the_lattice_are_like_any_other_place)
{
    for (const int32_t end : {KEY_MIN, KEY_MAX}) {
        marked m;
        m.add({end, end, end});
        m.add({end, 0, -1});
        expect_right(&m);
    }
}

TEST(stale, random_dirt_is_marked_exactly)
{
    std::mt19937 random(7);
    for (int round = 0; round < 60; round++) {
        marked m;
        const int reach = 3 + round % 12;
        for (int n = 0; n < 5 << round % 8; n++) {
            const auto one = [&] {
                return static_cast<int32_t>(random() % (2 * reach + 1)) - reach + (round % 3 - 1) * 16;
            };
            const int32_t i = one(), j = one(), k = one();
            m.add({i, j, k});
        }
        expect_right(&m);
    }
}

TEST(stale, nothing_dirty_marks_nothing_and_clear_forgets)
{
    marked m;
    ASSERT_EQ(stale_mark(&m.s, &m.d), STATUS_OK);
    EXPECT_EQ(stale_count(&m.s), 0u);
    m.add({3, 3, 3});
    ASSERT_EQ(stale_mark(&m.s, &m.d), STATUS_OK);
    EXPECT_GT(stale_count(&m.s), 0u);
    stale_clear(&m.s);
    EXPECT_EQ(stale_examined(&m.s), 0u);
    expect_right(&m);
}

TEST(stale, too_small_a_limit_is_said)
{
    marked m;
    stale small{};
    ASSERT_EQ(stale_init(&small, 3), STATUS_OK);
    m.add({0, 0, 0});
    EXPECT_EQ(stale_mark(&small, &m.d), STATUS_POOL_FULL);
    stale_finish(&small);
}

} // namespace
