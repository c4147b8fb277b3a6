/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: H7. On a medium that is full undo reaches less far, strokes are refused only when nothing may be forgotten, none
 *       that was put is lost, sculpting goes on when there is room; and nothing is tried for ever.
 * Method: a store in memory that holds so many bytes and no more; what a keeper does is done step by step, with every
 *         call of the store counted; after each step another history opens a copy of the files. */
#include "history/keeper.h"

#include "tests/unit/history/piece_steps.h"

#include <gtest/gtest.h>

namespace {

enum { WORK_MOST = 2000 }; /* slices: what goes on for longer than this goes on for ever */

/* What a history thread and its sculpture do until nothing is left to do. */
void rest(piece &p)
{
    int slices = 0;
    bool more = true;
    while (more) {
        (void)!history_keep(&p.h);
        keeper_facts facts;
        keeper_look(&p.h, &facts);
        if (facts.wants_field && !p.h.in_stroke)
            (void)!history_field_begin(&p.h, &p.c);
        more = history_work(&p.h);
        keeper_look(&p.h, &facts);
        more = more || facts.wants_field;
        ASSERT_LT(++slices, WORK_MOST) << "it never ends";
    }
}

/* One stroke, if one may begin; false when it was refused. */
bool one_more(piece &p, std::vector<uint64_t> &digests, const piece_stroke &s)
{
    if (history_room(&p.h) != STATUS_OK)
        return false;
    EXPECT_EQ(p.stretch(s, true), STATUS_OK);
    digests.push_back(p.digest());
    return true;
}

uint64_t reserve_bytes(const memory_store &m)
{
    const auto at = m.files.find(RESERVE_NAME);
    return at == m.files.end() ? 0 : at->second.size();
}

TEST(history_full, reserve_is_made_beside_and_holds_two_checkpoints_and_files)
{
    memory_store m;
    piece p(m.port());
    std::vector<uint64_t> digests = {p.digest()};
    ASSERT_TRUE(one_more(p, digests, piece_steps_large(40, 1)));
    ASSERT_NO_FATAL_FAILURE(rest(p));
    ASSERT_EQ(p.field(), STATUS_OK);
    ASSERT_NO_FATAL_FAILURE(rest(p));
    const uint64_t field = m.files.at("field").size();
    EXPECT_GE(reserve_bytes(m), 2 * field + 4 * PIECE_STEPS_FILE_BYTES);
    ASSERT_EQ(p.field(), STATUS_OK);
    ASSERT_NO_FATAL_FAILURE(rest(p));
    EXPECT_GE(reserve_bytes(m), field + 4 * PIECE_STEPS_FILE_BYTES) << "the older one gives its place";
    EXPECT_LE(reserve_bytes(m), 6 * field + 8 * PIECE_STEPS_FILE_BYTES);
    const uint64_t calls = m.calls;
    ASSERT_NO_FATAL_FAILURE(rest(p));
    EXPECT_EQ(m.calls, calls) << "once made it costs nothing";
    EXPECT_LE(p.h.ring.bytes, piece_steps_undo_files(m) * PIECE_STEPS_FILE_BYTES) << "it is none of the undo-files";
}

TEST(history_full, undo_reaches_less_far_and_sculpting_goes_on_for_ever)
{
    memory_store m;
    piece p(m.port());
    std::vector<uint64_t> digests = {p.digest()};
    for (int n = 1; n <= 8; n++) { /* fewer than a checkpoint is due after: none is beneath any */
        ASSERT_TRUE(one_more(p, digests, piece_stroke_numbered(n)));
        ASSERT_NO_FATAL_FAILURE(rest(p));
    }
    ASSERT_FALSE(p.h.field.there);
    m.most_bytes = m.held();
    for (int n = 9; n <= 60; n++) {
        ASSERT_TRUE(one_more(p, digests, piece_stroke_numbered(n))) << n << ": " << p.h.trouble.text;
        ASSERT_NO_FATAL_FAILURE(rest(p));
        ASSERT_EQ(p.h.kept, p.h.sequence) << n;
        ASSERT_NO_FATAL_FAILURE(piece_steps_reopen(p, m));
        EXPECT_LE(p.h.tree.count, 13u) << n;
    }
    EXPECT_EQ(p.h.medium, HISTORY_MEDIUM_GOOD);
    const uint64_t calls = m.calls;
    for (int n = 0; n < 10; n++)
        ASSERT_NO_FATAL_FAILURE(rest(p));
    EXPECT_LE(m.calls, calls + 10 * 3) << "each time an undo-file is tried to be made ahead, and nothing else";
    EXPECT_GE(piece_steps_undo_all(p, digests), 4u);
    EXPECT_EQ(m.misuse, "");
}

/* Nothing is written between strokes, as when somebody is faster than checkpoints are. */
TEST(history_full, what_cannot_be_kept_is_refused_before_it_is_made)
{
    constexpr uint64_t file = 4 * PIECE_STEPS_FILE_BYTES;
    memory_store m;
    piece p(m.port(), {40, file, file * 1000, 4});
    std::vector<uint64_t> digests = {p.digest()};
    for (int n = 1; n <= 8; n++) {
        ASSERT_TRUE(one_more(p, digests, piece_stroke_numbered(n)));
        ASSERT_NO_FATAL_FAILURE(rest(p));
    }
    m.most_bytes = m.held();
    int n = 9;
    for (; one_more(p, digests, piece_stroke_numbered(n)); n++) {
        ASSERT_LT(n, 30);
        ASSERT_EQ(history_keep(&p.h), STATUS_OK) << n;
    }
    EXPECT_GT(n, 10) << "the reserve has room for some";
    EXPECT_EQ(p.h.medium, HISTORY_MEDIUM_GOOD);
    EXPECT_EQ(p.h.held_bytes, 0u) << "all that was made is kept";
    ASSERT_NO_FATAL_FAILURE(rest(p));
    EXPECT_EQ(history_room(&p.h), STATUS_OK) << "undo reaches less far, and it goes on";
    m.most_bytes = UINT64_MAX;
    for (int more = 0; more < 160; more++) {
        ASSERT_TRUE(one_more(p, digests, piece_stroke_numbered(n + more)));
        ASSERT_NO_FATAL_FAILURE(rest(p));
    }
    for (const auto &[name, bytes] : m.files)
        if (name.starts_with("undo-")) {
            EXPECT_EQ(bytes.size(), file) << name << ": of those that the reserve gave, which are small, none is left";
        }
    EXPECT_EQ(m.misuse, "");
}

TEST(history_full, nothing_to_forget_and_nothing_in_reserve_refuses_until_there_is_room)
{
    memory_store m;
    piece p(m.port(), {200, PIECE_STEPS_FILE_BYTES, PIECE_STEPS_FILE_BYTES * 1000, 0});
    std::vector<uint64_t> digests = {p.digest()};
    for (int n = 1; n <= 8; n++) {
        ASSERT_TRUE(one_more(p, digests, piece_stroke_numbered(n)));
        ASSERT_NO_FATAL_FAILURE(rest(p));
    }
    m.most_bytes = m.held();
    int n = 9;
    for (; one_more(p, digests, piece_stroke_numbered(n)); n++) {
        ASSERT_LT(n, 12);
        ASSERT_NO_FATAL_FAILURE(rest(p));
    }
    EXPECT_EQ(history_room(&p.h), STATUS_NO_SPACE);
    EXPECT_NE(p.h.trouble.text[0], '\0');
    EXPECT_GT(p.h.held_bytes, 0u);
    const uint64_t newest = p.h.tree.cursor, kept = p.h.kept;
    {
        memory_store copy;
        copy.files = m.files;
        piece q(copy.port());
        EXPECT_STREQ(q.finding.text, "");
        EXPECT_EQ(q.h.sequence, kept) << "what was kept stays so";
    }
    keeper_facts facts;
    keeper_look(&p.h, &facts);
    EXPECT_FALSE(facts.wants_field) << "it could not begin";
    m.most_bytes = UINT64_MAX;
    ASSERT_NO_FATAL_FAILURE(rest(p));
    EXPECT_EQ(history_room(&p.h), STATUS_OK);
    EXPECT_EQ(p.h.tree.cursor, newest) << "what was put stayed put";
    EXPECT_EQ(p.h.held_bytes, 0u);
    EXPECT_TRUE(p.h.before.there) << "what was owed is written";
    ASSERT_NO_FATAL_FAILURE(piece_steps_reopen(p, m));
    EXPECT_EQ(piece_steps_undo_all(p, digests), newest);
    EXPECT_EQ(m.misuse, "");
}

TEST(history_full, checkpoint_without_space_is_given_up_and_leaves_nothing_behind)
{
    memory_store m;
    piece p(m.port(), {200, PIECE_STEPS_FILE_BYTES, PIECE_STEPS_FILE_BYTES * 1000, 0});
    std::vector<uint64_t> digests = {p.digest()};
    ASSERT_TRUE(one_more(p, digests, piece_steps_large(40, 1)));
    ASSERT_NO_FATAL_FAILURE(rest(p));
    m.most_bytes = m.held() + 70000; /* the clay takes more than 160000 */
    (void)!p.field();
    EXPECT_FALSE(p.h.field.there);
    EXPECT_EQ(m.files.count("field.new"), 0u);
    EXPECT_NE(std::string(p.h.trouble.text).find("full"), std::string::npos) << p.h.trouble.text;
    EXPECT_FALSE(p.h.wants_field) << "not again at once";
    const uint64_t calls = m.calls;
    ASSERT_NO_FATAL_FAILURE(rest(p));
    EXPECT_LE(m.calls, calls + 6) << "a try to make an undo-file ahead, no checkpoint";
    m.most_bytes = UINT64_MAX;
    ASSERT_EQ(p.field(), STATUS_OK);
    EXPECT_TRUE(p.h.field.there);
    EXPECT_EQ(m.misuse, "");
}

TEST(history_full, checkpoint_takes_the_reserve_then_undo)
{
    memory_store m;
    piece p(m.port());
    std::vector<uint64_t> digests = {p.digest()};
    for (int n = 1; n <= 20; n++)
        ASSERT_TRUE(one_more(p, digests, piece_stroke_numbered(n)));
    ASSERT_NO_FATAL_FAILURE(rest(p));
    for (int n = 0; n < 2; n++)
        ASSERT_EQ(p.field(), STATUS_OK);
    ASSERT_NO_FATAL_FAILURE(rest(p));
    m.most_bytes = m.held();
    ASSERT_TRUE(one_more(p, digests, piece_steps_large(300, 7))); /* a field far larger than the one before */
    ASSERT_EQ(history_keep(&p.h), STATUS_NO_SPACE) << "its record alone is more than there is";
    const uint64_t kept = p.h.kept;
    EXPECT_LE(p.h.tree.count, 2u) << "everything else was given for it";
    EXPECT_EQ(reserve_bytes(m), 0u);
    m.most_bytes += 4000000;
    ASSERT_NO_FATAL_FAILURE(rest(p));
    EXPECT_GT(p.h.kept, kept);
    EXPECT_EQ(p.h.kept, p.h.sequence);
    ASSERT_NO_FATAL_FAILURE(piece_steps_reopen(p, m));
    EXPECT_EQ(m.misuse, "");
}

TEST(history_full, every_size_of_the_medium_ends_in_rest_with_nothing_lost)
{
    for (uint64_t more = 0; more < 40; more++) {
        SCOPED_TRACE(more);
        memory_store m;
        piece p(m.port(), {30, PIECE_STEPS_FILE_BYTES, PIECE_STEPS_FILE_BYTES * 1000, static_cast<uint32_t>(more % 5)});
        std::vector<uint64_t> digests = {p.digest()};
        m.most_bytes = 90000 + more * 23456;
        for (int n = 1; n <= 40; n++) {
            const bool large = n % 7 == 3;
            (void)!one_more(p, digests,
                            large ? piece_steps_large(6, 9u * static_cast<uint32_t>(n)) : piece_stroke_numbered(n));
            ASSERT_NO_FATAL_FAILURE(rest(p));
            ASSERT_TRUE(p.h.medium == HISTORY_MEDIUM_GOOD || history_room(&p.h) == STATUS_NO_SPACE);
            const uint64_t calls = m.calls;
            ASSERT_NO_FATAL_FAILURE(rest(p));
            ASSERT_LE(m.calls, calls + (p.h.medium == HISTORY_MEDIUM_GOOD ? 3u : 6u)) << "an undo-file is tried to be made";
        }
        m.most_bytes = UINT64_MAX;
        ASSERT_NO_FATAL_FAILURE(rest(p));
        ASSERT_EQ(p.h.kept, p.h.sequence);
        ASSERT_EQ(history_room(&p.h), STATUS_OK);
        ASSERT_NO_FATAL_FAILURE(piece_steps_reopen(p, m));
        (void)piece_steps_undo_all(p, digests);
        ASSERT_EQ(m.misuse, "");
    }
}

TEST(history_full, reserve_of_any_size_or_none_means_nothing_to_opening)
{
    memory_store m;
    std::vector<uint64_t> digests;
    {
        piece p(m.port());
        ASSERT_NO_FATAL_FAILURE(piece_steps_up_to(p, digests, 1, 5));
    }
    for (const size_t size : {size_t{0}, size_t{1}, size_t{77777}, size_t{5000000}}) {
        m.files[RESERVE_NAME] = std::vector<uint8_t>(size, 0xa5);
        piece q(m.port());
        EXPECT_STREQ(q.finding.text, "");
        EXPECT_EQ(q.digest(), digests[5]);
        ASSERT_NO_FATAL_FAILURE(rest(q));
        EXPECT_LE(reserve_bytes(m), 1000000u) << "cut where it is far too long";
        EXPECT_GE(reserve_bytes(m), 4 * PIECE_STEPS_FILE_BYTES);
        EXPECT_EQ(m.files.count("reserve.set-aside"), 0u);
    }
    m.files.erase(RESERVE_NAME);
    piece q(m.port());
    EXPECT_STREQ(q.finding.text, "");
    EXPECT_EQ(q.digest(), digests[5]);
}

} // namespace
