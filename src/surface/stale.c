/* SPDX-License-Identifier: Apache-2.0 */
#include "surface/stale.h"

#include <string.h>

/* Bits of a slab (bit dj*8 + dk) with dk 0, and with dk 7. */
#define K_FIRST 0x0101010101010101u
#define K_LAST 0x8080808080808080u

status stale_init(stale *s, uint32_t limit)
{
    memset(s, 0, sizeof *s);
    status r = avl_init(&s->index, limit);
    if (r != STATUS_OK)
        return r;
    r = pool_init(&s->entries, sizeof(stale_entry), limit);
    if (r != STATUS_OK)
        avl_finish(&s->index);
    return r;
}

void stale_finish(stale *s)
{
    avl_finish(&s->index);
    pool_finish(&s->entries);
}

void stale_clear(stale *s)
{
    avl_clear(&s->index);
    pool_clear(&s->entries);
}

static status entry_get(stale *s, key at, stale_entry **out)
{
    uint32_t id = avl_find(&s->index, at);
    if (id == POOL_NONE) {
        status r = pool_take(&s->entries, &id);
        if (r != STATUS_OK)
            return r;
        r = avl_insert(&s->index, at, id);
        if (r != STATUS_OK) {
            pool_give(&s->entries, id);
            return r;
        }
        *stale_at(s, id) = (stale_entry){.at = at, .slot = POOL_NONE};
    }
    *out = stale_at(s, id);
    return STATUS_OK;
}

static void mask_unite(brick_mask *m, const brick_mask *with)
{
    for (int n = 0; n < BRICK_EDGE; n++)
        m->slab[n] |= with->slab[n];
}

/*
 * A dirtied corner's cubes lie 0 or 1 step below it on each axis. One axis after the other: what falls below the brick's
 * first layer lands in the last layer of the next lower brick.
 *
 *     cubes_out[low i * 4 + low j * 2 + low k]
 */
static void cubes_round(const brick_mask *corners, brick_mask cubes_out[8])
{
    memset(cubes_out, 0, 8 * sizeof *cubes_out);
    for (int n = 0; n < BRICK_EDGE; n++) {
        uint64_t w = corners->slab[n];
        uint64_t along_k[2] = {w | (w & ~K_FIRST) >> 1, (w & K_FIRST) << 7};
        for (int k = 0; k < 2; k++) {
            uint64_t along_j[2] = {along_k[k] | along_k[k] >> 8, along_k[k] << 56};
            for (int j = 0; j < 2; j++) {
                cubes_out[j * 2 + k].slab[n] |= along_j[j];
                if (n > 0)
                    cubes_out[j * 2 + k].slab[n - 1] |= along_j[j];
                else
                    cubes_out[4 + j * 2 + k].slab[BRICK_EDGE - 1] = along_j[j];
            }
        }
    }
}

static status examined_mark(stale *s, const dirt_entry *d)
{
    brick_mask cubes[8];
    cubes_round(&d->corners, cubes);
    for (int n = 0; n < 8; n++) {
        if (brick_mask_is_empty(&cubes[n]))
            continue;
        stale_entry *e;
        status r = entry_get(s, key_add(d->at, -(n >> 2), -(n >> 1 & 1), -(n & 1)), &e);
        if (r != STATUS_OK)
            return r;
        mask_unite(&e->examined, &cubes[n]);
    }
    return STATUS_OK;
}

/* The cubes and their six neighbours inside the brick, and what crosses its six faces (axis * 2 + (upwards)). */
static void cubes_star(const brick_mask *c, brick_mask *own_out, brick_mask across_out[6])
{
    memset(across_out, 0, 6 * sizeof *across_out);
    for (int n = 0; n < BRICK_EDGE; n++) {
        uint64_t w = c->slab[n];
        own_out->slab[n] = w | (w & ~K_FIRST) >> 1 | (w & ~K_LAST) << 1 | w >> 8 | w << 8;
        own_out->slab[n] |= (n > 0 ? c->slab[n - 1] : 0) | (n < BRICK_EDGE - 1 ? c->slab[n + 1] : 0);
        across_out[2].slab[n] = w << 56;
        across_out[3].slab[n] = w >> 56;
        across_out[4].slab[n] = (w & K_FIRST) << 7;
        across_out[5].slab[n] = (w & K_LAST) >> 7;
    }
    across_out[0].slab[BRICK_EDGE - 1] = c->slab[0];
    across_out[1].slab[0] = c->slab[BRICK_EDGE - 1];
}

static status aged_mark(stale *s, uint32_t n)
{
    brick_mask own, across[6];
    stale_entry *e = stale_at(s, n);
    cubes_star(&e->examined, &own, across);
    mask_unite(&e->aged, &own);
    for (int face = 0; face < 6; face++) {
        if (brick_mask_is_empty(&across[face]))
            continue;
        int step[3] = {0, 0, 0};
        step[face >> 1] = face & 1 ? 1 : -1;
        stale_entry *other;
        status r = entry_get(s, key_add(e->at, step[0], step[1], step[2]), &other);
        if (r != STATUS_OK)
            return r;
        mask_unite(&other->aged, &across[face]);
    }
    return STATUS_OK;
}

status stale_mark(stale *s, const dirt *d)
{
    assert(stale_count(s) == 0);
    status r = STATUS_OK;
    for (uint32_t n = 0; n < dirt_count(d) && r == STATUS_OK; n++)
        r = examined_mark(s, dirt_at(d, n));
    uint32_t examined = stale_count(s);
    for (uint32_t n = 0; n < examined && r == STATUS_OK; n++)
        r = aged_mark(s, n);
    return r;
}

uint64_t stale_examined(const stale *s)
{
    uint64_t sum = 0;
    for (uint32_t n = 0; n < stale_count(s); n++)
        for (int slab = 0; slab < BRICK_EDGE; slab++)
            sum += (uint64_t)__builtin_popcountll(stale_at(s, n)->examined.slab[slab]);
    return sum;
}
