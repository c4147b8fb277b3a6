/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What is written down of a sculpture's life, one record after the other: what a stretch of a stroke changed;
 *          where the person went back or forth to. The same bytes take the clay either way.
 * Is not:  The files they lie in (ring.h); which of them belong together (recovery.h); the gesture (station): nothing
 *          is computed again.
 * Shape:   little-endian, version 2. A record begins on a fresh block of 4 KiB: no write touches a block that an
 *          earlier record is in.
 *            offset size
 *                 0    8  "glring\r\n"
 *                 8    4  version (2)
 *                12    4  header bytes (160; preamble.h says what later versions keep)
 *                16    8  sequence: 1, 2, 3, ..., one more with every record
 *                24    8  use: 1, 2, 3, ..., one more with every file that is begun or begun anew
 *                32    8  the last eight bytes of the header before (sequence - 1; 0 for sequence 1)
 *                40    8  stroke that it is part of, 1 .. RECORD_STROKE_MAX; 0: a move
 *                48    8  stroke after which that stroke began (0: none; less than stroke)
 *                56    4  bricks that follow
 *                60    4  marks: 1 whole: a state that existed ends here. What one stretch changed may take several
 *                         records, of which only the last is whole
 *                64    8  cursor: the stroke after which the clay stands
 *                72    8  tip: the stroke that redo leads to (the cursor when there is none)
 *                80    8  clay_digest before
 *                88    8  clay_digest after
 *                96    8  number of the next dab
 *               104    8  step of the lattice, mm, IEEE double
 *               112    8  kept: the last sequence that was on the medium before this was written
 *               120    8  bytes of the bricks
 *               128    4  part: 0, 1, 2, ... of its stroke
 *               132    4  0
 *               136    8  bytes that follow: those of the bricks, or fewer: then these are packed (packing.h), and
 *                         are RECORD_PACKED_MOST at the most
 *               144    8  XXH3-64 of the bytes that follow, seeded with the sequence
 *               152    8  XXH3-64 of bytes 0..151
 *          then the bricks, in key order, each the difference between the two sides, bit by bit (exclusive or):
 *                 0   12  brick key: i, j, k as int32
 *                12    4  corners n (1..512)
 *                16   64  which corners: the 8 words of a brick_mask
 *                80   4n  potentials, in slot order
 *             80+4n   4n  RGBA8
 *          A corner that is not stored has potential 0 and COLOUR_NONE (0). A corner is there only if a bit of it
 *          differs; the same change always gives the same bricks. What lies behind, up to the next block, is not
 *          looked at.
 *          Version 1 knew no packing: bytes 136..143 were 0. It is read, not written.
 * Owner:   the caller owns all bytes.
 * Errors:  STATUS_CORRUPT, STATUS_NEWER with the place and what was expected.
 * Cost:    8 bytes a changed corner and 80 a brick, packed to 40 % or so; 700 ns a brick, and half as much for packing.
 * Source:  000 section 3.3. We differ: corners come brick by brick, with a mask in the place of one key each, and in
 *          the place of an old value and a new one stands their difference: half the bytes, and one way to apply them.
 */
#ifndef GLAISE_HISTORY_RECORD_H
#define GLAISE_HISTORY_RECORD_H

#include "clay/brick.h"
#include "history/packing.h"
#include "history/preamble.h"
#include "lattice/lanes.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    RECORD_VERSION = 2,
    RECORD_HEADER_BYTES = 160,
    RECORD_BLOCK_BYTES = 4096,
    RECORD_BRICK_HEAD_BYTES = 80,
    RECORD_CORNER_BYTES = 8,
    RECORD_BRICK_BYTES_MAX = RECORD_BRICK_HEAD_BYTES + BRICK_CORNERS * RECORD_CORNER_BYTES,
    RECORD_PACKED_MOST = 1024 * 1024, /* so that few bytes cannot ask for many */
    RECORD_WHOLE = 1,                 /* mark */
};

/* Far beyond any life's strokes, far below where adding to a number could overflow. */
#define RECORD_STROKE_MAX (UINT64_C(1) << 62)

typedef struct record {
    uint64_t sequence, use, before;
    uint64_t stroke, parent;
    uint32_t bricks, marks, part;
    uint64_t cursor, tip;
    uint64_t digest_before, digest_after;
    uint64_t dab;
    double step_mm;
    uint64_t kept;
    uint64_t bytes;  /* of the bricks */
    uint64_t stored; /* that follow the header; less where they are packed */
    uint64_t check;  /* of those; filled by reading and by sealing */
    uint64_t seal;   /* the header's last eight bytes; likewise */
} record;

/* Bytes from a record's beginning to the next one's. */
static inline uint64_t record_span(uint64_t stored)
{
    const uint64_t n = RECORD_HEADER_BYTES + stored;
    return (n + RECORD_BLOCK_BYTES - 1) / RECORD_BLOCK_BYTES * RECORD_BLOCK_BYTES;
}

/* Lays the difference down at `to`, where there is room for RECORD_BRICK_BYTES_MAX and SIEVE_ROWS_SLACK_BYTES; answers
   the bytes it took, 0 when there is none. NULL: not stored. */
size_t record_put_brick(uint8_t *to, key at, const brick_page *old, const brick_page *now, lanes rows);
/* Lays r->bytes of bricks down as they will lie on the medium, in no more than that, and fills `stored`. */
void record_pack(record *r, packing *with, uint8_t *to, const uint8_t *bricks);
/* Fills check and seal, and the header; what follows it is in place. */
void record_seal(record *r, uint8_t *header);

/* The header alone; bytes are the first `have` from where it should be, PREAMBLE_HEADER_BYTES_MAX of them if there are
   so many. */
STATUS_CHECKED status record_read(record *r_out, const uint8_t *bytes, size_t have, preamble_trouble *trouble_out);
/* The bricks out of r->stored bytes that were sealed, or checked: r->bytes of them. */
STATUS_CHECKED status record_unpack(const record *r, const uint8_t *stored, uint8_t *bricks_out);
/* The same for a header that was read: with the checksum, and all that the bricks alone can show. Offsets count from
   the header's end, or from the first brick. */
STATUS_CHECKED status record_check(const record *r, const uint8_t *stored, uint8_t *bricks_out,
                                   preamble_trouble *trouble_out);

/* A brick of bytes that record_check let pass. */
typedef struct record_brick {
    key at;
    uint32_t corners;
    brick_mask mask;
    const uint8_t *potential, *rgba; /* 4 bytes a corner */
} record_brick;

/* The bytes it takes; 0 when they are no brick. */
size_t record_get_brick(record_brick *b_out, const uint8_t *bytes, size_t left);

#ifdef __cplusplus
}
#endif
#endif
