/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: corners are kept as written, clamped and removed by the rule; bricks come with the first corner, are linked to
 *       their neighbours, and go with the last one.
 * Method: by hand at awkward keys; the validator is shown every kind of damage. Long random runs are in
 *         tests/property/clay_test.cpp, running out of room in room_test.cpp. */
#include "clay/clay.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace {

class clay_piece : public testing::Test {
protected:
    void SetUp() override { ASSERT_EQ(clay_init(&c, 1000), STATUS_OK); }
    void TearDown() override { clay_finish(&c); }
    void write(key at, float potential, uint32_t rgba) { ASSERT_EQ(clay_write(&c, at, potential, rgba), STATUS_OK); }
    void expect_corner(key at, float potential, uint32_t rgba)
    {
        uint32_t found = 12345;
        EXPECT_EQ(clay_read(&c, at, &found), potential);
        EXPECT_EQ(found, rgba);
        EXPECT_EQ(clay_read(&c, at, nullptr), potential);
    }
    clay c;
};

const std::vector<int32_t> ends = {KEY_MIN, KEY_MIN + 7, -9, -8, -1, 0, 7, 8, KEY_MAX - 7, KEY_MAX};

TEST_F(clay_piece, absent_reads_as_empty)
{
    expect_corner({0, 0, 0}, POTENTIAL_MIN, COLOUR_NONE);
    expect_corner({INT32_MIN, INT32_MAX, -1}, POTENTIAL_MIN, COLOUR_NONE);
    write({5, 5, 5}, 1, 9);
    expect_corner({5, 5, 6}, POTENTIAL_MIN, COLOUR_NONE);
}

TEST_F(clay_piece, keeps_what_is_written_anywhere_in_the_lattice)
{
    plain_clay model;
    for (int32_t i : ends)
        for (int32_t j : ends)
            for (int32_t k : ends) {
                const float v = static_cast<float>(1 + model.size()) / 1024;
                write({i, j, k}, v, static_cast<uint32_t>(model.size()));
                plain_clay_write(model, {i, j, k}, v, static_cast<uint32_t>(model.size()));
            }
    EXPECT_EQ(c.corners, 1000u);
    for (const auto &[at, corner] : model)
        expect_corner(plain_clay_untuple(at), corner.potential, corner.rgba);
    EXPECT_EQ(plain_clay_difference(model, &c), "");
    EXPECT_TRUE(clay_is_valid(&c));
    const box b = clay_box(&c);
    EXPECT_TRUE(key_equal(b.min, {KEY_MIN, KEY_MIN, KEY_MIN}));
    EXPECT_TRUE(key_equal(b.max, {KEY_MAX, KEY_MAX, KEY_MAX}));
}

TEST_F(clay_piece, refuses_what_lies_beyond_the_lattice)
{
    write({0, 0, 0}, 1, 9);
    const uint64_t digest = clay_digest(&c);
    dirt_clear(&c.dirty);
    for (int32_t bad : {KEY_MIN - 1, KEY_MAX + 1, INT32_MIN, INT32_MAX}) {
        EXPECT_EQ(clay_write(&c, {bad, 0, 0}, 1, 1), STATUS_OUT_OF_RANGE);
        EXPECT_EQ(clay_write(&c, {0, bad, 0}, 1, 1), STATUS_OUT_OF_RANGE);
        EXPECT_EQ(clay_write(&c, {0, 0, bad}, 1, 1), STATUS_OUT_OF_RANGE);
        uint32_t id;
        EXPECT_EQ(clay_brick_open(&c, {bad, 0, 0}, &id), STATUS_OUT_OF_RANGE);
        EXPECT_EQ(clay_brick_open(&c, {0, bad >> 3, 0}, &id), STATUS_OUT_OF_RANGE);
    }
    EXPECT_EQ(clay_digest(&c), digest);
    EXPECT_EQ(dirt_count(&c.dirty), 0u);
    EXPECT_EQ(clay_brick_count(&c), 1u);
}

TEST_F(clay_piece, clamps_and_removes)
{
    const float infinite = std::numeric_limits<float>::infinity();
    for (float high : {3.0f, 3.0001f, 1e30f, infinite}) {
        write({1, 2, 3}, high, 9);
        expect_corner({1, 2, 3}, POTENTIAL_MAX, 9);
    }
    for (float low : {0.0f, -0.0f, -1e-30f, -5.0f, -infinite, std::numeric_limits<float>::quiet_NaN()}) {
        write({1, 2, 3}, 1, 9);
        write({1, 2, 3}, low, 9);
        expect_corner({1, 2, 3}, POTENTIAL_MIN, COLOUR_NONE);
        EXPECT_FALSE(std::signbit(clay_read(&c, {1, 2, 3}, nullptr)));
        EXPECT_EQ(c.corners, 0u);
        EXPECT_EQ(clay_brick_count(&c), 0u) << "the last corner takes its brick with it";
    }
    const float tiny = std::numeric_limits<float>::denorm_min();
    write({1, 2, 3}, tiny, 0);
    expect_corner({1, 2, 3}, tiny, 0);
    EXPECT_EQ(c.corners, 1u);
}

TEST_F(clay_piece, removing_nothing_makes_nothing_but_is_dirt)
{
    write({1, 2, 3}, 0, 9);
    EXPECT_EQ(clay_brick_count(&c), 0u);
    ASSERT_EQ(dirt_count(&c.dirty), 1u);
    EXPECT_TRUE(brick_mask_has(&dirt_at(&c.dirty, 0)->corners, key_slot({1, 2, 3})));
}

TEST_F(clay_piece, dirt_names_exactly_the_written_corner)
{
    write({-1, 9, 20}, 1, 9);
    ASSERT_EQ(dirt_count(&c.dirty), 1u);
    EXPECT_TRUE(key_equal(dirt_at(&c.dirty, 0)->at, {-1, 1, 2}));
    for (int slot = 0; slot < BRICK_CORNERS; slot++)
        EXPECT_EQ(brick_mask_has(&dirt_at(&c.dirty, 0)->corners, slot), slot == 7 * 64 + 1 * 8 + 4);
}

key of_index(int n) { return {n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1}; }

TEST_F(clay_piece, bricks_are_linked_whatever_the_order)
{
    seeded chance = {1};
    for (int round = 0; round < 20; round++) {
        std::vector<int> order(27);
        for (int n = 0; n < 27; n++)
            order[static_cast<size_t>(n)] = n;
        for (size_t n = 27; n > 1; n--)
            std::swap(order[n - 1], order[static_cast<size_t>(seeded_int(chance, 0, static_cast<int64_t>(n) - 1))]);
        for (int n : order) {
            const key b = of_index(n);
            write(key_add(key_of_brick(b), 3, 4, 5), 1, 9);
            ASSERT_TRUE(clay_is_valid(&c)); /* compares every link with a search */
        }
        const brick *middle = clay_brick(&c, clay_find(&c, {0, 0, 0}));
        for (int n = 0; n < 27; n++)
            ASSERT_EQ(middle->neighbour[n], clay_find(&c, of_index(n)));
        for (int n : order) {
            write(key_add(key_of_brick(of_index(n)), 3, 4, 5), 0, 9);
            ASSERT_TRUE(clay_is_valid(&c));
        }
        ASSERT_EQ(clay_brick_count(&c), 0u);
    }
}

TEST_F(clay_piece, neighbours_of_stored_and_absent_bricks_agree_with_searching)
{
    seeded chance = {2};
    for (int n = 0; n < 60; n++)
        write(seeded_key(chance, -30, 30), 1, 9);
    for (int i = -5; i <= 5; i++)
        for (int j = -5; j <= 5; j++)
            for (int k = -5; k <= 5; k++) {
                uint32_t ids[BRICK_NEIGHBOURS];
                clay_neighbours(&c, {i, j, k}, ids);
                for (int n = 0; n < 27; n++) {
                    const key d = of_index(n);
                    ASSERT_EQ(ids[n], clay_find(&c, {i + d.i, j + d.j, k + d.k}));
                }
            }
}

TEST_F(clay_piece, prune_takes_the_empty_and_leaves_the_rest)
{
    uint32_t full, empty;
    brick_mask all;
    for (uint64_t &slab : all.slab)
        slab = ~0ull;
    ASSERT_EQ(clay_brick_open(&c, {0, 0, 0}, &full), STATUS_OK);
    ASSERT_EQ(clay_brick_open(&c, {0, 0, 1}, &empty), STATUS_OK);
    clay_brick(&c, full)->page->potential[511] = 1;
    clay_brick(&c, empty)->page->potential[0] = -1;
    clay_brick(&c, empty)->page->rgba[0] = 5;
    ASSERT_EQ(clay_brick_close(&c, full, &all), STATUS_OK);
    ASSERT_EQ(clay_brick_close(&c, empty, &all), STATUS_OK);
    EXPECT_EQ(clay_brick_count(&c), 2u);
    EXPECT_FALSE(clay_is_valid(&c)) << "an empty brick stands";
    clay_prune(&c);
    EXPECT_EQ(clay_brick_count(&c), 1u);
    EXPECT_EQ(clay_find(&c, {0, 0, 1}), POOL_NONE);
    EXPECT_EQ(clay_brick(&c, full)->neighbour[brick_neighbour_index(0, 0, 1)], POOL_NONE);
    EXPECT_TRUE(clay_is_valid(&c));
    EXPECT_EQ(c.corners, 1u);
}

TEST_F(clay_piece, close_restores_the_invariant_on_all_corners)
{
    uint32_t id;
    ASSERT_EQ(clay_brick_open(&c, {-1, -1, -1}, &id), STATUS_OK);
    brick_page *p = clay_brick(&c, id)->page;
    for (int n = 0; n < BRICK_CORNERS; n++) {
        p->potential[n] = n % 4 == 0 ? 5.0f : n % 4 == 1 ? std::nanf("") : n % 4 == 2 ? -1.0f : 0.5f;
        p->rgba[n] = 7;
    }
    const brick_mask none = {{0}};
    ASSERT_EQ(clay_brick_close(&c, id, &none), STATUS_OK);
    for (int n = 0; n < BRICK_CORNERS; n++) {
        EXPECT_EQ(p->potential[n], n % 4 == 0 ? 3.0f : n % 4 == 3 ? 0.5f : 0.0f);
        EXPECT_EQ(p->rgba[n], n % 4 == 0 || n % 4 == 3 ? 7u : COLOUR_NONE);
    }
    EXPECT_EQ(c.corners, 256u);
    EXPECT_TRUE(clay_is_valid(&c));
}

TEST_F(clay_piece, copy_is_equal_and_apart)
{
    seeded chance = {3};
    ASSERT_EQ(plain_clay_ball(&c, chance, {-3, 5, 9}, 9, 1), STATUS_OK);
    clay_change_begin(&c);
    write({-3, 5, 9}, 0.5f, 3);
    clay copy;
    ASSERT_EQ(clay_init(&copy, clay_brick_count(&c)), STATUS_OK);
    ASSERT_EQ(clay_copy(&copy, &c), STATUS_OK);
    const uint64_t digest = clay_digest(&copy);
    EXPECT_EQ(digest, clay_digest(&c));
    EXPECT_TRUE(clay_is_valid(&copy));
    EXPECT_EQ(dirt_count(&copy.dirty), 0u);
    EXPECT_EQ(change_count(&copy.changes), 0u);
    clay_change_revert(&c);
    EXPECT_NE(clay_digest(&c), digest);
    EXPECT_EQ(clay_digest(&copy), digest) << "a copy is no link";
    clay_finish(&copy);
}

TEST_F(clay_piece, copy_into_too_little_room_leaves_it_empty)
{
    for (int n = 0; n < 5; n++)
        write({n * 8, 0, 0}, 1, 9);
    clay copy;
    ASSERT_EQ(clay_init(&copy, 4), STATUS_OK);
    EXPECT_EQ(clay_copy(&copy, &c), STATUS_POOL_FULL);
    EXPECT_EQ(clay_brick_count(&copy), 0u);
    EXPECT_EQ(clay_digest(&copy), 0u);
    clay_finish(&copy);
}

TEST_F(clay_piece, box_is_the_smallest_there_is)
{
    EXPECT_TRUE(box_is_empty(clay_box(&c)));
    seeded chance = {4};
    for (int round = 0; round < 50; round++) {
        clay_clear(&c);
        box wanted = box_empty();
        const int reach = static_cast<int>(seeded_int(chance, 1, 40));
        for (int n = 0; n < 1 + 4 * round; n++) {
            const key at = seeded_key(chance, -reach, reach);
            write(at, 1, 9);
            wanted = box_include(wanted, at);
        }
        const box b = clay_box(&c);
        ASSERT_TRUE(key_equal(b.min, wanted.min));
        ASSERT_TRUE(key_equal(b.max, wanted.max));
    }
}

TEST_F(clay_piece, clear_leaves_nothing_behind)
{
    clay_change_begin(&c);
    for (int n = 0; n < 50; n++)
        write({n * 3, -n, 5}, 1, 9);
    clay_clear(&c);
    EXPECT_EQ(clay_brick_count(&c), 0u);
    EXPECT_EQ(c.corners, 0u);
    EXPECT_EQ(dirt_count(&c.dirty), 0u);
    EXPECT_EQ(change_count(&c.changes), 0u);
    EXPECT_FALSE(c.changes.recording);
    EXPECT_EQ(clay_digest(&c), 0u);
    write({0, 0, 0}, 1, 9);
    expect_corner({0, 0, 1}, POTENTIAL_MIN, COLOUR_NONE); /* pages come from the pool used; they must come empty */
    EXPECT_TRUE(clay_is_valid(&c));
}

TEST_F(clay_piece, validator_sees_damage)
{
    write({0, 0, 0}, 1, 9);
    write({8, 0, 0}, 1, 9);
    ASSERT_TRUE(clay_is_valid(&c));
    brick *b = clay_brick(&c, clay_find(&c, {0, 0, 0}));
    const brick kept = *b;
    const brick_page page = *b->page;
    b->stored = 2;
    EXPECT_FALSE(clay_is_valid(&c));
    *b = kept;
    b->neighbour[brick_neighbour_index(1, 0, 0)] = POOL_NONE;
    EXPECT_FALSE(clay_is_valid(&c));
    *b = kept;
    b->at.i = 5;
    EXPECT_FALSE(clay_is_valid(&c));
    *b = kept;
    b->page->potential[0] = 3.5f;
    EXPECT_FALSE(clay_is_valid(&c));
    *b->page = page;
    b->page->potential[0] = std::nanf("");
    EXPECT_FALSE(clay_is_valid(&c));
    *b->page = page;
    b->page->rgba[5] = 1;
    EXPECT_FALSE(clay_is_valid(&c));
    *b->page = page;
    c.corners++;
    EXPECT_FALSE(clay_is_valid(&c));
    c.corners--;
    EXPECT_TRUE(clay_is_valid(&c));
}

/* --- which corners are inside: kept by every way of writing --- */

void expect_inside(const clay *c)
{
    avl_walk w;
    key at;
    uint32_t id;
    for (bool more = avl_first(&w, &c->tree, &at, &id); more; more = avl_next(&w, &at, &id)) {
        const brick *b = clay_brick(c, id);
        for (int n = 0; n < BRICK_CORNERS; n++)
            ASSERT_EQ(brick_mask_has(&b->inside, n), b->page->potential[n] >= POTENTIAL_ISO) << at.i << ' ' << n;
    }
}

const float round_iso[] = {0, 0.1f, std::nextafter(1.5f, 0.0f), 1.5f, std::nextafter(1.5f, 2.0f), 3, 7};

TEST_F(clay_piece, inside_follows_single_corners)
{
    seeded chance = {5};
    for (int n = 0; n < 1500; n++) {
        write(seeded_key(chance, -3, 3), round_iso[seeded_int(chance, 0, 6)], 9);
        if (n % 50 == 0) {
            ASSERT_NO_FATAL_FAILURE(expect_inside(&c));
        }
    }
    expect_inside(&c);
}

TEST_F(clay_piece, inside_follows_closing_copying_and_reverting)
{
    seeded chance = {6};
    const brick_mask all = BRICK_MASK_ALL;
    for (int round = 0; round < 20; round++) {
        if (round % 2)
            clay_change_begin(&c);
        for (int n = 0; n < 3; n++) {
            uint32_t id;
            ASSERT_EQ(clay_brick_open(&c, {n, round % 3, 0}, &id), STATUS_OK);
            for (int slot = 0; slot < BRICK_CORNERS; slot++)
                clay_brick(&c, id)->page->potential[slot] = round_iso[seeded_int(chance, 0, 6)];
            ASSERT_EQ(clay_brick_close(&c, id, &all), STATUS_OK);
        }
        clay_prune(&c);
        ASSERT_NO_FATAL_FAILURE(expect_inside(&c)) << "closed";
        clay copy;
        ASSERT_EQ(clay_init(&copy, 20), STATUS_OK);
        ASSERT_EQ(clay_copy(&copy, &c), STATUS_OK);
        ASSERT_NO_FATAL_FAILURE(expect_inside(&copy)) << "copied";
        clay_finish(&copy);
        if (round % 4 == 1)
            clay_change_revert(&c);
        else if (round % 4 == 3)
            clay_change_end(&c);
        ASSERT_NO_FATAL_FAILURE(expect_inside(&c)) << "reverted";
    }
}

TEST_F(clay_piece, validator_sees_a_wrong_inside)
{
    write({0, 0, 0}, 2, 9);
    write({0, 0, 1}, 1, 9);
    brick *b = clay_brick(&c, clay_find(&c, {0, 0, 0}));
    b->inside.slab[0] = 3;
    EXPECT_FALSE(clay_is_valid(&c));
    b->inside.slab[0] = 0;
    EXPECT_FALSE(clay_is_valid(&c));
    b->inside.slab[0] = 1;
    EXPECT_TRUE(clay_is_valid(&c));
}

/* --- what writers say that keep the invariant themselves --- */

TEST_F(clay_piece, settle_takes_the_brick_for_what_it_is_told)
{
    write({0, 0, 0}, 1, 9);
    write({0, 0, 1}, 2, 9);
    write({9, 9, 9}, 1, 9);
    const uint64_t digest = clay_digest(&c);
    dirt_clear(&c.dirty);
    uint32_t id;
    ASSERT_EQ(clay_brick_open(&c, {0, 0, 0}, &id), STATUS_OK);
    brick_page *p = clay_brick(&c, id)->page;
    ASSERT_EQ(clay_digest(&c), digest); /* known again, and out of date with the next line */
    p->potential[0] = 0;
    p->rgba[0] = COLOUR_NONE;
    p->potential[64] = 1.5f;
    p->potential[65] = 0.5f;
    p->rgba[1] = 10;
    clay_written now = {};
    now.stored = 3;
    now.inside.slab[0] = 2;
    now.inside.slab[1] = 1;
    now.dirtied.slab[0] = 3;
    now.dirtied.slab[1] = 3;
    now.moved.slab[0] = 1;
    now.moved.slab[1] = 3;
    clay_brick_settle(&c, id, &now);
    EXPECT_TRUE(clay_is_valid(&c));
    EXPECT_EQ(c.corners, 4u);
    EXPECT_NE(clay_digest(&c), digest);
    ASSERT_EQ(dirt_count(&c.dirty), 1u);
    const dirt_entry *e = clay_dirt(&c, {0, 0, 0});
    ASSERT_NE(e, nullptr);
    EXPECT_EQ(e->brick_id, id);
    for (int n = 0; n < BRICK_EDGE; n++) {
        EXPECT_EQ(e->corners.slab[n], now.dirtied.slab[n]);
        EXPECT_EQ(e->moved.slab[n], now.moved.slab[n]);
    }
    now.dirtied.slab[0] = now.moved.slab[0] = 4; /* marks are united, the rest is as told last */
    clay_brick_settle(&c, id, &now);
    EXPECT_EQ(e->corners.slab[0], 7u);
    EXPECT_EQ(e->moved.slab[0], 5u);
    EXPECT_EQ(c.corners, 4u);
}

TEST_F(clay_piece, settled_empty_bricks_are_pruned)
{
    write({0, 0, 0}, 1, 9);
    const uint32_t id = clay_find(&c, {0, 0, 0});
    clay_brick(&c, id)->page->potential[0] = 0;
    clay_brick(&c, id)->page->rgba[0] = COLOUR_NONE;
    clay_written now = {};
    now.dirtied.slab[0] = now.moved.slab[0] = 1;
    clay_brick_settle(&c, id, &now);
    EXPECT_EQ(c.corners, 0u);
    clay_prune(&c);
    EXPECT_EQ(clay_brick_count(&c), 0u);
    EXPECT_EQ(clay_digest(&c), 0u);
    EXPECT_TRUE(clay_is_valid(&c));
}

TEST_F(clay_piece, knows_on_which_sides_of_the_surface_a_brick_is)
{
    write({1, 2, 3}, 1, 9);
    brick *b = clay_brick(&c, clay_find(&c, {0, 0, 0}));
    EXPECT_FALSE(b->has_inside);
    EXPECT_TRUE(b->has_outside);
    write({1, 2, 3}, POTENTIAL_ISO, 9);
    EXPECT_TRUE(b->has_inside);
    EXPECT_TRUE(b->has_outside);
    for (int n = 0; n < BRICK_CORNERS; n++)
        write({n >> 6, n >> 3 & 7, n & 7}, 2, 9);
    EXPECT_TRUE(b->has_inside);
    EXPECT_FALSE(b->has_outside);
    EXPECT_TRUE(clay_is_valid(&c));
    for (bool *side : {&b->has_inside, &b->has_outside}) {
        *side = !*side;
        EXPECT_FALSE(clay_is_valid(&c));
        *side = !*side;
    }
}

size_t bytes_held(const clay &c)
{
    return pool_bytes(&c.bricks) + pool_bytes(&c.pages.of) + pool_bytes(&c.tree.nodes) + pool_bytes(&c.changes.images) +
           pool_bytes(&c.changes.index.nodes) + pool_bytes(&c.dirty.entries) + pool_bytes(&c.dirty.absent.nodes);
}

TEST_F(clay_piece, what_was_reserved_is_written_without_asking_the_machine)
{
    enum { MANY = 150 }; /* pages come 64 a slab */
    write({-800, 0, 0}, 1, 9);
    dirt_clear(&c.dirty);
    clay_change_begin(&c);
    clay_need need = {0, 0, 0, 0};
    for (int n = 0; n < MANY; n++)
        clay_need_add(&c, &need, {n, 0, 0}, POOL_NONE, CLAY_OPEN);
    clay_need_add(&c, &need, {-100, 0, 0}, clay_find(&c, {-100, 0, 0}), CLAY_OPEN);
    clay_need_add(&c, &need, {-1, 0, 0}, POOL_NONE, CLAY_MARK);
    EXPECT_EQ(need.bricks, uint64_t{MANY});
    EXPECT_EQ(need.pages, uint64_t{MANY + 1});
    EXPECT_EQ(need.images, uint64_t{MANY + 1});
    EXPECT_EQ(need.marks, uint64_t{MANY + 2});
    ASSERT_EQ(clay_reserve(&c, &need), STATUS_OK);
    const size_t held = bytes_held(c);
    for (int n = 0; n < MANY; n++)
        write({8 * n, 0, 0}, 1, 9);
    write({-800, 0, 0}, 2, 9);
    write({-8, 0, 0}, 0, 9); /* only marked */
    EXPECT_EQ(bytes_held(c), held);
    EXPECT_EQ(clay_brick_count(&c), uint32_t{MANY + 1});
    EXPECT_EQ(change_count(&c.changes), uint32_t{MANY + 1});
    EXPECT_EQ(dirt_count(&c.dirty), uint32_t{MANY + 2});
    for (int n = 0; n < MANY; n++) /* their entries move into the tree, which must have room too */
        write({8 * n, 0, 0}, 0, 9);
    EXPECT_EQ(bytes_held(c), held);
}

TEST_F(clay_piece, reserving_too_much_is_refused_and_changes_nothing)
{
    write({0, 0, 0}, 1, 9);
    const size_t held = bytes_held(c);
    for (const clay_need &need : {clay_need{1000, 0, 0, 0}, clay_need{0, 200000, 0, 0}, clay_need{0, 0, 1001, 0},
                                  clay_need{0, 0, 0, 3000}})
        EXPECT_EQ(clay_reserve(&c, &need), STATUS_POOL_FULL);
    EXPECT_EQ(bytes_held(c), held);
    EXPECT_EQ(clay_brick_count(&c), 1u);
    const clay_need last = {999, 1999, 1000, 0};
    EXPECT_EQ(clay_reserve(&c, &last), STATUS_OK);
}

} // namespace
