/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: replacing is atomic and obeys the store's rules at every failure; what is set aside is never lost.
 * Method: a memory store that fails at each call in turn, before and after the work. */
#include "history/whole_file.h"

#include "tests/unit/history/memory_store.h"

#include <gtest/gtest.h>

namespace {

std::vector<uint8_t> bytes_of(const std::string &text) { return {text.begin(), text.end()}; }

TEST(whole_file, reads_all_of_it_even_in_pieces)
{
    memory_store m;
    m.files["field"].resize(100000);
    for (size_t n = 0; n < 100000; n++)
        m.files["field"][n] = static_cast<uint8_t>(n * 7 >> 3);
    const byte_store store = m.port();
    for (size_t at_most : {SIZE_MAX, size_t{3000}}) {
        m.read_at_most = at_most;
        byte_buffer b = {};
        bool exists = false;
        ASSERT_EQ(whole_file_read(&store, "field", &b, &exists), STATUS_OK);
        EXPECT_TRUE(exists);
        EXPECT_EQ(std::vector<uint8_t>(b.bytes, b.bytes + b.size), m.files["field"]);
        byte_buffer_finish(&b);
    }
}

TEST(whole_file, absence_is_a_state)
{
    memory_store m;
    const byte_store store = m.port();
    byte_buffer b = {};
    bool exists = true;
    EXPECT_EQ(whole_file_read(&store, "field", &b, &exists), STATUS_OK);
    EXPECT_FALSE(exists);
    EXPECT_EQ(b.size, 0u);
    EXPECT_EQ(whole_file_set_aside(&store, "field"), STATUS_OK);
    EXPECT_TRUE(m.files.empty());
    byte_buffer_finish(&b);
}

TEST(whole_file, replaces_or_keeps_at_every_failure)
{
    for (bool having_done : {false, true}) {
        int refused = 0;
        for (uint64_t fail_at = 1; fail_at <= 4; fail_at++) {
            memory_store m;
            const byte_store store = m.port();
            m.files["cursor"] = bytes_of("old");
            m.files["cursor.new"] = bytes_of("left over from before, and longer");
            m.fail_at = fail_at;
            m.fail_having_done = having_done;
            refused += whole_file_replace(&store, "cursor.new", "cursor", "new", 3) == STATUS_IO;
            EXPECT_TRUE(m.files["cursor"] == bytes_of("old") || (having_done && fail_at == 4));
            ASSERT_EQ(whole_file_replace(&store, "cursor.new", "cursor", "newest", 6), STATUS_OK);
            EXPECT_EQ(m.files["cursor"], bytes_of("newest"));
            EXPECT_EQ(m.files.size(), 1u);
            EXPECT_EQ(m.misuse, "");
        }
        EXPECT_EQ(refused, 4);
    }
}

TEST(whole_file, every_one_set_aside_finds_a_name_of_its_own)
{
    memory_store m;
    const byte_store store = m.port();
    for (const char *text : {"a", "b", "c"}) {
        m.files["undo-0001"] = bytes_of(text);
        ASSERT_EQ(whole_file_set_aside(&store, "undo-0001"), STATUS_OK);
    }
    const std::map<std::string, std::vector<uint8_t>> expected = {{"undo-0001.set-aside", bytes_of("a")},
                                                                  {"undo-0001.set-aside-2", bytes_of("b")},
                                                                  {"undo-0001.set-aside-3", bytes_of("c")}};
    EXPECT_EQ(m.files, expected);
    EXPECT_EQ(m.misuse, "");
}

} // namespace
