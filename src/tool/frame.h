/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Where a tool is: an affine frame from the tool's space into key space, any rotation, shear and scale.
 * Is not:  What the tool is (shape.h, tool.h); how it got there (station).
 * Shape:   x_key = origin + p[0] axis[0] + p[1] axis[1] + p[2] axis[2]. For an ellipsoid the axes are its semi-axes.
 *
 *              key space            tool space
 *                  axis[1]
 *                 /                    1
 *          origin ---- axis[0]   <=>   0 --- 1
 *
 * Units:   lattice steps.
 * Errors:  STATUS_BAD_POSE for NaN or infinity, an axis shorter than FRAME_AXIS_MIN or longer than FRAME_AXIS_MAX, or
 *          axes so nearly in one plane that the volume is under FRAME_FLAT of the product of their lengths.
 */
#ifndef GLAISE_TOOL_FRAME_H
#define GLAISE_TOOL_FRAME_H

#include "lattice/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FRAME_AXIS_MIN 1e-3
#define FRAME_AXIS_MAX 1e6
#define FRAME_FLAT 1e-6

typedef struct frame {
    double origin[3];
    double axis[3][3]; /* axis[a][c]: component c in key space of tool axis a */
} frame;

/* The tool-from-key map: p[a] = sum_c row[a][c] (x[c] - origin[c]). */
STATUS_CHECKED status frame_invert(const frame *f, double row_out[3][3]);

#ifdef __cplusplus
}
#endif
#endif
