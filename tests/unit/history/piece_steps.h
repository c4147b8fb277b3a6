/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Steps that tests of history have in common: numbered strokes up and undo down, with the digest of every
 *          state remembered, and another history that opens a copy of the files.
 */
#ifndef GLAISE_UNIT_HISTORY_PIECE_STEPS_H
#define GLAISE_UNIT_HISTORY_PIECE_STEPS_H

#include "tests/unit/history/memory_store.h"
#include "tests/unit/history/piece.h"

inline constexpr uint64_t PIECE_STEPS_FILE_BYTES = RING_FILE_BYTES_MIN;

inline piece_ring piece_steps_ring(uint32_t strokes)
{
    return {strokes, PIECE_STEPS_FILE_BYTES, PIECE_STEPS_FILE_BYTES * 1000};
}

/* The files alone lead to the same sculpture with the same history. */
inline void piece_steps_reopen(const piece &p, const memory_store &m)
{
    memory_store copy;
    copy.files = m.files;
    piece q(copy.port(), piece_steps_ring(p.h.settings.strokes));
    ASSERT_EQ(q.opened, STATUS_OK);
    ASSERT_STREQ(q.finding.text, "");
    ASSERT_EQ(q.digest(), p.digest());
    ASSERT_EQ(q.h.tree.cursor, p.h.tree.cursor);
    ASSERT_EQ(q.h.tree.tip, p.h.tree.tip);
    ASSERT_EQ(q.h.dab, p.h.dab);
    ASSERT_EQ(q.h.step_mm, p.h.step_mm);
    ASSERT_EQ(q.h.stroke, p.h.stroke);
    for (uint32_t n = 0; n < p.h.tree.count; n++)
        ASSERT_NE(tree_find(&q.h.tree, p.h.tree.strokes[n].stroke), nullptr);
    ASSERT_TRUE(clay_is_valid(&q.c));
    ASSERT_EQ(copy.misuse, "");
}

/* Strokes first..last, numbered; digests[n] is that after stroke n. */
inline void piece_steps_up_to(piece &p, std::vector<uint64_t> &digests, int first, int last)
{
    if (digests.empty())
        digests.push_back(p.digest());
    digests.resize(static_cast<size_t>(first));
    for (int n = first; n <= last; n++) {
        ASSERT_EQ(p.stroke(piece_stroke_numbered(n)), STATUS_OK);
        digests.push_back(p.digest());
        ASSERT_NE(digests[static_cast<size_t>(n)], digests[static_cast<size_t>(n) - 1]);
    }
}

/* Undo as far as it goes; every state must be one of the digests, next older each. */
inline size_t piece_steps_undo_all(piece &p, const std::vector<uint64_t> &digests)
{
    size_t steps = 0;
    while (history_can_undo(&p.h)) {
        EXPECT_EQ(p.undo(), STATUS_OK);
        steps++;
        EXPECT_EQ(p.digest(), digests[p.h.tree.cursor]);
    }
    EXPECT_EQ(p.undo(), STATUS_HISTORY_ENDS);
    return steps;
}

inline std::string piece_steps_file_of(const piece &p, uint64_t stroke)
{
    return ring_name_of(ring_next_file(&p.h.ring, stroke, 0)).text;
}

inline size_t piece_steps_undo_files(const memory_store &m)
{
    size_t n = 0;
    for (const auto &[name, bytes] : m.files)
        n += name.starts_with("undo-") && name.size() == 9;
    return n;
}

/* Every corner of so many bricks: some 4 KiB of record each. */
inline piece_stroke piece_steps_large(int bricks, uint32_t seed)
{
    piece_stroke s;
    seeded chance = {seed};
    for (int b = 0; b < bricks; b++)
        for (int n = 0; n < BRICK_CORNERS; n++)
            s.push_back({{8 * b + n / 64, n / 8 % 8, n % 8},
                         static_cast<float>(seeded_real(chance, 0.5, 2.5)),
                         static_cast<uint32_t>(seeded_bits(chance))});
    return s;
}

#endif
