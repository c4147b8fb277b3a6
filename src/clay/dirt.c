/* SPDX-License-Identifier: Apache-2.0 */
#include "clay/dirt.h"

status dirt_init(dirt *d, uint32_t limit)
{
    status s = avl_init(&d->index, limit);
    if (s != STATUS_OK)
        return s;
    s = pool_init(&d->entries, sizeof(dirt_entry), limit);
    if (s != STATUS_OK)
        avl_finish(&d->index);
    return s;
}

void dirt_finish(dirt *d)
{
    avl_finish(&d->index);
    pool_finish(&d->entries);
}

void dirt_clear(dirt *d)
{
    avl_clear(&d->index);
    pool_clear(&d->entries);
}

status dirt_mark(dirt *d, key brick_at, const brick_mask *corners)
{
    uint32_t id = avl_find(&d->index, brick_at);
    if (id == POOL_NONE) {
        status s = pool_take(&d->entries, &id);
        if (s != STATUS_OK)
            return s;
        s = avl_insert(&d->index, brick_at, id);
        if (s != STATUS_OK) {
            pool_give(&d->entries, id);
            return s;
        }
        *(dirt_entry *)pool_at(&d->entries, id) = (dirt_entry){.at = brick_at};
    }
    dirt_entry *e = (dirt_entry *)pool_at(&d->entries, id);
    for (int n = 0; n < BRICK_EDGE; n++)
        e->corners.slab[n] |= corners->slab[n];
    return STATUS_OK;
}
