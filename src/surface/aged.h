/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What a set of dirtied corners has aged: the corners whose potential, colour or gradient may be another now,
 *          and the bricks whose patches such corners may have changed.
 * Is not:  The dirtied corners (clay/dirt.h); what crosses the surface (polygonizer.h).
 * Shape:   entries 0..count-1, each brick once. A central difference reads six neighbours: a corner ages when it was
 *          dirtied, or one of its six neighbours moved. A patch reads corners 0..8 an axis: the brick of an aged corner
 *          is listed, and the bricks below it that reach up to it. Of a brick that is not stored all corners count as
 *          aged; it is listed only where it may have a patch.
 * Owner:   surface: scratch of one update. Ids of entries hold until the next aged_mark.
 * Errors:  STATUS_NO_MEMORY; STATUS_POOL_FULL beyond the limit.
 * Cost:    some 20 ns a brick to list it, words of 64 corners to age it, which is done only where it is asked for; no
 *          search for stored bricks.
 * Source:  000 section 3.2. We differ: the paper lets the normals beside a dab age.
 */
#ifndef GLAISE_SURFACE_AGED_H
#define GLAISE_SURFACE_AGED_H

#include "clay/clay.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct aged_brick {
    key at;         /* brick key */
    uint32_t brick_id; /* POOL_NONE: not stored */
    brick_mask corners; /* of those wanted, once aged_corners was there */
    bool is_wanted;
    bool may_cross; /* not stored: may have cubes that cross although it had no patch */
    /* For the surface's own use while it works the entries off. */
    brick_mask crossing;
    uint32_t slot;
    uint32_t outcome;
} aged_brick;

typedef struct aged_link {
    uint32_t round, entry;
} aged_link;

typedef struct aged {
    pool entries;
    avl absent;      /* brick key -> entry, of bricks that are not stored */
    aged_link *link; /* of brick ids */
    uint32_t links;
    uint32_t round;  /* links of other rounds are void */
    bool gone;       /* a dirty brick is not stored any more */
} aged;

STATUS_CHECKED status aged_init(aged *a, uint32_t limit);
void aged_finish(aged *a); /* a zeroed one is fine */

/* All that follows from c's dirt. orphans: are there patches of bricks that are not stored? */
STATUS_CHECKED status aged_mark(aged *a, const clay *c, bool orphans);

static inline uint32_t aged_count(const aged *a) { return a->entries.count; }
static inline aged_brick *aged_at(const aged *a, uint32_t n) { return (aged_brick *)pool_at(&a->entries, n); }
/* The aged corners of a stored brick will be asked for, if it is listed. */
void aged_want(aged *a, uint32_t brick_id);
/* Finds out the aged corners of entry n, if it is wanted. Writes that entry only: several hands may share them out. */
void aged_corners(aged *a, const clay *c, uint32_t n);
/* Entry of a stored brick, NULL when it has none. */
static inline const aged_brick *aged_of(const aged *a, uint32_t brick_id)
{
    return brick_id < a->links && a->link[brick_id].round == a->round ? aged_at(a, a->link[brick_id].entry) : NULL;
}

#ifdef __cplusplus
}
#endif
#endif
