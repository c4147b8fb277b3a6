/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Which corners were dirtied since somebody last looked: the paper's tree `modified`, by brick.
 * Is not:  What they were before (change.h). A dirtied corner is one with a contribution, even if its value stayed;
 *          those whose potential did change are told apart.
 * Shape:   entries 0..count-1 in the order in which bricks were first marked; each a brick key and two masks of 512.
 *          A stored brick keeps the id of its entry, and the round it holds for: a round ends with each clearing. An
 *          entry's brick need not be stored (it may have been emptied): only such entries are in the tree.
 * Owner:   clay. Cleared by whoever drew the consequences (sculpture.h).
 * Errors:  STATUS_POOL_FULL, STATUS_NO_MEMORY; nothing changes then. None after dirt_reserve.
 * Cost:    no search for a stored brick.
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
    key at;             /* brick key */
    uint32_t brick_id;  /* POOL_NONE while it is not stored */
    brick_mask corners; /* dirtied */
    brick_mask moved;   /* of these, those whose potential changed */
} dirt_entry;

typedef struct dirt {
    avl absent; /* brick key -> entry */
    pool entries;
    uint32_t round;
} dirt;

STATUS_CHECKED status dirt_init(dirt *d, uint32_t limit);
void dirt_finish(dirt *d);
void dirt_clear(dirt *d);
/* The next `more` new entries will not be refused. */
STATUS_CHECKED status dirt_reserve(dirt *d, uint32_t more);
/* The entry of a brick that is not stored, made if there is none; what is dirtied is to be united with its masks. */
STATUS_CHECKED status dirt_open(dirt *d, key brick_at, uint32_t *entry_out);
/* The same for a stored brick. */
STATUS_CHECKED status dirt_open_stored(dirt *d, brick *b, uint32_t brick_id, uint32_t *entry_out);
/* A brick was made (its entry, if it has one, is its own from now on), or is about to go. Cannot fail: the tree has
   room for every entry. */
void dirt_born(dirt *d, brick *b, uint32_t brick_id);
void dirt_gone(dirt *d, const brick *b);
/* Unites corners, all of which may have moved, with what is marked at a brick that is not stored. */
STATUS_CHECKED status dirt_mark(dirt *d, key brick_at, const brick_mask *corners);

static inline uint32_t dirt_count(const dirt *d) { return d->entries.count; }
static inline uint32_t dirt_room(const dirt *d) { return pool_room(&d->entries); }
static inline dirt_entry *dirt_at(const dirt *d, uint32_t n) { return (dirt_entry *)pool_at(&d->entries, n); }
/* The entry of a stored brick, POOL_NONE when it has none. */
static inline uint32_t dirt_of(const dirt *d, const brick *b)
{
    return b->dirt_round == d->round ? b->dirt : POOL_NONE;
}

#ifdef __cplusplus
}
#endif
#endif
