/* SPDX-License-Identifier: Apache-2.0 */
#include "clay/delta.h"

#include <stdlib.h>

static status room_for(delta *d, uint32_t count)
{
    if (count <= d->room)
        return STATUS_OK;
    uint32_t room = d->room * 2 > count ? d->room * 2 : count;
    delta_brick *grown = (delta_brick *)realloc(d->bricks, room * sizeof *grown);
    if (!grown)
        return STATUS_NO_MEMORY;
    d->bricks = grown;
    d->room = room;
    return STATUS_OK;
}

static uint32_t holds_of(const delta_brick *b) { return (b->old_id != POOL_NONE) + (b->now_id != POOL_NONE); }

static brick *brick_of(const clay *c, const change_image *image)
{
    brick *b = clay_brick(c, image->brick_id);
    if (b->page != NULL && key_equal(b->at, image->at))
        return b;
    const uint32_t id = clay_find(c, image->at); /* gone, or gone and made again */
    return id == POOL_NONE ? NULL : clay_brick(c, id);
}

/* The image's hold becomes the delta's. */
static void take(delta *d, clay *c, const change_image *image)
{
    brick *b = brick_of(c, image);
    delta_brick taken = {.at = image->at, .old_id = image->page_id, .now_id = b ? b->page_id : POOL_NONE};
    if (b)
        b->image = POOL_NONE;
    if (taken.old_id == taken.now_id) {
        if (taken.old_id != POOL_NONE)
            pages_give(&c->pages, taken.old_id);
        return;
    }
    if (taken.old_id != POOL_NONE)
        taken.old = pages_at(&c->pages, taken.old_id);
    if (b) {
        taken.now = b->page;
        pages_hold(&c->pages, taken.now_id);
    }
    c->cut += holds_of(&taken);
    d->bricks[d->count++] = taken;
}

status delta_cut(delta *d, clay *c)
{
    assert(c->changes.recording && d->count == 0);
    status s = room_for(d, change_count(&c->changes));
    if (s != STATUS_OK)
        return s;
    for (uint32_t n = 0; n < change_count(&c->changes); n++)
        take(d, c, change_at(&c->changes, n));
    change_clear(&c->changes);
    c->changes.recording = true;
    return STATUS_OK;
}

static int by_key(const void *a, const void *b)
{
    return key_compare(((const delta_brick *)a)->at, ((const delta_brick *)b)->at);
}

void delta_sort(delta *d)
{
    if (d->count > 1)
        qsort(d->bricks, d->count, sizeof d->bricks[0], by_key);
}

void delta_give(delta *d, clay *c)
{
    for (uint32_t n = 0; n < d->count; n++) {
        c->cut -= holds_of(&d->bricks[n]);
        if (d->bricks[n].old_id != POOL_NONE)
            pages_give(&c->pages, d->bricks[n].old_id);
        if (d->bricks[n].now_id != POOL_NONE)
            pages_give(&c->pages, d->bricks[n].now_id);
    }
    d->count = 0;
}

void delta_finish(delta *d)
{
    assert(d->count == 0);
    free(d->bricks);
    *d = (delta){NULL, 0, 0};
}
