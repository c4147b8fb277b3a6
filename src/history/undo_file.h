/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    One stroke as bytes: every corner it changed, as it was and as it became. Applied backwards it undoes the
 *          stroke, forwards it redoes it.
 * Is not:  The file's name and its place in the ring (undo_ring.h); the gesture (station): nothing is computed again.
 * Shape:   little-endian, version 1:
 *            offset size
 *                 0    8  "glundo\r\n"
 *                 8    4  version (1)
 *                12    4  header bytes (88; preamble.h says what later versions keep)
 *                16    8  stroke number, 1 .. UNDO_FILE_STROKE_MAX
 *                24    8  clay_digest before the stroke
 *                32    8  clay_digest after it
 *                40    8  number of the next dab after it
 *                48    8  bricks B that follow (1 or more)
 *                56    8  changed corners C in all of them
 *                64    8  bytes of the file: 88 + 88 B + 16 C
 *                72    4  files in the ring it was written into
 *                76    4  0
 *                80    8  XXH3-64 of bytes 0..79
 *          then per brick, in key order:
 *                 0   12  brick key: i, j, k as int32
 *                12    4  changed corners n (1..512)
 *                16   64  which corners: the 8 words of a brick_mask
 *                80   4n  old potentials, in slot order
 *            80+ 4n   4n  old RGBA8
 *            80+ 8n   4n  new potentials
 *            80+12n   4n  new RGBA8
 *            80+16n    8  XXH3-64 of bytes 0..80+16n-1 of this brick, seeded with the digest after: a brick of
 *                         another stroke does not pass
 *          A corner that is not stored has potential 0 and COLOUR_NONE. A corner is in the file only if its potential
 *          or its colour differ; the same change always gives the same bytes.
 * Owner:   the caller owns buffer and facts.
 * Errors:  STATUS_CORRUPT, STATUS_NEWER with the place and what was expected. undo_file_check looks at everything that
 *          the bytes alone can show; only bytes it let pass may be applied.
 * Cost:    16 bytes a changed corner; encoding compares the pages of the bricks that were opened. A stroke over all of
 *          CAPACITY_BRICKS at 170 corners a brick makes 0.7 GB, a usual one 10 to 500 kB.
 * Source:  000 section 3.3. We differ: corners come brick by brick, with a mask in the place of one key each.
 */
#ifndef GLAISE_HISTORY_UNDO_FILE_H
#define GLAISE_HISTORY_UNDO_FILE_H

#include "clay/clay.h"
#include "history/byte_buffer.h"
#include "history/preamble.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { UNDO_FILE_VERSION = 1, UNDO_FILE_HEADER_BYTES = 88 };

/* Far beyond any life's strokes, far below where adding to a number could overflow. */
#define UNDO_FILE_STROKE_MAX (UINT64_C(1) << 62)

typedef struct undo_file_facts {
    uint64_t stroke;
    uint64_t digest_before, digest_after;
    uint64_t dab;
    uint32_t ring;
    uint64_t bricks, corners, bytes; /* filled by encoding and by reading */
} undo_file_facts;

/* The change recorded in c, from the images to the clay as it is. When facts->corners is 0 afterwards nothing changed
   and the bytes are no file. STATUS_NO_MEMORY. */
STATUS_CHECKED status undo_file_encode(const clay *c, undo_file_facts *facts, byte_buffer *out);

/* The header alone; bytes are the first `have` of the file, PREAMBLE_HEADER_BYTES_MAX of them if it has so many. */
STATUS_CHECKED status undo_file_read_facts(undo_file_facts *facts_out, const uint8_t *bytes, size_t have,
                                           preamble_trouble *trouble_out);
/* The whole file. */
STATUS_CHECKED status undo_file_check(undo_file_facts *facts_out, const uint8_t *bytes, size_t size,
                                      preamble_trouble *trouble_out);

typedef enum undo_file_direction { UNDO_FILE_BACK, UNDO_FILE_FORTH } undo_file_direction;

/*
 * Takes the clay from the one side to the other, whole or not at all, and marks the dirt. STATUS_CORRUPT when some
 * corner of the clay is not what the file says it should be; STATUS_POOL_FULL, STATUS_NO_MEMORY.
 * Nothing may be recorded before. After STATUS_OK the step itself is recorded as a change: the caller ends it, or
 * reverts it if what it meant to do besides failed.
 */
STATUS_CHECKED status undo_file_apply(clay *c, const uint8_t *bytes, size_t size, undo_file_direction direction,
                                      preamble_trouble *trouble_out);

#ifdef __cplusplus
}
#endif
#endif
