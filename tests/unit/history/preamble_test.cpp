/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a sealed header passes; a newer one is told from a damaged one; every flipped bit and every cut is seen.
 * Method: all single-bit flips and all lengths of one header; headers of later versions with their own sizes. */
#include "history/preamble.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace {

constexpr preamble mine = {"glxxxx\r\n", 2, 40};

std::vector<uint8_t> sealed(const preamble &p)
{
    std::vector<uint8_t> h(p.header_bytes);
    for (size_t n = 0; n < h.size(); n++)
        h[n] = static_cast<uint8_t>(n * 3);
    preamble_seal(&p, h.data());
    return h;
}

status check(const std::vector<uint8_t> &h, preamble_trouble *why)
{
    *why = {12345, nullptr};
    return preamble_check(&mine, h.data(), h.size(), why);
}

TEST(preamble, sealed_passes_and_keeps_what_is_between)
{
    preamble_trouble why;
    const std::vector<uint8_t> h = sealed(mine);
    EXPECT_EQ(check(h, &why), STATUS_OK);
    EXPECT_EQ(std::memcmp(h.data(), "glxxxx\r\n", 8), 0);
    EXPECT_EQ(h[8], 2);
    EXPECT_EQ(h[12], 40);
    for (size_t n = 16; n < 32; n++)
        EXPECT_EQ(h[n], n * 3);
}

TEST(preamble, bytes_after_the_header_do_not_matter)
{
    preamble_trouble why;
    std::vector<uint8_t> h = sealed(mine);
    h.resize(PREAMBLE_HEADER_BYTES_MAX, 0xee);
    EXPECT_EQ(check(h, &why), STATUS_OK);
}

TEST(preamble, every_flipped_bit_is_damage_and_never_newer)
{
    for (size_t bit = 0; bit < 40 * 8; bit++) {
        preamble_trouble why;
        std::vector<uint8_t> h = sealed(mine);
        h[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
        EXPECT_EQ(check(h, &why), STATUS_CORRUPT) << bit;
        EXPECT_LE(why.offset, 40u);
        ASSERT_NE(why.expected, nullptr);
    }
}

TEST(preamble, every_cut_is_damage)
{
    for (size_t length = 0; length < 40; length++) {
        preamble_trouble why;
        std::vector<uint8_t> h = sealed(mine);
        h.resize(length);
        EXPECT_EQ(check(h, &why), STATUS_CORRUPT) << length;
    }
}

TEST(preamble, later_versions_are_newer_whatever_their_size)
{
    for (uint32_t size : {24u, 40u, 512u}) {
        preamble_trouble why;
        EXPECT_EQ(check(sealed({"glxxxx\r\n", 3, size}), &why), STATUS_NEWER) << size;
    }
}

TEST(preamble, earlier_versions_and_other_sizes_are_damage)
{
    preamble_trouble why;
    EXPECT_EQ(check(sealed({"glxxxx\r\n", 1, 40}), &why), STATUS_CORRUPT);
    EXPECT_EQ(check(sealed({"glxxxx\r\n", 2, 48}), &why), STATUS_CORRUPT);
    EXPECT_EQ(check(sealed({"glyyyy\r\n", 2, 40}), &why), STATUS_CORRUPT);
    EXPECT_EQ(why.offset, 0u);
    EXPECT_EQ(check(sealed({"glxxxx\r\n", 3, 520}), &why), STATUS_CORRUPT) << "beyond the largest header";
}

} // namespace
