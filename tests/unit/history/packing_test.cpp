/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: what was packed comes back, and no bytes lead anywhere but to what was asked for or a refusal.
 * Method: bytes of nothing, of chance, and between; every flip and cut of a packed piece, unpacked into memory that ends
 *         where it should. */
#include "history/packing.h"

#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <vector>

namespace {

using byte_string = std::vector<uint8_t>;

byte_string packed(const byte_string &plain)
{
    packing *p = packing_open();
    byte_string b(plain.size());
    b.resize(packing_pack(p, b.data(), plain.data(), plain.size()));
    packing_close(p);
    return b;
}

status unpack(byte_string *plain, const byte_string &b) { return packing_unpack(plain->data(), plain->size(), b.data(), b.size()); }

/* Each byte is one of a few, or of chance. */
byte_string bytes_of(seeded &chance, size_t n, double share)
{
    byte_string b(n);
    for (uint8_t &at : b)
        at = seeded_chance(chance, share) ? static_cast<uint8_t>(seeded_bits(chance)) : uint8_t{7};
    return b;
}

TEST(packing, everything_comes_back)
{
    seeded chance = {3};
    for (const size_t n : {size_t{1}, size_t{2}, size_t{100}, size_t{4096}, size_t{65536}, size_t{300000}})
        for (const double share : {0.0, 0.1, 1.0}) {
            const byte_string plain = bytes_of(chance, n, share), b = packed(plain);
            ASSERT_LE(b.size(), n);
            byte_string back(n);
            ASSERT_EQ(unpack(&back, b), STATUS_OK);
            EXPECT_EQ(back, plain);
            EXPECT_EQ(packed(plain), b) << "the same bytes pack to the same";
            if (n >= 4096) {
                EXPECT_EQ(b.size() < n, share < 1) << "chance cannot be packed, it stays as it is";
            }
        }
}

TEST(packing, nothing_is_nothing)
{
    uint8_t none = 9;
    EXPECT_EQ(packing_pack(nullptr, &none, &none, 0), 0u);
    EXPECT_EQ(packing_unpack(&none, 0, &none, 0), STATUS_OK);
    EXPECT_EQ(none, 9);
}

TEST(packing, without_room_it_packs_nothing)
{
    const byte_string plain(500);
    byte_string b(500, 1);
    EXPECT_EQ(packing_pack(nullptr, b.data(), plain.data(), plain.size()), plain.size());
    EXPECT_EQ(b, plain);
}

TEST(packing, another_size_than_it_was_is_refused)
{
    seeded chance = {4};
    const byte_string plain = bytes_of(chance, 1000, 0.1), b = packed(plain);
    ASSERT_LT(b.size(), plain.size());
    for (const size_t n : {b.size() + 1, size_t{999}, size_t{1001}, size_t{100000}}) {
        byte_string other(n);
        EXPECT_EQ(unpack(&other, b), STATUS_CORRUPT) << n;
    }
    byte_string fewer(b.size() - 1);
    EXPECT_EQ(unpack(&fewer, b), STATUS_CORRUPT) << "more than it could have come from";
}

TEST(packing, flips_and_cuts_write_nothing_beyond)
{
    seeded chance = {5};
    const byte_string plain = bytes_of(chance, 700, 0.2), good = packed(plain);
    ASSERT_LT(good.size(), plain.size());
    size_t refused = 0;
    for (size_t bit = 0; bit < good.size() * 8; bit++) {
        byte_string b = good, back(plain.size() + 64, 0xee);
        b[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
        refused += packing_unpack(back.data(), plain.size(), b.data(), b.size()) != STATUS_OK;
        EXPECT_EQ(byte_string(back.end() - 64, back.end()), byte_string(64, 0xee)) << bit;
    }
    EXPECT_GT(refused, 0u);
    for (size_t n = 0; n < good.size(); n++) {
        const byte_string cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(n));
        byte_string back(plain.size());
        EXPECT_EQ(unpack(&back, cut), STATUS_CORRUPT) << n;
    }
}

} // namespace
