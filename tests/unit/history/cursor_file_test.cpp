/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the cursor comes back as written; damage of any bit or length, and numbers that cannot be, are refused.
 * Method: one file through every flip and cut; files with impossible numbers under a sound checksum. */
#include "history/cursor_file.h"

#include "history/byte_order.h"
#include "tests/unit/history/memory_store.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

constexpr cursor_file sound = {.oldest = 3, .cursor = 5, .newest = 9, .dab = 77, .step_mm = 0.25, .ring = 8};

status read_back(memory_store &m, cursor_file *out)
{
    const byte_store store = m.port();
    bool exists;
    preamble_trouble why;
    const status s = cursor_file_read(out, &store, &exists, &why);
    EXPECT_EQ(exists, m.files.count("cursor") == 1);
    return s;
}

memory_store written(const cursor_file &f)
{
    memory_store m;
    const byte_store store = m.port();
    EXPECT_EQ(cursor_file_write(&f, &store), STATUS_OK);
    return m;
}

TEST(cursor_file, comes_back)
{
    memory_store m = written(sound);
    cursor_file f = {};
    ASSERT_EQ(read_back(m, &f), STATUS_OK);
    EXPECT_EQ(f.oldest, sound.oldest);
    EXPECT_EQ(f.cursor, sound.cursor);
    EXPECT_EQ(f.newest, sound.newest);
    EXPECT_EQ(f.dab, sound.dab);
    EXPECT_EQ(f.step_mm, sound.step_mm);
    EXPECT_EQ(f.ring, sound.ring);
    EXPECT_EQ(m.files["cursor"].size(), static_cast<size_t>(CURSOR_FILE_BYTES));
    EXPECT_EQ(m.misuse, "");
}

TEST(cursor_file, absence_is_a_state)
{
    memory_store m;
    cursor_file f = {};
    EXPECT_EQ(read_back(m, &f), STATUS_OK);
}

TEST(cursor_file, flips_and_cuts_and_tails_are_refused)
{
    const memory_store good = written(sound);
    const std::vector<uint8_t> bytes = good.files.at("cursor");
    cursor_file f = {};
    for (size_t bit = 0; bit < bytes.size() * 8; bit++) {
        memory_store m = good;
        m.files["cursor"][bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
        EXPECT_EQ(read_back(m, &f), STATUS_CORRUPT) << bit;
    }
    for (size_t length = 0; length < bytes.size(); length++) {
        memory_store m = good;
        m.files["cursor"].resize(length);
        EXPECT_EQ(read_back(m, &f), STATUS_CORRUPT) << length;
    }
    memory_store m = good;
    m.files["cursor"].push_back(0);
    EXPECT_EQ(read_back(m, &f), STATUS_CORRUPT);
}

TEST(cursor_file, impossible_numbers_are_refused)
{
    std::vector<cursor_file> bad(9, sound);
    bad[0].oldest = 0;
    bad[1].oldest = 7;
    bad[2].newest = 4;
    bad[3].newest = 11;
    bad[4].ring = 0;
    bad[5].ring = 10000;
    bad[6].step_mm = 0;
    bad[7].step_mm = std::numeric_limits<double>::quiet_NaN();
    bad[8].oldest = bad[8].cursor = bad[8].newest = UINT64_MAX - 1;
    cursor_file f = {};
    for (size_t n = 0; n < bad.size(); n++) {
        memory_store m = written(bad[n]);
        EXPECT_EQ(read_back(m, &f), STATUS_CORRUPT) << n;
    }
    std::vector<cursor_file> edges(3, sound);
    edges[0].oldest = 6;
    edges[1].newest = 10;
    edges[2].newest = 5;
    for (size_t n = 0; n < edges.size(); n++) {
        memory_store m = written(edges[n]);
        EXPECT_EQ(read_back(m, &f), STATUS_OK) << n;
    }
}

} // namespace
