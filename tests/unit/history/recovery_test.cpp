/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: whatever happened to the files, opening ends in a state of the sculpture that once was, the latest that can be
 *       proven, or in a clear refusal; it says what it found in one sentence; and nothing that held a stroke is gone.
 * Method: stores with strokes behind and before the cursor and two fields beneath; each of the six steps of recovery.h
 *         by hand. Damage of every kind is in recovery_damage_test.cpp, power cuts in tests/crash. */
#include "history/recovery.h"

#include "clay/digest.h"
#include "history/byte_order.h"
#include "history/packing.h"
#include "tests/unit/history/recovery_scene.h"

#include <gtest/gtest.h>

namespace {

/* --- nothing is wrong --- */

TEST(recovery, a_store_that_reads_in_small_pieces_is_as_good)
{
    const recovery_scene s;
    for (size_t at_most : {1, 3, 64, 100}) {
        memory_store m = recovery_scene_after(s.m, [&](memory_store &c) { c.read_at_most = at_most; });
        piece p(m.port(), recovery_scene_ring(100));
        ASSERT_EQ(p.opened, STATUS_OK);
        EXPECT_STREQ(p.finding.text, "");
        EXPECT_EQ(p.digest(), s.digests[7]);
        EXPECT_EQ(m.files, s.m.files);
    }
}

TEST(recovery, sound_files_are_opened_without_a_word_and_left_alone)
{
    for (const std::set<int> &fields : {std::set<int>{}, std::set<int>{4}, std::set<int>{4, 6}, std::set<int>{9}}) {
        recovery_scene s(fields);
        const auto before = s.m.files;
        piece p(s.m.port(), recovery_scene_ring(100));
        ASSERT_EQ(p.opened, STATUS_OK);
        EXPECT_STREQ(p.finding.text, "");
        EXPECT_EQ(p.digest(), s.digests[7]);
        EXPECT_EQ(p.h.tree.cursor, 7u);
        EXPECT_EQ(p.h.tree.tip, 9u);
        EXPECT_EQ(p.h.tree.count, 9u);
        EXPECT_EQ(p.h.stroke, 9u);
        EXPECT_EQ(p.h.sequence, 11u);
        EXPECT_EQ(p.h.kept, 11u);
        EXPECT_FALSE(p.h.wants_field);
        EXPECT_EQ(s.m.files, before);
    }
}

/* --- 1 and 2: which records count --- */

TEST(recovery, what_an_earlier_use_left_behind_does_not_count)
{
    memory_store m;
    std::vector<uint64_t> digests;
    {
        piece p(m.port(), recovery_scene_ring(2));
        for (int n = 1; n <= 12; n++) { /* long ones first: their later parts lie on behind the short ones */
            ASSERT_EQ(p.stretch(piece_stroke_numbered(n), false), STATUS_OK);
            for (int more = 0; n <= 6 && more < 4; more++)
                ASSERT_EQ(p.stretch(piece_stroke_numbered(20 + 10 * n + more), false), STATUS_OK);
            ASSERT_EQ(p.stretch(piece_stroke_numbered(200 + n), true), STATUS_OK);
            ASSERT_EQ(p.keep(), STATUS_OK);
            digests.push_back(p.digest());
        }
        bool left = false;
        record r;
        for (uint32_t n = 0; n < p.h.ring.count; n++)
            left = left || (p.h.ring.files[n].end > 0 &&
                            ring_read_header(&p.h.ring, n, p.h.ring.files[n].end, &r) == STATUS_OK);
        EXPECT_TRUE(left) << "or this proves nothing";
    }
    piece p(m.port(), recovery_scene_ring(2));
    EXPECT_STREQ(p.finding.text, "");
    EXPECT_EQ(p.digest(), digests[11]);
    ASSERT_EQ(p.undo(), STATUS_OK);
    EXPECT_EQ(p.digest(), digests[10]);
}

/* The next sync, alone, fails. */
struct lost_sync {
    memory_store m;
    bool fails = false;
    static inline lost_sync *one = nullptr;
    static status sync(void *self, const char *name)
    {
        if (!one->fails)
            return memory_store_sync(self, name);
        one->fails = false;
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

TEST(recovery, record_that_lies_in_two_files_counts_in_the_later)
{
    /* A sync failed. Later the record before it is no more: both checkpoints are beyond it. */
    for (const bool before_is_gone : {false, true}) {
        lost_sync l;
        uint64_t digest = 0, stroke = 0;
        {
            piece p(l.port(), recovery_scene_ring(2));
            for (int n = 1; n <= 3; n++)
                ASSERT_EQ(p.stroke(piece_stroke_numbered(n)), STATUS_OK);
            for (int n = 0; n < 2; n++)
                ASSERT_EQ(p.field(), STATUS_OK);
            ASSERT_EQ(p.stretch(piece_stroke_numbered(4), false), STATUS_OK);
            l.fails = true;
            ASSERT_EQ(history_keep(&p.h), STATUS_OK) << "into another file";
            ASSERT_FALSE(l.fails);
            for (int n = 5; n <= (before_is_gone ? 9 : 5); n++) {
                ASSERT_EQ(p.stretch(piece_stroke_numbered(n), true), STATUS_OK);
                ASSERT_EQ(history_keep(&p.h), STATUS_OK);
            }
            digest = p.digest();
            stroke = p.h.tree.cursor;
        }
        l.m.spoilt.clear();
        piece p(l.m.port(), recovery_scene_ring(2));
        EXPECT_STREQ(p.finding.text, "") << before_is_gone;
        EXPECT_EQ(p.h.tree.cursor, stroke);
        EXPECT_EQ(p.digest(), digest) << before_is_gone;
    }
}

/* --- 3: the base --- */

TEST(recovery, damaged_field_is_set_aside_and_the_one_before_does)
{
    recovery_scene s;
    s.m.files["field"][200] ^= 1;
    const memory_store before = s.m;
    piece p(s.m.port(), recovery_scene_ring(100));
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.digest(), s.digests[7]) << "the undo-files lead on from there";
    EXPECT_EQ(std::string(p.finding.text).find("field is damaged at byte "), 0u) << p.finding.text;
    EXPECT_NE(std::string(p.finding.text).find("and was set aside"), std::string::npos);
    EXPECT_EQ(s.m.files.at("field.set-aside"), before.files.at("field"));
    EXPECT_EQ(s.m.files.count("field"), 0u);
    EXPECT_TRUE(p.h.wants_field);
    EXPECT_EQ(p.h.tree.count, 9u);
    ASSERT_EQ(p.field(), STATUS_OK);
    piece q(s.m.port(), recovery_scene_ring(100));
    EXPECT_STREQ(q.finding.text, "");
    EXPECT_EQ(q.digest(), s.digests[7]);
}

TEST(recovery, all_records_since_the_field_before_are_kept_for_it)
{
    memory_store m;
    piece p(m.port(), recovery_scene_ring(4));
    for (int n = 1; n <= 16; n++) {
        if (n == 3) { /* the stroke before is on no way any more, and yet its record is needed */
            ASSERT_EQ(p.go(HISTORY_BACK), STATUS_OK);
        }
        ASSERT_EQ(p.stretch(piece_stroke_numbered(n), true), STATUS_OK);
        ASSERT_EQ(history_keep(&p.h), STATUS_OK);
        for (int fields = n == 1 ? 2 : n == 3; fields > 0; fields--)
            ASSERT_EQ(p.field(), STATUS_OK);
        for (const char *damaged : {"field", "field.before"}) {
            if (!m.files.count(damaged))
                continue;
            memory_store copy = recovery_scene_after(m, [&](memory_store &c) { c.files[damaged].back() ^= 1; });
            piece q(copy.port(), recovery_scene_ring(4));
            ASSERT_EQ(q.digest(), p.digest()) << n << " without " << damaged << ": " << q.finding.text;
        }
    }
}

TEST(recovery, field_that_says_it_is_another_is_damaged)
{
    recovery_scene s;
    std::vector<uint8_t> &f = s.m.files["field"];
    byte_order_put_u64(&f[48], 12345); /* the digest, under a checksum that holds */
    const preamble p2 = {"glaise\r\n", CHECKPOINT_VERSION, CHECKPOINT_HEADER_BYTES};
    preamble_seal(&p2, f.data());
    piece p(s.m.port(), recovery_scene_ring(100));
    EXPECT_EQ(p.digest(), s.digests[7]);
    EXPECT_EQ(std::string(p.finding.text),
              "field is damaged at byte 48 (expected the digest of the clay that follows) and was set aside");
}

TEST(recovery, without_any_field_the_strokes_make_the_sculpture_again)
{
    recovery_scene s;
    s.m.files["field"][200] ^= 1;
    s.m.files["field.before"][200] ^= 1;
    piece p(s.m.port(), recovery_scene_ring(100));
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.digest(), s.digests[7]);
    EXPECT_EQ(std::string(p.finding.text).find("field is damaged at byte "), 0u) << p.finding.text;
    EXPECT_EQ(s.m.files.count("field.set-aside"), 1u);
    EXPECT_EQ(s.m.files.count("field.before.set-aside"), 1u);
    EXPECT_TRUE(p.h.wants_field);
}

TEST(recovery, a_field_alone_is_enough)
{
    recovery_scene s;
    memory_store copy;
    copy.files["field"] = s.m.files.at("field");
    piece_clay c;
    history h;
    history_finding finding;
    const history_settings settings = HISTORY_SETTINGS_DEFAULT;
    ASSERT_EQ(history_open(&h, copy.port(), &settings, 3.0, &c.c, &finding), STATUS_OK);
    EXPECT_STREQ(finding.text, "");
    EXPECT_EQ(clay_digest(&c.c), s.digests[6]);
    EXPECT_EQ(h.step_mm, 0.5) << "that of the field, not the caller's";
    EXPECT_EQ(h.tree.cursor, 6u);
    EXPECT_EQ(h.stroke, 6u);
    EXPECT_FALSE(history_can_undo(&h) || history_can_redo(&h));
    history_close(&h);
}

TEST(recovery, neither_field_nor_first_strokes_is_empty_clay_and_nothing_is_thrown_away)
{
    recovery_scene s({}, 2); /* fields and forgetting as they come */
    for (const char *name : {"field", "field.before"})
        s.m.files.at(name)[200] ^= 1;
    const memory_store before = s.m;
    piece p(s.m.port(), recovery_scene_ring(2));
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(clay_brick_count(&p.c), 0u);
    EXPECT_FALSE(history_can_undo(&p.h) || history_can_redo(&p.h));
    EXPECT_NE(p.finding.text[0], '\0');
    recovery_scene_expect_kept(before, s.m, "");
    for (int n = 20; n < 40; n++)
        ASSERT_EQ(p.stroke(piece_stroke_numbered(n)), STATUS_OK);
    for (const auto &[name, bytes] : s.m.files)
        if (name.find(".set-aside") != std::string::npos) {
            EXPECT_EQ(bytes, before.files.at(name.substr(0, name.find(".set-aside"))));
        }
}

TEST(recovery, field_of_version_1_is_a_base)
{
    memory_store m;
    uint64_t digest = 0;
    std::vector<uint8_t> f, bricks;
    {
        piece p(m.port(), recovery_scene_ring(100));
        ASSERT_EQ(p.stroke({{{1, 2, 3}, 1.5f, 0x01020304}}), STATUS_OK);
        ASSERT_EQ(p.field(), STATUS_OK);
        digest = p.digest();
        f = m.files.at("field");
    }
    /* One block of one brick; it had no blocks, a shorter header, and a checksum a brick. */
    bricks.resize(byte_order_get_u32(&f[96]));
    ASSERT_EQ(packing_unpack(bricks.data(), bricks.size(), &f[104], byte_order_get_u32(&f[100])), STATUS_OK);
    ASSERT_EQ(bricks.size(), 88u);
    f.resize(64);
    byte_order_put_u64(&f[24], 31);
    const preamble p1 = {"glaise\r\n", 1, 64};
    preamble_seal(&p1, f.data());
    bricks.resize(96);
    byte_order_put_u64(&bricks[88], digest_bytes(bricks.data(), 88, 0));
    f.insert(f.end(), bricks.begin(), bricks.end());
    m.files.clear();
    m.files["field"] = f;
    piece p(m.port(), recovery_scene_ring(100));
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_STREQ(p.finding.text, "");
    EXPECT_EQ(p.digest(), digest);
    EXPECT_EQ(p.h.tree.cursor, 31u);
    ASSERT_EQ(p.stroke(piece_stroke_numbered(2)), STATUS_OK);
    EXPECT_EQ(p.h.tree.cursor, 32u);
    piece q(m.port(), recovery_scene_ring(100));
    EXPECT_EQ(q.digest(), p.digest());
}

TEST(recovery, torn_last_record_is_as_if_it_had_not_been_put)
{
    for (const size_t at : {size_t{RECOVERY_SCENE_IN_HEADER}, size_t{RECOVERY_SCENE_IN_BRICKS}}) {
        memory_store m;
        uint64_t before = 0;
        {
            piece p(m.port(), recovery_scene_ring(100));
            for (int n = 1; n <= 3; n++) {
                before = p.digest();
                ASSERT_EQ(p.stroke(piece_stroke_numbered(n)), STATUS_OK);
            }
            m.files.at(ring_name_of(p.h.ring.current).text)[at] ^= 4;
        }
        piece p(m.port(), recovery_scene_ring(100));
        EXPECT_STREQ(p.finding.text, "") << "nobody can tell it from one that was never synced";
        EXPECT_EQ(p.digest(), before);
        EXPECT_EQ(p.h.tree.cursor, 2u);
        ASSERT_EQ(p.stroke(piece_stroke_numbered(9)), STATUS_OK);
        const uint64_t digest = p.digest();
        piece q(m.port(), recovery_scene_ring(100));
        EXPECT_STREQ(q.finding.text, "");
        EXPECT_EQ(q.digest(), digest);
        EXPECT_EQ(q.h.tree.cursor, 3u);
    }
}

TEST(recovery, records_up_to_the_last_whole_one_count)
{
    memory_store m;
    uint64_t before = 0;
    piece_stroke full;
    for (int n = 0; n < BRICK_CORNERS * 3; n++)
        full.push_back({{n / 64, n / 8 % 8, n % 8}, 1, 5});
    {
        piece p(m.port(), recovery_scene_ring(100));
        ASSERT_EQ(p.stroke(piece_stroke_numbered(1)), STATUS_OK);
        before = p.digest();
        ASSERT_EQ(p.stroke(full), STATUS_OK); /* three records of a block each */
        ASSERT_EQ(p.h.sequence, 4u);
        m.files.at(ring_name_of(p.h.ring.current).text)[2 * 4096 + RECOVERY_SCENE_IN_BRICKS] ^= 4; /* the third */
    }
    piece p(m.port(), recovery_scene_ring(100));
    EXPECT_STREQ(p.finding.text, "");
    EXPECT_EQ(p.digest(), before);
    EXPECT_EQ(p.h.tree.cursor, 1u);
    EXPECT_EQ(p.h.sequence, 1u);
}

/* Two parts of a stroke, of which the second was written and not kept. Whoever opened without it made a checkpoint,
   and then it comes up all the same. */
TEST(recovery, part_of_a_stroke_behind_a_checkpoint_is_of_an_earlier_life)
{
    memory_store m;
    std::vector<uint8_t> later;
    std::string name;
    uint64_t before = 0;
    {
        memory_store earlier;
        piece p(earlier.port(), recovery_scene_ring(100));
        ASSERT_EQ(p.stroke(piece_stroke_numbered(1)), STATUS_OK);
        ASSERT_EQ(p.stretch(piece_stroke_numbered(2), false), STATUS_OK);
        ASSERT_EQ(p.keep(), STATUS_OK);
        before = p.digest();
        m.files = earlier.files;
        ASSERT_EQ(p.stretch(piece_stroke_numbered(3), true), STATUS_OK);
        ASSERT_EQ(p.keep(), STATUS_OK);
        name = ring_name_of(p.h.ring.current).text;
        later = earlier.files.at(name);
    }
    {
        piece p(m.port(), recovery_scene_ring(100));
        ASSERT_EQ(p.digest(), before);
        ASSERT_EQ(p.field(), STATUS_OK);
    }
    ASSERT_NE(m.files.at(name), later);
    m.files.at(name) = later;
    piece p(m.port(), recovery_scene_ring(100));
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.digest(), before);
    EXPECT_EQ(p.h.tree.cursor, 2u);
    ASSERT_EQ(p.undo(), STATUS_OK);
    ASSERT_EQ(p.redo(), STATUS_OK);
    EXPECT_EQ(p.digest(), before);
}

/* --- 5: the way --- */

TEST(recovery, stroke_that_cannot_be_gone_over_ends_at_the_latest_that_can_be_reached)
{
    recovery_scene s({9}); /* the way from the field to the cursor goes back over 9 and 8 */
    s.turn(8, RECOVERY_SCENE_IN_BRICKS);
    const memory_store before = s.m;
    piece p(s.m.port(), recovery_scene_ring(100));
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.digest(), s.digests[8]);
    EXPECT_EQ(p.h.tree.cursor, 8u);
    EXPECT_EQ(std::string(p.finding.text),
              "undo-files are damaged: the sculpture stands at the latest state that could be reached");
    EXPECT_FALSE(history_can_undo(&p.h));
    EXPECT_TRUE(p.h.wants_field);
    recovery_scene_expect_kept(before, s.m, "");
    ASSERT_EQ(p.keep(), STATUS_OK);
    piece q(s.m.port(), recovery_scene_ring(100));
    EXPECT_EQ(q.digest(), s.digests[8]) << "and there it stays";
}

TEST(recovery, walk_over_more_bricks_than_dirt_has_room_for)
{
    /* One corner wanders through forty bricks, in clay that has room for eight, and dirt for sixteen. */
    memory_store m;
    uint64_t digest = 0;
    {
        piece p(m.port(), recovery_scene_ring(100), 8);
        for (int n = 1; n <= 16; n++) {
            const piece_stroke stroke = {{{8 * n, 0, 0}, 1, 1}, {{8 * n - 8, 0, 0}, 0, 0}};
            ASSERT_EQ(p.stretch(stroke, true), STATUS_OK);
            ASSERT_EQ(history_keep(&p.h), STATUS_OK);
        }
        digest = p.digest();
    }
    piece p(m.port(), recovery_scene_ring(100), 8);
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.digest(), digest);
    EXPECT_EQ(dirt_count(&p.c.dirty), 1u);
}

TEST(recovery, damage_beneath_the_base_only_ends_undo)
{
    recovery_scene s;
    s.turn(3, RECOVERY_SCENE_IN_BRICKS);
    piece p(s.m.port(), recovery_scene_ring(100));
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.digest(), s.digests[7]);
    for (size_t n = 6; n >= 3; n--) {
        ASSERT_EQ(p.undo(), STATUS_OK);
        EXPECT_EQ(p.digest(), s.digests[n]);
    }
    EXPECT_EQ(p.undo(), STATUS_CORRUPT);
    EXPECT_EQ(p.undo(), STATUS_HISTORY_ENDS);
    EXPECT_EQ(p.digest(), s.digests[3]);
}

/* --- 6: what the medium lost --- */

TEST(recovery, medium_that_lost_what_it_had_kept_is_told_of)
{
    for (const size_t at : {size_t{RECOVERY_SCENE_IN_HEADER}, size_t{RECOVERY_SCENE_IN_BRICKS}}) {
        recovery_scene s({4});
        s.turn(6, at);
        const memory_store before = s.m;
        {
            piece p(s.m.port(), recovery_scene_ring(100));
            ASSERT_EQ(p.opened, STATUS_OK);
            EXPECT_EQ(p.digest(), s.digests[5]);
            EXPECT_EQ(std::string(p.finding.text),
                      "the medium lost what it had said was kept: the sculpture stands as after stroke 5, what "
                      "was found beyond is set aside");
            for (const uint64_t n : {7, 8, 9})
                EXPECT_EQ(s.m.files.at(s.files[n] + ".set-aside"), before.files.at(s.files[n])) << n;
            recovery_scene_expect_kept(before, s.m, "");
            ASSERT_EQ(p.stroke(piece_stroke_numbered(50)), STATUS_OK);
        }
        piece again(s.m.port(), recovery_scene_ring(100));
        EXPECT_STREQ(again.finding.text, "") << "said once is enough";
        ASSERT_EQ(again.undo(), STATUS_OK);
        EXPECT_EQ(again.digest(), s.digests[5]);
    }
}

/* --- earlier, newer, unreadable --- */

TEST(recovery, undo_files_of_the_earlier_form_are_set_aside)
{
    recovery_scene s;
    std::vector<uint8_t> old(300);
    std::memcpy(old.data(), "glundo\r\n", 8);
    s.m.files["undo-0077"] = old;
    piece p(s.m.port(), recovery_scene_ring(100));
    EXPECT_EQ(p.digest(), s.digests[7]);
    EXPECT_EQ(std::string(p.finding.text),
              "undo-0077 is of an earlier form and was set aside: its stroke cannot be undone any more");
    EXPECT_EQ(s.m.files.at("undo-0077.set-aside"), old);
    EXPECT_EQ(s.m.files.count("undo-0077"), 0u);
}

TEST(recovery, newer_files_are_refused_untouched)
{
    const recovery_scene sound;
    const std::string undo = sound.files.at(3), last = sound.files.at(9);
    const preamble field = {"glaise\r\n", CHECKPOINT_VERSION + 1, CHECKPOINT_HEADER_BYTES};
    const preamble rec = {"glring\r\n", RECORD_VERSION + 1, RECORD_HEADER_BYTES};
    for (const auto &[name, as] : std::map<std::string, preamble>{
             {"field", field}, {"field.before", field}, {undo, rec}, {last, rec}}) {
        recovery_scene s;
        preamble_seal(&as, s.m.files.at(name).data());
        s.turn(6, RECOVERY_SCENE_IN_BRICKS); /* even so */
        const auto before = s.m.files;
        piece p(s.m.port(), recovery_scene_ring(100));
        EXPECT_EQ(p.opened, STATUS_NEWER) << name;
        EXPECT_EQ(std::string(p.finding.text), name + " was written by a newer version of this program");
        EXPECT_EQ(s.m.files, before);
        EXPECT_EQ(clay_brick_count(&p.c), 0u);
        EXPECT_TRUE(clay_is_valid(&p.c));
    }
}

TEST(recovery, unreadable_undo_file_beneath_the_base_is_told_and_left)
{
    recovery_scene s;
    s.m.unreadable = s.files[2];
    const auto before = s.m.files;
    {
        piece p(s.m.port(), recovery_scene_ring(100));
        ASSERT_EQ(p.opened, STATUS_OK);
        EXPECT_EQ(p.digest(), s.digests[7]);
        EXPECT_EQ(std::string(p.finding.text), s.files[2] + " cannot be read: not every stroke can be undone");
        EXPECT_EQ(s.m.files, before) << "it may be readable tomorrow";
    }
    s.m.unreadable = "";
    piece p(s.m.port(), recovery_scene_ring(100));
    EXPECT_STREQ(p.finding.text, "");
    EXPECT_EQ(p.h.tree.count, 9u);
}

TEST(recovery, unreadable_field_is_told_and_the_one_before_does)
{
    recovery_scene s;
    s.m.unreadable = "field";
    const auto before = s.m.files;
    piece p(s.m.port(), recovery_scene_ring(100));
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(std::string(p.finding.text), "field cannot be read");
    EXPECT_EQ(p.digest(), s.digests[7]);
    EXPECT_EQ(s.m.files, before);
    EXPECT_TRUE(p.h.wants_field);
}

TEST(recovery, store_that_cannot_be_listed_is_refused)
{
    recovery_scene s;
    const auto before = s.m.files;
    s.m.fail_at = s.m.calls + 1;
    piece p(s.m.port(), recovery_scene_ring(100));
    EXPECT_EQ(p.opened, STATUS_IO);
    EXPECT_EQ(clay_brick_count(&p.c), 0u);
    EXPECT_EQ(s.m.files, before);
}

TEST(recovery, a_call_that_fails_costs_no_file)
{
    const recovery_scene s;
    for (uint64_t nth = 1;; nth++) {
        memory_store m = recovery_scene_after(s.m, [](memory_store &) {});
        m.fail_at = nth;
        piece p(m.port(), recovery_scene_ring(100));
        if (m.calls < nth)
            break;
        ASSERT_TRUE(p.opened == STATUS_IO || (p.opened == STATUS_OK && s.existed(p.digest()))) << nth;
        ASSERT_NO_FATAL_FAILURE(recovery_scene_expect_kept(s.m, m, std::to_string(nth)));
    }
}

TEST(recovery, clay_too_small_is_refused_untouched)
{
    for (const std::set<int> &fields : {std::set<int>{}, std::set<int>{4, 6}}) { /* on the way; in the field */
        recovery_scene s(fields);
        const auto before = s.m.files;
        piece p(s.m.port(), recovery_scene_ring(100), 1);
        EXPECT_EQ(p.opened, STATUS_POOL_FULL);
        EXPECT_EQ(clay_brick_count(&p.c), 0u);
        EXPECT_TRUE(clay_is_valid(&p.c));
        EXPECT_EQ(s.m.files, before);
    }
}

TEST(recovery, last_file_that_cannot_be_synced_gets_no_more)
{
    recovery_scene s;
    s.m.fail_at = 0;
    lost_sync l;
    l.m.files = s.m.files;
    l.fails = true;
    piece p(l.port(), recovery_scene_ring(100));
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.digest(), s.digests[7]);
    EXPECT_NE(std::string(p.finding.text).find(" cannot be written any more"), std::string::npos) << p.finding.text;
    EXPECT_EQ(p.h.ring.current, RING_NONE);
    EXPECT_TRUE(p.h.wants_field);
    ASSERT_EQ(p.redo(), STATUS_OK);
    EXPECT_EQ(l.m.misuse, "") << "the move went elsewhere";
    piece q(l.m.port(), recovery_scene_ring(100));
    EXPECT_EQ(q.digest(), s.digests[8]);
}

TEST(recovery, leftovers_and_strangers_are_not_looked_at)
{
    recovery_scene s;
    for (const char *name : {"field.new", "undo.new", "notes.txt", "undo-0003.set-aside"})
        s.m.files[name] = {1, 2, 3};
    piece p(s.m.port(), recovery_scene_ring(100));
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_STREQ(p.finding.text, "");
    ASSERT_EQ(p.stroke(piece_stroke_numbered(50)), STATUS_OK);
    ASSERT_EQ(p.field(), STATUS_OK);
    piece q(s.m.port(), recovery_scene_ring(100));
    EXPECT_EQ(q.digest(), p.digest());
    EXPECT_EQ(s.m.files.count("field.new"), 0u);
    EXPECT_EQ(s.m.files.count("notes.txt"), 1u);
}

} // namespace
