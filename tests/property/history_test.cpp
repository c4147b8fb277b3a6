/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: over any walk of strokes, undo, redo, new strokes after undo, checkpoints and restarts, on a good store and on
 *       one that fails now and then, the clay is what a list of whole states says, and history reaches exactly as far.
 * Method: the list holds every corner of every state still within the ring, in sorted maps that share nothing with
 *         clay; digests are compared with those of clay made anew from each map. Thousands of seeded steps, rings from
 *         1 up. */
#include "history/history.h"

#include "tests/property/seeded.h"
#include "tests/unit/history/memory_store.h"
#include "tests/unit/history/piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

namespace {

struct state {
    piece_model corners;
    uint64_t digest;
};

/* States oldest-1 .. newest; at: the one the clay should be in. */
struct remembered {
    std::deque<state> states = {{{}, 0}};
    size_t at = 0;
    uint32_t ring;
};

void remember_stroke(remembered &r, const piece_stroke &stroke)
{
    piece_model next = r.states[r.at].corners;
    piece_write_model(next, stroke);
    if (next == r.states[r.at].corners)
        return;
    r.states.resize(r.at + 1);
    r.states.push_back({next, piece_digest(next)});
    if (r.states.size() > r.ring + 1)
        r.states.pop_front();
    else
        r.at++;
}

struct walker {
    memory_store m;
    std::unique_ptr<piece> p;
    remembered r;
    seeded chance;
    int refused = 0;
    bool refused_since_moved = false;

    walker(uint64_t seed, uint32_t ring) : chance{seed}
    {
        r.ring = ring;
        p = std::make_unique<piece>(m.port(), ring);
        EXPECT_EQ(p->opened, STATUS_OK);
    }
};

void expect_as_remembered(const walker &w)
{
    const remembered &r = w.r;
    ASSERT_EQ(w.p->digest(), r.states[r.at].digest);
    ASSERT_EQ(history_can_undo(&w.p->h), r.at > 0);
    ASSERT_EQ(history_can_redo(&w.p->h), r.at + 1 < r.states.size());
    ASSERT_EQ(w.p->h.newest - w.p->h.cursor, r.states.size() - 1 - r.at);
    ASSERT_EQ(w.p->h.cursor + 1 - w.p->h.oldest, r.at);
    ASSERT_EQ(w.m.misuse, "");
}

void reopen(walker &w)
{
    w.p.reset();
    w.p = std::make_unique<piece>(w.m.port(), 1 + w.r.ring % 7);
    ASSERT_EQ(w.p->opened, STATUS_OK);
    ASSERT_STREQ(w.p->finding.text, "");
    ASSERT_NO_FATAL_FAILURE(piece_expect(&w.p->c, w.r.states[w.r.at].corners));
}

void step(walker &w)
{
    remembered &r = w.r;
    const double die = seeded_real(w.chance, 0, 1);
    if (die < 0.4) {
        const piece_stroke stroke = piece_stroke_random(w.chance, 60);
        ASSERT_EQ(w.p->stroke(stroke), STATUS_OK);
        remember_stroke(r, stroke);
    } else if (die < 0.68) {
        ASSERT_EQ(w.p->undo(), r.at > 0 ? STATUS_OK : STATUS_HISTORY_ENDS);
        r.at -= r.at > 0;
    } else if (die < 0.9) {
        const bool more = r.at + 1 < r.states.size();
        ASSERT_EQ(w.p->redo(), more ? STATUS_OK : STATUS_HISTORY_ENDS);
        r.at += more;
    } else if (die < 0.95) {
        ASSERT_EQ(history_checkpoint(&w.p->h, &w.p->c), STATUS_OK);
    } else {
        reopen(w);
    }
}

void walk(uint64_t seed, uint32_t ring, int steps)
{
    walker w(seed, ring);
    size_t corners = 0;
    for (int n = 0; n < steps; n++) {
        SCOPED_TRACE("seed " + std::to_string(seed) + " ring " + std::to_string(ring) + " step " + std::to_string(n));
        ASSERT_NO_FATAL_FAILURE(step(w));
        ASSERT_NO_FATAL_FAILURE(expect_as_remembered(w));
        corners = std::max(corners, w.r.states[w.r.at].corners.size());
    }
    EXPECT_GT(corners, 50u) << "a walk that never gets anywhere proves nothing";
}

TEST(history_walk, is_a_list_of_states)
{
    uint64_t seed = 1;
    for (uint32_t ring : {1u, 2u, 3u, 7u, 20u, 200u})
        walk(seed++, ring, seeded_steps(700));
}

/* --- now and then a call to the store fails --- */

/* A refused step leaves all as it was, but for what history says it may forget: after a refused stroke, the undone ones
   and the oldest. The list is cut to what is left. */
void accept_forgetting(walker &w)
{
    remembered &r = w.r;
    const size_t redo_left = w.p->h.newest - w.p->h.cursor, undo_left = w.p->h.cursor + 1 - w.p->h.oldest;
    ASSERT_TRUE(redo_left == r.states.size() - 1 - r.at || redo_left == 0);
    ASSERT_TRUE(undo_left == r.at || (undo_left + 1 == r.at && r.at == r.ring));
    r.states.resize(r.at + 1 + redo_left);
    if (undo_left + 1 == r.at) {
        r.states.pop_front();
        r.at--;
    }
}

void failing_step(walker &w)
{
    remembered &r = w.r;
    const uint64_t cursor = w.p->h.cursor;
    w.m.fail_having_done = seeded_chance(w.chance, 0.5);
    w.m.fail_at = seeded_chance(w.chance, 0.3) ? w.m.calls + static_cast<uint64_t>(seeded_int(w.chance, 1, 20)) : 0;
    const double die = seeded_real(w.chance, 0, 1);
    status s;
    if (die < 0.45) {
        const piece_stroke stroke = piece_stroke_random(w.chance, 30);
        s = w.p->stroke(stroke);
        if (s == STATUS_OK)
            remember_stroke(r, stroke);
    } else if (die < 0.75) {
        s = w.p->undo();
        r.at -= s == STATUS_OK;
    } else if (die < 0.95) {
        s = w.p->redo();
        r.at += s == STATUS_OK;
    } else {
        s = history_checkpoint(&w.p->h, &w.p->c);
    }
    w.m.fail_at = 0;
    ASSERT_TRUE(s == STATUS_OK || s == STATUS_IO || s == STATUS_HISTORY_ENDS);
    if (s == STATUS_OK && w.p->h.cursor != cursor)
        w.refused_since_moved = false;
    if (s == STATUS_IO) {
        w.refused++;
        w.refused_since_moved = true;
        accept_forgetting(w);
    }
}

/* The files alone lead to the sculpture as it is; after a refused step, until the cursor moves again, they may lead to
   where that step would have led. */
void expect_files_lead_here(const walker &w)
{
    memory_store copy;
    copy.files = w.m.files;
    piece q(copy.port());
    ASSERT_EQ(q.opened, STATUS_OK);
    ASSERT_STREQ(q.finding.text, "");
    ASSERT_TRUE(w.refused_since_moved || q.digest() == w.p->digest());
}

TEST(history_walk, failing_store_refuses_steps_and_loses_nothing)
{
    int refused = 0;
    for (uint64_t seed = 100; seed < 106; seed++) {
        walker w(seed, static_cast<uint32_t>(1 + seed % 5));
        for (int n = 0; n < seeded_steps(300); n++) {
            SCOPED_TRACE("seed " + std::to_string(seed) + " step " + std::to_string(n));
            ASSERT_NO_FATAL_FAILURE(failing_step(w));
            ASSERT_NO_FATAL_FAILURE(expect_as_remembered(w));
            ASSERT_NO_FATAL_FAILURE(expect_files_lead_here(w));
        }
        refused += w.refused;
    }
    EXPECT_GT(refused, 100);
}

} // namespace
