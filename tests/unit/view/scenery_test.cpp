/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the sphere map's formula and its inverse agree, and mean what a mirror ball seen from far means.
 * Method: seeded directions there and back; for an orthographic eye the place must be half the normal plus a half. */
#include "view/scenery.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

std::array<double, 3> unit(std::mt19937 *random)
{
    std::normal_distribution<double> n;
    std::array<double, 3> d = {n(*random), n(*random), n(*random)};
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (double &c : d)
        c /= length;
    return d;
}

TEST(scenery, directions_come_back)
{
    std::mt19937 random(1);
    for (int n = 0; n < 5000; n++) {
        const std::array<double, 3> d = unit(&random);
        if (d[2] < -0.999)
            continue; /* the whole rim is that direction */
        const std::array<double, 3> back = scenery_direction(scenery_place(d));
        for (size_t c = 0; c < 3; c++)
            ASSERT_NEAR(back[c], d[c], 1e-9);
    }
}

TEST(scenery, a_mirror_ball_seen_from_far_shows_the_map_itself)
{
    std::mt19937 random(2);
    for (int n = 0; n < 5000; n++) {
        std::array<double, 3> normal = unit(&random);
        normal[2] = std::abs(normal[2]);
        /* u = (0, 0, -1): r = u - 2 n (n.u) */
        const std::array<double, 3> r = {2 * normal[2] * normal[0], 2 * normal[2] * normal[1],
                                         2 * normal[2] * normal[2] - 1};
        const std::array<double, 2> place = scenery_place(r);
        ASSERT_NEAR(place[0], normal[0] / 2 + 0.5, 1e-9);
        ASSERT_NEAR(place[1], normal[1] / 2 + 0.5, 1e-9);
    }
}

TEST(scenery, the_middle_is_behind_the_viewer)
{
    EXPECT_EQ(scenery_place({0, 0, 1}), (std::array<double, 2>{0.5, 0.5}));
    const std::array<double, 3> corner = scenery_direction({0.01, 0.99});
    EXPECT_EQ(corner, (std::array<double, 3>{0, 0, -1})) << "beyond the rim the map goes on as the rim";
}

TEST(scenery, light_is_finite_everywhere_and_brightest_in_the_soft_boxes)
{
    std::mt19937 random(4);
    double most = 0;
    std::array<double, 3> brightest{};
    for (int n = 0; n < 20000; n++) {
        const std::array<double, 3> d = unit(&random);
        for (double c : scenery_light(SNAPSHOT_SCENERY_STUDIO, d)) {
            ASSERT_TRUE(std::isfinite(c));
            ASSERT_GT(c, 0);
            if (c > most) {
                most = c;
                brightest = d;
            }
        }
    }
    EXPECT_GT(most, 1) << "brighter than a screen: what a clear coat shows four hundredths of";
    EXPECT_LT(brightest[0], 0) << "the key stands left,";
    EXPECT_GT(brightest[1], 0) << "high,";
    EXPECT_GT(brightest[2], 0) << "on the viewer's side";
}

/* The light on a normal, from the nine coefficients. */
double falls_on(const std::array<std::array<float, 3>, SCENERY_COEFFICIENTS> &e, const scenery_vector &n)
{
    const double x = n[0], y = n[1], z = n[2];
    const double basis[SCENERY_COEFFICIENTS] = {0.282095,         0.488603 * y,     0.488603 * z,
                                                0.488603 * x,     1.092548 * x * y, 1.092548 * y * z,
                                                0.315392 * (3 * z * z - 1), 1.092548 * x * z,
                                                0.546274 * (x * x - y * y)};
    double sum = 0;
    for (size_t i = 0; i < SCENERY_COEFFICIENTS; i++)
        sum += static_cast<double>(e[i][0]) * basis[i];
    return sum;
}

/* Over pi, light of order 0 falls as it is, of order 1 by two thirds, of order 2 by a quarter: by hand, from the integral
   of cos^2 and of cos (3 cos^2 - 1) / 2 over a half sphere. */
TEST(scenery, matt_clay_receives_the_cosines_part_of_each_order)
{
    std::mt19937 random(3);
    const auto even = scenery_irradiance([](const scenery_vector &) { return scenery_vector{1, 1, 1}; });
    const auto slope = scenery_irradiance([](const scenery_vector &r) { return scenery_vector{1 + r[1], 0, 0}; });
    const auto saddle =
        scenery_irradiance([](const scenery_vector &r) { return scenery_vector{r[0] * r[2], 0, 0}; });
    for (int n = 0; n < 200; n++) {
        const scenery_vector d = unit(&random);
        ASSERT_NEAR(falls_on(even, d), 1, 2e-3);
        ASSERT_NEAR(falls_on(slope, d), 1 + 2.0 / 3 * d[1], 3e-3);
        ASSERT_NEAR(falls_on(saddle, d), 0.25 * d[0] * d[2], 3e-3);
    }
}

TEST(scenery, each_room_is_another_and_finite)
{
    std::mt19937 random(6);
    for (int n = 0; n < 2000; n++) {
        const scenery_vector d = unit(&random);
        for (int which = 0; which < SNAPSHOT_SCENERY_OWN; which++)
            for (double c : scenery_light(static_cast<snapshot_scenery>(which), d)) {
                ASSERT_TRUE(std::isfinite(c));
                ASSERT_GE(c, 0);
                ASSERT_LT(c, 20);
            }
    }
    const auto night = scenery_irradiance(
        [](const scenery_vector &r) { return scenery_light(SNAPSHOT_SCENERY_NIGHT, r); });
    const auto window = scenery_irradiance(
        [](const scenery_vector &r) { return scenery_light(SNAPSHOT_SCENERY_WINDOW, r); });
    EXPECT_LT(2 * night[0][2], window[0][2]) << "night is darker, and bluer than its lamp";
    EXPECT_GT(falls_on(window, {-0.8, 0.36, 0.46}), 1.5 * falls_on(window, {0.8, -0.36, -0.46}));
}

} // namespace
