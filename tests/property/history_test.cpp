/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: over any walk of strokes, stretches, undo, redo, forks, leaps, checkpoints and restarts, on a good store and on
 *       one that fails now and then, the clay is what a tree of whole states says, and history reaches exactly as far.
 * Method: the tree holds every corner of every state there ever was, in sorted maps that share nothing with clay;
 *         digests are compared with those of clay made anew from each map. A stroke may be forgotten only when it is
 *         the oldest and there are more than were asked for, or no room for more. Ten thousand seeded steps over rings
 *         of 1 to 200 strokes; GLAISE_WALK_STEPS asks for more. */
#include "history/history.h"

#include "tests/property/seeded.h"
#include "tests/unit/history/memory_store.h"
#include "tests/unit/history/piece.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

int steps_in_all()
{
    const char *asked = std::getenv("GLAISE_WALK_STEPS");
    return asked ? std::max(10000, std::atoi(asked)) : seeded_steps(10000);
}

struct state {
    piece_model corners;
    uint64_t digest = 0;
};

using state_ptr = std::shared_ptr<const state>;

/* Where the clay stood after a record. */
struct stand {
    uint64_t cursor, tip;
    state_ptr at;
};

struct remembered {
    std::map<uint64_t, state_ptr> states;    /* after a stroke, all there ever were */
    std::map<uint64_t, uint64_t> began;      /* where it began, likewise */
    std::map<uint64_t, uint64_t> first_seen; /* the record after which the stroke was there */
    std::map<uint64_t, uint64_t> kept;       /* stroke -> where it began: those that can be gone over */
    std::map<uint64_t, stand> stands;        /* by record */
    uint64_t cursor = 0, tip = 0, given = 0;
    bool in_stroke = false;
};

/* Do the strokes that are kept lead from one to the other by redo alone? */
bool is_forth(const remembered &r, uint64_t from, uint64_t to)
{
    while (to > from) {
        const auto s = r.kept.find(to);
        if (s == r.kept.end())
            return false;
        to = s->second;
    }
    return to == from;
}

uint64_t newest_forth(const remembered &r, uint64_t from)
{
    for (auto s = r.kept.rbegin(); s != r.kept.rend(); ++s)
        if (s->first > from && is_forth(r, from, s->first))
            return s->first;
    return from;
}

/* All states that the cursor reaches, by spreading over strokes until nothing more is reached. */
std::set<uint64_t> reached(const remembered &r)
{
    std::set<uint64_t> all = {r.cursor};
    for (size_t before = 0; before != all.size();) {
        before = all.size();
        for (const auto &[stroke, parent] : r.kept) /* in order: one round goes up a whole branch */
            if (all.count(stroke) || all.count(parent)) {
                all.insert(stroke);
                all.insert(parent);
            }
    }
    return all;
}

void settle(remembered &r)
{
    const std::set<uint64_t> there = reached(r);
    std::erase_if(r.kept, [&](const auto &s) { return !there.count(s.first); });
    if (!is_forth(r, r.cursor, r.tip))
        r.tip = newest_forth(r, r.cursor);
}

struct walker {
    memory_store m;
    std::unique_ptr<piece> p;
    remembered r;
    seeded chance;
    piece_ring limits;
    int refused = 0, wraps = 0, restarts = 0, leaps = 0, forks = 0, lost = 0;

    walker(uint64_t seed, const piece_ring &asked) : chance{seed}, limits(asked)
    {
        p = std::make_unique<piece>(m.port(), limits);
        EXPECT_EQ(p->opened, STATUS_OK);
        r.states[0] = std::make_shared<state>();
        r.stands[0] = {0, 0, r.states[0]};
    }
};

/* A record may have been put since. */
void note(walker &w)
{
    remembered &r = w.r;
    r.stands.insert({w.p->h.sequence, {r.cursor, r.tip, r.states.at(r.cursor)}});
}

/* --- steps --- */

void stretch(walker &w, bool ends)
{
    remembered &r = w.r;
    const piece_stroke stroke = piece_stroke_random(w.chance, 40);
    state next = *r.states.at(r.cursor);
    piece_write_model(next.corners, stroke);
    ASSERT_EQ(w.p->stretch(stroke, ends), STATUS_OK);
    if (next.corners != r.states.at(r.cursor)->corners) {
        next.digest = piece_digest(next.corners);
        if (!r.in_stroke) {
            r.given++;
            r.kept[r.given] = r.began[r.given] = r.cursor;
            r.first_seen[r.given] = w.p->h.sequence;
            r.cursor = r.tip = r.given;
            r.in_stroke = true;
        }
        r.states[r.cursor] = std::make_shared<state>(next);
        note(w);
    }
    r.in_stroke = r.in_stroke && !ends;
}

/* Goes there; on a store that fails it may not have. */
void go(walker &w, history_way way, uint64_t asked, uint64_t to)
{
    remembered &r = w.r;
    const status s = w.p->go(way, asked);
    if (to == r.cursor) {
        ASSERT_TRUE(s == STATUS_HISTORY_ENDS);
        return;
    }
    ASSERT_TRUE(s == STATUS_OK || (w.m.fail_at != 0 && s == STATUS_IO)) << s;
    if (s == STATUS_IO && w.p->h.tree.cursor == r.cursor)
        return;
    r.cursor = to;
    r.tip = is_forth(r, to, r.tip) ? r.tip : newest_forth(r, to);
    note(w);
}

uint64_t redo_of(const remembered &r)
{
    for (const auto &[stroke, parent] : r.kept)
        if (parent == r.cursor && is_forth(r, stroke, r.tip))
            return stroke;
    return r.cursor;
}

uint64_t fork_of(const remembered &r)
{
    std::set<uint64_t> ends;
    for (const auto &[stroke, parent] : r.kept)
        ends.insert(stroke);
    for (const auto &[stroke, parent] : r.kept)
        ends.erase(parent);
    if (ends.empty())
        return r.tip;
    const auto older = ends.lower_bound(r.tip);
    return older == ends.begin() ? *ends.rbegin() : *std::prev(older);
}

/* Of a stroke that had been forgotten and whose last file was written anew an earlier try may be left, of fewer
   stretches: going over it would be refused. As if somebody had tried. */
void drop_remains(walker &w)
{
    tree &t = w.p->h.tree;
    for (uint32_t n = 0; n < t.count;) {
        const tree_stroke s = t.strokes[n];
        const bool whole = w.r.states.count(s.stroke) && w.r.states.at(s.stroke)->digest == s.digest_after;
        if (whole || w.r.kept.count(s.stroke) || s.stroke == t.cursor)
            n++;
        else
            tree_forget(&t, s.stroke);
    }
}

void reopen(walker &w)
{
    remembered &r = w.r;
    const uint64_t kept = w.p->h.kept;
    w.p.reset();
    w.m.fail_at = 0;
    w.m.spoilt.clear(); /* another program, another cache */
    w.m.unsynced.clear();
    w.p = std::make_unique<piece>(w.m.port(), w.limits);
    w.restarts++;
    ASSERT_EQ(w.p->opened, STATUS_OK);
    ASSERT_STREQ(w.p->finding.text, "");
    const history &h = w.p->h;
    ASSERT_GE(h.sequence, kept);
    ASSERT_EQ(r.stands.count(h.sequence), 1u) << "a state that never was: record " << h.sequence;
    const stand now = r.stands.at(h.sequence);
    w.lost += r.stands.upper_bound(h.sequence) != r.stands.end();
    r.stands.erase(r.stands.upper_bound(h.sequence), r.stands.end());
    r.cursor = now.cursor;
    r.states[now.cursor] = now.at;
    r.in_stroke = false;
    r.given = 0;
    for (auto s = r.first_seen.begin(); s != r.first_seen.end();)
        if (s->second > h.sequence) {
            r.kept.erase(s->first);
            s = r.first_seen.erase(s);
        } else {
            r.given = std::max(r.given, (s++)->first);
        }
    drop_remains(w);
    for (uint32_t n = 0; n < h.tree.count; n++) { /* what had been forgotten may be there again */
        const uint64_t stroke = h.tree.strokes[n].stroke;
        ASSERT_EQ(r.first_seen.count(stroke), 1u) << stroke;
        r.kept[stroke] = r.began.at(stroke);
    }
    r.tip = now.tip;
    settle(r);
    if (h.tree.tip != r.tip) { /* what was forgotten since may have moved it, and a checkpoint have said so */
        ASSERT_TRUE(is_forth(r, r.cursor, h.tree.tip));
        r.tip = h.tree.tip;
    }
    ASSERT_NO_FATAL_FAILURE(piece_expect(&w.p->c, r.states.at(r.cursor)->corners));
}

uint64_t any_kept(walker &w)
{
    const std::set<uint64_t> there = reached(w.r);
    auto at = there.begin();
    std::advance(at, seeded_int(w.chance, 0, static_cast<int64_t>(there.size()) - 1));
    return *at;
}

void keep(walker &w)
{
    const status s = w.p->keep();
    ASSERT_TRUE(s == STATUS_OK || (w.m.fail_at != 0 && s == STATUS_IO)) << s;
    w.refused += s != STATUS_OK;
}

void step(walker &w)
{
    remembered &r = w.r;
    const double die = seeded_real(w.chance, 0, 1);
    if (r.in_stroke || die < 0.4) {
        ASSERT_NO_FATAL_FAILURE(stretch(w, seeded_chance(w.chance, 0.7)));
        if (r.in_stroke && seeded_chance(w.chance, 0.5))
            return; /* the keeper need not have come round */
        ASSERT_NO_FATAL_FAILURE(keep(w));
        if (r.in_stroke && seeded_chance(w.chance, 0.1))
            reopen(w);
    } else if (die < 0.62) {
        go(w, HISTORY_BACK, 0, r.kept.count(r.cursor) ? r.kept.at(r.cursor) : r.cursor);
    } else if (die < 0.78) {
        go(w, HISTORY_FORTH, 0, redo_of(r));
    } else if (die < 0.83) {
        w.forks += fork_of(r) != r.cursor;
        go(w, HISTORY_FORK, 0, fork_of(r));
    } else if (die < 0.88) {
        const uint64_t to = any_kept(w);
        w.leaps += to != r.cursor;
        go(w, HISTORY_TO, to, to);
    } else if (die < 0.93) {
        const status s = w.p->field();
        ASSERT_TRUE(s == STATUS_OK || (w.m.fail_at != 0 && s == STATUS_IO)) << s;
    } else {
        reopen(w);
    }
}

/* --- and what must hold after each --- */

/* Does another stroke go, or the tip, when this one does? */
bool takes_others_along(const remembered &r, uint64_t stroke)
{
    uint64_t after = 0, first = 0; /* strokes that began after it; that began where no stroke leads */
    for (const auto &[other, parent] : r.kept) {
        after += parent == stroke;
        first += r.kept.count(parent) == 0;
    }
    const bool end = after == 0 && stroke != r.tip && stroke != r.cursor;
    const bool start = first == 1 && r.kept.count(r.kept.at(stroke)) == 0 && r.kept.at(stroke) != r.cursor;
    return !end && !start;
}

/* One at a time is forgotten: the oldest that takes nothing along; and only when there is a reason. */
void follow_forgetting(walker &w)
{
    remembered &r = w.r;
    const history &h = w.p->h;
    const auto is_gone = [&h](const auto &s) { return tree_find(&h.tree, s.first) == nullptr; };
    while (std::any_of(r.kept.begin(), r.kept.end(), is_gone)) {
        const auto spare = std::find_if(r.kept.begin(), r.kept.end(),
                                        [&r](const auto &s) { return !takes_others_along(r, s.first); });
        ASSERT_NE(spare, r.kept.end());
        ASSERT_EQ(tree_find(&h.tree, spare->first), nullptr) << "another one than stroke " << spare->first << " went";
        ASSERT_TRUE(r.kept.size() > h.settings.strokes ||
                    h.ring.bytes + h.settings.file_bytes > h.settings.budget_bytes)
            << "stroke " << spare->first << " of " << r.kept.size() << " was forgotten without a reason";
        r.kept.erase(spare);
        settle(r);
    }
}

void expect_as_remembered(walker &w)
{
    const remembered &r = w.r;
    const history &h = w.p->h;
    ASSERT_NO_FATAL_FAILURE(follow_forgetting(w));
    ASSERT_EQ(h.tree.cursor, r.cursor);
    ASSERT_EQ(w.p->digest(), r.states.at(r.cursor)->digest);
    ASSERT_EQ(h.digest, r.states.at(r.cursor)->digest);
    ASSERT_EQ(h.tree.count, r.kept.size());
    for (const auto &[stroke, parent] : r.kept) {
        const tree_stroke *s = tree_find(&h.tree, stroke);
        ASSERT_NE(s, nullptr) << stroke;
        ASSERT_EQ(s->parent, parent);
        ASSERT_EQ(s->digest_after, r.states.at(stroke)->digest);
    }
    ASSERT_EQ(h.tree.tip, r.tip);
    ASSERT_EQ(history_can_undo(&h), r.kept.count(r.cursor) == 1);
    ASSERT_EQ(history_can_redo(&h), r.tip != r.cursor);
    ASSERT_EQ(w.m.misuse, "");
    ASSERT_TRUE(clay_is_valid(&w.p->c));
}

/* Once two checkpoints lie beneath all, there are no more strokes than were asked for, unless redo goes over them all. */
void expect_no_more_than_asked(walker &w)
{
    if (w.r.in_stroke)
        return;
    w.m.fail_at = 0;
    for (int n = 0; n < 2; n++)
        ASSERT_EQ(w.p->field(), STATUS_OK);
    ASSERT_EQ(w.p->keep(), STATUS_OK);
    ASSERT_NO_FATAL_FAILURE(expect_as_remembered(w));
    const bool all_ahead = w.r.kept.size() == w.p->h.tree.count && w.r.kept.begin()->second == w.r.cursor &&
                           is_forth(w.r, w.r.cursor, w.r.kept.rbegin()->first);
    ASSERT_TRUE(w.p->h.tree.count <= w.limits.strokes || all_ahead) << w.p->h.tree.count;
}

void expect_wraps(walker &w)
{
    for (uint32_t n = 0; n < w.p->h.ring.count; n++)
        w.wraps += w.p->h.ring.files[n].use > w.p->h.ring.count;
}

void walk(uint64_t seed, const piece_ring &limits, int steps)
{
    walker w(seed, limits);
    size_t corners = 0;
    for (int n = 0; n < steps; n++) {
        SCOPED_TRACE("seed " + std::to_string(seed) + " strokes " + std::to_string(limits.strokes) + " step " +
                     std::to_string(n));
        ASSERT_NO_FATAL_FAILURE(step(w));
        ASSERT_NO_FATAL_FAILURE(expect_as_remembered(w));
        if (n % 100 == 99) {
            ASSERT_NO_FATAL_FAILURE(expect_no_more_than_asked(w));
        }
        corners = std::max(corners, w.r.states.at(w.r.cursor)->corners.size());
    }
    expect_wraps(w);
    EXPECT_GT(corners, 50u) << "a walk that never gets anywhere proves nothing";
    EXPECT_GT(w.restarts, 0);
    EXPECT_GT(w.leaps, 0);
    if (limits.strokes > 1) {
        EXPECT_GT(w.forks, 0);
    }
    if (limits.strokes <= 20) {
        EXPECT_GT(w.wraps, 0) << "no file was ever written anew";
    }
}

TEST(history_walk, is_a_tree_of_states)
{
    const uint32_t all[] = {1, 2, 3, 4, 7, 20, 60, 200};
    uint64_t seed = 1;
    for (const uint32_t strokes : all)
        walk(seed++, {strokes, RING_FILE_BYTES_MIN, uint64_t{RING_FILE_BYTES_MIN} * 1000}, steps_in_all() * 6 / 10 / 8);
}

TEST(history_walk, small_budget_reaches_less_far_and_as_exactly)
{
    for (uint64_t seed = 50; seed < 52; seed++)
        walk(seed, {20, RING_FILE_BYTES_MIN, uint64_t{RING_FILE_BYTES_MIN} * (8 + 4 * (seed % 2))},
             steps_in_all() / 10 / 2);
}

TEST(history_walk, failing_store_loses_nothing_that_was_kept)
{
    int refused = 0, lost = 0;
    for (uint64_t seed = 100; seed < 105; seed++) {
        walker w(seed, {static_cast<uint32_t>(2 + 5 * (seed % 5)), RING_FILE_BYTES_MIN,
                        uint64_t{RING_FILE_BYTES_MIN} * 1000});
        for (int n = 0; n < steps_in_all() * 3 / 10 / 5; n++) {
            SCOPED_TRACE("seed " + std::to_string(seed) + " step " + std::to_string(n));
            w.m.fail_having_done = seeded_chance(w.chance, 0.5);
            w.m.fail_on = seeded_chance(w.chance, 0.5);
            w.m.fail_at =
                seeded_chance(w.chance, 0.4) ? w.m.calls + static_cast<uint64_t>(seeded_int(w.chance, 1, 12)) : 0;
            const int before = w.refused;
            ASSERT_NO_FATAL_FAILURE(step(w));
            w.m.fail_at = 0;
            if (w.refused > before && seeded_chance(w.chance, 0.3)) {
                ASSERT_NO_FATAL_FAILURE(reopen(w));
            }
            ASSERT_NO_FATAL_FAILURE(expect_as_remembered(w));
        }
        refused += w.refused;
        lost += w.lost;
        w.m.fail_at = 0;
        if (w.r.in_stroke) {
            ASSERT_NO_FATAL_FAILURE(stretch(w, true));
        }
        ASSERT_EQ(w.p->keep(), STATUS_OK) << "what was held is kept in the end";
        const uint64_t digest = w.p->digest();
        ASSERT_NO_FATAL_FAILURE(reopen(w));
        EXPECT_EQ(w.p->digest(), digest);
    }
    EXPECT_GT(refused, 20);
    EXPECT_GT(lost, 0) << "something put and not kept should have been lost by a restart now and then";
}

} // namespace
