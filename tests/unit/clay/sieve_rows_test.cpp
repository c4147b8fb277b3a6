/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: sifting finds every corner there is to find, and takes the words of a mask in order, with all vectors alike.
 * Method: seeded pages and masks, from none to all, against one corner after another; bits that floats do not tell
 *         apart (-0, NaN) among them. */
#include "clay/sieve_rows.h"

#include "clay/potential.h"
#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

namespace {

class sieve_rows : public testing::TestWithParam<lanes> {
protected:
    void SetUp() override
    {
        if (!lanes_are_here(GetParam()))
            GTEST_SKIP() << lanes_name(GetParam()) << " is not here";
    }
    brick_page page(double density)
    {
        brick_page p = {};
        for (int n = 0; n < BRICK_CORNERS; n++)
            if (seeded_chance(chance, density)) {
                p.potential[n] = static_cast<float>(seeded_real(chance, 0.001, 3));
                p.rgba[n] = static_cast<uint32_t>(seeded_bits(chance));
            }
        return p;
    }
    brick_mask mask(double density)
    {
        brick_mask m = {{0}};
        for (int n = 0; n < BRICK_CORNERS; n++)
            if (seeded_chance(chance, density))
                brick_mask_set(&m, n);
        return m;
    }
    seeded chance = {7};
};

const double DENSITIES[] = {0, 0.01, 0.3, 0.5, 0.97, 1};

TEST_P(sieve_rows, changed_sees_every_bit)
{
    for (const double density : DENSITIES) {
        const brick_page a = page(0.7);
        brick_page b = a;
        const brick_mask wanted = mask(density);
        for (int n = 0; n < BRICK_CORNERS; n++) {
            if (!brick_mask_has(&wanted, n))
                continue;
            uint32_t bits;
            std::memcpy(&bits, &b.potential[n], sizeof bits);
            bits ^= n % 3 == 0 ? 0x80000000u : n % 3 == 1 ? 1u : 0u; /* the sign of a zero counts too */
            std::memcpy(&b.potential[n], &bits, sizeof bits);
            b.rgba[n] ^= n % 3 == 2 ? 1u << n % 32 : 0u;
        }
        brick_mask found;
        EXPECT_EQ(sieve_rows_changed(&a, &b, &found, GetParam()), brick_mask_count(&wanted));
        EXPECT_EQ(std::memcmp(&found, &wanted, sizeof wanted), 0) << density;
    }
    brick_page a = page(1), b = a;
    a.potential[5] = b.potential[5] = std::nanf("");
    brick_mask found;
    EXPECT_EQ(sieve_rows_changed(&a, &b, &found, GetParam()), 0u) << "the same bits, though no number";
}

TEST_P(sieve_rows, stored_are_those_above_the_minimum)
{
    for (const double density : DENSITIES) {
        brick_page p = page(density);
        p.potential[3] = -0.0f;
        brick_mask wanted = {{0}}, found;
        for (int n = 0; n < BRICK_CORNERS; n++)
            if (p.potential[n] > POTENTIAL_MIN)
                brick_mask_set(&wanted, n);
        EXPECT_EQ(sieve_rows_stored(&p, &found, GetParam()), brick_mask_count(&wanted));
        EXPECT_EQ(std::memcmp(&found, &wanted, sizeof wanted), 0) << density;
    }
}

TEST_P(sieve_rows, taken_are_the_words_of_the_mask_in_order)
{
    for (const double density : DENSITIES) {
        const brick_page p = page(1);
        const brick_mask m = mask(density);
        const uint32_t count = brick_mask_count(&m);
        std::vector<uint8_t> to(4 * count + SIEVE_ROWS_SLACK_BYTES + 8, 0xcd);
        EXPECT_EQ(sieve_rows_take(to.data(), p.rgba, &m, GetParam()), to.data() + 4 * count);
        uint32_t taken = 0;
        for (int n = 0; n < BRICK_CORNERS; n++)
            if (brick_mask_has(&m, n)) {
                ASSERT_EQ(std::memcmp(to.data() + 4 * taken++, &p.rgba[n], 4), 0) << n;
            }
        for (size_t n = to.size() - 8; n < to.size(); n++)
            EXPECT_EQ(to[n], 0xcd) << "beyond the slack";
    }
}

INSTANTIATE_TEST_SUITE_P(each, sieve_rows, testing::Values(LANES_PLAIN, LANES_AVX2, LANES_AVX512));

} // namespace
