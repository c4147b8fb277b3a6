/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: both profiles have the values, slopes and support that were derived for them.
 * Method: the numbers of Wyvill's kernel at 0, 1/2 and 1, its slope by differences, against its other algebraic form;
 *         the box-shaped one against its definition. */
#include "tool/ellipsoid.h"

#include "clay/potential.h"

#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

float at(const ellipsoid &e, double x, double y, double z)
{
    const shape s = ellipsoid_shape(&e);
    const float p[3] = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
    float v = -1;
    s.evaluate(s.self, &p[0], &p[1], &p[2], &v, 1);
    return v;
}

ellipsoid make(ellipsoid_profile profile, double border)
{
    ellipsoid e;
    EXPECT_EQ(ellipsoid_init(&e, profile, border), STATUS_OK);
    return e;
}

double wyvill(double rho)
{
    const double q = rho * rho;
    return 1 - 4.0 / 9 * q * q * q + 17.0 / 9 * q * q - 22.0 / 9 * q;
}

TEST(ellipsoid_wyvill, has_the_numbers_of_its_derivation)
{
    const ellipsoid e = make(ELLIPSOID_WYVILL, 0.1);
    EXPECT_EQ(at(e, 0, 0, 0), POTENTIAL_MAX);
    EXPECT_EQ(at(e, 0.5, 0, 0), POTENTIAL_ISO) << "its surface lies at half its influence, exactly";
    EXPECT_EQ(at(e, 0, -0.5, 0), POTENTIAL_ISO);
    EXPECT_EQ(at(e, 0, 0, 0.5), POTENTIAL_ISO);
    EXPECT_EQ(at(e, 1, 0, 0), 0);
    EXPECT_EQ(at(e, 0, 0, -1), 0);
    EXPECT_EQ(at(e, 0.8, 0.8, 0), 0);
    const double h = 1e-2;
    EXPECT_NEAR((at(e, 0.5 + h, 0, 0) - at(e, 0.5 - h, 0, 0)) / (2 * h), -19.0 / 12 * 3, 2e-3);
    EXPECT_NEAR((at(e, h, 0, 0) - at(e, 0, 0, 0)) / h, 0, 0.1);
    EXPECT_NEAR((at(e, 1, 0, 0) - at(e, 1 - h, 0, 0)) / h, 0, 0.1);
    /* Second derivative at the border 40/9: C1 there, no more. */
    EXPECT_NEAR(at(e, 1 - h, 0, 0) / (h * h), 3 * 40.0 / 9 / 2, 0.3);
}

TEST(ellipsoid_wyvill, is_the_polynomial_in_every_direction_and_falls)
{
    const ellipsoid e = make(ELLIPSOID_WYVILL, 0.1);
    seeded chance = {1};
    for (int n = 0; n < 20000; n++) {
        double r[3][3];
        seeded_rotation(chance, r);
        const double rho = seeded_real(chance, 0, 1.2);
        const double wanted = rho < 1 ? 3 * wyvill(rho) : 0;
        ASSERT_NEAR(at(e, r[0][0] * rho, r[1][0] * rho, r[2][0] * rho), wanted, 2e-6);
    }
    for (int n = 1; n <= 1000; n++)
        ASSERT_LT(at(e, n / 1000.0, 0, 0), at(e, (n - 1) / 1000.0, 0, 0));
}

TEST(ellipsoid_box, is_flat_then_a_smooth_step)
{
    for (double border : {1.0, 0.5, 0.1, ELLIPSOID_BORDER_MIN}) {
        const ellipsoid e = make(ELLIPSOID_BOX, border);
        EXPECT_EQ(at(e, 0, 0, 0), POTENTIAL_MAX);
        EXPECT_EQ(at(e, 0, 1, 0), 0);
        EXPECT_EQ(at(e, 0, 1.5, 0), 0);
        EXPECT_NEAR(at(e, 0, 0, 1 - border), POTENTIAL_MAX, 1e-4);
        for (int n = 0; n <= 1000; n++) {
            const double rho = n / 1000.0;
            const double q = std::fmin((1 - rho) / border, 1);
            ASSERT_NEAR(at(e, 0, rho, 0), 3 * (3 * q * q - 2 * q * q * q), 4.5 * 1.2e-7 / border + 1e-6);
        }
        if (border < 0.9) {
            EXPECT_EQ(at(e, 0.99 * (1 - border), 0, 0), POTENTIAL_MAX);
            EXPECT_NEAR(at(e, 0, 0, 1 - border / 2), POTENTIAL_ISO, 5e-4);
        }
    }
}

TEST(ellipsoid, stays_in_the_range_and_evaluates_blocks_as_points)
{
    seeded chance = {2};
    for (ellipsoid_profile profile : {ELLIPSOID_WYVILL, ELLIPSOID_BOX}) {
        const ellipsoid e = make(profile, 0.2);
        const shape s = ellipsoid_shape(&e);
        for (int round = 0; round < 500; round++) {
            float p[3][37], v[38];
            for (auto &axis : p)
                for (float &c : axis)
                    c = static_cast<float>(seeded_real(chance, -1.1, 1.1));
            v[37] = -5;
            s.evaluate(s.self, p[0], p[1], p[2], v, 37);
            for (int n = 0; n < 37; n++) {
                ASSERT_EQ(v[n], at(e, p[0][n], p[1][n], p[2][n]));
                ASSERT_TRUE(v[n] >= POTENTIAL_MIN && v[n] <= POTENTIAL_MAX);
            }
            ASSERT_EQ(v[37], -5);
        }
        for (int a = 0; a < 3; a++) {
            EXPECT_EQ(s.lo[a], -1);
            EXPECT_EQ(s.hi[a], 1);
        }
    }
}

TEST(ellipsoid, refuses_borders_outside_their_range)
{
    ellipsoid e;
    for (double bad : {0.0, -1.0, ELLIPSOID_BORDER_MIN / 2, 1.01, std::nan(""),
                       std::numeric_limits<double>::infinity()})
        EXPECT_EQ(ellipsoid_init(&e, ELLIPSOID_BOX, bad), STATUS_BAD_PARAMETER);
}

} // namespace
