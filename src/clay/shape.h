/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The port every function of space speaks: it evaluates a block of points and says where it can be non-zero.
 *          Ellipsoids and freeform tools are shapes; so will be solids and clouds.
 * Is not:  A pose (tool/frame.h places a shape); a surface.
 * Shape:   points come as three arrays of n floats in the shape's own space; potentials go out as n floats in [0, 3].
 * Units:   the shape's own (an ellipsoid: its influence is the unit ball; a piece of clay: its lattice steps).
 * Owner:   whoever made `self`; it must outlive every use, and be safe for several readers at once.
 * Errors:  None: a shape is total. Outside lo..hi the potential is exactly 0.
 * Source:  000 section 4.1.
 */
#ifndef GLAISE_CLAY_SHAPE_H
#define GLAISE_CLAY_SHAPE_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct shape {
    const void *self;
    void (*evaluate)(const void *self, const float *x, const float *y, const float *z, float *potential, int n);
    double lo[3], hi[3]; /* support: the potential is 0 unless lo < p < hi on every axis */
    bool is_ball;        /* the potential is 0 outside the unit ball as well */
    bool wyvill;         /* evaluate is Wyvill's of the unit ball (tool/ellipsoid.h): row kernels need not call it */
} shape;

#ifdef __cplusplus
}
#endif
#endif
