/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The paper's own layout, as the reference of the benchmark: one tree node per corner, per cube, per crossing
 *          cube and per edge. It lives through the same dabs as clay and surface and must arrive at the same field, the
 *          same cubes and the same vertices.
 * Is not:  Part of the program (clay.h and surface.h are); complete (toothpaste and soft eraser, Wyvill's ellipsoid, no
 *          undo-files, no triangle list: the paper draws from the crossing cubes and their indices).
 * Shape:   corners, cubes, crossing, edges: AVL trees of ids into pools. A cube points at its eight corners (NULL:
 *          absent) and twelve edges (NULL: not cut); corner c of a cube = dx + 2 dy + 4 dz, edge e runs along axis
 *          e / 4.
 *
 *              apply  -> corners, modified          update: modified -> cubes -> crossing, edges
 *
 *          An edge's key is that of its two corners, smaller first: six ints in the paper, here packed into three as
 *          (i, j, 3k + 2 - axis). That keeps the order of the six, since of the edges that leave one corner the one
 *          along k has the smallest far end, then the one along j; it needs |k| < 2^31 / 3.
 * Units:   lattice steps; potentials in [0, 3].
 * Owner:   the caller owns the struct, the struct everything else.
 * Errors:  STATUS_POOL_FULL, STATUS_NO_MEMORY, STATUS_BAD_POSE, ...: what is being measured is then lost; finish it.
 * Cost:    apply: a search per dirtied corner. update: eight searches per dirtied corner, one per new or lost edge, six
 *          per gradient, each O(log n). What was found once is kept: pointers in cubes, stamps instead of a second
 *          temporary tree, a gradient per corner and update, an edge refreshed once per update.
 * Source:  000 sections 3.1, 3.2. We differ: a removed corner leaves its tree in the update, not in the dab, so that
 *          one search serves both; displacement vectors start afresh every eight corners, as walk.h has it.
 */
#ifndef GLAISE_BENCH_PER_CORNER_H
#define GLAISE_BENCH_PER_CORNER_H

#include "lattice/avl.h"
#include "tool/tool.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { PER_CORNER_CORNERS = 8, PER_CORNER_EDGES = 12 };

typedef struct per_corner_corner {
    key at;
    uint32_t id;
    float potential;
    uint32_t rgba;
    bool modified;           /* has a node in that tree */
    uint32_t gradient_stamp; /* update that computed the gradient */
    float position[3];
    float gradient[3];
} per_corner_corner;

typedef struct per_corner_edge {
    uint32_t users; /* crossing cubes that contain it */
    uint32_t stamp; /* update that refreshed it */
    float position[3];
    float normal[3];
    uint32_t rgba;
} per_corner_edge;

typedef struct per_corner_cube {
    key at;
    uint32_t stamp; /* update that examined it */
    uint32_t index; /* bit c: corner c is inside */
    per_corner_corner *corner[PER_CORNER_CORNERS];
    per_corner_edge *edge[PER_CORNER_EDGES];
} per_corner_cube;

typedef struct per_corner {
    avl corners, cubes, crossing, edges, modified;
    pool corner_items, cube_items, edge_items;
    per_corner_cube **treated; /* cubes of the update under way */
    size_t treated_count, treated_room;
    uint32_t update; /* number of the update under way */
} per_corner;

/* corners: limit of stored corners; those of cubes and edges follow from it. */
STATUS_CHECKED status per_corner_init(per_corner *p, uint32_t corners);
void per_corner_finish(per_corner *p);

/* The field's half of a dab. kind: ACTION_TOOTHPASTE or ACTION_SOFT_ERASER (asserted); the tool is Wyvill's ellipsoid.
   counts_out->bricks stays 0. */
STATUS_CHECKED status per_corner_apply(per_corner *p, action kind, uint32_t rgba, const tool_dab *d,
                                       tool_counts *counts_out);
/* The surface's half: everything that depends on a modified corner. *treated_out: cubes examined; each has a stored
   corner, or had one. */
STATUS_CHECKED status per_corner_update(per_corner *p, uint64_t *treated_out);

/* Sets one corner, to load a field that was made elsewhere; per_corner_update follows. */
STATUS_CHECKED status per_corner_write(per_corner *p, key at, float potential, uint32_t rgba);
/* NULL when absent. */
const per_corner_corner *per_corner_find(const per_corner *p, key at);
const per_corner_edge *per_corner_find_edge(const per_corner *p, key smaller, int axis);
const per_corner_cube *per_corner_find_cube(const per_corner *p, key at);
size_t per_corner_bytes(const per_corner *p);
/* Between an update and the next dab: each cube points at exactly its stored corners, and has one; each stored corner
   is in eight cubes; edges are pointed at where an index says they are cut. O(n log n). */
bool per_corner_is_valid(const per_corner *p);

#ifdef __cplusplus
}
#endif
#endif
