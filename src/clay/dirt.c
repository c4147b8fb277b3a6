/* SPDX-License-Identifier: Apache-2.0 */
#include "clay/dirt.h"

status dirt_init(dirt *d, uint32_t limit)
{
    d->round = 1; /* a zeroed brick has no entry */
    status s = avl_init(&d->absent, limit);
    if (s != STATUS_OK)
        return s;
    s = pool_init(&d->entries, sizeof(dirt_entry), limit);
    if (s != STATUS_OK)
        avl_finish(&d->absent);
    return s;
}

void dirt_finish(dirt *d)
{
    avl_finish(&d->absent);
    pool_finish(&d->entries);
}

void dirt_clear(dirt *d)
{
    avl_clear(&d->absent);
    pool_clear(&d->entries);
    d->round++;
}

status dirt_reserve(dirt *d, uint32_t more)
{
    status s = pool_reserve(&d->entries, more);
    /* Any entry's brick may go. */
    return s == STATUS_OK ? pool_reserve(&d->absent.nodes, dirt_count(d) - avl_count(&d->absent) + more) : s;
}

static status entry_make(dirt *d, key at, uint32_t brick_id, uint32_t *entry_out)
{
    status s = dirt_reserve(d, 1);
    if (s == STATUS_OK)
        s = pool_take(&d->entries, entry_out);
    if (s == STATUS_OK)
        *dirt_at(d, *entry_out) = (dirt_entry){.at = at, .brick_id = brick_id};
    return s;
}

status dirt_open(dirt *d, key brick_at, uint32_t *entry_out)
{
    *entry_out = avl_find(&d->absent, brick_at);
    if (*entry_out != POOL_NONE)
        return STATUS_OK;
    status s = entry_make(d, brick_at, POOL_NONE, entry_out);
    return s == STATUS_OK ? avl_insert(&d->absent, brick_at, *entry_out) : s;
}

status dirt_open_stored(dirt *d, brick *b, uint32_t brick_id, uint32_t *entry_out)
{
    *entry_out = dirt_of(d, b);
    if (*entry_out != POOL_NONE)
        return STATUS_OK;
    status s = entry_make(d, b->at, brick_id, entry_out);
    if (s == STATUS_OK) {
        b->dirt = *entry_out;
        b->dirt_round = d->round;
    }
    return s;
}

void dirt_born(dirt *d, brick *b, uint32_t brick_id)
{
    uint32_t entry = avl_remove(&d->absent, b->at);
    if (entry == POOL_NONE)
        return;
    dirt_at(d, entry)->brick_id = brick_id;
    b->dirt = entry;
    b->dirt_round = d->round;
}

void dirt_gone(dirt *d, const brick *b)
{
    uint32_t entry = dirt_of(d, b);
    if (entry == POOL_NONE)
        return;
    dirt_at(d, entry)->brick_id = POOL_NONE;
    status s = avl_insert(&d->absent, b->at, entry);
    assert(s == STATUS_OK);
    (void)s;
}

status dirt_mark(dirt *d, key brick_at, const brick_mask *corners)
{
    uint32_t id;
    status s = dirt_open(d, brick_at, &id);
    if (s == STATUS_OK) {
        brick_mask_unite(&dirt_at(d, id)->corners, corners);
        brick_mask_unite(&dirt_at(d, id)->moved, corners);
    }
    return s;
}
