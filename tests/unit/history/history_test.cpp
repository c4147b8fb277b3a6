/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: every step leaves files that lead to the sculpture as it is; undo reaches as far as was asked for and is exact.
 * Method: digests remembered from the way up; after each step another history opens a copy of the files. What a store
 *         that fails or is full costs is in history_keep_test.cpp, long random walks in
 *         tests/property/history_test.cpp, power cuts in tests/crash. */
#include "history/history.h"

#include "tests/unit/history/piece_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

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
    for (history_way way : {HISTORY_BACK, HISTORY_FORTH, HISTORY_FORK, HISTORY_TO})
        EXPECT_EQ(p.go(way, 0), STATUS_HISTORY_ENDS);
    EXPECT_EQ(p.go(HISTORY_TO, 5), STATUS_HISTORY_ENDS);
    EXPECT_EQ(p.h.step_mm, 0.5);
    EXPECT_TRUE(m.files.empty());
    EXPECT_EQ(history_room(&p.h), STATUS_OK);
    piece_steps_reopen(p, m);
    EXPECT_EQ(m.misuse, "");
}

TEST(history, settings_out_of_range_are_refused_untouched)
{
    const history_settings usual = HISTORY_SETTINGS_DEFAULT;
    std::vector<history_settings> all(6, usual);
    all[0].strokes = 0;
    all[1].strokes = HISTORY_STROKES_MAX + 1;
    all[2].file_bytes = PIECE_STEPS_FILE_BYTES - RECORD_BLOCK_BYTES;
    all[3].file_bytes = PIECE_STEPS_FILE_BYTES + 512;
    all[4].budget_bytes = usual.file_bytes - 1;
    all[5].file_bytes = 0;
    for (const history_settings &s : all) {
        memory_store m;
        piece_clay c;
        history h;
        history_finding f;
        EXPECT_EQ(history_open(&h, m.port(), &s, 0.5, &c.c, &f), STATUS_BAD_PARAMETER);
        EXPECT_EQ(m.calls, 0u);
    }
    for (double step : {0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
        memory_store m;
        piece_clay c;
        history h;
        history_finding f;
        EXPECT_EQ(history_open(&h, m.port(), &usual, step, &c.c, &f), STATUS_BAD_PARAMETER);
        EXPECT_EQ(m.calls, 0u);
    }
}

TEST(history, what_opening_brings_up_is_all_dirty)
{
    memory_store m;
    {
        piece p(m.port());
        std::vector<uint64_t> digests;
        piece_steps_up_to(p, digests, 1, 30);
        ASSERT_EQ(p.field(), STATUS_OK);
        piece_steps_up_to(p, digests, 31, 60);
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
        EXPECT_EQ(brick_mask_count(&dirty->corners), static_cast<uint32_t>(BRICK_CORNERS));
    }
}

/* --- back and forth --- */

TEST(history, undo_and_redo_are_exact_and_files_follow)
{
    memory_store m;
    piece p(m.port(), piece_steps_ring(10));
    std::vector<uint64_t> digests;
    piece_steps_up_to(p, digests, 1, 8);
    for (int round = 0; round < 2; round++) {
        for (size_t n = 8; n > 0; n--) {
            EXPECT_TRUE(history_can_undo(&p.h));
            ASSERT_EQ(p.undo(), STATUS_OK);
            ASSERT_EQ(p.digest(), digests[n - 1]);
            piece_steps_reopen(p, m);
        }
        EXPECT_EQ(p.undo(), STATUS_HISTORY_ENDS);
        EXPECT_EQ(clay_brick_count(&p.c), 0u);
        for (size_t n = 1; n <= 8; n++) {
            EXPECT_TRUE(history_can_redo(&p.h));
            ASSERT_EQ(p.redo(), STATUS_OK);
            ASSERT_EQ(p.digest(), digests[n]);
            piece_steps_reopen(p, m);
        }
        EXPECT_EQ(p.redo(), STATUS_HISTORY_ENDS);
    }
    EXPECT_EQ(m.misuse, "");
}

TEST(history, stroke_that_changed_nothing_makes_no_record)
{
    memory_store m;
    piece p(m.port());
    ASSERT_EQ(p.stroke({{{0, 0, 0}, 1, 1}}), STATUS_OK);
    const auto files = m.files;
    ASSERT_EQ(p.stroke({{{0, 0, 0}, 1, 1}, {{90, 0, 0}, 0, 0}}), STATUS_OK);
    EXPECT_EQ(m.files, files);
    EXPECT_EQ(p.h.tree.cursor, 1u);
    EXPECT_EQ(p.h.sequence, 1u);
    EXPECT_FALSE(p.h.in_stroke);
    ASSERT_EQ(p.undo(), STATUS_OK);
    EXPECT_EQ(clay_brick_count(&p.c), 0u);
}

TEST(history, new_stroke_after_undo_takes_nothing_away)
{
    memory_store m;
    piece p(m.port());
    std::vector<uint64_t> digests;
    piece_steps_up_to(p, digests, 1, 6);
    for (int n = 0; n < 3; n++)
        ASSERT_EQ(p.undo(), STATUS_OK);
    ASSERT_EQ(p.stroke({{{0, 0, 77}, 1, 1}}), STATUS_OK);
    digests.push_back(p.digest());
    EXPECT_EQ(p.h.tree.cursor, 7u);
    EXPECT_FALSE(history_can_redo(&p.h));
    EXPECT_EQ(tree_branches(&p.h.tree), 2u);
    for (const uint64_t to : {6, 7, 6}) { /* round the two ends */
        ASSERT_EQ(p.go(HISTORY_FORK), STATUS_OK);
        EXPECT_EQ(p.h.tree.cursor, to);
        EXPECT_EQ(p.digest(), digests[to]);
        piece_steps_reopen(p, m);
    }
    ASSERT_EQ(p.undo(), STATUS_OK);
    EXPECT_EQ(p.digest(), digests[5]);
    ASSERT_EQ(p.go(HISTORY_FORK), STATUS_OK) << "from within a branch too: the end that is next older than the tip";
    EXPECT_EQ(p.h.tree.cursor, 7u);
}

TEST(history, any_stroke_can_be_gone_to_in_one_step)
{
    memory_store m;
    piece p(m.port());
    std::vector<uint64_t> digests;
    piece_steps_up_to(p, digests, 1, 6);
    ASSERT_EQ(p.go(HISTORY_TO, 2), STATUS_OK);
    ASSERT_EQ(p.stroke({{{0, 0, 77}, 1, 1}}), STATUS_OK);
    ASSERT_EQ(p.stroke({{{0, 0, 78}, 1, 1}}), STATUS_OK);
    digests.resize(9);
    digests[8] = p.digest();
    for (const uint64_t to : {5, 8, 0, 3, 8, 1, 6, 4}) {
        const uint64_t sequence = p.h.sequence;
        ASSERT_EQ(p.go(HISTORY_TO, to), STATUS_OK);
        EXPECT_EQ(p.digest(), digests[to]) << to;
        EXPECT_EQ(p.h.sequence, sequence + 1);
        piece_steps_reopen(p, m);
        EXPECT_EQ(p.go(HISTORY_TO, to), STATUS_HISTORY_ENDS) << "it is there";
    }
    EXPECT_EQ(p.go(HISTORY_TO, 9), STATUS_HISTORY_ENDS) << "there is no such stroke";
}

TEST(history, what_is_put_can_be_undone_before_it_is_kept)
{
    memory_store m;
    piece p(m.port());
    std::vector<uint64_t> digests = {0};
    for (int n = 1; n <= 4; n++) {
        ASSERT_EQ(p.stretch(piece_stroke_numbered(n), true), STATUS_OK);
        digests.push_back(p.digest());
        if (n == 2) {
            ASSERT_EQ(p.keep(), STATUS_OK);
        }
    }
    ASSERT_EQ(p.h.kept, 2u);
    for (const uint64_t to : {1, 4, 0, 3}) {
        route r = {};
        ASSERT_EQ(history_fetch(&p.h, HISTORY_TO, to, &r), STATUS_OK);
        ASSERT_EQ(route_apply(&r, &p.c), STATUS_OK);
        clay_change_end(&p.c);
        ASSERT_EQ(history_move(&p.h, &r), STATUS_OK);
        EXPECT_EQ(p.digest(), digests[to]);
        route_finish(&r);
    }
    EXPECT_EQ(p.h.kept, 2u);
    ASSERT_EQ(p.keep(), STATUS_OK);
    EXPECT_EQ(p.h.kept, p.h.sequence);
    EXPECT_EQ(p.h.held_bytes, 0u);
    piece_steps_reopen(p, m);
}

TEST(history, fetching_moves_nothing)
{
    memory_store m;
    piece p(m.port());
    std::vector<uint64_t> digests;
    piece_steps_up_to(p, digests, 1, 4);
    const auto files = m.files;
    route r = {};
    ASSERT_EQ(history_fetch(&p.h, HISTORY_BACK, 0, &r), STATUS_OK);
    EXPECT_EQ(r.from, 4u);
    EXPECT_EQ(r.cursor, 3u);
    EXPECT_EQ(r.tip, 4u);
    EXPECT_EQ(r.digest_before, digests[4]);
    EXPECT_EQ(r.digest_after, digests[3]);
    EXPECT_EQ(p.h.tree.cursor, 4u);
    EXPECT_EQ(m.files, files);
    route_finish(&r);
}

/* --- strokes of several stretches --- */

TEST(history, stretches_of_a_stroke_are_one_step)
{
    memory_store m;
    piece p(m.port());
    std::vector<uint64_t> digests;
    piece_steps_up_to(p, digests, 1, 1);
    for (int n = 2; n <= 6; n++) {
        ASSERT_EQ(p.stretch(piece_stroke_numbered(n), n == 6), STATUS_OK);
        EXPECT_EQ(p.h.in_stroke, n < 6);
        if (n % 2 == 0) {
            ASSERT_EQ(p.keep(), STATUS_OK);
            piece_steps_reopen(p, m);
        }
    }
    const uint64_t after = p.digest();
    EXPECT_EQ(p.h.tree.count, 2u);
    ASSERT_EQ(p.undo(), STATUS_OK);
    EXPECT_EQ(p.digest(), digests[1]);
    ASSERT_EQ(p.redo(), STATUS_OK);
    EXPECT_EQ(p.digest(), after);
    piece_steps_reopen(p, m);
}

TEST(history, stroke_cut_short_stands_up_to_its_last_stretch)
{
    memory_store m;
    uint64_t before = 0, at_stretch = 0;
    {
        piece p(m.port());
        ASSERT_EQ(p.stroke(piece_stroke_numbered(1)), STATUS_OK);
        before = p.digest();
        ASSERT_EQ(p.stretch(piece_stroke_numbered(2), false), STATUS_OK);
        ASSERT_EQ(p.stretch(piece_stroke_numbered(3), false), STATUS_OK);
        ASSERT_EQ(p.keep(), STATUS_OK);
        at_stretch = p.digest();
        ASSERT_EQ(p.stretch(piece_stroke_numbered(4), false), STATUS_OK); /* not kept */
    }
    piece p(m.port());
    EXPECT_STREQ(p.finding.text, "");
    EXPECT_EQ(p.digest(), at_stretch);
    EXPECT_FALSE(p.h.in_stroke);
    ASSERT_EQ(p.stroke(piece_stroke_numbered(5)), STATUS_OK);
    EXPECT_EQ(p.h.tree.cursor, 3u) << "a stroke of its own";
    ASSERT_EQ(p.undo(), STATUS_OK);
    ASSERT_EQ(p.undo(), STATUS_OK);
    EXPECT_EQ(p.digest(), before);
}

TEST(history, stretches_that_change_nothing_begin_and_end_strokes_all_the_same)
{
    memory_store m;
    piece p(m.port());
    const piece_stroke nothing = {{{90, 0, 0}, 0, 0}};
    ASSERT_EQ(p.stretch(nothing, false), STATUS_OK);
    EXPECT_EQ(p.h.sequence, 0u);
    ASSERT_EQ(p.stretch(piece_stroke_numbered(1), false), STATUS_OK);
    ASSERT_EQ(p.stretch(nothing, false), STATUS_OK);
    ASSERT_EQ(p.stretch(piece_stroke_numbered(2), false), STATUS_OK);
    ASSERT_EQ(p.stretch(nothing, true), STATUS_OK);
    EXPECT_FALSE(p.h.in_stroke);
    ASSERT_EQ(p.stretch(piece_stroke_numbered(3), true), STATUS_OK);
    ASSERT_EQ(p.keep(), STATUS_OK);
    EXPECT_EQ(p.h.tree.count, 2u);
    ASSERT_EQ(p.undo(), STATUS_OK);
    ASSERT_EQ(p.undo(), STATUS_OK);
    EXPECT_EQ(clay_brick_count(&p.c), 0u);
    piece_steps_reopen(p, m);
}

TEST(history, large_stroke_takes_as_many_files_as_it_needs)
{
    memory_store m;
    piece p(m.port());
    ASSERT_EQ(p.stroke(piece_steps_large(1, 1)), STATUS_OK);
    const uint64_t before = p.digest();
    ASSERT_EQ(p.stroke(piece_steps_large(60, 5000)), STATUS_OK);
    const uint64_t after = p.digest();
    EXPECT_EQ(p.h.sequence, 61u) << "a quarter of a file at most: one such brick each";
    EXPECT_EQ(p.h.tree.count, 2u);
    EXPECT_EQ(piece_steps_undo_files(m), 1u + 60 / 4) << "four of two blocks a file: chance cannot be packed";
    for (const auto &[name, bytes] : m.files)
        EXPECT_EQ(bytes.size(), PIECE_STEPS_FILE_BYTES) << name;
    piece_steps_reopen(p, m);
    ASSERT_EQ(p.undo(), STATUS_OK);
    EXPECT_EQ(p.digest(), before);
    piece_steps_reopen(p, m);
    ASSERT_EQ(p.redo(), STATUS_OK);
    EXPECT_EQ(p.digest(), after);
    EXPECT_EQ(m.misuse, "");
}

TEST(history, large_stroke_of_which_a_part_is_kept_is_not_there)
{
    for (uint64_t nth = 3; nth < 40; nth += 4) {
        memory_store m;
        uint64_t before = 0;
        {
            piece p(m.port());
            ASSERT_EQ(p.stroke(piece_steps_large(1, 1)), STATUS_OK);
            before = p.digest();
            m.fail_at = m.calls + nth;
            m.fail_on = true;
            EXPECT_EQ(p.stroke(piece_steps_large(60, 5000)), STATUS_IO);
        }
        m.fail_at = 0;
        m.spoilt.clear();
        piece p(m.port());
        EXPECT_STREQ(p.finding.text, "") << "nothing was promised";
        EXPECT_EQ(p.digest(), before);
        EXPECT_EQ(p.h.tree.count, 1u);
        ASSERT_EQ(p.stroke(piece_steps_large(30, 9000)), STATUS_OK);
        piece_steps_reopen(p, m);
    }
}

/* --- how far undo reaches --- */

TEST(history, of_500_strokes_the_last_200_can_be_undone)
{
    memory_store m;
    std::vector<uint64_t> digests;
    {
        piece p(m.port());
        for (int n = 1; n <= 500; n++) {
            piece_steps_up_to(p, digests, n, n);
            ASSERT_EQ(p.h.tree.count, static_cast<uint32_t>(std::min(n, 200)));
        }
        EXPECT_LE(piece_steps_undo_files(m), 210u);
    }
    for (int restarts = 0; restarts < 2; restarts++) {
        piece p(m.port());
        ASSERT_EQ(p.opened, STATUS_OK);
        EXPECT_STREQ(p.finding.text, "");
        ASSERT_EQ(p.digest(), digests[500]);
        ASSERT_GE(piece_steps_undo_all(p, digests), 200u);
        piece_steps_reopen(p, m);
        while (history_can_redo(&p.h)) {
            ASSERT_EQ(p.redo(), STATUS_OK);
            ASSERT_EQ(p.digest(), digests[p.h.tree.cursor]);
        }
        EXPECT_EQ(p.h.tree.cursor, 500u);
    }
    EXPECT_EQ(m.misuse, "");
}

TEST(history, small_rings_lead_to_the_cursor_at_every_step)
{
    for (uint32_t strokes : {1u, 2u, 3u, 5u}) {
        memory_store m;
        piece p(m.port(), piece_steps_ring(strokes));
        std::vector<uint64_t> digests;
        for (int n = 1; n <= 17; n++) {
            piece_steps_up_to(p, digests, n, n);
            ASSERT_LE(p.h.tree.count, std::max(strokes, 2u) + 1);
            ASSERT_GE(p.h.tree.count, std::min(static_cast<uint32_t>(n), strokes));
            piece_steps_reopen(p, m);
        }
        EXPECT_LE(piece_steps_undo_files(m), strokes + 6u) << "files are written anew";
        EXPECT_GE(piece_steps_undo_all(p, digests), strokes);
        piece_steps_reopen(p, m);
    }
}

TEST(history, nothing_is_forgotten_before_two_checkpoints_are_beneath)
{
    memory_store m;
    piece p(m.port(), piece_steps_ring(2));
    std::vector<uint64_t> digests = {0};
    for (int n = 1; n <= 20; n++) { /* nobody writes a checkpoint */
        ASSERT_EQ(p.stretch(piece_stroke_numbered(n), true), STATUS_OK);
        ASSERT_EQ(history_keep(&p.h), STATUS_OK);
        digests.push_back(p.digest());
    }
    EXPECT_EQ(p.h.tree.count, 20u);
    EXPECT_TRUE(p.h.wants_field);
    ASSERT_EQ(p.field(), STATUS_OK);
    ASSERT_EQ(history_keep(&p.h), STATUS_OK);
    EXPECT_EQ(p.h.tree.count, 20u) << "one is not enough";
    ASSERT_EQ(p.field(), STATUS_OK);
    ASSERT_EQ(history_keep(&p.h), STATUS_OK);
    EXPECT_EQ(p.h.tree.count, 2u);
    EXPECT_EQ(piece_steps_undo_all(p, digests), 2u);
}

TEST(history, what_a_checkpoint_needs_is_not_forgotten)
{
    memory_store m;
    piece p(m.port(), piece_steps_ring(3));
    std::vector<uint64_t> digests;
    piece_steps_up_to(p, digests, 1, 3);
    for (int n = 0; n < 2; n++)
        ASSERT_EQ(p.field(), STATUS_OK); /* both after stroke 3 */
    ASSERT_EQ(p.go(HISTORY_TO, 0), STATUS_OK);
    for (int n = 0; n < 3; n++) { /* a branch of its own; the way from the checkpoints goes over strokes 3, 2, 1 */
        ASSERT_EQ(p.stretch({{{0, 0, 70 + n}, 1, 1}}, true), STATUS_OK);
        ASSERT_EQ(history_keep(&p.h), STATUS_OK);
        EXPECT_NE(tree_find(&p.h.tree, 1), nullptr);
        piece_steps_reopen(p, m);
    }
    EXPECT_TRUE(p.h.wants_field);
    for (int n = 0; n < 2; n++)
        ASSERT_EQ(p.field(), STATUS_OK);
    ASSERT_EQ(history_keep(&p.h), STATUS_OK);
    EXPECT_EQ(tree_find(&p.h.tree, 1), nullptr);
    EXPECT_EQ(p.h.tree.count, 3u);
    piece_steps_reopen(p, m);
}

TEST(history, smaller_settings_shrink_what_there_is)
{
    memory_store m;
    std::vector<uint64_t> digests;
    {
        piece p(m.port(), piece_steps_ring(100));
        piece_steps_up_to(p, digests, 1, 40);
    }
    ASSERT_GE(piece_steps_undo_files(m), 40u);
    piece p(m.port(), {5, PIECE_STEPS_FILE_BYTES, PIECE_STEPS_FILE_BYTES * 10});
    for (int n = 41; n <= 60; n++) {
        piece_steps_up_to(p, digests, n, n);
        while (history_work(&p.h))
            continue;
    }
    EXPECT_LE(piece_steps_undo_files(m), 12u);
    EXPECT_LE(p.h.ring.bytes, PIECE_STEPS_FILE_BYTES * 12);
    EXPECT_GE(piece_steps_undo_all(p, digests), 5u);
    EXPECT_EQ(m.misuse, "");
}

TEST(history, budget_limits_the_files_once_checkpoints_are_beneath)
{
    memory_store m;
    piece p(m.port(), {100, PIECE_STEPS_FILE_BYTES, PIECE_STEPS_FILE_BYTES * 12});
    std::vector<uint64_t> digests;
    piece_steps_up_to(p, digests, 1, 100);
    EXPECT_LE(p.h.ring.bytes, PIECE_STEPS_FILE_BYTES * 30) << "more only where no checkpoint could be made in time";
    EXPECT_GE(piece_steps_undo_all(p, digests), 5u);
    piece_steps_reopen(p, m);
}

} // namespace
