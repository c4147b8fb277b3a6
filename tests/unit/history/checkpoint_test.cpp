/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the field comes back bit for bit, whole or not at all, and no bytes lead anywhere but to a field or a refusal
 *       that says where.
 * Method: fields of chance against a model that is not clay; bytes looked up by the table in the header, and laid by
 *         it for version 1; every flip and cut of a small file; forged bricks under sound checksums; sources and sinks
 *         that fail or give little. */
#include "history/checkpoint.h"

#include "clay/digest.h"
#include "clay/freeze.h"
#include "history/byte_order.h"
#include "tests/unit/history/piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace {

struct bytes_kept {
    std::vector<uint8_t> bytes;
    size_t at_most = SIZE_MAX;    /* a source gives no more at once */
    uint64_t fail_from = UINT64_MAX; /* offset from which both fail */
    size_t calls = 0;
};

status keep(void *self, const void *bytes, size_t n)
{
    bytes_kept &k = *static_cast<bytes_kept *>(self);
    k.calls++;
    if (k.bytes.size() + n > k.fail_from)
        return STATUS_IO;
    const uint8_t *b = static_cast<const uint8_t *>(bytes);
    k.bytes.insert(k.bytes.end(), b, b + n);
    return STATUS_OK;
}

status give(void *self, uint64_t offset, void *bytes, size_t n, size_t *got)
{
    bytes_kept &k = *static_cast<bytes_kept *>(self);
    k.calls++;
    *got = 0;
    if (offset >= k.fail_from)
        return STATUS_IO;
    if (offset < k.bytes.size())
        *got = std::min({n, k.bytes.size() - static_cast<size_t>(offset), k.at_most});
    if (*got > 0)
        std::memcpy(bytes, k.bytes.data() + offset, *got);
    return STATUS_OK;
}

constexpr checkpoint_facts usual = {.version = 0,
                                    .step_mm = 0.125,
                                    .sequence = 31,
                                    .cursor = 8,
                                    .tip = 12,
                                    .seal = 0x1122334455667788,
                                    .dab = 400,
                                    .bricks = 0,
                                    .digest = 0};

checkpoint_facts facts_of(const clay *c)
{
    checkpoint_facts f = usual;
    f.digest = clay_digest(c);
    return f;
}

bytes_kept written(const clay *c)
{
    bytes_kept k;
    const checkpoint_facts f = facts_of(c);
    EXPECT_EQ(checkpoint_write(c, &f, keep, &k), STATUS_OK);
    return k;
}

status read(clay *c, bytes_kept k, checkpoint_trouble *why)
{
    checkpoint_facts f;
    *why = {};
    return checkpoint_read(c, &f, give, &k, why);
}

void fill(clay *c, piece_model *model, uint64_t seed, int strokes)
{
    seeded chance = {seed};
    for (int n = 0; n < strokes; n++) {
        const piece_stroke stroke = piece_stroke_random(chance, 300, 20);
        ASSERT_EQ(piece_write(c, stroke), STATUS_OK);
        piece_write_model(*model, stroke);
    }
}

/* Two bricks, three corners. */
void fill_small(clay *c)
{
    ASSERT_EQ(piece_write(c, {{{0, 0, 1}, 1.25f, 0x04030201}, {{0, 0, 9}, 2.5f, 0x08070605}, {{0, 0, 10}, 3, 0}}),
              STATUS_OK);
}

TEST(checkpoint, field_comes_back)
{
    piece_clay from, to;
    piece_model model;
    fill(&from.c, &model, 5, 60);
    bytes_kept k = written(&from.c);
    ASSERT_GT(k.bytes.size(), 20000u) << "more than one block";
    checkpoint_facts f;
    checkpoint_trouble why;
    ASSERT_EQ(checkpoint_read(&to.c, &f, give, &k, &why), STATUS_OK);
    piece_expect(&to.c, model);
    EXPECT_EQ(clay_digest(&to.c), clay_digest(&from.c));
    EXPECT_EQ(f.step_mm, usual.step_mm);
    EXPECT_EQ(f.sequence, usual.sequence);
    EXPECT_EQ(f.cursor, usual.cursor);
    EXPECT_EQ(f.tip, usual.tip);
    EXPECT_EQ(f.seal, usual.seal);
    EXPECT_EQ(f.dab, usual.dab);
    EXPECT_EQ(f.digest, clay_digest(&from.c));
    EXPECT_EQ(f.bricks, clay_brick_count(&from.c));
    EXPECT_EQ(written(&to.c).bytes, k.bytes);
}

TEST(checkpoint, sources_may_give_little_at_a_time)
{
    piece_clay from;
    piece_model model;
    fill(&from.c, &model, 6, 10);
    bytes_kept k = written(&from.c);
    for (size_t at_most : {1, 7, 4096}) {
        piece_clay to;
        checkpoint_trouble why;
        k.at_most = at_most;
        ASSERT_EQ(read(&to.c, k, &why), STATUS_OK);
        piece_expect(&to.c, model);
    }
}

TEST(checkpoint, bytes_are_those_of_the_table)
{
    piece_clay p;
    fill_small(&p.c);
    const std::vector<uint8_t> b = written(&p.c).bytes;
    ASSERT_EQ(b.size(), 96u + 2 * 88 + 3 * 8);
    EXPECT_EQ(std::memcmp(b.data(), "glaise\r\n", 8), 0);
    EXPECT_EQ(byte_order_get_u32(&b[8]), 2u);
    EXPECT_EQ(byte_order_get_u32(&b[12]), 96u);
    EXPECT_EQ(byte_order_get_double(&b[16]), 0.125);
    EXPECT_EQ(byte_order_get_u64(&b[24]), 31u);
    EXPECT_EQ(byte_order_get_u64(&b[32]), 400u);
    EXPECT_EQ(byte_order_get_u64(&b[40]), 2u);
    EXPECT_EQ(byte_order_get_u64(&b[48]), clay_digest(&p.c));
    EXPECT_EQ(byte_order_get_u64(&b[56]), 8u);
    EXPECT_EQ(byte_order_get_u64(&b[64]), 12u);
    EXPECT_EQ(byte_order_get_u64(&b[72]), 0x1122334455667788u);
    EXPECT_EQ(byte_order_get_u64(&b[80]), 0u);
    EXPECT_EQ(byte_order_get_u64(&b[88]), digest_bytes(b.data(), 88, 0));
    const uint8_t *second = &b[96 + 88 + 8];
    EXPECT_EQ(byte_order_get_u32(second + 8), 1u);
    EXPECT_EQ(byte_order_get_u32(second + 12), 2u);
    EXPECT_EQ(byte_order_get_u64(second + 16), 0b110u);
    EXPECT_EQ(byte_order_get_float(second + 80), 2.5f);
    EXPECT_EQ(byte_order_get_float(second + 84), 3.0f);
    EXPECT_EQ(byte_order_get_u32(second + 88), 0x08070605u);
    EXPECT_EQ(byte_order_get_u64(second + 96), digest_bytes(second, 96, 0));
}

TEST(checkpoint, empty_clay_is_a_header)
{
    piece_clay from, to;
    const bytes_kept k = written(&from.c);
    EXPECT_EQ(k.bytes.size(), 96u);
    fill_small(&to.c);
    checkpoint_trouble why;
    ASSERT_EQ(read(&to.c, k, &why), STATUS_OK);
    EXPECT_EQ(clay_brick_count(&to.c), 0u);
}

TEST(checkpoint, same_field_same_bytes_however_it_came_to_be)
{
    piece_clay one, other;
    piece_model model;
    fill(&one.c, &model, 8, 12);
    for (auto at = model.rbegin(); at != model.rend(); ++at)
        ASSERT_EQ(clay_write(&other.c, {std::get<0>(at->first), std::get<1>(at->first), std::get<2>(at->first)},
                             at->second.first, at->second.second),
                  STATUS_OK);
    EXPECT_EQ(written(&one.c).bytes, written(&other.c).bytes);
}

TEST(checkpoint, facts_alone_cost_no_more_than_a_block)
{
    piece_clay p;
    piece_model model;
    fill(&p.c, &model, 5, 60);
    bytes_kept k = written(&p.c);
    k.fail_from = 16384;
    checkpoint_facts f;
    checkpoint_trouble why;
    ASSERT_EQ(checkpoint_read_facts(&f, give, &k, &why), STATUS_OK);
    EXPECT_EQ(f.bricks, clay_brick_count(&p.c));
    EXPECT_EQ(f.step_mm, usual.step_mm);
}

TEST(checkpoint, written_bit_by_bit_it_is_the_same)
{
    piece_clay p;
    piece_model model;
    fill(&p.c, &model, 5, 60);
    const bytes_kept whole = written(&p.c);
    const checkpoint_facts f = facts_of(&p.c);
    for (const size_t slice : {size_t{1}, size_t{5000}, size_t{16384}, size_t{100000}, SIZE_MAX}) {
        bytes_kept k;
        auto w = std::make_unique<checkpoint_writer>();
        checkpoint_writer_begin(w.get(), &p.c, &f, keep, &k);
        size_t steps = 0;
        for (bool done = false; !done; steps++) {
            const size_t before = k.bytes.size() + w->used;
            ASSERT_EQ(checkpoint_writer_step(w.get(), slice, &done), STATUS_OK);
            const size_t put = k.bytes.size() + w->used - before;
            ASSERT_TRUE(done || put >= slice) << "as much as was asked for";
            ASSERT_LE(put, slice < SIZE_MAX - 5000 ? slice + 4184 : SIZE_MAX) << "or a brick more";
        }
        EXPECT_EQ(k.bytes, whole.bytes) << slice;
        EXPECT_EQ(steps > 1, slice < whole.bytes.size()) << slice;
    }
}

TEST(checkpoint, still_of_a_clay_that_goes_on_is_written_as_it_was)
{
    piece_clay p;
    piece_model model;
    seeded chance = {3};
    fill(&p.c, &model, 5, 60);
    const bytes_kept before = written(&p.c);
    const checkpoint_facts f = facts_of(&p.c);
    freeze still;
    ASSERT_EQ(freeze_begin(&still, &p.c), STATUS_OK);
    bytes_kept k;
    auto w = std::make_unique<checkpoint_writer>();
    checkpoint_writer_begin(w.get(), &still.still, &f, keep, &k);
    for (bool done = false; !done;) {
        ASSERT_EQ(checkpoint_writer_step(w.get(), 5000, &done), STATUS_OK);
        ASSERT_EQ(piece_write(&p.c, piece_stroke_random(chance, 300, 20)), STATUS_OK);
    }
    freeze_end(&still);
    EXPECT_EQ(k.bytes, before.bytes);
    EXPECT_NE(written(&p.c).bytes, before.bytes);
}

/* --- version 1 --- */

/* The two bricks of fill_small under the header that version 1 had, laid by hand. */
bytes_kept laid_by_version_1(uint64_t digest)
{
    bytes_kept k;
    std::vector<uint8_t> &b = k.bytes;
    b.resize(64 + 2 * 88 + 3 * 8);
    std::memcpy(b.data(), "glaise\r\n", 8);
    byte_order_put_u32(&b[8], 1);
    byte_order_put_u32(&b[12], 64);
    byte_order_put_double(&b[16], 0.125);
    byte_order_put_u64(&b[24], 31);
    byte_order_put_u64(&b[32], 400);
    byte_order_put_u64(&b[40], 2);
    byte_order_put_u64(&b[48], digest);
    byte_order_put_u64(&b[56], digest_bytes(b.data(), 56, 0));
    uint8_t *first = &b[64], *second = &b[64 + 88 + 8];
    byte_order_put_u32(first + 12, 1);
    byte_order_put_u64(first + 16, 0b10);
    byte_order_put_float(first + 80, 1.25f);
    byte_order_put_u32(first + 84, 0x04030201);
    byte_order_put_u64(first + 88, digest_bytes(first, 88, 0));
    byte_order_put_u32(second + 8, 1);
    byte_order_put_u32(second + 12, 2);
    byte_order_put_u64(second + 16, 0b110);
    byte_order_put_float(second + 80, 2.5f);
    byte_order_put_float(second + 84, 3);
    byte_order_put_u32(second + 88, 0x08070605);
    byte_order_put_u64(second + 96, digest_bytes(second, 96, 0));
    return k;
}

TEST(checkpoint, version_1_is_still_read)
{
    piece_clay from, to;
    fill_small(&from.c);
    bytes_kept k = laid_by_version_1(clay_digest(&from.c));
    checkpoint_facts f;
    checkpoint_trouble why;
    ASSERT_EQ(checkpoint_read(&to.c, &f, give, &k, &why), STATUS_OK) << why.expected;
    EXPECT_EQ(clay_digest(&to.c), clay_digest(&from.c));
    for (int alone = 0; alone < 2; alone++) {
        EXPECT_EQ(f.step_mm, 0.125);
        EXPECT_EQ(f.cursor, 31u) << "its sequence was the stroke after which the clay stood";
        EXPECT_EQ(f.tip, 31u);
        EXPECT_EQ(f.sequence, 0u) << "no record had been written then";
        EXPECT_EQ(f.seal, 0u);
        EXPECT_EQ(f.dab, 400u);
        EXPECT_EQ(f.bricks, 2u);
        EXPECT_EQ(f.digest, clay_digest(&from.c));
        ASSERT_EQ(checkpoint_read_facts(&f, give, &k, &why), STATUS_OK);
    }
    for (size_t bit = 0; bit < k.bytes.size() * 8; bit++) {
        bytes_kept spoilt = k;
        spoilt.bytes[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
        EXPECT_EQ(read(&to.c, spoilt, &why), STATUS_CORRUPT) << bit;
    }
    for (size_t length = 0; length < k.bytes.size(); length++) {
        bytes_kept cut = k;
        cut.bytes.resize(length);
        EXPECT_EQ(read(&to.c, cut, &why), STATUS_CORRUPT) << length;
    }
    EXPECT_EQ(clay_digest(&to.c), clay_digest(&from.c)) << "and nothing changed meanwhile";
}

TEST(checkpoint, version_1_with_the_header_of_2_is_refused)
{
    piece_clay p;
    fill_small(&p.c);
    bytes_kept k = written(&p.c);
    byte_order_put_u32(&k.bytes[8], 1);
    byte_order_put_u64(&k.bytes[88], digest_bytes(k.bytes.data(), 88, 0));
    checkpoint_trouble why;
    piece_clay to;
    EXPECT_EQ(read(&to.c, k, &why), STATUS_CORRUPT);
    EXPECT_EQ(why.offset, 8u);
    bytes_kept other = laid_by_version_1(clay_digest(&p.c));
    byte_order_put_u32(&other.bytes[8], 2);
    byte_order_put_u64(&other.bytes[56], digest_bytes(other.bytes.data(), 56, 0));
    EXPECT_EQ(read(&to.c, other, &why), STATUS_CORRUPT);
}

/* --- dirt --- */

TEST(checkpoint, old_and_new_bricks_are_dirty_afterwards)
{
    piece_clay from, to;
    fill_small(&from.c);
    ASSERT_EQ(clay_write(&to.c, {100, 0, 0}, 1, 1), STATUS_OK);
    dirt_clear(&to.c.dirty);
    ASSERT_EQ(clay_write(&to.c, {200, 0, 0}, 1, 1), STATUS_OK);
    ASSERT_EQ(clay_write(&to.c, {200, 0, 0}, 0, 0), STATUS_OK);
    checkpoint_trouble why;
    ASSERT_EQ(read(&to.c, written(&from.c), &why), STATUS_OK);
    for (const key at : {key{0, 0, 1}, key{0, 0, 9}, key{0, 0, 10}, key{100, 0, 0}, key{200, 0, 0}}) {
        const dirt_entry *dirty = clay_dirt(&to.c, key_brick(at));
        ASSERT_NE(dirty, nullptr) << at.i << " " << at.k;
        EXPECT_TRUE(brick_mask_has(&dirty->corners, key_slot(at)));
    }
}

/* --- trouble --- */

/* The clay that was there is there still. */
void expect_refused(const bytes_kept &k, status expected, const std::string &what, const std::string &words = "")
{
    piece_clay to;
    fill_small(&to.c);
    dirt_clear(&to.c.dirty);
    const uint64_t digest = clay_digest(&to.c);
    checkpoint_trouble why;
    EXPECT_EQ(read(&to.c, k, &why), expected) << what;
    EXPECT_EQ(clay_digest(&to.c), digest) << what;
    EXPECT_EQ(dirt_count(&to.c.dirty), 0u) << what;
    EXPECT_LE(why.offset, k.bytes.size()) << what;
    EXPECT_NE(why.expected[0], '\0') << what;
    EXPECT_NE(std::string(why.expected).find(words), std::string::npos) << what << ": " << why.expected;
}

TEST(checkpoint, every_flip_and_cut_and_tail_is_refused)
{
    piece_clay p;
    fill_small(&p.c);
    const bytes_kept good = written(&p.c);
    for (size_t bit = 0; bit < good.bytes.size() * 8; bit++) {
        bytes_kept k = good;
        k.bytes[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
        expect_refused(k, STATUS_CORRUPT, "bit " + std::to_string(bit));
    }
    for (size_t length = 0; length < good.bytes.size(); length++) {
        bytes_kept k = good;
        k.bytes.resize(length);
        expect_refused(k, STATUS_CORRUPT, "cut to " + std::to_string(length));
    }
    bytes_kept k = good;
    k.bytes.push_back(0);
    expect_refused(k, STATUS_CORRUPT, "a byte more");
}

/* Sound checksums under whatever else is in the bytes. */
bytes_kept resealed(bytes_kept k)
{
    std::vector<uint8_t> &b = k.bytes;
    byte_order_put_u64(&b[88], digest_bytes(b.data(), 88, 0));
    for (size_t at = 96; at + 88 <= b.size();) {
        const size_t vouched = 80 + size_t{8} * byte_order_get_u32(&b[at + 12]);
        if (at + vouched + 8 > b.size())
            break;
        byte_order_put_u64(&b[at + vouched], digest_bytes(&b[at], vouched, 0));
        at += vouched + 8;
    }
    return k;
}

TEST(checkpoint, forged_files_are_refused)
{
    piece_clay p;
    fill_small(&p.c);
    const bytes_kept good = written(&p.c);
    const size_t first = 96, second = 96 + 88 + 8;
    struct forgery {
        const char *what;
        status expected;
        size_t at;
        uint32_t word;
        const char *words; /* so that the right check refused it, and not a later one by luck */
    };
    const uint32_t nan = 0x7fc00000, above_3 = 0x40400001, minus_1 = 0xbf800000;
    const std::vector<forgery> all = {
        {"a step that is not a number", STATUS_CORRUPT, 20, 0x7ff80000, "step"},
        {"a step of minus zero", STATUS_CORRUPT, 20, 0x80000000, "step"},
        {"one brick fewer", STATUS_CORRUPT, 40, 1, "end of the file"},
        {"one brick more", STATUS_CORRUPT, 40, 3, "rest of a brick"},
        {"more bricks than there may be", STATUS_POOL_FULL, 44, 1, "no more bricks"},
        {"another digest", STATUS_CORRUPT, 48, 1, "digest of the clay"},
        {"a cursor beyond the tip", STATUS_CORRUPT, 56, 13, "a cursor up to the tip"},
        {"a tip beyond any life", STATUS_CORRUPT, 68, 0x40000001, "a cursor up to the tip"},
        {"a record beyond any life", STATUS_CORRUPT, 28, 0x40000001, "the number of a record"},
        {"not zero", STATUS_CORRUPT, 84, 1, "zero"},
        {"no corners", STATUS_CORRUPT, first + 12, 0, "as many as the mask"},
        {"more corners than the mask has", STATUS_CORRUPT, first + 12, 2, "as many as the mask"},
        {"more corners than the last mask has", STATUS_CORRUPT, second + 12, 3, "as many as the mask"},
        {"corners beyond a brick", STATUS_CORRUPT, first + 12, 0x20000000, "as many as the mask"},
        {"bricks out of order", STATUS_CORRUPT, first + 8, 4, "above the one before"},
        {"the same brick twice", STATUS_CORRUPT, first + 8, 1, "above the one before"},
        {"a brick beyond the lattice", STATUS_CORRUPT, second, 0x40000000, "within the lattice"},
        {"not a number", STATUS_CORRUPT, second + 80, nan, "potentials"},
        {"above 3", STATUS_CORRUPT, second + 84, above_3, "potentials"},
        {"below 0", STATUS_CORRUPT, second + 80, minus_1, "potentials"},
        {"stored, yet empty", STATUS_CORRUPT, second + 80, 0, "potentials"},
    };
    for (const forgery &f : all) {
        bytes_kept k = good;
        byte_order_put_u32(&k.bytes[f.at], f.word);
        ASSERT_NE(k.bytes, good.bytes) << f.what;
        expect_refused(resealed(k), f.expected, f.what, f.words);
    }
    bytes_kept newer = good;
    byte_order_put_u32(&newer.bytes[8], 3);
    expect_refused(newer, STATUS_CORRUPT, "a version whose checksum does not hold");
    expect_refused(resealed(newer), STATUS_NEWER, "a later version");
}

TEST(checkpoint, trouble_says_where)
{
    piece_clay p, to;
    fill_small(&p.c);
    bytes_kept k = written(&p.c);
    byte_order_put_u32(&k.bytes[96 + 8], 4); /* the first brick's key: now after the second's */
    checkpoint_trouble why;
    EXPECT_EQ(read(&to.c, resealed(k), &why), STATUS_CORRUPT);
    EXPECT_EQ(why.offset, 96u + 88 + 8);
    EXPECT_STREQ(why.expected, "a brick key above the one before");
}

TEST(checkpoint, file_too_large_for_the_clay_is_refused_early)
{
    piece_clay from, small(1);
    fill_small(&from.c);
    checkpoint_trouble why;
    EXPECT_EQ(read(&small.c, written(&from.c), &why), STATUS_POOL_FULL);
    EXPECT_EQ(why.offset, 40u);
    EXPECT_EQ(clay_brick_count(&small.c), 0u);
}

TEST(checkpoint, failing_source_is_told)
{
    piece_clay from;
    piece_model model;
    fill(&from.c, &model, 5, 60);
    bytes_kept k = written(&from.c);
    k.fail_from = 16384;
    expect_refused(k, STATUS_IO, "source fails after its first block");
}

TEST(checkpoint, failing_sink_is_told_and_not_asked_again)
{
    piece_clay p;
    piece_model model;
    fill(&p.c, &model, 5, 60);
    bytes_kept k;
    k.fail_from = 20000;
    EXPECT_EQ(checkpoint_write(&p.c, &usual, keep, &k), STATUS_IO);
    EXPECT_EQ(k.calls, 2u);
}

} // namespace
