/* SPDX-License-Identifier: Apache-2.0 */
#include "surface/aged.h"

#include <stdlib.h>
#include <string.h>

status aged_init(aged *a, uint32_t limit)
{
    memset(a, 0, sizeof *a);
    status r = avl_init(&a->absent, limit);
    if (r == STATUS_OK)
        r = pool_init(&a->entries, sizeof(aged_brick), limit);
    if (r != STATUS_OK)
        aged_finish(a);
    return r;
}

void aged_finish(aged *a)
{
    free(a->link);
    avl_finish(&a->absent);
    pool_finish(&a->entries);
    memset(a, 0, sizeof *a);
}

/* --- the list --- */

static status begin(aged *a, const clay *c)
{
    pool_clear(&a->entries);
    avl_clear(&a->absent);
    if (++a->round == 0) { /* after 2^32 rounds the old ones would be taken for new */
        memset(a->link, 0, a->links * sizeof *a->link);
        a->round = 1;
    }
    void *link = a->link;
    status r = pool_shadow(&c->bricks, &link, &a->links, sizeof *a->link);
    a->link = (aged_link *)link;
    return r;
}

static status entry_make(aged *a, key at, uint32_t brick_id, uint32_t *n_out)
{
    status r = pool_take(&a->entries, n_out);
    if (r != STATUS_OK)
        return r;
    aged_brick *e = aged_at(a, *n_out);
    e->at = at;
    e->brick_id = brick_id;
    e->is_wanted = false;
    return STATUS_OK;
}

static status stored_add(aged *a, const clay *c, uint32_t brick_id)
{
    aged_link *link = &a->link[brick_id];
    if (link->round == a->round)
        return STATUS_OK;
    status r = entry_make(a, clay_brick(c, brick_id)->at, brick_id, &link->entry);
    if (r == STATUS_OK)
        link->round = a->round;
    return r;
}

static status absent_add(aged *a, key at, bool may_cross)
{
    uint32_t n = avl_find(&a->absent, at);
    if (n != POOL_NONE) {
        aged_at(a, n)->may_cross |= may_cross;
        return STATUS_OK;
    }
    status r = entry_make(a, at, POOL_NONE, &n);
    if (r != STATUS_OK)
        return r;
    memset(&aged_at(a, n)->corners, 0xff, sizeof(brick_mask));
    aged_at(a, n)->may_cross = may_cross;
    return avl_insert(&a->absent, at, n);
}

/* --- which bricks --- */

/* Neighbours as a set: bit n is that of brick_neighbour_index. */
enum {
    BELOW_I = 0x1ff, LEVEL_I = BELOW_I << 9, ABOVE_I = BELOW_I << 18,
    BELOW_J = 7 | 7 << 9 | 7 << 18, LEVEL_J = BELOW_J << 3, ABOVE_J = BELOW_J << 6,
    BELOW_K = 0x1249249, LEVEL_K = BELOW_K << 1, ABOVE_K = BELOW_K << 2,
    /* An aged corner above lies in a face neighbour: no patch two steps up sees it. */
    TWICE_ABOVE = (ABOVE_I & ABOVE_J) | (ABOVE_I & ABOVE_K) | (ABOVE_J & ABOVE_K),
};

/* Those whose patches see a corner of the mask, or one of the six round it. */
static uint32_t reach_of(const brick_mask *m)
{
    uint64_t any = 0;
    for (int n = 0; n < BRICK_EDGE; n++)
        any |= m->slab[n];
    uint32_t i = LEVEL_I, j = LEVEL_J, k = LEVEL_K;
    i |= (m->slab[0] | m->slab[1]) != 0 ? BELOW_I : 0;
    i |= m->slab[7] != 0 ? ABOVE_I : 0;
    j |= (any & 0xffff) != 0 ? BELOW_J : 0;
    j |= any >> 56 != 0 ? ABOVE_J : 0;
    k |= (any & (BRICK_K_FIRST | BRICK_K_FIRST << 1)) != 0 ? BELOW_K : 0;
    k |= (any & BRICK_K_LAST) != 0 ? ABOVE_K : 0;
    return i & j & k & ~(uint32_t)TWICE_ABOVE;
}

/* orphans: a brick that is not stored may have a patch all the same, whose corners age like any others. */
static status stored_reach(aged *a, const clay *c, uint32_t brick_id, const brick_mask *dirtied, bool orphans)
{
    const brick *b = clay_brick(c, brick_id);
    status r = STATUS_OK;
    for (uint32_t left = reach_of(dirtied); left && r == STATUS_OK; left &= left - 1) {
        const int n = __builtin_ctz(left);
        if (b->neighbour[n] != POOL_NONE)
            r = stored_add(a, c, b->neighbour[n]);
        else if (orphans)
            r = absent_add(a, brick_neighbour_key(b->at, n), false);
    }
    return r;
}

/* A brick that was dirtied and is gone: all round it may see that. */
static status gone_reach(aged *a, const clay *c, key at, bool orphans)
{
    uint32_t ids[BRICK_NEIGHBOURS];
    status r = STATUS_OK;
    clay_neighbours(c, at, ids);
    for (int n = 0; n < BRICK_NEIGHBOURS && r == STATUS_OK; n++) {
        const int d[3] = {n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1};
        if (ids[n] != POOL_NONE)
            r = stored_add(a, c, ids[n]);
        else if (orphans || (d[0] <= 0 && d[1] <= 0 && d[2] <= 0))
            r = absent_add(a, brick_neighbour_key(at, n), true);
    }
    return r;
}

static status borders_add(aged *a, const clay *c, uint32_t brick_id, bool orphans)
{
    const brick *b = clay_brick(c, brick_id);
    status r = STATUS_OK;
    for (int down = 1; down < 8 && r == STATUS_OK; down++) {
        const int di = -(down >> 2), dj = -(down >> 1 & 1), dk = -(down & 1);
        bool may_cross = brick_comes_to_border(b, down);
        if (b->neighbour[brick_neighbour_index(di, dj, dk)] == POOL_NONE && (orphans || may_cross))
            r = absent_add(a, key_add(b->at, di, dj, dk), may_cross);
    }
    return r;
}

/* --- which corners --- */

static const brick_mask nothing;

static const brick_mask *moved_of(const clay *c, uint32_t brick_id)
{
    uint32_t entry = brick_id == POOL_NONE ? POOL_NONE : dirt_of(&c->dirty, clay_brick(c, brick_id));
    return entry == POOL_NONE ? &nothing : &dirt_at(&c->dirty, entry)->moved;
}

/* The brick beside b across a face. gone: there are dirty bricks that are not stored. */
static const brick_mask *moved_beside(const clay *c, const brick *b, int di, int dj, int dk, bool gone)
{
    uint32_t id = b->neighbour[brick_neighbour_index(di, dj, dk)];
    if (id != POOL_NONE || !gone)
        return moved_of(c, id);
    uint32_t entry = avl_find(&c->dirty.absent, key_add(b->at, di, dj, dk));
    return entry == POOL_NONE ? &nothing : &dirt_at(&c->dirty, entry)->moved;
}

static void corners_age(aged_brick *e, const clay *c, bool gone)
{
    const brick *b = clay_brick(c, e->brick_id);
    const brick_mask *m = moved_of(c, e->brick_id);
    const brick_mask *below[3] = {moved_beside(c, b, -1, 0, 0, gone), moved_beside(c, b, 0, -1, 0, gone),
                                  moved_beside(c, b, 0, 0, -1, gone)};
    const brick_mask *above[3] = {moved_beside(c, b, 1, 0, 0, gone), moved_beside(c, b, 0, 1, 0, gone),
                                  moved_beside(c, b, 0, 0, 1, gone)};
    uint32_t entry = dirt_of(&c->dirty, b);
    e->corners = entry == POOL_NONE ? nothing : dirt_at(&c->dirty, entry)->corners;
    for (int n = 0; n < BRICK_EDGE; n++) {
        uint64_t w = m->slab[n];
        e->corners.slab[n] |= n > 0 ? m->slab[n - 1] : below[0]->slab[7];
        e->corners.slab[n] |= n < 7 ? m->slab[n + 1] : above[0]->slab[0];
        e->corners.slab[n] |= w << 8 | below[1]->slab[n] >> 56 | w >> 8 | above[1]->slab[n] << 56;
        e->corners.slab[n] |= (w & ~BRICK_K_LAST) << 1 | (below[2]->slab[n] & BRICK_K_LAST) >> 7;
        e->corners.slab[n] |= (w & ~BRICK_K_FIRST) >> 1 | (above[2]->slab[n] & BRICK_K_FIRST) << 7;
    }
}

void aged_want(aged *a, uint32_t brick_id)
{
    const aged_link *link = &a->link[brick_id];
    if (link->round == a->round)
        aged_at(a, link->entry)->is_wanted = true;
}

void aged_corners(aged *a, const clay *c, uint32_t n)
{
    if (aged_at(a, n)->is_wanted)
        corners_age(aged_at(a, n), c, a->gone);
}

status aged_mark(aged *a, const clay *c, bool orphans)
{
    status r = begin(a, c);
    a->gone = false;
    for (uint32_t n = 0; n < dirt_count(&c->dirty) && r == STATUS_OK; n++) {
        const dirt_entry *d = dirt_at(&c->dirty, n);
        a->gone |= d->brick_id == POOL_NONE;
        r = d->brick_id == POOL_NONE ? gone_reach(a, c, d->at, orphans)
                                     : stored_reach(a, c, d->brick_id, &d->corners, orphans);
    }
    uint32_t count = aged_count(a);
    for (uint32_t n = 0; n < count && r == STATUS_OK; n++)
        if (aged_at(a, n)->brick_id != POOL_NONE)
            r = borders_add(a, c, aged_at(a, n)->brick_id, orphans);
    return r;
}
