/* SPDX-License-Identifier: Apache-2.0 */
#include "history/checkpoint.h"

#include "clay/digest.h"
#include "clay/sieve_rows.h"
#include "history/byte_order.h"
#include "history/preamble.h"
#include "history/record.h"
#include "history/sentence.h"

#include <math.h>

enum {
    VERSION_AT = 8,
    STEP_AT = 16,
    SEQUENCE_AT = 24,
    DAB_AT = 32,
    BRICKS_AT = 40,
    DIGEST_AT = 48,
    CURSOR_AT = 56,
    TIP_AT = 64,
    SEAL_AT = 72,
    ZERO_AT = 80,
    HEADER_BYTES_1 = 64,
    BLOCK_HEAD_BYTES = 8,
    BLOCK_STORED_AT = 4,
    BRICK_HEAD_BYTES = 80,
    BRICK_COUNT_AT = 12,
    BRICK_MASK_AT = 16,
    CHECKSUM_BYTES = 8,
    CORNER_BYTES = 8,
    BRICK_BYTES_MAX = BRICK_HEAD_BYTES + BRICK_CORNERS * CORNER_BYTES,
};

/* Of every version there was. */
static const preamble header_preambles[CHECKPOINT_VERSION] = {
    {"glaise\r\n", 1, HEADER_BYTES_1},
    {"glaise\r\n", 2, CHECKPOINT_HEADER_BYTES},
    {"glaise\r\n", 3, CHECKPOINT_HEADER_BYTES},
};

_Static_assert((int)CHECKPOINT_SLACK_BYTES >= (int)SIEVE_ROWS_SLACK_BYTES, "vectors are written whole");
_Static_assert((int)CHECKPOINT_FRAME_BYTES == (int)BLOCK_HEAD_BYTES + (int)CHECKSUM_BYTES, "of a block");

/* --- writing --- */

static status flush(checkpoint_writer *w)
{
    if (!w->headed) {
        w->headed = true;
        status s = w->sink(w->self, w->header, sizeof w->header);
        if (s != STATUS_OK)
            return s;
    }
    if (w->used == 0)
        return STATUS_OK;
    uint8_t *b = w->packed;
    const size_t stored = packing_pack(w->with, b + BLOCK_HEAD_BYTES, w->block, w->used);
    const size_t vouched = BLOCK_HEAD_BYTES + stored;
    byte_order_put_u32(b, (uint32_t)w->used);
    byte_order_put_u32(b + BLOCK_STORED_AT, (uint32_t)stored);
    byte_order_put_u64(b + vouched, digest_bytes(b, vouched, 0));
    w->used = 0;
    return w->sink(w->self, b, vouched + CHECKSUM_BYTES);
}

static void put_header(uint8_t *h, const checkpoint_facts *facts)
{
    byte_order_put_double(h + STEP_AT, facts->step_mm);
    byte_order_put_u64(h + SEQUENCE_AT, facts->sequence);
    byte_order_put_u64(h + DAB_AT, facts->dab);
    byte_order_put_u64(h + BRICKS_AT, facts->bricks);
    byte_order_put_u64(h + DIGEST_AT, facts->digest);
    byte_order_put_u64(h + CURSOR_AT, facts->cursor);
    byte_order_put_u64(h + TIP_AT, facts->tip);
    byte_order_put_u64(h + SEAL_AT, facts->seal);
    byte_order_put_u64(h + ZERO_AT, 0);
    preamble_seal(&header_preambles[CHECKPOINT_VERSION - 1], h);
}

/* Puts the brick into the block; the bytes it took, 0 when none of its corners is stored. */
static size_t put_brick(checkpoint_writer *w, key at, const brick_page *p)
{
    brick_mask mask;
    uint32_t stored = sieve_rows_stored(p, &mask, w->c->rows);
    if (stored == 0)
        return 0;
    uint8_t *b = w->block + w->used;
    byte_order_put_u32(b, (uint32_t)at.i);
    byte_order_put_u32(b + 4, (uint32_t)at.j);
    byte_order_put_u32(b + 8, (uint32_t)at.k);
    byte_order_put_u32(b + BRICK_COUNT_AT, stored);
    for (int n = 0; n < BRICK_EDGE; n++)
        byte_order_put_u64(b + BRICK_MASK_AT + 8 * n, mask.slab[n]);
    uint8_t *end = sieve_rows_take(b + BRICK_HEAD_BYTES, p->potential, &mask, w->c->rows);
    (void)sieve_rows_take(end, p->rgba, &mask, w->c->rows);
    const size_t took = BRICK_HEAD_BYTES + (size_t)stored * CORNER_BYTES;
    w->used += took;
    return took;
}

void checkpoint_writer_begin(checkpoint_writer *w, const clay *c, const checkpoint_facts *facts, packing *with,
                             checkpoint_sink sink, void *self)
{
    checkpoint_facts f = *facts;
    brick_mask mask;
    avl_walk walk;
    key at;
    uint32_t id;
    f.bricks = 0;
    for (bool more = avl_first(&walk, &c->tree, &at, &id); more; more = avl_next(&walk, &at, &id))
        f.bricks += sieve_rows_stored(clay_brick(c, id)->page, &mask, c->rows) > 0;
    w->c = c;
    w->with = with;
    w->sink = sink;
    w->self = self;
    w->used = 0;
    w->headed = false;
    put_header(w->header, &f);
    w->more = avl_first(&w->walk, &c->tree, &w->at, &w->id);
}

status checkpoint_writer_step(checkpoint_writer *w, size_t bytes, bool *done_out)
{
    status s = STATUS_OK;
    for (size_t put = 0; s == STATUS_OK && w->more && put < bytes;) {
        if (CHECKPOINT_BLOCK_BYTES - w->used < BRICK_BYTES_MAX)
            s = flush(w);
        if (s != STATUS_OK)
            break;
        put += put_brick(w, w->at, clay_brick(w->c, w->id)->page);
        w->more = avl_next(&w->walk, &w->at, &w->id);
    }
    *done_out = !w->more;
    return s == STATUS_OK && !w->more ? flush(w) : s;
}

status checkpoint_write(const clay *c, const checkpoint_facts *facts, checkpoint_sink sink, void *self)
{
    checkpoint_writer w;
    bool done = false;
    packing *with = packing_open();
    checkpoint_writer_begin(&w, c, facts, with, sink, self);
    status s = checkpoint_writer_step(&w, SIZE_MAX, &done);
    packing_close(with);
    return s;
}

/* --- reading --- */

typedef struct reader {
    checkpoint_source source;
    void *self;
    checkpoint_trouble *trouble;
    bool blocks;     /* version 3: bricks come in blocks */
    uint64_t offset; /* in the file: of block[at]; where there are blocks, of the one that block[0..have) came out of */
    uint64_t next;   /* of the block after it */
    size_t at, have; /* block[at..have) is read and not yet taken */
    uint8_t block[CHECKPOINT_BLOCK_BYTES];
    uint8_t packed[CHECKPOINT_BLOCK_BYTES + CHECKPOINT_FRAME_BYTES];
} reader;

static void reader_begin(reader *r, checkpoint_source source, void *self, checkpoint_trouble *trouble)
{
    r->source = source;
    r->self = self;
    r->trouble = trouble;
    r->blocks = false;
    r->offset = r->next = 0;
    r->at = r->have = 0;
    *trouble = (checkpoint_trouble){0, ""};
}

static status refuse(reader *r, status s, uint64_t offset, const char *expected)
{
    r->trouble->offset = offset;
    sentence text = sentence_begin(r->trouble->expected, sizeof r->trouble->expected);
    sentence_add(&text, expected);
    return s;
}

/* At a place so far behind what is to be taken next. */
static status refuse_here(reader *r, status s, size_t behind, const char *expected)
{
    return refuse(r, s, r->offset + (r->blocks ? 0 : behind), expected);
}

static size_t reader_has(const reader *r) { return r->have - r->at; }
static const uint8_t *reader_bytes(const reader *r) { return r->block + r->at; }

static void reader_take(reader *r, size_t n)
{
    r->at += n;
    r->offset += r->blocks ? 0 : n;
}

/* n bytes from offset; fewer only where the file ends. */
static status get(reader *r, uint64_t offset, uint8_t *bytes, size_t n, size_t *got_out)
{
    *got_out = 0;
    for (size_t got = 1; *got_out < n && got > 0; *got_out += got) {
        status s = r->source(r->self, offset + *got_out, bytes + *got_out, n - *got_out, &got);
        if (s != STATUS_OK)
            return refuse(r, s, offset + *got_out, "readable bytes");
    }
    return STATUS_OK;
}

/* Up to n bytes in one piece; fewer only when the file ends. */
static status reader_fill(reader *r, size_t n)
{
    if (reader_has(r) >= n)
        return STATUS_OK;
    memmove(r->block, r->block + r->at, reader_has(r));
    r->have -= r->at;
    r->at = 0;
    size_t got = 0;
    status s = get(r, r->offset + r->have, r->block + r->have, CHECKPOINT_BLOCK_BYTES - r->have, &got);
    r->have += got;
    return s;
}

/* The next block, whole, in the place of the one that was taken. */
static status reader_next_block(reader *r)
{
    uint8_t *b = r->packed;
    size_t got = 0;
    status s = get(r, r->next, b, BLOCK_HEAD_BYTES, &got);
    if (s != STATUS_OK)
        return s;
    if (got < BLOCK_HEAD_BYTES)
        return refuse(r, STATUS_CORRUPT, r->next + got, "the rest of the bricks");
    const uint32_t bytes = byte_order_get_u32(b), stored = byte_order_get_u32(b + BLOCK_STORED_AT);
    if (bytes < 1 || bytes > CHECKPOINT_BLOCK_BYTES || stored < 1 || stored > bytes)
        return refuse(r, STATUS_CORRUPT, r->next, "a block of 1 to 65536 bytes, in as many or fewer");
    s = get(r, r->next + BLOCK_HEAD_BYTES, b + BLOCK_HEAD_BYTES, stored + CHECKSUM_BYTES, &got);
    if (s != STATUS_OK)
        return s;
    if (got < stored + CHECKSUM_BYTES)
        return refuse(r, STATUS_CORRUPT, r->next + BLOCK_HEAD_BYTES + got, "the rest of a block");
    const size_t vouched = BLOCK_HEAD_BYTES + stored;
    if (byte_order_get_u64(b + vouched) != digest_bytes(b, vouched, 0))
        return refuse(r, STATUS_CORRUPT, r->next + vouched, "the checksum of this block");
    s = packing_unpack(r->block, bytes, b + BLOCK_HEAD_BYTES, stored);
    if (s != STATUS_OK)
        return refuse(r, s, r->next + BLOCK_HEAD_BYTES, "bytes that this program can unpack");
    r->offset = r->next;
    r->next += vouched + CHECKSUM_BYTES;
    r->at = 0;
    r->have = bytes;
    return STATUS_OK;
}

/* n bytes of a brick, in one piece. */
static status reader_bring(reader *r, size_t n)
{
    status s = STATUS_OK;
    if (!r->blocks)
        s = reader_fill(r, n);
    else if (reader_has(r) == 0)
        s = reader_next_block(r);
    if (s == STATUS_OK && reader_has(r) < n)
        s = refuse_here(r, STATUS_CORRUPT, reader_has(r), "the rest of a brick");
    return s;
}

static status reader_end(reader *r)
{
    uint8_t byte;
    size_t beyond = reader_has(r);
    if (beyond == 0) {
        status s = get(r, r->blocks ? r->next : r->offset, &byte, 1, &beyond);
        if (s != STATUS_OK)
            return s;
        r->offset = r->blocks ? r->next : r->offset;
    }
    return beyond > 0 ? refuse_here(r, STATUS_CORRUPT, 0, "the end of the file") : STATUS_OK;
}

static status get_header(reader *r, checkpoint_facts *f)
{
    status s = reader_fill(r, PREAMBLE_HEADER_BYTES_MAX);
    if (s != STATUS_OK)
        return s;
    const uint8_t *h = reader_bytes(r);
    uint32_t version = reader_has(r) >= PREAMBLE_BYTES ? byte_order_get_u32(h + VERSION_AT) : CHECKPOINT_VERSION;
    version = version < 1 || version > CHECKPOINT_VERSION ? CHECKPOINT_VERSION : version;
    const bool first_version = version == 1;
    preamble_trouble why;
    s = preamble_check(&header_preambles[version - 1], h, reader_has(r), &why);
    if (s != STATUS_OK)
        return refuse(r, s, why.offset, why.expected);
    *f = (checkpoint_facts){.version = version};
    f->step_mm = byte_order_get_double(h + STEP_AT);
    f->sequence = byte_order_get_u64(h + SEQUENCE_AT);
    f->dab = byte_order_get_u64(h + DAB_AT);
    f->bricks = byte_order_get_u64(h + BRICKS_AT);
    f->digest = byte_order_get_u64(h + DIGEST_AT);
    if (first_version) {
        f->cursor = f->tip = f->sequence;
        f->sequence = 0;
    } else {
        f->cursor = byte_order_get_u64(h + CURSOR_AT);
        f->tip = byte_order_get_u64(h + TIP_AT);
        f->seal = byte_order_get_u64(h + SEAL_AT);
    }
    if (f->sequence > RECORD_STROKE_MAX || f->tip > RECORD_STROKE_MAX || f->cursor > f->tip)
        return refuse(r, STATUS_CORRUPT, SEQUENCE_AT, "the number of a record, and a cursor up to the tip");
    if (!first_version && byte_order_get_u64(h + ZERO_AT) != 0)
        return refuse(r, STATUS_CORRUPT, ZERO_AT, "zero");
    if (!isfinite(f->step_mm) || f->step_mm <= 0)
        return refuse(r, STATUS_CORRUPT, STEP_AT, "a finite step above zero");
    reader_take(r, header_preambles[version - 1].header_bytes);
    r->blocks = version >= 3;
    if (r->blocks) {
        r->next = r->offset;
        r->at = r->have = 0; /* blocks are read from their beginning on */
    }
    return STATUS_OK;
}

/* Moves the brick's corners to an empty page; false at a potential that no stored corner can have. */
static bool fill_page(brick_page *p, const brick_mask *mask, const uint8_t *corners, uint32_t stored)
{
    const uint8_t *potential = corners, *rgba = corners + (size_t)4 * stored;
    for (int n = 0; n < BRICK_CORNERS; n++) {
        if (!brick_mask_has(mask, n))
            continue;
        float v = byte_order_get_float(potential);
        if (!(v > POTENTIAL_MIN && v <= POTENTIAL_MAX))
            return false;
        p->potential[n] = v;
        p->rgba[n] = byte_order_get_u32(rgba);
        potential += 4;
        rgba += 4;
    }
    return true;
}

/* Key, count and mask of the next brick, whose bytes are then in one piece and match their checksum. */
static status get_brick_head(reader *r, key *at_out, brick_mask *mask_out, uint32_t *stored_out)
{
    status s = reader_bring(r, BRICK_HEAD_BYTES);
    if (s != STATUS_OK)
        return s;
    const uint8_t *b = reader_bytes(r);
    uint32_t stored = byte_order_get_u32(b + BRICK_COUNT_AT), marked = 0;
    for (int n = 0; n < BRICK_EDGE; n++) {
        mask_out->slab[n] = byte_order_get_u64(b + BRICK_MASK_AT + 8 * n);
        marked += (uint32_t)__builtin_popcountll(mask_out->slab[n]);
    }
    if (stored < 1 || stored > BRICK_CORNERS || stored != marked)
        return refuse_here(r, STATUS_CORRUPT, BRICK_COUNT_AT, "1 to 512 corners, as many as the mask has");
    const size_t vouched = BRICK_HEAD_BYTES + (size_t)stored * CORNER_BYTES;
    s = reader_bring(r, vouched + (r->blocks ? 0 : CHECKSUM_BYTES));
    if (s != STATUS_OK)
        return s;
    b = reader_bytes(r);
    if (!r->blocks && byte_order_get_u64(b + vouched) != digest_bytes(b, vouched, 0))
        return refuse_here(r, STATUS_CORRUPT, vouched, "the checksum of this brick");
    *at_out = (key){(int32_t)byte_order_get_u32(b), (int32_t)byte_order_get_u32(b + 4),
                    (int32_t)byte_order_get_u32(b + 8)};
    *stored_out = stored;
    return STATUS_OK;
}

static status get_bricks(reader *r, const checkpoint_facts *f, clay *fresh)
{
    key last = {0, 0, 0};
    for (uint64_t n = 0; n < f->bricks; n++) {
        key at;
        brick_mask mask;
        uint32_t stored = 0, id = POOL_NONE;
        status s = get_brick_head(r, &at, &mask, &stored);
        if (s != STATUS_OK)
            return s;
        if (!key_brick_in_range(at))
            return refuse_here(r, STATUS_CORRUPT, 0, "a brick key within the lattice");
        if (n > 0 && key_compare(last, at) >= 0)
            return refuse_here(r, STATUS_CORRUPT, 0, "a brick key above the one before");
        last = at;
        s = clay_brick_open(fresh, at, &id);
        if (s != STATUS_OK)
            return refuse_here(r, s, 0, "room for one more brick");
        if (!fill_page(clay_brick(fresh, id)->page, &mask, reader_bytes(r) + BRICK_HEAD_BYTES, stored))
            return refuse_here(r, STATUS_CORRUPT, BRICK_HEAD_BYTES, "potentials above 0, up to 3");
        s = clay_brick_close(fresh, id, &mask);
        if (s != STATUS_OK)
            return refuse_here(r, s, 0, "room for one more brick");
        reader_take(r, BRICK_HEAD_BYTES + (size_t)stored * CORNER_BYTES + (r->blocks ? 0 : CHECKSUM_BYTES));
    }
    status s = reader_end(r);
    if (s == STATUS_OK && clay_digest(fresh) != f->digest)
        s = refuse(r, STATUS_CORRUPT, DIGEST_AT, "the digest of the clay that follows");
    return s;
}

/* What is about to go must be looked at again, and so must whatever was still waiting to be looked at. */
static status mark_old(const clay *old, clay *fresh)
{
    const brick_mask all = BRICK_MASK_ALL;
    status s = STATUS_OK;
    for (uint32_t n = 0; s == STATUS_OK && n < dirt_count(&old->dirty); n++)
        s = clay_mark(fresh, dirt_at(&old->dirty, n)->at, &dirt_at(&old->dirty, n)->corners);
    avl_walk w;
    key at;
    uint32_t id;
    bool more = avl_first(&w, &old->tree, &at, &id);
    for (; s == STATUS_OK && more; more = avl_next(&w, &at, &id))
        s = clay_mark(fresh, at, &all);
    return s;
}

status checkpoint_read(clay *c, checkpoint_facts *facts_out, checkpoint_source source, void *self,
                       checkpoint_trouble *trouble_out)
{
    assert(!c->changes.recording);
    reader r;
    checkpoint_facts facts;
    reader_begin(&r, source, self, trouble_out);
    status s = get_header(&r, &facts);
    if (s != STATUS_OK)
        return s;
    if (facts.bricks > c->bricks.limit)
        return refuse(&r, STATUS_POOL_FULL, BRICKS_AT, "no more bricks than this sculpture may have");
    clay fresh;
    s = clay_init(&fresh, c->bricks.limit);
    if (s != STATUS_OK)
        return s;
    s = get_bricks(&r, &facts, &fresh);
    if (s == STATUS_OK)
        s = mark_old(c, &fresh);
    if (s != STATUS_OK) {
        clay_finish(&fresh);
        return s;
    }
    clay_finish(c);
    *c = fresh;
    *facts_out = facts;
    return STATUS_OK;
}

status checkpoint_read_facts(checkpoint_facts *facts_out, checkpoint_source source, void *self,
                             checkpoint_trouble *trouble_out)
{
    reader r;
    checkpoint_facts facts;
    reader_begin(&r, source, self, trouble_out);
    status s = get_header(&r, &facts);
    if (s == STATUS_OK)
        *facts_out = facts;
    return s;
}
