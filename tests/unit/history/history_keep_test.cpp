/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: records and checkpoints are written as history.h says; a store that fails or is full, or whose files are
 *       damaged meanwhile, costs what it says they may and no more.
 * Method: every write watched; the store is made to fail at each call of each kind of step in turn, to be full, to lose
 *         a sync; after each step another history opens a copy of the files. */
#include "history/history.h"

#include "clay/freeze.h"
#include "tests/unit/history/piece_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

namespace {

/* --- what is written where --- */

/* Writes to undo-files that are there, as the store sees them. */
struct watched {
    memory_store m;
    std::map<std::string, std::set<uint64_t>> live; /* blocks of records that somebody needs */
    std::string broken;
    static inline watched *one = nullptr;

    static status write(void *self, const char *name, uint64_t offset, const void *bytes, size_t n)
    {
        const std::string file = name;
        const auto at = one->m.files.find(file);
        if (file.starts_with("undo-") && at != one->m.files.end() && at->second.size() >= PIECE_STEPS_FILE_BYTES) {
            if (offset % RECORD_BLOCK_BYTES != 0 || offset + n > at->second.size())
                one->broken = file + " at " + std::to_string(offset);
            for (uint64_t b = offset / RECORD_BLOCK_BYTES; b * RECORD_BLOCK_BYTES < offset + n; b++)
                if (one->live[file].count(b))
                    one->broken = file + ": a record that is needed is written over at " + std::to_string(offset);
        }
        return memory_store_write(self, name, offset, bytes, n);
    }
    byte_store port()
    {
        one = this;
        byte_store s = m.port();
        s.write = write;
        return s;
    }
    void look(const history &h)
    {
        const uint64_t beneath = h.before.there ? std::min(h.field.sequence, h.before.sequence) : 0;
        live.clear();
        for (uint32_t n = 0; n < h.ring.count; n++)
            if (tree_find(&h.tree, h.ring.files[n].stroke) || h.ring.files[n].last > beneath)
                for (uint64_t b = 0; b < h.ring.files[n].end / RECORD_BLOCK_BYTES; b++)
                    live[ring_name_of(n).text].insert(b);
    }
};

TEST(history_keep, no_write_touches_a_record_or_makes_a_file_longer)
{
    watched w;
    piece p(w.port(), piece_steps_ring(4));
    seeded chance = {5};
    for (int n = 0; n < 200; n++) {
        const double die = seeded_real(chance, 0, 1);
        if (die < 0.6) {
            ASSERT_EQ(p.stroke(piece_stroke_random(chance, 100)), STATUS_OK);
        } else {
            (void)!p.go(die < 0.8 ? HISTORY_BACK : HISTORY_FORTH);
        }
        ASSERT_EQ(w.broken, "") << n;
        w.look(p.h);
    }
    EXPECT_EQ(w.m.misuse, "");
}

TEST(history_keep, file_made_ahead_spares_the_next_stroke_its_making)
{
    memory_store m;
    piece p(m.port());
    ASSERT_EQ(p.stroke(piece_stroke_numbered(1)), STATUS_OK);
    while (history_work(&p.h))
        continue;
    EXPECT_EQ(piece_steps_undo_files(m), 2u);
    while (history_work(&p.h))
        continue;
    EXPECT_EQ(piece_steps_undo_files(m), 2u) << "one is enough";
    const uint64_t calls = m.calls;
    ASSERT_EQ(p.stretch(piece_stroke_numbered(2), true), STATUS_OK);
    ASSERT_EQ(history_keep(&p.h), STATUS_OK);
    EXPECT_EQ(m.calls, calls + 2) << "a write and a sync";
    EXPECT_EQ(piece_steps_undo_files(m), 2u);
}

TEST(history_keep, all_that_was_put_takes_one_sync_a_file)
{
    memory_store m;
    piece p(m.port());
    ASSERT_EQ(p.stretch(piece_stroke_numbered(1), false), STATUS_OK);
    ASSERT_EQ(history_keep(&p.h), STATUS_OK);
    for (int n = 2; n <= 5; n++)
        ASSERT_EQ(p.stretch(piece_stroke_numbered(n), n == 5), STATUS_OK);
    const uint64_t calls = m.calls;
    ASSERT_EQ(history_keep(&p.h), STATUS_OK);
    EXPECT_EQ(m.calls, calls + 4 + 1);
    ASSERT_EQ(history_keep(&p.h), STATUS_OK);
    EXPECT_EQ(m.calls, calls + 4 + 1) << "nothing is held";
}

/* --- checkpoints --- */

TEST(history_keep, checkpoint_is_written_bit_by_bit_while_strokes_go_on)
{
    memory_store m;
    piece p(m.port());
    seeded chance = {4};
    ASSERT_EQ(p.stroke(piece_steps_large(300, 3)), STATUS_OK); /* more than a slice */
    freeze still;
    ASSERT_EQ(freeze_begin(&still, &p.c), STATUS_OK);
    const uint64_t sequence = p.h.sequence;
    ASSERT_EQ(history_field_begin(&p.h, &still.still), STATUS_OK);
    int slices = 0;
    while (p.h.writer) {
        slices++;
        (void)history_work(&p.h);
        ASSERT_EQ(p.stretch(piece_stroke_random(chance, 100), true), STATUS_OK);
        ASSERT_EQ(history_keep(&p.h), STATUS_OK);
        piece_steps_reopen(p, m);
    }
    freeze_end(&still);
    EXPECT_GE(slices, 2);
    EXPECT_TRUE(p.h.field.there);
    EXPECT_EQ(p.h.field.sequence, sequence);
    EXPECT_EQ(p.h.field.cursor, 1u);
    EXPECT_FALSE(p.h.before.there);
    ASSERT_EQ(p.field(), STATUS_OK);
    EXPECT_EQ(p.h.before.sequence, sequence);
    EXPECT_EQ(m.files.count("field") + m.files.count("field.before"), 2u);
    EXPECT_EQ(m.files.count("field.new"), 0u);
    piece_steps_reopen(p, m);
    EXPECT_EQ(m.misuse, "");
}

TEST(history_keep, checkpoint_is_due_after_a_quarter_of_the_strokes)
{
    memory_store m;
    piece p(m.port(), piece_steps_ring(40));
    for (int n = 1; n <= 10; n++) {
        ASSERT_EQ(p.stretch(piece_stroke_numbered(n), true), STATUS_OK);
        EXPECT_FALSE(p.h.wants_field) << n;
    }
    ASSERT_EQ(p.stretch(piece_stroke_numbered(11), true), STATUS_OK);
    EXPECT_TRUE(p.h.wants_field);
    ASSERT_EQ(p.field(), STATUS_OK);
    EXPECT_FALSE(p.h.wants_field);
}

/* Strokes of a corner beside a field of many: writing that anew for ten of them would be most of what is written. */
TEST(history_keep, large_piece_waits_for_more_strokes_but_not_for_ever)
{
    memory_store m;
    piece p(m.port(), piece_steps_ring(40));
    ASSERT_EQ(p.stretch(piece_steps_large(60, 1), true), STATUS_OK);
    ASSERT_EQ(p.field(), STATUS_OK);
    for (int n = 1; n <= 40; n++) {
        ASSERT_EQ(p.stretch(piece_stroke_numbered(n), true), STATUS_OK);
        EXPECT_FALSE(p.h.wants_field) << n;
    }
    ASSERT_LT(p.h.put_since, p.h.field_bytes / 2);
    ASSERT_EQ(p.stretch(piece_stroke_numbered(41), true), STATUS_OK);
    EXPECT_TRUE(p.h.wants_field);
    ASSERT_EQ(p.field(), STATUS_OK);
    for (int n = 42; n <= 51; n++)
        ASSERT_EQ(p.stretch(piece_stroke_numbered(n), true), STATUS_OK);
    EXPECT_FALSE(p.h.wants_field);
    ASSERT_EQ(p.stretch(piece_steps_large(40, 9000), true), STATUS_OK);
    ASSERT_GT(p.h.put_since, p.h.field_bytes / 2);
    EXPECT_TRUE(p.h.wants_field) << "now it pays";
}

TEST(history_keep, checkpoint_is_due_after_an_eighth_of_the_budget)
{
    memory_store m;
    piece p(m.port(), {1000, PIECE_STEPS_FILE_BYTES, PIECE_STEPS_FILE_BYTES * 16});
    ASSERT_EQ(p.stretch(piece_steps_large(15, 1), true), STATUS_OK);
    EXPECT_FALSE(p.h.wants_field) << "15 bricks are less than two files";
    ASSERT_EQ(p.stretch(piece_steps_large(2, 9000), true), STATUS_OK);
    EXPECT_TRUE(p.h.wants_field);
}

/* --- a store that fails --- */

struct failing_case {
    const char *what;
    std::function<void(piece &)> prepare;
    std::function<status(piece &)> act;
};

/* Fails each call of the act in turn, and perhaps all after it. The sculpture stays or is where it went; what is not
   kept is kept later; the files lead to before or after at any time. */
void fail_each_call(const failing_case &f, bool having_done, bool on)
{
    for (uint64_t nth = 1;; nth++) {
        const std::string what = std::string(f.what) + " " + std::to_string(nth);
        memory_store m;
        piece p(m.port(), piece_steps_ring(4));
        std::vector<uint64_t> digests;
        piece_steps_up_to(p, digests, 1, 6);
        f.prepare(p);
        const uint64_t before = p.digest();
        m.fail_at = m.calls + nth;
        m.fail_having_done = having_done;
        m.fail_on = on;
        const status s = f.act(p);
        const bool failed = m.calls >= m.fail_at;
        m.fail_at = 0;
        ASSERT_TRUE(s == STATUS_OK || (failed && s == STATUS_IO)) << what;
        const uint64_t after = p.digest();
        ASSERT_EQ(after, p.h.digest) << what;
        ASSERT_TRUE(clay_is_valid(&p.c));
        ASSERT_FALSE(p.c.changes.recording);
        {
            memory_store copy;
            copy.files = m.files;
            piece q(copy.port(), piece_steps_ring(4));
            ASSERT_EQ(q.opened, STATUS_OK);
            ASSERT_STREQ(q.finding.text, "") << what;
            ASSERT_TRUE(q.digest() == after || (failed && q.digest() == before)) << what;
        }
        ASSERT_EQ(history_keep(&p.h), STATUS_OK) << what;
        piece_steps_reopen(p, m);
        ASSERT_EQ(p.stroke({{{0, 0, 99}, 1, 1}}), STATUS_OK);
        piece_steps_reopen(p, m);
        ASSERT_EQ(m.misuse, "") << what;
        if (!failed) {
            EXPECT_GT(nth, 1u) << f.what;
            break;
        }
    }
}

TEST(history_keep, failing_store_costs_nothing_that_was_made)
{
    const auto nothing = [](piece &) {};
    const auto undone = [](piece &p) {
        for (int n = 0; n < 2; n++)
            ASSERT_EQ(p.undo(), STATUS_OK);
    };
    const auto stroke = [](piece &p) { return p.stroke({{{0, 0, 77}, 1, 1}, {{-3, 0, 0}, 0, 0}}); };
    const auto large = [](piece &p) { return p.stroke(piece_steps_large(10, 4)); };
    const auto field = [](piece &p) { return p.field(); };
    const auto undo = [](piece &p) { return p.undo(); };
    const auto redo = [](piece &p) { return p.redo(); };
    const auto leap = [](piece &p) { return p.go(HISTORY_TO, 3); };
    const std::vector<failing_case> all = {
        {"stroke", nothing, stroke}, {"stroke after undo", undone, stroke}, {"large stroke", nothing, large},
        {"undo", nothing, undo},     {"redo", undone, redo},                {"leap", nothing, leap},
        {"checkpoint", undone, field},
    };
    for (const failing_case &f : all)
        for (bool having_done : {false, true})
            for (bool on : {false, true})
                fail_each_call(f, having_done, on);
}

/* The next sync, alone, fails. */
struct lost_sync {
    memory_store m;
    int fails = 0;
    static inline lost_sync *one = nullptr;

    static status sync(void *self, const char *name)
    {
        if (one->fails == 0)
            return memory_store_sync(self, name);
        one->fails--;
        one->m.spoilt.insert(name);
        return STATUS_IO;
    }
    byte_store port()
    {
        one = this;
        byte_store s = m.port();
        s.sync = sync;
        return s;
    }
};

TEST(history_keep, file_whose_sync_failed_gets_no_further_record)
{
    lost_sync l;
    piece p(l.port(), piece_steps_ring(3));
    std::vector<uint64_t> digests;
    piece_steps_up_to(p, digests, 1, 3);
    ASSERT_EQ(p.stretch(piece_stroke_numbered(4), false), STATUS_OK);
    ASSERT_EQ(history_keep(&p.h), STATUS_OK);
    const std::string spoilt = piece_steps_file_of(p, 4);
    ASSERT_EQ(p.stretch(piece_stroke_numbered(40), true), STATUS_OK);
    l.fails = 1;
    ASSERT_EQ(history_keep(&p.h), STATUS_OK) << "another file takes it";
    digests.push_back(p.digest());
    const auto as_it_was = l.m.files.at(spoilt);
    EXPECT_EQ(p.h.medium, HISTORY_MEDIUM_GOOD);
    piece_steps_reopen(p, l.m);
    ASSERT_EQ(p.undo(), STATUS_OK) << "what it held before may be read";
    ASSERT_EQ(p.redo(), STATUS_OK);
    for (int n = 5; n <= 12; n++) {
        piece_steps_up_to(p, digests, n, n);
        piece_steps_reopen(p, l.m);
        const bool aside = l.m.files.count(spoilt + ".set-aside") == 1;
        ASSERT_EQ(l.m.files.at(aside ? spoilt + ".set-aside" : spoilt), as_it_was) << "and nothing is lost";
    }
    EXPECT_EQ(l.m.files.count(spoilt + ".set-aside"), 1u) << "once stroke 4 is forgotten nothing needs it";
    EXPECT_EQ(l.m.misuse, "");
}

TEST(history_keep, while_the_medium_fails_strokes_are_held_in_memory)
{
    memory_store m;
    piece p(m.port());
    std::vector<uint64_t> digests;
    piece_steps_up_to(p, digests, 1, 3);
    m.fail_at = m.calls + 1;
    m.fail_on = true;
    const uint64_t kept = p.h.kept;
    for (int n = 4; n <= 20; n++) {
        ASSERT_EQ(p.stroke(piece_stroke_numbered(n)), STATUS_IO);
        digests.push_back(p.digest());
        EXPECT_EQ(p.h.kept, kept);
        EXPECT_EQ(history_room(&p.h), STATUS_OK) << "there is memory left";
    }
    EXPECT_EQ(p.h.medium, HISTORY_MEDIUM_FAILS);
    EXPECT_EQ(std::string(p.h.trouble.text).find("what was made last is only in memory: "), 0u) << p.h.trouble.text;
    p.h.settings.held_bytes = p.h.held_bytes;
    EXPECT_EQ(history_room(&p.h), STATUS_OK);
    p.h.settings.held_bytes--;
    EXPECT_EQ(history_room(&p.h), STATUS_IO) << "no more than is allowed";
    m.fail_at = 0;
    ASSERT_EQ(p.keep(), STATUS_OK);
    EXPECT_EQ(history_room(&p.h), STATUS_OK);
    EXPECT_EQ(p.h.medium, HISTORY_MEDIUM_GOOD);
    EXPECT_EQ(p.h.held_bytes, 0u);
    piece_steps_reopen(p, m);
    EXPECT_EQ(piece_steps_undo_all(p, digests), 20u);
}

TEST(history_keep, read_that_fails_moves_nothing_and_forgets_nothing)
{
    memory_store m;
    piece p(m.port());
    std::vector<uint64_t> digests;
    piece_steps_up_to(p, digests, 1, 3);
    m.unreadable = piece_steps_file_of(p, 3);
    EXPECT_EQ(p.undo(), STATUS_IO);
    EXPECT_EQ(p.digest(), digests[3]);
    m.unreadable = "";
    EXPECT_EQ(piece_steps_undo_all(p, digests), 3u);
}

/* --- files that are damaged while history is open --- */

TEST(history_keep, damaged_undo_file_is_told_once_and_ends_history_there)
{
    for (const bool missing : {false, true}) {
        memory_store m;
        piece p(m.port(), piece_steps_ring(10));
        std::vector<uint64_t> digests;
        piece_steps_up_to(p, digests, 1, 6);
        ASSERT_EQ(p.undo(), STATUS_OK);
        const std::string name = piece_steps_file_of(p, 4);
        if (missing)
            m.files.erase(name);
        else
            m.files.at(name)[RECORD_HEADER_BYTES + 20] ^= 0x10;
        const auto damaged = missing ? std::vector<uint8_t>() : m.files.at(name);
        ASSERT_EQ(p.undo(), STATUS_OK);
        EXPECT_EQ(p.undo(), STATUS_CORRUPT);
        EXPECT_EQ(std::string(p.h.trouble.text).find("stroke 4 cannot be gone over"), 0u) << p.h.trouble.text;
        EXPECT_EQ(p.digest(), digests[4]);
        EXPECT_EQ(p.undo(), STATUS_HISTORY_ENDS);
        EXPECT_TRUE(p.h.wants_field) << "the way from the last checkpoint is cut";
        ASSERT_EQ(p.keep(), STATUS_OK);
        ASSERT_EQ(p.field(), STATUS_OK);
        piece_steps_reopen(p, m);
        for (const size_t n : {5, 6}) {
            ASSERT_EQ(p.redo(), STATUS_OK) << "the other side is as it was";
            EXPECT_EQ(p.digest(), digests[n]);
        }
        ASSERT_EQ(p.field(), STATUS_OK);
        piece_steps_up_to(p, digests, 7, 10);
        EXPECT_EQ(m.files.count(name + ".set-aside"), missing ? 0u : 1u);
        if (!missing) {
            EXPECT_EQ(m.files.at(name + ".set-aside"), damaged);
        }
        piece_steps_reopen(p, m);
    }
}

TEST(history_keep, damaged_redo_file_ends_history_on_that_side)
{
    memory_store m;
    piece p(m.port(), piece_steps_ring(10));
    std::vector<uint64_t> digests;
    piece_steps_up_to(p, digests, 1, 6);
    for (int n = 0; n < 4; n++)
        ASSERT_EQ(p.undo(), STATUS_OK);
    m.files.at(piece_steps_file_of(p, 4))[RECORD_HEADER_BYTES + 20] ^= 0x10;
    ASSERT_EQ(p.redo(), STATUS_OK);
    EXPECT_EQ(p.redo(), STATUS_CORRUPT);
    EXPECT_EQ(p.redo(), STATUS_HISTORY_ENDS);
    EXPECT_EQ(p.digest(), digests[3]);
    EXPECT_EQ(p.h.tree.tip, 3u);
    EXPECT_EQ(tree_find(&p.h.tree, 5), nullptr) << "5 leads nowhere without 4";
    EXPECT_EQ(piece_steps_undo_all(p, digests), 3u);
}

TEST(history_keep, file_of_another_stroke_is_not_believed)
{
    memory_store m;
    piece p(m.port(), piece_steps_ring(10));
    const piece_stroke there = {{{0, 0, 0}, 1, 1}}, gone = {{{0, 0, 0}, 0, 0}};
    for (const piece_stroke &s : {there, gone, there})
        ASSERT_EQ(p.stroke(s), STATUS_OK);
    m.files[piece_steps_file_of(p, 3)] = m.files[piece_steps_file_of(p, 1)]; /* it did the same */
    EXPECT_EQ(p.undo(), STATUS_CORRUPT);
    EXPECT_EQ(clay_brick_count(&p.c), 1u);
    EXPECT_EQ(p.undo(), STATUS_HISTORY_ENDS);
}

TEST(history_keep, refused_way_loses_its_first_stroke)
{
    memory_store m;
    piece p(m.port(), piece_steps_ring(10));
    std::vector<uint64_t> digests;
    piece_steps_up_to(p, digests, 1, 6);
    route r = {};
    ASSERT_EQ(history_fetch(&p.h, HISTORY_TO, 3, &r), STATUS_OK);
    EXPECT_EQ(r.first, 6u);
    history_refuse(&p.h, &r);
    route_finish(&r);
    EXPECT_EQ(p.undo(), STATUS_HISTORY_ENDS);
    EXPECT_EQ(std::string(p.h.trouble.text).find("stroke 6 "), 0u);
}

} // namespace
