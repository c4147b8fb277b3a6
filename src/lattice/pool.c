/* SPDX-License-Identifier: Apache-2.0 */
#include "lattice/pool.h"

#include <stdlib.h>
#include <string.h>

enum { SLAB_TARGET_BYTES = 256 * 1024, ALIGNMENT = 64 };

static uint32_t slab_items(const pool *p) { return 1u << p->slab_shift; }
static uint32_t slab_total(const pool *p)
{
    return (uint32_t)(((uint64_t)p->limit + slab_items(p) - 1) >> p->slab_shift);
}

status pool_init(pool *p, size_t item_bytes, uint32_t limit)
{
    assert(item_bytes >= sizeof(uint32_t) && limit >= 1 && limit < POOL_NONE);
    memset(p, 0, sizeof *p);
    p->item_bytes = (item_bytes + 7) & ~(size_t)7;
    p->limit = limit;
    p->free_head = POOL_NONE;
    while (((size_t)2 << p->slab_shift) * p->item_bytes <= SLAB_TARGET_BYTES && slab_items(p) < limit)
        p->slab_shift++;
    p->slabs = (void **)calloc(slab_total(p), sizeof *p->slabs);
    return p->slabs ? STATUS_OK : STATUS_NO_MEMORY;
}

void pool_finish(pool *p)
{
    if (p->slabs)
        for (uint32_t s = 0; s < slab_total(p); s++)
            free(p->slabs[s]);
    free(p->slabs);
    memset(p, 0, sizeof *p);
}

static status slab_open(pool *p, uint32_t slab)
{
    if (p->slabs[slab])
        return STATUS_OK;
    size_t bytes = slab_items(p) * p->item_bytes;
    p->slabs[slab] = aligned_alloc(ALIGNMENT, (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT);
    return p->slabs[slab] ? STATUS_OK : STATUS_NO_MEMORY;
}

status pool_reserve(pool *p, uint32_t more)
{
    if (more > pool_room(p))
        return STATUS_POOL_FULL;
    uint32_t given_back = p->fresh - p->count;
    status s = STATUS_OK;
    if (more > given_back)
        for (uint32_t slab = p->fresh >> p->slab_shift;
             s == STATUS_OK && slab <= (p->fresh + (more - given_back) - 1) >> p->slab_shift; slab++)
            s = slab_open(p, slab);
    return s;
}

status pool_take(pool *p, uint32_t *id_out)
{
    if (p->free_head != POOL_NONE) {
        *id_out = p->free_head;
        memcpy(&p->free_head, pool_at(p, *id_out), sizeof p->free_head);
        p->count++;
        return STATUS_OK;
    }
    if (p->fresh == p->limit)
        return STATUS_POOL_FULL;
    status s = slab_open(p, p->fresh >> p->slab_shift);
    if (s == STATUS_OK) {
        *id_out = p->fresh++;
        p->count++;
    }
    return s;
}

void pool_give(pool *p, uint32_t id)
{
    assert(p->count > 0);
    memcpy(pool_at(p, id), &p->free_head, sizeof p->free_head);
    p->free_head = id;
    p->count--;
}

void pool_clear(pool *p)
{
    p->fresh = 0;
    p->count = 0;
    p->free_head = POOL_NONE;
}

status pool_copy(pool *to, const pool *from)
{
    status s = pool_init(to, from->item_bytes, from->limit);
    if (s != STATUS_OK)
        return s;
    s = pool_reserve(to, from->fresh);
    if (s != STATUS_OK) {
        pool_finish(to);
        return s;
    }
    for (uint32_t id = 0; id < from->fresh; id += slab_items(from)) {
        uint32_t slab = id >> from->slab_shift, left = from->fresh - id;
        memcpy(to->slabs[slab], from->slabs[slab],
               (left < slab_items(from) ? left : slab_items(from)) * from->item_bytes);
    }
    to->fresh = from->fresh;
    to->free_head = from->free_head;
    to->count = from->count;
    return STATUS_OK;
}

size_t pool_bytes(const pool *p)
{
    size_t bytes = 0;
    for (uint32_t s = 0; s < slab_total(p); s++)
        if (p->slabs[s])
            bytes += slab_items(p) * p->item_bytes;
    return bytes;
}

status pool_shadow(const pool *p, void **array, uint32_t *room, size_t item_bytes)
{
    if (p->fresh <= *room)
        return STATUS_OK;
    uint32_t grown = p->fresh + p->fresh / 2; /* bricks come one by one */
    void *moved = realloc(*array, grown * item_bytes);
    if (!moved)
        return STATUS_NO_MEMORY;
    memset((char *)moved + *room * item_bytes, 0, (grown - *room) * item_bytes);
    *array = moved;
    *room = grown;
    return STATUS_OK;
}
