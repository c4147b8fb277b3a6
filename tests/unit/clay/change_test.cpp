/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: while a change is recorded each brick's first state is kept once; reverting puts every bit back, whatever was
 *       made or removed meanwhile, and the surface is told.
 * Method: strokes by hand with bricks that come, go, and come and go; digests and images before and after. */
#include "clay/change.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

namespace {

class clay_change : public testing::Test {
protected:
    void SetUp() override
    {
        ASSERT_EQ(clay_init(&c, 100), STATUS_OK);
        seeded chance = {1};
        ASSERT_EQ(plain_clay_ball(&c, chance, {4, 4, 4}, 7, 1), STATUS_OK);
        before = plain_clay_of(&c);
        digest = clay_digest(&c);
        dirt_clear(&c.dirty);
    }
    void TearDown() override { clay_finish(&c); }
    void write(key at, float potential) { ASSERT_EQ(clay_write(&c, at, potential, 77), STATUS_OK); }
    void erase_brick(key b)
    {
        for (int n = 0; n < BRICK_CORNERS; n++)
            write(key_add(key_of_brick(b), n >> 6, n >> 3 & 7, n & 7), 0);
    }
    void revert_and_expect_before()
    {
        clay_change_revert(&c);
        EXPECT_EQ(plain_clay_difference(before, &c), "");
        EXPECT_EQ(clay_digest(&c), digest);
        EXPECT_TRUE(clay_is_valid(&c));
        EXPECT_EQ(change_count(&c.changes), 0u);
        EXPECT_FALSE(c.changes.recording);
    }
    clay c;
    plain_clay before;
    uint64_t digest;
};

TEST_F(clay_change, reverts_new_values)
{
    clay_change_begin(&c);
    seeded chance = {2};
    for (int n = 0; n < 500; n++)
        write(seeded_key(chance, -3, 11), static_cast<float>(seeded_real(chance, -1, 3)));
    EXPECT_NE(clay_digest(&c), digest);
    revert_and_expect_before();
}

TEST_F(clay_change, reverts_bricks_that_came)
{
    clay_change_begin(&c);
    for (int n = 5; n < 20; n++)
        write({8 * n, 0, 0}, 1);
    revert_and_expect_before();
}

TEST_F(clay_change, reverts_bricks_that_went)
{
    clay_change_begin(&c);
    for (const key &b : {key{0, 0, 0}, key{1, 1, 1}, key{-1, 0, 0}})
        erase_brick(b);
    EXPECT_EQ(clay_find(&c, {0, 0, 0}), POOL_NONE);
    revert_and_expect_before();
}

TEST_F(clay_change, reverts_bricks_that_went_and_came_again)
{
    clay_change_begin(&c);
    for (int round = 0; round < 3; round++) {
        erase_brick({0, 0, 0});
        write({3, 3, 3}, 2);
        write({80, 0, 0}, 2);
        write({80, 0, 0}, 0);
    }
    EXPECT_EQ(change_count(&c.changes), 2u) << "one image a brick";
    revert_and_expect_before();
}

TEST_F(clay_change, reverting_fits_when_the_clay_was_full)
{
    /* Fill to the limit, then trade one brick for another within the stroke: room comes back before it is needed. */
    for (int n = 0; clay_brick_count(&c) < 100; n++)
        write({-800, 8 * n, 0}, 1);
    before = plain_clay_of(&c);
    digest = clay_digest(&c);
    dirt_clear(&c.dirty);
    clay_change_begin(&c);
    erase_brick({0, 0, 0});
    write({800, 0, 0}, 1);
    ASSERT_EQ(clay_brick_count(&c), 100u);
    revert_and_expect_before();
}

TEST_F(clay_change, tells_the_surface_what_it_put_back)
{
    clay_change_begin(&c);
    write({4, 4, 4}, 0.25f);
    write({100, 0, 0}, 1);
    erase_brick({1, 1, 1});
    dirt_clear(&c.dirty); /* the surface has seen the stroke */
    clay_change_revert(&c);
    std::set<plain_clay_key> marked;
    for (uint32_t n = 0; n < dirt_count(&c.dirty); n++) {
        const dirt_entry *e = dirt_at(&c.dirty, n);
        marked.insert(plain_clay_tuple(e->at));
        for (uint64_t slab : e->corners.slab)
            EXPECT_EQ(slab, ~0ull);
    }
    EXPECT_EQ(marked, (std::set<plain_clay_key>{{0, 0, 0}, {12, 0, 0}, {1, 1, 1}}));
}

TEST_F(clay_change, keeps_the_first_state_only)
{
    brick_page page;
    std::memcpy(&page, clay_brick(&c, clay_find(&c, {0, 0, 0}))->page, sizeof page);
    clay_change_begin(&c);
    write({1, 1, 1}, 0.5f);
    write({1, 1, 2}, 0.7f);
    write({90, 0, 0}, 1);
    ASSERT_EQ(change_count(&c.changes), 2u);
    const change_image *first = change_at(&c.changes, 0), *second = change_at(&c.changes, 1);
    EXPECT_TRUE(key_equal(first->at, {0, 0, 0}));
    EXPECT_EQ(std::memcmp(clay_image_page(&c, 0), &page, sizeof page), 0);
    EXPECT_TRUE(key_equal(second->at, {11, 0, 0}));
    const brick_page none = {};
    EXPECT_EQ(std::memcmp(clay_image_page(&c, 1), &none, sizeof none), 0) << "a brick that was not is all zero";
    clay_change_revert(&c);
}

TEST_F(clay_change, end_keeps_the_clay_and_the_next_change_starts_afresh)
{
    clay_change_begin(&c);
    write({1, 1, 1}, 0.5f);
    clay_change_end(&c);
    EXPECT_EQ(change_count(&c.changes), 0u);
    write({1, 1, 1}, 0.6f); /* outside a change nothing is kept */
    EXPECT_EQ(change_count(&c.changes), 0u);
    before = plain_clay_of(&c);
    digest = clay_digest(&c);
    clay_change_begin(&c);
    write({1, 1, 1}, 0.7f);
    EXPECT_EQ(change_count(&c.changes), 1u);
    revert_and_expect_before();
}

TEST_F(clay_change, nothing_done_is_nothing_to_revert)
{
    clay_change_begin(&c);
    revert_and_expect_before();
    EXPECT_EQ(dirt_count(&c.dirty), 0u);
}

TEST_F(clay_change, begun_twice_is_our_bug)
{
    clay_change_begin(&c);
    EXPECT_DEATH(clay_change_begin(&c), "");
}

TEST(change_keep, answers_the_same_image_again)
{
    change c;
    pages none = {};
    ASSERT_EQ(change_init(&c, 2), STATUS_OK);
    uint32_t a, b;
    ASSERT_EQ(change_keep(&c, &none, {1, 2, 3}, 0, nullptr, &a), STATUS_OK);
    ASSERT_EQ(change_keep(&c, &none, {1, 2, 3}, 0, nullptr, &b), STATUS_OK);
    EXPECT_EQ(a, b);
    ASSERT_EQ(change_keep(&c, &none, {1, 2, 4}, 0, nullptr, &b), STATUS_OK);
    EXPECT_NE(a, b);
    EXPECT_EQ(change_keep(&c, &none, {1, 2, 5}, 0, nullptr, &b), STATUS_POOL_FULL);
    EXPECT_EQ(change_count(&c), 2u);
    EXPECT_EQ(change_keep(&c, &none, {1, 2, 3}, 0, nullptr, &b), STATUS_OK) << "full, but this one is there";
    change_finish(&c);
}

} // namespace
