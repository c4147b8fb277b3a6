/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Makes one patch: reads a brick and the layers round it, says which of its cubes cross the surface, and turns
 *          those into vertices and triangles.
 * Is not:  The keeper of patches, nor does it know which are stale (surface.h).
 * Shape:   polygonizer_look -> polygonizer_crossing -> polygonizer_make; the result stays in `vertices` and `triangles`
 *          until the next make. Order and fields: patch.h; position, normal and colour: surface.h.
 * Units:   lattice steps from the brick's smallest corner.
 * Owner:   the caller; 90 KiB, no memory besides, one per thread. It reads the clay between look and make.
 * Errors:  None.
 * Cost:    look and crossing: rows of eight, a fraction of a microsecond. make: an apron of potentials, then per cut
 *          edge and crossing cube.
 * Source:  000 section 3.2.
 */
#ifndef GLAISE_SURFACE_POLYGONIZER_H
#define GLAISE_SURFACE_POLYGONIZER_H

#include "clay/apron.h"
#include "surface/case_table.h"
#include "surface/patch.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { POLYGONIZER_TRIANGLES_MAX = (int)BRICK_CORNERS * (int)CASE_TABLE_TRIANGLES_MAX };

typedef struct polygonizer {
    const clay *of;
    key at;
    const brick_page *page[8];               /* of the bricks 0..1 an axis, k fastest; NULL where none is stored */
    uint16_t inside[PATCH_SIDE][PATCH_SIDE]; /* [di][dj], bit dk: corners 0..8 at or over iso */
    float potential[APRON_CORNERS_MAX];      /* corners -1..9 an axis */
    uint16_t vertex_of[PATCH_EDGE_NAMES];    /* of cut edges only */
    uint32_t vertex_count, triangle_count;
    patch_vertex vertices[PATCH_VERTICES_MAX];
    uint16_t triangles[POLYGONIZER_TRIANGLES_MAX][3];
} polygonizer;

void polygonizer_look(polygonizer *p, const clay *c, key brick_at);
void polygonizer_crossing(const polygonizer *p, brick_mask *crossing_out);
/* Number of the brick's cubes that have a stored corner: its part of the paper's CubesTree. */
uint32_t polygonizer_stored_cubes(const polygonizer *p);
/* crossing: what polygonizer_crossing said. */
void polygonizer_make(polygonizer *p, const case_table *t, const brick_mask *crossing);

#ifdef __cplusplus
}
#endif
#endif
