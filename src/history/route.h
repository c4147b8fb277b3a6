/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A way from one state of the clay to another, read from the medium and ready to be gone: what undo, redo and
 *          the like hand to the thread that has the clay.
 * Is not:  The choice of where to go (tree.h); the reading (history.h fills it).
 * Shape:   legs in the order in which they are gone over; legs of one group belong to one stretch of a stroke, between
 *          two states that existed. A leg's bricks are those of a record that was checked (record.h).
 * Owner:   the caller owns the struct (a zeroed one is empty); the route owns its bytes.
 * Errors:  route_apply: STATUS_CORRUPT when the clay is not what the route begins with, or would not become what it
 *          ends with; STATUS_POOL_FULL, STATUS_NO_MEMORY. The clay is then as it was.
 * Cost:    a brick: opened, 8 bytes a changed corner, and hashed twice (some us).
 */
#ifndef GLAISE_HISTORY_ROUTE_H
#define GLAISE_HISTORY_ROUTE_H

#include "clay/clay.h"
#include "history/record.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct route_leg {
    uint8_t *bricks;
    size_t size;
    uint32_t group;
} route_leg;

typedef struct route {
    uint64_t from, cursor, tip; /* strokes: where it begins, where it ends, where redo leads from there */
    uint64_t digest_before, digest_after;
    uint64_t first; /* the first stroke it goes over */
    route_leg *legs;
    uint32_t count, room;
} route;

/* Takes the bytes over; on STATUS_NO_MEMORY they stay the caller's. */
STATUS_CHECKED status route_add(route *r, uint8_t *bricks, size_t size, uint32_t group);
/* Legs from..count-1 the other way round. */
void route_reverse(route *r, uint32_t from);
void route_finish(route *r);

/* Nothing may be recorded before. After STATUS_OK the way is recorded as a change: the caller ends it, or reverts it if
   what was to follow failed. */
STATUS_CHECKED status route_apply(const route *r, clay *c);

#ifdef __cplusplus
}
#endif
#endif
