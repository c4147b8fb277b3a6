/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The freeform tool: any sculpted clay, duplicated, its field reconstructed tri-linearly as a tool's
 *          potential.
 * Is not:  A link to the piece it came from: sculpting goes on without changing the tool.
 * Shape:   tool space is the duplicate's key space moved so that the middle of its box of stored corners is the origin
 *          (a frame's origin is then the tool's middle). Support: that box grown by one step.
 * Units:   lattice steps of the clay it was made in.
 * Owner:   the freeform owns its clay; freeform_finish frees it.
 * Errors:  STATUS_BAD_PARAMETER when the clay is empty; pools and memory as clay_copy.
 * Source:  000 section 4.1.2.
 */
#ifndef GLAISE_TOOL_FREEFORM_H
#define GLAISE_TOOL_FREEFORM_H

#include "clay/clay.h"
#include "clay/shape.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct freeform {
    clay copy;
    double middle[3]; /* key space of the clay */
    double reach[3];  /* half the support's size, lattice steps */
} freeform;

STATUS_CHECKED status freeform_init(freeform *f, const clay *from);
void freeform_finish(freeform *f);
/* The shape refers to f, which must outlive it. */
shape freeform_shape(const freeform *f);

#ifdef __cplusplus
}
#endif
#endif
