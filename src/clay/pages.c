/* SPDX-License-Identifier: Apache-2.0 */
#include "clay/pages.h"

#include "clay/potential.h"

#include <stdlib.h>
#include <string.h>

status pages_init(pages *p, uint32_t limit)
{
    memset(p, 0, sizeof *p);
    memset(p->full, 0xff, sizeof p->full);
    return pool_init(&p->of, sizeof(brick_page), limit);
}

void pages_finish(pages *p)
{
    free(p->holders);
    pool_finish(&p->of);
    memset(p, 0, sizeof *p);
}

/* Notes for all pages that can be taken without another slab. */
static status holders_grow(pages *p, uint32_t more)
{
    const uint64_t need = (uint64_t)p->of.count + more;
    if (need <= p->holders_room)
        return STATUS_OK;
    uint64_t grown = need + need / 2;
    grown = grown > p->of.limit ? p->of.limit : grown;
    uint32_t *moved = (uint32_t *)realloc(p->holders, (size_t)grown * sizeof *moved);
    if (!moved)
        return STATUS_NO_MEMORY;
    p->holders = moved;
    p->holders_room = (uint32_t)grown;
    return STATUS_OK;
}

status pages_reserve(pages *p, uint32_t more)
{
    status s = pool_reserve(&p->of, more);
    return s == STATUS_OK ? holders_grow(p, more) : s;
}

status pages_take(pages *p, uint32_t *id_out)
{
    /* Given-back ids are used again first, so no id reaches beyond the most that were taken at one time. */
    status s = p->of.count < p->of.limit ? holders_grow(p, 1) : STATUS_POOL_FULL;
    if (s == STATUS_OK)
        s = pool_take(&p->of, id_out);
    if (s == STATUS_OK)
        p->holders[*id_out] = 1;
    return s;
}

void pages_give(pages *p, uint32_t id)
{
    assert(p->holders[id] > 0);
    if (--p->holders[id] == 0)
        pool_give(&p->of, id);
}

bool pages_is_full(const brick_page *page)
{
    for (int n = 0; n < BRICK_CORNERS; n++)
        if (page->potential[n] != POTENTIAL_MAX || page->rgba[n] != page->rgba[0])
            return false;
    return true;
}

uint32_t pages_fold(pages *p, uint32_t id)
{
    const uint32_t rgba = pages_at(p, id)->rgba[0];
    /* Fibonacci hashing: the highest bits say which place. */
    uint32_t *place = &p->full[(uint64_t)(rgba * 0x9E3779B1u) * CAPACITY_FULL_COLOURS >> 32];
    if (*place == id)
        return id;
    if (*place != POOL_NONE && pages_at(p, *place)->rgba[0] == rgba) {
        pages_hold(p, *place);
        pages_give(p, id);
        return *place;
    }
    if (*place != POOL_NONE)
        pages_give(p, *place);
    pages_hold(p, id);
    *place = id;
    return id;
}

bool pages_are_held(const pages *p, uint64_t known, bool or_more)
{
    uint64_t holds = 0;
    uint32_t held = 0;
    for (uint32_t id = 0; id < p->of.fresh; id++) {
        held += p->holders[id] > 0;
        holds += p->holders[id];
    }
    for (uint32_t n = 0; n < CAPACITY_FULL_COLOURS; n++)
        known += p->full[n] != POOL_NONE;
    return held == p->of.count && (or_more ? holds >= known : holds == known);
}
