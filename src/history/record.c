/* SPDX-License-Identifier: Apache-2.0 */
#include "history/record.h"

#include "clay/digest.h"
#include "clay/sieve_rows.h"
#include "history/byte_order.h"

#include <math.h>

enum {
    VERSION_AT = 8,
    SEQUENCE_AT = 16,
    USE_AT = 24,
    BEFORE_AT = 32,
    STROKE_AT = 40,
    PARENT_AT = 48,
    BRICKS_AT = 56,
    MARKS_AT = 60,
    CURSOR_AT = 64,
    TIP_AT = 72,
    DIGEST_BEFORE_AT = 80,
    DIGEST_AFTER_AT = 88,
    DAB_AT = 96,
    STEP_AT = 104,
    KEPT_AT = 112,
    BYTES_AT = 120,
    PART_AT = 128,
    ZERO_AT = 132,
    STORED_AT = 136,
    CHECK_AT = 144,
    SEAL_AT = 152,
    BRICK_COUNT_AT = 12,
    BRICK_MASK_AT = 16,
};

static const preamble header_preamble = {"glring\r\n", RECORD_VERSION, RECORD_HEADER_BYTES};
static const preamble header_preamble_1 = {"glring\r\n", 1, RECORD_HEADER_BYTES};

static const brick_page empty_page;

/* --- writing --- */

size_t record_put_brick(uint8_t *to, key at, const brick_page *old, const brick_page *now, lanes rows)
{
    brick_mask mask;
    brick_page differs;
    old = old ? old : &empty_page;
    now = now ? now : &empty_page;
    const uint32_t corners = sieve_rows_changed(old, now, &mask, rows);
    if (corners == 0)
        return 0;
    const uint32_t *a = (const uint32_t *)(const void *)old, *b = (const uint32_t *)(const void *)now;
    uint32_t *d = (uint32_t *)(void *)&differs;
    for (int n = 0; n < 2 * BRICK_CORNERS; n++)
        d[n] = a[n] ^ b[n];
    byte_order_put_u32(to, (uint32_t)at.i);
    byte_order_put_u32(to + 4, (uint32_t)at.j);
    byte_order_put_u32(to + 8, (uint32_t)at.k);
    byte_order_put_u32(to + BRICK_COUNT_AT, corners);
    for (int n = 0; n < BRICK_EDGE; n++)
        byte_order_put_u64(to + BRICK_MASK_AT + 8 * n, mask.slab[n]);
    uint8_t *end = sieve_rows_take(to + RECORD_BRICK_HEAD_BYTES, differs.potential, &mask, rows);
    (void)sieve_rows_take(end, differs.rgba, &mask, rows);
    return RECORD_BRICK_HEAD_BYTES + (size_t)corners * RECORD_CORNER_BYTES;
}

void record_pack(record *r, packing *with, uint8_t *to, const uint8_t *bricks)
{
    assert(r->bytes <= RECORD_PACKED_MOST);
    r->stored = packing_pack(with, to, bricks, (size_t)r->bytes);
}

void record_seal(record *r, uint8_t *header)
{
    uint8_t *h = header;
    r->check = digest_bytes(h + RECORD_HEADER_BYTES, (size_t)r->stored, r->sequence);
    byte_order_put_u64(h + SEQUENCE_AT, r->sequence);
    byte_order_put_u64(h + USE_AT, r->use);
    byte_order_put_u64(h + BEFORE_AT, r->before);
    byte_order_put_u64(h + STROKE_AT, r->stroke);
    byte_order_put_u64(h + PARENT_AT, r->parent);
    byte_order_put_u32(h + BRICKS_AT, r->bricks);
    byte_order_put_u32(h + MARKS_AT, r->marks);
    byte_order_put_u64(h + CURSOR_AT, r->cursor);
    byte_order_put_u64(h + TIP_AT, r->tip);
    byte_order_put_u64(h + DIGEST_BEFORE_AT, r->digest_before);
    byte_order_put_u64(h + DIGEST_AFTER_AT, r->digest_after);
    byte_order_put_u64(h + DAB_AT, r->dab);
    byte_order_put_double(h + STEP_AT, r->step_mm);
    byte_order_put_u64(h + KEPT_AT, r->kept);
    byte_order_put_u64(h + BYTES_AT, r->bytes);
    byte_order_put_u32(h + PART_AT, r->part);
    byte_order_put_u32(h + ZERO_AT, 0);
    byte_order_put_u64(h + STORED_AT, r->stored);
    byte_order_put_u64(h + CHECK_AT, r->check);
    preamble_seal(&header_preamble, h);
    r->seal = byte_order_get_u64(h + SEAL_AT);
}

/* --- reading --- */

static status refuse(preamble_trouble *trouble, uint64_t offset, const char *expected)
{
    *trouble = (preamble_trouble){offset, expected};
    return STATUS_CORRUPT;
}

/* What no stroke and no move may say. */
static status look_at(const record *r, preamble_trouble *trouble)
{
    const uint64_t least = (uint64_t)r->bricks * (RECORD_BRICK_HEAD_BYTES + RECORD_CORNER_BYTES);
    const uint64_t most = (uint64_t)r->bricks * RECORD_BRICK_BYTES_MAX;
    const bool move = r->stroke == 0;
    if (r->sequence < 1 || r->sequence > RECORD_STROKE_MAX)
        return refuse(trouble, SEQUENCE_AT, "a sequence from 1");
    if (r->use < 1 || r->use > RECORD_STROKE_MAX)
        return refuse(trouble, USE_AT, "a use from 1");
    if (r->stroke > RECORD_STROKE_MAX || (move ? r->parent != 0 : r->parent >= r->stroke))
        return refuse(trouble, STROKE_AT, "a stroke after the one it began at");
    if (r->marks > RECORD_WHOLE || (move && r->marks != RECORD_WHOLE))
        return refuse(trouble, MARKS_AT, "no mark, or that of a whole state");
    if (r->tip > RECORD_STROKE_MAX || r->cursor > r->tip || (!move && (r->cursor != r->stroke || r->tip != r->stroke)))
        return refuse(trouble, CURSOR_AT, "a cursor at the stroke, or before the tip");
    if (r->kept >= r->sequence)
        return refuse(trouble, KEPT_AT, "an earlier sequence");
    if (!isfinite(r->step_mm) || r->step_mm <= 0)
        return refuse(trouble, STEP_AT, "a finite step above zero");
    if (move ? r->bricks != 0 || r->part != 0 : r->bricks < 1)
        return refuse(trouble, BRICKS_AT, "bricks in a stroke, and none in a move");
    if (r->bytes < least || r->bytes > most)
        return refuse(trouble, BYTES_AT, "the bytes of 1 to 512 corners a brick");
    if (r->stored != r->bytes && (r->stored < 1 || r->stored > r->bytes || r->bytes > RECORD_PACKED_MOST))
        return refuse(trouble, STORED_AT, "as many bytes as the bricks have, or fewer where these are packed");
    return STATUS_OK;
}

status record_read(record *r_out, const uint8_t *bytes, size_t have, preamble_trouble *trouble_out)
{
    const bool first_version = have >= RECORD_HEADER_BYTES && byte_order_get_u32(bytes + VERSION_AT) == 1;
    status s = preamble_check(first_version ? &header_preamble_1 : &header_preamble, bytes, have, trouble_out);
    if (s != STATUS_OK)
        return s;
    record r = {
        .sequence = byte_order_get_u64(bytes + SEQUENCE_AT),
        .use = byte_order_get_u64(bytes + USE_AT),
        .before = byte_order_get_u64(bytes + BEFORE_AT),
        .stroke = byte_order_get_u64(bytes + STROKE_AT),
        .parent = byte_order_get_u64(bytes + PARENT_AT),
        .bricks = byte_order_get_u32(bytes + BRICKS_AT),
        .marks = byte_order_get_u32(bytes + MARKS_AT),
        .part = byte_order_get_u32(bytes + PART_AT),
        .cursor = byte_order_get_u64(bytes + CURSOR_AT),
        .tip = byte_order_get_u64(bytes + TIP_AT),
        .digest_before = byte_order_get_u64(bytes + DIGEST_BEFORE_AT),
        .digest_after = byte_order_get_u64(bytes + DIGEST_AFTER_AT),
        .dab = byte_order_get_u64(bytes + DAB_AT),
        .step_mm = byte_order_get_double(bytes + STEP_AT),
        .kept = byte_order_get_u64(bytes + KEPT_AT),
        .bytes = byte_order_get_u64(bytes + BYTES_AT),
        .stored = byte_order_get_u64(bytes + STORED_AT),
        .check = byte_order_get_u64(bytes + CHECK_AT),
        .seal = byte_order_get_u64(bytes + SEAL_AT),
    };
    if (byte_order_get_u32(bytes + ZERO_AT) != 0 || (first_version && r.stored != 0))
        return refuse(trouble_out, ZERO_AT, "zeros");
    if (first_version)
        r.stored = r.bytes;
    s = look_at(&r, trouble_out);
    if (s == STATUS_OK)
        *r_out = r;
    return s;
}

size_t record_get_brick(record_brick *b_out, const uint8_t *bytes, size_t left)
{
    if (left < RECORD_BRICK_HEAD_BYTES)
        return 0;
    record_brick b = {.at = {(int32_t)byte_order_get_u32(bytes), (int32_t)byte_order_get_u32(bytes + 4),
                             (int32_t)byte_order_get_u32(bytes + 8)},
                      .corners = byte_order_get_u32(bytes + BRICK_COUNT_AT)};
    for (int n = 0; n < BRICK_EDGE; n++)
        b.mask.slab[n] = byte_order_get_u64(bytes + BRICK_MASK_AT + 8 * n);
    if (b.corners < 1 || b.corners != brick_mask_count(&b.mask))
        return 0;
    const size_t takes = RECORD_BRICK_HEAD_BYTES + (size_t)b.corners * RECORD_CORNER_BYTES;
    if (left < takes)
        return 0;
    b.potential = bytes + RECORD_BRICK_HEAD_BYTES;
    b.rgba = b.potential + (size_t)4 * b.corners;
    *b_out = b;
    return takes;
}

/* Does every corner differ in some bit? */
static bool differs_everywhere(const record_brick *b)
{
    for (uint32_t n = 0; n < b->corners; n++)
        if ((byte_order_get_u32(b->potential + (size_t)4 * n) | byte_order_get_u32(b->rgba + (size_t)4 * n)) == 0)
            return false;
    return true;
}

status record_unpack(const record *r, const uint8_t *stored, uint8_t *bricks_out)
{
    return packing_unpack(bricks_out, (size_t)r->bytes, stored, (size_t)r->stored);
}

status record_check(const record *r, const uint8_t *stored, uint8_t *bricks_out, preamble_trouble *trouble_out)
{
    const uint8_t *bricks = bricks_out;
    if (r->check != digest_bytes(stored, (size_t)r->stored, r->sequence))
        return refuse(trouble_out, 0, "the checksum of the bricks");
    status s = record_unpack(r, stored, bricks_out);
    if (s != STATUS_OK) {
        *trouble_out = (preamble_trouble){0, "bytes that this program can unpack"};
        return s;
    }
    size_t offset = 0;
    record_brick b, last = {.corners = 0};
    for (uint32_t n = 0; n < r->bricks; n++) {
        const size_t taken = record_get_brick(&b, bricks + offset, (size_t)r->bytes - offset);
        if (taken == 0)
            return refuse(trouble_out, offset, "a brick with as many corners as its mask has");
        if (!key_brick_in_range(b.at) || (n > 0 && key_compare(last.at, b.at) >= 0))
            return refuse(trouble_out, offset, "a brick key within the lattice, above the one before");
        if (!differs_everywhere(&b))
            return refuse(trouble_out, offset + RECORD_BRICK_HEAD_BYTES, "corners that differ");
        last = b;
        offset += taken;
    }
    return offset == r->bytes ? STATUS_OK : refuse(trouble_out, offset, "the end of the bricks");
}
