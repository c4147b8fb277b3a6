/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal    No bytes make the readers of records read outside them or change clay in part; what they let pass takes the
 *         clay where a plain reading of the same bytes says, and back, and the same change makes the same bytes.
 * Method  The first byte chooses: the rest are a record; a record whose checksums are put right; or corners of a
 *         stroke, whose record, packed or not, must pass, and is then changed in up to four places, its checksums
 *         perhaps put right.
 *         The plain reading turns bits over corner by corner, in clay of its own.
 */
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "clay/delta.h"
#include "clay/digest.h"
#include "clay/sieve_rows.h"
#include "history/byte_order.h"
#include "history/record.h"
#include "history/route.h"

namespace {

enum { BRICKS = 32, HEADER = RECORD_HEADER_BYTES, CORNER_PROGRAM_BYTES = 6, CHANGE_BYTES = 3, CHANGES_MAX = 4 };

using byte_string = std::vector<uint8_t>;

void require(bool truth)
{
    if (!truth) {
        std::abort();
    }
}

void put_checksums_right(byte_string &b)
{
    if (b.size() < HEADER)
        return;
    const uint64_t stored = b.size() - HEADER;
    byte_order_put_u64(&b[136], byte_order_get_u32(&b[8]) == 1 ? 0 : stored);
    if (byte_order_get_u64(&b[120]) < stored) /* more: they are said to be packed */
        byte_order_put_u64(&b[120], stored);
    byte_order_put_u64(&b[144], digest_bytes(b.data() + HEADER, b.size() - HEADER, byte_order_get_u64(&b[16])));
    byte_order_put_u64(&b[152], digest_bytes(b.data(), 152, 0));
}

/* Six bytes a corner: place, potential, colour. */
void write_corners(clay &c, const uint8_t *bytes, size_t size)
{
    for (; size >= CORNER_PROGRAM_BYTES; bytes += CORNER_PROGRAM_BYTES, size -= CORNER_PROGRAM_BYTES) {
        const key at = {static_cast<int8_t>(bytes[0]), static_cast<int8_t>(bytes[1]), static_cast<int8_t>(bytes[2])};
        const float potential = static_cast<float>(bytes[3]) / 80;
        const status s = clay_write(&c, at, potential, static_cast<uint32_t>(bytes[4] << 8 | bytes[5]));
        require(s == STATUS_OK || s == STATUS_POOL_FULL);
    }
}

/* The bricks of the change under way, which goes on. */
byte_string bricks_of_change(clay &c, uint32_t *bricks_out)
{
    byte_string all, one(size_t{RECORD_BRICK_BYTES_MAX} + SIEVE_ROWS_SLACK_BYTES);
    delta d = {};
    require(delta_cut(&d, &c) == STATUS_OK);
    delta_sort(&d);
    *bricks_out = 0;
    for (uint32_t n = 0; n < d.count; n++) {
        const delta_brick *b = &d.bricks[n];
        const size_t took = record_put_brick(one.data(), b->at, b->old, b->now, c.rows);
        all.insert(all.end(), one.begin(), one.begin() + static_cast<std::ptrdiff_t>(took));
        *bricks_out += took > 0;
    }
    delta_give(&d, &c);
    delta_finish(&d);
    return all;
}

/* --- the plain reading --- */

enum class plainly { no_clay, no_room, done };

uint32_t word_at(const byte_string &b, size_t at) { return byte_order_get_u32(&b.at(at)); }

/* Turns over in `to` what the bricks say. */
plainly turn_over(clay &to, const byte_string &b, uint32_t bricks)
{
    size_t at = 0;
    bool room = true;
    for (uint32_t brick = 0; brick < bricks; brick++) {
        const key first = {static_cast<int32_t>(word_at(b, at)) * 8, static_cast<int32_t>(word_at(b, at + 4)) * 8,
                           static_cast<int32_t>(word_at(b, at + 8)) * 8};
        const uint32_t corners = word_at(b, at + 12);
        uint32_t n = 0;
        for (int slot = 0; slot < BRICK_CORNERS; slot++) {
            if (!(b.at(at + 16 + static_cast<size_t>(slot / 8)) >> slot % 8 & 1))
                continue;
            const key corner = key_add(first, slot / 64, slot / 8 % 8, slot % 8);
            uint32_t rgba, bits;
            float potential = clay_read(&to, corner, &rgba);
            std::memcpy(&bits, &potential, 4);
            bits ^= word_at(b, at + 80 + size_t{4} * n);
            rgba ^= word_at(b, at + 80 + size_t{4} * (corners + n));
            std::memcpy(&potential, &bits, 4);
            if (bits == 0 ? rgba != 0 : !(potential > 0 && potential <= 3))
                return plainly::no_clay;
            room = clay_write(&to, corner, potential, rgba) == STATUS_OK && room;
            n++;
        }
        at += 80 + size_t{8} * corners;
    }
    return room && clay_brick_count(&to) <= BRICKS ? plainly::done : plainly::no_room;
}

status go(clay &c, const byte_string &bricks, uint64_t before, uint64_t after)
{
    route r = {};
    uint8_t *own = static_cast<uint8_t *>(std::malloc(bricks.size())); /* exact, so that reading beyond traps */
    std::memcpy(own, bricks.data(), bricks.size());
    require(route_add(&r, own, bricks.size(), 0) == STATUS_OK);
    r.digest_before = before;
    r.digest_after = after;
    dirt_clear(&c.dirty);
    const status s = route_apply(&r, &c);
    route_finish(&r);
    return s;
}

/* Over bricks that passed, and back. */
void forth_and_back(clay &c, const byte_string &bricks, uint32_t count)
{
    const uint64_t before = clay_digest(&c);
    clay plain;
    require(clay_init(&plain, 64 * BRICKS) == STATUS_OK && clay_copy(&plain, &c) == STATUS_OK);
    const plainly expected = turn_over(plain, bricks, count);
    const uint64_t after = clay_digest(&plain);
    clay_finish(&plain);
    const status s = go(c, bricks, before, after);
    if (s == STATUS_OK) {
        uint32_t bricks_again;
        require(expected == plainly::done && clay_is_valid(&c) && clay_digest(&c) == after);
        require(bricks_of_change(c, &bricks_again) == bricks && bricks_again == count);
        clay_change_end(&c);
        require(go(c, bricks, after, before) == STATUS_OK);
        clay_change_end(&c);
        require(go(c, bricks, before, after + 1) == STATUS_CORRUPT); /* it would end elsewhere */
    } else {
        require(expected == plainly::no_clay ? s == STATUS_CORRUPT || s == STATUS_POOL_FULL : s == STATUS_POOL_FULL);
    }
    require(!c.changes.recording && clay_is_valid(&c) && clay_digest(&c) == before);
}

/* --- the bytes --- */

bool read_record(clay &c, const byte_string &b)
{
    const byte_string head(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(std::min<size_t>(b.size(), 512)));
    record r = {};
    preamble_trouble trouble = {UINT64_MAX, nullptr};
    status s = record_read(&r, head.data(), head.size(), &trouble);
    if (s == STATUS_OK && r.stored > b.size() - HEADER)
        return false; /* the ring looks at that */
    if (s == STATUS_OK) {
        const byte_string stored(b.begin() + HEADER, b.begin() + HEADER + static_cast<std::ptrdiff_t>(r.stored));
        byte_string bricks(static_cast<size_t>(r.bytes));
        s = record_check(&r, stored.data(), bricks.data(), &trouble);
        if (s == STATUS_OK && r.bricks > 0)
            forth_and_back(c, bricks, r.bricks);
    }
    require(s == STATUS_OK || (trouble.expected != nullptr && trouble.offset <= std::max<size_t>(b.size(), r.bytes)));
    return s == STATUS_OK;
}

/* Three bytes a change: where, and what is turned over there. */
void spoil(byte_string &file, const uint8_t *bytes, size_t changes)
{
    for (; changes > 0; bytes += CHANGE_BYTES, changes--)
        file[static_cast<size_t>(bytes[0] << 8 | bytes[1]) % file.size()] ^= bytes[2];
}

packing *const packer = packing_open();

void make_and_spoil(clay &c, const uint8_t *bytes, size_t size)
{
    const size_t head = 1 + CHANGE_BYTES * CHANGES_MAX;
    if (size < head)
        return;
    const size_t before = (size - head) / 2;
    write_corners(c, bytes + head, before);
    record r = {};
    r.sequence = r.use = 2u + bytes[0];
    r.stroke = r.cursor = r.tip = 1u + bytes[0];
    r.marks = RECORD_WHOLE;
    r.step_mm = 1;
    r.digest_before = clay_digest(&c);
    clay_change_begin(&c);
    write_corners(c, bytes + head + before, size - head - before);
    r.digest_after = clay_digest(&c);
    const byte_string bricks = bricks_of_change(c, &r.bricks);
    clay_change_end(&c);
    if (bricks.empty())
        return;
    require(go(c, bricks, r.digest_after, r.digest_before) == STATUS_OK);
    clay_change_end(&c);
    r.bytes = r.stored = bricks.size();
    byte_string file(HEADER);
    file.insert(file.end(), bricks.begin(), bricks.end());
    if (bytes[0] & 64)
        record_pack(&r, packer, &file[HEADER], bricks.data());
    file.resize(HEADER + r.stored);
    record_seal(&r, file.data());
    require(read_record(c, file));
    spoil(file, bytes + 1, 1 + (bytes[0] >> 1) % CHANGES_MAX);
    if (bytes[0] & 1)
        put_checksums_right(file);
    (void)read_record(c, file);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    if (size < 1)
        return 0;
    clay c;
    require(clay_init(&c, BRICKS) == STATUS_OK);
    byte_string file(bytes + 1, bytes + size);
    switch (bytes[0] % 3) {
    case 0: (void)read_record(c, file); break;
    case 1:
        put_checksums_right(file);
        (void)read_record(c, file);
        break;
    default: make_and_spoil(c, bytes + 1, size - 1); break;
    }
    clay_finish(&c);
    return 0;
}
