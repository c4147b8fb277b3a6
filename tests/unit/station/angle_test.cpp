/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: sine and cosine are right, so that hand-written degrees mean what they say. Method: long double reference. */
#include "station/angle.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

TEST(angle, agrees_with_long_double_over_many_turns)
{
    std::mt19937_64 random(1);
    for (int n = 0; n < 200000; n++) {
        double range = n % 2 ? 7.0 : 700.0;
        double x = std::uniform_real_distribution<double>(-range, range)(random);
        angle_pair p = angle_sincos(x);
        EXPECT_NEAR(p.sine, static_cast<double>(sinl(static_cast<long double>(x))), 3e-15);
        EXPECT_NEAR(p.cosine, static_cast<double>(cosl(static_cast<long double>(x))), 3e-15);
    }
}

TEST(angle, is_exact_where_it_should_be)
{
    EXPECT_EQ(angle_sincos(0).sine, 0);
    EXPECT_EQ(angle_sincos(0).cosine, 1);
    EXPECT_NEAR(angle_sincos(ANGLE_PI / 2).sine, 1, 1e-16);
    EXPECT_NEAR(angle_sincos(ANGLE_PI / 2).cosine, 6.1e-17, 1e-17);
    EXPECT_NEAR(angle_sincos(-ANGLE_PI).cosine, -1, 1e-16);
}
