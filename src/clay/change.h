/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The bricks of the stroke under way as they were before it: one image per brick, taken when the stroke first
 *          opens it. History reads them against the clay as it is; a refused stroke is put back from them.
 * Is not:  The undo-file (history's); a list of dirtied corners (dirt.h).
 * Shape:   images 0..count-1 in the order in which bricks were first opened. An image whose brick did not exist is all
 *          zero: absent and empty are the same thing.
 * Owner:   clay. Filled by clay_brick_open while a change is being recorded.
 * Errors:  STATUS_POOL_FULL / STATUS_NO_MEMORY; nothing changes then.
 * Cost:    one copy of 4 KiB per brick and stroke.
 * Source:  000 section 3.3 (previous value and colour of every modified corner).
 */
#ifndef GLAISE_CLAY_CHANGE_H
#define GLAISE_CLAY_CHANGE_H

#include "clay/brick.h"
#include "lattice/avl.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct change_image {
    key at; /* brick key */
    brick_page page;
} change_image;

typedef struct change {
    avl index;
    pool images;
    bool recording;
} change;

STATUS_CHECKED status change_init(change *c, uint32_t limit);
void change_finish(change *c);
void change_clear(change *c); /* forgets the images, stops recording */
/* The next `more` new images will not be refused. */
STATUS_CHECKED status change_reserve(change *c, uint32_t more);
/* Image of the brick at `at`, taken from `page` (NULL: a brick that is not stored) unless there is one already. */
STATUS_CHECKED status change_keep(change *c, key at, const brick_page *page, uint32_t *image_out);

static inline uint32_t change_count(const change *c) { return c->images.count; }
static inline const change_image *change_at(const change *c, uint32_t n)
{
    return (const change_image *)pool_at(&c->images, n);
}

#ifdef __cplusplus
}
#endif
#endif
