/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal    No bytes make the reader of undo-files read outside them or change clay in part; what it lets pass can be
 *         applied forth and back to the exact digest, and a stroke that does the same makes the same bytes.
 * Method  The first byte chooses: the rest are a file; a file whose checksums are put right; or corners of a stroke,
 *         whose file must pass, and is then changed in up to four places, its checksums perhaps put right.
 */
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "clay/digest.h"
#include "history/byte_order.h"
#include "history/undo_file.h"

namespace {

enum { BRICKS = 32, HEADER = UNDO_FILE_HEADER_BYTES, CORNER_PROGRAM_BYTES = 6, CHANGE_BYTES = 3, CHANGES_MAX = 4 };

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
    const uint64_t seed = byte_order_get_u64(&b[32]);
    byte_order_put_u64(&b[HEADER - 8], digest_bytes(b.data(), HEADER - 8, 0));
    for (size_t at = HEADER; at + 88 <= b.size();) {
        const uint64_t vouched = 80 + uint64_t{16} * byte_order_get_u32(&b[at + 12]);
        if (vouched + 8 > b.size() - at)
            return;
        byte_order_put_u64(&b[at + vouched], digest_bytes(&b[at], vouched, seed));
        at += vouched + 8;
    }
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

byte_string file_of(const clay &c, undo_file_facts facts)
{
    byte_buffer b = {nullptr, 0, 0};
    require(undo_file_encode(&c, &facts, &b) == STATUS_OK);
    byte_string out(b.bytes, b.bytes + (facts.corners > 0 ? b.size : 0));
    byte_buffer_finish(&b);
    return out;
}

/* Applies a file that passed; the clay is afterwards as it was. */
void forth_and_back(clay &c, const byte_string &file, const undo_file_facts &facts)
{
    const uint64_t digest = clay_digest(&c);
    preamble_trouble trouble = {0, nullptr};
    dirt_clear(&c.dirty);
    status s = undo_file_apply(&c, file.data(), file.size(), UNDO_FILE_FORTH, &trouble);
    require(s == STATUS_OK || s == STATUS_CORRUPT || s == STATUS_POOL_FULL);
    if (s == STATUS_OK) {
        require(clay_is_valid(&c) && clay_digest(&c) != digest);
        require(file_of(c, facts) == file);
        clay_change_end(&c);
        dirt_clear(&c.dirty);
        s = undo_file_apply(&c, file.data(), file.size(), UNDO_FILE_BACK, &trouble);
        require(s == STATUS_OK);
        clay_change_end(&c);
    }
    require(!c.changes.recording && clay_is_valid(&c) && clay_digest(&c) == digest);
}

void read_file(clay &c, const byte_string &file)
{
    undo_file_facts facts;
    preamble_trouble trouble = {UINT64_MAX, nullptr};
    const status s = undo_file_check(&facts, file.data(), file.size(), &trouble);
    if (s == STATUS_OK)
        forth_and_back(c, file, facts);
    else
        require(trouble.expected != nullptr && trouble.offset <= file.size());
}

/* Three bytes a change: where, and what is turned over there. */
void spoil(byte_string &file, const uint8_t *bytes, size_t changes)
{
    for (; changes > 0; bytes += CHANGE_BYTES, changes--)
        file[static_cast<size_t>(bytes[0] << 8 | bytes[1]) % file.size()] ^= bytes[2];
}

void make_and_spoil(clay &c, const uint8_t *bytes, size_t size)
{
    const size_t head = 1 + CHANGE_BYTES * CHANGES_MAX;
    if (size < head)
        return;
    const size_t before = (size - head) / 2;
    write_corners(c, bytes + head, before);
    undo_file_facts facts = {.stroke = 1u + bytes[0], .digest_before = clay_digest(&c), .digest_after = 0, .dab = 1,
                             .ring = 200, .bricks = 0, .corners = 0, .bytes = 0};
    clay_change_begin(&c);
    write_corners(c, bytes + head + before, size - head - before);
    facts.digest_after = clay_digest(&c);
    byte_string file = file_of(c, facts);
    clay_change_revert(&c);
    require(clay_digest(&c) == facts.digest_before);
    if (file.empty())
        return;
    undo_file_facts found;
    preamble_trouble trouble;
    require(undo_file_check(&found, file.data(), file.size(), &trouble) == STATUS_OK);
    read_file(c, file);
    spoil(file, bytes + 1, 1 + (bytes[0] >> 1) % CHANGES_MAX);
    if (bytes[0] & 1)
        put_checksums_right(file);
    read_file(c, file);
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
    case 0: read_file(c, file); break;
    case 1:
        put_checksums_right(file);
        read_file(c, file);
        break;
    default: make_and_spoil(c, bytes + 1, size - 1); break;
    }
    clay_finish(&c);
    return 0;
}
