/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a way takes the clay exactly from one state to the other, back and forth, whole or not at all.
 * Method: strokes of chance against a model that is not clay; legs laid from deltas of the same strokes; the last brick
 *         spoilt in every manner; full sculptures; bricks that one stretch leaves and the next comes back to. */
#include "history/route.h"

#include "clay/delta.h"
#include "clay/sieve_rows.h"
#include "history/byte_order.h"
#include "tests/unit/history/piece.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace {

using byte_string = std::vector<uint8_t>;

/* One stretch's bricks, and each of them alone. */
struct stretch {
    byte_string bytes;
    std::vector<size_t> at;
};

stretch bricks_of(const delta &d, lanes rows)
{
    stretch s;
    byte_string b(size_t{RECORD_BRICK_BYTES_MAX} + SIEVE_ROWS_SLACK_BYTES);
    for (uint32_t n = 0; n < d.count; n++) {
        const size_t took = record_put_brick(b.data(), d.bricks[n].at, d.bricks[n].old, d.bricks[n].now, rows);
        if (took == 0)
            continue;
        s.at.push_back(s.bytes.size());
        s.bytes.insert(s.bytes.end(), b.begin(), b.begin() + static_cast<std::ptrdiff_t>(took));
    }
    return s;
}

/* Does a stroke of several stretches; c is then behind it, nothing recorded, nothing dirty. */
struct done {
    uint64_t before = 0, after = 0;
    std::vector<stretch> stretches;
};

done do_stroke(clay *c, const std::vector<piece_stroke> &strokes)
{
    done all;
    delta d = {};
    all.before = clay_digest(c);
    clay_change_begin(c);
    for (const piece_stroke &s : strokes) {
        EXPECT_EQ(piece_write(c, s), STATUS_OK);
        EXPECT_EQ(delta_cut(&d, c), STATUS_OK);
        delta_sort(&d);
        all.stretches.push_back(bricks_of(d, c->rows));
        delta_give(&d, c);
        dirt_clear(&c->dirty);
    }
    clay_change_end(c);
    delta_finish(&d);
    all.after = clay_digest(c);
    return all;
}

struct routed {
    route r = {};
    ~routed() { route_finish(&r); }
    void add(const byte_string &b, uint32_t group)
    {
        uint8_t *own = static_cast<uint8_t *>(std::malloc(b.size()));
        if (!b.empty())
            std::memcpy(own, b.data(), b.size());
        ASSERT_EQ(route_add(&r, own, b.size(), group), STATUS_OK);
    }
    void add_stroke(const done &d)
    {
        uint32_t group = 0;
        for (const stretch &s : d.stretches)
            add(s.bytes, group++);
        r.digest_before = d.before;
        r.digest_after = d.after;
    }
    void turn()
    {
        route_reverse(&r, 0);
        std::swap(r.digest_before, r.digest_after);
    }
};

status go(const route &r, clay *c)
{
    dirt_clear(&c->dirty);
    const status s = route_apply(&r, c);
    if (s == STATUS_OK)
        clay_change_end(c);
    EXPECT_FALSE(c->changes.recording);
    EXPECT_TRUE(clay_is_valid(c));
    return s;
}

/* Two bricks, three corners. */
const piece_stroke two_bricks = {{{0, 0, 1}, 1.25f, 0x04030201}, {{0, 0, 9}, 2.5f, 0x08070605}, {{0, 0, 10}, 3, 0}};

TEST(route, back_and_forth_is_exact)
{
    piece_clay p;
    piece_model model;
    seeded chance = {11};
    for (int n = 0; n < 200; n++) {
        const piece_model before = model;
        std::vector<piece_stroke> strokes;
        for (int64_t more = seeded_int(chance, 1, 4); more > 0; more--) {
            strokes.push_back(piece_stroke_random(chance, 150));
            piece_write_model(model, strokes.back());
        }
        const done d = do_stroke(&p.c, strokes);
        routed way;
        way.add_stroke(d);
        way.turn();
        ASSERT_EQ(go(way.r, &p.c), STATUS_OK);
        ASSERT_NO_FATAL_FAILURE(piece_expect(&p.c, before));
        ASSERT_EQ(clay_digest(&p.c), d.before);
        way.turn();
        ASSERT_EQ(go(way.r, &p.c), STATUS_OK);
        ASSERT_NO_FATAL_FAILURE(piece_expect(&p.c, model));
        ASSERT_EQ(clay_digest(&p.c), d.after);
    }
    EXPECT_GT(model.size(), 100u);
}

TEST(route, reversing_turns_the_legs_from_there_on)
{
    routed way;
    for (uint32_t n = 0; n < 40; n++)
        way.add({static_cast<uint8_t>(n)}, n);
    route_reverse(&way.r, 37);
    route_reverse(&way.r, 0);
    route_reverse(&way.r, 40);
    std::vector<uint32_t> groups;
    for (uint32_t n = 0; n < way.r.count; n++) {
        EXPECT_EQ(way.r.legs[n].bricks[0], way.r.legs[n].group);
        groups.push_back(way.r.legs[n].group);
    }
    std::vector<uint32_t> expected = {37, 38, 39};
    for (uint32_t n = 37; n > 0; n--)
        expected.push_back(n - 1);
    EXPECT_EQ(groups, expected);
}

TEST(route, marks_exactly_what_changed)
{
    piece_clay p;
    routed way;
    way.add_stroke(do_stroke(&p.c, {two_bricks}));
    way.turn();
    ASSERT_EQ(go(way.r, &p.c), STATUS_OK);
    EXPECT_EQ(clay_brick_count(&p.c), 0u);
    ASSERT_EQ(dirt_count(&p.c.dirty), 2u);
    uint64_t marked = 0;
    for (uint32_t n = 0; n < 2; n++)
        marked += brick_mask_count(&dirt_at(&p.c.dirty, n)->corners);
    EXPECT_EQ(marked, 3u);
    for (const piece_corner &corner : two_bricks) {
        const dirt_entry *dirty = clay_dirt(&p.c, key_brick(corner.at));
        ASSERT_NE(dirty, nullptr);
        EXPECT_TRUE(brick_mask_has(&dirty->corners, key_slot(corner.at)));
    }
}

TEST(route, can_be_reverted_by_the_caller)
{
    piece_clay p;
    routed way;
    const done d = do_stroke(&p.c, {two_bricks});
    way.add_stroke(d);
    way.turn();
    ASSERT_EQ(route_apply(&way.r, &p.c), STATUS_OK);
    EXPECT_TRUE(p.c.changes.recording);
    EXPECT_EQ(clay_digest(&p.c), d.before);
    clay_change_revert(&p.c);
    EXPECT_EQ(clay_digest(&p.c), d.after);
    EXPECT_TRUE(clay_is_valid(&p.c));
}

TEST(route, way_of_no_legs_is_gone_in_an_instant)
{
    piece_clay p;
    routed way;
    EXPECT_EQ(go(way.r, &p.c), STATUS_OK);
    way.r.digest_after = 1;
    EXPECT_EQ(go(way.r, &p.c), STATUS_CORRUPT);
}

/* --- whole or not at all --- */

void expect_unmoved(const route &r, clay *c, status expected, const std::string &what)
{
    const uint64_t digest = clay_digest(c);
    const uint32_t bricks = clay_brick_count(c);
    const uint64_t corners = c->corners;
    EXPECT_EQ(go(r, c), expected) << what;
    EXPECT_EQ(clay_digest(c), digest) << what;
    EXPECT_EQ(clay_brick_count(c), bricks) << what;
    EXPECT_EQ(c->corners, corners) << what;
}

TEST(route, last_brick_that_would_be_no_clay_undoes_all)
{
    const uint32_t sign = 0x80000000, exponent = 0x7f800000;
    struct spoil {
        const char *what;
        size_t at; /* in the last brick: two corners */
        uint32_t turn;
    };
    const std::vector<spoil> all = {
        {"a potential below 0", 80, sign},
        {"one that is no number", 80, exponent | 1},
        {"one above 3", 80, 0x40600000 ^ 0x40200000},
        {"minus zero where nothing should be", 84, 0x40400000 ^ sign},
        {"a colour where there is no clay", 84, 0x40400000},
        {"another potential", 84, 1},
        {"another colour", 88, 1},
    };
    for (const bool back : {false, true})
        for (const spoil &s : all) {
            piece_clay p;
            piece_stroke coloured = two_bricks;
            coloured[2].rgba = 7;
            if (back) { /* such that the spoilt side is the older one */
                ASSERT_EQ(piece_write(&p.c, coloured), STATUS_OK);
                dirt_clear(&p.c.dirty);
            }
            const piece_stroke none = {{{0, 0, 1}, 0, 0}, {{0, 0, 9}, 0, 0}, {{0, 0, 10}, 0, 0}};
            done d = do_stroke(&p.c, {{{{-9, 0, 0}, 1, 1}}, back ? none : coloured});
            stretch &last = d.stretches.back();
            uint8_t *word = &last.bytes[last.at.back() + s.at];
            byte_order_put_u32(word, byte_order_get_u32(word) ^ s.turn);
            if (back)
                std::swap(d.stretches.front(), d.stretches.back()); /* gone over last */
            routed way;
            way.add_stroke(d);
            way.turn();
            if (!back) {
                piece_clay from;
                way.turn();
                expect_unmoved(way.r, &from.c, STATUS_CORRUPT, s.what);
                continue;
            }
            expect_unmoved(way.r, &p.c, STATUS_CORRUPT, s.what);
        }
}

TEST(route, clay_that_is_not_where_it_begins_is_left_alone)
{
    const piece_stroke spoils = {{{0, 0, 1}, 1.0f, 0x04030201}, {{0, 0, 1}, 1.25f, 5}, {{0, 0, 9}, 0, 0}};
    for (const piece_corner &spoil : spoils) {
        piece_clay p;
        routed way;
        way.add_stroke(do_stroke(&p.c, {two_bricks}));
        ASSERT_EQ(clay_write(&p.c, spoil.at, spoil.potential, spoil.rgba), STATUS_OK);
        way.turn();
        expect_unmoved(way.r, &p.c, STATUS_CORRUPT, "");
    }
    piece_clay p;
    routed way;
    way.add_stroke(do_stroke(&p.c, {two_bricks}));
    expect_unmoved(way.r, &p.c, STATUS_CORRUPT, "it has been gone over already");
}

TEST(route, way_that_ends_elsewhere_is_not_gone)
{
    piece_clay p;
    routed way;
    way.add_stroke(do_stroke(&p.c, {two_bricks}));
    way.turn();
    way.r.digest_after ^= 1;
    expect_unmoved(way.r, &p.c, STATUS_CORRUPT, "");
}

TEST(route, no_room_changes_nothing)
{
    piece_clay large, small(1);
    routed way;
    way.add_stroke(do_stroke(&large.c, {two_bricks}));
    expect_unmoved(way.r, &small.c, STATUS_POOL_FULL, "");
    piece_clay other(2); /* the first stretch has room, the second has not */
    routed longer;
    piece_clay c;
    longer.add_stroke(do_stroke(&c.c, {two_bricks, {{{0, 0, 17}, 1, 1}}}));
    expect_unmoved(longer.r, &other.c, STATUS_POOL_FULL, "");
}

/* --- full sculptures --- */

piece_stroke row(int first, int end, int j, float potential)
{
    piece_stroke s;
    for (int n = first; n < end; n++)
        s.push_back({{8 * n, j, 0}, potential, potential > 0 ? 7u : 0u});
    return s;
}

TEST(route, full_sculpture_goes_back_to_where_it_was)
{
    /* Eight bricks at most: four of them go and four others come, in one stroke. */
    piece_clay p(8);
    ASSERT_EQ(piece_write(&p.c, row(0, 8, 0, 1)), STATUS_OK);
    for (const int j : {80, -80}) { /* such that what comes lies behind, then before what goes */
        delta d = {};
        done all;
        all.before = clay_digest(&p.c);
        dirt_clear(&p.c.dirty);
        clay_change_begin(&p.c);
        ASSERT_EQ(piece_write(&p.c, row(0, 4, 0, 0)), STATUS_OK);
        ASSERT_EQ(piece_write(&p.c, row(0, 4, j, 2)), STATUS_OK);
        ASSERT_EQ(delta_cut(&d, &p.c), STATUS_OK);
        delta_sort(&d);
        all.stretches.push_back(bricks_of(d, p.c.rows));
        delta_give(&d, &p.c);
        delta_finish(&d);
        clay_change_end(&p.c);
        all.after = clay_digest(&p.c);
        ASSERT_EQ(clay_brick_count(&p.c), 8u);
        ASSERT_EQ(all.stretches[0].at.size(), 8u);
        routed way;
        way.add_stroke(all);
        for (int times = 0; times < 2; times++) {
            way.turn();
            ASSERT_EQ(go(way.r, &p.c), STATUS_OK);
            EXPECT_EQ(clay_digest(&p.c), all.before);
            way.turn();
            ASSERT_EQ(go(way.r, &p.c), STATUS_OK);
            EXPECT_EQ(clay_digest(&p.c), all.after);
        }
        way.turn();
        ASSERT_EQ(go(way.r, &p.c), STATUS_OK);
    }
}

TEST(route, bricks_of_one_stretch_that_several_records_hold_make_room_for_each_other)
{
    piece_clay p(8);
    ASSERT_EQ(piece_write(&p.c, row(0, 8, 0, 1)), STATUS_OK);
    dirt_clear(&p.c.dirty);
    delta d = {};
    const uint64_t before = clay_digest(&p.c);
    clay_change_begin(&p.c);
    ASSERT_EQ(piece_write(&p.c, row(0, 4, 0, 0)), STATUS_OK);
    ASSERT_EQ(piece_write(&p.c, row(0, 4, 80, 2)), STATUS_OK);
    ASSERT_EQ(delta_cut(&d, &p.c), STATUS_OK);
    delta_sort(&d);
    const stretch s = bricks_of(d, p.c.rows);
    delta_give(&d, &p.c);
    delta_finish(&d);
    clay_change_end(&p.c);
    routed together, apart;
    for (routed *way : {&together, &apart}) {
        for (size_t n = 0; n < s.at.size(); n++) {
            const size_t end = n + 1 < s.at.size() ? s.at[n + 1] : s.bytes.size();
            way->add({s.bytes.begin() + static_cast<std::ptrdiff_t>(s.at[n]),
                      s.bytes.begin() + static_cast<std::ptrdiff_t>(end)},
                     way == &together ? 0 : static_cast<uint32_t>(n));
        }
        way->r.digest_before = clay_digest(&p.c);
        way->r.digest_after = before;
    }
    expect_unmoved(apart.r, &p.c, STATUS_POOL_FULL, "as states of their own there is no room between them");
    ASSERT_EQ(go(together.r, &p.c), STATUS_OK);
    EXPECT_EQ(clay_digest(&p.c), before);
}

TEST(route, brick_that_a_stretch_empties_and_the_next_fills_is_followed)
{
    piece_clay p(6);
    ASSERT_EQ(piece_write(&p.c, row(0, 6, 0, 1)), STATUS_OK);
    dirt_clear(&p.c.dirty);
    /* Six bricks at most, all there; one goes, comes elsewhere, goes again, ... */
    const done d = do_stroke(&p.c, {row(0, 1, 0, 0), row(0, 1, 80, 2), row(0, 1, 80, 0), row(0, 1, 0, 3),
                                    row(1, 2, 0, 0), row(0, 1, 40, 1)});
    ASSERT_EQ(d.stretches.size(), 6u);
    routed way;
    way.add_stroke(d);
    way.turn();
    ASSERT_EQ(go(way.r, &p.c), STATUS_OK);
    EXPECT_EQ(clay_digest(&p.c), d.before);
    way.turn();
    ASSERT_EQ(go(way.r, &p.c), STATUS_OK);
    EXPECT_EQ(clay_digest(&p.c), d.after);
}

} // namespace
