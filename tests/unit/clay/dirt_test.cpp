/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: dirt remembers each brick once, in the order of first marking, with the union of its corners.
 * Method: marks by hand, and random ones against a map of sets. */
#include "clay/dirt.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace {

TEST(brick_mask, sets_and_finds_each_of_512_bits)
{
    for (int slot = 0; slot < BRICK_CORNERS; slot++) {
        brick_mask m = {{0}};
        EXPECT_TRUE(brick_mask_is_empty(&m));
        brick_mask_set(&m, slot);
        EXPECT_FALSE(brick_mask_is_empty(&m));
        for (int other = 0; other < BRICK_CORNERS; other++)
            ASSERT_EQ(brick_mask_has(&m, other), other == slot);
    }
}

TEST(dirt, unites_marks_and_keeps_the_order)
{
    dirt d;
    ASSERT_EQ(dirt_init(&d, 50), STATUS_OK);
    seeded chance = {1};
    std::map<plain_clay_key, std::set<int>> model;
    std::vector<plain_clay_key> order;
    for (int n = 0; n < 3000; n++) {
        const key at = seeded_key(chance, -1, 1);
        const int slot = static_cast<int>(seeded_int(chance, 0, 511));
        brick_mask m = {{0}};
        brick_mask_set(&m, slot);
        if (model.count(plain_clay_tuple(at)) == 0)
            order.push_back(plain_clay_tuple(at));
        model[plain_clay_tuple(at)].insert(slot);
        ASSERT_EQ(dirt_mark(&d, at, &m), STATUS_OK);
    }
    ASSERT_EQ(dirt_count(&d), 27u);
    EXPECT_EQ(dirt_room(&d), 23u);
    for (uint32_t n = 0; n < dirt_count(&d); n++) {
        const dirt_entry *e = dirt_at(&d, n);
        ASSERT_EQ(plain_clay_tuple(e->at), order[n]);
        for (int slot = 0; slot < BRICK_CORNERS; slot++)
            ASSERT_EQ(brick_mask_has(&e->corners, slot), model[order[n]].count(slot) == 1);
    }
    dirt_clear(&d);
    EXPECT_EQ(dirt_count(&d), 0u);
    EXPECT_EQ(dirt_room(&d), 50u);
    const brick_mask none = {{0}};
    ASSERT_EQ(dirt_mark(&d, {0, 0, 0}, &none), STATUS_OK);
    EXPECT_TRUE(brick_mask_is_empty(&dirt_at(&d, 0)->corners)) << "what was cleared came back";
    dirt_finish(&d);
}

TEST(dirt, full_is_refused_for_new_bricks_only)
{
    dirt d;
    ASSERT_EQ(dirt_init(&d, 2), STATUS_OK);
    brick_mask m = {{1}};
    ASSERT_EQ(dirt_mark(&d, {0, 0, 0}, &m), STATUS_OK);
    ASSERT_EQ(dirt_mark(&d, {1, 0, 0}, &m), STATUS_OK);
    EXPECT_EQ(dirt_mark(&d, {2, 0, 0}, &m), STATUS_POOL_FULL);
    EXPECT_EQ(dirt_count(&d), 2u);
    m = {{2}};
    EXPECT_EQ(dirt_mark(&d, {1, 0, 0}, &m), STATUS_OK);
    EXPECT_EQ(dirt_at(&d, 1)->corners.slab[0], 3u);
    dirt_finish(&d);
}

} // namespace
