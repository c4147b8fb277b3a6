/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a record's bytes are those of the table, on every machine's vectors; and bytes are believed only where every
 *       promise of the table holds.
 * Method: a header and bricks laid by hand, number by number, from the table in record.h; each field moved alone; pages
 *         of chance sifted by a loop of its own; every flip and cut; forgeries under sound checksums. */
#include "history/record.h"

#include "clay/colour.h"
#include "clay/digest.h"
#include "clay/sieve_rows.h"
#include "history/byte_order.h"
#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace {

using byte_string = std::vector<uint8_t>;

enum { HEADER = 160 };

void lay32(byte_string &b, size_t at, uint32_t v)
{
    for (size_t n = 0; n < 4; n++)
        b.at(at + n) = static_cast<uint8_t>(v >> 8 * n & 255);
}

void lay64(byte_string &b, size_t at, uint64_t v)
{
    lay32(b, at, static_cast<uint32_t>(v & 0xffffffff));
    lay32(b, at + 4, static_cast<uint32_t>(v >> 32));
}

/* The last two fields, which vouch for the others. */
byte_string sealed(byte_string b)
{
    lay64(b, 144, digest_bytes(b.data() + HEADER, b.size() - HEADER, byte_order_get_u64(&b[16])));
    lay64(b, 152, digest_bytes(b.data(), 152, 0));
    return b;
}

/* Two bricks: (0,0,0) with corner (0,0,1); (0,0,1) with corners (0,0,9) and (0,0,10). */
byte_string laid()
{
    byte_string b(HEADER + 80 + 8 + 80 + 16);
    std::memcpy(b.data(), "glring\r\n", 8);
    lay32(b, 8, 2);
    lay32(b, 12, 160);
    lay64(b, 16, 9);
    lay64(b, 24, 4);
    lay64(b, 32, 0x1122334455667788);
    lay64(b, 40, 7);
    lay64(b, 48, 3);
    lay32(b, 56, 2);
    lay32(b, 60, 1);
    lay64(b, 64, 7);
    lay64(b, 72, 7);
    lay64(b, 80, 0xa1a2a3a4a5a6a7a8);
    lay64(b, 88, 0xb1b2b3b4b5b6b7b8);
    lay64(b, 96, 99);
    lay64(b, 104, 0x3fc0000000000000); /* 0.125 */
    lay64(b, 112, 8);
    lay64(b, 120, b.size() - HEADER);
    lay32(b, 128, 2);
    lay64(b, 136, b.size() - HEADER);
    const size_t first = HEADER, second = HEADER + 88;
    lay32(b, first + 12, 1);
    lay64(b, first + 16, 0b10);
    lay32(b, first + 80, 0x3fa00000); /* 1.25, from nothing */
    lay32(b, first + 84, 0x04030201);
    lay32(b, second + 8, 1);
    lay32(b, second + 12, 2);
    lay64(b, second + 16, 0b110);
    lay32(b, second + 80, 0x3f000000 ^ 0x40200000); /* 0.5 became 2.5 */
    lay32(b, second + 84, 0x40400000);              /* 3 became nothing */
    lay32(b, second + 88, 0xaabbccdd ^ 0x08070605);
    return sealed(b);
}

constexpr record facts = {.sequence = 9,
                          .use = 4,
                          .before = 0x1122334455667788,
                          .stroke = 7,
                          .parent = 3,
                          .bricks = 2,
                          .marks = RECORD_WHOLE,
                          .part = 2,
                          .cursor = 7,
                          .tip = 7,
                          .digest_before = 0xa1a2a3a4a5a6a7a8,
                          .digest_after = 0xb1b2b3b4b5b6b7b8,
                          .dab = 99,
                          .step_mm = 0.125,
                          .kept = 8,
                          .bytes = 184,
                          .stored = 184,
                          .check = 0,
                          .seal = 0};

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

byte_string put(key at, const brick_page *old, const brick_page *now, lanes rows)
{
    byte_string b(size_t{RECORD_BRICK_BYTES_MAX} + SIEVE_ROWS_SLACK_BYTES);
    b.resize(record_put_brick(b.data(), at, old, now, rows));
    return b;
}

/* The header that the room writes over bricks laid by hand. */
byte_string written(record r)
{
    byte_string b = laid();
    std::fill(b.begin(), b.begin() + HEADER, uint8_t{0xee});
    record_seal(&r, b.data());
    EXPECT_EQ(r.check, byte_order_get_u64(&b[144]));
    EXPECT_EQ(r.seal, byte_order_get_u64(&b[152]));
    return b;
}

status read(const byte_string &b, record *r, preamble_trouble *why)
{
    *why = {UINT64_MAX, ""};
    const byte_string exact(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(std::min<size_t>(b.size(), 512)));
    return record_read(r, exact.data(), exact.size(), why);
}

/* Header and bricks. */
status take(const byte_string &b, preamble_trouble *why)
{
    record r = {};
    const status s = read(b, &r, why);
    if (s != STATUS_OK)
        return s;
    if (r.stored != b.size() - HEADER)
        return STATUS_CORRUPT;
    const byte_string stored(b.begin() + HEADER, b.end());
    byte_string bricks(static_cast<size_t>(r.bytes));
    return record_check(&r, stored.data(), bricks.data(), why);
}

/* --- what the bytes say --- */

TEST(record, header_is_that_of_the_table) { EXPECT_EQ(written(facts), laid()); }

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
    const byte_string good = laid();
    for (const place &p : all) {
        record r = facts;
        p.move(r);
        byte_string expected = good;
        expected[p.at] ^= 0xff;
        EXPECT_EQ(written(r), sealed(expected)) << "the field at " << p.at;
    }
    record r = facts;
    r.step_mm = -2;
    byte_string expected = good;
    lay64(expected, 104, 0xc000000000000000);
    EXPECT_EQ(written(r), sealed(expected));
    r = facts;
    r.bytes = 89;
    r.stored = 88; /* the first 88 alone are vouched for */
    const byte_string shorter = written(r);
    EXPECT_EQ(byte_order_get_u64(&shorter[120]), 89u);
    EXPECT_EQ(byte_order_get_u64(&shorter[136]), 88u);
    EXPECT_EQ(byte_order_get_u64(&shorter[144]), digest_bytes(good.data() + HEADER, 88, 9));
}

TEST(record, reading_gives_every_field_back)
{
    record r = {};
    preamble_trouble why;
    const byte_string b = laid();
    ASSERT_EQ(read(b, &r, &why), STATUS_OK);
    EXPECT_EQ(r.sequence, facts.sequence);
    EXPECT_EQ(r.use, facts.use);
    EXPECT_EQ(r.before, facts.before);
    EXPECT_EQ(r.stroke, facts.stroke);
    EXPECT_EQ(r.parent, facts.parent);
    EXPECT_EQ(r.bricks, facts.bricks);
    EXPECT_EQ(r.marks, facts.marks);
    EXPECT_EQ(r.part, facts.part);
    EXPECT_EQ(r.cursor, facts.cursor);
    EXPECT_EQ(r.tip, facts.tip);
    EXPECT_EQ(r.digest_before, facts.digest_before);
    EXPECT_EQ(r.digest_after, facts.digest_after);
    EXPECT_EQ(r.dab, facts.dab);
    EXPECT_EQ(r.step_mm, facts.step_mm);
    EXPECT_EQ(r.kept, facts.kept);
    EXPECT_EQ(r.bytes, facts.bytes);
    EXPECT_EQ(r.stored, facts.stored);
    EXPECT_EQ(r.check, byte_order_get_u64(&b[144]));
    EXPECT_EQ(r.seal, byte_order_get_u64(&b[152]));
    byte_string bricks(b.size() - HEADER);
    EXPECT_EQ(record_check(&r, b.data() + HEADER, bricks.data(), &why), STATUS_OK);
    EXPECT_EQ(bricks, byte_string(b.begin() + HEADER, b.end()));
}

TEST(record, version_1_is_still_read)
{
    byte_string b = laid();
    preamble_trouble why;
    record r = {};
    lay32(b, 8, 1);
    lay64(b, 136, 0);
    b = sealed(b);
    ASSERT_EQ(read(b, &r, &why), STATUS_OK) << why.expected;
    EXPECT_EQ(r.stored, 184u) << "it knew no packing";
    EXPECT_EQ(take(b, &why), STATUS_OK) << why.expected;
    lay64(b, 136, 184);
    EXPECT_EQ(take(sealed(b), &why), STATUS_CORRUPT);
    EXPECT_EQ(why.offset, 132u);
}

/* The laid record as the room would write it. */
byte_string packed()
{
    const byte_string plain = laid();
    record r = facts;
    byte_string b(plain.size());
    packing *with = packing_open();
    record_pack(&r, with, &b[HEADER], &plain[HEADER]);
    packing_close(with);
    EXPECT_LT(r.stored, r.bytes) << "so much of nothing can be packed";
    b.resize(HEADER + r.stored);
    record_seal(&r, b.data());
    return b;
}

TEST(record, packed_bricks_come_back)
{
    const byte_string b = packed(), plain = laid();
    record r = {};
    preamble_trouble why;
    ASSERT_EQ(read(b, &r, &why), STATUS_OK);
    EXPECT_EQ(r.bytes, 184u);
    EXPECT_EQ(r.stored, b.size() - HEADER);
    byte_string bricks(184);
    EXPECT_EQ(record_check(&r, b.data() + HEADER, bricks.data(), &why), STATUS_OK);
    EXPECT_EQ(bricks, byte_string(plain.begin() + HEADER, plain.end()));
    ASSERT_EQ(record_unpack(&r, b.data() + HEADER, bricks.data()), STATUS_OK);
    EXPECT_EQ(bricks, byte_string(plain.begin() + HEADER, plain.end()));
}

TEST(record, packed_bytes_that_lie_are_refused)
{
    preamble_trouble why;
    const byte_string good = packed();
    ASSERT_EQ(take(good, &why), STATUS_OK) << why.expected;
    for (size_t bit = HEADER * 8; bit < good.size() * 8; bit++) {
        byte_string b = good;
        b[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
        EXPECT_EQ(take(b, &why), STATUS_CORRUPT) << bit;
        /* Under a sound checksum: whatever it unpacks to, it is bricks or refused, and no byte goes beyond them. */
        const status s = take(sealed(b), &why);
        EXPECT_TRUE(s == STATUS_CORRUPT || s == STATUS_OK) << bit;
    }
    for (const uint64_t claim : {176u, 183u, 185u, 192u, 8u * 1024}) {
        byte_string b = good;
        lay64(b, 120, claim);
        EXPECT_EQ(take(sealed(b), &why), STATUS_CORRUPT) << claim;
    }
    byte_string cut = good;
    cut.pop_back();
    lay64(cut, 136, cut.size() - HEADER);
    EXPECT_EQ(take(sealed(cut), &why), STATUS_CORRUPT);
    EXPECT_NE(std::string(why.expected).find("unpack"), std::string::npos) << why.expected;
}

TEST(record, bricks_are_those_of_the_table)
{
    const byte_string b = laid();
    const pages first = first_pages(), second = second_pages();
    EXPECT_EQ(put({0, 0, 0}, nullptr, &first.now, LANES_PLAIN),
              byte_string(b.begin() + HEADER, b.begin() + HEADER + 88));
    EXPECT_EQ(put({0, 0, 1}, &second.old, &second.now, LANES_PLAIN), byte_string(b.begin() + HEADER + 88, b.end()));
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
byte_string put_plainly(key at, const brick_page &old, const brick_page &now)
{
    byte_string potentials, colours, b(80);
    uint32_t corners = 0;
    for (int n = 0; n < BRICK_CORNERS; n++) {
        uint32_t a, z;
        std::memcpy(&a, &old.potential[n], 4);
        std::memcpy(&z, &now.potential[n], 4);
        if (a == z && old.rgba[n] == now.rgba[n])
            continue;
        b[static_cast<size_t>(16 + n / 8)] |= static_cast<uint8_t>(1 << n % 8);
        potentials.resize(potentials.size() + 4);
        lay32(potentials, potentials.size() - 4, a ^ z);
        colours.resize(colours.size() + 4);
        lay32(colours, colours.size() - 4, old.rgba[n] ^ now.rgba[n]);
        corners++;
    }
    lay32(b, 0, static_cast<uint32_t>(at.i));
    lay32(b, 4, static_cast<uint32_t>(at.j));
    lay32(b, 8, static_cast<uint32_t>(at.k));
    lay32(b, 12, corners);
    b.insert(b.end(), potentials.begin(), potentials.end());
    b.insert(b.end(), colours.begin(), colours.end());
    return corners > 0 ? b : byte_string();
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
        const byte_string expected = put_plainly(at, p.old, p.now);
        for (lanes l : {LANES_PLAIN, LANES_AVX2, LANES_AVX512})
            if (lanes_are_here(l)) {
                ASSERT_EQ(put(at, &p.old, &p.now, l), expected) << lanes_name(l);
            }
    }
}

TEST(record, get_brick_is_the_way_back)
{
    const byte_string b = laid();
    record_brick brick;
    ASSERT_EQ(record_get_brick(&brick, &b[HEADER + 88], 96), 96u);
    EXPECT_EQ(key_compare(brick.at, {0, 0, 1}), 0);
    EXPECT_EQ(brick.corners, 2u);
    EXPECT_EQ(brick.mask.slab[0], 0b110u);
    EXPECT_EQ(brick.potential, &b[HEADER + 88 + 80]);
    EXPECT_EQ(brick.rgba, &b[HEADER + 88 + 88]);
    for (size_t left = 0; left < 96; left++) {
        const byte_string cut(b.begin() + HEADER + 88, b.begin() + HEADER + 88 + static_cast<std::ptrdiff_t>(left));
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

/* --- bytes that lie --- */

TEST(record, every_flip_and_cut_is_refused)
{
    const byte_string good = laid();
    preamble_trouble why;
    ASSERT_EQ(take(good, &why), STATUS_OK);
    for (size_t bit = 0; bit < good.size() * 8; bit++) {
        byte_string b = good;
        b[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
        EXPECT_EQ(take(b, &why), STATUS_CORRUPT) << bit;
    }
    for (size_t length = 0; length < HEADER; length++) {
        EXPECT_EQ(take({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length)}, &why), STATUS_CORRUPT);
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

void expect_refused(const byte_string &from, const forgery &f)
{
    byte_string b = from;
    preamble_trouble why;
    if (f.bytes == 4)
        lay32(b, f.at, static_cast<uint32_t>(f.value));
    else
        lay64(b, f.at, f.value);
    ASSERT_NE(b, from) << f.what;
    EXPECT_EQ(take(sealed(b), &why), STATUS_CORRUPT) << f.what;
    EXPECT_EQ(why.offset, f.place) << f.what << ": " << why.expected;
    EXPECT_NE(std::string(why.expected).find(f.words), std::string::npos) << f.what << ": " << why.expected;
}

constexpr uint64_t beyond = (UINT64_C(1) << 62) + 1;
constexpr uint64_t nan_bits = 0x7ff8000000000000, infinite_bits = 0x7ff0000000000000;

TEST(record, forged_headers_are_refused)
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
        expect_refused(laid(), f);
}

/* The person went from stroke 7 back to 3. */
byte_string laid_move()
{
    byte_string b = laid();
    b.resize(HEADER);
    for (const size_t at : {size_t{40}, size_t{48}, size_t{120}, size_t{136}})
        lay64(b, at, 0);
    lay32(b, 56, 0);
    lay32(b, 128, 0);
    lay64(b, 64, 3);
    return sealed(b);
}

TEST(record, moves_have_no_stroke_no_bricks_and_are_whole)
{
    preamble_trouble why;
    record r = {};
    const byte_string good = laid_move();
    ASSERT_EQ(take(good, &why), STATUS_OK) << why.expected;
    ASSERT_EQ(read(good, &r, &why), STATUS_OK);
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

TEST(record, strokes_need_not_be_whole)
{
    byte_string b = laid();
    preamble_trouble why;
    lay32(b, 60, 0);
    EXPECT_EQ(take(sealed(b), &why), STATUS_OK);
}

TEST(record, forged_bricks_are_refused)
{
    const size_t first = HEADER, second = HEADER + 88;
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
        expect_refused(laid(), f);
    byte_string more = laid(); /* three bricks of 96 bytes less than four */
    preamble_trouble why;
    more.resize(HEADER + 3 * 88);
    lay64(more, 120, 3 * 88);
    lay64(more, 136, 3 * 88);
    lay32(more, 56, 3);
    EXPECT_EQ(take(sealed(more), &why), STATUS_CORRUPT);
    EXPECT_EQ(why.offset, 184u);
}

TEST(record, mask_of_more_corners_than_there_are_bytes_is_refused)
{
    byte_string b = laid();
    preamble_trouble why;
    const size_t second = HEADER + 88;
    lay32(b, second + 12, 512);
    std::fill_n(b.begin() + static_cast<std::ptrdiff_t>(second) + 16, 64, uint8_t{0xff});
    EXPECT_EQ(take(sealed(b), &why), STATUS_CORRUPT);
    EXPECT_EQ(why.offset, 88u);
}

TEST(record, highest_counts_are_a_header_still)
{
    byte_string b = laid();
    preamble_trouble why;
    record r = {};
    lay32(b, 56, UINT32_MAX);
    lay64(b, 120, uint64_t{UINT32_MAX} * (80 + 512 * 8));
    EXPECT_EQ(read(sealed(b), &r, &why), STATUS_CORRUPT) << "that much may not be packed";
    lay64(b, 136, uint64_t{UINT32_MAX} * (80 + 512 * 8));
    ASSERT_EQ(read(sealed(b), &r, &why), STATUS_OK) << "reading it allocates nothing: who reads on looks at the file";
    EXPECT_EQ(r.bytes, uint64_t{UINT32_MAX} * (80 + 512 * 8));
}

TEST(record, refusal_leaves_the_answer_alone)
{
    byte_string b = laid();
    preamble_trouble why;
    record r = {};
    r.sequence = 77;
    lay64(b, 24, 0);
    ASSERT_EQ(read(sealed(b), &r, &why), STATUS_CORRUPT);
    EXPECT_EQ(r.sequence, 77u);
}

TEST(record, later_versions_are_told_from_damage)
{
    preamble_trouble why;
    byte_string b = laid();
    lay32(b, 8, 3);
    EXPECT_EQ(take(b, &why), STATUS_CORRUPT) << "its checksum does not hold";
    EXPECT_EQ(take(sealed(b), &why), STATUS_NEWER);
    EXPECT_EQ(why.offset, 8u);
    byte_string longer = laid(); /* one that has more to say */
    longer.insert(longer.begin() + 152, 40, uint8_t{1});
    lay32(longer, 8, 3);
    lay32(longer, 12, 200);
    lay64(longer, 192, digest_bytes(longer.data(), 192, 0));
    EXPECT_EQ(take(longer, &why), STATUS_NEWER);
    for (const uint32_t version : {1u, 2u}) {
        lay32(longer, 8, version);
        lay64(longer, 192, digest_bytes(longer.data(), 192, 0));
        EXPECT_EQ(take(longer, &why), STATUS_CORRUPT) << "versions 1 and 2 have 160";
    }
    lay32(b, 8, 0);
    EXPECT_EQ(take(sealed(b), &why), STATUS_CORRUPT) << "there never was a version 0";
}

} // namespace
