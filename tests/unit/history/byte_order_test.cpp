/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: bytes are little-endian on any machine, and every value comes back.
 * Method: known values against bytes written out by hand; bits that a conversion through arithmetic would lose. */
#include "history/byte_order.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace {

TEST(byte_order, integers_have_their_smallest_byte_first)
{
    std::array<uint8_t, 12> b{};
    byte_order_put_u32(b.data(), 0x01020384u);
    byte_order_put_u64(b.data() + 4, 0xf1f2f3f4f5f6f7f8u);
    const std::array<uint8_t, 12> expected = {0x84, 3, 2, 1, 0xf8, 0xf7, 0xf6, 0xf5, 0xf4, 0xf3, 0xf2, 0xf1};
    EXPECT_EQ(b, expected);
    EXPECT_EQ(byte_order_get_u32(b.data()), 0x01020384u);
    EXPECT_EQ(byte_order_get_u64(b.data() + 4), 0xf1f2f3f4f5f6f7f8u);
}

TEST(byte_order, floats_keep_every_bit)
{
    std::array<uint8_t, 8> b{};
    byte_order_put_float(b.data(), 1.5f); /* 0x3fc00000 */
    EXPECT_EQ(b[3], 0x3f);
    EXPECT_EQ(b[2], 0xc0);
    for (float v : {0.0f, -0.0f, 3.0f, std::numeric_limits<float>::denorm_min(), 1e-30f}) {
        byte_order_put_float(b.data(), v);
        const float back = byte_order_get_float(b.data());
        EXPECT_EQ(back, v);
        EXPECT_EQ(std::signbit(back), std::signbit(v));
    }
    byte_order_put_double(b.data(), 0.5); /* 0x3fe0000000000000 */
    EXPECT_EQ(b[7], 0x3f);
    EXPECT_EQ(b[6], 0xe0);
    EXPECT_EQ(byte_order_get_double(b.data()), 0.5);
}

} // namespace
