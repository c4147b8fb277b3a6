/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: stamping in either reading leaves the clay where the tool's own surface passes through it: there def is 0.
 * Method: a slab stamped again and again. Corners exactly on the tool's surface: not one bit may change. Points on it
 *         between corners: one stamp changes the corners by a function g that is 0 on the tool's surface, so the
 *         tri-linear field changes there by no more than the error of interpolating g, which is at most
 *         1/8 (|g_xx| + |g_yy| + |g_zz|) for steps of one; the second derivatives are bounded from the polynomials. */
#include "clay/capacity.h"
#include "clay/reconstruct.h"
#include "tool/ellipsoid.h"
#include "tool/tool.h"

#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

/* Bounds, along any axis, of the slope of g = def(3 - 3 f(|x| / R)) and of its second derivative, which is
   def'' (v')^2 + def' v'': each factor at its worst. */
struct worst {
    double slope, bend;
};

worst worst_of(const deform &d, double radius)
{
    double slope = 0, bend = 0;
    const double lengths[3] = {d.s, d.m, d.r};
    for (int p = 0; p < 3; p++)
        for (int n = 0; n <= 1000; n++) {
            const double u = lengths[p] * n / 1000;
            slope = std::max(slope, std::fabs((3.0 * d.piece[p][0] * u + 2.0 * d.piece[p][1]) * u + d.piece[p][2]));
            bend = std::max(bend, std::fabs(6.0 * d.piece[p][0] * u + 2.0 * d.piece[p][1]));
        }
    double f1 = 0, f2 = 0; /* |f'|, and the larger of |f''| and |f' / rho| */
    for (int n = 0; n <= 1000; n++) {
        const double q = n / 1000.0 * (n / 1000.0), rho = n / 1000.0;
        const double over = -44.0 / 9 + 68.0 / 9 * q - 24.0 / 9 * q * q;
        f1 = std::max(f1, std::fabs(over * rho));
        f2 = std::max({f2, std::fabs(over), std::fabs(-44.0 / 9 + 204.0 / 9 * q - 120.0 / 9 * q * q)});
    }
    return {slope * 3 * f1 / radius, bend * 9 * f1 * f1 / (radius * radius) + slope * 3 * f2 / (radius * radius)};
}

struct slab {
    clay c;
    tool_scratch scratch;
    ellipsoid ball;
    tool t;
};

/* Constant 1.5 in |z| <= 10, so that neither end of the range clamps what is measured. */
void slab_init(slab &s, action kind, int reach)
{
    ASSERT_EQ(clay_init(&s.c, 4000), STATUS_OK);
    ASSERT_EQ(tool_scratch_init(&s.scratch, CAPACITY_DAB_BRICKS), STATUS_OK);
    ASSERT_EQ(ellipsoid_init(&s.ball, ELLIPSOID_WYVILL, 0.1), STATUS_OK);
    s.t = {ellipsoid_shape(&s.ball), kind, 5, deform_default()};
    for (int i = -reach; i <= reach; i++)
        for (int j = -reach; j <= reach; j++)
            for (int k = -10; k <= 10; k++)
                ASSERT_EQ(clay_write(&s.c, {i, j, k}, POTENTIAL_ISO, 9), STATUS_OK);
    dirt_clear(&s.c.dirty);
}

void slab_finish(slab &s)
{
    tool_scratch_finish(&s.scratch);
    clay_finish(&s.c);
}

void stamp(slab &s, double radius, double amount, int times)
{
    const tool_dab d = {{{0, 0, 0}, {{radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}}, amount, 0};
    for (int n = 0; n < times; n++) {
        tool_counts counts;
        ASSERT_EQ(tool_apply(&s.t, &d, &s.c, &s.scratch, &counts), STATUS_OK);
        dirt_clear(&s.c.dirty);
    }
}

class stamp_rim : public testing::TestWithParam<action> {};

TEST_P(stamp_rim, corners_on_the_tools_surface_keep_every_bit)
{
    slab s;
    ASSERT_NO_FATAL_FAILURE(slab_init(s, GetParam(), 20));
    /* Half of 20 steps: (10, 0, 0), (6, 8, 0), (0, -6, 8) ... lie exactly on the sphere where v_tool = iso. */
    ASSERT_NO_FATAL_FAILURE(stamp(s, 20, 1, 100));
    int on = 0;
    for (int i = -10; i <= 10; i++)
        for (int j = -10; j <= 10; j++)
            for (int k = -10; k <= 10; k++) {
                const int d2 = i * i + j * j + k * k;
                const float v = clay_read(&s.c, {i, j, k}, nullptr);
                if (d2 < 95) {
                    EXPECT_LT(v, POTENTIAL_ISO);
                }
                if (d2 > 105 && d2 < 150) {
                    EXPECT_GT(v, POTENTIAL_ISO);
                }
                /* Only where a square root of the sum is that of one float: the tool's potential is 1.5 to the bit. */
                if (d2 == 100 && (i == 0) + (j == 0) + (k == 0) == 2) {
                    EXPECT_EQ(v, POTENTIAL_ISO) << i << " " << j << " " << k;
                    on++;
                }
            }
    EXPECT_EQ(on, 6);
    slab_finish(s);
}

TEST_P(stamp_rim, points_on_the_tools_surface_move_no_more_than_interpolation_errs)
{
    const double radius = 40, amount = 0.01;
    const int times = 10;
    slab s;
    ASSERT_NO_FATAL_FAILURE(slab_init(s, GetParam(), 30));
    ASSERT_NO_FATAL_FAILURE(stamp(s, radius, amount, times));
    const deform d = deform_default();
    const worst g = worst_of(d, radius);
    double bend = times * amount * g.bend;
    if (GetParam() == ACTION_PRINT) /* 1.5 (1 + a def)^n, differentiated twice, def <= n */
        bend = 1.5 * std::pow(1 + amount * d.n, times) * (bend + times * amount * times * amount * g.slope * g.slope);
    const double bound = 3.0 / 8 * bend + times * 1e-6;
    ASSERT_LT(bound, 0.01) << "a bound worth having";
    reconstruct r = reconstruct_begin(&s.c);
    seeded chance = {1};
    double moved = 0, inside = 0;
    for (int n = 0; n < 20000; n++) {
        double m[3][3];
        seeded_rotation(chance, m);
        const double x = m[0][0] * radius / 2, y = m[1][0] * radius / 2, z = m[2][0] * radius / 2;
        if (std::fabs(z) > 9 || std::fabs(x) > 28 || std::fabs(y) > 28)
            continue;
        moved = std::max(moved, std::fabs(reconstruct_potential(&r, x, y, z, nullptr) - 1.5));
        inside = std::max(inside, 1.5 - reconstruct_potential(&r, x * 0.7, y * 0.7, z * 0.7, nullptr));
    }
    EXPECT_LE(moved, bound);
    EXPECT_GT(inside, 10 * bound) << "while inside the tool the clay did give way";
    slab_finish(s);
}

INSTANTIATE_TEST_SUITE_P(readings, stamp_rim, testing::Values(ACTION_STAMP, ACTION_PRINT),
                         [](const auto &which) { return std::string(action_name(which.param)); });

} // namespace
