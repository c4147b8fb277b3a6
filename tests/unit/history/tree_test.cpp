/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: undo, redo, forks and forgetting lead where a plain picture of the strokes says.
 * Method: the picture is a map of strokes to where they began; every question is answered by walking all of it, edge by
 *         edge. Trees of chance beside it, and the drawing in tree.h by hand. */
#include "history/tree.h"

#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <vector>

namespace {

struct wood {
    tree t = {};
    ~wood() { tree_finish(&t); }
    void put(uint64_t stroke, uint64_t parent)
    {
        tree_stroke s = {};
        s.stroke = stroke;
        s.parent = parent;
        s.digest_before = stroke * 10;
        s.digest_after = stroke * 10 + 1;
        ASSERT_EQ(tree_put(&t, s), STATUS_OK);
    }
};

/* What the drawing in tree.h shows. */
void draw(wood &w)
{
    const std::map<uint64_t, uint64_t> strokes = {{1, 0}, {2, 1}, {3, 2}, {4, 3}, {5, 2}, {6, 5}, {7, 3}};
    for (const auto &[stroke, parent] : strokes)
        w.put(stroke, parent);
    w.t.cursor = 3;
    w.t.tip = 7;
}

using picture = std::map<uint64_t, uint64_t>; /* stroke -> where it began */

/* The states on the one way there is, both ends among them; empty: there is none. */
std::vector<uint64_t> way(const picture &p, uint64_t from, uint64_t to)
{
    std::map<uint64_t, uint64_t> came = {{from, from}};
    std::deque<uint64_t> next = {from};
    while (!next.empty() && !came.count(to)) {
        const uint64_t at = next.front();
        next.pop_front();
        for (const auto &[stroke, parent] : p)
            for (const auto &[here, there] : {std::pair{stroke, parent}, std::pair{parent, stroke}})
                if (here == at && came.insert({there, at}).second)
                    next.push_back(there);
    }
    if (!came.count(to))
        return {};
    std::vector<uint64_t> all = {to};
    while (all.back() != from)
        all.push_back(came.at(all.back()));
    return {all.rbegin(), all.rend()};
}

/* Does redo alone lead there? */
bool is_forth(const picture &p, uint64_t from, uint64_t to)
{
    const std::vector<uint64_t> states = way(p, from, to);
    for (size_t n = 1; n < states.size(); n++)
        if (!p.count(states[n]) || p.at(states[n]) != states[n - 1])
            return false;
    return !states.empty();
}

uint64_t newest_forth(const picture &p, uint64_t from)
{
    uint64_t best = from;
    for (const auto &[stroke, parent] : p)
        if (stroke > best && is_forth(p, from, stroke))
            best = stroke;
    return best;
}

std::set<uint64_t> ends(const picture &p)
{
    std::set<uint64_t> all;
    for (const auto &[stroke, parent] : p)
        all.insert(stroke);
    for (const auto &[stroke, parent] : p)
        all.erase(parent);
    return all;
}

/* Leaves only what the cursor reaches. */
void prune(picture &p, uint64_t cursor)
{
    const picture whole = p;
    std::erase_if(p, [&](const auto &s) { return way(whole, cursor, s.first).empty(); });
}

void expect_like(const tree &t, const picture &p)
{
    ASSERT_EQ(t.count, p.size());
    uint32_t n = 0;
    for (const auto &[stroke, parent] : p) {
        ASSERT_EQ(t.strokes[n].stroke, stroke);
        ASSERT_EQ(t.strokes[n].parent, parent);
        ASSERT_EQ(t.strokes[n].digest_after, stroke * 10 + 1);
        uint32_t children = 0;
        for (const auto &[other, began] : p)
            children += began == stroke;
        ASSERT_EQ(t.strokes[n++].children, children);
        ASSERT_NE(tree_find(&t, stroke), nullptr);
    }
    ASSERT_EQ(tree_undo(&t), p.count(t.cursor) ? p.at(t.cursor) : t.cursor);
    const std::vector<uint64_t> forth = way(p, t.cursor, t.tip);
    ASSERT_TRUE(is_forth(p, t.cursor, t.tip)) << "the tip is where redo alone leads";
    ASSERT_EQ(tree_redo(&t), forth.size() > 1 ? forth[1] : t.cursor);
    ASSERT_EQ(tree_branches(&t), ends(p).size());
}

void expect_ways_like(const tree &t, const picture &p, uint64_t from, uint64_t to, uint64_t over)
{
    const std::vector<uint64_t> states = way(p, from, to);
    ASSERT_EQ(tree_leads(&t, from, to), !states.empty());
    bool passes = false;
    for (size_t n = 1; n < states.size(); n++)
        passes = passes || std::max(states[n], states[n - 1]) == over;
    ASSERT_EQ(tree_passes(&t, from, to, over), passes) << from << " to " << to << " over " << over;
    ASSERT_EQ(tree_tip_of(&t, from), newest_forth(p, from));
    if (from == to)
        return;
    if (states.empty()) {
        ASSERT_EQ(tree_next(&t, from, to).stroke, 0u);
        return;
    }
    const tree_leg leg = tree_next(&t, from, to);
    ASSERT_EQ(leg.to, states[1]);
    ASSERT_EQ(leg.stroke, std::max(from, states[1])) << "a stroke is named by the later of its two states";
    ASSERT_EQ(leg.back, states[1] < from);
}

/* --- the drawing --- */

TEST(tree, drawing)
{
    wood w;
    draw(w);
    EXPECT_EQ(tree_undo(&w.t), 2u);
    EXPECT_EQ(tree_redo(&w.t), 7u);
    EXPECT_EQ(tree_branches(&w.t), 3u);
    const tree_leg leg = tree_next(&w.t, 4, 6);
    EXPECT_EQ(leg.stroke, 4u);
    EXPECT_TRUE(leg.back);
    EXPECT_EQ(leg.to, 3u);
    const tree_leg forth = tree_next(&w.t, 2, 6);
    EXPECT_EQ(forth.stroke, 5u);
    EXPECT_FALSE(forth.back);
    EXPECT_EQ(forth.to, 5u);
    EXPECT_TRUE(tree_passes(&w.t, 4, 6, 5));
    EXPECT_FALSE(tree_passes(&w.t, 4, 6, 2)) << "they meet there";
}

TEST(tree, redo_after_undo_returns)
{
    wood w;
    draw(w);
    w.t.cursor = w.t.tip = 7;
    for (uint64_t to : {3, 2, 1, 0}) {
        EXPECT_EQ(tree_undo(&w.t), to);
        w.t.cursor = to;
    }
    EXPECT_EQ(tree_undo(&w.t), 0u) << "there is nothing before the beginning";
    for (uint64_t to : {1, 2, 3, 7}) {
        EXPECT_EQ(tree_redo(&w.t), to);
        w.t.cursor = to;
    }
    EXPECT_EQ(tree_redo(&w.t), 7u);
}

TEST(tree, fork_goes_round_all_ends)
{
    wood w;
    draw(w);
    w.t.cursor = 2;
    std::vector<uint64_t> went;
    for (int n = 0; n < 4; n++) {
        w.t.cursor = w.t.tip = tree_fork(&w.t);
        went.push_back(w.t.tip);
    }
    EXPECT_EQ(went, (std::vector<uint64_t>{6, 4, 7, 6}));
}

TEST(tree, empty_and_single)
{
    wood w;
    EXPECT_EQ(tree_undo(&w.t), 0u);
    EXPECT_EQ(tree_redo(&w.t), 0u);
    EXPECT_EQ(tree_fork(&w.t), 0u);
    EXPECT_EQ(tree_branches(&w.t), 0u);
    EXPECT_EQ(tree_find(&w.t, 0), nullptr);
    tree_forget(&w.t, 5);
    w.put(9, 4);
    w.t.cursor = w.t.tip = 9;
    EXPECT_EQ(tree_undo(&w.t), 4u) << "where it began need not be a stroke that is kept";
    EXPECT_EQ(tree_fork(&w.t), 9u);
    EXPECT_TRUE(tree_leads(&w.t, 9, 4));
    EXPECT_FALSE(tree_leads(&w.t, 9, 0));
}

TEST(tree, putting_again_only_moves_where_it_ends)
{
    wood w;
    draw(w);
    tree_stroke again = {};
    again.stroke = 5;
    again.digest_after = 99;
    ASSERT_EQ(tree_put(&w.t, again), STATUS_OK);
    const tree_stroke *s = tree_find(&w.t, 5);
    EXPECT_EQ(w.t.count, 7u);
    EXPECT_EQ(s->parent, 2u);
    EXPECT_EQ(s->digest_before, 50u);
    EXPECT_EQ(s->digest_after, 99u);
}

TEST(tree, forgetting_loses_what_is_cut_off)
{
    wood w;
    draw(w);
    tree_forget(&w.t, 3); /* the cursor stands behind it: what is lost is all before */
    EXPECT_EQ(w.t.count, 2u);
    EXPECT_NE(tree_find(&w.t, 4), nullptr);
    EXPECT_NE(tree_find(&w.t, 7), nullptr);
    EXPECT_EQ(w.t.tip, 7u);
    EXPECT_EQ(tree_undo(&w.t), 3u);
    tree_forget(&w.t, 7);
    EXPECT_EQ(w.t.tip, 4u) << "the tip went: the newest that is left";
}

/* --- trees of chance --- */

struct state {
    wood w;
    picture p;
    uint64_t given = 0;
};

uint64_t any_state(seeded &chance, const state &s)
{
    return static_cast<uint64_t>(seeded_int(chance, 0, static_cast<int64_t>(s.given)));
}

/* Goes there, as history does: the tip stays while redo leads to it. */
void go(state &s, uint64_t to)
{
    s.w.t.tip = is_forth(s.p, to, s.w.t.tip) ? s.w.t.tip : newest_forth(s.p, to);
    s.w.t.cursor = to;
}

void forget(state &s, uint64_t stroke)
{
    tree &t = s.w.t;
    if (s.p.erase(stroke)) {
        const uint64_t tip = t.tip;
        prune(s.p, t.cursor);
        tree_forget(&t, stroke);
        ASSERT_EQ(t.tip, is_forth(s.p, t.cursor, tip) ? tip : newest_forth(s.p, t.cursor));
    } else {
        tree_forget(&t, stroke);
    }
}

void grow(seeded &chance, state &s)
{
    tree &t = s.w.t;
    const double die = seeded_real(chance, 0, 1);
    if (die < 0.5) {
        s.given += static_cast<uint64_t>(seeded_int(chance, 1, 2));
        s.w.put(s.given, t.cursor);
        s.p[s.given] = t.cursor;
        t.cursor = t.tip = s.given;
    } else if (die < 0.8) {
        const uint64_t to = any_state(chance, s);
        if (!way(s.p, t.cursor, to).empty())
            go(s, to);
    } else if (die < 0.9) {
        go(s, tree_undo(&t));
    } else if (s.p.size() > 4) {
        forget(s, seeded_chance(chance, 0.5) ? s.p.begin()->first : any_state(chance, s));
    }
}

/* The first stroke whose forgetting takes nothing else away, tried one by one. */
uint64_t first_spare(const state &s)
{
    for (const auto &[stroke, parent] : s.p) {
        picture without = s.p;
        without.erase(stroke);
        prune(without, s.w.t.cursor);
        if (without.size() + 1 == s.p.size() && is_forth(without, s.w.t.cursor, s.w.t.tip))
            return stroke;
    }
    return 0;
}

TEST(tree, is_the_picture_at_every_step)
{
    size_t largest = 0, forks = 0;
    for (uint64_t seed = 1; seed <= 30; seed++) {
        seeded chance = {seed};
        state s;
        for (int n = 0; n < 120; n++) {
            SCOPED_TRACE("seed " + std::to_string(seed) + " step " + std::to_string(n));
            ASSERT_NO_FATAL_FAILURE(grow(chance, s));
            ASSERT_NO_FATAL_FAILURE(expect_like(s.w.t, s.p));
            for (int more = 0; more < 8; more++)
                ASSERT_NO_FATAL_FAILURE(expect_ways_like(s.w.t, s.p, any_state(chance, s), any_state(chance, s),
                                                         any_state(chance, s)));
            ASSERT_EQ(tree_spare(&s.w.t), first_spare(s));
            largest = std::max(largest, s.p.size());
            forks = std::max(forks, ends(s.p).size());
        }
        /* Round all ends, from wherever. */
        std::set<uint64_t> went;
        for (size_t n = 0; n < ends(s.p).size(); n++) {
            s.w.t.cursor = s.w.t.tip = tree_fork(&s.w.t);
            went.insert(s.w.t.tip);
        }
        EXPECT_EQ(went, ends(s.p));
    }
    EXPECT_GT(largest, 30u);
    EXPECT_GT(forks, 5u);
}

TEST(tree, strokes_may_be_put_in_any_order)
{
    seeded chance = {3};
    wood w;
    picture p;
    std::vector<uint64_t> all;
    for (uint64_t n = 1; n <= 200; n++)
        all.push_back(n);
    for (size_t n = all.size(); n > 1; n--)
        std::swap(all[n - 1], all[static_cast<size_t>(seeded_int(chance, 0, static_cast<int64_t>(n) - 1))]);
    for (const uint64_t stroke : all) {
        p[stroke] = stroke / 2;
        w.put(stroke, stroke / 2);
    }
    w.t.cursor = 1;
    w.t.tip = 200;
    expect_like(w.t, p);
}

} // namespace
