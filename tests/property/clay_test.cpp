/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: after any sequence of writes, whole bricks, changes ended and changes reverted, clay is what a sorted map of
 *       corners is; and a frozen clay is what the map was.
 * Method: thousands of seeded steps on both; reads compared at every step, everything (corners, invariants, box, digest
 *         against a fresh copy) at intervals. */
#include "clay/freeze.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace {

struct pair {
    clay c;
    plain_clay p;
    std::optional<plain_clay> before; /* while a change is recorded */
    uint64_t digest_before;
    int reach;
    freeze frozen[2];
    std::optional<plain_clay> when_frozen[2];
};

float any_potential(seeded &chance)
{
    switch (seeded_int(chance, 0, 7)) {
    case 0: return 0;
    case 1: return -1;
    case 2: return 4;
    case 3: return std::nanf("");
    case 4: return POTENTIAL_MAX;
    default: return static_cast<float>(seeded_real(chance, 0, 3));
    }
}

void write_one(pair &x, seeded &chance)
{
    const key at = seeded_key(chance, -x.reach, x.reach);
    const float v = any_potential(chance);
    const uint32_t rgba = static_cast<uint32_t>(seeded_bits(chance));
    ASSERT_EQ(clay_write(&x.c, at, v, rgba), STATUS_OK);
    plain_clay_write(x.p, at, v, rgba);
}

/* As a dab does it: several bricks opened, written, closed, then pruned together. */
void write_bricks(pair &x, seeded &chance)
{
    const double density = seeded_real(chance, 0, 1);
    for (int n = static_cast<int>(seeded_int(chance, 1, 4)); n > 0; n--) {
        const key at = key_brick(seeded_key(chance, -x.reach, x.reach));
        uint32_t id;
        brick_mask dirtied = {{0}};
        ASSERT_EQ(clay_brick_open(&x.c, at, &id), STATUS_OK);
        for (int slot = 0; slot < BRICK_CORNERS; slot++) {
            if (!seeded_chance(chance, density))
                continue;
            const float v = density > 0.7 ? 0 : any_potential(chance);
            const uint32_t rgba = static_cast<uint32_t>(seeded_bits(chance));
            clay_brick(&x.c, id)->page->potential[slot] = v;
            clay_brick(&x.c, id)->page->rgba[slot] = rgba;
            brick_mask_set(&dirtied, slot);
            plain_clay_write(x.p, key_add(key_of_brick(at), slot >> 6, slot >> 3 & 7, slot & 7), v, rgba);
        }
        ASSERT_EQ(clay_brick_close(&x.c, id, &dirtied), STATUS_OK);
    }
    clay_prune(&x.c);
}

/* Full of one colour, of few: such bricks share pages. */
void fill_brick(pair &x, seeded &chance)
{
    static const brick_mask all = BRICK_MASK_ALL;
    const key at = key_brick(seeded_key(chance, -x.reach, x.reach));
    const uint32_t rgba = static_cast<uint32_t>(seeded_int(chance, 1, 3));
    uint32_t id;
    ASSERT_EQ(clay_brick_open(&x.c, at, &id), STATUS_OK);
    for (int slot = 0; slot < BRICK_CORNERS; slot++) {
        clay_brick(&x.c, id)->page->potential[slot] = POTENTIAL_MAX;
        clay_brick(&x.c, id)->page->rgba[slot] = rgba;
        plain_clay_write(x.p, key_add(key_of_brick(at), slot >> 6, slot >> 3 & 7, slot & 7), POTENTIAL_MAX, rgba);
    }
    ASSERT_EQ(clay_brick_close(&x.c, id, &all), STATUS_OK);
}

void freeze_or_end(pair &x, seeded &chance)
{
    const int64_t n = seeded_int(chance, 0, 1);
    if (!x.when_frozen[n]) {
        ASSERT_EQ(freeze_begin(&x.frozen[n], &x.c), STATUS_OK);
        x.when_frozen[n] = x.p;
        return;
    }
    ASSERT_EQ(plain_clay_difference(*x.when_frozen[n], &x.frozen[n].still), "");
    freeze_end(&x.frozen[n]);
    x.when_frozen[n].reset();
}

void begin_or_end(pair &x, seeded &chance)
{
    if (!x.before) {
        clay_change_begin(&x.c);
        x.before = x.p;
        x.digest_before = clay_digest(&x.c);
    } else if (seeded_chance(chance, 0.5)) {
        clay_change_end(&x.c);
        x.before.reset();
    } else {
        clay_change_revert(&x.c);
        x.p = *x.before;
        x.before.reset();
        ASSERT_EQ(clay_digest(&x.c), x.digest_before);
    }
}

void expect_same(const pair &x)
{
    ASSERT_EQ(plain_clay_difference(x.p, &x.c), "");
    ASSERT_TRUE(clay_is_valid(&x.c));
    box wanted = box_empty();
    for (const auto &[at, corner] : x.p)
        wanted = box_include(wanted, plain_clay_untuple(at));
    const box found = clay_box(&x.c);
    ASSERT_TRUE(key_equal(found.min, wanted.min) && key_equal(found.max, wanted.max));
    clay copy;
    ASSERT_EQ(clay_init(&copy, x.c.bricks.limit), STATUS_OK);
    ASSERT_EQ(clay_copy(&copy, &x.c), STATUS_OK);
    ASSERT_EQ(clay_digest(&copy), clay_digest(&x.c));
    clay_finish(&copy);
}

void run(uint64_t seed, int reach, int steps)
{
    seeded chance = {seed};
    pair x = {};
    x.reach = reach;
    ASSERT_EQ(clay_init(&x.c, 20000), STATUS_OK);
    for (int n = 0; n < steps && !testing::Test::HasFatalFailure(); n++) {
        const int64_t what = seeded_int(chance, 0, 99);
        if (what < 88)
            write_one(x, chance);
        else if (what < 90)
            fill_brick(x, chance);
        else if (what < 91)
            freeze_or_end(x, chance);
        else if (what < 98)
            write_bricks(x, chance);
        else
            begin_or_end(x, chance);
        const key at = seeded_key(chance, -reach, reach);
        uint32_t rgba;
        ASSERT_EQ(clay_read(&x.c, at, &rgba), plain_clay_read(x.p, at).potential);
        ASSERT_EQ(rgba, plain_clay_read(x.p, at).rgba);
        if (seeded_chance(chance, 0.01))
            dirt_clear(&x.c.dirty);
        if (n % 1000 == 0)
            expect_same(x);
    }
    expect_same(x);
    for (int n = 0; n < 2; n++)
        if (x.when_frozen[n])
            freeze_end(&x.frozen[n]);
    ASSERT_TRUE(clay_is_valid(&x.c));
    clay_finish(&x.c);
}

TEST(clay_property, is_a_sorted_map_of_corners_crowded)
{
    for (uint64_t seed = 1; seed <= 3; seed++)
        run(seed, 9, seeded_steps(8000));
}

TEST(clay_property, is_a_sorted_map_of_corners_scattered)
{
    for (uint64_t seed = 11; seed <= 12; seed++)
        run(seed, 60, seeded_steps(8000));
}

} // namespace
