/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The field between the corners: tri-linear value, colour and gradient anywhere in space, and the gradient
 *          at a corner by central differences across brick borders.
 * Is not:  Smooth: C0 only, as the papers have it.
 * Shape:   a cursor keeps the brick it was in, so that walks along a row search once per brick. Begin a new one when
 *          the clay has changed.
 * Units:   positions in lattice steps (key space); gradients in potential per lattice step.
 * Errors:  None. Positions beyond KEY_MIN..KEY_MAX, and NaN, read as empty.
 * Cost:    eight corner reads, no search while inside one brick.
 * Source:  000 sections 3.1 (gradient), 4.1.2 (tri-linear reconstruction). We differ: an absent corner has no colour,
 *          so it takes no part in a colour.
 */
#ifndef GLAISE_CLAY_RECONSTRUCT_H
#define GLAISE_CLAY_RECONSTRUCT_H

#include "clay/clay.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct reconstruct {
    const clay *of;
    key at; /* brick the ids belong to */
    bool known;
    uint32_t ids[BRICK_NEIGHBOURS];
} reconstruct;

static inline reconstruct reconstruct_begin(const clay *of)
{
    reconstruct r = {of, {0, 0, 0}, false, {0}};
    return r;
}

/* Potential at p; *rgba_out (may be NULL) is the mean of the stored corners' colours, by weight; COLOUR_NONE if
   none. */
float reconstruct_potential(reconstruct *r, double x, double y, double z, uint32_t *rgba_out);
void reconstruct_gradient(reconstruct *r, double x, double y, double z, float gradient_out[3]);
void reconstruct_corner_gradient(reconstruct *r, key corner, float gradient_out[3]);

#ifdef __cplusplus
}
#endif
#endif
