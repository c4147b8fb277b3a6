/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A box of keys, both ends inclusive; empty when any min exceeds its max.
 * Is not:  A box in space (shape.h bounds itself in its own coordinates, in doubles).
 * Units:   lattice steps.
 * Errors:  None; box_count cannot overflow: it is a double, exact up to 2^53 and rounded beyond.
 */
#ifndef GLAISE_LATTICE_BOX_H
#define GLAISE_LATTICE_BOX_H

#include "lattice/key.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct box {
    key min, max;
} box;

static inline box box_empty(void)
{
    box b = {{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
    return b;
}

static inline bool box_is_empty(box b) { return b.min.i > b.max.i || b.min.j > b.max.j || b.min.k > b.max.k; }

static inline bool box_contains(box b, key c)
{
    return c.i >= b.min.i && c.i <= b.max.i && c.j >= b.min.j && c.j <= b.max.j && c.k >= b.min.k && c.k <= b.max.k;
}

static inline box box_include(box b, key c)
{
    b.min.i = c.i < b.min.i ? c.i : b.min.i;
    b.min.j = c.j < b.min.j ? c.j : b.min.j;
    b.min.k = c.k < b.min.k ? c.k : b.min.k;
    b.max.i = c.i > b.max.i ? c.i : b.max.i;
    b.max.j = c.j > b.max.j ? c.j : b.max.j;
    b.max.k = c.k > b.max.k ? c.k : b.max.k;
    return b;
}

/* Number of keys inside; 0 when empty. */
static inline double box_count(box b)
{
    if (box_is_empty(b))
        return 0;
    return ((double)b.max.i - b.min.i + 1) * ((double)b.max.j - b.min.j + 1) * ((double)b.max.k - b.min.k + 1);
}

/* The bricks that hold the corners of b; empty when b is. */
static inline box box_of_bricks(box b)
{
    if (box_is_empty(b))
        return box_empty(); /* its ends may share a brick */
    box r = {key_brick(b.min), key_brick(b.max)};
    return r;
}

#ifdef __cplusplus
}
#endif
#endif
