/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What changed in a clay since the change began or was last cut: every brick that did, as it was and as it is,
 *          held so that another thread can read both while sculpting goes on. History writes it down.
 * Is not:  A format (history/record.h); the clay as a whole (freeze.h).
 * Shape:   bricks in the order in which they were first opened, each once; delta_sort puts them in key order. A side is
 *          NULL where the brick was, or is, not stored. What was opened and left as it was may be among them.
 * Owner:   the caller owns the struct (a zeroed one is empty). delta_cut and delta_give belong to the thread that
 *          writes the clay; in between the pages may be read by any.
 * Errors:  STATUS_NO_MEMORY; clay and delta are then as they were.
 * Cost:    some 20 ns a brick: nothing is copied. Who writes such a brick next takes a page of his own (pages.h).
 */
#ifndef GLAISE_CLAY_DELTA_H
#define GLAISE_CLAY_DELTA_H

#include "clay/clay.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct delta_brick {
    key at;
    uint32_t old_id, now_id; /* of clay's pages */
    const brick_page *old, *now;
} delta_brick;

typedef struct delta {
    delta_brick *bricks;
    uint32_t count, room;
} delta;

/* Into an empty delta. The change goes on being recorded, as one that has only just begun. */
STATUS_CHECKED status delta_cut(delta *d, clay *c);
void delta_sort(delta *d);
/* Lets go of the pages: d is empty again. */
void delta_give(delta *d, clay *c);
void delta_finish(delta *d); /* when empty */

#ifdef __cplusplus
}
#endif
#endif
