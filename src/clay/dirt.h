/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Which corners were dirtied since somebody last looked: the paper's tree `modified`, by brick.
 * Is not:  What they were before (change.h). A dirtied corner is one with a contribution, even if its value stayed.
 * Shape:   entries 0..count-1 in the order in which bricks were first marked; each a brick key and a mask of 512.
 *          An entry's brick need not be stored (an eraser marks what it passes).
 * Owner:   clay. Cleared by whoever drew the consequences (sculpture.h).
 * Errors:  dirt_mark asserts room: callers ask dirt_room first.
 * Cost:    one tree entry per brick.
 * Source:  000 section 3.2.
 */
#ifndef GLAISE_CLAY_DIRT_H
#define GLAISE_CLAY_DIRT_H

#include "clay/brick.h"
#include "lattice/avl.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dirt_entry {
    key at; /* brick key */
    brick_mask corners;
} dirt_entry;

typedef struct dirt {
    avl index;
    pool entries;
} dirt;

STATUS_CHECKED status dirt_init(dirt *d, uint32_t limit);
void dirt_finish(dirt *d);
void dirt_clear(dirt *d);
/* Unites corners with what is marked at that brick. STATUS_NO_MEMORY when the machine refuses; nothing changes then. */
STATUS_CHECKED status dirt_mark(dirt *d, key brick_at, const brick_mask *corners);

static inline uint32_t dirt_count(const dirt *d) { return d->entries.count; }
static inline uint32_t dirt_room(const dirt *d) { return pool_room(&d->entries); }
static inline const dirt_entry *dirt_at(const dirt *d, uint32_t n)
{
    return (const dirt_entry *)pool_at(&d->entries, n);
}

#ifdef __cplusplus
}
#endif
#endif
