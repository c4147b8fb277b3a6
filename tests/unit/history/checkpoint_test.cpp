/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the field comes back bit for bit, whole or not at all, and no bytes lead anywhere but to a field or a refusal
 *       that says where.
 * Method: fields of chance against a model that is not clay; bytes looked up by the table in the header, and laid by
 *         it for every version there was; every flip and cut of a small file; forged bricks under sound checksums; sources and sinks
 *         that fail or give little. */
#include "history/checkpoint.h"

#include "clay/digest.h"
#include "clay/freeze.h"
#include "history/byte_order.h"
#include "history/packing.h"
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
    fill(&from.c, &model, 5, 400);
    bytes_kept k = written(&from.c);
    ASSERT_GT(model.size() * 8, 2u * CHECKPOINT_BLOCK_BYTES) << "more than two blocks";
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

/* The two bricks of fill_small; each with its checksum behind it, or none. */
std::vector<uint8_t> laid_bricks(bool vouched)
{
    const size_t sum = vouched ? 8 : 0;
    std::vector<uint8_t> b(88 + 96 + 2 * sum);
    uint8_t *first = b.data(), *second = &b[88 + sum];
    byte_order_put_u32(first + 12, 1);
    byte_order_put_u64(first + 16, 0b10);
    byte_order_put_float(first + 80, 1.25f);
    byte_order_put_u32(first + 84, 0x04030201);
    byte_order_put_u32(second + 8, 1);
    byte_order_put_u32(second + 12, 2);
    byte_order_put_u64(second + 16, 0b110);
    byte_order_put_float(second + 80, 2.5f);
    byte_order_put_float(second + 84, 3);
    byte_order_put_u32(second + 88, 0x08070605);
    if (vouched) {
        byte_order_put_u64(first + 88, digest_bytes(first, 88, 0));
        byte_order_put_u64(second + 96, digest_bytes(second, 96, 0));
    }
    return b;
}

size_t header_bytes(uint32_t version) { return version == 1 ? 64 : 96; }

/* Sound checksums under whatever else is in the bytes: of the header, and of one block. */
bytes_kept resealed(bytes_kept k)
{
    std::vector<uint8_t> &b = k.bytes;
    byte_order_put_u64(&b[88], digest_bytes(b.data(), 88, 0));
    byte_order_put_u64(&b[b.size() - 8], digest_bytes(&b[96], b.size() - 96 - 8, 0));
    return k;
}

/* fill_small as that version had it, laid by hand; version 3 in one block, not packed. */
bytes_kept laid(uint32_t version, uint64_t digest)
{
    bytes_kept k;
    std::vector<uint8_t> &b = k.bytes;
    const size_t header = header_bytes(version);
    b.resize(header);
    std::memcpy(b.data(), "glaise\r\n", 8);
    byte_order_put_u32(&b[8], version);
    byte_order_put_u32(&b[12], static_cast<uint32_t>(header));
    byte_order_put_double(&b[16], 0.125);
    byte_order_put_u64(&b[24], 31);
    byte_order_put_u64(&b[32], 400);
    byte_order_put_u64(&b[40], 2);
    byte_order_put_u64(&b[48], digest);
    if (version > 1) {
        byte_order_put_u64(&b[56], 8);
        byte_order_put_u64(&b[64], 12);
        byte_order_put_u64(&b[72], 0x1122334455667788u);
    }
    byte_order_put_u64(&b[header - 8], digest_bytes(b.data(), header - 8, 0));
    const std::vector<uint8_t> bricks = laid_bricks(version < 3);
    if (version >= 3) {
        b.resize(header + 8);
        byte_order_put_u32(&b[header], static_cast<uint32_t>(bricks.size()));
        byte_order_put_u32(&b[header + 4], static_cast<uint32_t>(bricks.size()));
    }
    b.insert(b.end(), bricks.begin(), bricks.end());
    b.resize(b.size() + (version >= 3 ? 8 : 0));
    return version >= 3 ? resealed(k) : k;
}

TEST(checkpoint, bytes_are_those_of_the_table)
{
    piece_clay p;
    fill_small(&p.c);
    const std::vector<uint8_t> b = written(&p.c).bytes, expected = laid(3, clay_digest(&p.c)).bytes;
    EXPECT_EQ(std::vector<uint8_t>(b.begin(), b.begin() + 96),
              std::vector<uint8_t>(expected.begin(), expected.begin() + 96));
    const std::vector<uint8_t> bricks = laid_bricks(false);
    const uint32_t stored = byte_order_get_u32(&b[100]);
    EXPECT_EQ(byte_order_get_u32(&b[96]), bricks.size());
    EXPECT_LT(stored, bricks.size()) << "so much of nothing can be packed";
    ASSERT_EQ(b.size(), 104u + stored + 8);
    std::vector<uint8_t> unpacked(bricks.size());
    ASSERT_EQ(packing_unpack(unpacked.data(), unpacked.size(), &b[104], stored), STATUS_OK);
    EXPECT_EQ(unpacked, bricks);
    EXPECT_EQ(byte_order_get_u64(&b[104 + stored]), digest_bytes(&b[96], 8 + stored, 0));
}

TEST(checkpoint, block_that_cannot_be_packed_is_read_as_it_is)
{
    piece_clay from, to;
    fill_small(&from.c);
    checkpoint_trouble why;
    ASSERT_EQ(read(&to.c, laid(3, clay_digest(&from.c)), &why), STATUS_OK) << why.expected;
    EXPECT_EQ(clay_digest(&to.c), clay_digest(&from.c));
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
    fill(&p.c, &model, 5, 400);
    bytes_kept k = written(&p.c);
    ASSERT_GT(k.bytes.size(), CHECKPOINT_BLOCK_BYTES);
    k.fail_from = CHECKPOINT_BLOCK_BYTES;
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
    size_t bricks = 0;
    for (const auto &[at, corner] : model)
        bricks += corner.first > 0 ? 8 : 0;
    for (const size_t slice : {size_t{1}, size_t{5000}, size_t{16384}, size_t{100000}, SIZE_MAX}) {
        bytes_kept k;
        packing *with = packing_open();
        auto w = std::make_unique<checkpoint_writer>();
        checkpoint_writer_begin(w.get(), &p.c, &f, with, keep, &k);
        size_t steps = 0;
        for (bool done = false; !done; steps++)
            ASSERT_EQ(checkpoint_writer_step(w.get(), slice, &done), STATUS_OK);
        packing_close(with);
        EXPECT_EQ(k.bytes, whole.bytes) << slice;
        EXPECT_LE(steps, 2 + bricks * 11 / slice) << "80 bytes a brick beside its corners, and there are few corners";
        EXPECT_GE(steps, 1 + bricks / (slice < SIZE_MAX / 2 ? slice + 4176 : SIZE_MAX)) << "or a brick more";
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
    packing *with = packing_open();
    auto w = std::make_unique<checkpoint_writer>();
    checkpoint_writer_begin(w.get(), &still.still, &f, with, keep, &k);
    for (bool done = false; !done;) {
        ASSERT_EQ(checkpoint_writer_step(w.get(), 5000, &done), STATUS_OK);
        ASSERT_EQ(piece_write(&p.c, piece_stroke_random(chance, 300, 20)), STATUS_OK);
    }
    freeze_end(&still);
    packing_close(with);
    EXPECT_EQ(k.bytes, before.bytes);
    EXPECT_NE(written(&p.c).bytes, before.bytes);
}

/* --- versions that were --- */

TEST(checkpoint, earlier_versions_are_still_read)
{
    piece_clay from, to;
    fill_small(&from.c);
    for (const uint32_t version : {1u, 2u}) {
        SCOPED_TRACE(version);
        bytes_kept k = laid(version, clay_digest(&from.c));
        checkpoint_facts f;
        checkpoint_trouble why;
        ASSERT_EQ(checkpoint_read(&to.c, &f, give, &k, &why), STATUS_OK) << why.expected;
        EXPECT_EQ(clay_digest(&to.c), clay_digest(&from.c));
        for (int alone = 0; alone < 2; alone++) {
            EXPECT_EQ(f.version, version);
            EXPECT_EQ(f.step_mm, 0.125);
            EXPECT_EQ(f.cursor, version == 1 ? 31u : 8u) << "its sequence was the stroke after which the clay stood";
            EXPECT_EQ(f.tip, version == 1 ? 31u : 12u);
            EXPECT_EQ(f.sequence, version == 1 ? 0u : 31u) << "no record had been written then";
            EXPECT_EQ(f.seal, version == 1 ? 0u : 0x1122334455667788u);
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
}

TEST(checkpoint, version_with_the_header_or_the_body_of_another_is_refused)
{
    piece_clay p, to;
    fill_small(&p.c);
    checkpoint_trouble why;
    for (const uint32_t version : {1u, 2u, 3u})
        for (const uint32_t other : {1u, 2u, 3u}) {
            bytes_kept k = laid(version, clay_digest(&p.c));
            const size_t vouched = header_bytes(version) - 8;
            byte_order_put_u32(&k.bytes[8], other);
            byte_order_put_u64(&k.bytes[vouched], digest_bytes(k.bytes.data(), vouched, 0));
            EXPECT_EQ(read(&to.c, k, &why), other == version ? STATUS_OK : STATUS_CORRUPT) << version << other;
        }
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

TEST(checkpoint, forged_files_are_refused)
{
    piece_clay p;
    fill_small(&p.c);
    const bytes_kept good = laid(3, clay_digest(&p.c));
    const size_t first = 96 + 8, second = 96 + 8 + 88;
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
        {"one brick more", STATUS_CORRUPT, 40, 3, "rest of the bricks"},
        {"a block of nothing", STATUS_CORRUPT, 96, 0, "a block of"},
        {"a block beyond any", STATUS_CORRUPT, 96, 65537, "a block of"},
        {"a block of less than follows", STATUS_CORRUPT, 96, 183, "a block of"},
        {"a block that nothing follows", STATUS_CORRUPT, 100, 0, "a block of"},
        {"a block of more than the file has", STATUS_CORRUPT, 100, 0xffffffff, "a block of"},
        {"a block said to be packed", STATUS_CORRUPT, 96, 185, "unpack"},
        {"a block said to be packed well", STATUS_CORRUPT, 96, 65536, "unpack"},
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
    byte_order_put_u32(&newer.bytes[8], 4);
    expect_refused(newer, STATUS_CORRUPT, "a version whose checksum does not hold");
    expect_refused(resealed(newer), STATUS_NEWER, "a later version");
}

TEST(checkpoint, trouble_says_where)
{
    piece_clay p, to;
    fill_small(&p.c);
    bytes_kept k = laid(3, clay_digest(&p.c));
    byte_order_put_u32(&k.bytes[96 + 8 + 8], 4); /* the first brick's key: now after the second's */
    checkpoint_trouble why;
    EXPECT_EQ(read(&to.c, resealed(k), &why), STATUS_CORRUPT);
    EXPECT_EQ(why.offset, 96u) << "the block that it lies in";
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
    fill(&from.c, &model, 5, 400);
    bytes_kept k = written(&from.c);
    ASSERT_GT(k.bytes.size(), CHECKPOINT_BLOCK_BYTES + 1000u);
    k.fail_from = CHECKPOINT_BLOCK_BYTES;
    expect_refused(k, STATUS_IO, "source fails after its first blocks");
}

TEST(checkpoint, failing_sink_is_told_and_not_asked_again)
{
    piece_clay p;
    piece_model model;
    fill(&p.c, &model, 5, 60);
    bytes_kept k;
    k.fail_from = 1000;
    EXPECT_EQ(checkpoint_write(&p.c, &usual, keep, &k), STATUS_IO);
    EXPECT_EQ(k.calls, 2u) << "the header, and a block";
}

} // namespace
