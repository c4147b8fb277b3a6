/* SPDX-License-Identifier: Apache-2.0 */
#include "surface/stale.h"

#include <string.h>

/* Bits of a slab (bit dj*8 + dk) with dk 0, and with dk 7. */
#define K_FIRST 0x0101010101010101u
#define K_LAST 0x8080808080808080u

enum { FACES = 6 };

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

static status entry_get(stale *s, key at, uint32_t *id_out)
{
    *id_out = avl_find(&s->index, at);
    if (*id_out != POOL_NONE)
        return STATUS_OK;
    uint32_t id;
    status r = pool_take(&s->entries, &id);
    if (r != STATUS_OK)
        return r;
    r = avl_insert(&s->index, at, id);
    if (r != STATUS_OK) {
        pool_give(&s->entries, id);
        return r;
    }
    stale_entry *e = stale_at(s, id);
    *e = (stale_entry){.at = at, .slot = POOL_NONE};
    for (int face = 0; face < FACES; face++)
        e->beside[face] = POOL_NONE;
    *id_out = id;
    return STATUS_OK;
}

/* The entry across a face, made if there is none. */
static status entry_beside(stale *s, uint32_t id, int face, stale_entry **out)
{
    stale_entry *e = stale_at(s, id);
    if (e->beside[face] == POOL_NONE) {
        int step[3] = {0, 0, 0};
        step[face >> 1] = face & 1 ? 1 : -1;
        status r = entry_get(s, key_add(e->at, step[0], step[1], step[2]), &e->beside[face]);
        if (r != STATUS_OK)
            return r;
        stale_at(s, e->beside[face])->beside[face ^ 1] = id;
    }
    *out = stale_at(s, e->beside[face]);
    return STATUS_OK;
}

static void mask_unite(brick_mask *m, const brick_mask *with)
{
    for (int n = 0; n < BRICK_EDGE; n++)
        m->slab[n] |= with->slab[n];
}

/* Everything moved one step across a face (axis * 2 + upwards): what stays in the brick, and what lands in the next. */
static void mask_shift(const brick_mask *m, int face, brick_mask *own_out, brick_mask *across_out)
{
    memset(across_out, 0, sizeof *across_out);
    for (int n = 0; n < BRICK_EDGE; n++) {
        uint64_t w = m->slab[n];
        switch (face) {
        case 0:
            own_out->slab[n] = n < BRICK_EDGE - 1 ? m->slab[n + 1] : 0;
            break;
        case 1:
            own_out->slab[n] = n > 0 ? m->slab[n - 1] : 0;
            break;
        case 2:
            own_out->slab[n] = w >> 8;
            across_out->slab[n] = w << 56;
            break;
        case 3:
            own_out->slab[n] = w << 8;
            across_out->slab[n] = w >> 56;
            break;
        case 4:
            own_out->slab[n] = (w & ~K_FIRST) >> 1;
            across_out->slab[n] = (w & K_FIRST) << 7;
            break;
        default:
            own_out->slab[n] = (w & ~K_LAST) << 1;
            across_out->slab[n] = (w & K_LAST) >> 7;
            break;
        }
    }
    if (face == 0)
        across_out->slab[BRICK_EDGE - 1] = m->slab[0];
    if (face == 1)
        across_out->slab[0] = m->slab[BRICK_EDGE - 1];
}

/* Adds the examined cubes, moved one step across a face, to the aged ones. */
static status aged_add(stale *s, uint32_t id, int face)
{
    brick_mask own, across;
    stale_entry *e = stale_at(s, id), *other;
    mask_shift(&e->examined, face, &own, &across);
    mask_unite(&e->aged, &own);
    if (brick_mask_is_empty(&across))
        return STATUS_OK;
    status r = entry_beside(s, id, face, &other);
    if (r == STATUS_OK)
        mask_unite(&other->aged, &across);
    return r;
}

/* A dirtied corner's cubes lie 0 or 1 step below it on each axis: one axis after the other. `aged` holds what came down
   until all bricks have passed theirs on. */
static status examined_mark(stale *s, int axis)
{
    status r = STATUS_OK;
    uint32_t before = stale_count(s);
    for (uint32_t n = 0; n < before && r == STATUS_OK; n++)
        r = aged_add(s, n, axis * 2);
    for (uint32_t n = 0; n < stale_count(s) && r == STATUS_OK; n++) {
        stale_entry *e = stale_at(s, n);
        mask_unite(&e->examined, &e->aged);
        memset(&e->aged, 0, sizeof e->aged);
    }
    return r;
}

static status aged_mark(stale *s)
{
    status r = STATUS_OK;
    uint32_t examined = stale_count(s);
    for (uint32_t n = 0; n < examined && r == STATUS_OK; n++) {
        mask_unite(&stale_at(s, n)->aged, &stale_at(s, n)->examined);
        for (int face = 0; face < FACES && r == STATUS_OK; face++)
            r = aged_add(s, n, face);
    }
    return r;
}

status stale_mark(stale *s, const dirt *d)
{
    assert(stale_count(s) == 0);
    status r = STATUS_OK;
    for (uint32_t n = 0; n < dirt_count(d) && r == STATUS_OK; n++) {
        uint32_t id;
        r = entry_get(s, dirt_at(d, n)->at, &id);
        if (r == STATUS_OK)
            stale_at(s, id)->examined = dirt_at(d, n)->corners;
    }
    for (int axis = 0; axis < 3 && r == STATUS_OK; axis++)
        r = examined_mark(s, axis);
    return r == STATUS_OK ? aged_mark(s) : r;
}

uint64_t stale_examined(const stale *s)
{
    uint64_t sum = 0;
    for (uint32_t n = 0; n < stale_count(s); n++)
        for (int slab = 0; slab < BRICK_EDGE; slab++)
            sum += (uint64_t)__builtin_popcountll(stale_at(s, n)->examined.slab[slab]);
    return sum;
}
