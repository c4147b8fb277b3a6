/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: dirt remembers each brick once, in the order of first marking, with the union of its corners, whether the brick
 *       is stored, goes, or comes back.
 * Method: marks by hand, and random ones against a map of sets; bricks by hand, and those of a clay that is written at
 *         random. */
#include "clay/clay.h"
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

/* A brick nobody has marked, as clay makes it. */
brick fresh_brick(key at)
{
    brick b = {};
    b.at = at;
    return b;
}

TEST(dirt, of_a_stored_brick_is_found_without_the_tree)
{
    dirt d;
    ASSERT_EQ(dirt_init(&d, 9), STATUS_OK);
    brick b = fresh_brick({1, 2, 3}), other = fresh_brick({1, 2, 4});
    EXPECT_EQ(dirt_of(&d, &b), POOL_NONE);
    uint32_t entry, again, third;
    ASSERT_EQ(dirt_open_stored(&d, &b, 70, &entry), STATUS_OK);
    EXPECT_EQ(dirt_of(&d, &b), entry);
    EXPECT_EQ(dirt_of(&d, &other), POOL_NONE);
    EXPECT_TRUE(key_equal(dirt_at(&d, entry)->at, b.at));
    EXPECT_EQ(dirt_at(&d, entry)->brick_id, 70u);
    EXPECT_TRUE(brick_mask_is_empty(&dirt_at(&d, entry)->corners));
    EXPECT_TRUE(brick_mask_is_empty(&dirt_at(&d, entry)->moved));
    ASSERT_EQ(dirt_open_stored(&d, &b, 70, &again), STATUS_OK);
    EXPECT_EQ(again, entry);
    ASSERT_EQ(dirt_open_stored(&d, &other, 71, &third), STATUS_OK);
    EXPECT_NE(third, entry);
    EXPECT_EQ(dirt_count(&d), 2u);
    EXPECT_EQ(avl_count(&d.absent), 0u) << "only bricks that are not stored are in the tree";
    dirt_finish(&d);
}

TEST(dirt, of_a_round_is_void_in_the_next)
{
    dirt d;
    ASSERT_EQ(dirt_init(&d, 9), STATUS_OK);
    brick b = fresh_brick({0, 0, 0});
    uint32_t entry;
    for (int round = 0; round < 5; round++) {
        EXPECT_EQ(dirt_of(&d, &b), POOL_NONE) << round;
        ASSERT_EQ(dirt_open_stored(&d, &b, 3, &entry), STATUS_OK);
        EXPECT_TRUE(brick_mask_is_empty(&dirt_at(&d, entry)->corners)) << "what was cleared came back";
        brick_mask_set(&dirt_at(&d, entry)->corners, round);
        EXPECT_EQ(dirt_count(&d), 1u);
        dirt_clear(&d);
    }
    dirt_finish(&d);
}

TEST(dirt, follows_a_brick_that_goes_and_comes_back)
{
    dirt d;
    ASSERT_EQ(dirt_init(&d, 9), STATUS_OK);
    brick b = fresh_brick({4, -4, 0}), back = fresh_brick({4, -4, 0});
    uint32_t entry, same;
    brick_mask m = {{5}};
    ASSERT_EQ(dirt_mark(&d, b.at, &m), STATUS_OK); /* passed by an eraser while it was not stored */
    dirt_born(&d, &b, 11);
    ASSERT_EQ(dirt_open_stored(&d, &b, 11, &entry), STATUS_OK);
    EXPECT_EQ(dirt_at(&d, entry)->brick_id, 11u);
    EXPECT_EQ(avl_count(&d.absent), 0u);
    dirt_gone(&d, &b);
    EXPECT_EQ(dirt_at(&d, entry)->brick_id, POOL_NONE);
    ASSERT_EQ(dirt_open(&d, b.at, &same), STATUS_OK);
    EXPECT_EQ(same, entry);
    dirt_born(&d, &back, 12);
    EXPECT_EQ(dirt_of(&d, &back), entry);
    EXPECT_EQ(dirt_at(&d, entry)->brick_id, 12u);
    EXPECT_EQ(dirt_at(&d, entry)->corners.slab[0], 5u) << "marks stay with the place";
    EXPECT_EQ(dirt_count(&d), 1u);
    dirt_finish(&d);
}

TEST(dirt, a_brick_without_an_entry_comes_and_goes_unseen)
{
    dirt d;
    ASSERT_EQ(dirt_init(&d, 9), STATUS_OK);
    brick b = fresh_brick({4, -4, 0});
    dirt_born(&d, &b, 1);
    EXPECT_EQ(dirt_of(&d, &b), POOL_NONE);
    dirt_gone(&d, &b);
    EXPECT_EQ(dirt_count(&d), 0u);
    EXPECT_EQ(avl_count(&d.absent), 0u);
    dirt_finish(&d);
}

TEST(dirt, all_that_are_stored_may_go_after_reserving)
{
    dirt d;
    ASSERT_EQ(dirt_init(&d, 6), STATUS_OK);
    ASSERT_EQ(dirt_reserve(&d, 6), STATUS_OK);
    EXPECT_EQ(dirt_reserve(&d, 7), STATUS_POOL_FULL);
    const size_t held = pool_bytes(&d.entries) + pool_bytes(&d.absent.nodes);
    std::vector<brick> all;
    for (int n = 0; n < 6; n++)
        all.push_back(fresh_brick({n, 0, 0}));
    uint32_t entry;
    for (brick &b : all)
        ASSERT_EQ(dirt_open_stored(&d, &b, static_cast<uint32_t>(b.at.i), &entry), STATUS_OK);
    brick more = fresh_brick({6, 0, 0});
    EXPECT_EQ(dirt_open_stored(&d, &more, 6, &entry), STATUS_POOL_FULL);
    EXPECT_EQ(dirt_of(&d, &more), POOL_NONE);
    for (const brick &b : all)
        dirt_gone(&d, &b);
    EXPECT_EQ(avl_count(&d.absent), 6u);
    EXPECT_EQ(pool_bytes(&d.entries) + pool_bytes(&d.absent.nodes), held);
    dirt_finish(&d);
}

/* More than a slab of the tree holds, one after the other. */
TEST(dirt, whatever_was_marked_may_go_without_asking_the_machine)
{
    enum { MANY = 20000 };
    dirt d;
    ASSERT_EQ(dirt_init(&d, MANY), STATUS_OK);
    std::vector<brick> all;
    for (int n = 0; n < MANY; n++)
        all.push_back(fresh_brick({n, 0, 0}));
    uint32_t entry;
    for (brick &b : all)
        ASSERT_EQ(dirt_open_stored(&d, &b, static_cast<uint32_t>(b.at.i), &entry), STATUS_OK);
    const size_t held = pool_bytes(&d.absent.nodes);
    for (const brick &b : all)
        dirt_gone(&d, &b);
    EXPECT_EQ(avl_count(&d.absent), uint32_t{MANY});
    EXPECT_EQ(pool_bytes(&d.absent.nodes), held);
    dirt_finish(&d);
}

/* --- through clay --- */

TEST(dirt_of_clay, a_brick_made_emptied_and_made_again_keeps_its_one_entry)
{
    clay c;
    ASSERT_EQ(clay_init(&c, 50), STATUS_OK);
    for (int n = 0; n < 6; n++) {
        const key corner = {8, 0, n};
        ASSERT_EQ(clay_write(&c, corner, 2, 9), STATUS_OK);
        const uint32_t id = clay_find(&c, {1, 0, 0});
        ASSERT_EQ(dirt_count(&c.dirty), 1u);
        EXPECT_EQ(dirt_at(&c.dirty, 0)->brick_id, id);
        EXPECT_EQ(dirt_of(&c.dirty, clay_brick(&c, id)), 0u);
        EXPECT_EQ(clay_dirt(&c, {1, 0, 0}), dirt_at(&c.dirty, 0));
        ASSERT_EQ(clay_write(&c, corner, 0, 9), STATUS_OK);
        ASSERT_EQ(clay_find(&c, {1, 0, 0}), POOL_NONE);
        ASSERT_EQ(dirt_count(&c.dirty), 1u);
        EXPECT_EQ(dirt_at(&c.dirty, 0)->brick_id, POOL_NONE);
        EXPECT_EQ(clay_dirt(&c, {1, 0, 0}), dirt_at(&c.dirty, 0));
        const uint64_t since_the_round_began = (uint64_t{2} << n) - 1;
        EXPECT_EQ(dirt_at(&c.dirty, 0)->corners.slab[0], since_the_round_began);
        EXPECT_EQ(dirt_at(&c.dirty, 0)->moved.slab[0], since_the_round_began);
    }
    clay_finish(&c);
}

TEST(dirt_of_clay, a_brick_that_takes_over_an_id_does_not_take_over_its_dirt)
{
    clay c;
    ASSERT_EQ(clay_init(&c, 50), STATUS_OK);
    ASSERT_EQ(clay_write(&c, {0, 0, 0}, 2, 9), STATUS_OK);
    const uint32_t id = clay_find(&c, {0, 0, 0});
    ASSERT_EQ(clay_write(&c, {0, 0, 0}, 0, 9), STATUS_OK);
    ASSERT_EQ(clay_write(&c, {80, 0, 0}, 2, 9), STATUS_OK);
    ASSERT_EQ(clay_find(&c, {10, 0, 0}), id) << "this is about ids used again";
    ASSERT_EQ(dirt_count(&c.dirty), 2u);
    EXPECT_EQ(clay_dirt(&c, {0, 0, 0})->brick_id, POOL_NONE);
    EXPECT_EQ(clay_dirt(&c, {10, 0, 0})->brick_id, id);
    EXPECT_TRUE(key_equal(clay_dirt(&c, {10, 0, 0})->at, {10, 0, 0}));
    clay_finish(&c);
}

using corner_sets = std::map<plain_clay_key, std::set<int>>;

void expect_marks(const clay *c, const corner_sets &model)
{
    ASSERT_EQ(dirt_count(&c->dirty), model.size());
    uint32_t absent = 0;
    for (const auto &[at, slots] : model) {
        const uint32_t id = clay_find(c, plain_clay_untuple(at));
        const dirt_entry *e = clay_dirt(c, plain_clay_untuple(at));
        ASSERT_NE(e, nullptr);
        ASSERT_EQ(plain_clay_tuple(e->at), at);
        ASSERT_EQ(e->brick_id, id);
        absent += id == POOL_NONE;
        ASSERT_EQ(brick_mask_count(&e->corners), slots.size());
        for (int slot : slots)
            ASSERT_TRUE(brick_mask_has(&e->corners, slot));
    }
    ASSERT_EQ(avl_count(&c->dirty.absent), absent);
}

TEST(dirt_of_clay, is_a_map_of_sets_whatever_bricks_come_and_go)
{
    seeded chance = {3};
    clay c;
    ASSERT_EQ(clay_init(&c, 60), STATUS_OK);
    corner_sets model;
    for (int n = 0; n < 4000; n++) {
        if (seeded_chance(chance, 0.01)) {
            dirt_clear(&c.dirty);
            model.clear();
        }
        /* Few corners in many bricks, most of them removed: bricks come and go all the time. */
        const key at = seeded_key(chance, -1, 1), corner = key_add(key_of_brick(at), 0, 0, n & 1);
        ASSERT_EQ(clay_write(&c, corner, seeded_chance(chance, 0.4) ? 1.0f : 0.0f, 9), STATUS_OK);
        model[plain_clay_tuple(at)].insert(key_slot(corner));
        ASSERT_NO_FATAL_FAILURE(expect_marks(&c, model)) << n;
    }
    clay_finish(&c);
}

} // namespace
