/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: every cube that shares a dirtied corner is counted once, none besides, across brick borders and at negative
 *       keys.
 * Method: the count against a set of cubes named one by one (mesh_oracle), for single corners at every place of a brick
 *         and for random dirt. */
#include "surface/examined.h"

#include "tests/property/mesh_oracle.h"

#include <gtest/gtest.h>

#include <random>

namespace {

struct marked {
    dirt d{};
    examined e{};
    std::vector<key> corners;

    explicit marked(uint32_t limit = 27000)
    {
        EXPECT_EQ(dirt_init(&d, 1000), STATUS_OK);
        EXPECT_EQ(examined_init(&e, limit), STATUS_OK);
    }
    ~marked()
    {
        examined_finish(&e);
        dirt_finish(&d);
    }
    void add(key corner)
    {
        brick_mask m{};
        brick_mask_set(&m, key_slot(corner));
        EXPECT_EQ(dirt_mark(&d, key_brick(corner), &m), STATUS_OK);
        corners.push_back(corner);
    }
    /* The cubes themselves, each brick's once, and their number. */
    std::vector<key> cubes()
    {
        uint64_t count = 0;
        EXPECT_EQ(examined_count(&e, &d, &count), STATUS_OK);
        std::set<key, mesh_oracle_less> found;
        for (uint32_t n = 0; n < dirt_count(&e.cubes); n++)
            for (int c = 0; c < BRICK_CORNERS; c++)
                if (brick_mask_has(&dirt_at(&e.cubes, n)->corners, c))
                    found.insert(key_add(key_of_brick(dirt_at(&e.cubes, n)->at), c >> 6, c >> 3 & 7, c & 7));
        EXPECT_EQ(count, found.size());
        return {found.begin(), found.end()};
    }
};

void expect_right(marked *m)
{
    const std::vector<key> found = m->cubes(), wanted = mesh_oracle_cubes(m->corners);
    ASSERT_EQ(found.size(), wanted.size());
    for (size_t n = 0; n < found.size(); n++)
        ASSERT_TRUE(key_equal(found[n], wanted[n]));
}

TEST(examined, one_corner_has_eight_cubes_wherever_it_lies)
{
    for (int n = 0; n < BRICK_CORNERS; n++)
        for (const int32_t base : {0, -8, 8 * 1000, -8 * 1000}) {
            marked m;
            m.add({base + (n >> 6), base + (n >> 3 & 7), base + (n & 7)});
            expect_right(&m);
            EXPECT_EQ(m.cubes().size(), 8u);
        }
}

TEST(examined, the_ends_of_the_lattice_are_like_any_other_place)
{
    for (const int32_t end : {KEY_MIN, KEY_MAX}) {
        marked m;
        m.add({end, end, end});
        m.add({end, 0, -1});
        expect_right(&m);
    }
}

TEST(examined, random_dirt_is_counted_exactly)
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

TEST(examined, nothing_dirty_counts_nothing_and_each_count_begins_anew)
{
    marked m;
    EXPECT_TRUE(m.cubes().empty());
    m.add({3, 3, 3});
    expect_right(&m);
    expect_right(&m);
    dirt_clear(&m.d);
    EXPECT_TRUE(m.cubes().empty());
}

TEST(examined, too_small_a_limit_is_said)
{
    marked m(3);
    m.add({0, 0, 0});
    uint64_t count = 0;
    EXPECT_EQ(examined_count(&m.e, &m.d, &count), STATUS_POOL_FULL);
}

} // namespace
