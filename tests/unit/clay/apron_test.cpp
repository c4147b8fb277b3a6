/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: an apron holds, at every place, what clay_read answers for that corner, and nothing is written outside it.
 * Method: random clay over several bricks, stored and absent middles, both widths, guard values behind the arrays. */
#include "clay/apron.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <vector>

namespace {

void expect_apron(const clay *c, key at, int hi, bool with_colour)
{
    const int side = hi - APRON_LO + 1;
    const size_t corners = static_cast<size_t>(side * side * side);
    std::vector<float> potential(corners + 8, -7.0f);
    std::vector<uint32_t> rgba(corners + 8, 77u);
    uint32_t ids[BRICK_NEIGHBOURS];
    clay_neighbours(c, at, ids);
    apron_gather(c, ids, hi, potential.data(), with_colour ? rgba.data() : nullptr);
    const key first = key_of_brick(at);
    for (int di = APRON_LO; di <= hi; di++)
        for (int dj = APRON_LO; dj <= hi; dj++)
            for (int dk = APRON_LO; dk <= hi; dk++) {
                const size_t n = static_cast<size_t>(((di + 1) * side + dj + 1) * side + dk + 1);
                uint32_t wanted;
                ASSERT_EQ(potential[n], clay_read(c, key_add(first, di, dj, dk), &wanted)) << di << dj << dk;
                ASSERT_EQ(rgba[n], with_colour ? wanted : 77u);
            }
    for (size_t n = corners; n < corners + 8; n++) {
        ASSERT_EQ(potential[n], -7.0f);
        ASSERT_EQ(rgba[n], 77u);
    }
}

void expect_aprons(const clay *c, key middle)
{
    for (int i = -2; i <= 2; i++)
        for (int j = -2; j <= 2; j++)
            for (int k = -2; k <= 2; k++) {
                expect_apron(c, key_add(middle, i, j, k), 8, true);
                expect_apron(c, key_add(middle, i, j, k), 9, true);
                expect_apron(c, key_add(middle, i, j, k), 9, false);
            }
}

TEST(apron, is_what_single_reads_say)
{
    seeded chance = {1};
    for (double density : {0.02, 0.5}) {
        clay c;
        ASSERT_EQ(clay_init(&c, 200), STATUS_OK);
        for (int n = 0; n < 27 * 512 * density; n++)
            ASSERT_EQ(clay_write(&c, seeded_key(chance, -12, 11), static_cast<float>(seeded_real(chance, 0.1, 3)),
                                 static_cast<uint32_t>(seeded_bits(chance))),
                      STATUS_OK);
        expect_aprons(&c, {0, 0, 0});
        clay_finish(&c);
    }
}

/* Rows in the rectangle are those of the whole apron, all others as they were. */
void expect_rows(const clay *c, key at, int hi, apron_rows rows)
{
    const int side = hi - APRON_LO + 1;
    const size_t corners = static_cast<size_t>(side * side * side);
    std::vector<float> whole(corners), some(corners + 8, -7.0f);
    uint32_t ids[BRICK_NEIGHBOURS];
    clay_neighbours(c, at, ids);
    apron_gather(c, ids, hi, whole.data(), nullptr);
    apron_gather_rows(c, ids, hi, rows, some.data());
    for (int di = APRON_LO; di <= hi; di++)
        for (int dj = APRON_LO; dj <= hi; dj++)
            for (int dk = APRON_LO; dk <= hi; dk++) {
                const size_t n = static_cast<size_t>(((di + 1) * side + dj + 1) * side + dk + 1);
                const bool asked = di >= rows.from_i && di <= rows.to_i && dj >= rows.from_j && dj <= rows.to_j;
                ASSERT_EQ(some[n], asked ? whole[n] : -7.0f) << di << ' ' << dj << ' ' << dk;
            }
    for (size_t n = corners; n < corners + 8; n++)
        ASSERT_EQ(some[n], -7.0f);
}

TEST(apron, rows_are_gathered_where_asked_and_nowhere_else)
{
    seeded chance = {2};
    clay c;
    ASSERT_EQ(clay_init(&c, 200), STATUS_OK);
    for (int n = 0; n < 6000; n++)
        ASSERT_EQ(clay_write(&c, seeded_key(chance, -12, 19), static_cast<float>(seeded_real(chance, 0.1, 3)), 9),
                  STATUS_OK);
    for (int hi = 8; hi <= APRON_HI_MAX; hi++) {
        const auto end = [&] { return static_cast<int8_t>(seeded_int(chance, APRON_LO, hi)); };
        const int8_t last = static_cast<int8_t>(hi);
        for (key at : {key{0, 0, 0}, key{-2, 1, 0}, key{5, 5, 5}}) { /* amid clay, beside it, far from it */
            ASSERT_NO_FATAL_FAILURE(expect_rows(&c, at, hi, {APRON_LO, last, APRON_LO, last}));
            ASSERT_NO_FATAL_FAILURE(expect_rows(&c, at, hi, {3, 2, 0, 7})) << "none";
            ASSERT_NO_FATAL_FAILURE(expect_rows(&c, at, hi, {last, last, APRON_LO, APRON_LO})) << "one row";
            for (int n = 0; n < 60; n++)
                ASSERT_NO_FATAL_FAILURE(expect_rows(&c, at, hi, {end(), end(), end(), end()}));
        }
    }
    clay_finish(&c);
}

TEST(apron, works_at_the_ends_of_the_lattice)
{
    clay c;
    ASSERT_EQ(clay_init(&c, 200), STATUS_OK);
    ASSERT_EQ(clay_write(&c, {KEY_MIN, KEY_MIN, KEY_MIN}, 1, 1), STATUS_OK);
    ASSERT_EQ(clay_write(&c, {KEY_MAX, KEY_MAX, KEY_MAX}, 2, 2), STATUS_OK);
    expect_apron(&c, key_brick({KEY_MIN, KEY_MIN, KEY_MIN}), 9, true);
    expect_apron(&c, key_add(key_brick({KEY_MIN, KEY_MIN, KEY_MIN}), -1, -1, -1), 9, true);
    expect_apron(&c, key_brick({KEY_MAX, KEY_MAX, KEY_MAX}), 8, true);
    clay_finish(&c);
}

} // namespace
