/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What a set of dirtied corners makes stale, by brick: the cubes that share a dirtied corner and must be
 *          examined, and the cubes whose corners' gradients may have changed, so that their vertices have aged.
 * Is not:  The dirtied corners (clay/dirt.h); knowledge of what crosses the surface (surface.h).
 * Shape:   entries 0..count-1, each a brick key and two masks of 512 cubes named by their smallest corner. An entry's
 *          brick need not be stored. examined: the eight cubes round each dirtied corner, every cube once.
 *          aged: a central difference reads six neighbours, so a gradient ages when a corner within one step does; the
 *          cubes touching such a corner are the examined cubes and their six neighbours (the two dilations commute).
 * Owner:   surface: scratch of one update.
 * Errors:  STATUS_NO_MEMORY; STATUS_POOL_FULL beyond the limit. The marks are then useless until stale_clear.
 * Cost:    words of 64 cubes. The tree is entered once per brick and border; from then on bricks beside each other are
 *          linked.
 * Source:  000 section 3.2 ("the eight Cubes that share it ... only once each dirtied Cube").
 */
#ifndef GLAISE_SURFACE_STALE_H
#define GLAISE_SURFACE_STALE_H

#include "clay/dirt.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct stale_entry {
    key at;             /* brick key */
    uint32_t slot;      /* for the surface's own use while it works the entries off */
    uint32_t beside[6]; /* entries across the faces (axis * 2 + upwards), POOL_NONE while not known */
    brick_mask examined, aged;
} stale_entry;

typedef struct stale {
    avl index;
    pool entries;
} stale;

STATUS_CHECKED status stale_init(stale *s, uint32_t limit);
void stale_finish(stale *s); /* a zeroed one is fine */
void stale_clear(stale *s);

/* Marks all that follows from d; s must be clear. */
STATUS_CHECKED status stale_mark(stale *s, const dirt *d);

static inline uint32_t stale_count(const stale *s) { return s->entries.count; }
static inline stale_entry *stale_at(const stale *s, uint32_t n) { return (stale_entry *)pool_at(&s->entries, n); }
/* Number of examined cubes. */
uint64_t stale_examined(const stale *s);

#ifdef __cplusplus
}
#endif
#endif
