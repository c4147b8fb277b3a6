/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   bytes reach the sink whole and in order, its first failure sticks, numbers look the same everywhere.
 * Method: runs longer than a block against a plain string; a sink that fails at each place; decimals against printf in
 *         the C locale, and brought back to the same bits.
 */
#include "bucket.h"

#include "exchange/outlet.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>

namespace {

TEST(outlet, long_runs_arrive_whole_and_in_order)
{
    std::string expected;
    bucket b;
    outlet o;
    outlet_begin(o, bucket_put, &b);
    for (size_t n = 0; n < 3000; n++) {
        const std::string piece(n % 97, static_cast<char>('a' + n % 26));
        expected += piece;
        outlet_text(o, piece);
    }
    const std::string large(5 * OUTLET_BLOCK_BYTES + 7, 'L');
    outlet_text(o, large);
    EXPECT_EQ(outlet_end(o), STATUS_OK);
    EXPECT_EQ(b.bytes, expected + large);
}

TEST(outlet, binary_numbers_are_little_endian)
{
    bucket b;
    outlet o;
    outlet_begin(o, bucket_put, &b);
    outlet_u8(o, 0xfe);
    outlet_u32(o, 0x01020384u);
    outlet_f32(o, -1.5f);
    outlet_integer(o, UINT64_MAX);
    outlet_integer(o, 0);
    EXPECT_EQ(outlet_end(o), STATUS_OK);
    EXPECT_EQ(b.bytes, std::string("\xfe\x84\x03\x02\x01\x00\x00\xc0\xbf", 9) + "184467440737095516150");
}

std::string decimal(float value, int digits)
{
    bucket b;
    outlet o;
    outlet_begin(o, bucket_put, &b);
    outlet_decimal(o, value, digits);
    EXPECT_EQ(outlet_end(o), STATUS_OK);
    return b.bytes;
}

TEST(outlet, decimals_are_printfs_and_come_back)
{
    const float values[] = {0.0f,   -0.0f,           1.0f,           -1.5f,        0.1f,
                            1e-45f, 1.17549435e-38f, 3.40282347e38f, -123456.789f, 2e9f};
    for (float value : values) {
        char expected[64];
        std::snprintf(expected, sizeof expected, "%.9g", static_cast<double>(value));
        EXPECT_EQ(decimal(value, 9), expected);
    }
    uint32_t bits = 12345;
    for (int n = 0; n < 20000; n++) {
        bits = bits * 1664525u + 1013904223u;
        const float value = std::bit_cast<float>(bits);
        if (!std::isfinite(value))
            continue;
        const std::string text = decimal(value, 9);
        ASSERT_EQ(std::bit_cast<uint32_t>(std::strtof(text.c_str(), nullptr)), bits) << text;
    }
    EXPECT_EQ(decimal(1.0f / 3, 5), "0.33333");
}

TEST(outlet, first_failure_sticks)
{
    for (size_t room : {size_t{0}, size_t{1}, size_t{OUTLET_BLOCK_BYTES}, size_t{OUTLET_BLOCK_BYTES + 1}}) {
        bucket b;
        b.room = room;
        outlet o;
        outlet_begin(o, bucket_put, &b);
        for (int n = 0; n < 10; n++)
            outlet_text(o, std::string(OUTLET_BLOCK_BYTES / 2, static_cast<char>('0' + n)));
        EXPECT_EQ(outlet_end(o), STATUS_IO);
        EXPECT_EQ(outlet_end(o), STATUS_IO);
        EXPECT_EQ(b.bytes.size(), room);
        EXPECT_EQ(b.calls_after_failure, 0);
    }
}

TEST(outlet, nothing_put_nothing_sent)
{
    bucket b;
    b.room = 0;
    b.failed = true;
    outlet o;
    outlet_begin(o, bucket_put, &b);
    outlet_text(o, "");
    EXPECT_EQ(outlet_end(o), STATUS_OK);
    EXPECT_EQ(b.calls_after_failure, 0);
}

} // namespace
