/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   a store of which a file was cut short, or a byte changed, opens, and with a state that was.
 * Method: a small store, of which every undo-file and every checkpoint is cut at every byte, and every byte of headers
 *         and every so many of what follows is flipped. What comes up is compared with all states that there were;
 *         where a checkpoint was damaged, with the last one: the other checkpoint and the undo-files lead there.
 */
#include "tests/crash/sim_disk.h"
#include "tests/unit/history/memory_store.h"
#include "tests/unit/history/piece.h"

#include <cstdio>
#include <set>

namespace {

enum { STROKES = 7, HEADER_BYTES = 512, STRIDE = 7 };

/* The files of a life of some strokes, two checkpoints, strokes behind them and an undo. */
struct small_store {
    std::map<std::string, std::vector<uint8_t>> files;
    std::set<uint64_t> ever = {0};
    uint64_t last = 0, sequence = 0;

    small_store()
    {
        memory_store m;
        seeded chance{11};
        piece p(m.port());
        EXPECT_EQ(p.opened, STATUS_OK);
        for (int n = 1; n <= STROKES; n++) {
            EXPECT_EQ(p.stretch(piece_stroke_random(chance, 40), false), STATUS_OK);
            ever.insert(p.digest());
            EXPECT_EQ(p.stroke(piece_stroke_numbered(n)), STATUS_OK);
            ever.insert(p.digest());
            if (n == 2 || n == 4) {
                EXPECT_EQ(p.field(), STATUS_OK);
            }
        }
        EXPECT_EQ(p.undo(), STATUS_OK);
        EXPECT_EQ(p.h.kept, p.h.sequence);
        last = p.digest();
        sequence = p.h.sequence;
        files = m.files;
        EXPECT_TRUE(files.count(HISTORY_FIELD_NAME) && files.count(HISTORY_FIELD_BEFORE_NAME));
        EXPECT_TRUE(files.count("undo-0003"));
    }
};

/* Opens the store with one file in place of the sound one, and works on. */
void expect_a_state(const small_store &store, const std::string &name, std::vector<uint8_t> bytes)
{
    const bool checkpoint = name.rfind("field", 0) == 0;
    memory_store m;
    m.files = store.files;
    m.files[name] = std::move(bytes);
    piece p(m.port());
    ASSERT_EQ(p.opened, STATUS_OK);
    ASSERT_TRUE(clay_is_valid(&p.c));
    const uint64_t digest = p.digest();
    ASSERT_EQ(digest, p.h.digest);
    ASSERT_TRUE(store.ever.count(digest));
    if (checkpoint) {
        ASSERT_EQ(digest, store.last);
        ASSERT_EQ(p.h.sequence, store.sequence);
    }
    ASSERT_EQ(p.stroke(piece_stroke_numbered(STROKES + 1)), STATUS_OK);
    ASSERT_EQ(p.undo(), STATUS_OK);
    ASSERT_EQ(p.digest(), digest);
    ASSERT_EQ(m.misuse, "");
}

TEST(truncation, every_file_at_every_byte)
{
    const small_store store;
    uint64_t cuts = 0;
    for (const auto &[name, bytes] : store.files)
        for (size_t n = 0; n < bytes.size(); n += SIM_DISK_THIN, cuts++) {
            SCOPED_TRACE(name + " cut at byte " + std::to_string(n));
            ASSERT_NO_FATAL_FAILURE(
                expect_a_state(store, name, {bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(n)}));
        }
    std::printf("%llu cuts\n", static_cast<unsigned long long>(cuts));
    RecordProperty("cuts", std::to_string(cuts));
}

TEST(truncation, a_byte_flipped)
{
    const small_store store;
    uint64_t flips = 0;
    for (const auto &[name, bytes] : store.files)
        for (size_t n = 0, step = 0; n < bytes.size(); n += step * SIM_DISK_THIN) {
            step = n % RECORD_BLOCK_BYTES < HEADER_BYTES ? 1 : STRIDE;
            std::vector<uint8_t> damaged = bytes;
            damaged[n] ^= static_cast<uint8_t>(1u << n % 8);
            flips++;
            SCOPED_TRACE(name + ", bit " + std::to_string(n % 8) + " of byte " + std::to_string(n));
            ASSERT_NO_FATAL_FAILURE(expect_a_state(store, name, std::move(damaged)));
        }
    std::printf("%llu flips\n", static_cast<unsigned long long>(flips));
    RecordProperty("flips", std::to_string(flips));
}

/* H3: the checkpoint before leads to where the clay stands too, also where undo-files are written anew all the time. */
TEST(truncation, a_damaged_checkpoint_above_a_small_ring)
{
    for (uint64_t seed = 1; seed <= 150; seed++) {
        seeded chance{seed};
        memory_store m;
        const piece_ring limits = {static_cast<uint32_t>(1 + seed % 3), RING_FILE_BYTES_MIN,
                                   RING_FILE_BYTES_MIN * (3 + seed % 4)};
        piece p(m.port(), limits);
        ASSERT_EQ(p.opened, STATUS_OK);
        for (int n = 0; n < 60; n++) {
            SCOPED_TRACE("seed " + std::to_string(seed) + " step " + std::to_string(n));
            const double die = seeded_real(chance, 0, 1);
            status s = STATUS_OK;
            if (die < 0.5) {
                s = p.stroke(piece_stroke_random(chance, 40));
            } else if (die < 0.75) {
                s = p.go(static_cast<history_way>(seeded_int(chance, 0, 3)),
                         static_cast<uint64_t>(seeded_int(chance, 0, n)));
            } else {
                s = p.field();
            }
            ASSERT_TRUE(s == STATUS_OK || s == STATUS_HISTORY_ENDS) << s;
            if (!m.files.count(HISTORY_FIELD_BEFORE_NAME)) {
                continue;
            }
            memory_store damaged;
            damaged.files = m.files;
            damaged.files[HISTORY_FIELD_NAME].resize(CHECKPOINT_HEADER_BYTES / 2);
            piece q(damaged.port(), limits);
            ASSERT_EQ(q.opened, STATUS_OK);
            ASSERT_EQ(q.h.sequence, p.h.sequence) << q.finding.text;
            ASSERT_EQ(q.digest(), p.digest());
        }
    }
}

/* What cannot be read for a while, and is there again later, changes nothing of what was kept meanwhile. */
TEST(truncation, a_file_that_cannot_be_read_for_a_while)
{
    const small_store store;
    for (const auto &[name, bytes] : store.files) {
        SCOPED_TRACE(name);
        memory_store m;
        m.files = store.files;
        m.unreadable = name;
        uint64_t digest, sequence;
        {
            piece p(m.port());
            ASSERT_EQ(p.opened, STATUS_OK);
            for (int n = 0; n < 3; n++)
                ASSERT_EQ(p.stroke(piece_stroke_numbered(STROKES + 1 + n)), STATUS_OK);
            digest = p.digest();
            sequence = p.h.sequence;
        }
        m.unreadable.clear();
        {
            piece p(m.port());
            ASSERT_EQ(p.opened, STATUS_OK);
            ASSERT_EQ(p.h.sequence, sequence);
            ASSERT_EQ(p.digest(), digest);
        }
    }
}

/* A checkpoint that cannot be read does not take the place of the one before, which can. */
TEST(truncation, an_unread_checkpoint_is_set_aside)
{
    const small_store store;
    memory_store m;
    m.files = store.files;
    m.unreadable = HISTORY_FIELD_NAME;
    piece p(m.port());
    ASSERT_EQ(p.opened, STATUS_OK);
    ASSERT_EQ(p.digest(), store.last);
    m.unreadable.clear();
    ASSERT_EQ(p.field(), STATUS_OK);
    EXPECT_EQ(m.files[HISTORY_FIELD_BEFORE_NAME], store.files.at(HISTORY_FIELD_BEFORE_NAME));
    EXPECT_EQ(m.files[HISTORY_FIELD_NAME ".set-aside"], store.files.at(HISTORY_FIELD_NAME));
}

} // namespace
