/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the digest of clay says what the field is, and nothing about how it came to be.
 * Method: one field made in many orders and by detours; then one bit of it changed at a time. */
#include "clay/digest.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

struct written {
    key at;
    float potential;
    uint32_t rgba;
};

std::vector<written> some_corners(seeded &chance, int n)
{
    std::map<plain_clay_key, written> all;
    while (static_cast<int>(all.size()) < n) {
        const key at = seeded_key(chance, -30, 30);
        all[plain_clay_tuple(at)] = {at, static_cast<float>(seeded_real(chance, 0.01, 3)),
                                     static_cast<uint32_t>(seeded_bits(chance))};
    }
    std::vector<written> list;
    for (const auto &[tuple, w] : all)
        list.push_back(w);
    return list;
}

void shuffle(std::vector<written> &list, seeded &chance)
{
    for (size_t n = list.size(); n > 1; n--)
        std::swap(list[n - 1], list[static_cast<size_t>(seeded_int(chance, 0, static_cast<int64_t>(n) - 1))]);
}

TEST(digest_bytes, is_xxh3)
{
    EXPECT_EQ(digest_bytes("", 0, 0), 0x2D06800538D394C2u) << "XXH3 of nothing, as its authors publish it";
    EXPECT_NE(digest_bytes("a", 1, 0), digest_bytes("a", 1, 1));
    EXPECT_NE(digest_bytes("a", 1, 0), digest_bytes("b", 1, 0));
}

TEST(clay_digest, of_empty_is_0)
{
    clay c;
    ASSERT_EQ(clay_init(&c, 100), STATUS_OK);
    EXPECT_EQ(clay_digest(&c), 0u);
    ASSERT_EQ(clay_write(&c, {1, 2, 3}, 1, 5), STATUS_OK);
    EXPECT_NE(clay_digest(&c), 0u);
    ASSERT_EQ(clay_write(&c, {1, 2, 3}, 0, 5), STATUS_OK);
    EXPECT_EQ(clay_digest(&c), 0u);
    clay_finish(&c);
}

TEST(clay_digest, does_not_depend_on_the_order)
{
    seeded chance = {1};
    std::vector<written> list = some_corners(chance, 2000);
    uint64_t wanted = 0;
    for (int round = 0; round < 6; round++) {
        clay c;
        ASSERT_EQ(clay_init(&c, 4096), STATUS_OK);
        shuffle(list, chance);
        for (const written &w : list) {
            if (round > 2 && seeded_chance(chance, 0.3)) { /* detours: other corners that go again */
                const key other = seeded_key(chance, 40, 60);
                ASSERT_EQ(clay_write(&c, other, 1, 1), STATUS_OK);
                ASSERT_EQ(clay_write(&c, w.at, 0.5f, 1), STATUS_OK);
                (void)clay_digest(&c); /* caches must not go stale */
                ASSERT_EQ(clay_write(&c, other, 0, 1), STATUS_OK);
            }
            ASSERT_EQ(clay_write(&c, w.at, w.potential, w.rgba), STATUS_OK);
        }
        wanted = round == 0 ? clay_digest(&c) : wanted;
        EXPECT_EQ(clay_digest(&c), wanted) << round;
        clay copy;
        ASSERT_EQ(clay_init(&copy, 4096), STATUS_OK);
        ASSERT_EQ(clay_copy(&copy, &c), STATUS_OK);
        EXPECT_EQ(clay_digest(&copy), wanted) << "computed afresh";
        clay_finish(&copy);
        clay_finish(&c);
    }
}

TEST(clay_digest, sees_every_single_change)
{
    seeded chance = {2};
    clay c;
    ASSERT_EQ(clay_init(&c, 4096), STATUS_OK);
    const std::vector<written> list = some_corners(chance, 300);
    for (const written &w : list)
        ASSERT_EQ(clay_write(&c, w.at, w.potential, w.rgba), STATUS_OK);
    const uint64_t wanted = clay_digest(&c);
    for (const written &w : list) {
        ASSERT_EQ(clay_write(&c, w.at, std::nextafter(w.potential, 0.0f), w.rgba), STATUS_OK);
        ASSERT_NE(clay_digest(&c), wanted);
        ASSERT_EQ(clay_write(&c, w.at, w.potential, w.rgba ^ 0x80000000u), STATUS_OK);
        ASSERT_NE(clay_digest(&c), wanted);
        ASSERT_EQ(clay_write(&c, w.at, 0, 0), STATUS_OK);
        ASSERT_NE(clay_digest(&c), wanted);
        ASSERT_EQ(clay_write(&c, w.at, w.potential, w.rgba), STATUS_OK);
        ASSERT_EQ(clay_digest(&c), wanted);
    }
    clay_finish(&c);
}

TEST(clay_digest, sees_where_the_clay_is)
{
    std::vector<uint64_t> seen;
    for (const key &at : {key{0, 0, 0}, key{8, 0, 0}, key{0, 8, 0}, key{0, 0, 8}, key{-8, 0, 0}, key{0, 0, 1}}) {
        clay c;
        ASSERT_EQ(clay_init(&c, 10), STATUS_OK);
        ASSERT_EQ(clay_write(&c, at, 2, 7), STATUS_OK);
        seen.push_back(clay_digest(&c));
        clay_finish(&c);
    }
    std::sort(seen.begin(), seen.end());
    EXPECT_EQ(std::unique(seen.begin(), seen.end()), seen.end());
}

TEST(clay_digest, does_not_see_an_open_empty_brick)
{
    clay c;
    ASSERT_EQ(clay_init(&c, 10), STATUS_OK);
    uint32_t id;
    const brick_mask none = {{0}};
    ASSERT_EQ(clay_brick_open(&c, {3, 3, 3}, &id), STATUS_OK);
    ASSERT_EQ(clay_brick_close(&c, id, &none), STATUS_OK);
    EXPECT_EQ(clay_brick_count(&c), 1u);
    EXPECT_EQ(clay_digest(&c), 0u);
    clay_finish(&c);
}

} // namespace
