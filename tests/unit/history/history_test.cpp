/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: what was done can be undone and redone to the exact digest, as far as the ring reaches, across restarts; what a
 *       failing store refuses is refused whole; and at every moment the files alone lead to the sculpture as it is.
 * Method: numbered strokes with all digests kept; after every step a copy of the files is opened beside; a store that
 *         fails at each of its calls in turn, before and after the work; files damaged under an open history. */
#include "history/history.h"

#include "tests/unit/history/memory_store.h"
#include "tests/unit/history/piece.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

namespace {

/* Opens a copy of the files: it must stand where this one does and reach as far. */
void expect_reopens(const piece &p, const memory_store &m)
{
    memory_store copy;
    copy.files = m.files;
    piece q(copy.port(), 77);
    ASSERT_EQ(q.opened, STATUS_OK);
    ASSERT_STREQ(q.finding.text, "");
    ASSERT_EQ(q.digest(), p.digest());
    ASSERT_EQ(q.h.cursor, p.h.cursor);
    ASSERT_EQ(q.h.oldest, p.h.oldest);
    ASSERT_EQ(q.h.newest, p.h.newest);
    ASSERT_EQ(q.h.dab, p.h.dab);
    ASSERT_EQ(q.h.step_mm, p.h.step_mm);
    ASSERT_EQ(q.h.ring, p.h.ring);
    ASSERT_TRUE(clay_is_valid(&q.c));
    ASSERT_EQ(copy.misuse, "");
}

/* Strokes first..last, numbered; digests[n] is that after stroke n. */
void stroke_to(piece &p, std::vector<uint64_t> &digests, int first, int last)
{
    if (digests.empty())
        digests.push_back(p.digest());
    digests.resize(static_cast<size_t>(first));
    for (int n = first; n <= last; n++) {
        p.h.dab += 3;
        ASSERT_EQ(p.stroke(piece_stroke_numbered(n)), STATUS_OK);
        digests.push_back(p.digest());
        ASSERT_NE(digests[static_cast<size_t>(n)], digests[static_cast<size_t>(n) - 1]);
    }
}

/* --- opening --- */

TEST(history, new_store_is_empty_and_stays_so)
{
    memory_store m;
    piece p(m.port());
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_STREQ(p.finding.text, "");
    EXPECT_EQ(clay_brick_count(&p.c), 0u);
    EXPECT_FALSE(history_can_undo(&p.h));
    EXPECT_FALSE(history_can_redo(&p.h));
    EXPECT_EQ(p.undo(), STATUS_HISTORY_ENDS);
    EXPECT_EQ(p.redo(), STATUS_HISTORY_ENDS);
    EXPECT_EQ(p.h.step_mm, 0.5);
    EXPECT_EQ(m.files.size(), 2u);
    expect_reopens(p, m);
    EXPECT_EQ(m.misuse, "");
}

TEST(history, parameters_out_of_range_are_refused_untouched)
{
    for (uint32_t ring : {0u, 10000u}) {
        memory_store m;
        piece p(m.port(), ring);
        EXPECT_EQ(p.opened, STATUS_BAD_PARAMETER);
        EXPECT_EQ(m.calls, 0u);
    }
    for (double step : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
        memory_store m;
        piece_clay c;
        history h;
        history_finding f;
        EXPECT_EQ(history_open(&h, m.port(), 10, step, &c.c, &f), STATUS_BAD_PARAMETER);
        EXPECT_EQ(m.calls, 0u);
    }
}

TEST(history, what_opening_brings_up_is_all_dirty)
{
    memory_store m;
    {
        piece p(m.port());
        std::vector<uint64_t> digests;
        stroke_to(p, digests, 1, 30);
        ASSERT_EQ(history_checkpoint(&p.h, &p.c), STATUS_OK);
        stroke_to(p, digests, 31, 60);
    }
    piece q(m.port());
    ASSERT_EQ(q.opened, STATUS_OK);
    ASSERT_GT(clay_brick_count(&q.c), 10u);
    EXPECT_EQ(dirt_count(&q.c.dirty), clay_brick_count(&q.c));
    avl_walk w;
    key at;
    uint32_t id;
    for (bool more = avl_first(&w, &q.c.tree, &at, &id); more; more = avl_next(&w, &at, &id)) {
        const dirt_entry *dirty = clay_dirt(&q.c, at);
        ASSERT_NE(dirty, nullptr);
        for (int slot = 0; slot < BRICK_CORNERS; slot++)
            ASSERT_TRUE(brick_mask_has(&dirty->corners, slot));
    }
}

/* --- back and forth --- */

TEST(history, undo_and_redo_are_exact_and_files_follow)
{
    memory_store m;
    piece p(m.port(), 10);
    std::vector<uint64_t> digests;
    stroke_to(p, digests, 1, 8);
    for (int round = 0; round < 2; round++) {
        for (size_t n = 8; n > 0; n--) {
            EXPECT_TRUE(history_can_undo(&p.h));
            ASSERT_EQ(p.undo(), STATUS_OK);
            ASSERT_EQ(p.digest(), digests[n - 1]);
            expect_reopens(p, m);
        }
        EXPECT_EQ(p.undo(), STATUS_HISTORY_ENDS);
        EXPECT_EQ(clay_brick_count(&p.c), 0u);
        for (size_t n = 1; n <= 8; n++) {
            EXPECT_TRUE(history_can_redo(&p.h));
            ASSERT_EQ(p.redo(), STATUS_OK);
            ASSERT_EQ(p.digest(), digests[n]);
            expect_reopens(p, m);
        }
        EXPECT_EQ(p.redo(), STATUS_HISTORY_ENDS);
    }
    EXPECT_EQ(m.misuse, "");
}

TEST(history, a_step_marks_what_it_changed)
{
    memory_store m;
    piece p(m.port());
    ASSERT_EQ(p.stroke({{{0, 0, 0}, 1, 1}, {{50, 0, 0}, 1, 1}}), STATUS_OK);
    ASSERT_EQ(history_undo(&p.h, &p.c), STATUS_OK);
    EXPECT_EQ(dirt_count(&p.c.dirty), 2u);
    EXPECT_FALSE(p.c.changes.recording);
}

TEST(history, stroke_that_changed_nothing_makes_no_file)
{
    memory_store m;
    piece p(m.port());
    ASSERT_EQ(p.stroke({{{0, 0, 0}, 1, 1}}), STATUS_OK);
    const auto files = m.files;
    ASSERT_EQ(p.stroke({{{0, 0, 0}, 1, 1}, {{90, 0, 0}, 0, 0}}), STATUS_OK);
    EXPECT_EQ(m.files, files);
    EXPECT_EQ(p.h.cursor, 1u);
    EXPECT_FALSE(p.c.changes.recording);
    ASSERT_EQ(p.undo(), STATUS_OK);
    EXPECT_EQ(clay_brick_count(&p.c), 0u);
}

TEST(history, new_stroke_takes_the_place_of_undone_ones)
{
    memory_store m;
    piece p(m.port(), 10);
    std::vector<uint64_t> digests;
    stroke_to(p, digests, 1, 6);
    for (int n = 0; n < 3; n++)
        ASSERT_EQ(p.undo(), STATUS_OK);
    ASSERT_EQ(p.stroke({{{0, 0, 77}, 1, 1}}), STATUS_OK);
    EXPECT_FALSE(history_can_redo(&p.h));
    EXPECT_EQ(p.h.cursor, 4u);
    expect_reopens(p, m);
    ASSERT_EQ(p.undo(), STATUS_OK);
    EXPECT_EQ(p.digest(), digests[3]);
}

/* --- the ring --- */

TEST(history, ring_of_200_keeps_the_last_200_of_500)
{
    memory_store m;
    std::vector<uint64_t> digests;
    {
        piece p(m.port());
        stroke_to(p, digests, 1, 500);
        size_t undo_files = 0;
        for (const auto &[name, bytes] : m.files)
            undo_files += name.starts_with("undo-");
        EXPECT_EQ(undo_files, 200u);
    }
    for (int restarts = 0; restarts < 2; restarts++) {
        piece p(m.port());
        ASSERT_EQ(p.opened, STATUS_OK);
        EXPECT_STREQ(p.finding.text, "");
        ASSERT_EQ(p.digest(), digests[500]);
        for (size_t n = 500; n > 300; n--) {
            ASSERT_EQ(p.undo(), STATUS_OK) << n;
            ASSERT_EQ(p.digest(), digests[n - 1]);
        }
        EXPECT_EQ(p.undo(), STATUS_HISTORY_ENDS) << "the 201st";
        EXPECT_EQ(p.digest(), digests[300]);
        expect_reopens(p, m);
        for (size_t n = 301; n <= 500; n++) {
            ASSERT_EQ(p.redo(), STATUS_OK) << n;
            ASSERT_EQ(p.digest(), digests[n]);
        }
        EXPECT_EQ(p.redo(), STATUS_HISTORY_ENDS);
    }
    EXPECT_EQ(m.misuse, "");
}

TEST(history, small_rings_lead_to_the_cursor_at_every_step)
{
    for (uint32_t ring : {1u, 2u, 3u, 5u}) {
        memory_store m;
        piece p(m.port(), ring);
        std::vector<uint64_t> digests;
        for (int n = 1; n <= 17; n++) {
            stroke_to(p, digests, n, n);
            expect_reopens(p, m);
        }
        for (size_t n = 17; n > 17 - ring; n--) {
            ASSERT_EQ(p.undo(), STATUS_OK);
            ASSERT_EQ(p.digest(), digests[n - 1]);
            expect_reopens(p, m);
        }
        EXPECT_EQ(p.undo(), STATUS_HISTORY_ENDS);
        stroke_to(p, digests, static_cast<int>(p.h.cursor) + 1, 20);
        expect_reopens(p, m);
    }
}

TEST(history, new_stroke_below_the_checkpoint_writes_a_new_one_first)
{
    memory_store m;
    piece p(m.port(), 10);
    std::vector<uint64_t> digests;
    stroke_to(p, digests, 1, 6);
    ASSERT_EQ(history_checkpoint(&p.h, &p.c), STATUS_OK);
    EXPECT_EQ(p.h.checkpoint, 6u);
    for (int n = 0; n < 4; n++) {
        ASSERT_EQ(p.undo(), STATUS_OK);
        expect_reopens(p, m);
    }
    ASSERT_EQ(p.stroke({{{0, 0, 77}, 1, 1}}), STATUS_OK);
    EXPECT_EQ(p.h.checkpoint, 2u);
    expect_reopens(p, m);
    ASSERT_EQ(p.undo(), STATUS_OK);
    EXPECT_EQ(p.digest(), digests[2]) << "the checkpoint was written while the stroke stood in the clay";
    expect_reopens(p, m);
    ASSERT_EQ(p.undo(), STATUS_OK);
    EXPECT_EQ(p.digest(), digests[1]);
}

TEST(history, checkpoint_during_a_stroke_leaves_the_stroke_out)
{
    memory_store m;
    piece p(m.port(), 10);
    std::vector<uint64_t> digests;
    stroke_to(p, digests, 1, 3);
    clay_change_begin(&p.c);
    ASSERT_EQ(piece_write(&p.c, {{{0, 0, 77}, 1, 1}, {{-6, 0, 0}, 0, 0}}), STATUS_OK);
    ASSERT_EQ(history_checkpoint(&p.h, &p.c), STATUS_OK);
    ASSERT_NE(p.digest(), digests[3]);
    clay_change_revert(&p.c);
    EXPECT_EQ(p.digest(), digests[3]);
    expect_reopens(p, m);
}

/* --- a store that fails --- */

struct failing_case {
    const char *what;
    std::function<void(piece &)> prepare;
    std::function<status(piece &)> act;
};

/* Fails each call of the act in turn. The clay stays as it was, the files lead to before or after, and a second try
   succeeds. */
void fail_each_call(const failing_case &f, bool having_done)
{
    for (uint64_t nth = 1;; nth++) {
        memory_store m;
        piece p(m.port(), 4);
        std::vector<uint64_t> digests;
        stroke_to(p, digests, 1, 6);
        f.prepare(p);
        const uint64_t before = p.digest();
        m.fail_at = m.calls + nth;
        m.fail_having_done = having_done;
        const status s = f.act(p);
        const bool failed = m.calls >= m.fail_at;
        m.fail_at = 0;
        if (!failed) {
            EXPECT_GT(nth, 4u) << f.what;
            ASSERT_EQ(s, STATUS_OK);
            break;
        }
        ASSERT_EQ(s, STATUS_IO) << f.what << " " << nth;
        ASSERT_EQ(p.digest(), before) << f.what << " " << nth;
        ASSERT_TRUE(clay_is_valid(&p.c));
        ASSERT_FALSE(p.c.changes.recording);
        memory_store copy;
        copy.files = m.files;
        ASSERT_EQ(f.act(p), STATUS_OK) << f.what << " " << nth;
        const uint64_t after = p.digest();
        {
            piece q(copy.port(), 4);
            ASSERT_EQ(q.opened, STATUS_OK);
            ASSERT_STREQ(q.finding.text, "") << f.what << " " << nth;
            ASSERT_TRUE(q.digest() == before || q.digest() == after) << f.what << " " << nth;
        }
        expect_reopens(p, m);
        ASSERT_EQ(m.misuse, "") << f.what << " " << nth;
    }
}

TEST(history, failing_store_changes_nothing)
{
    const auto nothing = [](piece &) {};
    const auto undone = [](piece &p) {
        for (int n = 0; n < 2; n++)
            ASSERT_EQ(p.undo(), STATUS_OK);
    };
    const auto above = [](piece &p) {
        ASSERT_EQ(history_checkpoint(&p.h, &p.c), STATUS_OK);
        for (int n = 0; n < 3; n++)
            ASSERT_EQ(p.undo(), STATUS_OK);
    };
    const auto stroke = [](piece &p) { return p.stroke({{{0, 0, 77}, 1, 1}, {{-3, 0, 0}, 0, 0}}); };
    const auto checkpoint = [](piece &p) { return history_checkpoint(&p.h, &p.c); };
    const auto undo = [](piece &p) { return p.undo(); };
    const auto redo = [](piece &p) { return p.redo(); };
    const std::vector<failing_case> all = {
        {"stroke", nothing, stroke},         {"stroke after undo", undone, stroke},
        {"stroke below the field", above, stroke}, {"undo", nothing, undo},
        {"undo below the field", above, undo},     {"redo", undone, redo},
        {"redo up to the field", above, redo},     {"checkpoint", undone, checkpoint},
    };
    for (const failing_case &f : all)
        for (bool having_done : {false, true})
            fail_each_call(f, having_done);
}

TEST(history, checkpoint_whose_rename_failed_is_not_counted_on)
{
    /* The new field may be on the medium all the same: then strokes below it must not be replaced. */
    memory_store m;
    piece p(m.port(), 10);
    std::vector<uint64_t> digests;
    stroke_to(p, digests, 1, 6);
    m.fail_having_done = true;
    for (uint64_t nth = 1; p.h.checkpoint_known; nth++) {
        m.fail_at = m.calls + nth;
        ASSERT_EQ(history_checkpoint(&p.h, &p.c), STATUS_IO);
    }
    m.fail_at = 0;
    for (int n = 0; n < 3; n++)
        ASSERT_EQ(p.undo(), STATUS_OK);
    ASSERT_EQ(p.stroke({{{0, 0, 77}, 1, 1}}), STATUS_OK);
    expect_reopens(p, m);
}

TEST(history, opening_on_a_failing_store_is_refused_and_leaves_the_files)
{
    memory_store good;
    std::vector<uint64_t> digests;
    {
        piece p(good.port(), 4);
        stroke_to(p, digests, 1, 6);
    }
    for (uint64_t nth = 1;; nth++) {
        memory_store m = good;
        m.calls = 0;
        m.fail_at = nth;
        piece p(m.port(), 4);
        if (m.calls < nth)
            break;
        EXPECT_TRUE(p.opened == STATUS_IO || p.digest() == digests[6]);
        if (p.opened != STATUS_OK) {
            EXPECT_EQ(clay_brick_count(&p.c), 0u);
        }
        for (const auto &[name, bytes] : good.files)
            EXPECT_TRUE(m.files.count(name) == 1 && (name == "cursor" || m.files[name] == bytes)) << name;
    }
}

/* --- files that are damaged while history is open --- */

void spoil(memory_store &m, const std::string &name) { m.files.at(name)[100] ^= 0x10; }

TEST(history, damaged_undo_file_ends_history_on_that_side)
{
    for (bool missing : {false, true}) {
        memory_store m;
        piece p(m.port(), 10);
        std::vector<uint64_t> digests;
        stroke_to(p, digests, 1, 6);
        ASSERT_EQ(p.undo(), STATUS_OK);
        if (missing)
            m.files.erase("undo-0004");
        else
            spoil(m, "undo-0004");
        ASSERT_EQ(p.undo(), STATUS_OK);
        EXPECT_EQ(p.undo(), STATUS_CORRUPT);
        EXPECT_EQ(p.digest(), digests[4]);
        EXPECT_EQ(p.undo(), STATUS_HISTORY_ENDS);
        EXPECT_EQ(m.files.count("undo-0004"), 0u);
        EXPECT_EQ(m.files.count("undo-0004.set-aside"), missing ? 0u : 1u);
        EXPECT_EQ(p.h.checkpoint, 4u) << "nothing else leads to the cursor now";
        expect_reopens(p, m);
        ASSERT_EQ(p.redo(), STATUS_OK);
        ASSERT_EQ(p.redo(), STATUS_OK);
        EXPECT_EQ(p.digest(), digests[6]);
        expect_reopens(p, m);
        EXPECT_EQ(m.misuse, "");
    }
}

TEST(history, damaged_redo_file_ends_history_on_that_side)
{
    memory_store m;
    piece p(m.port(), 10);
    std::vector<uint64_t> digests;
    stroke_to(p, digests, 1, 6);
    ASSERT_EQ(history_checkpoint(&p.h, &p.c), STATUS_OK);
    for (int n = 0; n < 4; n++)
        ASSERT_EQ(p.undo(), STATUS_OK);
    spoil(m, "undo-0004");
    ASSERT_EQ(p.redo(), STATUS_OK);
    EXPECT_EQ(p.redo(), STATUS_CORRUPT);
    EXPECT_EQ(p.redo(), STATUS_HISTORY_ENDS);
    EXPECT_EQ(p.digest(), digests[3]);
    for (const char *name : {"undo-0004", "undo-0005", "undo-0006"}) {
        EXPECT_EQ(m.files.count(name), 0u);
        EXPECT_EQ(m.files.count(std::string(name) + ".set-aside"), 1u);
    }
    expect_reopens(p, m);
    ASSERT_EQ(p.undo(), STATUS_OK);
    EXPECT_EQ(p.digest(), digests[2]);
}

TEST(history, file_of_another_stroke_that_did_the_same_is_not_believed)
{
    memory_store m;
    piece p(m.port(), 10);
    const piece_stroke there = {{{0, 0, 0}, 1, 1}}, gone = {{{0, 0, 0}, 0, 0}};
    for (const piece_stroke &s : {there, gone, there})
        ASSERT_EQ(p.stroke(s), STATUS_OK);
    m.files["undo-0003"] = m.files["undo-0001"];
    EXPECT_EQ(p.undo(), STATUS_CORRUPT);
    EXPECT_EQ(clay_brick_count(&p.c), 1u);
    expect_reopens(p, m);
}

TEST(history, file_of_another_stroke_is_not_believed)
{
    memory_store m;
    piece p(m.port(), 10);
    std::vector<uint64_t> digests;
    stroke_to(p, digests, 1, 6);
    m.files["undo-0006"] = m.files["undo-0005"];
    EXPECT_EQ(p.undo(), STATUS_CORRUPT);
    EXPECT_EQ(p.digest(), digests[6]);
    EXPECT_EQ(p.undo(), STATUS_HISTORY_ENDS);
    expect_reopens(p, m);
}

} // namespace
