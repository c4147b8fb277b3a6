/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a file is read whole from any place, however little the store gives at a time; what is set aside is never lost.
 * Method: a memory store that gives little, or nothing. */
#include "history/stored_file.h"

#include "tests/unit/history/memory_store.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

std::vector<uint8_t> bytes_of(const std::string &text) { return {text.begin(), text.end()}; }

TEST(stored_file, reads_from_any_place_even_in_pieces)
{
    memory_store m;
    m.files["field"].resize(100000);
    for (size_t n = 0; n < 100000; n++)
        m.files["field"][n] = static_cast<uint8_t>(n * 7 >> 3);
    const byte_store store = m.port();
    const stored_file f = {&store, "field"};
    for (const size_t at_most : {SIZE_MAX, size_t{3000}})
        for (const size_t from : {size_t{0}, size_t{777}, size_t{99990}, size_t{100000}, size_t{200000}}) {
            m.read_at_most = at_most;
            std::vector<uint8_t> bytes(50000);
            size_t got = 1;
            ASSERT_EQ(stored_file_read(&f, from, bytes.data(), bytes.size(), &got), STATUS_OK);
            const size_t there = std::min(bytes.size(), 100000 - std::min<size_t>(from, 100000));
            ASSERT_EQ(got, there);
            EXPECT_TRUE(std::equal(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(got),
                                   m.files["field"].begin() + static_cast<ptrdiff_t>(std::min<size_t>(from, 100000))));
        }
}

TEST(stored_file, what_cannot_be_read_is_answered)
{
    memory_store m;
    m.files["field"].resize(10);
    m.unreadable = "field";
    const byte_store store = m.port();
    stored_file f = {&store, "field"};
    uint8_t byte;
    size_t got = 1;
    EXPECT_EQ(stored_file_get(&f, 0, &byte, 1, &got), STATUS_IO);
    EXPECT_EQ(got, 0u);
}

TEST(stored_file, absence_is_a_state)
{
    memory_store m;
    const byte_store store = m.port();
    const stored_file f = {&store, "field"};
    uint8_t byte;
    size_t got = 1;
    EXPECT_EQ(stored_file_read(&f, 0, &byte, 1, &got), STATUS_OK);
    EXPECT_EQ(got, 0u);
    EXPECT_EQ(stored_file_set_aside(&f), STATUS_OK);
    EXPECT_TRUE(m.files.empty());
}

TEST(stored_file, every_one_set_aside_finds_a_name_of_its_own)
{
    memory_store m;
    const byte_store store = m.port();
    const stored_file f = {&store, "undo-0001"};
    for (const char *text : {"a", "b", "c"}) {
        m.files["undo-0001"] = bytes_of(text);
        ASSERT_EQ(stored_file_set_aside(&f), STATUS_OK);
    }
    const std::map<std::string, std::vector<uint8_t>> expected = {{"undo-0001.set-aside", bytes_of("a")},
                                                                  {"undo-0001.set-aside-2", bytes_of("b")},
                                                                  {"undo-0001.set-aside-3", bytes_of("c")}};
    EXPECT_EQ(m.files, expected);
    EXPECT_EQ(m.misuse, "");
}

} // namespace
