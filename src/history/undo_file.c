/* SPDX-License-Identifier: Apache-2.0 */
#include "history/undo_file.h"

#include "clay/colour.h"
#include "clay/digest.h"
#include "clay/sieve_rows.h"
#include "history/byte_order.h"

enum {
    STROKE_AT = 16,
    BEFORE_AT = 24,
    AFTER_AT = 32,
    DAB_AT = 40,
    BRICKS_AT = 48,
    CORNERS_AT = 56,
    BYTES_AT = 64,
    RING_AT = 72,
    ZERO_AT = 76,
    BRICK_HEAD_BYTES = 80,
    BRICK_COUNT_AT = 12,
    BRICK_MASK_AT = 16,
    CHECKSUM_BYTES = 8,
    CORNER_BYTES = 16,
    BRICK_BYTES_MAX = BRICK_HEAD_BYTES + BRICK_CORNERS * CORNER_BYTES + CHECKSUM_BYTES,
};

/* More than any memory holds; products of counts below it do not overflow. */
#define CORNERS_MAX (UINT64_C(1) << 48)

static const preamble header_preamble = {"glundo\r\n", UNDO_FILE_VERSION, UNDO_FILE_HEADER_BYTES};

static size_t brick_bytes(uint32_t corners)
{
    return BRICK_HEAD_BYTES + (size_t)corners * CORNER_BYTES + CHECKSUM_BYTES;
}

/* --- encoding --- */

/* One side of a brick: potentials, then colours. */
static uint8_t *put_side(uint8_t *to, const brick_page *p, const brick_mask *mask, lanes l)
{
    to = sieve_rows_take(to, p->potential, mask, l);
    return sieve_rows_take(to, p->rgba, mask, l);
}

static void put_brick(uint8_t *to, key at, const brick_page *old, const brick_page *now, const brick_mask *mask,
                      uint32_t corners, uint64_t seed, lanes l)
{
    byte_order_put_u32(to, (uint32_t)at.i);
    byte_order_put_u32(to + 4, (uint32_t)at.j);
    byte_order_put_u32(to + 8, (uint32_t)at.k);
    byte_order_put_u32(to + BRICK_COUNT_AT, corners);
    for (int n = 0; n < BRICK_EDGE; n++)
        byte_order_put_u64(to + BRICK_MASK_AT + 8 * n, mask->slab[n]);
    uint8_t *end = put_side(to + BRICK_HEAD_BYTES, old, mask, l);
    end = put_side(end, now, mask, l);
    byte_order_put_u64(end, digest_bytes(to, (size_t)(end - to), seed));
}

static void put_header(uint8_t *h, const undo_file_facts *f)
{
    byte_order_put_u64(h + STROKE_AT, f->stroke);
    byte_order_put_u64(h + BEFORE_AT, f->digest_before);
    byte_order_put_u64(h + AFTER_AT, f->digest_after);
    byte_order_put_u64(h + DAB_AT, f->dab);
    byte_order_put_u64(h + BRICKS_AT, f->bricks);
    byte_order_put_u64(h + CORNERS_AT, f->corners);
    byte_order_put_u64(h + BYTES_AT, f->bytes);
    byte_order_put_u32(h + RING_AT, f->ring);
    byte_order_put_u32(h + ZERO_AT, 0);
    preamble_seal(&header_preamble, h);
}

status undo_file_encode(const clay *c, undo_file_facts *facts, byte_buffer *out)
{
    static const brick_page empty_page;
    avl_walk w;
    key at;
    uint32_t image;
    facts->bricks = facts->corners = 0;
    out->size = UNDO_FILE_HEADER_BYTES;
    for (bool more = avl_first(&w, &c->changes.index, &at, &image); more; more = avl_next(&w, &at, &image)) {
        status s = byte_buffer_reserve(out, out->size + BRICK_BYTES_MAX + SIEVE_ROWS_SLACK_BYTES);
        if (s != STATUS_OK)
            return s;
        const brick_page *old = clay_image_page(c, image);
        uint32_t id = clay_find(c, at);
        const brick_page *now = id == POOL_NONE ? &empty_page : clay_brick(c, id)->page;
        brick_mask mask;
        uint32_t corners = sieve_rows_changed(old, now, &mask, c->rows);
        if (corners == 0)
            continue;
        put_brick(out->bytes + out->size, at, old, now, &mask, corners, facts->digest_after, c->rows);
        out->size += brick_bytes(corners);
        facts->bricks++;
        facts->corners += corners;
    }
    facts->bytes = out->size;
    if (facts->corners > 0)
        put_header(out->bytes, facts);
    return STATUS_OK;
}

/* --- checking --- */

static status refuse(preamble_trouble *trouble, uint64_t offset, const char *expected)
{
    *trouble = (preamble_trouble){offset, expected};
    return STATUS_CORRUPT;
}

status undo_file_read_facts(undo_file_facts *facts_out, const uint8_t *bytes, size_t have,
                            preamble_trouble *trouble_out)
{
    status s = preamble_check(&header_preamble, bytes, have, trouble_out);
    if (s != STATUS_OK)
        return s;
    undo_file_facts f = {
        .stroke = byte_order_get_u64(bytes + STROKE_AT),
        .digest_before = byte_order_get_u64(bytes + BEFORE_AT),
        .digest_after = byte_order_get_u64(bytes + AFTER_AT),
        .dab = byte_order_get_u64(bytes + DAB_AT),
        .ring = byte_order_get_u32(bytes + RING_AT),
        .bricks = byte_order_get_u64(bytes + BRICKS_AT),
        .corners = byte_order_get_u64(bytes + CORNERS_AT),
        .bytes = byte_order_get_u64(bytes + BYTES_AT),
    };
    if (f.stroke < 1 || f.stroke > UNDO_FILE_STROKE_MAX)
        return refuse(trouble_out, STROKE_AT, "a stroke number from 1");
    if (f.corners > CORNERS_MAX || f.bricks < 1 || f.bricks > f.corners || f.corners > f.bricks * BRICK_CORNERS)
        return refuse(trouble_out, BRICKS_AT, "1 to 512 changed corners a brick");
    if (f.bytes != UNDO_FILE_HEADER_BYTES + f.bricks * brick_bytes(0) + f.corners * CORNER_BYTES)
        return refuse(trouble_out, BYTES_AT, "the size that follows from the counts");
    if (f.ring < 1 || byte_order_get_u32(bytes + ZERO_AT) != 0)
        return refuse(trouble_out, RING_AT, "a ring of 1 file or more, then zero");
    *facts_out = f;
    return STATUS_OK;
}

/* A brick of a checked file. */
typedef struct brick_record {
    key at;
    uint32_t corners;
    brick_mask mask;
    const uint8_t *side[2]; /* old, new: potentials, then colours */
} brick_record;

/* Answers the bytes it takes; 0 when not even the head fits or the count is not that of the mask. */
static size_t get_brick(brick_record *b, const uint8_t *bytes, size_t left)
{
    if (left < brick_bytes(0))
        return 0;
    b->at = (key){(int32_t)byte_order_get_u32(bytes), (int32_t)byte_order_get_u32(bytes + 4),
                  (int32_t)byte_order_get_u32(bytes + 8)};
    b->corners = byte_order_get_u32(bytes + BRICK_COUNT_AT);
    uint32_t marked = 0;
    for (int n = 0; n < BRICK_EDGE; n++) {
        b->mask.slab[n] = byte_order_get_u64(bytes + BRICK_MASK_AT + 8 * n);
        marked += (uint32_t)__builtin_popcountll(b->mask.slab[n]);
    }
    if (b->corners < 1 || b->corners != marked || left < brick_bytes(b->corners))
        return 0;
    b->side[0] = bytes + BRICK_HEAD_BYTES;
    b->side[1] = b->side[0] + (size_t)8 * b->corners;
    return brick_bytes(b->corners);
}

static bool corner_is_sound(const uint8_t *potential, const uint8_t *rgba)
{
    uint32_t bits = byte_order_get_u32(potential);
    float v = byte_order_get_float(potential);
    if (bits == 0)
        return byte_order_get_u32(rgba) == COLOUR_NONE;
    return v > POTENTIAL_MIN && v <= POTENTIAL_MAX;
}

/* Every corner is one that clay can hold, and its two sides differ. */
static bool sides_are_sound(const brick_record *b)
{
    for (uint32_t n = 0; n < b->corners; n++) {
        const uint8_t *potential[2], *rgba[2];
        for (int s = 0; s < 2; s++) {
            potential[s] = b->side[s] + 4 * n;
            rgba[s] = b->side[s] + 4 * (b->corners + n);
            if (!corner_is_sound(potential[s], rgba[s]))
                return false;
        }
        if (memcmp(potential[0], potential[1], 4) == 0 && memcmp(rgba[0], rgba[1], 4) == 0)
            return false;
    }
    return true;
}

static bool brick_in_range(key at)
{
    const key lowest = {KEY_MIN, KEY_MIN, KEY_MIN}, highest = {KEY_MAX, KEY_MAX, KEY_MAX};
    const box storable = {key_brick(lowest), key_brick(highest)};
    return box_contains(storable, at);
}

status undo_file_check(undo_file_facts *facts_out, const uint8_t *bytes, size_t size, preamble_trouble *trouble_out)
{
    undo_file_facts f;
    status s = undo_file_read_facts(&f, bytes, size, trouble_out);
    if (s != STATUS_OK)
        return s;
    if (f.bytes != size)
        return refuse(trouble_out, size < f.bytes ? size : f.bytes, "as many bytes as the header says");
    size_t offset = UNDO_FILE_HEADER_BYTES;
    brick_record b;
    key last = {0, 0, 0};
    for (uint64_t n = 0; n < f.bricks; n++) {
        size_t taken = get_brick(&b, bytes + offset, size - offset);
        if (taken == 0)
            return refuse(trouble_out, offset, "a brick with as many corners as its mask has");
        size_t vouched = taken - CHECKSUM_BYTES;
        if (byte_order_get_u64(bytes + offset + vouched) != digest_bytes(bytes + offset, vouched, f.digest_after))
            return refuse(trouble_out, offset + vouched, "the checksum of this brick");
        if (!brick_in_range(b.at) || (n > 0 && key_compare(last, b.at) >= 0))
            return refuse(trouble_out, offset, "a brick key within the lattice, above the one before");
        if (!sides_are_sound(&b))
            return refuse(trouble_out, offset + BRICK_HEAD_BYTES, "corners that clay can hold, changed");
        last = b.at;
        offset += taken;
    }
    if (offset != size) /* the header's corners are more than those that came */
        return refuse(trouble_out, CORNERS_AT, "the number of corners that follow");
    *facts_out = f;
    return STATUS_OK;
}

/* --- applying --- */

/* What a step needs, and what it gives back. */
typedef struct step_needs {
    uint64_t fresh, emptied, touched;
} step_needs;

static uint32_t stored_on(const brick_record *b, int side)
{
    uint32_t stored = 0;
    for (uint32_t n = 0; n < b->corners; n++)
        stored += byte_order_get_u32(b->side[side] + 4 * n) != 0;
    return stored;
}

/* Will the brick hold nothing once this step is made? */
static bool goes_empty(const clay *c, const brick_record *b, int to)
{
    uint32_t id = clay_find(c, b->at);
    return id != POOL_NONE && clay_brick(c, id)->stored + stored_on(b, to) == stored_on(b, !to);
}

/* Has this step been made already, so that the brick is gone? */
static bool has_gone(const clay *c, const brick_record *b, int to)
{
    return clay_find(c, b->at) == POOL_NONE && stored_on(b, to) == 0;
}

static uint32_t float_bits(float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits;
}

/* Is every corner of the record what the `from` side says? */
static bool clay_holds(const clay *c, const brick_record *b, int from)
{
    uint32_t id = clay_find(c, b->at);
    const brick_page *p = id == POOL_NONE ? NULL : clay_brick(c, id)->page;
    const uint8_t *potential = b->side[from], *rgba = potential + (size_t)4 * b->corners;
    for (int n = 0; n < BRICK_CORNERS; n++) {
        if (!brick_mask_has(&b->mask, n))
            continue;
        uint32_t stored_bits = p ? float_bits(p->potential[n]) : 0, stored_rgba = p ? p->rgba[n] : COLOUR_NONE;
        if (byte_order_get_u32(potential) != stored_bits || byte_order_get_u32(rgba) != stored_rgba)
            return false;
        potential += 4;
        rgba += 4;
    }
    return true;
}

static status look_ahead(const clay *c, const uint8_t *bytes, size_t size, int from, step_needs *needs,
                         preamble_trouble *trouble)
{
    brick_record b;
    *needs = (step_needs){0, 0, 0};
    for (size_t offset = UNDO_FILE_HEADER_BYTES; offset < size;) {
        size_t taken = get_brick(&b, bytes + offset, size - offset);
        assert(taken > 0);
        if (!clay_holds(c, &b, from))
            return refuse(trouble, offset, "clay as this side of the record has it");
        needs->touched++;
        needs->fresh += clay_find(c, b.at) == POOL_NONE;
        needs->emptied += goes_empty(c, &b, !from);
        offset += taken;
    }
    return STATUS_OK;
}

static status write_brick(clay *c, const brick_record *b, int to)
{
    uint32_t id;
    status s = clay_brick_open(c, b->at, &id);
    if (s != STATUS_OK)
        return s;
    brick_page *p = clay_brick(c, id)->page;
    const uint8_t *potential = b->side[to], *rgba = potential + (size_t)4 * b->corners;
    for (int n = 0; n < BRICK_CORNERS; n++) {
        if (!brick_mask_has(&b->mask, n))
            continue;
        p->potential[n] = byte_order_get_float(potential);
        p->rgba[n] = byte_order_get_u32(rgba);
        potential += 4;
        rgba += 4;
    }
    return clay_brick_close(c, id, &b->mask);
}

/* The bricks that go empty, or after them the others, in key order. */
static status write_bricks(clay *c, const uint8_t *bytes, size_t size, int to, bool emptied)
{
    brick_record b;
    status s = STATUS_OK;
    for (size_t offset = UNDO_FILE_HEADER_BYTES; s == STATUS_OK && offset < size;) {
        offset += get_brick(&b, bytes + offset, size - offset);
        if (emptied ? goes_empty(c, &b, to) : !has_gone(c, &b, to))
            s = write_brick(c, &b, to);
    }
    clay_prune(c);
    return s;
}

status undo_file_apply(clay *c, const uint8_t *bytes, size_t size, undo_file_direction direction,
                       preamble_trouble *trouble_out)
{
    assert(!c->changes.recording);
    int to = direction == UNDO_FILE_FORTH;
    step_needs needs;
    status s = look_ahead(c, bytes, size, !to, &needs, trouble_out);
    if (s != STATUS_OK)
        return s;
    clay_change_begin(c);
    uint64_t fresh = needs.fresh > needs.emptied ? needs.fresh - needs.emptied : 0;
    s = clay_room(c, fresh, needs.touched);
    if (s != STATUS_OK) {
        clay_change_end(c);
        return s;
    }
    /* What goes empty goes first: a full sculpture has no room for the one side beside the other. */
    s = write_bricks(c, bytes, size, to, true);
    if (s == STATUS_OK)
        s = write_bricks(c, bytes, size, to, false);
    if (s != STATUS_OK)
        clay_change_revert(c);
    return s;
}
