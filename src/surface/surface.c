/* SPDX-License-Identifier: Apache-2.0 */
#include "surface/surface.h"

#include "clay/capacity.h"
#include "clay/digest.h"
#include "surface/polygonizer.h"

#include <stdlib.h>
#include <string.h>

/* A dirty brick marks itself and at most its 26 neighbours, so the dirt runs out first. */
enum { STALE_PER_DIRTY = BRICK_NEIGHBOURS };
/* Arrays grow to the next multiple: most remakings of a patch then fit where it lies. */
enum { VERTEX_GRAIN = 32, TRIANGLE_GRAIN = 64 };

static patch *patch_at(const surface *s, uint32_t slot) { return (patch *)pool_at(&s->patches, slot); }

/* --- making and ending --- */

status surface_init(surface *s, uint32_t patches)
{
    memset(s, 0, sizeof *s);
    case_table_init(&s->cases);
    status r = avl_init(&s->tree, patches);
    if (r == STATUS_OK)
        r = pool_init(&s->patches, sizeof(patch), patches);
    if (r == STATUS_OK)
        r = stale_init(&s->marks, STALE_PER_DIRTY * CAPACITY_DIRT);
    if (r != STATUS_OK)
        surface_finish(s);
    return r;
}

static void patch_free(patch *p)
{
    free(p->vertices);
    free(p->triangles);
    memset(p, 0, sizeof *p);
}

static void patches_clear(surface *s)
{
    for (uint32_t slot = 0; slot < surface_slots(s); slot++)
        if (surface_patch(s, slot))
            patch_free(patch_at(s, slot));
    avl_clear(&s->tree);
    pool_clear(&s->patches);
    s->triangles = s->vertices = s->crossing = 0;
}

void surface_finish(surface *s)
{
    patches_clear(s);
    avl_finish(&s->tree);
    pool_finish(&s->patches);
    stale_finish(&s->marks);
}

/* --- patches come and go --- */

const patch *surface_patch(const surface *s, uint32_t slot)
{
    /* A given-back item keeps its bytes but for the first few: generation 0 lies beyond those. */
    const patch *p = patch_at(s, slot);
    return p->generation ? p : NULL;
}

const patch *surface_find(const surface *s, key brick_at)
{
    uint32_t slot = avl_find(&s->tree, brick_at);
    return slot == POOL_NONE ? NULL : patch_at(s, slot);
}

static status patch_open(surface *s, key at, uint32_t *slot_out)
{
    status r = pool_take(&s->patches, slot_out);
    if (r != STATUS_OK)
        return r;
    *patch_at(s, *slot_out) = (patch){.at = at};
    r = avl_insert(&s->tree, at, *slot_out);
    if (r != STATUS_OK)
        pool_give(&s->patches, *slot_out);
    return r;
}

static uint64_t mask_count(const brick_mask *m)
{
    uint64_t n = 0;
    for (int slab = 0; slab < BRICK_EDGE; slab++)
        n += (uint64_t)__builtin_popcountll(m->slab[slab]);
    return n;
}

/* Takes the patch's part out of the totals, or (sign 1) puts it in. */
static void totals_move(surface *s, const patch *p, int sign)
{
    uint64_t by = (uint64_t)(int64_t)sign;
    s->vertices += by * p->vertex_count;
    s->triangles += by * p->triangle_count;
    s->crossing += by * mask_count(&p->crossing);
}

static void patch_close(surface *s, uint32_t slot)
{
    patch *p = patch_at(s, slot);
    totals_move(s, p, -1);
    avl_remove(&s->tree, p->at);
    patch_free(p);
    pool_give(&s->patches, slot);
}

/* NULL when the machine refuses; the array is then as it was. */
static void *array_grow(void *array, uint32_t *room, uint32_t need, uint32_t grain, size_t item_bytes)
{
    if (need <= *room)
        return array;
    uint32_t grown = (need + grain - 1) / grain * grain;
    void *moved = realloc(array, grown * item_bytes);
    if (moved)
        *room = grown;
    return moved;
}

static status patch_grow(patch *p, uint32_t vertices, uint32_t triangles)
{
    void *v = array_grow(p->vertices, &p->vertex_room, vertices, VERTEX_GRAIN, sizeof *p->vertices);
    if (!v)
        return STATUS_NO_MEMORY;
    p->vertices = v;
    void *t = array_grow(p->triangles, &p->triangle_room, triangles, TRIANGLE_GRAIN, sizeof *p->triangles);
    if (!t)
        return STATUS_NO_MEMORY;
    p->triangles = t;
    return STATUS_OK;
}

static bool patch_equals(const patch *p, const polygonizer *made)
{
    return p->vertex_count == made->vertex_count && p->triangle_count == made->triangle_count &&
           memcmp(p->vertices, made->vertices, p->vertex_count * sizeof *p->vertices) == 0 &&
           memcmp(p->triangles, made->triangles, p->triangle_count * sizeof *p->triangles) == 0;
}

/* The patch becomes what was made, or stays whole. */
static status patch_fill(surface *s, patch *p, const polygonizer *made, const brick_mask *crossing)
{
    status r = patch_grow(p, made->vertex_count, made->triangle_count);
    if (r != STATUS_OK || patch_equals(p, made))
        return r;
    totals_move(s, p, -1);
    p->vertex_count = made->vertex_count;
    p->triangle_count = made->triangle_count;
    memcpy(p->vertices, made->vertices, p->vertex_count * sizeof *p->vertices);
    memcpy(p->triangles, made->triangles, p->triangle_count * sizeof *p->triangles);
    p->crossing = *crossing;
    p->digest_known = false;
    p->generation = ++s->generation;
    totals_move(s, p, 1);
    return STATUS_OK;
}

/* --- bringing up to date --- */

/* Of what is in p: the patch in `slot` (POOL_NONE: a new one) is made, remade, or given back when nothing crosses. */
static status patch_remake(surface *s, polygonizer *p, key at, uint32_t slot, const brick_mask *crossing,
                           surface_counts *counts)
{
    bool fresh = slot == POOL_NONE;
    if (brick_mask_is_empty(crossing)) {
        if (!fresh)
            patch_close(s, slot);
        return STATUS_OK;
    }
    polygonizer_make(p, &s->cases, crossing);
    status r = fresh ? patch_open(s, at, &slot) : STATUS_OK;
    if (r != STATUS_OK)
        return r;
    r = patch_fill(s, patch_at(s, slot), p, crossing);
    if (r != STATUS_OK) {
        if (fresh)
            patch_close(s, slot);
        return r;
    }
    counts->patches++;
    counts->triangles += p->triangle_count;
    return STATUS_OK;
}

static bool masks_meet(const brick_mask *a, const brick_mask *b)
{
    uint64_t both = 0;
    for (int n = 0; n < BRICK_EDGE; n++)
        both |= a->slab[n] & b->slab[n];
    return both != 0;
}

static status brick_update(surface *s, const clay *c, const stale_entry *e, polygonizer *p, surface_counts *counts)
{
    const brick_mask none = {{0}}, *before = e->slot == POOL_NONE ? &none : &patch_at(s, e->slot)->crossing;
    if (brick_mask_is_empty(&e->examined) && !masks_meet(&e->aged, before))
        return STATUS_OK;
    brick_mask now;
    polygonizer_look(p, c, e->at);
    polygonizer_crossing(p, &now);
    for (int n = 0; n < BRICK_EDGE; n++)
        now.slab[n] = (now.slab[n] & e->examined.slab[n]) | (before->slab[n] & ~e->examined.slab[n]);
    if (!masks_meet(&e->aged, before) && !masks_meet(&e->aged, &now))
        return STATUS_OK;
    return patch_remake(s, p, e->at, e->slot, &now, counts);
}

status surface_update(surface *s, const clay *c, surface_counts *counts_out)
{
    surface_counts counts = {0, 0, 0};
    polygonizer p;
    stale_clear(&s->marks);
    status r = stale_mark(&s->marks, &c->dirty);
    if (r != STATUS_OK)
        return r;
    counts.treated = stale_examined(&s->marks);
    for (uint32_t n = 0; n < stale_count(&s->marks); n++)
        stale_at(&s->marks, n)->slot = avl_find(&s->tree, stale_at(&s->marks, n)->at);
    /* First the patches there are: only then is there room for as many new ones as the clay needs. */
    for (int fresh = 0; fresh < 2; fresh++)
        for (uint32_t n = 0; n < stale_count(&s->marks) && r == STATUS_OK; n++)
            if ((stale_at(&s->marks, n)->slot == POOL_NONE) == fresh)
                r = brick_update(s, c, stale_at(&s->marks, n), &p, &counts);
    if (counts_out)
        *counts_out = counts;
    return r;
}

static status brick_rebuild(surface *s, const clay *c, key at, polygonizer *p, surface_counts *counts)
{
    brick_mask crossing;
    polygonizer_look(p, c, at);
    polygonizer_crossing(p, &crossing);
    counts->treated += polygonizer_stored_cubes(p);
    return patch_remake(s, p, at, POOL_NONE, &crossing, counts);
}

/* The cubes of a brick that is not stored may reach up to seven stored ones: the first of those answers for it.
   down, 0..7: how far that brick lies below b, an axis a bit. */
static bool answers_for(const brick *b, int down)
{
    int di = down >> 2, dj = down >> 1 & 1, dk = down & 1;
    for (int n = 0; n < down; n++) {
        int ni = n >> 2, nj = n >> 1 & 1, nk = n & 1;
        if (b->neighbour[brick_neighbour_index(ni - di, nj - dj, nk - dk)] != POOL_NONE)
            return false;
    }
    return true;
}

status surface_rebuild(surface *s, const clay *c, surface_counts *counts_out)
{
    surface_counts counts = {0, 0, 0};
    polygonizer p;
    patches_clear(s);
    avl_walk w;
    key at;
    uint32_t id;
    status r = STATUS_OK;
    for (bool more = avl_first(&w, &c->tree, &at, &id); more && r == STATUS_OK; more = avl_next(&w, &at, &id))
        for (int down = 0; down < 8 && r == STATUS_OK; down++)
            if (answers_for(clay_brick(c, id), down))
                r = brick_rebuild(s, c, key_add(at, -(down >> 2), -(down >> 1 & 1), -(down & 1)), &p, &counts);
    if (counts_out)
        *counts_out = counts;
    return r;
}

uint64_t surface_digest(surface *s)
{
    uint64_t sum = 0;
    for (uint32_t slot = 0; slot < surface_slots(s); slot++) {
        if (!surface_patch(s, slot))
            continue;
        patch *p = patch_at(s, slot);
        if (!p->digest_known) {
            int32_t k[3] = {p->at.i, p->at.j, p->at.k};
            uint64_t d = digest_bytes(k, sizeof k, 0);
            d = digest_bytes(p->vertices, p->vertex_count * sizeof *p->vertices, d);
            p->digest = digest_bytes(p->triangles, p->triangle_count * sizeof *p->triangles, d);
            p->digest_known = true;
        }
        sum += p->digest;
    }
    return sum;
}
