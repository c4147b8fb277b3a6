/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A record's bytes laid by hand, number by number, from the table in history/record.h, and reading them as
 *          strictly as it can be done.
 * Is not:  What the room itself writes: tests compare that with these.
 */
#ifndef GLAISE_UNIT_HISTORY_RECORD_LAID_H
#define GLAISE_UNIT_HISTORY_RECORD_LAID_H

#include "history/record.h"

#include "clay/digest.h"
#include "history/byte_order.h"

#include <algorithm>
#include <cstring>
#include <vector>

using record_laid_string = std::vector<uint8_t>;

enum { RECORD_LAID_HEADER = 160 };

inline void record_laid_u32(record_laid_string &b, size_t at, uint32_t v)
{
    for (size_t n = 0; n < 4; n++)
        b.at(at + n) = static_cast<uint8_t>(v >> 8 * n & 255);
}

inline void record_laid_u64(record_laid_string &b, size_t at, uint64_t v)
{
    record_laid_u32(b, at, static_cast<uint32_t>(v & 0xffffffff));
    record_laid_u32(b, at + 4, static_cast<uint32_t>(v >> 32));
}

/* The last two fields, which vouch for the others. */
inline record_laid_string record_laid_sealed(record_laid_string b)
{
    const size_t stored = b.size() - RECORD_LAID_HEADER;
    record_laid_u64(b, 144, digest_bytes(b.data() + RECORD_LAID_HEADER, stored, byte_order_get_u64(&b[16])));
    record_laid_u64(b, 152, digest_bytes(b.data(), 152, 0));
    return b;
}

/* Two bricks: (0,0,0) with corner (0,0,1); (0,0,1) with corners (0,0,9) and (0,0,10). */
inline record_laid_string record_laid_bytes()
{
    record_laid_string b(RECORD_LAID_HEADER + 80 + 8 + 80 + 16);
    std::memcpy(b.data(), "glring\r\n", 8);
    record_laid_u32(b, 8, 2);
    record_laid_u32(b, 12, 160);
    record_laid_u64(b, 16, 9);
    record_laid_u64(b, 24, 4);
    record_laid_u64(b, 32, 0x1122334455667788);
    record_laid_u64(b, 40, 7);
    record_laid_u64(b, 48, 3);
    record_laid_u32(b, 56, 2);
    record_laid_u32(b, 60, 1);
    record_laid_u64(b, 64, 7);
    record_laid_u64(b, 72, 7);
    record_laid_u64(b, 80, 0xa1a2a3a4a5a6a7a8);
    record_laid_u64(b, 88, 0xb1b2b3b4b5b6b7b8);
    record_laid_u64(b, 96, 99);
    record_laid_u64(b, 104, 0x3fc0000000000000); /* 0.125 */
    record_laid_u64(b, 112, 8);
    record_laid_u64(b, 120, b.size() - RECORD_LAID_HEADER);
    record_laid_u32(b, 128, 2);
    record_laid_u64(b, 136, b.size() - RECORD_LAID_HEADER);
    const size_t first = RECORD_LAID_HEADER, second = RECORD_LAID_HEADER + 88;
    record_laid_u32(b, first + 12, 1);
    record_laid_u64(b, first + 16, 0b10);
    record_laid_u32(b, first + 80, 0x3fa00000); /* 1.25, from nothing */
    record_laid_u32(b, first + 84, 0x04030201);
    record_laid_u32(b, second + 8, 1);
    record_laid_u32(b, second + 12, 2);
    record_laid_u64(b, second + 16, 0b110);
    record_laid_u32(b, second + 80, 0x3f000000 ^ 0x40200000); /* 0.5 became 2.5 */
    record_laid_u32(b, second + 84, 0x40400000);              /* 3 became nothing */
    record_laid_u32(b, second + 88, 0xaabbccdd ^ 0x08070605);
    return record_laid_sealed(b);
}

inline constexpr record record_laid_facts = {.sequence = 9,
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

inline status record_laid_read(const record_laid_string &b, record *r, preamble_trouble *why)
{
    *why = {UINT64_MAX, ""};
    const record_laid_string exact(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(std::min<size_t>(b.size(), 512)));
    return record_read(r, exact.data(), exact.size(), why);
}

/* Header and bricks. */
inline status record_laid_take(const record_laid_string &b, preamble_trouble *why)
{
    record r = {};
    const status s = record_laid_read(b, &r, why);
    if (s != STATUS_OK)
        return s;
    if (r.stored != b.size() - RECORD_LAID_HEADER)
        return STATUS_CORRUPT;
    const record_laid_string stored(b.begin() + RECORD_LAID_HEADER, b.end());
    record_laid_string bricks(static_cast<size_t>(r.bytes));
    return record_check(&r, stored.data(), bricks.data(), why);
}

#endif
