/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: what a power cut leaves of a log of writes is what a disk may leave, and all of that.
 * Method: logs laid down byte by byte; many seeds, so that every fate is seen, and no other. */
#include "tests/vm/write_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace {

constexpr size_t SECTOR = WRITE_LOG_SECTOR_BYTES, DISK_BYTES = 64 * SECTOR;
enum { FLUSH = 1, PAST_CACHE = 2, DISCARD = 4 };

struct laid {
    uint64_t sector, sectors, flags;
    uint8_t filled;
};

void add(write_log_bytes *to, uint64_t n, size_t bytes)
{
    for (size_t b = 0; b < bytes; b++)
        to->push_back(static_cast<uint8_t>(n >> (8 * b)));
}

write_log_bytes bytes_of(const std::vector<laid> &entries, uint64_t told)
{
    write_log_bytes all;
    add(&all, 0x6a736677736872u, 8);
    add(&all, 1, 8);
    add(&all, told, 8);
    add(&all, SECTOR, 4);
    all.resize(SECTOR);
    for (const laid &e : entries) {
        const size_t begins = all.size();
        for (const uint64_t n : {e.sector, e.sectors, e.flags})
            add(&all, n, 8);
        all.resize(begins + SECTOR);
        if (!(e.flags & DISCARD))
            all.resize(all.size() + e.sectors * SECTOR, e.filled);
    }
    return all;
}

write_log log_of(const std::vector<laid> &entries)
{
    write_log log;
    EXPECT_EQ(write_log_parse(bytes_of(entries, entries.size()), &log), "");
    EXPECT_EQ(log.entries.size(), entries.size());
    return log;
}

/* One letter a sector: what it is filled with, '?' where it is not all the same. */
std::string seen(const write_log_bytes &disk, size_t from, size_t sectors)
{
    std::string text;
    for (size_t s = from; s < from + sectors; s++) {
        const auto begin = disk.begin() + static_cast<ptrdiff_t>(s * SECTOR);
        const bool same = std::all_of(begin, begin + SECTOR, [&](uint8_t b) { return b == *begin; });
        text += same ? static_cast<char>(*begin) : '?';
    }
    return text;
}

/* All that a cut behind an entry is seen to leave of some sectors, over many seeds. */
std::set<std::string> fates(const write_log &log, size_t entry, size_t from, size_t sectors)
{
    std::set<std::string> all;
    for (uint64_t seed = 1; seed <= 2000; seed++) {
        seeded chance{seed};
        write_log_fates counts;
        write_log_disk disk = {&log, write_log_bytes(DISK_BYTES, '.')};
        all.insert(seen(disk.after_cut(entry, chance, &counts), from, sectors));
    }
    return all;
}

using texts = std::set<std::string>;

TEST(write_log, a_write_is_kept_dropped_or_torn_until_a_flush)
{
    const write_log log = log_of({{20, 2, 0, 'a'}, {30, 1, 0, 'b'}, {0, 0, FLUSH, 0}, {20, 2, 0, 'c'}});
    EXPECT_EQ(log.flushes, 1u);
    EXPECT_EQ(fates(log, 0, 20, 2), (texts{"..", "a.", ".a", "aa"}));
    EXPECT_EQ(fates(log, 0, 30, 1), texts{"."}) << "a write of the future";
    EXPECT_EQ(fates(log, 1, 30, 1), (texts{".", "b"}));
    EXPECT_EQ(fates(log, 2, 20, 2), texts{"aa"});
    EXPECT_EQ(fates(log, 2, 30, 1), texts{"b"});
    EXPECT_EQ(fates(log, 3, 20, 2), (texts{"aa", "ca", "ac", "cc"}));
}

TEST(write_log, what_goes_past_the_cache_is_there)
{
    const write_log log = log_of({{20, 2, 0, 'a'}, {22, 2, PAST_CACHE, 'b'}});
    EXPECT_EQ(fates(log, 1, 22, 2), texts{"bb"});
    EXPECT_EQ(fates(log, 1, 20, 2).size(), 4u) << "it is no flush";
}

TEST(write_log, data_of_a_flush_comes_after_it)
{
    const write_log log = log_of({{20, 1, 0, 'a'}, {21, 1, FLUSH, 'b'}});
    EXPECT_EQ(fates(log, 1, 20, 2), (texts{"a.", "ab"}));
}

TEST(write_log, a_discard_empties_and_has_no_data)
{
    const write_log log = log_of({{20, 2, DISCARD, 0}, {22, 1, 0, 'b'}, {0, 0, FLUSH, 0}});
    EXPECT_EQ(fates(log, 2, 20, 3), texts{std::string(2, '\0') + "b"});
}

TEST(write_log, the_first_block_is_whole)
{
    const write_log log = log_of({{6, 4, 0, 'a'}});
    EXPECT_EQ(fates(log, 0, 6, 4), (texts{"....", "aa..", "..a.", "...a", "aaa.", "aa.a", "..aa", "aaaa"}));
}

TEST(write_log, what_lies_behind_the_disk_has_no_fate)
{
    const write_log log = log_of({{64, 2, 0, 'a'}, {63, 2, 0, 'b'}});
    write_log_disk disk = {&log, write_log_bytes(DISK_BYTES, '.')};
    seeded chance{1};
    write_log_fates counts;
    EXPECT_EQ(disk.after_cut(1, chance, &counts).size(), DISK_BYTES);
    EXPECT_EQ(counts.kept + counts.dropped + counts.torn, 1u);
    EXPECT_EQ(seen(disk.whole(), 62, 2), ".b");
}

TEST(write_log, cuts_do_not_touch_what_is_durable)
{
    const write_log log = log_of({{20, 1, 0, 'a'}, {0, 0, FLUSH, 0}, {20, 1, 0, 'b'}, {21, 1, 0, 'c'}});
    write_log_disk disk = {&log, write_log_bytes(DISK_BYTES, '.')};
    seeded chance{1};
    write_log_fates counts;
    texts all;
    for (int n = 0; n < 200; n++)
        all.insert(seen(disk.after_cut(3, chance, &counts), 20, 2));
    EXPECT_EQ(all, (texts{"a.", "ac", "b.", "bc"}));
    EXPECT_EQ(counts.kept + counts.dropped + counts.torn, 2u);
    EXPECT_EQ(seen(disk.whole(), 20, 2), "bc");
}

TEST(write_log, an_unfinished_log_ends_before_what_is_not_there)
{
    const write_log_bytes all = bytes_of({{20, 2, 0, 'a'}, {22, 2, 0, 'b'}}, 1);
    write_log log;
    EXPECT_EQ(write_log_parse(write_log_bytes(all.begin(), all.end() - 1), &log), "");
    EXPECT_EQ(log.entries.size(), 1u);
    write_log_bytes longer = all;
    longer.resize(all.size() + 3 * SECTOR);
    EXPECT_EQ(write_log_parse(longer, &log), "");
    EXPECT_EQ(log.entries.size(), 2u);
    EXPECT_NE(write_log_parse(bytes_of({{20, 2, 0, 'a'}}, 2), &log), "") << "one that was told of is missing";
    EXPECT_NE(write_log_parse(write_log_bytes(SECTOR), &log), "");
    EXPECT_NE(write_log_parse({}, &log), "");
}

} // namespace
