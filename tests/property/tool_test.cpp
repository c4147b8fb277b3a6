/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a dab of any action, shape and pose does to the clay what the definitions say, counts what it visited, computed
 *       and dirtied, marks exactly what it dirtied, and touches nothing else.
 * Method: thousands of seeded dabs in a row; after each the walked box is compared, corner by corner, with plain_dab.h
 *         applied to the clay as it was, the rest at intervals; every invariant of the clay each time. */
#include "tool/freeform.h"
#include "tool/tool.h"
#include "tool/walk.h"

#include "tests/property/plain_dab.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

enum { BRICKS = 3000, REACH = 20 };

struct bench {
    clay c = {};
    plain_clay p;
    tool_scratch scratch = {};
    freeform forms[2] = {};
    plain_dab_shape plain_forms[2];
    ellipsoid ball = {};
    uint64_t number = 0;
    seeded chance;
};

void bench_init(bench &b, uint64_t seed)
{
    b.chance = {seed};
    ASSERT_EQ(clay_init(&b.c, BRICKS), STATUS_OK);
    ASSERT_EQ(tool_scratch_init(&b.scratch, BRICKS), STATUS_OK);
    for (int n = 0; n < 2; n++) {
        ASSERT_EQ(plain_clay_ball(&b.c, b.chance, {30 * n, -7, 3}, 4 + n, 2), STATUS_OK);
        ASSERT_EQ(clay_write(&b.c, {30 * n + 6, -7, 9 * n}, 3, 1), STATUS_OK);
        ASSERT_EQ(freeform_init(&b.forms[n], &b.c), STATUS_OK);
        b.plain_forms[n] = plain_dab_freeform(plain_clay_of(&b.c));
        clay_clear(&b.c);
    }
}

void bench_finish(bench &b)
{
    for (freeform &f : b.forms)
        freeform_finish(&f);
    tool_scratch_finish(&b.scratch);
    clay_finish(&b.c);
}

/* Both descriptions of one tool's shape. */
plain_dab_shape choose_shape(bench &b, tool &t)
{
    const int64_t which = seeded_int(b.chance, 0, 5);
    if (which >= 4) {
        t.form = freeform_shape(&b.forms[which - 4]);
        return b.plain_forms[which - 4];
    }
    const double border = seeded_real(b.chance, 0.05, 1);
    EXPECT_EQ(ellipsoid_init(&b.ball, which < 2 ? ELLIPSOID_WYVILL : ELLIPSOID_BOX, border), STATUS_OK);
    t.form = ellipsoid_shape(&b.ball);
    return plain_dab_ellipsoid(which >= 2, border);
}

deform choose_deform(seeded &chance)
{
    deform d;
    const double m = seeded_real(chance, 0.1, 1.0), r = seeded_real(chance, 0.1, 1.5 - m);
    if (deform_init(&d, 1.5, m, r, seeded_real(chance, 0, 1.5), seeded_real(chance, 0, 2)) != STATUS_OK)
        return deform_default();
    return d;
}

frame choose_frame(bench &b, plain_dab_form form)
{
    frame f;
    double r[3][3];
    seeded_rotation(b.chance, r);
    const bool upright = seeded_chance(b.chance, 0.15), grid = seeded_chance(b.chance, 0.15);
    for (int a = 0; a < 3; a++) {
        const double lo = form == PLAIN_DAB_FREEFORM ? 0.3 : 1, hi = form == PLAIN_DAB_FREEFORM ? 1.5 : 9;
        const double length = std::exp(seeded_real(b.chance, std::log(lo), std::log(hi)));
        f.origin[a] = seeded_real(b.chance, -REACH, REACH);
        f.origin[a] = grid ? std::floor(f.origin[a]) : f.origin[a];
        for (int c = 0; c < 3; c++)
            f.axis[a][c] = length * (upright ? a == c : r[c][a]) * (seeded_chance(b.chance, 0.05) ? 0.9 : 1);
    }
    return f;
}

double choose_amount(seeded &chance, action kind)
{
    if (kind == ACTION_SOFT_ERASER)
        return seeded_real(chance, 0, 1);
    return seeded_chance(chance, 0.1) ? 0 : seeded_chance(chance, 0.2) ? seeded_real(chance, 1, 5)
                                                                       : seeded_real(chance, 0, 1);
}

/* Where in tool space a corner lies, directly. */
void place(const frame &f, const double row[3][3], key at, double out[3])
{
    const double d[3] = {at.i - f.origin[0], at.j - f.origin[1], at.k - f.origin[2]};
    for (int a = 0; a < 3; a++)
        out[a] = row[a][0] * d[0] + row[a][1] * d[1] + row[a][2] * d[2];
}

struct limits {
    uint64_t computed_min, computed_max;
};

/* Does the tool reach the corner: surely, surely not, or could rounding decide? */
enum reach { INSIDE, OUTSIDE, BORDER };

reach reach_of(const walk &w, const double p[3])
{
    reach answer = INSIDE;
    for (int a = 0; a < 3; a++) {
        const double by = walk_bound(&w, a) + 1e-7;
        if (p[a] <= w.lo[a] - by || p[a] >= w.hi[a] + by)
            return OUTSIDE;
        if (p[a] <= w.lo[a] + by || p[a] >= w.hi[a] - by)
            answer = BORDER;
    }
    return answer;
}

bool is_marked(const clay &c, key at)
{
    const dirt_entry *dirty = clay_dirt(&c, key_brick(at));
    return dirty && brick_mask_has(&dirty->corners, key_slot(at));
}

/* Is there surely a contribution? Amounts of nothing count as none, except where an action asks no amount. */
bool surely_contributes(const tool &t, double amount, double v, double dv)
{
    if (v <= dv)
        return false;
    if (t.kind == ACTION_ERASER || t.kind == ACTION_PAINTER)
        return true;
    if (t.kind == ACTION_STAMP || t.kind == ACTION_PRINT)
        return std::min(amount, 1.0) * std::fabs(plain_dab_def(t.def, 3 - v)) >
               plain_dab_def_slope_max(t.def) * dv + 1e-4;
    return amount > 0;
}

bool surely_not(const tool &t, double amount, reach r, double v, const double p[3], const plain_dab_shape &shape)
{
    const bool beyond = shape.form != PLAIN_DAB_FREEFORM && p[0] * p[0] + p[1] * p[1] + p[2] * p[2] > 1.0001;
    const bool needs_amount = t.kind != ACTION_ERASER && t.kind != ACTION_PAINTER;
    return r == OUTSIDE || (v == 0 && beyond) || (amount == 0 && needs_amount);
}

void expect_corner(bench &b, const tool &t, const plain_dab_shape &shape, const tool_dab &d, const walk &w, key at,
                   limits &computed)
{
    double p[3];
    place(d.at, w.row, at, p);
    const double by[3] = {walk_bound(&w, 0) + 1e-9, walk_bound(&w, 1) + 1e-9, walk_bound(&w, 2) + 1e-9};
    const reach r = reach_of(w, p);
    const double v = r == OUTSIDE ? 0 : plain_dab_potential(shape, p), dv = plain_dab_slack(shape, by);
    computed.computed_min += r == INSIDE;
    computed.computed_max += r != OUTSIDE;
    plain_clay_corner found;
    found.potential = clay_read(&b.c, at, &found.rgba);
    const plain_clay_corner old = plain_clay_read(b.p, at);
    const bool same = found.potential == old.potential && found.rgba == old.rgba, marked = is_marked(b.c, at);
    const bool sure = r == INSIDE && surely_contributes(t, d.amount, v, dv);
    if (surely_not(t, d.amount, r, v, p, shape)) {
        ASSERT_TRUE(same) << "changed beyond the tool";
        ASSERT_FALSE(marked);
    } else if (sure || !same) {
        ASSERT_TRUE(!sure || marked);
        ASSERT_TRUE(same || marked) << "changed and not marked";
        const plain_dab_corner wanted = plain_dab_act(t, d.amount, b.p, at, v, dv);
        ASSERT_TRUE(plain_dab_is(wanted, found, colour_dither(at, d.number)))
            << "v " << v << " +- " << dv << ": " << old.potential << " became " << found.potential << " not "
            << wanted.potential << " +- " << wanted.slack << ", colour " << std::hex << old.rgba << " became "
            << found.rgba << std::dec << " not " << wanted.channel[0] << " " << wanted.channel[1] << " "
            << wanted.channel[2] << " " << wanted.channel[3] << " +- " << wanted.channel_slack;
    }
}

template <typename work_type> void each_corner(box all, work_type work)
{
    key at;
    for (at.i = all.min.i; at.i <= all.max.i; at.i++)
        for (at.j = all.min.j; at.j <= all.max.j; at.j++)
            for (at.k = all.min.k; at.k <= all.max.k; at.k++)
                work(at);
}

uint64_t marks(const clay &c)
{
    uint64_t all = 0;
    for (uint32_t n = 0; n < dirt_count(&c.dirty); n++)
        for (uint64_t slab : dirt_at(&c.dirty, n)->corners.slab)
            all += static_cast<uint64_t>(__builtin_popcountll(slab));
    return all;
}

void expect_dab(bench &b, const tool &t, const plain_dab_shape &shape, const tool_dab &d)
{
    walk w;
    tool_counts counts;
    dirt_clear(&b.c.dirty);
    ASSERT_EQ(walk_begin(&w, &d.at, &t.form), STATUS_OK);
    ASSERT_EQ(tool_apply(&t, &d, &b.c, &b.scratch, &counts), STATUS_OK);
    limits computed = {0, 0};
    each_corner(w.corners, [&](key at) {
        if (!testing::Test::HasFatalFailure())
            expect_corner(b, t, shape, d, w, at, computed);
    });
    ASSERT_FALSE(testing::Test::HasFatalFailure())
        << action_name(t.kind) << " amount " << d.amount << " form " << shape.form << " dab " << d.number;
    ASSERT_EQ(static_cast<double>(counts.visited), box_count(w.corners));
    ASSERT_TRUE(counts.visited >= counts.computed && counts.computed >= counts.dirtied);
    ASSERT_TRUE(counts.computed >= computed.computed_min && counts.computed <= computed.computed_max);
    ASSERT_EQ(counts.dirtied, marks(b.c)) << "marks outside the walked box, or too few";
    ASSERT_EQ(counts.bricks, dirt_count(&b.c.dirty));
    ASSERT_TRUE(clay_is_valid(&b.c));
    each_corner(w.corners, [&](key at) {
        uint32_t rgba;
        const float v = clay_read(&b.c, at, &rgba);
        plain_clay_write(b.p, at, v, rgba);
    });
    ASSERT_EQ(b.c.corners, b.p.size()) << "changed outside the walked box";
}

/* Mostly building, so that the other actions have something to work on. */
action choose_action(seeded &chance, size_t corners)
{
    static const action actions[] = {ACTION_TOOTHPASTE,   ACTION_SOFT_ERASER, ACTION_ERASER, ACTION_PAINTER,
                                     ACTION_SOFT_PAINTER, ACTION_SMOOTH,      ACTION_STAMP,  ACTION_PRINT};
    if (corners < 3000 && seeded_chance(chance, 0.5))
        return ACTION_TOOTHPASTE;
    if (corners > 20000 && seeded_chance(chance, 0.5))
        return ACTION_ERASER;
    return actions[seeded_int(chance, 0, ACTION_COUNT - 1)];
}

void run(uint64_t seed, int dabs)
{
    bench b;
    bench_init(b, seed);
    for (int n = 0; n < dabs && !testing::Test::HasFatalFailure(); n++) {
        tool t = {};
        t.kind = choose_action(b.chance, b.p.size());
        t.rgba = static_cast<uint32_t>(seeded_bits(b.chance));
        t.def = choose_deform(b.chance);
        const plain_dab_shape shape = choose_shape(b, t);
        const tool_dab d = {choose_frame(b, shape.form), choose_amount(b.chance, t.kind), b.number++};
        expect_dab(b, t, shape, d);
        if (n % 25 == 0) {
            ASSERT_EQ(plain_clay_difference(b.p, &b.c), "");
        }
    }
    EXPECT_EQ(plain_clay_difference(b.p, &b.c), "");
    bench_finish(b);
}

TEST(tool_property, dabs_do_what_the_definitions_say)
{
    for (uint64_t seed = 1; seed <= 4 && !HasFatalFailure(); seed++)
        run(seed, seeded_steps(400));
}

} // namespace
