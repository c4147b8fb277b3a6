/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a record's bytes are those of the table, on every machine's vectors.
 * Method: a header and bricks laid by hand; each field moved alone; pages of chance sifted by a loop of its own; the
 *         same bricks packed. */
#include "tests/unit/history/record_laid.h"

#include "clay/colour.h"
#include "clay/sieve_rows.h"
#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace {

struct pages {
    brick_page old = {}, now = {};
};

pages first_pages()
{
    pages p;
    p.now.potential[1] = 1.25f;
    p.now.rgba[1] = 0x04030201;
    return p;
}

pages second_pages()
{
    pages p;
    p.old.potential[1] = 0.5f;
    p.old.rgba[1] = 0xaabbccdd;
    p.now.potential[1] = 2.5f;
    p.now.rgba[1] = 0x08070605;
    p.old.potential[2] = 3;
    p.old.rgba[2] = COLOUR_NONE;
    for (brick_page *page : {&p.old, &p.now}) { /* the same on both sides */
        page->potential[500] = 1;
        page->rgba[500] = 5;
    }
    return p;
}

record_laid_string put(key at, const brick_page *old, const brick_page *now, lanes rows)
{
    record_laid_string b(size_t{RECORD_BRICK_BYTES_MAX} + SIEVE_ROWS_SLACK_BYTES);
    b.resize(record_put_brick(b.data(), at, old, now, rows));
    return b;
}

/* The header that the room writes over bricks laid by hand. */
record_laid_string written(record r)
{
    record_laid_string b = record_laid_bytes();
    std::fill(b.begin(), b.begin() + RECORD_LAID_HEADER, uint8_t{0xee});
    record_seal(&r, b.data());
    EXPECT_EQ(r.check, byte_order_get_u64(&b[144]));
    EXPECT_EQ(r.seal, byte_order_get_u64(&b[152]));
    return b;
}

/* --- what the bytes say --- */

TEST(record, header_is_that_of_the_table) { EXPECT_EQ(written(record_laid_facts), record_laid_bytes()); }

TEST(record, every_field_has_its_place_and_no_other)
{
    struct place {
        size_t at, bytes;
        void (*move)(record &);
    };
    const std::vector<place> all = {
        {16, 8, [](record &r) { r.sequence ^= 0xff; }},
        {24, 8, [](record &r) { r.use ^= 0xff; }},
        {32, 8, [](record &r) { r.before ^= 0xff; }},
        {40, 8, [](record &r) { r.stroke ^= 0xff; }},
        {48, 8, [](record &r) { r.parent ^= 0xff; }},
        {56, 4, [](record &r) { r.bricks ^= 0xff; }},
        {60, 4, [](record &r) { r.marks ^= 0xff; }},
        {64, 8, [](record &r) { r.cursor ^= 0xff; }},
        {72, 8, [](record &r) { r.tip ^= 0xff; }},
        {80, 8, [](record &r) { r.digest_before ^= 0xff; }},
        {88, 8, [](record &r) { r.digest_after ^= 0xff; }},
        {96, 8, [](record &r) { r.dab ^= 0xff; }},
        {112, 8, [](record &r) { r.kept ^= 0xff; }},
        {128, 4, [](record &r) { r.part ^= 0xff; }},
    };
    const record_laid_string good = record_laid_bytes();
    for (const place &p : all) {
        record r = record_laid_facts;
        p.move(r);
        record_laid_string expected = good;
        expected[p.at] ^= 0xff;
        EXPECT_EQ(written(r), record_laid_sealed(expected)) << "the field at " << p.at;
    }
    record r = record_laid_facts;
    r.step_mm = -2;
    record_laid_string expected = good;
    record_laid_u64(expected, 104, 0xc000000000000000);
    EXPECT_EQ(written(r), record_laid_sealed(expected));
    r = record_laid_facts;
    r.bytes = 89;
    r.stored = 88; /* the first 88 alone are vouched for */
    const record_laid_string shorter = written(r);
    EXPECT_EQ(byte_order_get_u64(&shorter[120]), 89u);
    EXPECT_EQ(byte_order_get_u64(&shorter[136]), 88u);
    EXPECT_EQ(byte_order_get_u64(&shorter[144]), digest_bytes(good.data() + RECORD_LAID_HEADER, 88, 9));
}

TEST(record, reading_gives_every_field_back)
{
    record r = {};
    preamble_trouble why;
    const record_laid_string b = record_laid_bytes();
    ASSERT_EQ(record_laid_read(b, &r, &why), STATUS_OK);
    EXPECT_EQ(r.sequence, record_laid_facts.sequence);
    EXPECT_EQ(r.use, record_laid_facts.use);
    EXPECT_EQ(r.before, record_laid_facts.before);
    EXPECT_EQ(r.stroke, record_laid_facts.stroke);
    EXPECT_EQ(r.parent, record_laid_facts.parent);
    EXPECT_EQ(r.bricks, record_laid_facts.bricks);
    EXPECT_EQ(r.marks, record_laid_facts.marks);
    EXPECT_EQ(r.part, record_laid_facts.part);
    EXPECT_EQ(r.cursor, record_laid_facts.cursor);
    EXPECT_EQ(r.tip, record_laid_facts.tip);
    EXPECT_EQ(r.digest_before, record_laid_facts.digest_before);
    EXPECT_EQ(r.digest_after, record_laid_facts.digest_after);
    EXPECT_EQ(r.dab, record_laid_facts.dab);
    EXPECT_EQ(r.step_mm, record_laid_facts.step_mm);
    EXPECT_EQ(r.kept, record_laid_facts.kept);
    EXPECT_EQ(r.bytes, record_laid_facts.bytes);
    EXPECT_EQ(r.stored, record_laid_facts.stored);
    EXPECT_EQ(r.check, byte_order_get_u64(&b[144]));
    EXPECT_EQ(r.seal, byte_order_get_u64(&b[152]));
    record_laid_string bricks(b.size() - RECORD_LAID_HEADER);
    EXPECT_EQ(record_check(&r, b.data() + RECORD_LAID_HEADER, bricks.data(), &why), STATUS_OK);
    EXPECT_EQ(bricks, record_laid_string(b.begin() + RECORD_LAID_HEADER, b.end()));
}

TEST(record, version_1_is_still_read)
{
    record_laid_string b = record_laid_bytes();
    preamble_trouble why;
    record r = {};
    record_laid_u32(b, 8, 1);
    record_laid_u64(b, 136, 0);
    b = record_laid_sealed(b);
    ASSERT_EQ(record_laid_read(b, &r, &why), STATUS_OK) << why.expected;
    EXPECT_EQ(r.stored, 184u) << "it knew no packing";
    EXPECT_EQ(record_laid_take(b, &why), STATUS_OK) << why.expected;
    record_laid_u64(b, 136, 184);
    EXPECT_EQ(record_laid_take(record_laid_sealed(b), &why), STATUS_CORRUPT);
    EXPECT_EQ(why.offset, 132u);
}

/* The laid record as the room would write it. */
record_laid_string packed()
{
    const record_laid_string plain = record_laid_bytes();
    record r = record_laid_facts;
    record_laid_string b(plain.size());
    packing *with = packing_open();
    record_pack(&r, with, &b[RECORD_LAID_HEADER], &plain[RECORD_LAID_HEADER]);
    packing_close(with);
    EXPECT_LT(r.stored, r.bytes) << "so much of nothing can be packed";
    b.resize(RECORD_LAID_HEADER + r.stored);
    record_seal(&r, b.data());
    return b;
}

TEST(record, packed_bricks_come_back)
{
    const record_laid_string b = packed(), plain = record_laid_bytes();
    record r = {};
    preamble_trouble why;
    ASSERT_EQ(record_laid_read(b, &r, &why), STATUS_OK);
    EXPECT_EQ(r.bytes, 184u);
    EXPECT_EQ(r.stored, b.size() - RECORD_LAID_HEADER);
    record_laid_string bricks(184);
    EXPECT_EQ(record_check(&r, b.data() + RECORD_LAID_HEADER, bricks.data(), &why), STATUS_OK);
    EXPECT_EQ(bricks, record_laid_string(plain.begin() + RECORD_LAID_HEADER, plain.end()));
    ASSERT_EQ(record_unpack(&r, b.data() + RECORD_LAID_HEADER, bricks.data()), STATUS_OK);
    EXPECT_EQ(bricks, record_laid_string(plain.begin() + RECORD_LAID_HEADER, plain.end()));
}

TEST(record, packed_bytes_that_lie_are_refused)
{
    preamble_trouble why;
    const record_laid_string good = packed();
    ASSERT_EQ(record_laid_take(good, &why), STATUS_OK) << why.expected;
    for (size_t bit = RECORD_LAID_HEADER * 8; bit < good.size() * 8; bit++) {
        record_laid_string b = good;
        b[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
        EXPECT_EQ(record_laid_take(b, &why), STATUS_CORRUPT) << bit;
        /* Under a sound checksum: whatever it unpacks to, it is bricks or refused, and no byte goes beyond them. */
        const status s = record_laid_take(record_laid_sealed(b), &why);
        EXPECT_TRUE(s == STATUS_CORRUPT || s == STATUS_OK) << bit;
    }
    for (const uint64_t claim : {176u, 183u, 185u, 192u, 8u * 1024}) {
        record_laid_string b = good;
        record_laid_u64(b, 120, claim);
        EXPECT_EQ(record_laid_take(record_laid_sealed(b), &why), STATUS_CORRUPT) << claim;
    }
    record_laid_string cut = good;
    cut.pop_back();
    record_laid_u64(cut, 136, cut.size() - RECORD_LAID_HEADER);
    EXPECT_EQ(record_laid_take(record_laid_sealed(cut), &why), STATUS_CORRUPT);
    EXPECT_NE(std::string(why.expected).find("unpack"), std::string::npos) << why.expected;
}

TEST(record, bricks_are_those_of_the_table)
{
    const record_laid_string b = record_laid_bytes();
    const pages first = first_pages(), second = second_pages();
    EXPECT_EQ(put({0, 0, 0}, nullptr, &first.now, LANES_PLAIN),
              record_laid_string(b.begin() + RECORD_LAID_HEADER, b.begin() + RECORD_LAID_HEADER + 88));
    EXPECT_EQ(put({0, 0, 1}, &second.old, &second.now, LANES_PLAIN),
              record_laid_string(b.begin() + RECORD_LAID_HEADER + 88, b.end()));
}

TEST(record, difference_is_the_same_either_way)
{
    const pages p = second_pages();
    EXPECT_EQ(put({1, 2, 3}, &p.old, &p.now, LANES_PLAIN), put({1, 2, 3}, &p.now, &p.old, LANES_PLAIN));
    EXPECT_EQ(put({1, 2, 3}, &p.now, nullptr, LANES_PLAIN), put({1, 2, 3}, nullptr, &p.now, LANES_PLAIN));
    EXPECT_TRUE(put({1, 2, 3}, &p.now, &p.now, LANES_PLAIN).empty());
    EXPECT_TRUE(put({1, 2, 3}, nullptr, nullptr, LANES_PLAIN).empty());
}

void fill(seeded &chance, brick_page *p, double share)
{
    *p = {};
    for (int n = 0; n < BRICK_CORNERS; n++)
        if (seeded_chance(chance, share)) {
            p->potential[n] = static_cast<float>(seeded_int(chance, 1, 3000)) / 1000;
            p->rgba[n] = static_cast<uint32_t>(seeded_bits(chance));
        }
}

/* Corner by corner, as the table says it. */
record_laid_string put_plainly(key at, const brick_page &old, const brick_page &now)
{
    record_laid_string potentials, colours, b(80);
    uint32_t corners = 0;
    for (int n = 0; n < BRICK_CORNERS; n++) {
        uint32_t a, z;
        std::memcpy(&a, &old.potential[n], 4);
        std::memcpy(&z, &now.potential[n], 4);
        if (a == z && old.rgba[n] == now.rgba[n])
            continue;
        b[static_cast<size_t>(16 + n / 8)] |= static_cast<uint8_t>(1 << n % 8);
        potentials.resize(potentials.size() + 4);
        record_laid_u32(potentials, potentials.size() - 4, a ^ z);
        colours.resize(colours.size() + 4);
        record_laid_u32(colours, colours.size() - 4, old.rgba[n] ^ now.rgba[n]);
        corners++;
    }
    record_laid_u32(b, 0, static_cast<uint32_t>(at.i));
    record_laid_u32(b, 4, static_cast<uint32_t>(at.j));
    record_laid_u32(b, 8, static_cast<uint32_t>(at.k));
    record_laid_u32(b, 12, corners);
    b.insert(b.end(), potentials.begin(), potentials.end());
    b.insert(b.end(), colours.begin(), colours.end());
    return corners > 0 ? b : record_laid_string();
}

TEST(record, every_kind_of_vectors_gives_the_same_bytes)
{
    seeded chance = {5};
    for (int n = 0; n < 200; n++) {
        pages p;
        fill(chance, &p.old, seeded_real(chance, 0, 1));
        if (seeded_chance(chance, 0.5))
            p.now = p.old;
        else
            fill(chance, &p.now, seeded_real(chance, 0, 1));
        for (int64_t more = seeded_int(chance, 0, 5); more > 0; more--)
            p.now.rgba[seeded_int(chance, 0, 511)] ^= 1u << seeded_int(chance, 0, 31);
        const key at = seeded_key(chance, -1000, 1000);
        const record_laid_string expected = put_plainly(at, p.old, p.now);
        for (lanes l : {LANES_PLAIN, LANES_AVX2, LANES_AVX512})
            if (lanes_are_here(l)) {
                ASSERT_EQ(put(at, &p.old, &p.now, l), expected) << lanes_name(l);
            }
    }
}

TEST(record, get_brick_is_the_way_back)
{
    const record_laid_string b = record_laid_bytes();
    record_brick brick;
    ASSERT_EQ(record_get_brick(&brick, &b[RECORD_LAID_HEADER + 88], 96), 96u);
    EXPECT_EQ(key_compare(brick.at, {0, 0, 1}), 0);
    EXPECT_EQ(brick.corners, 2u);
    EXPECT_EQ(brick.mask.slab[0], 0b110u);
    EXPECT_EQ(brick.potential, &b[RECORD_LAID_HEADER + 88 + 80]);
    EXPECT_EQ(brick.rgba, &b[RECORD_LAID_HEADER + 88 + 88]);
    for (size_t left = 0; left < 96; left++) {
        const auto from = b.begin() + RECORD_LAID_HEADER + 88;
        const record_laid_string cut(from, from + static_cast<std::ptrdiff_t>(left));
        EXPECT_EQ(record_get_brick(&brick, cut.data(), left), 0u) << left;
    }
}

TEST(record, span_is_whole_blocks)
{
    EXPECT_EQ(record_span(0), 4096u);
    EXPECT_EQ(record_span(4096 - 160), 4096u);
    EXPECT_EQ(record_span(4096 - 159), 8192u);
    EXPECT_EQ(record_span(uint64_t{UINT32_MAX} * RECORD_BRICK_BYTES_MAX) % 4096, 0u);
    const uint64_t most = uint64_t{UINT32_MAX} * RECORD_BRICK_BYTES_MAX;
    EXPECT_GT(record_span(most), most);
}

} // namespace
