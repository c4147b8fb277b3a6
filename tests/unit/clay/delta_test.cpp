/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a delta shows every brick that changed since the change began or was last cut, as it was and as it is, and goes
 *       on showing it whatever is done to the clay; and what it holds it gives back.
 * Method: copies of the clay taken before, at every cut and after, corner by corner, beside it; holds and pages
 *         counted. */
#include "clay/delta.h"

#include "clay/freeze.h"
#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <vector>

namespace {

/* What the clay has at a brick, read corner by corner. */
brick_page page_of(const plain_clay &p, key at)
{
    brick_page page = {};
    for (int di = 0; di < BRICK_EDGE; di++)
        for (int dj = 0; dj < BRICK_EDGE; dj++)
            for (int dk = 0; dk < BRICK_EDGE; dk++) {
                const auto found = p.find({at.i * 8 + di, at.j * 8 + dj, at.k * 8 + dk});
                if (found == p.end())
                    continue;
                page.potential[di * 64 + dj * 8 + dk] = found->second.potential;
                page.rgba[di * 64 + dj * 8 + dk] = found->second.rgba;
            }
    return page;
}

bool stores(const plain_clay &p, key at)
{
    const brick_page page = page_of(p, at), none = {};
    return std::memcmp(&page, &none, sizeof page) != 0;
}

bool same(const brick_page *a, const brick_page &b)
{
    const brick_page none = {};
    return std::memcmp(a ? a : &none, &b, sizeof b) == 0;
}

class delta_of_a_ball : public testing::Test {
protected:
    void SetUp() override
    {
        seeded chance = {1};
        ASSERT_EQ(clay_init(&c, 1000), STATUS_OK);
        ASSERT_EQ(plain_clay_ball(&c, chance, {0, 0, 0}, 20, 1), STATUS_OK);
        dirt_clear(&c.dirty);
        before = plain_clay_of(&c);
        pages = c.pages.of.count;
        clay_change_begin(&c);
    }
    void TearDown() override
    {
        delta_finish(&d);
        delta_finish(&more);
        clay_finish(&c);
    }
    void write(key at, float potential, uint32_t rgba = 77)
    {
        ASSERT_EQ(clay_write(&c, at, potential, rgba), STATUS_OK);
        dirt_clear(&c.dirty);
    }
    void write_all(float potential)
    {
        for (const auto &[at, corner] : plain_clay_of(&c))
            write(plain_clay_untuple(at), potential);
    }
    void cut(delta *into)
    {
        ASSERT_EQ(delta_cut(into, &c), STATUS_OK);
        delta_sort(into);
    }
    /* It shows all that is not the same in the two, and what it shows is so. */
    void expect_shows(const delta &shown, const plain_clay &old, const plain_clay &now)
    {
        std::set<std::tuple<int, int, int>> at;
        for (const plain_clay *p : {&old, &now})
            for (const auto &[corner, held] : *p) {
                const key b = key_brick(plain_clay_untuple(corner));
                at.insert({b.i, b.j, b.k});
            }
        uint32_t n = 0;
        for (const auto &tuple : at) {
            const key b = {std::get<0>(tuple), std::get<1>(tuple), std::get<2>(tuple)};
            const brick_page was = page_of(old, b), is = page_of(now, b);
            if (n < shown.count && key_compare(shown.bricks[n].at, b) == 0) {
                EXPECT_TRUE(same(shown.bricks[n].old, was) && same(shown.bricks[n].now, is));
                EXPECT_EQ(shown.bricks[n].old != nullptr, stores(old, b));
                EXPECT_EQ(shown.bricks[n].now != nullptr, stores(now, b));
                n++;
            } else {
                EXPECT_EQ(std::memcmp(&was, &is, sizeof was), 0) << b.i << " " << b.j << " " << b.k;
            }
        }
        EXPECT_EQ(n, shown.count) << "in key order, each once";
    }
    clay c;
    plain_clay before;
    uint32_t pages;
    delta d = {}, more = {};
};

TEST_F(delta_of_a_ball, nothing_done_shows_nothing)
{
    cut(&d);
    EXPECT_EQ(d.count, 0u);
    EXPECT_TRUE(c.changes.recording);
    EXPECT_TRUE(clay_is_valid(&c));
    delta_give(&d, &c);
}

TEST_F(delta_of_a_ball, shows_what_came_what_went_and_what_became_of_the_rest)
{
    write({100, 0, 0}, 1); /* a new brick, after all */
    write({-100, 0, 0}, 1); /* another, before all */
    write({1, 2, 3}, 0.25f);
    const key gone = key_brick({19, 0, 0});
    for (const auto &[at, corner] : before)
        if (key_compare(key_brick(plain_clay_untuple(at)), gone) == 0)
            write(plain_clay_untuple(at), 0);
    cut(&d);
    ASSERT_EQ(d.count, 4u);
    expect_shows(d, before, plain_clay_of(&c));
    EXPECT_EQ(d.bricks[0].old_id, POOL_NONE);
    EXPECT_NE(d.bricks[0].now_id, POOL_NONE);
    EXPECT_TRUE(clay_is_valid(&c));
    EXPECT_EQ(c.cut, 6u * 1 - 1) << "two came, one went, one changed: 1 + 1 + 1 + 2";
    delta_give(&d, &c);
    EXPECT_EQ(c.cut, 0u);
    EXPECT_EQ(d.count, 0u);
    EXPECT_TRUE(clay_is_valid(&c));
}

TEST_F(delta_of_a_ball, pages_stay_while_the_clay_goes_on)
{
    write_all(0.5f);
    const plain_clay at_cut = plain_clay_of(&c);
    cut(&d);
    ASSERT_GT(d.count, 50u);
    EXPECT_TRUE(clay_is_valid(&c));
    write_all(2.5f);
    expect_shows(d, before, at_cut);
    write_all(0);
    EXPECT_EQ(clay_brick_count(&c), 0u);
    expect_shows(d, before, at_cut);
    clay_change_end(&c);
    EXPECT_TRUE(clay_is_valid(&c)) << "the delta's holds are the only ones left";
    clay_clear(&c);
    EXPECT_GE(c.pages.of.count, 2 * d.count - 64);
    expect_shows(d, before, at_cut);
    delta_give(&d, &c);
    EXPECT_EQ(c.pages.of.count, 0u);
    EXPECT_TRUE(clay_is_valid(&c));
}

TEST_F(delta_of_a_ball, cut_twice_shows_one_stretch_each)
{
    write({1, 2, 3}, 0.5f);
    write({9, 2, 3}, 0.5f);
    const plain_clay first = plain_clay_of(&c);
    cut(&d);
    write({1, 2, 3}, 0.75f);
    write({-9, 2, 3}, 0.75f);
    const plain_clay second = plain_clay_of(&c);
    cut(&more);
    EXPECT_EQ(d.count, 2u);
    EXPECT_EQ(more.count, 2u);
    expect_shows(d, before, first);
    expect_shows(more, first, second);
    EXPECT_TRUE(clay_is_valid(&c));
    delta_give(&d, &c); /* in the order in which they were cut, as they are kept */
    expect_shows(more, first, second);
    EXPECT_TRUE(clay_is_valid(&c));
    delta_give(&more, &c);
    EXPECT_TRUE(clay_is_valid(&c));
}

TEST_F(delta_of_a_ball, reverting_goes_back_to_the_cut)
{
    write_all(0.5f);
    const plain_clay at_cut = plain_clay_of(&c);
    const uint64_t digest = clay_digest(&c);
    cut(&d);
    write_all(2);
    write({100, 100, 100}, 1);
    clay_change_revert(&c);
    EXPECT_EQ(plain_clay_difference(at_cut, &c), "");
    EXPECT_EQ(clay_digest(&c), digest);
    expect_shows(d, before, at_cut);
    EXPECT_TRUE(clay_is_valid(&c));
    delta_give(&d, &c);
}

TEST_F(delta_of_a_ball, bricks_come_in_the_order_in_which_they_were_opened_until_sorted)
{
    const std::vector<key> opened = {{50, 0, 0}, {-50, 0, 0}, {7, 9, 1}, {7, -9, 1}, {7, 9, 0}};
    for (const key &at : opened)
        write(key_of_brick(at), 1);
    write(key_of_brick(opened[1]), 2);
    ASSERT_EQ(delta_cut(&d, &c), STATUS_OK);
    ASSERT_EQ(d.count, opened.size());
    for (uint32_t n = 0; n < d.count; n++)
        EXPECT_EQ(key_compare(d.bricks[n].at, opened[n]), 0) << n;
    delta_sort(&d);
    for (uint32_t n = 1; n < d.count; n++)
        EXPECT_LT(key_compare(d.bricks[n - 1].at, d.bricks[n].at), 0) << n;
    expect_shows(d, before, plain_clay_of(&c));
    delta_give(&d, &c);
}

TEST_F(delta_of_a_ball, gives_back_every_page)
{
    for (int n = 0; n < 5; n++) {
        write_all(0.5f + static_cast<float>(n) / 8);
        cut(&d);
        delta_give(&d, &c);
    }
    clay_change_end(&c);
    EXPECT_LE(c.pages.of.count, pages + 64u) << "pages shared by full bricks aside";
    clay_clear(&c);
    EXPECT_EQ(c.pages.of.count, 0u);
    EXPECT_TRUE(clay_is_valid(&c));
}

TEST_F(delta_of_a_ball, brick_that_went_and_came_again_shows_both_sides)
{
    ASSERT_EQ(stores(before, {12, 0, 0}), false);
    write({100, 0, 0}, 1);
    cut(&d);
    delta_give(&d, &c);
    const plain_clay old = plain_clay_of(&c);
    write({100, 0, 0}, 0);
    write({101, 0, 0}, 2);
    cut(&d);
    ASSERT_EQ(d.count, 1u);
    expect_shows(d, old, plain_clay_of(&c));
    delta_give(&d, &c);
    write({101, 0, 0}, 0); /* and what came and went within one stretch is nothing */
    cut(&d);
    delta_give(&d, &c);
    write({200, 0, 0}, 2);
    write({200, 0, 0}, 0);
    cut(&d);
    for (uint32_t n = 0; n < d.count; n++)
        EXPECT_TRUE(d.bricks[n].old == nullptr && d.bricks[n].now == nullptr);
    EXPECT_TRUE(clay_is_valid(&c));
    delta_give(&d, &c);
    EXPECT_TRUE(clay_is_valid(&c));
}

TEST_F(delta_of_a_ball, full_brick_that_stays_full_of_its_colour_holds_nothing)
{
    const auto fill = [&](uint32_t rgba) {
        uint32_t id;
        const brick_mask all = BRICK_MASK_ALL;
        ASSERT_EQ(clay_brick_open(&c, {50, 0, 0}, &id), STATUS_OK);
        for (int n = 0; n < BRICK_CORNERS; n++) {
            clay_brick(&c, id)->page->potential[n] = POTENTIAL_MAX;
            clay_brick(&c, id)->page->rgba[n] = rgba;
        }
        ASSERT_EQ(clay_brick_close(&c, id, &all), STATUS_OK);
        dirt_clear(&c.dirty);
    };
    fill(5);
    cut(&d);
    EXPECT_EQ(d.count, 1u);
    delta_give(&d, &c);
    fill(5);
    cut(&d);
    EXPECT_EQ(d.count, 0u) << "the same page as before";
    EXPECT_EQ(c.cut, 0u);
    EXPECT_TRUE(clay_is_valid(&c));
    fill(6);
    cut(&more);
    EXPECT_EQ(more.count, 1u);
    EXPECT_TRUE(clay_is_valid(&c));
    delta_give(&more, &c);
    EXPECT_TRUE(clay_is_valid(&c));
}

TEST_F(delta_of_a_ball, frozen_clay_and_delta_do_not_see_each_other)
{
    freeze f;
    ASSERT_EQ(freeze_begin(&f, &c), STATUS_OK);
    write_all(0.5f);
    const plain_clay at_cut = plain_clay_of(&c);
    cut(&d);
    write_all(1.5f);
    EXPECT_EQ(plain_clay_difference(before, &f.still), "");
    expect_shows(d, before, at_cut);
    freeze_end(&f);
    EXPECT_TRUE(clay_is_valid(&c));
    expect_shows(d, before, at_cut);
    delta_give(&d, &c);
    EXPECT_TRUE(clay_is_valid(&c));
}

/* Long walks: the sum of all stretches is the whole change. */
TEST(delta, stretches_add_up_to_the_change)
{
    seeded chance = {7};
    clay c;
    ASSERT_EQ(clay_init(&c, 400), STATUS_OK);
    std::vector<std::pair<plain_clay, plain_clay>> sides;
    std::vector<delta> held(6, delta{});
    clay_change_begin(&c);
    for (int n = 0; n < 200; n++) {
        const plain_clay old = plain_clay_of(&c);
        for (int64_t corners = seeded_int(chance, 0, 40); corners > 0; corners--) {
            const key at = seeded_key(chance, -12, 12);
            ASSERT_EQ(clay_write(&c, at, static_cast<float>(seeded_int(chance, 0, 3)), 3), STATUS_OK);
        }
        dirt_clear(&c.dirty);
        delta &d = held[static_cast<size_t>(n) % held.size()];
        delta_give(&d, &c);
        ASSERT_EQ(delta_cut(&d, &c), STATUS_OK);
        ASSERT_TRUE(clay_is_valid(&c)) << n;
        const plain_clay now = plain_clay_of(&c);
        sides.push_back({old, now});
        for (size_t back = 0; back < std::min(held.size(), sides.size()); back++) { /* older ones too, still */
            const delta &older = held[(static_cast<size_t>(n) - back) % held.size()];
            const auto &[was, is] = sides[sides.size() - 1 - back];
            for (uint32_t b = 0; b < older.count; b++) {
                ASSERT_TRUE(same(older.bricks[b].old, page_of(was, older.bricks[b].at)));
                ASSERT_TRUE(same(older.bricks[b].now, page_of(is, older.bricks[b].at)));
            }
        }
    }
    clay_change_end(&c);
    for (delta &d : held) {
        delta_give(&d, &c);
        delta_finish(&d);
    }
    EXPECT_TRUE(clay_is_valid(&c));
    EXPECT_EQ(c.cut, 0u);
    clay_finish(&c);
}

} // namespace
