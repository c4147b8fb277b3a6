/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The bricks of the stroke under way as they were before it: one image per brick, taken when the stroke first
 *          opens it. History reads them against the clay as it is; a refused stroke is put back from them.
 * Is not:  The undo-file (history's); a list of dirtied corners (dirt.h).
 * Shape:   images 0..count-1 in the order in which bricks were first opened. An image holds the page that its brick had
 *          (pages.h): nothing is copied. A brick that did not exist has none: absent and empty are the same thing.
 * Owner:   clay. Filled while a change is being recorded.
 * Errors:  STATUS_POOL_FULL / STATUS_NO_MEMORY; nothing changes then.
 * Cost:    an entry per brick and stroke; the page is paid for by whoever writes the brick next.
 * Source:  000 section 3.3 (previous value and colour of every modified corner).
 */
#ifndef GLAISE_CLAY_CHANGE_H
#define GLAISE_CLAY_CHANGE_H

#include "clay/pages.h"
#include "lattice/avl.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct change_image {
    key at;           /* brick key */
    uint32_t page_id; /* held; POOL_NONE: the brick was not stored */
    uint32_t stored;  /* as the brick had it */
    uint32_t brick_id; /* where it is, if that still has this key */
    brick_mask inside;
} change_image;

typedef struct change {
    avl index;
    pool images;
    bool recording;
} change;

STATUS_CHECKED status change_init(change *c, uint32_t limit);
void change_finish(change *c);
void change_clear(change *c); /* forgets the images, stops recording; their pages are the caller's to give */
/* The next `more` new images will not be refused. */
STATUS_CHECKED status change_reserve(change *c, uint32_t more);
/* Image of the brick at `at` (b NULL: it was not stored until now), holding its page, unless there is one already. */
STATUS_CHECKED status change_keep(change *c, pages *p, key at, uint32_t brick_id, const brick *b, uint32_t *image_out);

static inline uint32_t change_count(const change *c) { return c->images.count; }
static inline const change_image *change_at(const change *c, uint32_t n)
{
    return (const change_image *)pool_at(&c->images, n);
}

#ifdef __cplusplus
}
#endif
#endif
