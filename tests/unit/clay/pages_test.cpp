/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a page lives as long as somebody holds it; bricks that are full of one colour share one, and get their own again
 *       before they are written.
 * Method: by hand; what a clay of full bricks costs is read off its pool. */
#include "clay/clay.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

namespace {

class clay_pages : public testing::Test {
protected:
    void SetUp() override { ASSERT_EQ(pages_init(&p, 100), STATUS_OK); }
    void TearDown() override { pages_finish(&p); }
    uint32_t take()
    {
        uint32_t id = POOL_NONE;
        EXPECT_EQ(pages_take(&p, &id), STATUS_OK);
        return id;
    }
    uint32_t take_full(uint32_t rgba)
    {
        const uint32_t id = take();
        for (int n = 0; n < BRICK_CORNERS; n++) {
            pages_at(&p, id)->potential[n] = POTENTIAL_MAX;
            pages_at(&p, id)->rgba[n] = rgba;
        }
        return id;
    }
    pages p;
};

TEST_F(clay_pages, live_as_long_as_they_are_held)
{
    const uint32_t id = take();
    EXPECT_FALSE(pages_is_shared(&p, id));
    pages_hold(&p, id);
    pages_hold(&p, id);
    EXPECT_TRUE(pages_is_shared(&p, id));
    pages_give(&p, id);
    EXPECT_TRUE(pages_is_shared(&p, id));
    pages_give(&p, id);
    EXPECT_FALSE(pages_is_shared(&p, id));
    EXPECT_EQ(p.of.count, 1u);
    pages_give(&p, id);
    EXPECT_EQ(p.of.count, 0u);
    EXPECT_EQ(take(), id);
    EXPECT_FALSE(pages_is_shared(&p, id));
}

TEST_F(clay_pages, run_out_at_the_limit)
{
    for (int n = 0; n < 100; n++)
        take();
    uint32_t id = 12345;
    EXPECT_EQ(pages_take(&p, &id), STATUS_POOL_FULL);
    EXPECT_EQ(id, 12345u);
    EXPECT_EQ(pages_reserve(&p, 1), STATUS_POOL_FULL);
    EXPECT_EQ(pages_reserve(&p, 0), STATUS_OK);
}

TEST_F(clay_pages, reserved_are_taken_without_asking_the_machine)
{
    ASSERT_EQ(pages_reserve(&p, 90), STATUS_OK);
    const size_t held = pool_bytes(&p.of);
    const uint32_t *const holders = p.holders;
    for (int n = 0; n < 90; n++)
        take();
    EXPECT_EQ(pool_bytes(&p.of), held);
    EXPECT_EQ(p.holders, holders);
}

TEST_F(clay_pages, full_is_full_to_the_last_corner)
{
    brick_page *page = pages_at(&p, take_full(7));
    EXPECT_TRUE(pages_is_full(page));
    for (const int n : {0, 1, 255, 511}) {
        page->potential[n] = 2.9999998f;
        EXPECT_FALSE(pages_is_full(page)) << n;
        page->potential[n] = POTENTIAL_MAX;
        page->rgba[n] = 8;
        EXPECT_FALSE(pages_is_full(page)) << n;
        page->rgba[n] = 7;
    }
    EXPECT_TRUE(pages_is_full(page));
}

TEST_F(clay_pages, full_ones_of_a_colour_become_one)
{
    const uint32_t first = take_full(7);
    EXPECT_EQ(pages_fold(&p, first), first);
    EXPECT_TRUE(pages_is_shared(&p, first)) << "the table holds it too: nobody may write it";
    EXPECT_EQ(pages_fold(&p, first), first) << "again";
    for (int n = 0; n < 10; n++)
        EXPECT_EQ(pages_fold(&p, take_full(7)), first);
    EXPECT_EQ(p.of.count, 1u);
    for (int n = 0; n < 11; n++)
        pages_give(&p, first);
    EXPECT_EQ(p.of.count, 1u) << "kept for the next one";
    EXPECT_EQ(pages_fold(&p, take_full(7)), first);
}

TEST_F(clay_pages, more_colours_than_the_table_has_places)
{
    uint32_t id[90];
    for (uint32_t n = 0; n < 90; n++)
        id[n] = pages_fold(&p, take_full(1000 + n));
    for (uint32_t n = 0; n < 90; n++) {
        EXPECT_TRUE(pages_is_full(pages_at(&p, id[n])));
        EXPECT_EQ(pages_at(&p, id[n])->rgba[0], 1000 + n) << "never another colour's";
        pages_give(&p, id[n]);
    }
    EXPECT_LE(p.of.count, CAPACITY_FULL_COLOURS);
}

void fill(clay *c, key at, uint32_t rgba)
{
    static const brick_mask all = BRICK_MASK_ALL;
    uint32_t id;
    ASSERT_EQ(clay_brick_open(c, at, &id), STATUS_OK);
    for (int n = 0; n < BRICK_CORNERS; n++) {
        clay_brick(c, id)->page->potential[n] = POTENTIAL_MAX;
        clay_brick(c, id)->page->rgba[n] = rgba;
    }
    ASSERT_EQ(clay_brick_close(c, id, &all), STATUS_OK);
}

TEST(clay_of_full_bricks, takes_a_page_a_colour)
{
    clay c, copy;
    ASSERT_EQ(clay_init(&c, 1000), STATUS_OK);
    for (int n = 0; n < 500; n++)
        fill(&c, {n, 0, 0}, n < 400 ? 5 : 6);
    EXPECT_EQ(c.corners, 500u * 512u);
    EXPECT_EQ(c.pages.of.count, 2u);
    EXPECT_LE(pool_bytes(&c.pages.of), 512u * 1024) << "nor was there ever need for more";
    EXPECT_TRUE(clay_is_valid(&c));
    ASSERT_EQ(clay_init(&copy, 1000), STATUS_OK);
    ASSERT_EQ(clay_copy(&copy, &c), STATUS_OK);
    EXPECT_EQ(copy.pages.of.count, 2u);
    EXPECT_EQ(clay_digest(&copy), clay_digest(&c));
    clay_finish(&copy);
    clay_finish(&c);
}

TEST(clay_of_full_bricks, writing_one_leaves_the_others)
{
    clay c;
    ASSERT_EQ(clay_init(&c, 1000), STATUS_OK);
    for (int n = 0; n < 5; n++)
        fill(&c, {n, 0, 0}, 5);
    const uint64_t digest = clay_digest(&c);
    plain_clay model = plain_clay_of(&c);
    ASSERT_EQ(clay_write(&c, {17, 1, 1}, 1, 9), STATUS_OK);
    plain_clay_write(model, {17, 1, 1}, 1, 9);
    EXPECT_EQ(plain_clay_difference(model, &c), "");
    EXPECT_EQ(c.pages.of.count, 2u);
    EXPECT_TRUE(clay_is_valid(&c));
    ASSERT_EQ(clay_write(&c, {17, 1, 1}, POTENTIAL_MAX, 5), STATUS_OK);
    EXPECT_EQ(c.pages.of.count, 1u) << "full again";
    EXPECT_EQ(clay_digest(&c), digest);
    for (int n = 0; n < 5; n++)
        for (int slot = 0; slot < BRICK_CORNERS; slot++)
            ASSERT_EQ(clay_write(&c, {8 * n + (slot >> 6), slot >> 3 & 7, slot & 7}, 0, 0), STATUS_OK);
    EXPECT_EQ(clay_brick_count(&c), 0u);
    EXPECT_TRUE(clay_is_valid(&c));
    clay_finish(&c);
}

} // namespace
