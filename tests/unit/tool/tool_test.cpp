/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a dab does all of its work or none of it; it works at the ends of the lattice; dabs apart do not care about
 *       their order; and what the actions promise over many dabs holds on real clay.
 * Method: each refusal with the digest before and after; many dabs in a row with the numbers derived for them. */
#include "tool/tool.h"

#include "clay/capacity.h"
#include "clay/reconstruct.h"
#include "tool/ellipsoid.h"
#include "tool/freeform.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace {

const action all_actions[ACTION_COUNT] = {ACTION_TOOTHPASTE,   ACTION_SOFT_ERASER, ACTION_ERASER, ACTION_PAINTER,
                                          ACTION_SOFT_PAINTER, ACTION_SMOOTH,      ACTION_STAMP,  ACTION_PRINT};

tool_dab dab_at(double x, double y, double z, double radius, double amount, uint64_t number = 0)
{
    return {{{x, y, z}, {{radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}}, amount, number};
}

class tool_dabs : public testing::Test {
protected:
    void SetUp() override
    {
        ASSERT_EQ(clay_init(&c, 4000), STATUS_OK);
        ASSERT_EQ(tool_scratch_init(&scratch, CAPACITY_DAB_BRICKS), STATUS_OK);
        ASSERT_EQ(ellipsoid_init(&ball, ELLIPSOID_WYVILL, 0.1), STATUS_OK);
    }
    void TearDown() override
    {
        tool_scratch_finish(&scratch);
        clay_finish(&c);
    }
    tool make(action kind, uint32_t rgba = 0xFF336699u)
    {
        return {ellipsoid_shape(&ball), kind, rgba, deform_default()};
    }
    status apply(const tool &t, const tool_dab &d)
    {
        const status s = tool_apply(&t, &d, &c, &scratch, &counts);
        dirt_clear(&c.dirty);
        return s;
    }
    void model(key middle, double radius)
    {
        seeded noise = {1};
        ASSERT_EQ(plain_clay_ball(&c, noise, middle, radius, 1), STATUS_OK);
        dirt_clear(&c.dirty);
    }
    void expect_refused(const tool &t, const tool_dab &d, status wanted)
    {
        const plain_clay before = plain_clay_of(&c);
        const uint64_t digest = clay_digest(&c);
        dirt_clear(&c.dirty);
        counts = {9, 9, 9, 9};
        EXPECT_EQ(tool_apply(&t, &d, &c, &scratch, &counts), wanted);
        EXPECT_EQ(plain_clay_difference(before, &c), "");
        EXPECT_EQ(clay_digest(&c), digest);
        EXPECT_TRUE(clay_is_valid(&c));
        EXPECT_EQ(dirt_count(&c.dirty), 0u);
        EXPECT_EQ(counts.visited + counts.computed + counts.dirtied + counts.bricks, 0u);
    }
    clay c;
    tool_scratch scratch;
    ellipsoid ball;
    tool_counts counts;
};

TEST_F(tool_dabs, of_bad_pose_are_refused)
{
    model({0, 0, 0}, 8);
    const double infinite = std::numeric_limits<double>::infinity();
    for (action a : all_actions) {
        for (double bad : {std::nan(""), infinite, -infinite}) {
            tool_dab d = dab_at(0, 0, 0, 5, 1);
            d.at.origin[1] = bad;
            expect_refused(make(a), d, STATUS_BAD_POSE);
            d = dab_at(0, 0, 0, 5, 1);
            d.at.axis[2][0] = bad;
            expect_refused(make(a), d, STATUS_BAD_POSE);
        }
        expect_refused(make(a), dab_at(0, 0, 0, 0, 1), STATUS_BAD_POSE);
        expect_refused(make(a), dab_at(0, 0, 0, 1e7, 1), STATUS_BAD_POSE);
        tool_dab flat = dab_at(0, 0, 0, 5, 1);
        for (int n = 0; n < 3; n++)
            flat.at.axis[1][n] = flat.at.axis[0][n];
        expect_refused(make(a), flat, STATUS_BAD_POSE);
    }
}

TEST_F(tool_dabs, of_bad_amount_or_action_are_refused)
{
    model({0, 0, 0}, 8);
    for (double bad : {-0.001, std::nan(""), std::numeric_limits<double>::infinity(), 1.1 * TOOL_AMOUNT_MAX})
        for (action a : all_actions)
            expect_refused(make(a), dab_at(0, 0, 0, 5, bad), STATUS_BAD_PARAMETER);
    for (int bad : {-1, static_cast<int>(ACTION_COUNT), 1000}) {
        tool t = make(ACTION_ERASER);
        static_assert(sizeof t.kind == sizeof bad);
        std::memcpy(&t.kind, &bad, sizeof bad); /* as damaged settings would; C++ may not say it any other way */
        expect_refused(t, dab_at(0, 0, 0, 5, 1), STATUS_BAD_PARAMETER);
    }
    EXPECT_EQ(apply(make(ACTION_TOOTHPASTE), dab_at(0, 0, 0, 5, TOOL_AMOUNT_MAX)), STATUS_OK);
    EXPECT_TRUE(clay_is_valid(&c));
}

TEST_F(tool_dabs, that_are_too_large_are_refused)
{
    model({0, 0, 0}, 8);
    expect_refused(make(ACTION_TOOTHPASTE), dab_at(0, 0, 0, 400, 1), STATUS_TOO_LARGE);
    tool_scratch_finish(&scratch);
    ASSERT_EQ(tool_scratch_init(&scratch, 3), STATUS_OK);
    expect_refused(make(ACTION_TOOTHPASTE), dab_at(0, 0, 0, 8, 1), STATUS_TOO_LARGE);
    EXPECT_EQ(apply(make(ACTION_TOOTHPASTE), dab_at(4, 4, 4, 2, 1)), STATUS_OK);
}

TEST_F(tool_dabs, beyond_the_lattice_are_refused)
{
    model({0, 0, 0}, 8);
    expect_refused(make(ACTION_TOOTHPASTE), dab_at(0, 0, 3e9, 5, 1), STATUS_OUT_OF_RANGE);
    expect_refused(make(ACTION_TOOTHPASTE), dab_at(KEY_MIN - 20.0, 0, 0, 5, 1), STATUS_OUT_OF_RANGE);
}

TEST_F(tool_dabs, at_the_ends_of_the_lattice_stay_inside)
{
    for (const key &corner : {key{KEY_MIN, KEY_MIN, KEY_MIN}, key{KEY_MAX, KEY_MAX, KEY_MAX}, key{KEY_MIN, 0, KEY_MAX}})
        for (action a : all_actions) {
            clay_clear(&c);
            ASSERT_EQ(apply(make(ACTION_TOOTHPASTE), dab_at(corner.i, corner.j, corner.k, 6, 3)), STATUS_OK);
            ASSERT_GT(c.corners, 50u);
            ASSERT_EQ(apply(make(a), dab_at(corner.i + 0.3, corner.j - 0.4, corner.k, 7, 1)), STATUS_OK);
            EXPECT_TRUE(clay_is_valid(&c));
            const box b = clay_box(&c);
            EXPECT_TRUE(box_is_empty(b) || (key_in_range(b.min) && key_in_range(b.max)));
        }
}

/* The dab reaches 27 bricks. Toothpaste and stamp fill them all, 26 of them new; smooth writes only the one with clay
   but marks all 27, and a clay has two marks a brick to give. */
TEST_F(tool_dabs, without_room_are_refused_whole)
{
    const tool_dab wide = dab_at(4, 4, 4, 11, 1);
    for (uint32_t limit = 1; limit <= 40; limit++)
        for (action a : {ACTION_TOOTHPASTE, ACTION_STAMP, ACTION_SMOOTH}) {
            clay_finish(&c);
            ASSERT_EQ(clay_init(&c, limit), STATUS_OK);
            ASSERT_EQ(clay_write(&c, {3, 3, 3}, 2, 9), STATUS_OK);
            dirt_clear(&c.dirty);
            clay_change_begin(&c);
            const plain_clay before = plain_clay_of(&c);
            if (limit < (a == ACTION_SMOOTH ? 14u : 27u)) {
                expect_refused(make(a), wide, STATUS_POOL_FULL);
            } else {
                EXPECT_EQ(apply(make(a), wide), STATUS_OK) << action_name(a) << " " << limit;
                EXPECT_EQ(counts.bricks, 27u);
            }
            clay_change_revert(&c);
            EXPECT_EQ(plain_clay_difference(before, &c), "");
        }
}

TEST_F(tool_dabs, again_and_again_in_one_place_never_run_out)
{
    clay_finish(&c);
    ASSERT_EQ(clay_init(&c, 8), STATUS_OK);
    clay_change_begin(&c);
    for (int n = 0; n < 200; n++)
        ASSERT_EQ(apply(make(all_actions[n % ACTION_COUNT]), dab_at(0, 0, 0, 6, 1)), STATUS_OK) << n;
    clay_change_end(&c);
}

TEST_F(tool_dabs, do_not_depend_on_what_the_scratch_held)
{
    seeded chance = {3};
    for (int n = 0; n < 60; n++) {
        clay_clear(&c);
        model({0, 0, 0}, 9);
        clay other;
        tool_scratch fresh;
        ASSERT_EQ(clay_init(&other, 4000), STATUS_OK);
        ASSERT_EQ(clay_copy(&other, &c), STATUS_OK);
        ASSERT_EQ(tool_scratch_init(&fresh, 1000), STATUS_OK);
        const tool t = make(all_actions[n % ACTION_COUNT]);
        const tool_dab d = dab_at(seeded_real(chance, -9, 9), seeded_real(chance, -9, 9), 0, 3 + n % 9, 0.7, 5);
        tool_counts of_other;
        ASSERT_EQ(tool_apply(&t, &d, &c, &scratch, &counts), STATUS_OK);
        ASSERT_EQ(tool_apply(&t, &d, &other, &fresh, &of_other), STATUS_OK);
        EXPECT_EQ(clay_digest(&c), clay_digest(&other));
        EXPECT_EQ(counts.dirtied, of_other.dirtied);
        tool_scratch_finish(&fresh);
        clay_finish(&other);
    }
}

/* A counted dab looks at all the air under the tool, another one only where clay can spread to: over blocks that end
   where bricks end, on the faces of the tool's box and far inside it, and at corners that touch by a point. */
TEST_F(tool_dabs, do_the_same_whether_counted_or_not)
{
    for (const action a : all_actions)
        for (const key block : {key{0, 0, 0}, key{-1, 2, 1}, key{4, 0, 0}}) {
            clay_clear(&c);
            for (int n = 0; n < 2; n++)
                for (int slot = 0; slot < BRICK_CORNERS; slot++)
                    ASSERT_EQ(clay_write(&c, {8 * (block.i + n) + (slot >> 6), 8 * (block.j + n) + (slot >> 3 & 7),
                                              8 * (block.k + n) + (slot & 7)}, 3, 9), STATUS_OK);
            clay other;
            ASSERT_EQ(clay_init(&other, 4000), STATUS_OK);
            ASSERT_EQ(clay_copy(&other, &c), STATUS_OK);
            const tool t = make(a);
            const tool_dab d = dab_at(4, 4, 4, 40, 0.7, 5);
            const uint32_t bricks = clay_brick_count(&c);
            ASSERT_EQ(tool_apply(&t, &d, &c, &scratch, &counts), STATUS_OK);
            ASSERT_EQ(tool_apply(&t, &d, &other, &scratch, nullptr), STATUS_OK);
            EXPECT_EQ(clay_digest(&c), clay_digest(&other)) << action_name(a);
            EXPECT_TRUE(clay_is_valid(&other));
            if (a == ACTION_SMOOTH) {
                EXPECT_GT(clay_brick_count(&c), bricks + 10) << "it spreads all round";
            }
            clay_finish(&other);
        }
}

TEST_F(tool_dabs, apart_do_not_care_about_their_order)
{
    for (action a : all_actions)
        for (action b : all_actions) {
            uint64_t digest[2];
            for (int order = 0; order < 2; order++) {
                clay_clear(&c);
                model({0, 0, 0}, 12);
                /* Boxes -9..-1 and 1..9: smoothing reads one step further, up to 0 from both sides. */
                const tool_dab first = dab_at(-5, 1, 2, 3.9, 0.5, 1), second = dab_at(5.1, 1, 2, 3.9, 0.5, 2);
                for (int n = 0; n < 2; n++)
                    ASSERT_EQ(n == order ? apply(make(a), first) : apply(make(b, 7), second), STATUS_OK);
                digest[order] = clay_digest(&c);
            }
            EXPECT_EQ(digest[0], digest[1]) << action_name(a) << " and " << action_name(b);
        }
}

/* n deposits of amount a: the surface lies where n a f(rho) = 1.5. The numbers solve that for Wyvill's f. */
TEST_F(tool_dabs, of_toothpaste_grow_as_derived)
{
    const struct {
        double total, rho;
    } derived[] = {{2, 0.334}, {3, 0.5}, {6, 0.665}, {12, 0.767}};
    const double radius = 60;
    for (const auto &want : derived) {
        clay_clear(&c);
        tool_dab d = dab_at(0, 0, 0, radius, want.total / 4);
        d.at.axis[1][1] = d.at.axis[2][2] = 2; /* a needle is enough to measure along */
        for (int n = 0; n < 4; n++)
            ASSERT_EQ(apply(make(ACTION_TOOTHPASTE), d), STATUS_OK);
        reconstruct r = reconstruct_begin(&c);
        double at = 0;
        while (reconstruct_potential(&r, at, 0, 0, nullptr) >= POTENTIAL_ISO)
            at += 0.01;
        EXPECT_NEAR(at / radius, want.rho, 0.002) << want.total;
    }
}

TEST_F(tool_dabs, of_soft_paint_arrive_exactly_and_never_leave_the_span)
{
    const uint32_t from = colour_pack(10, 250, 128, 255), to = colour_pack(200, 3, 127, 255);
    for (int n = 0; n < 512; n++) {
        const float potential = 0.5f + 2.5f * static_cast<float>(n) / 512;
        ASSERT_EQ(clay_write(&c, {n >> 6, n >> 3 & 7, n & 7}, potential, from), STATUS_OK);
    }
    plain_clay before = plain_clay_of(&c);
    for (uint64_t dab = 0; dab < 9000; dab++) {
        ASSERT_EQ(apply(make(ACTION_SOFT_PAINTER, to), dab_at(3.5, 3.5, 3.5, 9, 0.02, dab)), STATUS_OK);
        if (dab % 500)
            continue;
        for (const auto &[at, corner] : plain_clay_of(&c))
            for (int n = 0; n < 3; n++) {
                const unsigned lo = std::min(colour_channel(from, n), colour_channel(to, n));
                const unsigned hi = std::max(colour_channel(from, n), colour_channel(to, n));
                ASSERT_GE(colour_channel(corner.rgba, n), lo);
                ASSERT_LE(colour_channel(corner.rgba, n), hi);
            }
    }
    for (auto &[at, corner] : before)
        corner.rgba = to;
    EXPECT_EQ(plain_clay_difference(before, &c), "") << "every corner has the colour itself, and the clay its shape";
}

TEST_F(tool_dabs, of_print_make_nothing_out_of_nothing_and_stamps_do)
{
    ASSERT_EQ(apply(make(ACTION_PRINT), dab_at(0, 0, 0, 9, 1)), STATUS_OK);
    EXPECT_EQ(clay_brick_count(&c), 0u);
    EXPECT_GT(counts.dirtied, 0u) << "a contribution all the same";
    ASSERT_EQ(apply(make(ACTION_STAMP), dab_at(0, 0, 0, 9, 1)), STATUS_OK);
    EXPECT_GT(c.corners, 0u);
    clay_clear(&c);
    model({0, 0, 0}, 8);
    const plain_clay before = plain_clay_of(&c);
    ASSERT_EQ(apply(make(ACTION_PRINT), dab_at(7, 0, 0, 12, 1)), STATUS_OK);
    for (const auto &[at, corner] : plain_clay_of(&c))
        ASSERT_EQ(before.count(at), 1u);
}

TEST_F(tool_dabs, of_the_eraser_leave_nothing_inside)
{
    model({0, 0, 0}, 10);
    ASSERT_EQ(apply(make(ACTION_ERASER), dab_at(1, 2, 3, 6, 0)), STATUS_OK);
    for (const auto &[at, corner] : plain_clay_of(&c)) {
        const key k = plain_clay_untuple(at);
        const double d2 = (k.i - 1.0) * (k.i - 1.0) + (k.j - 2.0) * (k.j - 2.0) + (k.k - 3.0) * (k.k - 3.0);
        ASSERT_GE(d2, 36 * (1 - 1e-5));
    }
    ASSERT_EQ(apply(make(ACTION_ERASER), dab_at(0, 0, 0, 30, 0)), STATUS_OK);
    EXPECT_EQ(clay_brick_count(&c), 0u);
    EXPECT_TRUE(clay_is_valid(&c));
}

TEST_F(tool_dabs, with_a_tool_made_of_clay_are_not_changed_by_sculpting_on)
{
    model({0, 0, 0}, 5);
    freeform f;
    ASSERT_EQ(freeform_init(&f, &c), STATUS_OK);
    const tool t = {freeform_shape(&f), ACTION_TOOTHPASTE, 5, deform_default()};
    uint64_t digest[2];
    for (uint64_t &of : digest) {
        clay_clear(&c);
        ASSERT_EQ(apply(t, dab_at(50.5, 3, 3, 1.25, 1)), STATUS_OK);
        ASSERT_GT(c.corners, 0u);
        of = clay_digest(&c);
    }
    EXPECT_EQ(digest[0], digest[1]);
    /* In its own pose and with a unit amount it is its source, thinned to a third and times three again. */
    clay_clear(&c);
    ASSERT_EQ(apply(t, dab_at(f.middle[0], f.middle[1], f.middle[2], 1, 3)), STATUS_OK);
    for (const auto &[at, corner] : plain_clay_of(&f.copy))
        ASSERT_FLOAT_EQ(clay_read(&c, plain_clay_untuple(at), nullptr), corner.potential);
    EXPECT_EQ(c.corners, f.copy.corners);
    freeform_finish(&f);
}

} // namespace
