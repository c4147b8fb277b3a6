/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a census counts what the paper counts: corners of the box, of these the ones inside the tool, of these the ones
 *       with a contribution; and the bricks these lie in.
 * Method: the same, corner by corner and one at a time: by the walk's own points for any frame; by transforming each
 *         corner where that is exact, so that nothing depends on how the walk finds its points. */
#include "tool/census.h"

#include "tool/ellipsoid.h"
#include "tool/freeform.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

namespace {

void each_corner(box all, const std::function<void(key)> &work)
{
    key at;
    for (at.i = all.min.i; at.i <= all.max.i; at.i++)
        for (at.j = all.min.j; at.j <= all.max.j; at.j++)
            for (at.k = all.min.k; at.k <= all.max.k; at.k++)
                work(at);
}

/* Counts corners as they are told. */
struct tally {
    uint64_t visited = 0, computed = 0, dirtied = 0;
    std::set<plain_clay_key> bricks;

    void add(const shape &form, const action_setting &set, key at, const float p[3])
    {
        visited++;
        for (int a = 0; a < 3; a++)
            if (!(p[a] > static_cast<float>(form.lo[a]) && p[a] < static_cast<float>(form.hi[a])))
                return;
        float v;
        form.evaluate(form.self, p, p + 1, p + 2, &v, 1);
        computed++;
        if (!action_contributes(&set, v))
            return;
        dirtied++;
        bricks.insert(plain_clay_tuple(key_brick(at)));
    }
};

void expect_counts(const tool_counts &found, const tally &wanted)
{
    EXPECT_EQ(found.visited, wanted.visited);
    EXPECT_EQ(found.computed, wanted.computed);
    EXPECT_EQ(found.dirtied, wanted.dirtied);
    EXPECT_EQ(found.bricks, wanted.bricks.size());
}

class census : public testing::Test {
protected:
    void SetUp() override
    {
        clay piece;
        ASSERT_EQ(ellipsoid_init(&wyvill, ELLIPSOID_WYVILL, 1), STATUS_OK);
        ASSERT_EQ(ellipsoid_init(&boxed, ELLIPSOID_BOX, 0.3), STATUS_OK);
        ASSERT_EQ(clay_init(&piece, 100), STATUS_OK);
        ASSERT_EQ(plain_clay_ball(&piece, chance, {3, -9, 40}, 4, 2), STATUS_OK);
        ASSERT_EQ(freeform_init(&free, &piece), STATUS_OK);
        clay_finish(&piece);
    }
    void TearDown() override { freeform_finish(&free); }
    shape form(int n) const { return n == 2 ? freeform_shape(&free) : ellipsoid_shape(n ? &boxed : &wyvill); }
    frame any_frame(double lo, double hi, double reach)
    {
        frame f;
        double r[3][3];
        seeded_rotation(chance, r);
        for (int a = 0; a < 3; a++) {
            const double length = std::exp(seeded_real(chance, std::log(lo), std::log(hi)));
            f.origin[a] = seeded_real(chance, -reach, reach);
            for (int c = 0; c < 3; c++)
                f.axis[a][c] = length * r[a][c] * (seeded_chance(chance, 0.1) ? 1.2 : 1);
        }
        return f;
    }

    seeded chance = {1};
    ellipsoid wyvill = {}, boxed = {};
    freeform free = {};
    deform def = deform_default();
};

TEST_F(census, is_a_count_corner_by_corner)
{
    uint64_t dirtied = 0, left_out = 0;
    for (int n = 0; n < 240; n++) {
        const shape s = form(n % 3);
        const action kind = static_cast<action>(n / 3 % ACTION_COUNT);
        const float amount = n % 7 == 0 ? 0.0f : n % 7 == 1 ? 1e-44f : static_cast<float>(seeded_real(chance, 0.01, 2));
        const action_setting set = {kind, 5, amount, &def, 0};
        const frame f = n % 3 == 2 ? any_frame(0.3, 1.5, 30) : any_frame(0.8, 11, 30);
        walk w;
        ASSERT_EQ(walk_begin(&w, &f, &s), STATUS_OK);
        tally wanted;
        each_corner(w.corners, [&](key at) {
            float start[3], x[8], y[8], z[8];
            walk_start(&w, key_brick(at), start);
            walk_row(&w, start, at.i & 7, at.j & 7, x, y, z);
            const float p[3] = {x[at.k & 7], y[at.k & 7], z[at.k & 7]};
            wanted.add(s, set, at, p);
        });
        expect_counts(census_take(&s, &set, &w), wanted);
        ASSERT_FALSE(HasFailure()) << action_name(kind) << ", shape " << n % 3 << ", amount " << amount;
        dirtied += wanted.dirtied;
        left_out += wanted.computed - wanted.dirtied;
    }
    EXPECT_GT(dirtied, 10000u);
    EXPECT_GT(left_out, 10000u);
}

/* Axes along the grid, of a power of two, and a middle in quarters: every corner's place in the tool is exact. */
TEST_F(census, is_the_transform_of_each_corner_where_that_is_exact)
{
    for (int n = 0; n < 120; n++) {
        const shape s = form(n % 2);
        const action_setting set = {static_cast<action>(n / 2 % ACTION_COUNT), 5, 0.5f, &def, 0};
        frame f = {};
        box all;
        int32_t *lo[3] = {&all.min.i, &all.min.j, &all.min.k}, *hi[3] = {&all.max.i, &all.max.j, &all.max.k};
        for (int a = 0; a < 3; a++) {
            const double length = static_cast<double>(1 << seeded_int(chance, 0, 4));
            f.origin[a] = static_cast<double>(seeded_int(chance, -200, 200)) / 4;
            f.axis[a][a] = seeded_chance(chance, 0.5) ? length : -length;
            *lo[a] = static_cast<int32_t>(std::floor(f.origin[a] - length));
            *hi[a] = static_cast<int32_t>(std::floor(f.origin[a] + length));
        }
        walk w;
        ASSERT_EQ(walk_begin(&w, &f, &s), STATUS_OK);
        tally wanted;
        each_corner(all, [&](key at) {
            const int32_t x[3] = {at.i, at.j, at.k};
            float p[3];
            for (int a = 0; a < 3; a++)
                p[a] = static_cast<float>((x[a] - f.origin[a]) / f.axis[a][a]);
            wanted.add(s, set, at, p);
        });
        expect_counts(census_take(&s, &set, &w), wanted);
        ASSERT_FALSE(HasFailure()) << n;
    }
}

TEST_F(census, leaves_out_what_lies_beyond_the_lattice)
{
    const shape s = form(0);
    const action_setting set = {ACTION_TOOTHPASTE, 5, 1, &def, 0};
    const frame f = {{KEY_MIN, 0, KEY_MAX}, {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}}};
    walk w;
    ASSERT_EQ(walk_begin(&w, &f, &s), STATUS_OK);
    tally wanted;
    each_corner({{KEY_MIN, -4, KEY_MAX - 4}, {KEY_MIN + 4, 4, KEY_MAX}}, [&](key at) {
        const float p[3] = {static_cast<float>((at.i - static_cast<double>(KEY_MIN)) / 4),
                            static_cast<float>(at.j) / 4,
                            static_cast<float>((at.k - static_cast<double>(KEY_MAX)) / 4)};
        wanted.add(s, set, at, p);
    });
    expect_counts(census_take(&s, &set, &w), wanted);
    EXPECT_EQ(wanted.visited, 225u);
}

} // namespace
