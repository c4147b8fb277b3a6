/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The actions of action.h on a whole brick, as many corners at once as the machine's vectors hold: walk,
 *          tool's potential, action, limits of the field and masks of what came of it, in one pass over the page.
 * Is not:  The definition of the actions (action.h); the choice of bricks (tool.h).
 * Shape:   slabs of 64 corners, vectors along dj and dk. Where the tool's potential is 0 nothing is read or written.
 * Units:   lattice steps outside, the shape's inside.
 * Errors:  None. All lanes give the same bits, those of action_row followed by clay_brick_close.
 * Cost:    some 3 ns a dirtied corner with 8 lanes, most of it the colour.
 * Source:  as action.h and walk.h.
 */
#ifndef GLAISE_TOOL_ACTION_ROWS_H
#define GLAISE_TOOL_ACTION_ROWS_H

#include "clay/clay.h"
#include "clay/colour.h"
#include "clay/shape.h"
#include "lattice/lanes.h"
#include "tool/action.h"
#include "tool/walk.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The same for all bricks of a dab. */
typedef struct action_rows_dab {
    const action_setting *set;
    const shape *form;
    const walk *path;
    uint32_t dither[64]; /* of colour_dither, for corner (0, dj, dk) and this dab */
} action_rows_dab;

typedef struct action_rows_brick {
    key at;             /* brick key */
    brick_page *page;   /* in: as the brick is; out: as it becomes */
    const float *mean;  /* smooth: L[F] of the 512 corners (action_rows_mean); else NULL */
    clay_written now;   /* in: inside and stored as the page has them; out: what came of it */
    brick_mask fresh;   /* out: clay that smooth or stamp made; its colour is left to the caller */
} action_rows_brick;

bool action_rows_plain(const action_rows_dab *d, action_rows_brick *b);
bool action_rows_avx2(const action_rows_dab *d, action_rows_brick *b);
bool action_rows_avx512(const action_rows_dab *d, action_rows_brick *b);
void action_rows_mean_plain(const float *apron, float mean_out[BRICK_CORNERS]);
void action_rows_mean_avx2(const float *apron, float mean_out[BRICK_CORNERS]);
void action_rows_mean_avx512(const float *apron, float mean_out[BRICK_CORNERS]);

static inline action_rows_dab action_rows_begin(const action_setting *set, const shape *form, const walk *path)
{
    action_rows_dab d;
    d.set = set;
    d.form = form;
    d.path = path;
    for (uint32_t n = 0; n < 64; n++)
        d.dither[n] = (n >> 3) * COLOUR_STEP_J + (n & 7) * COLOUR_STEP_K + (uint32_t)set->dab * COLOUR_STEP_DAB;
    return d;
}
/* Answers whether any corner is dirtied. */
static inline bool action_rows(const action_rows_dab *d, action_rows_brick *b, lanes l)
{
    return LANES_PICK(action_rows, l)(d, b);
}
/* The binomial mean at each of a brick's corners, from its apron (hi 8). */
static inline void action_rows_mean(const float *apron, float mean_out[BRICK_CORNERS], lanes l)
{
    LANES_PICK(action_rows_mean, l)(apron, mean_out);
}

#ifdef __cplusplus
}
#endif
#endif
