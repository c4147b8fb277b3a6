/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: between corners the field, its colour and its gradient are the tri-linear ones, across brick borders, at the
 *       ends of the lattice, and whatever the cursor was asked before.
 * Method: each answer against the eight-corner formula in doubles, on clay read one corner at a time. */
#include "clay/reconstruct.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

double eight_corners(double x, double y, double z, double (*corner)(const clay *, key), const clay *c)
{
    const double fx = std::floor(x), fy = std::floor(y), fz = std::floor(z);
    const key at = {static_cast<int32_t>(fx), static_cast<int32_t>(fy), static_cast<int32_t>(fz)};
    double sum = 0;
    for (int n = 0; n < 8; n++) {
        const double wx = n & 1 ? x - fx : 1 - (x - fx);
        const double wy = n & 2 ? y - fy : 1 - (y - fy);
        const double wz = n & 4 ? z - fz : 1 - (z - fz);
        sum += wx * wy * wz * corner(c, key_add(at, n & 1, n >> 1 & 1, n >> 2 & 1));
    }
    return sum;
}

double potential_of(const clay *c, key at) { return clay_read(c, at, nullptr); }
double stored_of(const clay *c, key at) { return clay_read(c, at, nullptr) > POTENTIAL_MIN; }

template <int channel> double colour_of(const clay *c, key at)
{
    uint32_t rgba;
    return clay_read(c, at, &rgba) > POTENTIAL_MIN ? colour_channel(rgba, channel) : 0;
}

template <int axis> double slope_of(const clay *c, key at)
{
    const key d = {axis == 0, axis == 1, axis == 2};
    return (clay_read(c, key_add(at, d.i, d.j, d.k), nullptr) - clay_read(c, key_add(at, -d.i, -d.j, -d.k), nullptr)) /
           2.0;
}

class reconstruct_field : public testing::Test {
protected:
    void SetUp() override
    {
        ASSERT_EQ(clay_init(&c, 1000), STATUS_OK);
        seeded noise = {1};
        ASSERT_EQ(plain_clay_ball(&c, noise, {-2, 3, 1}, 13, 2), STATUS_OK);
    }
    void TearDown() override { clay_finish(&c); }
    void expect_at(reconstruct *r, double x, double y, double z)
    {
        uint32_t rgba;
        ASSERT_NEAR(reconstruct_potential(r, x, y, z, &rgba), eight_corners(x, y, z, potential_of, &c), 2e-6);
        const double stored = eight_corners(x, y, z, stored_of, &c);
        double (*const channels[4])(const clay *, key) = {colour_of<0>, colour_of<1>, colour_of<2>, colour_of<3>};
        for (int n = 0; n < 4; n++) {
            const double wanted = stored > 0 ? eight_corners(x, y, z, channels[n], &c) / stored : 0;
            ASSERT_NEAR(colour_channel(rgba, n), wanted, 0.501) << x << " " << y << " " << z;
        }
        float gradient[3];
        reconstruct_gradient(r, x, y, z, gradient);
        ASSERT_NEAR(gradient[0], eight_corners(x, y, z, slope_of<0>, &c), 2e-6);
        ASSERT_NEAR(gradient[1], eight_corners(x, y, z, slope_of<1>, &c), 2e-6);
        ASSERT_NEAR(gradient[2], eight_corners(x, y, z, slope_of<2>, &c), 2e-6);
    }
    clay c;
    seeded chance = {2};
};

TEST_F(reconstruct_field, is_the_eight_corner_formula_everywhere)
{
    reconstruct r = reconstruct_begin(&c);
    for (int n = 0; n < 20000; n++)
        expect_at(&r, seeded_real(chance, -18, 14), seeded_real(chance, -13, 19), seeded_real(chance, -15, 17));
}

TEST_F(reconstruct_field, is_the_same_along_a_row_and_after_a_jump)
{
    reconstruct r = reconstruct_begin(&c);
    for (int n = 0; n < 3000; n++) {
        expect_at(&r, -2.3, 3.7, -20 + n / 75.0);
        if (n % 100 == 0)
            expect_at(&r, seeded_real(chance, -1e6, 1e6), 0.5, 0.5);
    }
}

TEST_F(reconstruct_field, at_a_corner_is_that_corner)
{
    reconstruct r = reconstruct_begin(&c);
    for (int n = 0; n < 3000; n++) {
        const key at = seeded_key(chance, -16, 16);
        uint32_t rgba, wanted;
        const float v = clay_read(&c, at, &wanted);
        ASSERT_EQ(reconstruct_potential(&r, at.i, at.j, at.k, &rgba), v);
        ASSERT_EQ(rgba, wanted);
        float gradient[3];
        reconstruct_corner_gradient(&r, at, gradient);
        ASSERT_EQ(gradient[0], static_cast<float>(slope_of<0>(&c, at)));
        ASSERT_EQ(gradient[1], static_cast<float>(slope_of<1>(&c, at)));
        ASSERT_EQ(gradient[2], static_cast<float>(slope_of<2>(&c, at)));
    }
}

TEST_F(reconstruct_field, one_colour_stays_that_colour)
{
    clay_clear(&c);
    const uint32_t colour = colour_pack(200, 1, 255, 63);
    for (int n = 0; n < 40; n++)
        ASSERT_EQ(clay_write(&c, seeded_key(chance, -3, 3), 1, colour), STATUS_OK);
    reconstruct r = reconstruct_begin(&c);
    for (int n = 0; n < 5000; n++) {
        uint32_t rgba;
        const float v = reconstruct_potential(&r, seeded_real(chance, -5, 5), seeded_real(chance, -5, 5),
                                              seeded_real(chance, -5, 5), &rgba);
        ASSERT_EQ(rgba, v > 0 ? colour : COLOUR_NONE);
    }
}

TEST_F(reconstruct_field, never_leaves_the_range)
{
    clay_clear(&c);
    for (int n = 0; n < 512; n++)
        ASSERT_EQ(clay_write(&c, {n >> 6, n >> 3 & 7, n & 7}, POTENTIAL_MAX, 1), STATUS_OK);
    reconstruct r = reconstruct_begin(&c);
    for (int n = 0; n < 200000; n++) {
        const float v = reconstruct_potential(&r, seeded_real(chance, 0, 7), seeded_real(chance, 0, 7),
                                              seeded_real(chance, 0, 7), nullptr);
        ASSERT_LE(v, POTENTIAL_MAX);
        ASSERT_GT(v, POTENTIAL_MAX - 2e-6f);
    }
}

TEST_F(reconstruct_field, reads_empty_beyond_the_lattice_and_nowhere)
{
    clay_clear(&c);
    ASSERT_EQ(clay_write(&c, {KEY_MAX, KEY_MAX, KEY_MAX}, 2, 7), STATUS_OK);
    ASSERT_EQ(clay_write(&c, {KEY_MIN, KEY_MIN, KEY_MIN}, 2, 7), STATUS_OK);
    reconstruct r = reconstruct_begin(&c);
    EXPECT_EQ(reconstruct_potential(&r, KEY_MAX, KEY_MAX, KEY_MAX, nullptr), 2);
    EXPECT_EQ(reconstruct_potential(&r, KEY_MAX - 0.5, KEY_MAX, KEY_MAX, nullptr), 1);
    EXPECT_EQ(reconstruct_potential(&r, KEY_MIN, KEY_MIN, KEY_MIN, nullptr), 2);
    EXPECT_EQ(reconstruct_potential(&r, KEY_MIN - 0.5, KEY_MIN, KEY_MIN, nullptr), 1);
    const double infinite = std::numeric_limits<double>::infinity();
    for (double bad : {infinite, -infinite, std::nan(""), 1e300, -1e300, 4e9, -4e9, KEY_MAX + 1.0, KEY_MIN - 2.0}) {
        uint32_t rgba = 5;
        float gradient[3] = {1, 1, 1};
        EXPECT_EQ(reconstruct_potential(&r, bad, 0, 0, &rgba), POTENTIAL_MIN);
        EXPECT_EQ(rgba, COLOUR_NONE);
        EXPECT_EQ(reconstruct_potential(&r, 0, bad, 0, nullptr), POTENTIAL_MIN);
        EXPECT_EQ(reconstruct_potential(&r, 0, 0, bad, nullptr), POTENTIAL_MIN);
        reconstruct_gradient(&r, bad, bad, bad, gradient);
        EXPECT_TRUE(gradient[0] == 0 && gradient[1] == 0 && gradient[2] == 0);
    }
}

} // namespace
