/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: mixing is exact at its ends, never leaves the span between two colours, rounds up exactly as often as the
 *       fraction says, and depends on nothing but its arguments.
 * Method: every pair of channel values with the smallest, the largest and random thresholds; whole numbers computed
 *         here in long form; means over many corners and dabs against their expectation. */
#include "clay/colour.h"

#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

const float threshold_max = 1.0f - 0x1p-16f;
const std::vector<float> thresholds = {0.0f, 0x1p-16f, 0.25f, 0.5f, 0.99f, threshold_max};

uint32_t grey(unsigned v) { return colour_pack(v, v, v, v); }

TEST(colour_pack, puts_red_in_the_lowest_byte)
{
    const uint32_t c = colour_pack(1, 2, 3, 4);
    EXPECT_EQ(c, 0x04030201u);
    for (int n = 0; n < 4; n++)
        EXPECT_EQ(colour_channel(c, n), static_cast<unsigned>(n + 1));
}

TEST(colour_mix, with_weight_0_and_1_is_exact_for_every_pair)
{
    for (unsigned a = 0; a < 256; a++)
        for (unsigned b = 0; b < 256; b++)
            for (float t : thresholds) {
                ASSERT_EQ(colour_mix(grey(a), grey(b), 0, t), grey(a)) << a << " " << b << " " << t;
                ASSERT_EQ(colour_mix(grey(a), grey(b), 1, t), grey(b)) << a << " " << b << " " << t;
            }
}

TEST(colour_mix, never_leaves_the_span)
{
    seeded chance = {1};
    for (int n = 0; n < 2000000; n++) {
        const unsigned a = static_cast<unsigned>(seeded_int(chance, 0, 255));
        const unsigned b = static_cast<unsigned>(seeded_int(chance, 0, 255));
        const double w = seeded_chance(chance, 0.3) ? std::pow(10.0, seeded_real(chance, -12, 0))
                                                    : seeded_real(chance, 0, 1);
        const float t = seeded_chance(chance, 0.5) ? thresholds[seeded_bits(chance) % thresholds.size()]
                                                   : static_cast<float>(seeded_bits(chance) >> 48) * 0x1p-16f;
        const uint32_t m = colour_mix(colour_pack(a, b, 255, 0), colour_pack(b, a, 255, 0), static_cast<float>(w), t);
        ASSERT_GE(colour_channel(m, 0), std::min(a, b));
        ASSERT_LE(colour_channel(m, 0), std::max(a, b));
        ASSERT_GE(colour_channel(m, 1), std::min(a, b));
        ASSERT_LE(colour_channel(m, 1), std::max(a, b));
        ASSERT_EQ(colour_channel(m, 2), 255u);
        ASSERT_EQ(colour_channel(m, 3), 0u);
    }
}

/* But for the roundings of floats of that size. */
bool is_floor_of(double x, unsigned found)
{
    return found >= static_cast<unsigned>(x - 0x1p-15) && found <= static_cast<unsigned>(x + 0x1p-15);
}

TEST(colour_mix, channels_do_not_touch_each_other)
{
    const uint32_t from = colour_pack(255, 0, 255, 0), to = colour_pack(255, 255, 0, 0);
    for (float t : thresholds)
        for (float w : {0.001f, 0.3f, 0.999f}) {
            const uint32_t m = colour_mix(from, to, w, t);
            EXPECT_EQ(colour_channel(m, 0), 255u);
            EXPECT_TRUE(is_floor_of(255.0 * w + t, colour_channel(m, 1)));
            EXPECT_TRUE(is_floor_of(255.0 - 255.0 * w + t, colour_channel(m, 2)));
            EXPECT_EQ(colour_channel(m, 3), 0u);
        }
}

/* Over all 2^16 evenly spaced thresholds the mean is the mix itself. */
TEST(colour_mix, rounds_up_as_often_as_the_fraction_says)
{
    for (double w : {0.001, 0.1, 0.3333, 0.5, 0.9, 0.9999})
        for (unsigned b : {3u, 100u, 255u}) {
            double up = 0, down = 0;
            for (int n = 0; n < 65536; n++) {
                const float t = static_cast<float>(n) / 65536.0f;
                up += colour_channel(colour_mix(grey(0), grey(b), static_cast<float>(w), t), 0);
                down += colour_channel(colour_mix(grey(b), grey(0), static_cast<float>(w), t), 0);
            }
            EXPECT_NEAR(up / 65536, w * b, 2.0 / 65536 + 255e-7);
            EXPECT_NEAR(down / 65536, b - w * b, 2.0 / 65536 + 255e-7);
        }
}

TEST(colour_dither, is_in_range_and_repeats)
{
    seeded chance = {2};
    for (int n = 0; n < 100000; n++) {
        const key at = seeded_key(chance, INT32_MIN, INT32_MAX);
        const uint64_t dab = seeded_bits(chance);
        const float t = colour_dither(at, dab);
        ASSERT_GE(t, 0.0f);
        ASSERT_LE(t, threshold_max);
        ASSERT_EQ(t, colour_dither(at, dab));
    }
}

/* Even chance would leave each of 16 bins off by some sqrt(n / 16); this sequence must do better. */
void expect_even(const std::vector<float> &run)
{
    const double n = static_cast<double>(run.size());
    double mean = 0;
    int bins[16] = {};
    for (const float t : run) {
        mean += t / n;
        bins[static_cast<int>(t * 16)]++;
    }
    EXPECT_NEAR(mean, 0.5, 0.3 / std::sqrt(n));
    for (int b : bins)
        EXPECT_NEAR(b, n / 16, 0.5 * std::sqrt(n / 16));
}

TEST(colour_dither, is_even_over_dabs_at_one_corner_and_over_corners_of_one_dab)
{
    for (const key &at : {key{0, 0, 0}, key{-5, 17, 100000}}) {
        std::vector<float> dabs;
        for (uint64_t d = 0; d < 100000; d++)
            dabs.push_back(colour_dither(at, d));
        expect_even(dabs);
    }
    for (uint64_t dab : {0ull, 1ull, 1ull << 40}) {
        std::vector<float> along[3], all;
        for (int n = -50000; n < 50000; n++) {
            along[0].push_back(colour_dither({n, 3, -3}, dab));
            along[1].push_back(colour_dither({3, n, -3}, dab));
            along[2].push_back(colour_dither({3, -3, n}, dab));
        }
        for (int i = -20; i < 20; i++)
            for (int j = -20; j < 20; j++)
                for (int k = -20; k < 20; k++)
                    all.push_back(colour_dither({i, j, k}, dab));
        for (const std::vector<float> &run : {along[0], along[1], along[2], all})
            expect_even(run);
    }
}

TEST(colour_dither, differs_between_dabs)
{
    int same = 0;
    for (int i = 0; i < 1000; i++)
        same += colour_dither({i, 0, 0}, 7) == colour_dither({i, 0, 0}, 8);
    EXPECT_LE(same, 1);
}

/* What the dither is for: with plain rounding a weight of 1/1000 would never move an 8-bit channel at all. */
TEST(colour_mix, weak_mixing_arrives_exactly_and_stays)
{
    const uint32_t target = colour_pack(200, 3, 128, 255);
    uint32_t c = colour_pack(10, 250, 127, 0);
    uint64_t dab = 0, arrived = 0;
    for (; dab < 40000; dab++) {
        c = colour_mix(c, target, 0.001f, colour_dither({4, 5, 6}, dab));
        if (c == target && arrived == 0)
            arrived = dab;
        if (arrived) {
            ASSERT_EQ(c, target);
        }
    }
    EXPECT_GT(arrived, 1000u);
    EXPECT_LT(arrived, 30000u);
}

} // namespace
