/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the deformation function is the corrected one: -1 at the centre, 0 with slope kappa on the tool's surface, the
 *       bulge n at its crest, 0 from its end on, continuous with its slope everywhere, and never an overshoot.
 * Method: values and slopes at the joints out of the stored coefficients in doubles and by finite differences, for
 *         thousands of admissible settings; the pieces against the formulas written out again. */
#include "tool/deform.h"

#include "clay/potential.h"

#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

struct setting {
    double m, r, n, kappa;
};

const double s = 1.5;

std::vector<setting> settings(int count)
{
    std::vector<setting> all = {{0.4, 0.9, 0.3, 1}, {0.5, 1.0, 0.3, 1}, {0.5, 0.8, 0.3, 1}, {0.1, 0.1, 0, 0},
                                {0.75, 0.75, 3, 2}, {0.5, 1.0, 0, 5}};
    seeded chance = {1};
    while (static_cast<int>(all.size()) < count) {
        const double m = seeded_real(chance, 0.05, 1.4), r = seeded_real(chance, 0.05, 1.45);
        if (s + m + r <= 3)
            all.push_back({m, r, seeded_real(chance, 0, 3), seeded_real(chance, 0, 4)});
    }
    return all;
}

deform make(const setting &t)
{
    deform d;
    EXPECT_EQ(deform_init(&d, s, t.m, t.r, t.n, t.kappa), STATUS_OK);
    return d;
}

double value(const float p[4], double u) { return ((p[0] * u + p[1]) * u + p[2]) * u + p[3]; }
double slope(const float p[4], double u) { return (3.0 * p[0] * u + 2.0 * p[1]) * u + p[2]; }
/* What rounding the coefficients to floats can do to a value, and to a slope. */
double slack(const float p[4], double u)
{
    const double cubic = std::fabs(p[0] * u * u * u), square = std::fabs(p[1] * u * u);
    return 2e-7 * (cubic + square + std::fabs(p[2] * u) + std::fabs(p[3])) + 1e-9;
}

TEST(deform, meets_its_values_and_slopes_at_every_joint)
{
    for (const setting &t : settings(3000)) {
        const deform d = make(t);
        const double kappa = d.kappa, tight = 6 / std::min({s, t.m, t.r});
        EXPECT_EQ(value(d.piece[0], 0), -1);
        EXPECT_EQ(slope(d.piece[0], 0), 0);
        EXPECT_NEAR(value(d.piece[0], s), 0, slack(d.piece[0], s));
        EXPECT_NEAR(slope(d.piece[0], s), kappa, slack(d.piece[0], s) * tight);
        EXPECT_EQ(value(d.piece[1], 0), 0);
        EXPECT_NEAR(slope(d.piece[1], 0), kappa, 1e-7 * (1 + kappa));
        EXPECT_NEAR(value(d.piece[1], t.m), t.n, slack(d.piece[1], t.m));
        EXPECT_NEAR(slope(d.piece[1], t.m), 0, slack(d.piece[1], t.m) * tight);
        EXPECT_NEAR(value(d.piece[2], 0), t.n, 1e-7 * (1 + t.n));
        EXPECT_EQ(slope(d.piece[2], 0), 0);
        EXPECT_NEAR(value(d.piece[2], t.r), 0, slack(d.piece[2], t.r));
        EXPECT_NEAR(slope(d.piece[2], t.r), 0, slack(d.piece[2], t.r) * tight);
    }
}

TEST(deform, at_is_exact_at_the_joints)
{
    for (const setting &t : settings(1000)) {
        const deform d = make(t);
        const float fs = static_cast<float>(s), fm = static_cast<float>(t.m), fr = static_cast<float>(t.r);
        EXPECT_EQ(deform_at(&d, 0), -1);
        EXPECT_EQ(deform_at(&d, fs), 0) << "the tool's surface must not drift, dab after dab";
        EXPECT_EQ(deform_at(&d, fs + fm), static_cast<float>(t.n));
        EXPECT_EQ(deform_at(&d, fs + fm + fr), 0);
    }
}

TEST(deform, at_is_continuous_with_its_slope)
{
    for (const setting &t : settings(300)) {
        const deform d = make(t);
        /* Largest second derivative over the pieces: how far two slopes h apart may differ. */
        double bend = 0;
        for (int p = 0; p < 3; p++) {
            const double length = p == 0 ? s : p == 1 ? t.m : t.r;
            const double first = 2.0 * d.piece[p][1], last = 6.0 * d.piece[p][0] * length + first;
            bend = std::max({bend, std::fabs(first), std::fabs(last)});
        }
        const double h = 1e-3;
        for (double joint : {s, s + t.m, s + t.m + t.r}) {
            const auto at = [&](double v) { return static_cast<double>(deform_at(&d, static_cast<float>(v))); };
            const double left = (at(joint) - at(joint - h)) / h, right = (at(joint + h) - at(joint)) / h;
            EXPECT_NEAR(left, right, bend * h * 1.2 + 4e-3) << "m " << t.m << " r " << t.r << " n " << t.n;
        }
    }
}

/* The corrected formulas once more, k = -kappa as printed. */
double written_out(const deform &d, double v)
{
    const double k = -d.kappa, m = d.m, r = d.r, n = d.n;
    if (v <= 0)
        return -1;
    if (v <= s)
        return -(s * k + 2) / (s * s * s) * v * v * v + (s * k + 3) / (s * s) * v * v - 1;
    if (v <= s + m) {
        const double u = v - s;
        return -(k * m + 2 * n) / (m * m * m) * u * u * u + (2 * k * m + 3 * n) / (m * m) * u * u - k * u;
    }
    if (v <= s + m + r) {
        const double u = v - s - m;
        return 2 * n / (r * r * r) * u * u * u - 3 * n / (r * r) * u * u + n;
    }
    return 0;
}

TEST(deform, at_is_the_corrected_formula)
{
    for (const setting &t : settings(300)) {
        const deform d = make(t);
        for (int n = -10; n <= 350; n++) {
            const float v = static_cast<float>(n) / 100;
            ASSERT_NEAR(deform_at(&d, v), written_out(d, v), 2e-6 * (1 + t.n) / std::min({1.0, t.m, t.r})) << v;
        }
    }
}

TEST(deform, never_overshoots)
{
    for (const setting &t : settings(1000)) {
        const deform d = make(t);
        float before = -1;
        for (int n = 0; n <= 3000; n++) {
            const float v = static_cast<float>(n) / 1000, f = deform_at(&d, v);
            ASSERT_GE(f, -1 - 1e-6f);
            ASSERT_LE(f, static_cast<float>(t.n) + 2e-6f * (1 + static_cast<float>(t.n)));
            if (v <= s + t.m) {
                ASSERT_GE(f, before - 4e-6f) << "rises up to the crest";
            } else if (v - 1e-3 > s + t.m) {
                ASSERT_LE(f, before + 4e-6f) << "falls after it";
            }
            ASSERT_TRUE(v >= s ? f >= -4e-6f : f <= 4e-6f) << "removes inside, adds outside";
            before = f;
        }
    }
}

TEST(deform, is_0_beyond_its_end)
{
    const deform d = make({0.4, 0.6, 0.3, 1});
    for (float v : {2.5f, 2.6f, 2.99f, 3.0f, 100.0f})
        EXPECT_EQ(deform_at(&d, v), 0);
    EXPECT_GT(deform_at(&d, 2.4f), 0);
}

TEST(deform, inside_the_centre_is_the_centre)
{
    const deform d = deform_default();
    for (float v : {0.0f, -1e-7f, -1.0f, -100.0f})
        EXPECT_EQ(deform_at(&d, v), -1);
}

TEST(deform, clamps_kappa)
{
    deform d;
    ASSERT_EQ(deform_init(&d, s, 0.5, 0.5, 3, 100), STATUS_OK);
    EXPECT_EQ(d.kappa, 3 / s);
    ASSERT_EQ(deform_init(&d, s, 0.5, 0.5, 0.1, 100), STATUS_OK);
    EXPECT_DOUBLE_EQ(d.kappa, 3 * 0.1 / 0.5);
    ASSERT_EQ(deform_init(&d, s, 0.5, 0.5, 0, 1), STATUS_OK);
    EXPECT_EQ(d.kappa, 0) << "without a bulge the curve cannot rise through the surface";
    ASSERT_EQ(deform_init(&d, s, 0.5, 0.5, 0.3, 0.25), STATUS_OK);
    EXPECT_EQ(d.kappa, 0.25);
}

TEST(deform, refuses_settings_outside_their_range)
{
    const double infinite = std::numeric_limits<double>::infinity(), none = std::nan("");
    const double good[5] = {s, 0.4, 0.9, 0.3, 1};
    deform d;
    ASSERT_EQ(deform_init(&d, good[0], good[1], good[2], good[3], good[4]), STATUS_OK);
    const deform kept = d;
    for (int which = 0; which < 5; which++)
        for (double bad : {none, infinite, -infinite, -0.1, -1e-300}) {
            double p[5];
            std::copy(good, good + 5, p);
            p[which] = bad;
            EXPECT_EQ(deform_init(&d, p[0], p[1], p[2], p[3], p[4]), STATUS_BAD_PARAMETER) << which << " " << bad;
        }
    EXPECT_EQ(deform_init(&d, 1.4, 0.4, 0.9, 0.3, 1), STATUS_BAD_PARAMETER) << "s is not free";
    EXPECT_EQ(deform_init(&d, s, 0, 0.9, 0.3, 1), STATUS_BAD_PARAMETER);
    EXPECT_EQ(deform_init(&d, s, 0.4, 0, 0.3, 1), STATUS_BAD_PARAMETER);
    EXPECT_EQ(deform_init(&d, s, 0.4, 1.2, 0.3, 1), STATUS_BAD_PARAMETER) << "would not be 0 at the border";
    EXPECT_EQ(deform_init(&d, s, 0.4, 0.9, 3.1, 1), STATUS_BAD_PARAMETER);
    for (int n = 0; n < 3; n++)
        for (int c = 0; c < 4; c++)
            EXPECT_EQ(d.piece[n][c], kept.piece[n][c]) << "a refusal wrote";
    EXPECT_EQ(deform_init(&d, s, 0.5, 1.0, 0.3, 1), STATUS_OK) << "exactly 3";
}

TEST(deform, of_the_narrowest_pieces_stays_finite)
{
    for (double narrow : {1e-3, 1e-6, 1e-8, 1e-20, 1e-300}) {
        deform d;
        ASSERT_EQ(deform_init(&d, s, narrow, 0.9, 0.3, 1), STATUS_OK);
        for (float v = 1.499f; v < 1.501f; v = std::nextafter(v, 2.0f))
            ASSERT_TRUE(deform_at(&d, v) >= -1 && deform_at(&d, v) <= 0.4f) << narrow << " " << v;
        ASSERT_EQ(deform_init(&d, s, 0.4, narrow, 0.3, 1), STATUS_OK);
        for (float v = 1.899f; v < 1.901f; v = std::nextafter(v, 2.0f))
            ASSERT_TRUE(deform_at(&d, v) >= -1e-4f && deform_at(&d, v) <= 0.4f) << narrow << " " << v;
    }
}

TEST(deform_default, is_what_its_header_says)
{
    const deform d = deform_default();
    EXPECT_EQ(d.s, POTENTIAL_MAX - POTENTIAL_ISO);
    EXPECT_EQ(d.m, 0.4);
    EXPECT_EQ(d.r, 0.9);
    EXPECT_EQ(d.n, 0.3);
    EXPECT_EQ(d.kappa, 1.0);
}

} // namespace
