/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a frozen clay stays what the clay was, whatever is done to that, and costs nothing once it is ended.
 * Method: everything that writes clay is done to one that is frozen; the rest is counting pages. Long random runs are in
 *         tests/property/clay_test.cpp, another thread reading it in tests/unit/station/errand_test.cpp. */
#include "clay/freeze.h"

#include "clay/capacity.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

namespace {

class frozen_clay : public testing::Test {
protected:
    void SetUp() override
    {
        seeded chance = {1};
        ASSERT_EQ(clay_init(&c, 1000), STATUS_OK);
        ASSERT_EQ(plain_clay_ball(&c, chance, {0, 0, 0}, 20, 1), STATUS_OK);
        dirt_clear(&c.dirty);
        before = plain_clay_of(&c);
        digest = clay_digest(&c);
        pages = c.pages.of.count;
        ASSERT_EQ(freeze_begin(&f, &c), STATUS_OK);
    }
    void TearDown() override { clay_finish(&c); }
    void expect_still()
    {
        EXPECT_EQ(plain_clay_difference(before, &f.still), "");
        EXPECT_EQ(clay_digest(&f.still), digest);
        EXPECT_EQ(f.still.corners, before.size());
        EXPECT_EQ(dirt_count(&f.still.dirty), 0u);
        for (uint32_t id = 0; id < f.still.bricks.fresh; id++)
            EXPECT_EQ(dirt_of(&f.still.dirty, clay_brick(&f.still, id)), POOL_NONE);
    }
    void end()
    {
        freeze_end(&f);
        EXPECT_TRUE(clay_is_valid(&c));
    }
    void write_all(float potential)
    {
        for (const auto &[at, corner] : before)
            ASSERT_EQ(clay_write(&c, plain_clay_untuple(at), potential, 77), STATUS_OK);
    }
    clay c;
    freeze f;
    plain_clay before;
    uint64_t digest;
    uint32_t pages;
};

TEST_F(frozen_clay, is_the_clay_and_takes_no_page)
{
    expect_still();
    EXPECT_EQ(c.pages.of.count, pages);
    end();
    EXPECT_EQ(c.pages.of.count, pages);
}

TEST_F(frozen_clay, stays_while_every_corner_is_written)
{
    write_all(0.5f);
    expect_still();
    EXPECT_GT(c.pages.of.count, pages);
    end();
    EXPECT_EQ(c.pages.of.count, pages) << "what it held is given back";
}

TEST_F(frozen_clay, stays_while_the_clay_goes)
{
    write_all(0);
    EXPECT_EQ(clay_brick_count(&c), 0u);
    expect_still();
    end();
    EXPECT_EQ(c.pages.of.count, 0u);
}

TEST_F(frozen_clay, stays_while_the_clay_is_cleared)
{
    clay_clear(&c);
    expect_still();
    ASSERT_EQ(clay_write(&c, {1, 2, 3}, 1, 9), STATUS_OK);
    expect_still();
    end();
}

TEST_F(frozen_clay, stays_over_a_change_and_its_reverting)
{
    clay_change_begin(&c);
    write_all(0.5f);
    expect_still();
    clay_change_revert(&c);
    EXPECT_EQ(clay_digest(&c), digest);
    expect_still();
    end();
    EXPECT_EQ(c.pages.of.count, pages);
}

TEST_F(frozen_clay, of_a_change_under_way_is_what_is_there_then)
{
    freeze second;
    clay_change_begin(&c);
    ASSERT_EQ(clay_write(&c, {0, 0, 0}, 0.5f, 9), STATUS_OK);
    const uint64_t then = clay_digest(&c);
    ASSERT_EQ(freeze_begin(&second, &c), STATUS_OK);
    ASSERT_EQ(clay_write(&c, {0, 0, 0}, 0.6f, 9), STATUS_OK);
    clay_change_end(&c);
    EXPECT_EQ(clay_digest(&second.still), then);
    EXPECT_EQ(change_count(&second.still.changes), 0u);
    expect_still();
    freeze_end(&second);
    end();
}

TEST_F(frozen_clay, no_more_than_capacity_at_a_time)
{
    freeze more[CAPACITY_FROZEN];
    for (uint32_t n = 1; n < CAPACITY_FROZEN; n++)
        ASSERT_EQ(freeze_begin(&more[n], &c), STATUS_OK);
    EXPECT_EQ(freeze_begin(&more[0], &c), STATUS_POOL_FULL);
    for (uint32_t n = 1; n < CAPACITY_FROZEN; n++)
        freeze_end(&more[n]);
    ASSERT_EQ(freeze_begin(&more[0], &c), STATUS_OK);
    freeze_end(&more[0]);
    end();
}

TEST_F(frozen_clay, outliving_its_clay_is_our_bug)
{
    EXPECT_DEATH(clay_finish(&c), "");
    end();
}

} // namespace
