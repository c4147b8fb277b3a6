/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: whichever pool runs out, and at whichever item, the clay is as it was and goes on working; what takes no room
 *       is never refused for lack of it.
 * Method: clays of a few bricks, filled until each of their pools refuses in turn. A machine that gives no memory is
 *         in tests/unit/tool/memory_test.cpp. */
#include "clay/clay.h"

#include "clay/capacity.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

namespace {

void expect_refused(clay *c, key at, status wanted)
{
    const plain_clay before = plain_clay_of(c);
    const uint64_t digest = clay_digest(c);
    const uint32_t images = change_count(&c->changes);
    EXPECT_EQ(clay_write(c, at, 1, 9), wanted);
    EXPECT_EQ(plain_clay_difference(before, c), "");
    EXPECT_EQ(clay_digest(c), digest);
    EXPECT_EQ(change_count(&c->changes), images);
    EXPECT_TRUE(clay_is_valid(c));
}

TEST(clay_room, for_bricks_ends_at_the_limit)
{
    for (uint32_t limit = 1; limit <= 9; limit++) {
        clay c;
        ASSERT_EQ(clay_init(&c, limit), STATUS_OK);
        for (uint32_t n = 0; n < limit; n++)
            ASSERT_EQ(clay_write(&c, {static_cast<int32_t>(8 * n), 0, 0}, 1, 9), STATUS_OK);
        expect_refused(&c, {-8, 0, 0}, STATUS_POOL_FULL);
        EXPECT_EQ(clay_write(&c, {1, 0, 0}, 1, 9), STATUS_OK) << "a corner in a stored brick takes none";
        EXPECT_EQ(clay_write(&c, {-8, 0, 0}, 0, 9), STATUS_OK) << "nor does removing what is not there";
        dirt_clear(&c.dirty);
        ASSERT_EQ(clay_write(&c, {1, 0, 0}, 0, 9), STATUS_OK);
        ASSERT_EQ(clay_write(&c, {0, 0, 0}, 0, 9), STATUS_OK);
        EXPECT_EQ(clay_write(&c, {-8, 0, 0}, 1, 9), STATUS_OK) << "a brick given back is room again";
        EXPECT_TRUE(clay_is_valid(&c));
        clay_finish(&c);
    }
}

TEST(clay_room, for_images_ends_at_the_limit)
{
    clay c;
    ASSERT_EQ(clay_init(&c, 3), STATUS_OK);
    clay_change_begin(&c);
    for (int n = 0; n < 3; n++) { /* bricks that come and go: images stay */
        ASSERT_EQ(clay_write(&c, {8 * n, 0, 0}, 1, 9), STATUS_OK);
        ASSERT_EQ(clay_write(&c, {8 * n, 0, 0}, 0, 9), STATUS_OK);
        dirt_clear(&c.dirty);
    }
    ASSERT_EQ(change_count(&c.changes), 3u);
    expect_refused(&c, {80, 0, 0}, STATUS_POOL_FULL);
    EXPECT_EQ(clay_write(&c, {8, 0, 0}, 1, 9), STATUS_OK) << "its image is kept already";
    clay_change_revert(&c);
    EXPECT_EQ(clay_digest(&c), 0u);
    clay_finish(&c);
}

TEST(clay_room, a_stroke_that_stays_where_it_is_never_runs_out)
{
    clay c;
    ASSERT_EQ(clay_init(&c, 2), STATUS_OK);
    clay_change_begin(&c);
    for (int n = 0; n < 1000; n++)
        ASSERT_EQ(clay_write(&c, {n % 16, 0, 0}, n % 3 ? 1.0f : 0.0f, 9), STATUS_OK) << n;
    clay_change_revert(&c);
    EXPECT_EQ(clay_digest(&c), 0u);
    clay_finish(&c);
}

TEST(clay_room, for_dirt_ends_at_the_limit)
{
    clay c;
    ASSERT_EQ(clay_init(&c, 4), STATUS_OK);
    ASSERT_EQ(clay_write(&c, {0, 0, 0}, 1, 9), STATUS_OK);
    for (int n = 1; n < 8; n++)
        ASSERT_EQ(clay_write(&c, {8 * n, 0, 0}, 0, 9), STATUS_OK); /* marks, and stores nothing */
    ASSERT_EQ(dirt_room(&c.dirty), 4u); /* one for each image there could be */
    expect_refused(&c, {800, 0, 0}, STATUS_POOL_FULL);
    EXPECT_EQ(clay_write(&c, {8, 0, 0}, 1, 9), STATUS_OK) << "marked already";
    dirt_clear(&c.dirty);
    EXPECT_EQ(clay_write(&c, {800, 0, 0}, 1, 9), STATUS_OK);
    clay_finish(&c);
}

TEST(clay_room, reverting_always_has_its_marks)
{
    clay c;
    ASSERT_EQ(clay_init(&c, 4), STATUS_OK);
    clay_change_begin(&c);
    for (int n = 0; n < 4; n++)
        ASSERT_EQ(clay_write(&c, {8 * n, 0, 0}, 1, 9), STATUS_OK);
    dirt_clear(&c.dirty); /* the surface has seen these */
    int marked = 0;
    for (int n = 0; n < 20; n++) /* an eraser that passes through the air, as far as it is let */
        marked += clay_write(&c, {0, 800 + 8 * n, 0}, 0, 9) == STATUS_OK;
    EXPECT_EQ(marked, 8) << "two for each brick; a third is held back";
    clay_change_revert(&c);
    EXPECT_EQ(clay_digest(&c), 0u);
    EXPECT_TRUE(clay_is_valid(&c));
    clay_finish(&c);
}

TEST(clay_room, counts_each_pool_by_itself)
{
    clay c;
    ASSERT_EQ(clay_init(&c, 4), STATUS_OK);
    EXPECT_EQ(clay_room(&c, 4, 8), STATUS_OK);
    EXPECT_EQ(clay_room(&c, 5, 5), STATUS_POOL_FULL);
    EXPECT_EQ(clay_room(&c, 0, 9), STATUS_POOL_FULL);
    clay_change_begin(&c);
    EXPECT_EQ(clay_room(&c, 4, 4), STATUS_OK);
    EXPECT_EQ(clay_room(&c, 0, 5), STATUS_POOL_FULL) << "five images";
    clay_change_end(&c);
    clay_finish(&c);
}

TEST(clay_room, need_counts_what_is_there_already)
{
    clay c;
    ASSERT_EQ(clay_init(&c, 4), STATUS_OK);
    ASSERT_EQ(clay_write(&c, {0, 0, 0}, 1, 9), STATUS_OK);
    dirt_clear(&c.dirty);
    clay_change_begin(&c);
    ASSERT_EQ(clay_write(&c, {8, 0, 0}, 1, 9), STATUS_OK);
    clay_need need = {0, 0, 0, 0};
    clay_need_add(&c, &need, {1, 0, 0}, clay_find(&c, {1, 0, 0}), CLAY_OPEN); /* stored, imaged, marked */
    EXPECT_EQ(need.bricks + need.images + need.marks, 0u);
    clay_need_add(&c, &need, {0, 0, 0}, clay_find(&c, {0, 0, 0}), CLAY_OPEN); /* stored only */
    EXPECT_EQ(need.bricks, 0u);
    EXPECT_EQ(need.images, 1u);
    EXPECT_EQ(need.marks, 1u);
    clay_need_add(&c, &need, {2, 0, 0}, clay_find(&c, {2, 0, 0}), CLAY_MARK); /* the air, only passed */
    EXPECT_EQ(need.bricks, 0u);
    EXPECT_EQ(need.images, 1u);
    EXPECT_EQ(need.marks, 2u);
    clay_need_add(&c, &need, {2, 0, 0}, clay_find(&c, {2, 0, 0}), CLAY_OPEN);
    EXPECT_EQ(need.bricks, 1u);
    EXPECT_EQ(need.images, 2u);
    EXPECT_EQ(need.marks, 3u);
    clay_change_end(&c);
    clay_finish(&c);
}

TEST(clay_room, ratios_are_capacitys)
{
    clay c;
    ASSERT_EQ(clay_init(&c, CAPACITY_BRICKS), STATUS_OK);
    EXPECT_EQ(c.bricks.limit, CAPACITY_BRICKS);
    EXPECT_EQ(c.changes.images.limit, CAPACITY_IMAGES);
    EXPECT_EQ(c.dirty.entries.limit, CAPACITY_DIRT);
    EXPECT_LT(pool_bytes(&c.pages.of) + pool_bytes(&c.bricks), 1u << 20) << "limits cost nothing until they are used";
    clay_finish(&c);
}

TEST(clay_room_death, limits_beyond_capacity_are_our_bug)
{
    clay c;
    EXPECT_DEATH(EXPECT_EQ(clay_init(&c, 0), STATUS_OK), "");
    EXPECT_DEATH(EXPECT_EQ(clay_init(&c, CAPACITY_BRICKS + 1), STATUS_OK), "");
}

} // namespace
