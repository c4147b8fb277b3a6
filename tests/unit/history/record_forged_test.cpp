/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: bytes are believed to be a record only where every promise of the table in record.h holds.
 * Method: a record laid by hand: every flip and cut of it, and forgeries under sound checksums. */
#include "tests/unit/history/record_laid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace {

TEST(record_forged, every_flip_and_cut_is_refused)
{
    const record_laid_string good = record_laid_bytes();
    preamble_trouble why;
    ASSERT_EQ(record_laid_take(good, &why), STATUS_OK);
    for (size_t bit = 0; bit < good.size() * 8; bit++) {
        record_laid_string b = good;
        b[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
        EXPECT_EQ(record_laid_take(b, &why), STATUS_CORRUPT) << bit;
    }
    for (size_t length = 0; length < RECORD_LAID_HEADER; length++) {
        const record_laid_string cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length));
        EXPECT_EQ(record_laid_take(cut, &why), STATUS_CORRUPT);
        EXPECT_LE(why.offset, length);
        EXPECT_NE(why.expected[0], '\0');
    }
}

struct forgery {
    const char *what;
    size_t at, bytes;
    uint64_t value;
    uint64_t place; /* that is told; bricks count from the first */
    const char *words;
};

void expect_refused(const record_laid_string &from, const forgery &f)
{
    record_laid_string b = from;
    preamble_trouble why;
    if (f.bytes == 4)
        record_laid_u32(b, f.at, static_cast<uint32_t>(f.value));
    else
        record_laid_u64(b, f.at, f.value);
    ASSERT_NE(b, from) << f.what;
    EXPECT_EQ(record_laid_take(record_laid_sealed(b), &why), STATUS_CORRUPT) << f.what;
    EXPECT_EQ(why.offset, f.place) << f.what << ": " << why.expected;
    EXPECT_NE(std::string(why.expected).find(f.words), std::string::npos) << f.what << ": " << why.expected;
}

constexpr uint64_t beyond = (UINT64_C(1) << 62) + 1;
constexpr uint64_t nan_bits = 0x7ff8000000000000, infinite_bits = 0x7ff0000000000000;

TEST(record_forged, forged_headers_are_refused)
{
    const std::vector<forgery> all = {
        {"sequence 0", 16, 8, 0, 16, "sequence from 1"},
        {"sequence beyond any life", 16, 8, beyond, 16, "sequence from 1"},
        {"use 0", 24, 8, 0, 24, "use from 1"},
        {"use beyond any life", 24, 8, beyond, 24, "use from 1"},
        {"stroke beyond any life", 40, 8, beyond, 40, "after the one it began at"},
        {"stroke before where it began", 40, 8, 2, 40, "after the one it began at"},
        {"stroke that began at itself", 48, 8, 7, 40, "after the one it began at"},
        {"a move that began somewhere", 40, 8, 0, 40, "after the one it began at"},
        {"no bricks in a stroke", 56, 4, 0, 56, "bricks in a stroke"},
        {"a mark of later", 60, 4, 3, 60, "no mark"},
        {"cursor beyond the tip", 64, 8, 8, 64, "cursor"},
        {"cursor not at the stroke", 64, 8, 6, 64, "cursor"},
        {"tip beyond the stroke", 72, 8, 8, 64, "cursor"},
        {"tip beyond any life", 72, 8, beyond, 64, "cursor"},
        {"a step that is no number", 104, 8, nan_bits, 104, "finite step"},
        {"a step without end", 104, 8, infinite_bits, 104, "finite step"},
        {"a step of nothing", 104, 8, 0, 104, "finite step"},
        {"a step below nothing", 104, 8, 0xbfc0000000000000, 104, "finite step"},
        {"kept is itself", 112, 8, 9, 112, "earlier sequence"},
        {"kept is later", 112, 8, UINT64_MAX, 112, "earlier sequence"},
        {"bytes of less than a corner a brick", 120, 8, 2 * 88 - 1, 120, "512 corners"},
        {"bytes of more than 512 corners a brick", 120, 8, 2 * (80 + 512 * 8) + 1, 120, "512 corners"},
        {"bytes that wrap round", 120, 8, UINT64_MAX - 1000, 120, "512 corners"},
        {"more bricks than there can be bytes for", 56, 4, UINT32_MAX, 120, "512 corners"},
        {"not zero, first", 132, 4, 1, 132, "zeros"},
        {"nothing follows", 136, 8, 0, 136, "fewer where these are packed"},
        {"more follows than there are bricks", 136, 8, 185, 136, "fewer where these are packed"},
        {"more follows than there can be", 136, 8, UINT64_MAX, 136, "fewer where these are packed"},
    };
    for (const forgery &f : all)
        expect_refused(record_laid_bytes(), f);
}

/* The person went from stroke 7 back to 3. */
record_laid_string laid_move()
{
    record_laid_string b = record_laid_bytes();
    b.resize(RECORD_LAID_HEADER);
    for (const size_t at : {size_t{40}, size_t{48}, size_t{120}, size_t{136}})
        record_laid_u64(b, at, 0);
    record_laid_u32(b, 56, 0);
    record_laid_u32(b, 128, 0);
    record_laid_u64(b, 64, 3);
    return record_laid_sealed(b);
}

TEST(record_forged, moves_have_no_stroke_no_bricks_and_are_whole)
{
    preamble_trouble why;
    record r = {};
    const record_laid_string good = laid_move();
    ASSERT_EQ(record_laid_take(good, &why), STATUS_OK) << why.expected;
    ASSERT_EQ(record_laid_read(good, &r, &why), STATUS_OK);
    EXPECT_EQ(r.stroke, 0u);
    EXPECT_EQ(r.cursor, 3u);
    EXPECT_EQ(r.tip, 7u);
    const std::vector<forgery> all = {
        {"a move that is not whole", 60, 4, 0, 60, "no mark"},
        {"a move with bricks", 56, 4, 1, 56, "none in a move"},
        {"a move that is a part", 128, 4, 1, 56, "none in a move"},
        {"a move with bytes", 120, 8, 88, 120, "512 corners"},
        {"a move that began somewhere", 48, 8, 1, 40, "after the one it began at"},
        {"a move to beyond its tip", 64, 8, 8, 64, "cursor"},
    };
    for (const forgery &f : all)
        expect_refused(good, f);
}

TEST(record_forged, strokes_need_not_be_whole)
{
    record_laid_string b = record_laid_bytes();
    preamble_trouble why;
    record_laid_u32(b, 60, 0);
    EXPECT_EQ(record_laid_take(record_laid_sealed(b), &why), STATUS_OK);
}

TEST(record_forged, forged_bricks_are_refused)
{
    const size_t first = RECORD_LAID_HEADER, second = RECORD_LAID_HEADER + 88;
    const std::vector<forgery> all = {
        {"count not of the mask", first + 12, 4, 2, 0, "as its mask"},
        {"mask not of the count", first + 16, 8, 0xff, 0, "as its mask"},
        {"count of nothing", second + 12, 4, 0, 88, "as its mask"},
        {"count beyond a brick", second + 12, 4, 0x10000000, 88, "as its mask"},
        {"corners that are not there", second + 12, 4, 3, 88, "as its mask"},
        {"bricks out of order", first + 8, 4, 5, 88, "above the one before"},
        {"the same brick twice", first + 8, 4, 1, 88, "above the one before"},
        {"a brick beyond the lattice", second, 4, 0x10000000, 88, "within the lattice"},
        {"a brick in the layer that stays empty", second, 4, INT32_MAX >> 3, 88, "within the lattice"},
        {"a corner that did not change", second + 84, 4, 0, 88 + 80, "corners that differ"},
        {"fewer bricks than follow", 56, 4, 1, 88, "end of the bricks"},
    };
    for (const forgery &f : all)
        expect_refused(record_laid_bytes(), f);
    record_laid_string more = record_laid_bytes(); /* three bricks of 96 bytes less than four */
    preamble_trouble why;
    more.resize(RECORD_LAID_HEADER + 3 * 88);
    record_laid_u64(more, 120, 3 * 88);
    record_laid_u64(more, 136, 3 * 88);
    record_laid_u32(more, 56, 3);
    EXPECT_EQ(record_laid_take(record_laid_sealed(more), &why), STATUS_CORRUPT);
    EXPECT_EQ(why.offset, 184u);
}

TEST(record_forged, mask_of_more_corners_than_there_are_bytes_is_refused)
{
    record_laid_string b = record_laid_bytes();
    preamble_trouble why;
    const size_t second = RECORD_LAID_HEADER + 88;
    record_laid_u32(b, second + 12, 512);
    std::fill_n(b.begin() + static_cast<std::ptrdiff_t>(second) + 16, 64, uint8_t{0xff});
    EXPECT_EQ(record_laid_take(record_laid_sealed(b), &why), STATUS_CORRUPT);
    EXPECT_EQ(why.offset, 88u);
}

TEST(record_forged, highest_counts_are_a_header_still)
{
    record_laid_string b = record_laid_bytes();
    preamble_trouble why;
    record r = {};
    record_laid_u32(b, 56, UINT32_MAX);
    record_laid_u64(b, 120, uint64_t{UINT32_MAX} * (80 + 512 * 8));
    EXPECT_EQ(record_laid_read(record_laid_sealed(b), &r, &why), STATUS_CORRUPT) << "that much may not be packed";
    record_laid_u64(b, 136, uint64_t{UINT32_MAX} * (80 + 512 * 8));
    ASSERT_EQ(record_laid_read(record_laid_sealed(b), &r, &why), STATUS_OK)
        << "reading it allocates nothing: who reads on looks at the file";
    EXPECT_EQ(r.bytes, uint64_t{UINT32_MAX} * (80 + 512 * 8));
}

TEST(record_forged, refusal_leaves_the_answer_alone)
{
    record_laid_string b = record_laid_bytes();
    preamble_trouble why;
    record r = {};
    r.sequence = 77;
    record_laid_u64(b, 24, 0);
    ASSERT_EQ(record_laid_read(record_laid_sealed(b), &r, &why), STATUS_CORRUPT);
    EXPECT_EQ(r.sequence, 77u);
}

TEST(record_forged, later_versions_are_told_from_damage)
{
    preamble_trouble why;
    record_laid_string b = record_laid_bytes();
    record_laid_u32(b, 8, 3);
    EXPECT_EQ(record_laid_take(b, &why), STATUS_CORRUPT) << "its checksum does not hold";
    EXPECT_EQ(record_laid_take(record_laid_sealed(b), &why), STATUS_NEWER);
    EXPECT_EQ(why.offset, 8u);
    record_laid_string longer = record_laid_bytes(); /* one that has more to say */
    longer.insert(longer.begin() + 152, 40, uint8_t{1});
    record_laid_u32(longer, 8, 3);
    record_laid_u32(longer, 12, 200);
    record_laid_u64(longer, 192, digest_bytes(longer.data(), 192, 0));
    EXPECT_EQ(record_laid_take(longer, &why), STATUS_NEWER);
    for (const uint32_t version : {1u, 2u}) {
        record_laid_u32(longer, 8, version);
        record_laid_u64(longer, 192, digest_bytes(longer.data(), 192, 0));
        EXPECT_EQ(record_laid_take(longer, &why), STATUS_CORRUPT) << "versions 1 and 2 have 160";
    }
    record_laid_u32(b, 8, 0);
    EXPECT_EQ(record_laid_take(record_laid_sealed(b), &why), STATUS_CORRUPT) << "there never was a version 0";
}

} // namespace
