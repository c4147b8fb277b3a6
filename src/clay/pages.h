/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The pages that bricks hold, and who else holds them: an image kept for undo, a frozen clay, every brick
 *          that is full of one colour. A page with several holders is never written: who wants to takes one of its own.
 * Is not:  Safe for several writers: holders are counted by the clay's own thread. Others may read a page that is held
 *          for them.
 * Shape:   a pool of brick_page; beside it, a count of holders for each. Full pages (every corner at POTENTIAL_MAX, all
 *          of one colour) are found by their colour in a table of CAPACITY_FULL_COLOURS places, which holds them too:
 *          a colour that falls on another's place takes it over.
 * Owner:   clay.
 * Errors:  STATUS_POOL_FULL / STATUS_NO_MEMORY; nothing changes then.
 * Cost:    all O(1). A brick that is full of one colour, as many inside a piece are, costs no page.
 */
#ifndef GLAISE_CLAY_PAGES_H
#define GLAISE_CLAY_PAGES_H

#include "clay/brick.h"
#include "clay/capacity.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pages {
    pool of;
    uint32_t *holders; /* of page ids */
    uint32_t holders_room;
    uint32_t full[CAPACITY_FULL_COLOURS]; /* page ids, POOL_NONE where none */
} pages;

STATUS_CHECKED status pages_init(pages *p, uint32_t limit);
void pages_finish(pages *p); /* a zeroed one is fine */
/* The next `more` takes will not be refused. */
STATUS_CHECKED status pages_reserve(pages *p, uint32_t more);

/* A page with one holder; its bytes are whatever they were. */
STATUS_CHECKED status pages_take(pages *p, uint32_t *id_out);
static inline brick_page *pages_at(const pages *p, uint32_t id) { return (brick_page *)pool_at(&p->of, id); }
static inline void pages_hold(pages *p, uint32_t id) { p->holders[id]++; }
/* One holder less; the last one gives it back. */
void pages_give(pages *p, uint32_t id);
static inline bool pages_is_shared(const pages *p, uint32_t id) { return p->holders[id] > 1; }

/* Is every corner full, and of the colour of the first? */
bool pages_is_full(const brick_page *page);
/* Gives up one hold on a full page for one on that page which all full ones of its colour share; this may be it. */
uint32_t pages_fold(pages *p, uint32_t id);

/* Are there as many holds, the table's aside, as are known to the caller (or_more: at least), and none on a page that
   was given back? O(pages): for tests. */
bool pages_are_held(const pages *p, uint64_t known, bool or_more);

#ifdef __cplusplus
}
#endif
#endif
