/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal    No bytes make the reader of sculpture files read outside them, allocate more than they could hold, or change
 *         the clay without saying STATUS_OK; and what it accepts is a field whose file has those bricks and no others.
 * Method  The first byte chooses: the rest are a file; a file whose checksums are put right; or corners to write into
 *         clay, whose file, of any version, packed or not, must pass, and is then changed in up to four places, its
 *         checksums perhaps put right.
 */
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "clay/digest.h"
#include "history/byte_order.h"
#include "history/checkpoint.h"
#include "history/packing.h"

namespace {

enum {
    BRICKS = 32,
    HEADER = CHECKPOINT_HEADER_BYTES,
    HEADER_1 = 64,
    CORNER_PROGRAM_BYTES = 6,
    CHANGE_BYTES = 3,
    CHANGES_MAX = 4
};

using byte_string = std::vector<uint8_t>;

void require(bool truth)
{
    if (!truth) {
        std::abort();
    }
}

status keep(void *self, const void *bytes, size_t n)
{
    byte_string &out = *static_cast<byte_string *>(self);
    const uint8_t *b = static_cast<const uint8_t *>(bytes);
    out.insert(out.end(), b, b + n);
    return STATUS_OK;
}

/* Gives an exact-size copy, so that reading beyond what was asked for traps. */
status give(void *self, uint64_t offset, void *bytes, size_t n, size_t *got)
{
    const byte_string &in = *static_cast<const byte_string *>(self);
    *got = offset < in.size() ? std::min(n, in.size() - static_cast<size_t>(offset)) : 0;
    if (*got > 0)
        std::memcpy(bytes, in.data() + offset, *got);
    return STATUS_OK;
}

uint32_t version_of(const byte_string &b) { return b.size() >= HEADER_1 ? byte_order_get_u32(&b[8]) : 3; }

/* Bytes of the header that the version has. */
size_t header_of(const byte_string &b) { return version_of(b) == 1 ? size_t{HEADER_1} : size_t{HEADER}; }

void put_checksums_right(byte_string &b)
{
    const size_t header = header_of(b);
    if (b.size() < header)
        return;
    byte_order_put_u64(&b[header - 8], digest_bytes(b.data(), header - 8, 0));
    const bool blocks = version_of(b) >= 3;
    for (size_t at = header; at + (blocks ? 8 : 88) <= b.size();) {
        const uint64_t vouched = blocks ? 8 + uint64_t{byte_order_get_u32(&b[at + 4])}
                                        : 80 + uint64_t{8} * byte_order_get_u32(&b[at + 12]);
        if (vouched + 8 > b.size() - at)
            return;
        byte_order_put_u64(&b[at + vouched], digest_bytes(&b[at], vouched, 0));
        at += vouched + 8;
    }
}

byte_string file_of(const clay &c, const checkpoint_facts &facts)
{
    byte_string out;
    require(checkpoint_write(&c, &facts, keep, &out) == STATUS_OK);
    return out;
}

/* The bricks of a sound file, as version 3 has them in its blocks. */
byte_string bricks_of(const byte_string &file)
{
    byte_string all;
    for (size_t at = header_of(file); at < file.size();) {
        if (version_of(file) >= 3) {
            const uint32_t bytes = byte_order_get_u32(&file[at]), stored = byte_order_get_u32(&file[at + 4]);
            all.resize(all.size() + bytes);
            require(packing_unpack(&all[all.size() - bytes], bytes, &file[at + 8], stored) == STATUS_OK);
            at += 8 + size_t{stored} + 8;
        } else {
            const size_t bytes = 80 + size_t{8} * byte_order_get_u32(&file[at + 12]);
            all.insert(all.end(), &file[at], &file[at] + bytes);
            at += bytes + 8;
        }
    }
    return all;
}

/* The same field as another version wrote it; version 3: in one block that is not packed. */
byte_string as_version(uint32_t version, const byte_string &file, uint64_t cursor)
{
    const size_t header = version == 1 ? size_t{HEADER_1} : size_t{HEADER};
    const byte_string bricks = bricks_of(file);
    byte_string out(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(header));
    byte_order_put_u32(&out[8], version);
    byte_order_put_u32(&out[12], static_cast<uint32_t>(header));
    if (version == 1)
        byte_order_put_u64(&out[24], cursor);
    if (version >= 3) {
        const size_t bytes = bricks.size();
        out.resize(header + 8 + bytes + 8);
        byte_order_put_u32(&out[header], static_cast<uint32_t>(bytes));
        byte_order_put_u32(&out[header + 4], static_cast<uint32_t>(bytes));
        std::copy(bricks.begin(), bricks.end(), out.begin() + static_cast<std::ptrdiff_t>(header) + 8);
    }
    for (size_t at = 0; version < 3 && at < bricks.size();) {
        const size_t bytes = 80 + size_t{8} * byte_order_get_u32(&bricks[at + 12]);
        out.insert(out.end(), &bricks[at], &bricks[at] + bytes);
        out.resize(out.size() + 8);
        at += bytes;
    }
    put_checksums_right(out);
    return out;
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

status read_file(byte_string file)
{
    clay c;
    checkpoint_facts facts;
    checkpoint_trouble trouble;
    require(clay_init(&c, BRICKS) == STATUS_OK);
    require(clay_write(&c, {3, 4, 5}, 1, 7) == STATUS_OK);
    const uint64_t digest = clay_digest(&c);
    const status s = checkpoint_read(&c, &facts, give, &file, &trouble);
    if (s == STATUS_OK) {
        require(clay_is_valid(&c) && clay_digest(&c) == facts.digest && clay_brick_count(&c) == facts.bricks);
        const byte_string again = file_of(c, facts);
        require(bricks_of(again) == bricks_of(file));
        require(version_of(file) < 3 || std::equal(again.begin(), again.begin() + HEADER, file.begin()));
    } else {
        require(clay_digest(&c) == digest && trouble.offset <= file.size() && trouble.expected[0] != '\0');
    }
    clay_finish(&c);
    return s;
}

/* Three bytes a change: where, and what is turned over there. */
void spoil(byte_string &file, const uint8_t *bytes, size_t changes)
{
    for (; changes > 0; bytes += CHANGE_BYTES, changes--)
        file[static_cast<size_t>(bytes[0] << 8 | bytes[1]) % file.size()] ^= bytes[2];
}

void make_and_spoil(const uint8_t *bytes, size_t size)
{
    const size_t head = 1 + CHANGE_BYTES * CHANGES_MAX;
    if (size < head)
        return;
    clay c;
    require(clay_init(&c, BRICKS) == STATUS_OK);
    write_corners(c, bytes + head, size - head);
    const checkpoint_facts facts = {.version = 0,
                                    .step_mm = 1,
                                    .sequence = bytes[0],
                                    .cursor = bytes[0] / 2u,
                                    .tip = bytes[0],
                                    .seal = 7,
                                    .dab = 2,
                                    .bricks = 0,
                                    .digest = clay_digest(&c)};
    byte_string file = file_of(c, facts);
    clay_finish(&c);
    const uint32_t version = bytes[0] >> 4 & 3; /* 0: as it was written */
    if (version > 0 && file.size() > HEADER)
        file = as_version(version, file, facts.cursor);
    require(read_file(file) == STATUS_OK);
    spoil(file, bytes + 1, 1 + (bytes[0] >> 1) % CHANGES_MAX);
    if (bytes[0] & 1)
        put_checksums_right(file);
    read_file(file);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    if (size < 1)
        return 0;
    byte_string file(bytes + 1, bytes + size);
    switch (bytes[0] % 3) {
    case 0: read_file(file); break;
    case 1:
        put_checksums_right(file);
        read_file(file);
        break;
    default: make_and_spoil(bytes + 1, size - 1); break;
    }
    return 0;
}
