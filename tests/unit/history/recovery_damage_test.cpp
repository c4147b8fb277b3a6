/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: whatever happened to the files, opening ends in a state of the sculpture that once was; nothing that held a
 *       stroke is gone; and what is made after it is kept.
 * Method: every file of a small store cut, turned over, missing, in the place of another. */
#include "tests/unit/history/recovery_scene.h"

#include <gtest/gtest.h>

namespace {

/* Opening and going all the way back and forth meets only states that were; what is made after it is kept. */
void expect_sound(const recovery_scene &s, memory_store m, const std::string &what)
{
    const memory_store before = m;
    uint64_t digest = 0;
    {
        piece p(m.port(), recovery_scene_ring(s.strokes));
        ASSERT_EQ(p.opened, STATUS_OK) << what;
        ASSERT_TRUE(s.existed(p.digest())) << what << ": " << p.finding.text;
        ASSERT_EQ(p.digest(), p.h.digest) << what;
        ASSERT_NO_FATAL_FAILURE(recovery_scene_expect_kept(before, m, what));
        for (const history_way way : {HISTORY_BACK, HISTORY_FORTH}) {
            status step = STATUS_OK;
            while ((step = p.go(way)) == STATUS_OK)
                ASSERT_TRUE(s.existed(p.digest())) << what;
            ASSERT_TRUE(step == STATUS_HISTORY_ENDS || step == STATUS_CORRUPT) << what;
        }
        ASSERT_TRUE(clay_is_valid(&p.c));
        ASSERT_EQ(p.stroke(piece_stroke_numbered(50)), STATUS_OK) << what;
        digest = p.digest();
    }
    piece q(m.port(), recovery_scene_ring(s.strokes));
    ASSERT_EQ(q.opened, STATUS_OK) << what;
    ASSERT_EQ(q.digest(), digest) << what << ": " << q.finding.text;
    ASSERT_EQ(m.misuse, "") << what;
}

std::vector<std::string> names(const memory_store &m)
{
    std::vector<std::string> all;
    for (const auto &[name, bytes] : m.files)
        all.push_back(name);
    return all;
}

/* --- damage of every kind --- */

TEST(recovery_damage, every_file_cut)
{
    const recovery_scene s;
    for (const std::string &name : names(s.m)) {
        const size_t size = s.m.files.at(name).size();
        for (size_t length = 0; length < size; length += length < 400 || length % 4096 > 4094 ? 1 : 251) {
            expect_sound(s, recovery_scene_after(s.m, [&](memory_store &c) { c.files[name].resize(length); }),
                         name + " cut to " + std::to_string(length));
            if (HasFatalFailure())
                return;
        }
    }
}

TEST(recovery_damage, every_file_with_bits_turned)
{
    const recovery_scene s;
    for (const std::string &name : names(s.m)) {
        const size_t size = s.m.files.at(name).size();
        for (size_t at = 0; at < size; at += at < 400 ? 1 : at % 4096 < 256 ? 11 : 509) {
            expect_sound(s, recovery_scene_after(s.m,
                         [&](memory_store &c) { c.files[name][at] ^= uint8_t(1u << at % 8); }),
                         name + " turned at " + std::to_string(at));
            if (HasFatalFailure())
                return;
        }
    }
}

TEST(recovery_damage, every_set_of_files_missing)
{
    const recovery_scene s;
    const std::vector<std::string> all = names(s.m);
    ASSERT_LE(all.size(), 13u);
    for (unsigned set = 0; set < 1u << all.size(); set++) {
        expect_sound(s,
                     recovery_scene_after(s.m,
                                 [&](memory_store &c) {
                                     for (size_t n = 0; n < all.size(); n++)
                                         if (set >> n & 1)
                                             c.files.erase(all[n]);
                                 }),
                     "set " + std::to_string(set));
        if (HasFatalFailure())
            return;
    }
}

TEST(recovery_damage, files_in_each_others_places)
{
    const recovery_scene s;
    for (const std::string &one : names(s.m))
        for (const std::string &other : names(s.m)) {
            expect_sound(s, recovery_scene_after(s.m, [&](memory_store &c) { c.files[one] = s.m.files.at(other); }),
                         other + " in the place of " + one);
            if (HasFatalFailure())
                return;
        }
}

TEST(recovery_damage, a_file_whose_beginning_is_unreadable_is_kept_aside)
{
    recovery_scene s;
    s.turn(3, 100);
    const std::string name = s.files.at(3);
    const std::vector<uint8_t> was = s.m.files.at(name);
    piece p(s.m.port(), recovery_scene_ring(s.strokes));
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_EQ(p.digest(), s.digests[7]);
    EXPECT_EQ(s.m.files.count(name), 0u);
    ASSERT_EQ(s.m.files.count(name + ".set-aside"), 1u);
    EXPECT_EQ(s.m.files.at(name + ".set-aside"), was);
    for (int n = 0; n < 4; n++)
        ASSERT_EQ(p.undo(), STATUS_OK);
    EXPECT_EQ(p.undo(), STATUS_HISTORY_ENDS) << "stroke 3 is not there any more";
}

/* Three strokes, of which the third is written twice, because the sync of its first file fails, and a checkpoint. The
   failing call is the nth; false: that was not it. */
bool written_twice(memory_store &m, std::vector<uint64_t> &digests, uint64_t nth)
{
    piece p(m.port(), recovery_scene_ring(100));
    digests = {0};
    for (int n = 1; n < 4; n++) {
        EXPECT_EQ(p.stretch(piece_stroke_numbered(n), true), STATUS_OK);
        m.fail_at = n == 3 ? m.calls + nth : 0;
        m.fail_having_done = true;
        EXPECT_EQ(p.keep(), STATUS_OK);
        digests.push_back(p.digest());
    }
    m.fail_at = 0;
    EXPECT_EQ(p.field(), STATUS_OK);
    record r[2];
    return p.h.ring.count > 3 && ring_read_header(&p.h.ring, 2, 0, &r[0]) == STATUS_OK &&
           ring_read_header(&p.h.ring, 3, 0, &r[1]) == STATUS_OK && r[0].sequence == r[1].sequence;
}

TEST(recovery_damage, what_was_written_twice_is_there_while_one_of_the_two_is)
{
    memory_store m;
    std::vector<uint64_t> digests;
    uint64_t nth = 1;
    while (nth < 10 && !written_twice(m = memory_store(), digests, nth))
        nth++;
    ASSERT_LT(nth, 10u);
    m.files.erase(ring_name_of(3).text);
    for (int round = 0; round < 3; round++) {
        piece p(m.port(), recovery_scene_ring(100));
        ASSERT_EQ(p.opened, STATUS_OK);
        ASSERT_EQ(p.digest(), digests[round < 2 ? 3 : 0]) << p.finding.text;
        if (round == 0) { /* what follows on it follows on the checkpoint, which knows of the second */
            ASSERT_EQ(p.stroke(piece_stroke_numbered(9)), STATUS_OK);
            ASSERT_EQ(p.undo(), STATUS_OK);
        } else if (round == 1) {
            for (size_t n = 3; n-- > 0;) {
                ASSERT_EQ(p.undo(), STATUS_OK);
                ASSERT_EQ(p.digest(), digests[n]);
            }
        }
        ASSERT_EQ(p.keep(), STATUS_OK);
    }
}

} // namespace
