/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: undo-files are found by their names, made whole, written one record behind the other and never beyond their
 *       end; what is read from them is a record or a refusal.
 * Method: a store in memory that fails at each call in turn; files looked at byte by byte; the same files read in
 *         pieces of a few bytes. */
#include "history/ring.h"

#include "tests/unit/history/memory_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace {

constexpr uint64_t BLOCK = RECORD_BLOCK_BYTES, FILE_BYTES = RING_FILE_BYTES_MIN;

struct rings {
    memory_store m;
    byte_store store;
    ring r = {};

    rings() { open(); }
    ~rings() { ring_close(&r); }
    rings(const rings &) = delete;
    rings &operator=(const rings &) = delete;
    void open()
    {
        ring_close(&r);
        store = m.port();
        ASSERT_EQ(ring_open(&r, &store), STATUS_OK);
    }
    uint32_t make(uint64_t bytes = FILE_BYTES)
    {
        uint32_t file = RING_NONE;
        EXPECT_EQ(ring_make(&r, bytes, &file), STATUS_OK);
        return file;
    }
};

/* A record of one brick that differs in so many corners. */
struct made {
    record r = {};
    std::vector<uint8_t> bytes;

    explicit made(uint64_t sequence, uint64_t stroke = 1, int corners = 1)
    {
        static brick_page page;
        page = {};
        for (int n = 0; n < corners; n++) {
            page.potential[n] = 1;
            page.rgba[n] = static_cast<uint32_t>(sequence);
        }
        bytes.resize(size_t{RECORD_HEADER_BYTES} + RECORD_BRICK_BYTES_MAX + 64);
        r.sequence = sequence;
        r.stroke = r.cursor = r.tip = stroke;
        r.parent = stroke - 1;
        r.bricks = 1;
        r.marks = RECORD_WHOLE;
        r.digest_after = 5;
        r.dab = 1;
        r.step_mm = 0.5;
        r.bytes = record_put_brick(&bytes[RECORD_HEADER_BYTES], {1, 2, 3}, nullptr, &page, LANES_PLAIN);
        r.stored = r.bytes;
        bytes.resize(RECORD_HEADER_BYTES + r.bytes);
    }
};

status write(rings &k, uint32_t file, made &what) { return ring_write(&k.r, file, &what.r, what.bytes.data()); }

/* --- the files there are --- */

TEST(ring, names_have_four_digits)
{
    EXPECT_STREQ(ring_name_of(0).text, "undo-0000");
    EXPECT_STREQ(ring_name_of(17).text, "undo-0017");
    EXPECT_STREQ(ring_name_of(RING_FILES_MAX - 1).text, "undo-9999");
}

TEST(ring, finds_its_own_files_and_no_others)
{
    rings k;
    for (const char *name : {"field", "field.before", "undo-", "undo-12", "undo-00001", "undo-000a",
                             "undo-0003.set-aside", "undo_0004", "xundo-0005", "cursor", "undo--001"})
        k.m.files[name].resize(FILE_BYTES);
    k.m.files["undo-0002"].resize(FILE_BYTES);
    k.m.files["undo-0070"].resize(100);
    k.open();
    EXPECT_EQ(k.r.count, 71u);
    EXPECT_EQ(k.r.bytes, FILE_BYTES + 100u);
    EXPECT_EQ(k.r.current, RING_NONE);
    for (uint32_t n = 0; n < k.r.count; n++) {
        EXPECT_EQ(k.r.files[n].bytes, n == 2 ? FILE_BYTES : n == 70 ? uint64_t{100} : uint64_t{0}) << n;
        EXPECT_EQ(k.r.files[n].free, n == 2 || n == 70);
        EXPECT_EQ(k.r.files[n].use, 0u);
    }
    EXPECT_EQ(k.m.misuse, "");
}

TEST(ring, store_that_cannot_be_listed_is_told)
{
    for (uint64_t nth : {1, 2}) { /* the list; the size of the one file */
        memory_store m;
        m.files["undo-0000"].resize(FILE_BYTES);
        m.fail_at = nth;
        const byte_store store = m.port();
        ring r;
        EXPECT_EQ(ring_open(&r, &store), STATUS_IO);
        ring_close(&r);
    }
}

TEST(ring, makes_the_lowest_that_is_missing_whole_and_synced)
{
    rings k;
    k.m.files["undo-0001"].resize(FILE_BYTES);
    k.open();
    EXPECT_EQ(k.make(), 0u);
    EXPECT_EQ(k.make(FILE_BYTES + BLOCK), 2u);
    EXPECT_EQ(k.m.files["undo-0000"], std::vector<uint8_t>(FILE_BYTES));
    EXPECT_EQ(k.m.files["undo-0002"], std::vector<uint8_t>(FILE_BYTES + BLOCK));
    EXPECT_TRUE(k.m.unsynced.empty());
    EXPECT_EQ(k.r.bytes, 3u * FILE_BYTES + BLOCK);
    ASSERT_EQ(ring_remove(&k.r, 1), STATUS_OK);
    EXPECT_EQ(k.m.files.count("undo-0001"), 0u);
    EXPECT_EQ(k.r.bytes, 2u * FILE_BYTES + BLOCK);
    EXPECT_EQ(k.make(), 1u);
    EXPECT_EQ(k.m.misuse, "");
}

TEST(ring, what_cannot_be_made_leaves_nothing)
{
    for (uint64_t nth : {1, 2}) { /* the write, the sync */
        rings k;
        k.m.fail_at = k.m.calls + nth;
        uint32_t file = 77;
        EXPECT_EQ(ring_make(&k.r, FILE_BYTES, &file), STATUS_IO);
        EXPECT_EQ(file, 77u);
        EXPECT_TRUE(k.m.files.empty());
        EXPECT_EQ(k.r.bytes, 0u);
        EXPECT_EQ(ring_free_file(&k.r, 1), RING_NONE);
        k.m.fail_at = 0;
        EXPECT_EQ(k.make(), 0u);
        EXPECT_EQ(k.m.misuse, "");
    }
    rings k;
    uint32_t file = 77;
    k.m.most_bytes = FILE_BYTES;
    EXPECT_EQ(k.make(), 0u);
    EXPECT_EQ(ring_make(&k.r, FILE_BYTES, &file), STATUS_NO_SPACE);
    EXPECT_EQ(k.m.files.size(), 1u);
}

TEST(ring, there_are_no_more_names_than_ten_thousand)
{
    rings k;
    for (uint32_t n = 0; n < RING_FILES_MAX; n++)
        k.m.files[ring_name_of(n).text].resize(1);
    k.open();
    uint32_t file = 77;
    EXPECT_EQ(ring_make(&k.r, FILE_BYTES, &file), STATUS_NO_SPACE);
    ASSERT_EQ(ring_remove(&k.r, 9999), STATUS_OK);
    EXPECT_EQ(k.make(), 9999u);
}

TEST(ring, failed_removal_keeps_the_file)
{
    rings k;
    k.make();
    k.m.fail_at = k.m.calls + 1;
    EXPECT_EQ(ring_remove(&k.r, 0), STATUS_IO);
    EXPECT_EQ(k.r.bytes, FILE_BYTES);
    EXPECT_EQ(ring_free_file(&k.r, 1), 0u);
}

/* --- whose turn it is --- */

TEST(ring, free_file_is_the_one_begun_longest_ago)
{
    rings k;
    for (int n = 0; n < 4; n++)
        k.make();
    for (uint32_t file : {2u, 0u, 3u, 1u})
        ring_begin(&k.r, file, 1);
    EXPECT_EQ(ring_free_file(&k.r, 1), RING_NONE) << "all are in use";
    for (uint32_t n = 0; n < 4; n++)
        k.r.files[n].free = true;
    EXPECT_EQ(ring_free_file(&k.r, 1), 2u);
    k.r.files[2].spoilt = true;
    EXPECT_EQ(ring_free_file(&k.r, 1), 0u);
    EXPECT_EQ(ring_free_file(&k.r, FILE_BYTES), 0u);
    EXPECT_EQ(ring_free_file(&k.r, FILE_BYTES + 1), RING_NONE);
    k.r.files[0].bytes = FILE_BYTES - 1; /* cut short from outside */
    EXPECT_EQ(ring_free_file(&k.r, 1), 3u);
}

TEST(ring, beginning_gives_the_next_use_and_an_empty_file)
{
    rings k;
    k.make();
    k.make();
    ring_begin(&k.r, 1, 5);
    made one(1, 5);
    ASSERT_EQ(write(k, 1, one), STATUS_OK);
    EXPECT_EQ(k.r.current, 1u);
    EXPECT_EQ(k.r.files[1].use, 1u);
    EXPECT_EQ(k.r.files[1].end, BLOCK);
    ring_begin(&k.r, 0, 6);
    ring_begin(&k.r, 1, 7);
    EXPECT_EQ(k.r.current, 1u);
    EXPECT_EQ(k.r.files[0].use, 2u);
    EXPECT_EQ(k.r.files[1].use, 3u);
    EXPECT_EQ(k.r.files[1].stroke, 7u);
    EXPECT_EQ(k.r.files[1].end, 0u);
    EXPECT_GT(k.r.files[1].first, k.r.files[1].last);
    EXPECT_EQ(k.r.files[1].bytes, FILE_BYTES);
    EXPECT_FALSE(k.r.files[1].free);
}

TEST(ring, file_set_aside_is_current_no_more)
{
    rings k;
    k.make();
    k.make();
    ring_begin(&k.r, 1, 5);
    ASSERT_EQ(ring_set_aside(&k.r, 0), STATUS_OK);
    EXPECT_EQ(k.r.current, 1u);
    ASSERT_EQ(ring_set_aside(&k.r, 1), STATUS_OK);
    EXPECT_EQ(k.r.current, RING_NONE);
    EXPECT_EQ(k.r.bytes, 0u);
    EXPECT_EQ(k.m.files.size(), 2u);
    EXPECT_EQ(k.m.files.count(std::string(ring_name_of(1).text) + ".set-aside"), 1u);
}

/* --- writing and reading --- */

TEST(ring, records_lie_one_behind_the_other_on_blocks_of_their_own)
{
    rings k;
    k.make();
    ring_begin(&k.r, 0, 1);
    std::vector<uint8_t> expected(FILE_BYTES);
    uint64_t at = 0;
    for (uint64_t n = 1; n <= 3; n++) {
        made one(n, 1, n == 2 ? 512 : 3); /* the second takes two blocks */
        ASSERT_EQ(write(k, 0, one), STATUS_OK);
        EXPECT_EQ(one.r.use, 1u);
        std::copy(one.bytes.begin(), one.bytes.end(), expected.begin() + static_cast<std::ptrdiff_t>(at));
        at += n == 2 ? 2 * BLOCK : BLOCK;
        EXPECT_EQ(k.r.files[0].end, at);
        EXPECT_EQ(k.r.files[0].first, 1u);
        EXPECT_EQ(k.r.files[0].last, n);
    }
    EXPECT_EQ(k.m.files["undo-0000"], expected);
    EXPECT_EQ(k.m.unsynced.size(), 1u) << "syncing is the caller's";
}

TEST(ring, what_is_written_is_read_however_small_the_pieces)
{
    rings k;
    k.make();
    ring_begin(&k.r, 0, 1);
    made one(1, 1, 512), two(2, 1, 7);
    ASSERT_EQ(write(k, 0, one), STATUS_OK);
    ASSERT_EQ(write(k, 0, two), STATUS_OK);
    for (size_t at_most : {SIZE_MAX, size_t{1}, size_t{100}}) {
        k.m.read_at_most = at_most;
        byte_buffer b = {};
        record r;
        ASSERT_EQ(ring_read_header(&k.r, 0, 2 * BLOCK, &r), STATUS_OK);
        EXPECT_EQ(r.sequence, 2u);
        EXPECT_EQ(r.seal, two.r.seal);
        ASSERT_EQ(ring_read_bricks(&k.r, 0, 2 * BLOCK, &r, &b), STATUS_OK);
        EXPECT_EQ(std::vector<uint8_t>(b.bytes, b.bytes + b.size),
                  std::vector<uint8_t>(two.bytes.begin() + RECORD_HEADER_BYTES, two.bytes.end()));
        byte_buffer_finish(&b);
    }
}

TEST(ring, room_is_up_to_the_last_byte)
{
    rings k;
    k.make();
    ring_begin(&k.r, 0, 1);
    const uint64_t all = FILE_BYTES - RECORD_HEADER_BYTES;
    EXPECT_TRUE(ring_has_room(&k.r, 0, all));
    EXPECT_FALSE(ring_has_room(&k.r, 0, all + 1));
    for (uint64_t n = 1; n <= FILE_BYTES / BLOCK; n++) {
        EXPECT_TRUE(ring_has_room(&k.r, 0, 88));
        made one(n);
        ASSERT_EQ(write(k, 0, one), STATUS_OK);
    }
    EXPECT_FALSE(ring_has_room(&k.r, 0, 0)) << "full";
    EXPECT_EQ(k.m.files["undo-0000"].size(), FILE_BYTES);
    ring_begin(&k.r, 0, 2);
    EXPECT_TRUE(ring_has_room(&k.r, 0, all));
    k.r.files[0].spoilt = true;
    EXPECT_FALSE(ring_has_room(&k.r, 0, 0));
}

TEST(ring, failed_write_does_not_count)
{
    rings k;
    k.make();
    ring_begin(&k.r, 0, 1);
    made one(1);
    ASSERT_EQ(write(k, 0, one), STATUS_OK);
    k.m.fail_at = k.m.calls + 1;
    made two(2);
    EXPECT_EQ(write(k, 0, two), STATUS_IO);
    EXPECT_EQ(k.r.files[0].last, 1u);
    EXPECT_EQ(k.r.files[0].end, BLOCK);
}

TEST(ring, places_without_a_record_are_refused)
{
    rings k;
    k.make();
    ring_begin(&k.r, 0, 1);
    made one(1);
    record r;
    ASSERT_EQ(write(k, 0, one), STATUS_OK);
    EXPECT_EQ(ring_read_header(&k.r, 0, BLOCK, &r), STATUS_CORRUPT) << "zeros";
    EXPECT_EQ(ring_read_header(&k.r, 0, 16, &r), STATUS_CORRUPT);
    EXPECT_EQ(ring_read_header(&k.r, 0, FILE_BYTES, &r), STATUS_CORRUPT) << "the end";
    k.m.unreadable = "undo-0000";
    EXPECT_EQ(ring_read_header(&k.r, 0, 0, &r), STATUS_IO);
}

TEST(ring, record_that_reaches_beyond_its_file_is_refused)
{
    rings k;
    k.make();
    ring_begin(&k.r, 0, 1);
    made one(1, 1, 512);
    record r;
    ASSERT_EQ(write(k, 0, one), STATUS_OK);
    std::vector<uint8_t> &f = k.m.files["undo-0000"];
    std::copy(one.bytes.begin(), one.bytes.begin() + 4096, f.end() - 4096);
    EXPECT_EQ(ring_read_header(&k.r, 0, 0, &r), STATUS_OK);
    EXPECT_EQ(ring_read_header(&k.r, 0, FILE_BYTES - BLOCK, &r), STATUS_CORRUPT);
    std::copy(one.bytes.begin(), one.bytes.end(), f.end() - 8192);
    EXPECT_EQ(ring_read_header(&k.r, 0, FILE_BYTES - 2 * BLOCK, &r), STATUS_OK) << "it just fits";
    /* Sound, and so large that nobody could hold it: 2^32 - 1 bricks. */
    made vast(1);
    vast.r.bricks = UINT32_MAX;
    vast.r.bytes = vast.r.stored = 88;
    record_seal(&vast.r, vast.bytes.data());
    for (size_t n = 0; n < 8; n++)
        vast.bytes[120 + n] = vast.bytes[136 + n] = static_cast<uint8_t>(uint64_t{UINT32_MAX} * 88 >> 8 * n);
    const preamble p = {"glring\r\n", RECORD_VERSION, RECORD_HEADER_BYTES};
    preamble_seal(&p, vast.bytes.data());
    std::copy(vast.bytes.begin(), vast.bytes.end(), f.begin());
    EXPECT_EQ(ring_read_header(&k.r, 0, 0, &r), STATUS_CORRUPT);
}

TEST(ring, bricks_that_are_not_what_the_header_says_are_refused)
{
    rings k;
    k.make();
    ring_begin(&k.r, 0, 1);
    made one(1, 1, 200);
    record r;
    byte_buffer b = {};
    ASSERT_EQ(write(k, 0, one), STATUS_OK);
    ASSERT_EQ(ring_read_header(&k.r, 0, 0, &r), STATUS_OK);
    std::vector<uint8_t> &f = k.m.files["undo-0000"];
    for (size_t at = RECORD_HEADER_BYTES; at < one.bytes.size(); at += 37) {
        f[at] ^= 4;
        EXPECT_EQ(ring_read_bricks(&k.r, 0, 0, &r, &b), STATUS_CORRUPT) << at;
        f[at] ^= 4;
    }
    EXPECT_EQ(ring_read_bricks(&k.r, 0, 0, &r, &b), STATUS_OK);
    f.resize(one.bytes.size() - 1);
    EXPECT_EQ(ring_read_bricks(&k.r, 0, 0, &r, &b), STATUS_CORRUPT) << "cut short meanwhile";
    k.m.unreadable = "undo-0000";
    EXPECT_EQ(ring_read_bricks(&k.r, 0, 0, &r, &b), STATUS_IO);
    byte_buffer_finish(&b);
}

TEST(ring, a_later_record_is_told_from_damage)
{
    rings k;
    k.make();
    ring_begin(&k.r, 0, 1);
    made one(1);
    record r;
    ASSERT_EQ(write(k, 0, one), STATUS_OK);
    const preamble later = {"glring\r\n", RECORD_VERSION + 1, RECORD_HEADER_BYTES};
    preamble_seal(&later, k.m.files["undo-0000"].data());
    EXPECT_EQ(ring_read_header(&k.r, 0, 0, &r), STATUS_NEWER);
}

TEST(ring, files_of_a_stroke_come_in_the_order_in_which_they_were_begun)
{
    rings k;
    for (int n = 0; n < 5; n++)
        k.make();
    uint64_t sequence = 0;
    for (uint32_t file : {3u, 1u, 4u, 0u}) {
        ring_begin(&k.r, file, file == 4 ? 8 : 7);
        made one(++sequence, 7);
        ASSERT_EQ(write(k, file, one), STATUS_OK);
    }
    ring_begin(&k.r, 2, 7); /* begun, nothing written */
    std::vector<uint32_t> went;
    uint64_t use = 0;
    for (uint32_t file; (file = ring_next_file(&k.r, 7, use)) != RING_NONE; use = k.r.files[file].use)
        went.push_back(file);
    EXPECT_EQ(went, (std::vector<uint32_t>{3, 1, 0}));
    EXPECT_EQ(ring_next_file(&k.r, 9, 0), RING_NONE);
}

} // namespace
