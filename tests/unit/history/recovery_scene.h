/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A small store with strokes behind and before the cursor, and the digest of every state there was;
 *          what became of its files.
 */
#ifndef GLAISE_UNIT_HISTORY_RECOVERY_SCENE_H
#define GLAISE_UNIT_HISTORY_RECOVERY_SCENE_H

#include "history/recovery.h"

#include "tests/unit/history/memory_store.h"
#include "tests/unit/history/piece.h"

#include <algorithm>
#include <functional>
#include <set>

inline constexpr uint64_t RECOVERY_SCENE_FILE_BYTES = RING_FILE_BYTES_MIN;

inline piece_ring recovery_scene_ring(uint32_t strokes)
{
    return {strokes, RECOVERY_SCENE_FILE_BYTES, RECOVERY_SCENE_FILE_BYTES * 1000};
}

/* Nine strokes of which the cursor is after the seventh; fields after the strokes asked for. */
struct recovery_scene {
    memory_store m;
    std::vector<uint64_t> digests; /* after stroke n */
    std::map<uint64_t, std::string> files; /* of stroke n */
    uint32_t strokes;

    explicit recovery_scene(std::set<int> fields = {4, 6}, uint32_t asked = 100) : strokes(asked)
    {
        piece p(m.port(), recovery_scene_ring(strokes));
        digests.push_back(p.digest());
        for (int n = 1; n <= 9; n++) {
            EXPECT_EQ(p.stroke(piece_stroke_numbered(n, 2)), STATUS_OK);
            digests.push_back(p.digest());
            if (fields.count(n)) {
                EXPECT_EQ(p.field(), STATUS_OK);
            }
        }
        for (uint64_t n = 1; n <= 9; n++)
            files[n] = ring_name_of(ring_next_file(&p.h.ring, n, 0)).text;
        for (int n = 0; n < 2; n++)
            EXPECT_EQ(p.undo(), STATUS_OK);
        EXPECT_EQ(m.misuse, "");
    }
    bool existed(uint64_t digest) const { return std::count(digests.begin(), digests.end(), digest) > 0; }
    void turn(uint64_t stroke, size_t at) { m.files.at(files.at(stroke)).at(at) ^= 0x10; }
};

/* Places in a record. */
enum { RECOVERY_SCENE_IN_HEADER = 100, RECOVERY_SCENE_IN_BRICKS = RECORD_HEADER_BYTES + 20 };

inline memory_store recovery_scene_after(const memory_store &m, const std::function<void(memory_store &)> &done)
{
    memory_store copy;
    copy.files = m.files;
    done(copy);
    return copy;
}

/* Each file is there as it was, or set aside. */
inline void recovery_scene_expect_kept(const memory_store &before, const memory_store &m, const std::string &what)
{
    for (const auto &[name, bytes] : before.files) {
        const auto at = m.files.find(name), aside = m.files.find(name + ".set-aside");
        ASSERT_TRUE((at != m.files.end() && at->second == bytes) || (aside != m.files.end() && aside->second == bytes))
            << what << ": " << name;
    }
}

#endif
