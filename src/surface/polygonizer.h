/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Makes one patch: joins a brick's inside bits with those of the bricks above it, says which cubes cross the
 *          surface, and turns those into vertices and triangles. Of a patch that is there already, vertices that have
 *          not aged are kept as they are, and triangles as long as no corner changed sides.
 * Is not:  The keeper of patches, nor does it know which are stale (surface.h, aged.h).
 * Shape:   polygonizer_look -> polygonizer_crossing -> polygonizer_make; the result stays in `vertices` and
 *          `triangles` until the next one. Order and fields: patch.h; position, normal and colour: surface.h.
 *          Cut edges are found row by row in the bits, vertices are made VEC_LANES at a time (polygonizer_rows.c).
 * Units:   lattice steps from the brick's smallest corner.
 * Owner:   the caller; 100 KiB, no memory besides, one per thread. It reads the clay between look and make.
 * Errors:  None. All lanes give the same bits.
 * Cost:    look and crossing: words of 64 corners, some 50 ns. make: an apron of potentials, then per cut edge and
 *          crossing cube.
 * Source:  000 section 3.2.
 */
#ifndef GLAISE_SURFACE_POLYGONIZER_H
#define GLAISE_SURFACE_POLYGONIZER_H

#include "clay/apron.h"
#include "lattice/lanes.h"
#include "surface/case_table.h"
#include "surface/patch.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The last cube's triangles are written as the most a cube can have. */
enum { POLYGONIZER_TRIANGLES_MAX = (int)BRICK_CORNERS * (int)CASE_TABLE_TRIANGLES_MAX + (int)CASE_TABLE_TRIANGLES_MAX };

/* One bit for each corner 0..8 an axis: [di][dj], bit dk. */
typedef struct polygonizer_bits {
    uint16_t row[PATCH_SIDE][PATCH_SIDE];
} polygonizer_bits;

/* A vertex to be made is ordered as a word of bytes: its edge's smaller corner di, dj, dk, then its axis. The last
   vector of orders is filled up. */
enum { POLYGONIZER_ORDERS_MAX = PATCH_VERTICES_MAX + 16 };

typedef struct polygonizer {
    const clay *of;
    key at;
    uint32_t brick_id;          /* id, or POOL_NONE */
    const brick *above[8];      /* the bricks 0..1 an axis, k fastest; NULL where none is stored */
    polygonizer_bits inside;    /* corners at or over iso: polygonizer_make */
    float potential[APRON_CORNERS_MAX]; /* corners -1..9 an axis */
    const uint32_t *rgba[8];            /* colours of the bricks above */
    uint16_t vertex_of[PATCH_EDGE_NAMES];    /* of cut edges only */
    uint32_t vertex_count, triangle_count, order_count, crossing_count;
    uint16_t first[PATCH_SIDE]; /* as the patch's */
    uint32_t order[POLYGONIZER_ORDERS_MAX];
    uint16_t order_vertex[PATCH_VERTICES_MAX]; /* which vertex it will be */
    patch_vertex vertices[PATCH_VERTICES_MAX];
    uint16_t triangles[POLYGONIZER_TRIANGLES_MAX][3];
} polygonizer;

/* The case table, its edges by the names they have in a patch, for the cube at (0, 0, 0). */
typedef struct polygonizer_cases {
    uint8_t triangles[CASE_TABLE_CASES];
    uint16_t name[CASE_TABLE_CASES][16];
} polygonizer_cases;
void polygonizer_cases_init(polygonizer_cases *p);

/* What became of a patch. */
typedef enum polygonizer_outcome {
    POLYGONIZER_SAME,     /* no vertex was made */
    POLYGONIZER_VERTICES, /* those of `vertices` that `orders` name are new; the patch's others and triangles hold */
    POLYGONIZER_ALL,      /* vertices and triangles are new */
} polygonizer_outcome;

/* brick_id: of the brick at brick_at, POOL_NONE when it is not stored. */
void polygonizer_look(polygonizer *p, const clay *c, key brick_at, uint32_t brick_id);
void polygonizer_crossing(const polygonizer *p, brick_mask *crossing_out);
/* Number of the brick's cubes that have a stored corner: its part of the paper's CubesTree. */
uint32_t polygonizer_stored_cubes(const polygonizer *p);

/* polygonizer_rows.c. */
polygonizer_outcome polygonizer_make_plain(polygonizer *p, const polygonizer_cases *t, const brick_mask *crossing,
                                           const brick_mask *const aged_at[8], const patch *old);
polygonizer_outcome polygonizer_make_avx2(polygonizer *p, const polygonizer_cases *t, const brick_mask *crossing,
                                          const brick_mask *const aged_at[8], const patch *old);
polygonizer_outcome polygonizer_make_avx512(polygonizer *p, const polygonizer_cases *t, const brick_mask *crossing,
                                            const brick_mask *const aged_at[8], const patch *old);
/* crossing: what polygonizer_crossing said. old: the patch as it was; NULL: there was none, or all is to be made.
   aged_at: of the eight bricks of `above`, the corners that aged since; NULL: none. */
static inline polygonizer_outcome polygonizer_make(polygonizer *p, const polygonizer_cases *t,
                                                   const brick_mask *crossing, const brick_mask *const aged_at[8],
                                                   const patch *old)
{
    return LANES_PICK(polygonizer_make, p->of->rows)(p, t, crossing, aged_at, old);
}

#ifdef __cplusplus
}
#endif
#endif
