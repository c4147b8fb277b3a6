/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The whole field as bytes: the native sculpture file, and what history rests on. One format for both.
 * Is not:  A mesh (exchange); the ring of undo-files (history.h).
 * Shape:   little-endian, version 3:
 *            offset size
 *                 0    8  "glaise\r\n"
 *                 8    4  version (3)
 *                12    4  header bytes (96; preamble.h says what later versions keep)
 *                16    8  step of the lattice, mm, IEEE double
 *                24    8  sequence: number of the last record in it (0: none)
 *                32    8  dab number
 *                40    8  bricks that follow
 *                48    8  clay_digest of the whole
 *                56    8  cursor: the stroke after which the clay stands (0: none)
 *                64    8  tip: the stroke that redo leads to (the cursor when there is none)
 *                72    8  the last eight bytes of that last record's header (record.h)
 *                80    8  0
 *                88    8  XXH3-64 of bytes 0..87
 *          then blocks, until all bricks are there:
 *                 0    4  bytes n of the bricks in it, 1..CHECKPOINT_BLOCK_BYTES
 *                 4    4  bytes m that follow: m = n, or fewer: then they are packed (packing.h)
 *                 8    m
 *               8+m    8  XXH3-64 of bytes 0..8+m-1 of this block
 *          and nothing after the last block. In them, in key order, none in two blocks, the bricks:
 *                 0   12  brick key: i, j, k as int32
 *                12    4  stored corners n (1..512)
 *                16   64  which corners: the 8 words of a brick_mask
 *                80   4n  potentials, in slot order
 *            80+4n    4n  RGBA8
 *          The same field always gives the same bricks in the same blocks.
 *          Version 2 had no blocks: the bricks followed the header, each with the XXH3-64 of its bytes behind it. The
 *          header of version 1 had 64 bytes, of which 0..55 are those of version 2, then its checksum; its sequence
 *          was the stroke after which the clay stood. Both are read, not written.
 * Units:   the step in millimetres, keys in lattice steps.
 * Owner:   the caller gives a sink or a source; nothing is kept.
 * Errors:  STATUS_CORRUPT, STATUS_NEWER with the place and what was expected in `trouble`; STATUS_POOL_FULL when the
 *          clay's limit is below what the file holds; the clay is then untouched (reading goes into a clay of its own
 *          first). Hostile counts never allocate more than the bytes could hold.
 * Cost:    one pass through a block of 64 KiB, most of it packing (600 MB/s; unpacking 1.5 GB/s): a quarter of the
 *          field's bytes reach the medium. Reading holds the old clay and the new until the end.
 * Source:  000 section 2 ("an internal format which writes the whole field").
 */
#ifndef GLAISE_HISTORY_CHECKPOINT_H
#define GLAISE_HISTORY_CHECKPOINT_H

#include "clay/clay.h"
#include "history/packing.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    CHECKPOINT_VERSION = 3,
    CHECKPOINT_HEADER_BYTES = 96,
    CHECKPOINT_BLOCK_BYTES = 65536,
    CHECKPOINT_FRAME_BYTES = 16, /* before and behind what a block holds */
    CHECKPOINT_SLACK_BYTES = 64,
};

typedef struct checkpoint_facts {
    uint32_t version; /* filled when read */
    double step_mm;
    uint64_t sequence, cursor, tip;
    uint64_t seal;   /* of the record `sequence` */
    uint64_t dab;
    uint64_t bricks; /* filled when read */
    uint64_t digest;
} checkpoint_facts;

/* Where and why reading stopped. */
typedef struct checkpoint_trouble {
    uint64_t offset; /* in the file; of a brick that is packed: of its block */
    char expected[80]; /* "brick key above the one before", ... */
} checkpoint_trouble;

/* Takes n bytes, in order; anything but STATUS_OK ends the writing. */
typedef status (*checkpoint_sink)(void *self, const void *bytes, size_t n);
/* Gives up to n bytes from offset, fewer only at the end. */
typedef status (*checkpoint_source)(void *self, uint64_t offset, void *bytes, size_t n, size_t *got_out);

/* Writing bit by bit. The clay does not change until it is done: it is a still (clay/freeze.h), or nobody works on it
   meanwhile. The caller owns the struct; nothing in it wants finishing. */
typedef struct checkpoint_writer {
    const clay *c;
    avl_walk walk;
    key at;
    uint32_t id;
    bool more;
    packing *with;
    checkpoint_sink sink;
    void *self;
    uint8_t header[CHECKPOINT_HEADER_BYTES];
    bool headed; /* the header is written */
    size_t used; /* of the block */
    uint8_t block[CHECKPOINT_BLOCK_BYTES + CHECKPOINT_SLACK_BYTES];
    uint8_t packed[CHECKPOINT_BLOCK_BYTES + CHECKPOINT_FRAME_BYTES];
} checkpoint_writer;

/* facts->digest is clay_digest; bricks are counted here. O(bricks). */
void checkpoint_writer_begin(checkpoint_writer *w, const clay *c, const checkpoint_facts *facts, packing *with,
                             checkpoint_sink sink, void *self);
/* Writes `bytes` of bricks or little more; *done_out after the last of them. */
STATUS_CHECKED status checkpoint_writer_step(checkpoint_writer *w, size_t bytes, bool *done_out);
/* All at once. */
STATUS_CHECKED status checkpoint_write(const clay *c, const checkpoint_facts *facts, checkpoint_sink sink, void *self);
/* Into an initialised clay, whose content is replaced whole or not at all (its limit stays). Every corner that is
   stored, and every brick that was, is marked dirty. Nothing may be recorded at this time. */
STATUS_CHECKED status checkpoint_read(clay *c, checkpoint_facts *facts_out, checkpoint_source source, void *self,
                                      checkpoint_trouble *trouble_out);
/* The header alone. */
STATUS_CHECKED status checkpoint_read_facts(checkpoint_facts *facts_out, checkpoint_source source, void *self,
                                            checkpoint_trouble *trouble_out);

#ifdef __cplusplus
}
#endif
#endif
