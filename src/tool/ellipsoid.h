/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The ellipsoidal tool: a potential that falls from 3 at the centre to 0 at distance 1, Wyvill's or
 *          box-shaped. The frame's axes make the unit ball an ellipsoid.
 * Is not:  A freeform tool (freeform.h).
 * Shape:   rho = |p|. Wyvill: 3 (1 - rho^2)^2 (9 - 4 rho^2) / 9, no square root. Box-shaped: 3 up to rho = 1 - border,
 *          then a smooth step down: a sheer one would set every vertex at the same fraction of its edge and show
 *          stairs.
 * Units:   the influence is the unit ball; the surface (potential 1.5) of Wyvill's lies at rho = 1/2.
 * Errors:  ELLIPSOID_BORDER_MIN <= border <= 1, else STATUS_BAD_PARAMETER. Choose border >= one lattice step /
 *          semi-axis.
 * Source:  000 section 4.1.1 and figure 8; Wyvill, McPheeters, Wyvill 1986.
 */
#ifndef GLAISE_TOOL_ELLIPSOID_H
#define GLAISE_TOOL_ELLIPSOID_H

#include "clay/shape.h"
#include "lattice/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define ELLIPSOID_BORDER_MIN 1e-3

typedef enum ellipsoid_profile { ELLIPSOID_WYVILL, ELLIPSOID_BOX } ellipsoid_profile;

typedef struct ellipsoid {
    ellipsoid_profile profile;
    float border; /* width of the box-shaped profile's fall, as a part of the radius */
} ellipsoid;

STATUS_CHECKED status ellipsoid_init(ellipsoid *e, ellipsoid_profile profile, double border);
/* The shape refers to e, which must outlive it. */
shape ellipsoid_shape(const ellipsoid *e);

#ifdef __cplusplus
}
#endif
#endif
