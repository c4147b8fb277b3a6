/* SPDX-License-Identifier: Apache-2.0 */
#include "surface/aged.h"

#include <stdlib.h>
#include <string.h>

/* Bits of a slab (bit dj*8 + dk) with dk 0, and with dk 7. */
#define K_FIRST 0x0101010101010101u
#define K_LAST 0x8080808080808080u

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
    if (c->bricks.fresh <= a->links)
        return STATUS_OK;
    uint32_t links = c->bricks.fresh + c->bricks.fresh / 2;
    aged_link *link = realloc(a->link, links * sizeof *link);
    if (!link)
        return STATUS_NO_MEMORY;
    memset(link + a->links, 0, (links - a->links) * sizeof *link);
    a->link = link;
    a->links = links;
    return STATUS_OK;
}

static status entry_make(aged *a, key at, uint32_t brick_id, uint32_t *n_out)
{
    status r = pool_take(&a->entries, n_out);
    if (r != STATUS_OK)
        return r;
    aged_brick *e = aged_at(a, *n_out);
    e->at = at;
    e->brick_id = brick_id;
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

static status absent_add(aged *a, key at)
{
    uint32_t n;
    if (avl_find(&a->absent, at) != POOL_NONE)
        return STATUS_OK;
    status r = entry_make(a, at, POOL_NONE, &n);
    if (r != STATUS_OK)
        return r;
    memset(&aged_at(a, n)->corners, 0xff, sizeof(brick_mask));
    return avl_insert(&a->absent, at, n);
}

/* --- which bricks --- */

/* Which neighbours' patches see a corner of the mask, or one of the six round it: [axis][0] below, [axis][1] above. */
static void reach_of(const brick_mask *m, bool reach[3][2])
{
    uint64_t any = 0;
    for (int n = 0; n < BRICK_EDGE; n++)
        any |= m->slab[n];
    reach[0][0] = (m->slab[0] | m->slab[1]) != 0;
    reach[0][1] = m->slab[7] != 0;
    reach[1][0] = (any & 0xffff) != 0;
    reach[1][1] = any >> 56 != 0;
    reach[2][0] = (any & (K_FIRST | K_FIRST << 1)) != 0;
    reach[2][1] = (any & K_LAST) != 0;
}

/* An aged corner in a brick above lies in a face neighbour: steps up along two axes lead to none. */
static bool is_reached(bool reach[3][2], int n)
{
    const int d[3] = {n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1};
    int ups = 0;
    for (int a = 0; a < 3; a++) {
        if (d[a] != 0 && !reach[a][d[a] > 0])
            return false;
        ups += d[a] > 0;
    }
    return ups <= 1;
}

static status stored_reach(aged *a, const clay *c, uint32_t brick_id, const brick_mask *dirtied)
{
    const brick *b = clay_brick(c, brick_id);
    bool reach[3][2];
    status r = STATUS_OK;
    reach_of(dirtied, reach);
    for (int n = 0; n < BRICK_NEIGHBOURS && r == STATUS_OK; n++)
        if (b->neighbour[n] != POOL_NONE && is_reached(reach, n))
            r = stored_add(a, c, b->neighbour[n]);
    return r;
}

/* A brick that was dirtied and is gone: all round it may see that. */
static status gone_reach(aged *a, const clay *c, key at)
{
    uint32_t ids[BRICK_NEIGHBOURS];
    status r = STATUS_OK;
    clay_neighbours(c, at, ids);
    for (int n = 0; n < BRICK_NEIGHBOURS && r == STATUS_OK; n++) {
        const int d[3] = {n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1};
        if (ids[n] != POOL_NONE)
            r = stored_add(a, c, ids[n]);
        else if (d[0] <= 0 && d[1] <= 0 && d[2] <= 0)
            r = absent_add(a, key_add(at, d[0], d[1], d[2]));
    }
    return r;
}

/* May the patch of the absent brick `down` (an axis a bit) below b cross? It does only where the clay comes to its
   border at once. */
static bool comes_to_border(const brick *b, int down)
{
    for (int di = 0; di < BRICK_EDGE; di++) {
        uint64_t w = b->inside.slab[di];
        w &= down & 2 ? 0xff : ~(uint64_t)0;
        w &= down & 1 ? K_FIRST : ~(uint64_t)0;
        if (w != 0 && (di == 0 || !(down & 4)))
            return true;
    }
    return false;
}

static status borders_add(aged *a, const clay *c, uint32_t brick_id, bool orphans)
{
    const brick *b = clay_brick(c, brick_id);
    status r = STATUS_OK;
    for (int down = 1; down < 8 && r == STATUS_OK; down++) {
        const int di = -(down >> 2), dj = -(down >> 1 & 1), dk = -(down & 1);
        if (b->neighbour[brick_neighbour_index(di, dj, dk)] == POOL_NONE && (orphans || comes_to_border(b, down)))
            r = absent_add(a, key_add(b->at, di, dj, dk));
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
        e->corners.slab[n] |= (w & ~K_LAST) << 1 | (below[2]->slab[n] & K_LAST) >> 7;
        e->corners.slab[n] |= (w & ~K_FIRST) >> 1 | (above[2]->slab[n] & K_FIRST) << 7;
    }
}

status aged_mark(aged *a, const clay *c, bool orphans)
{
    bool gone = false;
    status r = begin(a, c);
    for (uint32_t n = 0; n < dirt_count(&c->dirty) && r == STATUS_OK; n++) {
        const dirt_entry *d = dirt_at(&c->dirty, n);
        gone |= d->brick_id == POOL_NONE;
        r = d->brick_id == POOL_NONE ? gone_reach(a, c, d->at) : stored_reach(a, c, d->brick_id, &d->corners);
    }
    uint32_t count = aged_count(a);
    for (uint32_t n = 0; n < count && r == STATUS_OK; n++) {
        aged_brick *e = aged_at(a, n);
        if (e->brick_id == POOL_NONE)
            continue;
        corners_age(e, c, gone);
        if (!brick_mask_is_empty(&e->corners))
            r = borders_add(a, c, e->brick_id, orphans);
    }
    return r;
}
