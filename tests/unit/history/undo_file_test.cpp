/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a stroke's bytes take the clay back and forth exactly, hold nothing that did not change, and are believed only
 *       when every promise of the format holds.
 * Method: strokes of chance against a model that is not clay; bytes checked at places computed from the table in the
 *         header; every flip and cut; forged records under sound checksums; clay that is not what the record expects;
 *         a full sculpture. */
#include "history/undo_file.h"

#include "clay/colour.h"
#include "clay/digest.h"
#include "history/byte_order.h"
#include "tests/unit/history/piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace {

struct recorded {
    byte_buffer b = {};
    undo_file_facts facts = {};
    ~recorded() { byte_buffer_finish(&b); }
    std::vector<uint8_t> bytes() const { return {b.bytes, b.bytes + b.size}; }
};

/* Makes a stroke and its record; the stroke's change is ended. */
void record(clay *c, const piece_stroke &stroke, recorded *out)
{
    out->facts = {.stroke = 7, .digest_before = clay_digest(c), .digest_after = 0, .dab = 99, .ring = 200, .bricks = 0,
                  .corners = 0, .bytes = 0};
    clay_change_begin(c);
    ASSERT_EQ(piece_write(c, stroke), STATUS_OK);
    out->facts.digest_after = clay_digest(c);
    ASSERT_EQ(undo_file_encode(c, &out->facts, &out->b), STATUS_OK);
    clay_change_end(c);
    dirt_clear(&c->dirty);
}

status apply(clay *c, const std::vector<uint8_t> &bytes, undo_file_direction direction)
{
    preamble_trouble why;
    const status s = undo_file_apply(c, bytes.data(), bytes.size(), direction, &why);
    if (s == STATUS_OK)
        clay_change_end(c);
    return s;
}

/* `words`, if there are any, are among those of the refusal. */
status check(const std::vector<uint8_t> &bytes, const std::string &words = "")
{
    undo_file_facts f;
    preamble_trouble why = {UINT64_MAX, ""};
    const status s = undo_file_check(&f, bytes.data(), bytes.size(), &why);
    EXPECT_TRUE(s == STATUS_OK || (why.offset <= bytes.size() && why.expected[0] != '\0'));
    EXPECT_NE(std::string(why.expected).find(words), std::string::npos) << why.expected;
    return s;
}

/* Two bricks, so that their order can be wrong. */
const piece_stroke two_bricks = {{{0, 0, 1}, 1.25f, 0x04030201}, {{0, 0, 9}, 2.5f, 0x08070605}, {{0, 0, 10}, 3, 0}};

/* --- what the bytes say --- */

TEST(undo_file, bytes_are_those_of_the_table)
{
    piece_clay p;
    recorded r;
    ASSERT_EQ(clay_write(&p.c, {0, 0, 9}, 0.5f, 0xaabbccdd), STATUS_OK);
    record(&p.c, two_bricks, &r);
    const std::vector<uint8_t> b = r.bytes();
    ASSERT_EQ(b.size(), 88u + 2 * 88 + 3 * 16);
    EXPECT_EQ(std::memcmp(b.data(), "glundo\r\n", 8), 0);
    EXPECT_EQ(byte_order_get_u32(&b[8]), 1u);
    EXPECT_EQ(byte_order_get_u32(&b[12]), 88u);
    EXPECT_EQ(byte_order_get_u64(&b[16]), 7u);
    EXPECT_EQ(byte_order_get_u64(&b[24]), r.facts.digest_before);
    EXPECT_EQ(byte_order_get_u64(&b[32]), r.facts.digest_after);
    EXPECT_EQ(byte_order_get_u64(&b[40]), 99u);
    EXPECT_EQ(byte_order_get_u64(&b[48]), 2u);
    EXPECT_EQ(byte_order_get_u64(&b[56]), 3u);
    EXPECT_EQ(byte_order_get_u64(&b[64]), b.size());
    EXPECT_EQ(byte_order_get_u32(&b[72]), 200u);
    EXPECT_EQ(byte_order_get_u64(&b[80]), digest_bytes(b.data(), 80, 0));
    const uint8_t *second = &b[88 + 88 + 16]; /* brick (0,0,1), corners 9 and 10 */
    EXPECT_EQ(byte_order_get_u32(second), 0u);
    EXPECT_EQ(byte_order_get_u32(second + 8), 1u);
    EXPECT_EQ(byte_order_get_u32(second + 12), 2u);
    EXPECT_EQ(byte_order_get_u64(second + 16), 0b110u);
    EXPECT_EQ(byte_order_get_float(second + 80), 0.5f);
    EXPECT_EQ(byte_order_get_float(second + 84), 0.0f);
    EXPECT_EQ(byte_order_get_u32(second + 88), 0xaabbccddu);
    EXPECT_EQ(byte_order_get_u32(second + 92), COLOUR_NONE);
    EXPECT_EQ(byte_order_get_float(second + 96), 2.5f);
    EXPECT_EQ(byte_order_get_float(second + 100), 3.0f);
    EXPECT_EQ(byte_order_get_u32(second + 104), 0x08070605u);
    EXPECT_EQ(byte_order_get_u64(second + 112), digest_bytes(second, 112, r.facts.digest_after));
    EXPECT_EQ(check(b), STATUS_OK);
}

TEST(undo_file, what_is_the_same_again_is_not_in_it)
{
    piece_clay p;
    recorded first, again, colour;
    record(&p.c, two_bricks, &first);
    EXPECT_EQ(first.facts.corners, 3u);
    record(&p.c, two_bricks, &again);
    EXPECT_EQ(again.facts.corners, 0u);
    piece_stroke tint = two_bricks;
    tint[1].rgba ^= 1;
    record(&p.c, tint, &colour);
    EXPECT_EQ(colour.facts.corners, 1u);
    EXPECT_EQ(colour.facts.bricks, 1u);
}

TEST(undo_file, order_of_opening_does_not_matter)
{
    piece_clay one, other;
    recorded a, b;
    record(&one.c, two_bricks, &a);
    clay_change_begin(&other.c);
    for (auto at = two_bricks.rbegin(); at != two_bricks.rend(); ++at)
        ASSERT_EQ(piece_write(&other.c, {*at}), STATUS_OK);
    b.facts = a.facts;
    ASSERT_EQ(undo_file_encode(&other.c, &b.facts, &b.b), STATUS_OK);
    EXPECT_EQ(a.bytes(), b.bytes());
}

/* --- back and forth --- */

TEST(undo_file, back_and_forth_is_exact)
{
    piece_clay p;
    piece_model model;
    seeded chance = {11};
    for (int n = 0; n < 300; n++) {
        recorded r;
        const piece_model before = model;
        const piece_stroke stroke = piece_stroke_random(chance, 200);
        record(&p.c, stroke, &r);
        piece_write_model(model, stroke);
        if (r.facts.corners == 0)
            continue;
        ASSERT_EQ(check(r.bytes()), STATUS_OK);
        ASSERT_EQ(apply(&p.c, r.bytes(), UNDO_FILE_BACK), STATUS_OK);
        piece_expect(&p.c, before);
        ASSERT_EQ(clay_digest(&p.c), r.facts.digest_before);
        ASSERT_EQ(apply(&p.c, r.bytes(), UNDO_FILE_FORTH), STATUS_OK);
        piece_expect(&p.c, model);
        ASSERT_EQ(clay_digest(&p.c), r.facts.digest_after);
        dirt_clear(&p.c.dirty);
    }
    EXPECT_GT(model.size(), 100u);
}

TEST(undo_file, marks_exactly_what_changed)
{
    piece_clay p;
    recorded r;
    record(&p.c, two_bricks, &r);
    ASSERT_EQ(apply(&p.c, r.bytes(), UNDO_FILE_BACK), STATUS_OK);
    ASSERT_EQ(dirt_count(&p.c.dirty), 2u);
    uint64_t marked = 0;
    for (uint32_t n = 0; n < 2; n++)
        for (uint64_t word : dirt_at(&p.c.dirty, n)->corners.slab)
            marked += static_cast<uint64_t>(__builtin_popcountll(word));
    EXPECT_EQ(marked, 3u);
    for (const piece_corner &corner : two_bricks) {
        const dirt_entry *dirty = clay_dirt(&p.c, key_brick(corner.at));
        ASSERT_NE(dirty, nullptr);
        EXPECT_TRUE(brick_mask_has(&dirty->corners, key_slot(corner.at)));
    }
}

TEST(undo_file, step_can_be_reverted_by_the_caller)
{
    piece_clay p;
    recorded r;
    preamble_trouble why;
    record(&p.c, two_bricks, &r);
    ASSERT_EQ(undo_file_apply(&p.c, r.b.bytes, r.b.size, UNDO_FILE_BACK, &why), STATUS_OK);
    ASSERT_EQ(clay_digest(&p.c), r.facts.digest_before);
    clay_change_revert(&p.c);
    EXPECT_EQ(clay_digest(&p.c), r.facts.digest_after);
}

TEST(undo_file, clay_that_is_not_the_expected_side_is_left_alone)
{
    const piece_stroke spoils = {{{0, 0, 1}, 1.0f, 0x04030201}, {{0, 0, 1}, 1.25f, 5}, {{0, 0, 9}, 0, 0}};
    for (const piece_corner &spoil : spoils) {
        piece_clay p;
        recorded r;
        record(&p.c, two_bricks, &r);
        ASSERT_EQ(clay_write(&p.c, spoil.at, spoil.potential, spoil.rgba), STATUS_OK);
        dirt_clear(&p.c.dirty);
        const uint64_t digest = clay_digest(&p.c);
        EXPECT_EQ(apply(&p.c, r.bytes(), UNDO_FILE_BACK), STATUS_CORRUPT);
        EXPECT_EQ(clay_digest(&p.c), digest);
        EXPECT_EQ(dirt_count(&p.c.dirty), 0u);
        EXPECT_FALSE(p.c.changes.recording);
    }
    piece_clay p;
    recorded r;
    record(&p.c, two_bricks, &r);
    EXPECT_EQ(apply(&p.c, r.bytes(), UNDO_FILE_FORTH), STATUS_CORRUPT) << "it is forth already";
}

/* --- no room --- */

TEST(undo_file, full_sculpture_steps_back_to_where_it_was)
{
    /* Eight bricks at most: four of them go and four others come, in one stroke. */
    piece_clay p(8);
    piece_stroke first, go, come;
    for (int n = 0; n < 8; n++)
        first.push_back({{8 * n, 0, 0}, 1, 1});
    for (int n = 0; n < 4; n++) {
        go.push_back({{8 * n, 0, 0}, 0, 0});
        come.push_back({{8 * n, 80, 0}, 2, 2});
    }
    ASSERT_EQ(piece_write(&p.c, first), STATUS_OK);
    const uint64_t before = clay_digest(&p.c);
    recorded r;
    r.facts = {.stroke = 1, .digest_before = before, .digest_after = 0, .dab = 0, .ring = 1, .bricks = 0, .corners = 0,
               .bytes = 0};
    clay_change_begin(&p.c);
    ASSERT_EQ(piece_write(&p.c, go), STATUS_OK);
    ASSERT_EQ(piece_write(&p.c, come), STATUS_OK);
    r.facts.digest_after = clay_digest(&p.c);
    ASSERT_EQ(undo_file_encode(&p.c, &r.facts, &r.b), STATUS_OK);
    clay_change_end(&p.c);
    dirt_clear(&p.c.dirty);
    ASSERT_EQ(clay_brick_count(&p.c), 8u);
    ASSERT_EQ(apply(&p.c, r.bytes(), UNDO_FILE_BACK), STATUS_OK);
    EXPECT_EQ(clay_digest(&p.c), before);
    dirt_clear(&p.c.dirty);
    ASSERT_EQ(apply(&p.c, r.bytes(), UNDO_FILE_FORTH), STATUS_OK);
    EXPECT_EQ(clay_digest(&p.c), r.facts.digest_after);
}

TEST(undo_file, no_room_changes_nothing)
{
    piece_clay large, small(1);
    recorded r;
    record(&large.c, two_bricks, &r);
    EXPECT_EQ(apply(&small.c, r.bytes(), UNDO_FILE_FORTH), STATUS_POOL_FULL);
    EXPECT_EQ(clay_brick_count(&small.c), 0u);
    EXPECT_EQ(dirt_count(&small.c.dirty), 0u);
    EXPECT_FALSE(small.c.changes.recording);
}

/* --- bytes that lie --- */

TEST(undo_file, every_flip_and_cut_is_refused)
{
    piece_clay p;
    recorded r;
    record(&p.c, two_bricks, &r);
    const std::vector<uint8_t> good = r.bytes();
    for (size_t bit = 0; bit < good.size() * 8; bit++) {
        std::vector<uint8_t> b = good;
        b[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
        EXPECT_EQ(check(b), STATUS_CORRUPT) << bit;
    }
    for (size_t length = 0; length < good.size(); length++)
        EXPECT_EQ(check({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length)}), STATUS_CORRUPT) << length;
    std::vector<uint8_t> longer = good;
    longer.push_back(0);
    EXPECT_EQ(check(longer), STATUS_CORRUPT);
}

/* Puts sound checksums under whatever else is in the bytes; bricks are found by their counts. */
std::vector<uint8_t> resealed(std::vector<uint8_t> b)
{
    const uint64_t seed = byte_order_get_u64(&b[32]);
    byte_order_put_u64(&b[80], digest_bytes(b.data(), 80, 0));
    for (size_t at = 88; at + 88 <= b.size();) {
        const size_t vouched = 80 + size_t{16} * byte_order_get_u32(&b[at + 12]);
        if (at + vouched + 8 > b.size())
            break;
        byte_order_put_u64(&b[at + vouched], digest_bytes(&b[at], vouched, seed));
        at += vouched + 8;
    }
    return b;
}

struct forgery {
    const char *what;
    size_t at;
    std::vector<uint8_t> bytes;
    const char *words; /* so that the right check refused it, and not a later one by luck */
};

std::vector<uint8_t> le32(uint32_t v)
{
    std::vector<uint8_t> b(4);
    byte_order_put_u32(b.data(), v);
    return b;
}

std::vector<uint8_t> le_float(float v)
{
    std::vector<uint8_t> b(4);
    byte_order_put_float(b.data(), v);
    return b;
}

TEST(undo_file, forged_records_are_refused)
{
    piece_clay p;
    recorded r;
    record(&p.c, two_bricks, &r);
    const std::vector<uint8_t> good = r.bytes();
    ASSERT_EQ(check(resealed(good)), STATUS_OK);
    const size_t first = 88, second = 88 + 88 + 16;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<forgery> all = {
        {"stroke 0", 16, le32(0), "stroke number"},
        {"stroke of 2^63", 16 + 7, {0x80}, "stroke number"},
        {"fewer bricks", 48, le32(1), "follows from the counts"},
        {"more bricks", 48, le32(3), "follows from the counts"},
        {"no bricks", 48, le32(0), "corners a brick"},
        {"more corners", 56, le32(4), "follows from the counts"},
        {"corners beyond any memory", 56 + 7, {0x7f}, "corners a brick"},
        {"another size", 64, le32(static_cast<uint32_t>(good.size() + 16)), "follows from the counts"},
        {"ring of none", 72, le32(0), "ring of 1"},
        {"not zero", 76, le32(1), "then zero"},
        {"count not of the mask", first + 12, le32(2), "as its mask"},
        {"mask not of the count", first + 16, {0xff}, "as its mask"},
        {"count of nothing", first + 12, le32(0), "as its mask"},
        {"count beyond a brick", first + 12, le32(0x10000000), "as its mask"},
        {"keys out of order", first + 8, le32(5), "above the one before"},
        {"the same key twice", first + 8, le32(1), "above the one before"},
        {"key beyond the lattice", second, le32(0x10000000), "within the lattice"},
        {"key in the layer that stays empty", second, le32(INT32_MAX >> 3), "within the lattice"},
        {"new potential above 3", second + 96, le_float(3.01f), "can hold"},
        {"negative", second + 96, le_float(-1), "can hold"},
        {"minus zero", second + 96, le_float(-0.0f), "can hold"},
        {"not a number", second + 96, le_float(nan), "can hold"},
        {"infinite", second + 96, le_float(std::numeric_limits<float>::infinity()), "can hold"},
        {"colour where nothing is", second + 88, le32(7), "can hold"},
        {"absent on both sides", second + 100, le32(0), "changed"},
    };
    for (const forgery &f : all) {
        std::vector<uint8_t> b = good;
        std::copy(f.bytes.begin(), f.bytes.end(), b.begin() + static_cast<std::ptrdiff_t>(f.at));
        ASSERT_NE(b, good) << f.what;
        EXPECT_EQ(check(resealed(b), f.words), STATUS_CORRUPT) << f.what;
    }
}

TEST(undo_file, forged_counts_cannot_add_up_past_the_last_number)
{
    /* 88 + 88 B + 16 C is the size of the file, modulo 2^64, and B <= C <= 512 B, modulo 2^64. */
    piece_clay p;
    recorded r;
    record(&p.c, two_bricks, &r);
    std::vector<uint8_t> b = r.bytes();
    const uint64_t y = UINT64_C(1) << 53, bricks = (UINT64_C(1) << 61) + y;
    const uint64_t corners = 3 * (UINT64_C(1) << 60) + 14 - y / 2 * 11;
    ASSERT_EQ(88 + 88 * bricks + 16 * corners, b.size());
    ASSERT_TRUE(bricks <= corners && corners <= bricks * 512);
    byte_order_put_u64(&b[48], bricks);
    byte_order_put_u64(&b[56], corners);
    EXPECT_EQ(check(resealed(b), "changed corners a brick"), STATUS_CORRUPT);
}

TEST(undo_file, corners_the_header_has_beyond_the_bricks_are_refused)
{
    piece_clay p;
    recorded r;
    record(&p.c, two_bricks, &r);
    std::vector<uint8_t> b = r.bytes();
    b.resize(b.size() + 16);
    byte_order_put_u64(&b[56], 4);
    byte_order_put_u64(&b[64], b.size());
    EXPECT_EQ(check(resealed(b), "the number of corners"), STATUS_CORRUPT);
}

TEST(undo_file, lowest_and_highest_brick_of_the_lattice_pass)
{
    piece_clay p;
    recorded r;
    record(&p.c, {{{KEY_MIN, KEY_MIN, KEY_MIN}, 1, 1}, {{KEY_MAX, KEY_MAX, KEY_MAX}, 1, 1}}, &r);
    EXPECT_EQ(check(r.bytes()), STATUS_OK);
    EXPECT_EQ(apply(&p.c, r.bytes(), UNDO_FILE_BACK), STATUS_OK);
    EXPECT_EQ(clay_brick_count(&p.c), 0u);
}

TEST(undo_file, brick_of_another_stroke_does_not_pass)
{
    piece_clay p;
    recorded one, other;
    record(&p.c, {{{0, 0, 0}, 1, 1}}, &one);
    record(&p.c, {{{0, 0, 0}, 2, 1}}, &other);
    std::vector<uint8_t> mixed = one.bytes();
    const std::vector<uint8_t> b = other.bytes();
    ASSERT_EQ(mixed.size(), b.size());
    std::copy(b.begin() + 88, b.end(), mixed.begin() + 88);
    EXPECT_EQ(check(mixed), STATUS_CORRUPT);
}

TEST(undo_file, newer_version_is_said_to_be_newer)
{
    piece_clay p;
    recorded r;
    record(&p.c, two_bricks, &r);
    std::vector<uint8_t> b = r.bytes();
    byte_order_put_u32(&b[8], 2);
    EXPECT_EQ(check(b), STATUS_CORRUPT) << "its checksum does not hold";
    EXPECT_EQ(check(resealed(b)), STATUS_NEWER);
}

} // namespace
