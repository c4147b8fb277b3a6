/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A brick together with the layers round it, copied out of the neighbours into one dense block, so that
 *          stencils (smoothing, gradients, cubes) read plain memory across brick borders.
 * Is not:  A view: it is a copy, old values stay in it while the clay is written.
 * Shape:   corners APRON_LO..hi relative to the brick on each axis, n = hi - APRON_LO + 1 a side, k fastest:
 *          slot ((di+1)*n + (dj+1))*n + (dk+1). Smoothing wants hi = 8 (n = 10), the surface hi = 9 (n = 11).
 * Errors:  None: absent corners read POTENTIAL_MIN and COLOUR_NONE.
 * Cost:    n^3 floats copied in rows; no search when the brick is stored.
 */
#ifndef GLAISE_CLAY_APRON_H
#define GLAISE_CLAY_APRON_H

#include "clay/clay.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { APRON_LO = -1, APRON_HI_MAX = 9, APRON_SIDE_MAX = 11, APRON_CORNERS_MAX = 1331 };

/* Rows of an apron: corners from..to (inclusive) along i and j. */
typedef struct apron_rows {
    int8_t from_i, to_i, from_j, to_j;
} apron_rows;

/* Only some rows of the potentials; the others are left as they are. */
void apron_gather_rows(const clay *c, const uint32_t neighbours[BRICK_NEIGHBOURS], int hi, apron_rows rows,
                       float *potential);
/* Either may be NULL. hi in 8..9. */
void apron_gather(const clay *c, const uint32_t neighbours[BRICK_NEIGHBOURS], int hi, float *potential, uint32_t *rgba);

#ifdef __cplusplus
}
#endif
#endif
