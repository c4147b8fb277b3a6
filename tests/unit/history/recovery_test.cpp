/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: whatever happened to the files, opening ends in a state of the sculpture that once was, or in a clear refusal;
 *       it says what it found in one sentence; and nothing that held a stroke is lost.
 * Method: one store with undo below and redo above the cursor and a field beneath; every file cut at every byte, every
 *         bit flipped, every file missing; the moments between two files of a commit made by hand. */
#include "history/recovery.h"

#include "clay/digest.h"
#include "history/byte_order.h"
#include "history/cursor_file.h"
#include "tests/unit/history/memory_store.h"
#include "tests/unit/history/piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

namespace {

/* Nine strokes in a ring of 8: field after 4, cursor at 7, strokes 2 to 9 kept. */
struct scene {
    memory_store m;
    std::vector<uint64_t> digests; /* after stroke n */

    scene()
    {
        piece p(m.port(), 8);
        digests.push_back(p.digest());
        for (int n = 1; n <= 9; n++) {
            if (n == 5) {
                EXPECT_EQ(history_checkpoint(&p.h, &p.c), STATUS_OK);
            }
            p.h.dab += 2;
            EXPECT_EQ(p.stroke(piece_stroke_numbered(n, 2)), STATUS_OK);
            digests.push_back(p.digest());
        }
        for (int n = 0; n < 2; n++)
            EXPECT_EQ(p.undo(), STATUS_OK);
        EXPECT_EQ(p.h.checkpoint, 4u);
        EXPECT_EQ(p.h.oldest, 2u);
    }

    bool existed(uint64_t digest) const { return std::count(digests.begin(), digests.end(), digest) > 0; }
};

/* As files are after `change`. */
memory_store files_after(const memory_store &m, const std::function<void(memory_store &)> &change)
{
    memory_store copy;
    copy.files = m.files;
    change(copy);
    return copy;
}

/* Opening and going all the way back and forth meets only states that were; opening once more has nothing to say. */
void expect_sound(const scene &s, memory_store &m, const std::string &what)
{
    {
        piece p(m.port(), 8);
        if (p.opened == STATUS_CORRUPT) {
            ASSERT_NE(p.finding.text[0], '\0') << what;
            ASSERT_EQ(clay_brick_count(&p.c), 0u) << what;
        } else {
            ASSERT_EQ(p.opened, STATUS_OK) << what;
        }
    }
    piece p(m.port(), 8);
    ASSERT_EQ(p.opened, STATUS_OK) << what;
    ASSERT_TRUE(s.existed(p.digest())) << what << ": " << p.finding.text;
    status step = STATUS_OK;
    while ((step = p.undo()) == STATUS_OK)
        ASSERT_TRUE(s.existed(p.digest())) << what;
    ASSERT_TRUE(step == STATUS_HISTORY_ENDS || step == STATUS_CORRUPT) << what;
    while ((step = p.redo()) == STATUS_OK)
        ASSERT_TRUE(s.existed(p.digest())) << what;
    ASSERT_TRUE(step == STATUS_HISTORY_ENDS || step == STATUS_CORRUPT) << what;
    ASSERT_TRUE(clay_is_valid(&p.c));
    piece q(m.port(), 8);
    ASSERT_EQ(q.opened, STATUS_OK) << what;
    ASSERT_STREQ(q.finding.text, "") << what;
    ASSERT_EQ(q.digest(), p.digest()) << what;
    ASSERT_EQ(m.misuse, "") << what;
}

std::vector<std::string> names(const memory_store &m)
{
    std::vector<std::string> all;
    for (const auto &[name, bytes] : m.files)
        all.push_back(name);
    return all;
}

/* Every original file is there as it was, or replaced by a good one with its damaged bytes set aside. */
void expect_kept(const std::map<std::string, std::vector<uint8_t>> &before, const memory_store &m,
                 const std::string &what)
{
    for (const auto &[name, bytes] : before) {
        if (name == CURSOR_FILE_NAME)
            continue;
        const bool there = m.files.count(name) && m.files.at(name) == bytes;
        const std::string aside = name + ".set-aside";
        ASSERT_TRUE(there || (m.files.count(aside) && m.files.at(aside) == bytes)) << what << ": " << name;
    }
}

/* --- damage of every kind --- */

TEST(recovery, every_file_cut_at_every_byte)
{
    const scene s;
    for (const std::string &name : names(s.m))
        for (size_t length = 0; length < s.m.files.at(name).size(); length++) {
            memory_store m = files_after(s.m, [&](memory_store &c) { c.files[name].resize(length); });
            const auto before = m.files;
            expect_sound(s, m, name + " cut to " + std::to_string(length));
            expect_kept(before, m, name);
            if (HasFatalFailure())
                return;
        }
}

TEST(recovery, every_file_with_bits_flipped)
{
    const scene s;
    /* Every bit of one file of each kind, one bit in every byte of the others. */
    const std::set<std::string> thorough = {"cursor", "field", "undo-0006"};
    for (const std::string &name : names(s.m))
        for (size_t bit = 0; bit < s.m.files.at(name).size() * 8; bit += thorough.count(name) ? 1 : 9) {
            memory_store m = files_after(
                s.m, [&](memory_store &c) { c.files[name][bit / 8] ^= static_cast<uint8_t>(1u << bit % 8); });
            const auto before = m.files;
            expect_sound(s, m, name + " bit " + std::to_string(bit));
            expect_kept(before, m, name);
            if (HasFatalFailure())
                return;
        }
}

TEST(recovery, every_set_of_files_missing)
{
    const scene s;
    const std::vector<std::string> all = names(s.m);
    ASSERT_EQ(all.size(), 10u);
    for (unsigned set = 0; set < 1u << all.size(); set++) {
        memory_store m = files_after(s.m, [&](memory_store &c) {
            for (size_t n = 0; n < all.size(); n++)
                if (set >> n & 1)
                    c.files.erase(all[n]);
        });
        expect_sound(s, m, "set " + std::to_string(set));
        if (HasFatalFailure())
            return;
    }
}

TEST(recovery, files_in_each_others_places)
{
    const scene s;
    const std::vector<std::string> all = names(s.m);
    for (const std::string &one : all)
        for (const std::string &other : all) {
            memory_store m = files_after(s.m, [&](memory_store &c) { c.files[one] = s.m.files.at(other); });
            expect_sound(s, m, other + " in the place of " + one);
            if (HasFatalFailure())
                return;
        }
}

TEST(recovery, a_store_that_reads_in_small_pieces_is_as_good)
{
    const scene s;
    for (size_t at_most : {1, 3, 64, 100}) {
        memory_store m = files_after(s.m, [&](memory_store &c) { c.read_at_most = at_most; });
        piece p(m.port(), 8);
        ASSERT_EQ(p.opened, STATUS_OK);
        EXPECT_STREQ(p.finding.text, "");
        EXPECT_EQ(p.digest(), s.digests[7]);
        EXPECT_EQ(m.files, s.m.files);
    }
}

/* --- what is found, and what is said --- */

void spoil(memory_store &m, const std::string &name) { m.files.at(name)[100] ^= 0x10; }

TEST(recovery, sound_files_are_opened_without_a_word)
{
    scene s;
    const auto before = s.m.files;
    piece p(s.m.port(), 8);
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_STREQ(p.finding.text, "");
    EXPECT_EQ(p.digest(), s.digests[7]);
    EXPECT_EQ(p.h.oldest, 2u);
    EXPECT_EQ(p.h.cursor, 7u);
    EXPECT_EQ(p.h.newest, 9u);
    EXPECT_EQ(p.h.dab, 18u);
    EXPECT_EQ(s.m.files, before);
}

TEST(recovery, damage_on_the_way_to_the_cursor_ends_there_and_keeps_the_rest)
{
    scene s;
    spoil(s.m, "undo-0006");
    const auto before = s.m.files;
    {
        piece p(s.m.port(), 8);
        ASSERT_EQ(p.opened, STATUS_OK);
        EXPECT_EQ(p.digest(), s.digests[5]);
        EXPECT_EQ(p.h.newest, 5u);
        EXPECT_EQ(p.h.oldest, 2u);
        EXPECT_NE(std::string(p.finding.text).find("undo-0006 is damaged at byte "), std::string::npos);
        EXPECT_NE(std::string(p.finding.text).find("the sculpture stands as after stroke 5"), std::string::npos);
    }
    for (const char *name : {"undo-0006", "undo-0007", "undo-0000", "undo-0001"}) /* strokes 6, 7, 8, 9 */
        EXPECT_EQ(s.m.files.at(std::string(name) + ".set-aside"), before.at(name));
    EXPECT_EQ(s.m.files.count("undo-0007"), 0u);
    piece again(s.m.port(), 8);
    EXPECT_STREQ(again.finding.text, "");
    EXPECT_EQ(again.digest(), s.digests[5]);
    ASSERT_EQ(again.stroke(piece_stroke_numbered(50)), STATUS_OK);
    EXPECT_EQ(s.m.files.at("undo-0006.set-aside"), before.at("undo-0006"));
}

TEST(recovery, damage_on_the_way_down_to_the_cursor_ends_there)
{
    scene s;
    {
        piece p(s.m.port(), 8);
        ASSERT_EQ(p.redo(), STATUS_OK);
        ASSERT_EQ(p.redo(), STATUS_OK);
        ASSERT_EQ(history_checkpoint(&p.h, &p.c), STATUS_OK);
        for (int n = 0; n < 4; n++)
            ASSERT_EQ(p.undo(), STATUS_OK);
    }
    spoil(s.m, "undo-0007");
    piece p(s.m.port(), 8);
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.digest(), s.digests[7]);
    EXPECT_FALSE(history_can_undo(&p.h));
    EXPECT_EQ(p.h.newest, 9u);
    EXPECT_NE(std::string(p.finding.text).find("the sculpture stands as after stroke 7"), std::string::npos);
    EXPECT_EQ(s.m.files.count("undo-0007.set-aside"), 1u);
}

TEST(recovery, damage_on_the_undo_side_is_said_and_ends_it)
{
    scene s;
    s.m.files["undo-0003"][30] ^= 1; /* in the header: opening sees it */
    piece p(s.m.port(), 8);
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.digest(), s.digests[7]);
    EXPECT_EQ(p.h.oldest, 4u);
    EXPECT_EQ(p.h.newest, 9u);
    EXPECT_EQ(std::string(p.finding.text),
              "undo-0003 is damaged at byte 80 (expected the checksum of the header): not every stroke can be undone "
              "before stroke 7");
    EXPECT_EQ(s.m.files.count("undo-0003.set-aside"), 1u);
    piece again(s.m.port(), 8);
    EXPECT_STREQ(again.finding.text, "") << "said once is enough";
}

TEST(recovery, missing_redo_file_is_said_and_ends_it)
{
    scene s;
    s.m.files.erase("undo-0000");
    piece p(s.m.port(), 8);
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.digest(), s.digests[7]);
    EXPECT_EQ(p.h.newest, 7u);
    EXPECT_EQ(p.h.oldest, 2u);
    EXPECT_EQ(std::string(p.finding.text), "undo-0000 is missing: not every stroke can be redone after stroke 7");
    EXPECT_EQ(s.m.files.count("undo-0001.set-aside"), 1u) << "stroke 9 leads nowhere without 8";
    piece again(s.m.port(), 8);
    EXPECT_STREQ(again.finding.text, "");
}

TEST(recovery, file_in_a_place_that_is_not_its_own_is_set_aside)
{
    scene s;
    s.m.files["undo-0003"] = s.m.files["undo-0005"];
    piece p(s.m.port(), 8);
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.h.oldest, 4u);
    EXPECT_NE(std::string(p.finding.text).find("a stroke that belongs in this place"), std::string::npos);
    EXPECT_EQ(s.m.files.at("undo-0003.set-aside"), s.m.files.at("undo-0005"));
}

TEST(recovery, damaged_cursor_falls_back_to_the_last_stroke_that_links)
{
    for (bool missing : {false, true}) {
        scene s;
        if (missing)
            s.m.files.erase("cursor");
        else
            s.m.files["cursor"][20] ^= 1;
        piece p(s.m.port(), 3); /* the ring is found in the undo-files */
        ASSERT_EQ(p.opened, STATUS_OK);
        EXPECT_EQ(p.digest(), s.digests[9]);
        EXPECT_EQ(p.h.ring, 8u);
        EXPECT_EQ(p.h.oldest, 2u);
        EXPECT_EQ(p.h.newest, 9u);
        EXPECT_EQ(p.h.dab, 18u);
        EXPECT_EQ(p.h.step_mm, 0.5);
        EXPECT_EQ(std::string(p.finding.text),
                  std::string("cursor is ") + (missing ? "missing" : "damaged") +
                      ": the sculpture stands as after stroke 9, the last one kept");
        EXPECT_EQ(s.m.files.count("cursor.set-aside"), missing ? 0u : 1u);
        EXPECT_EQ(s.m.files.count("cursor"), 1u);
    }
}

TEST(recovery, damaged_field_is_set_aside_and_the_second_opening_starts_anew)
{
    scene s;
    s.m.files["field"][150] ^= 1;
    const auto before = s.m.files;
    {
        piece p(s.m.port(), 8);
        EXPECT_EQ(p.opened, STATUS_CORRUPT);
        EXPECT_EQ(std::string(p.finding.text).find("field is damaged at byte "), 0u) << p.finding.text;
        EXPECT_EQ(s.m.files.count("field"), 0u);
        EXPECT_EQ(s.m.files.at("field.set-aside"), before.at("field"));
    }
    piece p(s.m.port(), 8);
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(clay_brick_count(&p.c), 0u) << "stroke 1 is no longer in the ring";
    EXPECT_FALSE(history_can_undo(&p.h) || history_can_redo(&p.h));
    EXPECT_NE(p.finding.text[0], '\0');
    EXPECT_EQ(p.h.step_mm, 0.5);
    for (int n = 0; n < 8; n++) {
        const std::string name = "undo-000" + std::to_string(n);
        EXPECT_EQ(s.m.files.at(name + ".set-aside"), before.at(name));
        EXPECT_EQ(s.m.files.count(name), 0u);
    }
}

TEST(recovery, lost_field_is_made_again_from_the_first_stroke_on)
{
    memory_store m;
    uint64_t digest = 0;
    {
        piece p(m.port(), 8);
        for (int n = 1; n <= 6; n++)
            ASSERT_EQ(p.stroke(piece_stroke_numbered(n)), STATUS_OK);
        ASSERT_EQ(history_checkpoint(&p.h, &p.c), STATUS_OK);
        ASSERT_EQ(p.undo(), STATUS_OK);
        digest = p.digest();
    }
    m.files.erase("field");
    piece p(m.port(), 8);
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.digest(), digest);
    EXPECT_EQ(p.h.newest, 6u);
    EXPECT_EQ(p.h.oldest, 1u);
    EXPECT_EQ(p.h.checkpoint, 5u) << "the field is written again at once";
    EXPECT_EQ(std::string(p.finding.text),
              "field is missing: the undo-files made the sculpture again, up to stroke 5");
}

/* --- newer and unreadable --- */

void make_newer(std::vector<uint8_t> &b, size_t header_bytes)
{
    byte_order_put_u32(&b[8], 2);
    byte_order_put_u64(&b[header_bytes - 8], digest_bytes(b.data(), header_bytes - 8, 0));
}

TEST(recovery, newer_files_are_refused_untouched)
{
    for (const auto &[name, header_bytes] :
         std::map<std::string, size_t>{{"cursor", 72}, {"field", 64}, {"undo-0003", 88}, {"undo-0001", 88}}) {
        scene s;
        make_newer(s.m.files.at(name), header_bytes);
        spoil(s.m, "undo-0006");
        const auto before = s.m.files;
        piece p(s.m.port(), 8);
        EXPECT_EQ(p.opened, STATUS_NEWER) << name;
        EXPECT_EQ(std::string(p.finding.text), name + " was written by a newer version of this program");
        EXPECT_EQ(s.m.files, before);
        EXPECT_EQ(clay_brick_count(&p.c), 0u);
    }
}

TEST(recovery, unreadable_on_the_way_is_refused_and_elsewhere_ends_history)
{
    for (const char *name : {"cursor", "field", "undo-0005", "undo-0007"}) {
        scene s;
        s.m.unreadable = name;
        const auto before = s.m.files;
        piece p(s.m.port(), 8);
        EXPECT_EQ(p.opened, STATUS_IO) << name;
        EXPECT_EQ(s.m.files, before);
    }
    scene s;
    s.m.unreadable = "undo-0003";
    piece p(s.m.port(), 8);
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.digest(), s.digests[7]);
    EXPECT_EQ(p.h.oldest, 4u);
    EXPECT_EQ(std::string(p.finding.text).find("undo-0003 cannot be read: "), 0u) << p.finding.text;
    EXPECT_EQ(s.m.files.count("undo-0003"), 1u) << "it may be readable tomorrow";
}

TEST(recovery, clay_too_small_for_the_field_is_refused_untouched)
{
    scene s;
    const auto before = s.m.files;
    piece p(s.m.port(), 8, 1);
    EXPECT_EQ(p.opened, STATUS_POOL_FULL);
    EXPECT_EQ(s.m.files, before);
    EXPECT_EQ(clay_brick_count(&p.c), 0u);
}

/* --- the power goes between two files --- */

TEST(recovery, stroke_whose_cursor_was_not_written_is_absent_without_a_word)
{
    scene s;
    {
        piece p(s.m.port(), 8);
        ASSERT_EQ(p.redo(), STATUS_OK);
        ASSERT_EQ(p.redo(), STATUS_OK);
    }
    const auto cursor = s.m.files.at("cursor");
    {
        piece p(s.m.port(), 8);
        ASSERT_EQ(p.stroke(piece_stroke_numbered(10)), STATUS_OK); /* in the place of stroke 2 */
    }
    s.m.files["cursor"] = cursor;
    piece p(s.m.port(), 8);
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_STREQ(p.finding.text, "");
    EXPECT_EQ(p.digest(), s.digests[9]);
    EXPECT_EQ(p.h.oldest, 3u);
    EXPECT_EQ(p.h.newest, 9u);
}

TEST(recovery, stroke_in_the_place_of_undone_ones_whose_cursor_was_not_written_can_be_redone)
{
    scene s;
    const auto cursor = s.m.files.at("cursor");
    uint64_t other;
    {
        piece p(s.m.port(), 8);
        ASSERT_EQ(p.stroke(piece_stroke_numbered(33)), STATUS_OK);
        EXPECT_EQ(p.h.cursor, 8u);
        other = p.digest();
    }
    s.m.files["cursor"] = cursor;
    const auto before = s.m.files;
    piece p(s.m.port(), 8);
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_STREQ(p.finding.text, "");
    EXPECT_EQ(p.digest(), s.digests[7]);
    EXPECT_EQ(p.h.newest, 8u) << "stroke 9 is of the other branch";
    ASSERT_EQ(p.redo(), STATUS_OK);
    EXPECT_EQ(p.digest(), other);
    EXPECT_EQ(p.redo(), STATUS_HISTORY_ENDS);
    for (const auto &[name, bytes] : before)
        EXPECT_EQ(s.m.files.count(name + ".set-aside"), 0u);
}

TEST(recovery, new_store_whose_cursor_was_not_written_opens_without_a_word)
{
    memory_store m;
    {
        piece p(m.port(), 8);
    }
    m.files.erase("cursor");
    piece p(m.port(), 8);
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_STREQ(p.finding.text, "");
}

TEST(recovery, field_alone_is_enough)
{
    scene s;
    const auto field = s.m.files.at("field");
    s.m.files.clear();
    s.m.files["field"] = field;
    memory_store copy;
    copy.files = s.m.files;
    piece_clay c;
    history h;
    history_finding finding;
    ASSERT_EQ(history_open(&h, copy.port(), 5, 3.0, &c.c, &finding), STATUS_OK);
    EXPECT_STREQ(finding.text, "");
    EXPECT_EQ(clay_digest(&c.c), s.digests[4]);
    EXPECT_EQ(h.step_mm, 0.5) << "that of the field, not the caller's";
    EXPECT_EQ(h.dab, 8u);
    EXPECT_EQ(h.cursor, 4u);
    EXPECT_FALSE(history_can_undo(&h) || history_can_redo(&h));
    history_close(&h);
}

TEST(recovery, walk_over_more_bricks_than_dirt_has_room_for)
{
    /* One corner wanders through forty bricks, in clay that has room for eight, and dirt for sixteen. */
    memory_store m;
    uint64_t digest = 0;
    {
        piece p(m.port(), 100, 8);
        for (int n = 1; n <= 40; n++) {
            const piece_stroke stroke = {{{8 * n, 0, 0}, 1, 1}, {{8 * n - 8, 0, 0}, 0, 0}};
            ASSERT_EQ(p.stroke(stroke), STATUS_OK);
        }
        digest = p.digest();
    }
    piece p(m.port(), 100, 8);
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.digest(), digest);
    EXPECT_EQ(dirt_count(&p.c.dirty), 1u);
}

TEST(recovery, leftovers_of_writing_are_not_looked_at)
{
    scene s;
    for (const char *name : {"undo.new", "cursor.new", "field.new"})
        s.m.files[name] = {1, 2, 3};
    piece p(s.m.port(), 8);
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_STREQ(p.finding.text, "");
    ASSERT_EQ(p.stroke(piece_stroke_numbered(50)), STATUS_OK);
    ASSERT_EQ(history_checkpoint(&p.h, &p.c), STATUS_OK);
    piece q(s.m.port(), 8);
    EXPECT_EQ(q.digest(), p.digest());
    EXPECT_EQ(s.m.files.count("undo.new") + s.m.files.count("cursor.new") + s.m.files.count("field.new"), 0u);
}

} // namespace
