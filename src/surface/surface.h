/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The iso-surface of a piece of clay, kept up to date by looking only at what a dirtied corner has aged.
 *          Patches by brick, each with a generation number, so that a viewer uploads what changed and nothing else.
 * Is not:  A mesh file (exchange); drawing (view); the exact topology of ambiguous cubes (case_table.h).
 * Shape:   a tree from brick key to patch. A patch exists iff one of its cubes crosses. Patches are walked by slot
 *          0..surface_slots-1, NULL where none: slots are stable while the patch lives.
 *              position  t = (F_in - iso) / (F_in - F_out), clamped to [1e-3, 1 - 1e-3] so that vertices stay apart
 *              normal    -(gradients of both ends, interpolated by the unclamped t), length 1
 *              colour    both ends interpolated likewise; an absent end has none
 *          Where the interpolated gradient is shorter than 5e-7 a step the normal is the axis of the edge, outwards.
 *          A patch is looked at when one of its corners aged (aged.h): vertices of aged edges are made anew, the others
 *          stay; its generation moves on only if that gave other vertices or triangles.
 * Units:   lattice steps.
 * Owner:   the caller owns the struct; surface owns patches and their arrays. One surface follows one clay.
 * Errors:  STATUS_POOL_FULL / STATUS_NO_MEMORY: the surface is then partly updated and must be brought back by
 *          surface_update after the clay was put back (what it showed before fits), or by surface_rebuild.
 * Cost:    per brick looked at, some 200 ns; per patch that changes, some 2 us. Counting the treated cubes costs eight
 *          tree entries a brick.
 * Source:  000 section 3.2. We differ: a corner's change also ages the normals of edges at its six neighbours.
 */
#ifndef GLAISE_SURFACE_SURFACE_H
#define GLAISE_SURFACE_SURFACE_H

#include "clay/clay.h"
#include "surface/aged.h"
#include "surface/examined.h"
#include "surface/patch.h"
#include "surface/polygonizer.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where a brick's patch is, so that it need not be searched for: holds for the brick that was born then. */
typedef struct surface_link {
    uint64_t born;
    uint32_t slot;
} surface_link;

typedef struct surface {
    polygonizer_cases cases;
    avl tree;           /* brick key -> patch slot */
    pool patches;       /* patch */
    surface_link *link; /* of brick ids */
    uint32_t links;
    uint32_t orphans;   /* patches of bricks that are not stored */
    struct aged aged;   /* scratch of one update */
    struct examined examined;
    uint64_t generation;                    /* of the latest change of any patch */
    uint64_t triangles, vertices, crossing; /* totals over all patches; vertices counted once per patch */
} surface;

typedef struct surface_counts {
    uint64_t treated;   /* cubes sharing a dirtied corner (000 section 6); rebuild: cubes with a stored corner */
    uint32_t patches;   /* patches with a vertex made; those given back are not among them */
    uint64_t triangles; /* triangles in them */
} surface_counts;

/* patches: limit of patches. */
STATUS_CHECKED status surface_init(surface *s, uint32_t patches);
void surface_finish(surface *s); /* a zeroed one is fine */

/* Brings the surface up to date with the corners marked in c->dirty (which it reads and does not clear).
   counts_out: NULL where nobody counts. */
STATUS_CHECKED status surface_update(surface *s, const clay *c, surface_counts *counts_out);
/* From nothing, all of the clay: what surface_update must equal, vertex for vertex. Every patch gets a new
   generation. */
STATUS_CHECKED status surface_rebuild(surface *s, const clay *c, surface_counts *counts_out);

static inline uint32_t surface_slots(const surface *s) { return s->patches.fresh; }
/* NULL when the slot holds no patch. */
const patch *surface_patch(const surface *s, uint32_t slot);
/* NULL when the brick has no patch. */
const patch *surface_find(const surface *s, key brick_at);

/* Of everything a viewer could see: keys, vertices, triangles of all patches, whatever their slots; 0 when empty. */
uint64_t surface_digest(surface *s);

#ifdef __cplusplus
}
#endif
#endif
