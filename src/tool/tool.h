/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A tool, and one dab of it: the whole of paper 000 section 3.2 up to the surface. Corners under the tool are
 *          read, acted on and written back, brick by brick; the counts are the paper's.
 * Is not:  A stroke (station cuts those into dabs); the surface's update (surface.h); undo (history.h).
 * Shape:   tool_apply: walk -> which bricks -> act aside -> room? -> act in place -> settle. Bricks that are new,
 *          whose page others hold (pages.h), or that their neighbours read (smooth, stamp) are acted on aside, from
 *          old values only, on a page that becomes theirs; then room is asked for; only then are the others written,
 *          where they lie.
 * Units:   lattice steps; amounts in potential.
 * Owner:   the caller owns everything; scratch is kept between dabs to spare allocations.
 * Errors:  STATUS_BAD_POSE, STATUS_BAD_PARAMETER (amount negative, NaN or over TOOL_AMOUNT_MAX), STATUS_OUT_OF_RANGE,
 *          STATUS_TOO_LARGE, STATUS_POOL_FULL, STATUS_NO_MEMORY: the dab is refused whole, the clay is as it was.
 * Cost:    a box test per visited brick, a vector step per few corners, one tree entry per row of bricks. Counting
 *          walks the box once more, corner by corner, and takes many times as long as the dab.
 * Source:  000 sections 3.2, 4, 6.
 */
#ifndef GLAISE_TOOL_TOOL_H
#define GLAISE_TOOL_TOOL_H

#include "clay/clay.h"
#include "clay/shape.h"
#include "tool/action.h"
#include "tool/frame.h"

#ifdef __cplusplus
extern "C" {
#endif

#define TOOL_AMOUNT_MAX 1e6 /* potential; three is all there can be */

typedef struct tool {
    shape form;
    action kind;
    uint32_t rgba;
    deform def; /* for stamp and print */
} tool;

typedef struct tool_dab {
    frame at;        /* key space */
    double amount;   /* rate x time */
    uint64_t number; /* of the dab within the sculpture: seeds the colour dither */
} tool_dab;

/* As counted in 000 section 6: visited >= computed >= dirtied. */
typedef struct tool_counts {
    uint64_t visited;  /* corners in the grid-aligned box */
    uint64_t computed; /* of these, inside the tool's own box: its potential was evaluated */
    uint64_t dirtied;  /* of these, with a contribution */
    uint32_t bricks;   /* bricks with a dirtied corner */
} tool_counts;

typedef struct tool_scratch {
    pool works; /* one a brick that the tool's box touches */
} tool_scratch;

STATUS_CHECKED status tool_scratch_init(tool_scratch *s, uint32_t bricks);
void tool_scratch_finish(tool_scratch *s);

/* counts_out: NULL where nobody counts. */
STATUS_CHECKED status tool_apply(const tool *t, const tool_dab *d, clay *c, tool_scratch *scratch,
                                 tool_counts *counts_out);

#ifdef __cplusplus
}
#endif
#endif
