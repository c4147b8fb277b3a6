/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The stamp's deformation function: what a tool of potential v_tool adds to the clay, removal inside, a bulge
 *          outside, as three cubic pieces of v = 3 - v_tool and 0 beyond them.
 * Is not:  The tool's own contribution (shape.h); how it is applied (action.h has both readings).
 * Shape:      n        ___                     v:  0         the tool's centre, def = -1
 *             0 ______/   \____                    s         its surface, def = 0, slope kappa
 *                    /|    |   |                   s+m       the bulge's crest, def = n
 *            -1 ____/ s   s+m  s+m+r               s+m+r     its end, 0 from here on
 * Units:   v, s, m, r in potential; n as a part of the tool's whole effect; kappa = slope at s, per potential.
 * Errors:  deform_init: STATUS_BAD_PARAMETER unless s = 3 - iso, m > 0, r > 0, 0 <= n <= 3,
 *          kappa >= 0, s + m + r <= 3, all finite.
 *          kappa is clamped to min(3/s, 3n/m): beyond, a piece would overshoot.
 * Source:  000 section 4.3, figures 10 to 12. We differ: v runs from the centre outwards (read literally, the printed
 *          argument erases the world); the third piece's cubic term is +2n/r^3 and its square term -3n/r^2 (as
 *          printed it does not end at 0); kappa = -k, since the curve rises through s.
 */
#ifndef GLAISE_TOOL_DEFORM_H
#define GLAISE_TOOL_DEFORM_H

#include "lattice/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct deform {
    double s, m, r; /* where the pieces join */
    double n;       /* height of the bulge, <= 3 */
    double kappa;   /* slope at s, after clamping */
    float piece[3][4]; /* coefficients of u^3, u^2, u, 1 with u from the piece's start */
} deform;

STATUS_CHECKED status deform_init(deform *d, double s, double m, double r, double n, double kappa);
/* s 1.5, m 0.4, r 0.9, n 0.3, kappa 1: a soft rim, for most clay. */
deform deform_default(void);
/* v = POTENTIAL_MAX - v_tool; any v (at or under 0 reads as 0). */
float deform_at(const deform *d, float v);

#ifdef __cplusplus
}
#endif
#endif
