/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the reserve holds as much as it says, gives it back piece by piece, and is never written to again once the
 *       store has failed with it.
 * Method: a store in memory that is full at so many bytes, and that fails at each call in turn. */
#include "history/reserve.h"

#include "tests/unit/history/memory_store.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

constexpr uint64_t MIB = 1024 * 1024;

struct held {
    memory_store m;
    byte_store port = m.port();
    reserve r;
    held() { reserve_open(&r, &port); }
    uint64_t size() const { return m.files.count(RESERVE_NAME) ? m.files.at(RESERVE_NAME).size() : 0; }
    status grow(uint64_t bytes)
    {
        bool done = false;
        status s = STATUS_OK;
        while (s == STATUS_OK && !done)
            s = reserve_grow(&r, bytes, &done);
        return s;
    }
};

TEST(reserve, grows_in_slices_and_is_synced_in_the_end)
{
    held h;
    bool done = false;
    ASSERT_EQ(reserve_grow(&h.r, 2 * MIB + 5000, &done), STATUS_OK);
    EXPECT_FALSE(done);
    EXPECT_EQ(h.size(), MIB);
    ASSERT_EQ(reserve_grow(&h.r, 2 * MIB + 5000, &done), STATUS_OK);
    EXPECT_FALSE(done);
    ASSERT_EQ(reserve_grow(&h.r, 2 * MIB + 5000, &done), STATUS_OK);
    EXPECT_TRUE(done);
    EXPECT_EQ(h.size(), 2 * MIB + 5000);
    EXPECT_EQ(h.r.bytes, h.size());
    EXPECT_EQ(h.m.unsynced.count(RESERVE_NAME), 0u);
    for (const uint8_t b : h.m.files.at(RESERVE_NAME))
        ASSERT_EQ(b, 0);
}

TEST(reserve, gives_what_it_has_and_no_more)
{
    held h;
    EXPECT_EQ(reserve_give(&h.r, 1), 0u) << "there is none";
    ASSERT_EQ(h.grow(MIB), STATUS_OK);
    EXPECT_EQ(reserve_give(&h.r, 300000), 300000u);
    EXPECT_EQ(h.size(), MIB - 300000);
    EXPECT_EQ(reserve_give(&h.r, MIB), MIB - 300000);
    EXPECT_EQ(h.m.files.count(RESERVE_NAME), 0u);
    EXPECT_EQ(reserve_give(&h.r, MIB), 0u);
    ASSERT_EQ(h.grow(MIB), STATUS_OK) << "and is made again";
    EXPECT_EQ(h.m.misuse, "");
}

TEST(reserve, another_process_finds_it_as_it_was_left)
{
    held h;
    ASSERT_EQ(h.grow(MIB + 1), STATUS_OK);
    reserve found;
    reserve_open(&found, &h.port);
    EXPECT_EQ(found.bytes, MIB + 1);
    EXPECT_EQ(reserve_give(&found, MIB), MIB);
}

TEST(reserve, full_store_leaves_it_as_long_as_it_could_be_made)
{
    held h;
    h.m.most_bytes = MIB + 100000;
    EXPECT_EQ(h.grow(3 * MIB), STATUS_NO_SPACE);
    EXPECT_EQ(h.r.bytes, h.size());
    EXPECT_GT(h.size(), MIB);
    EXPECT_EQ(h.m.unsynced.count(RESERVE_NAME), 0u);
    h.m.most_bytes = 100;
    held none;
    none.m.most_bytes = 100;
    EXPECT_EQ(none.grow(MIB), STATUS_NO_SPACE);
    EXPECT_EQ(none.m.files.count(RESERVE_NAME), 0u) << "no empty file";
    EXPECT_EQ(h.m.misuse, "");
}

TEST(reserve, store_that_fails_makes_it_absent_never_wrong)
{
    for (const bool on : {false, true})
        for (uint64_t nth = 1; nth < 60; nth++) {
            held h;
            ASSERT_EQ(h.grow(MIB), STATUS_OK);
            h.m.fail_at = h.m.calls + nth;
            h.m.fail_on = on;
            (void)!h.grow(2 * MIB);
            const uint64_t held = h.r.bytes, given = reserve_give(&h.r, 4096);
            h.m.fail_at = 0;
            ASSERT_TRUE(given == 0 || given >= std::min<uint64_t>(held, 4096));
            ASSERT_TRUE(h.r.spoilt || h.r.bytes == h.size()) << nth;
            if (!h.r.spoilt) {
                ASSERT_EQ(h.grow(3 * MIB), STATUS_OK);
            }
            ASSERT_EQ(h.m.misuse, "") << nth;
        }
}

} // namespace
