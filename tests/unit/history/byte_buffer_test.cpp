/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a buffer grows keeping what is in it, and refuses what no machine has.
 * Method: grows from nothing past its first room; asks for more than there is address space. */
#include "history/byte_buffer.h"

#include <gtest/gtest.h>

namespace {

TEST(byte_buffer, grows_and_keeps)
{
    byte_buffer b = {};
    ASSERT_EQ(byte_buffer_reserve(&b, 10), STATUS_OK);
    ASSERT_GE(b.room, 10u);
    for (size_t n = 0; n < 10; n++)
        b.bytes[n] = static_cast<uint8_t>(n);
    b.size = 10;
    ASSERT_EQ(byte_buffer_reserve(&b, 300000), STATUS_OK);
    ASSERT_GE(b.room, 300000u);
    b.bytes[299999] = 1;
    for (size_t n = 0; n < 10; n++)
        EXPECT_EQ(b.bytes[n], n);
    EXPECT_EQ(b.size, 10u);
    const size_t room = b.room;
    ASSERT_EQ(byte_buffer_reserve(&b, 5), STATUS_OK);
    EXPECT_EQ(b.room, room);
    byte_buffer_finish(&b);
    EXPECT_EQ(b.bytes, nullptr);
    EXPECT_EQ(b.room, 0u);
}

TEST(byte_buffer, refusal_changes_nothing)
{
    byte_buffer b = {};
    ASSERT_EQ(byte_buffer_reserve(&b, 10), STATUS_OK);
    b.bytes[9] = 42;
    const byte_buffer before = b;
    EXPECT_EQ(byte_buffer_reserve(&b, SIZE_MAX / 2 + 1), STATUS_NO_MEMORY);
    EXPECT_EQ(b.bytes, before.bytes);
    EXPECT_EQ(b.room, before.room);
    EXPECT_EQ(b.bytes[9], 42);
    byte_buffer_finish(&b);
}

} // namespace
