/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Counts the cubes that share a dirtied corner: those that the paper's update examines one by one.
 * Is not:  What our update looks at (aged.h): it needs no count, and this is made only where somebody asks.
 * Shape:   a dirtied corner's cubes lie 0 or 1 step below it on each axis: its mask is moved down, one axis after the
 *          other, into up to eight bricks, and united there, so that every cube counts once.
 * Owner:   surface: scratch.
 * Errors:  STATUS_NO_MEMORY; STATUS_POOL_FULL beyond the limit.
 * Cost:    eight tree entries a dirty brick.
 * Source:  000 section 3.2 ("the eight Cubes that share it ... only once each dirtied Cube").
 */
#ifndef GLAISE_SURFACE_EXAMINED_H
#define GLAISE_SURFACE_EXAMINED_H

#include "clay/dirt.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct examined {
    dirt cubes; /* named by their smallest corner */
} examined;

STATUS_CHECKED status examined_init(examined *e, uint32_t limit);
void examined_finish(examined *e); /* a zeroed one is fine */
STATUS_CHECKED status examined_count(examined *e, const dirt *d, uint64_t *cubes_out);

#ifdef __cplusplus
}
#endif
#endif
