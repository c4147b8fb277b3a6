/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: walking by addition reaches the points that transforming reaches, within the stated bound, for every frame that
 *       is admitted; and no brick is rejected that holds a corner inside.
 * Method: thousands of random frames (rotated, sheared, mirrored, flat, tiny, huge, far out) against a transform of its
 *         own: the 3 x 3 system solved in long doubles for every corner. */
#include "tool/walk.h"

#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

void nothing(const void *, const float *, const float *, const float *, float *potential, int n)
{
    std::fill(potential, potential + n, 0.0f);
}

using real = long double;

real determinant(const real a[3], const real b[3], const real c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* Cramer's rule: the p with origin + sum p[a] axis[a] = at. */
void solve(const frame &f, key at, real out[3])
{
    const real d[3] = {at.i - static_cast<real>(f.origin[0]), at.j - static_cast<real>(f.origin[1]),
                       at.k - static_cast<real>(f.origin[2])};
    real axis[3][3];
    for (int a = 0; a < 3; a++)
        for (int c = 0; c < 3; c++)
            axis[a][c] = f.axis[a][c];
    const real whole = determinant(axis[0], axis[1], axis[2]);
    out[0] = determinant(d, axis[1], axis[2]) / whole;
    out[1] = determinant(axis[0], d, axis[2]) / whole;
    out[2] = determinant(axis[0], axis[1], d) / whole;
}

struct kind {
    const char *name;
    double length_min, length_max, far, shear;
    int frames;
};

const kind kinds[] = {
    {"common", 0.8, 12, 100, 0.3, 3000},   {"tiny", 2 * FRAME_AXIS_MIN, 0.5, 100, 0.3, 2000},
    {"long", 0.5, 120, 100, 0, 60},        {"far", 0.8, 8, 2.1e9, 0.3, 1500},
    {"sheared", 0.8, 8, 100, 200, 200},
};

std::ostream &operator<<(std::ostream &out, const kind &k) { return out << k.name; }

frame random_frame(seeded &chance, const kind &k)
{
    frame f;
    double r[3][3];
    seeded_rotation(chance, r);
    const bool upright = seeded_chance(chance, 0.1), grid = seeded_chance(chance, 0.1);
    double shear = seeded_real(chance, -k.shear, k.shear);
    for (int a = 0; a < 3; a++) {
        const double length = std::exp(seeded_real(chance, std::log(k.length_min), std::log(k.length_max)));
        f.origin[a] = seeded_real(chance, -k.far, k.far);
        f.origin[a] = grid ? std::floor(f.origin[a]) : f.origin[a];
        const double mirror = seeded_chance(chance, 0.2) ? -1 : 1;
        for (int c = 0; c < 3; c++)
            f.axis[a][c] = mirror * length * (upright ? a == c : r[c][a]);
        /* Lean every later axis over the first: up to nearly flat. */
        for (int c = 0; c < 3 && a > 0; c++)
            f.axis[a][c] = f.axis[a][c] / (1 + std::fabs(shear)) + shear / (1 + std::fabs(shear)) * f.axis[0][c] * 0.5;
    }
    return f;
}

shape random_shape(seeded &chance)
{
    shape s = {nullptr, nothing, {-1, -1, -1}, {1, 1, 1}, false, false};
    if (seeded_chance(chance, 0.4))
        for (int a = 0; a < 3; a++) {
            s.lo[a] = seeded_real(chance, -2, 0.5);
            s.hi[a] = s.lo[a] + seeded_real(chance, 0.1, 2);
        }
    return s;
}

bool is_inside(const walk &w, const real p[3], real margin_steps)
{
    bool in = true;
    for (int a = 0; a < 3; a++) {
        const real margin = margin_steps * static_cast<real>(walk_bound(&w, a));
        in = in && p[a] > w.lo[a] + margin && p[a] < w.hi[a] - margin;
    }
    return in;
}

/* Corners that are surely inside, and those that may be. */
struct tally {
    uint64_t sure, may, found;
};

void expect_brick(const walk &w, const frame &f, key b, tally &t)
{
    const bool touched = walk_touches(&w, b);
    float start[3], q[3][8];
    walk_start(&w, b, start);
    for (int row = 0; row < BRICK_ROWS; row++) {
        walk_row(&w, start, row >> 3, row & 7, q[0], q[1], q[2]);
        const unsigned mask = walk_inside(&w, b, row >> 3, row & 7, q[0], q[1], q[2]);
        for (int n = 0; n < 8; n++) {
            const key at = key_add(key_of_brick(b), row >> 3, row & 7, n);
            real p[3];
            solve(f, at, p);
            const bool range = box_contains(w.corners, at);
            const bool sure = range && is_inside(w, p, 1), may = range && is_inside(w, p, -1);
            t.sure += sure;
            t.may += may;
            t.found += mask >> n & 1;
            ASSERT_TRUE(!sure || touched) << "a brick with a corner inside was rejected";
            ASSERT_TRUE(!(mask >> n & 1) || touched);
            ASSERT_TRUE(!sure || (mask >> n & 1));
            ASSERT_TRUE(may || !(mask >> n & 1));
            for (int a = 0; a < 3 && touched; a++)
                ASSERT_LE(std::fabs(static_cast<double>(p[a] - static_cast<real>(q[a][n]))), walk_bound(&w, a));
        }
    }
}

/* Every corner inside lies in the walked range: asked one step beyond it on each side. */
void expect_nothing_outside(const walk &w, const frame &f)
{
    const key lo = key_add(w.corners.min, -1, -1, -1), hi = key_add(w.corners.max, 1, 1, 1);
    key at;
    for (at.i = lo.i; at.i <= hi.i; at.i++)
        for (at.j = lo.j; at.j <= hi.j; at.j++)
            for (at.k = lo.k; at.k <= hi.k; at.k++) {
                if (box_contains(w.corners, at))
                    continue;
                real p[3];
                solve(f, at, p);
                ASSERT_FALSE(is_inside(w, p, 1));
            }
}

/* The range, counted from the eight corners of the oriented box. */
void expect_range(const walk &w, const frame &f)
{
    const int32_t lo[3] = {w.corners.min.i, w.corners.min.j, w.corners.min.k};
    const int32_t hi[3] = {w.corners.max.i, w.corners.max.j, w.corners.max.k};
    for (int c = 0; c < 3; c++) {
        real least = 1e30L, most = -1e30L;
        for (int n = 0; n < 8; n++) {
            real x = f.origin[c];
            for (int a = 0; a < 3; a++)
                x += static_cast<real>(f.axis[a][c]) * (n >> a & 1 ? w.hi[a] : w.lo[a]);
            least = std::min(least, x);
            most = std::max(most, x);
        }
        const real doubt = 1e-15L * (100 + std::fabs(least) + std::fabs(most)); /* where doubles may floor otherwise */
        ASSERT_TRUE(lo[c] >= std::floor(least - doubt) && lo[c] <= std::floor(least + doubt)) << "axis " << c;
        ASSERT_TRUE(hi[c] >= std::floor(most - doubt) && hi[c] <= std::floor(most + doubt)) << "axis " << c;
    }
}

void expect_walk(seeded &chance, const kind &k)
{
    const frame f = random_frame(chance, k);
    const shape s = random_shape(chance);
    walk w;
    ASSERT_EQ(walk_begin(&w, &f, &s), STATUS_OK) << k.name;
    ASSERT_EQ(w.visited, box_count(w.corners));
    ASSERT_NO_FATAL_FAILURE(expect_range(w, f)) << k.name;
    tally t = {0, 0, 0};
    key b;
    for (b.i = w.bricks.min.i; b.i <= w.bricks.max.i; b.i++)
        for (b.j = w.bricks.min.j; b.j <= w.bricks.max.j; b.j++)
            for (b.k = w.bricks.min.k; b.k <= w.bricks.max.k; b.k++)
                ASSERT_NO_FATAL_FAILURE(expect_brick(w, f, b, t)) << k.name;
    ASSERT_GE(w.visited, static_cast<double>(t.found));
    ASSERT_TRUE(t.sure <= t.found && t.found <= t.may);
    if (w.visited < 20000) {
        ASSERT_NO_FATAL_FAILURE(expect_nothing_outside(w, f)) << k.name;
    }
}

class walk_property : public testing::TestWithParam<kind> {};

TEST_P(walk_property, by_addition_is_by_transforming)
{
    seeded chance = {static_cast<uint64_t>(GetParam().frames)};
    const int frames = seeded_steps(GetParam().frames / 2);
    for (int n = 0; n < frames && !HasFatalFailure(); n++)
        expect_walk(chance, GetParam());
}

INSTANTIATE_TEST_SUITE_P(frames, walk_property, testing::ValuesIn(kinds),
                         [](const auto &which) { return std::string(which.param.name); });

/* As long and thin as one dab may be: addition must not drift along it. */
TEST(walk_needle, of_huge_axis_does_not_drift)
{
    const frame f = {{0.3, -0.2, 0.1}, {{3, 0.001, 0}, {0, 2.5, 0.0007}, {1, 2, 6e4}}};
    const shape s = {nullptr, nothing, {-1, -1, -1}, {1, 1, 1}, false, false};
    walk w;
    ASSERT_EQ(walk_begin(&w, &f, &s), STATUS_OK);
    tally t = {0, 0, 0};
    for (int32_t k = w.bricks.min.k; k <= w.bricks.max.k; k += 17)
        for (int32_t i = w.bricks.min.i; i <= w.bricks.max.i; i++)
            for (int32_t j = w.bricks.min.j; j <= w.bricks.max.j; j++)
                ASSERT_NO_FATAL_FAILURE(expect_brick(w, f, {i, j, k}, t));
    EXPECT_GT(t.found, 10000u);
}

} // namespace
