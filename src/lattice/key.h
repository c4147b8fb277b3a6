/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The key of a lattice point: three int32, ordered lexicographically (i, then j, then k). The same
 *          type names corners (the sampling lattice) and bricks (the lattice divided by eight, rounded down).
 * Is not:  A position in millimetres (sculpture.h holds the step); a potential (clay.h).
 * Shape:   k runs fastest wherever keys are stored in order.
 * Units:   lattice steps.
 * Cost:    everything here is a handful of instructions.
 * Source:  000 section 3.1 (corner key, lexicographic order).
 */
#ifndef GLAISE_LATTICE_KEY_H
#define GLAISE_LATTICE_KEY_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct key {
    int32_t i, j, k;
} key;

enum { KEY_BRICK_SHIFT = 3 }; /* a brick is 2^3 corners along each axis */

/* Corners that may be stored. The two outermost layers of bricks stay empty, so that every cube has all its eight
   keys, every surface closes, and key +- 8 never overflows. Both ends are ends of a brick. */
#define KEY_MIN (INT32_MIN + 16)
#define KEY_MAX (INT32_MAX - 16)

static inline int key_compare(key a, key b)
{
    if (a.i != b.i)
        return a.i < b.i ? -1 : 1;
    if (a.j != b.j)
        return a.j < b.j ? -1 : 1;
    if (a.k != b.k)
        return a.k < b.k ? -1 : 1;
    return 0;
}

static inline bool key_equal(key a, key b) { return a.i == b.i && a.j == b.j && a.k == b.k; }

static inline key key_add(key a, int32_t di, int32_t dj, int32_t dk)
{
    key r = {a.i + di, a.j + dj, a.k + dk};
    return r;
}

/* May a corner with this key be stored? */
static inline bool key_in_range(key c)
{
    return c.i >= KEY_MIN && c.i <= KEY_MAX && c.j >= KEY_MIN && c.j <= KEY_MAX && c.k >= KEY_MIN && c.k <= KEY_MAX;
}

/* Brick that holds a corner. Right shift of a negative int is arithmetic on every compiler we build with. */
static inline key key_brick(key c)
{
    key b = {c.i >> KEY_BRICK_SHIFT, c.j >> KEY_BRICK_SHIFT, c.k >> KEY_BRICK_SHIFT};
    return b;
}

/* Smallest corner of a brick; the brick key must be one that key_brick can answer. */
static inline key key_of_brick(key b)
{
    key c = {b.i * 8, b.j * 8, b.k * 8};
    return c;
}

/* May a brick with this key be stored? KEY_MIN..KEY_MAX are whole bricks, so all of its corners may or none. Asked of
   the brick key itself: key_of_brick would overflow for keys that come from a damaged file. */
static inline bool key_brick_in_range(key b)
{
    const int32_t lo = KEY_MIN >> KEY_BRICK_SHIFT, hi = KEY_MAX >> KEY_BRICK_SHIFT;
    return b.i >= lo && b.i <= hi && b.j >= lo && b.j <= hi && b.k >= lo && b.k <= hi;
}

/* Place of a corner inside its brick, 0..511, k fastest. */
static inline int key_slot(key c) { return ((c.i & 7) << 6) | ((c.j & 7) << 3) | (c.k & 7); }

#ifdef __cplusplus
}
#endif
#endif
