/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The walkthrough: every corner of the grid-aligned box round a tool, in key space and tool space at once, the
 *          tool-space point reached by adding displacement vectors instead of transforming.
 * Is not:  The evaluation of the tool (shape.h) or what is done to the corners (action.h).
 * Shape:   box: per axis k from floor(c_k - e_k) to floor(c_k + e_k), e_k the half extents of the oriented box.
 *          Walked by brick, rows of eight. Per brick one point is transformed; corner (di,dj,dk) of it lies at
 *              start + along[di] + plane[dj][dk]
 *          so the only error against the direct transform is the rounding of these numbers and two float additions.
 * Units:   lattice steps outside, the shape's units inside.
 * Errors:  see walk_begin.
 * Cost:    bricks whose box misses the oriented box are rejected whole; visited counts their corners all the same,
 *          as the paper does.
 * Source:  000 section 3.2 and figure 6; counts as in its section 6; the box convention reproduces its table.
 */
#ifndef GLAISE_TOOL_WALK_H
#define GLAISE_TOOL_WALK_H

#include "clay/brick.h"
#include "clay/shape.h"
#include "lattice/box.h"
#include "tool/frame.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct walk {
    box corners; /* the whole range, clipped to KEY_MIN..KEY_MAX */
    box bricks;
    box reached; /* bricks that the shape itself can reach: of a ball, fewer than those of the box round it */
    double row[3][3]; /* tool from key */
    double origin[3];
    double lo[3], hi[3];      /* the shape's support, tool space */
    bool is_ball;             /* and it lies in the unit ball */
    double brick_reach[3];    /* half the size of a brick's box in tool space, with what roundings may add */
    float slab_middle[3];     /* of a slab's box in tool space, from its first corner */
    float slab_reach[3];      /* half the box's size, with what roundings may add */
    float along[3][8];        /* [tool axis][di] displacement */
    float plane[3][64];       /* [tool axis][dj * 8 + dk] displacement */
    double visited;           /* corners in the range */
} walk;

/* STATUS_BAD_POSE from frame_invert; STATUS_OUT_OF_RANGE when the whole box lies beyond the lattice; STATUS_TOO_LARGE
   when it covers more than CAPACITY_DAB_BRICKS bricks. */
STATUS_CHECKED status walk_begin(walk *w, const frame *f, const shape *s);
/* Largest |tool point by addition - tool point by direct transform| along a tool axis: four roundings of numbers no
   larger than the support and one brick's displacement together. */
double walk_bound(const walk *w, int tool_axis);
/* Can any corner of this brick lie inside the oriented box? Never false wrongly. */
bool walk_touches(const walk *w, key brick_at);
/* The same, and inside the ball where the shape is one: can its potential there be anything but 0? */
bool walk_reaches(const walk *w, key brick_at);
/* Tool-space point of the brick's first corner. */
void walk_start(const walk *w, key brick_at, float start_out[3]);
/* Tool-space points of the eight corners of row (di, dj): x, y, z. */
void walk_row(const walk *w, const float start[3], int di, int dj, float x[8], float y[8], float z[8]);
/* Bit dk set: that corner of the row is in the world range and strictly inside the oriented box. */
unsigned walk_inside(const walk *w, key brick_at, int di, int dj, const float x[8], const float y[8], const float z[8]);

#ifdef __cplusplus
}
#endif
#endif
