/* SPDX-License-Identifier: Apache-2.0 */
#include "surface/surface.h"

#include "clay/capacity.h"
#include "clay/digest.h"

#include <stdlib.h>
#include <string.h>

/* A dirty brick ages itself and at most its 26 neighbours, so the dirt runs out first. */
enum { AGED_PER_DIRTY = BRICK_NEIGHBOURS };
/* Arrays grow to the next multiple: most remakings of a patch then fit where it lies. */
enum { VERTEX_GRAIN = 32, TRIANGLE_GRAIN = 64 };
/* Bricks whose memory is on its way while one is rebuilt. */
enum { REBUILD_AHEAD = 16 };

static patch *patch_at(const surface *s, uint32_t slot) { return (patch *)pool_at(&s->patches, slot); }

/* --- making and ending --- */

status surface_init(surface *s, uint32_t patches)
{
    memset(s, 0, sizeof *s);
    polygonizer_cases_init(&s->cases);
    status r = avl_init(&s->tree, patches);
    if (r == STATUS_OK)
        r = pool_init(&s->patches, sizeof(patch), patches);
    if (r == STATUS_OK)
        r = aged_init(&s->aged, AGED_PER_DIRTY * CAPACITY_DIRT);
    if (r == STATUS_OK)
        r = examined_init(&s->examined, AGED_PER_DIRTY * CAPACITY_DIRT);
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

void surface_finish(surface *s)
{
    for (uint32_t slot = 0; slot < surface_slots(s); slot++)
        if (surface_patch(s, slot))
            patch_free(patch_at(s, slot));
    avl_finish(&s->tree);
    pool_finish(&s->patches);
    aged_finish(&s->aged);
    examined_finish(&s->examined);
    free(s->link);
    memset(s, 0, sizeof *s);
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

/* Takes the patch's part out of the totals, or (sign 1) puts it in. */
static void totals_move(surface *s, const patch *p, int sign)
{
    uint64_t by = (uint64_t)(int64_t)sign;
    s->vertices += by * p->vertex_count;
    s->triangles += by * p->triangle_count;
    s->crossing += by * p->crossing_count;
}

static void patch_close(surface *s, uint32_t slot)
{
    patch *p = patch_at(s, slot);
    totals_move(s, p, -1);
    s->orphans -= p->is_orphan;
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

/* No corner changed sides: answers whether any of the vertices made is another one. */
static bool vertices_take(patch *p, const polygonizer *made)
{
    bool is_other = false;
    for (uint32_t n = 0; n < made->order_count; n++) {
        uint32_t v = made->order_vertex[n];
        is_other |= memcmp(&p->vertices[v], &made->vertices[v], sizeof *p->vertices) != 0;
        p->vertices[v] = made->vertices[v];
    }
    return is_other;
}

/* The patch becomes what was made, or stays whole. The totals are the caller's. */
static status patch_fill(patch *p, const polygonizer *made, polygonizer_outcome outcome, const brick_mask *crossing,
                         bool *is_other)
{
    *is_other = false;
    status r = STATUS_OK;
    if (outcome == POLYGONIZER_VERTICES)
        *is_other = vertices_take(p, made);
    if (outcome == POLYGONIZER_ALL)
        r = patch_grow(p, made->vertex_count, made->triangle_count);
    if (outcome == POLYGONIZER_ALL && r == STATUS_OK) {
        *is_other = true;
        p->vertex_count = made->vertex_count;
        p->triangle_count = made->triangle_count;
        memcpy(p->vertices, made->vertices, p->vertex_count * sizeof *p->vertices);
        memcpy(p->triangles, made->triangles, p->triangle_count * sizeof *p->triangles);
        memcpy(p->inside, made->inside.row, sizeof p->inside);
        memcpy(p->first, made->first, sizeof p->first);
        p->crossing = *crossing;
        p->crossing_count = made->crossing_count;
    }
    p->digest_known &= !*is_other;
    return r;
}

/* --- the way from a brick to its patch --- */

static status links_grow(surface *s, const clay *c)
{
    void *link = s->link;
    status r = pool_shadow(&c->bricks, &link, &s->links, sizeof *s->link);
    s->link = (surface_link *)link;
    return r;
}

static uint32_t slot_of(surface *s, const clay *c, uint32_t brick_id, key at)
{
    if (brick_id == POOL_NONE)
        return avl_find(&s->tree, at);
    surface_link *link = &s->link[brick_id];
    uint64_t born = clay_brick(c, brick_id)->born;
    bool is_void = link->slot != POOL_NONE && (link->slot >= surface_slots(s) || !surface_patch(s, link->slot) ||
                                               !key_equal(patch_at(s, link->slot)->at, at));
    if (link->born != born || is_void)
        *link = (surface_link){born, avl_find(&s->tree, at)};
    return link->slot;
}

/* Says which patch a brick has now; slot POOL_NONE: none. */
static void slot_set(surface *s, uint32_t brick_id, uint32_t slot)
{
    if (brick_id != POOL_NONE)
        s->link[brick_id].slot = slot;
    if (slot == POOL_NONE)
        return;
    patch *p = patch_at(s, slot);
    bool is_orphan = brick_id == POOL_NONE;
    s->orphans += (uint32_t)is_orphan - (uint32_t)p->is_orphan;
    p->is_orphan = is_orphan;
}

/* --- bringing up to date --- */

/* What is to be done about a brick's patch; then, what was: vertices made to no other end, another patch. */
enum { DO_NOTHING, DO_CLOSE, DO_OPEN, DO_RENEW, DID_NOTHING, DID_MAKE, DID_CHANGE, DID_FAIL };

/* Reads clay and surface; writes the entry. */
static void brick_examine(surface *s, const clay *c, aged_brick *e, polygonizer *p)
{
    e->slot = slot_of(s, c, e->brick_id, e->at);
    if (e->brick_id == POOL_NONE && e->slot == POOL_NONE && !e->may_cross) {
        e->outcome = DO_NOTHING;
        return;
    }
    polygonizer_look(p, c, e->at, e->brick_id);
    polygonizer_crossing(p, &e->crossing);
    bool has = e->slot != POOL_NONE, crosses = !brick_mask_is_empty(&e->crossing);
    e->outcome = has ? (crosses ? DO_RENEW : DO_CLOSE) : (crosses ? DO_OPEN : DO_NOTHING);
}

static void close_one(surface *s, aged_brick *e)
{
    patch_close(s, e->slot);
    slot_set(s, e->brick_id, POOL_NONE);
    e->outcome = DO_NOTHING;
}

static status open_one(surface *s, aged_brick *e)
{
    status r = patch_open(s, e->at, &e->slot);
    if (r == STATUS_OK)
        slot_set(s, e->brick_id, e->slot);
    else
        e->slot = POOL_NONE;
    return r;
}

static const brick_mask every_corner = BRICK_MASK_ALL;

/* Reads clay and surface; writes the entry and its patch's arrays. */
static void brick_renew(surface *s, const clay *c, aged_brick *e, polygonizer *p)
{
    const brick_mask *above[8];
    patch *of = patch_at(s, e->slot);
    polygonizer_look(p, c, e->at, e->brick_id);
    for (int n = 0; n < 8; n++) {
        above[n] = &every_corner;
        if (e->brick_id == POOL_NONE || !p->above[n])
            continue;
        const uint32_t *neighbour = clay_brick(c, e->brick_id)->neighbour;
        const aged_brick *a = aged_of(&s->aged, neighbour[brick_neighbour_index(n >> 2, n >> 1 & 1, n & 1)]);
        above[n] = a ? &a->corners : NULL;
    }
    bool is_other;
    polygonizer_outcome made = polygonizer_make(p, &s->cases, &e->crossing, above,
                                                e->outcome == DO_OPEN ? NULL : of);
    status r = patch_fill(of, p, made, &e->crossing, &is_other);
    e->outcome = is_other ? DID_CHANGE : made == POLYGONIZER_SAME ? DID_NOTHING : DID_MAKE;
    if (r != STATUS_OK)
        e->outcome = DID_FAIL;
}

static void totals_settle(surface *s, const aged_brick *e, surface_counts *counts)
{
    patch *p = patch_at(s, e->slot);
    totals_move(s, p, 1);
    if (e->outcome == DID_CHANGE)
        p->generation = ++s->generation;
    if (e->outcome == DID_MAKE || e->outcome == DID_CHANGE) {
        counts->patches++;
        counts->triangles += p->triangle_count;
    }
}

/* The corners of a patch lie in its brick and the seven above. */
static void above_want(surface *s, const clay *c, const aged_brick *e)
{
    for (int n = 0; n < 8 && e->brick_id != POOL_NONE; n++) {
        uint32_t id = clay_brick(c, e->brick_id)->neighbour[brick_neighbour_index(n >> 2, n >> 1 & 1, n & 1)];
        if (id != POOL_NONE)
            aged_want(&s->aged, id);
    }
}

/* First the patches that go: only then is there room for as many new ones as the clay needs. */
static status patches_open(surface *s, const clay *c)
{
    status r = STATUS_OK;
    for (uint32_t n = 0; n < aged_count(&s->aged); n++)
        if (aged_at(&s->aged, n)->outcome == DO_CLOSE)
            close_one(s, aged_at(&s->aged, n));
    for (uint32_t n = 0; n < aged_count(&s->aged); n++) {
        aged_brick *e = aged_at(&s->aged, n);
        if (e->outcome == DO_OPEN && r == STATUS_OK)
            r = open_one(s, e);
        if (e->outcome == DO_RENEW) {
            totals_move(s, patch_at(s, e->slot), -1);
            slot_set(s, e->brick_id, e->slot);
            above_want(s, c, e);
        }
    }
    return r;
}

typedef struct update_share {
    surface *s;
    const clay *c;
} update_share;

static void examine_job(void *on, uint32_t hand, uint32_t hands)
{
    const update_share *share = (const update_share *)on;
    polygonizer p;
    for (uint32_t n = 0; n < aged_count(&share->s->aged); n++) {
        aged_brick *e = aged_at(&share->s->aged, n);
        if (crew_hand_of(e->at, hands) == hand)
            brick_examine(share->s, share->c, e, &p);
    }
}

static void age_job(void *on, uint32_t hand, uint32_t hands)
{
    const update_share *share = (const update_share *)on;
    for (uint32_t n = 0; n < aged_count(&share->s->aged); n++)
        if (crew_hand_of(aged_at(&share->s->aged, n)->at, hands) == hand)
            aged_corners(&share->s->aged, share->c, n);
}

static void renew_job(void *on, uint32_t hand, uint32_t hands)
{
    const update_share *share = (const update_share *)on;
    polygonizer p;
    for (uint32_t n = 0; n < aged_count(&share->s->aged); n++) {
        aged_brick *e = aged_at(&share->s->aged, n);
        if (crew_hand_of(e->at, hands) != hand) /* first: the rest of the entry is its own hand's */
            continue;
        if ((e->outcome == DO_OPEN || e->outcome == DO_RENEW) && e->slot != POOL_NONE)
            brick_renew(share->s, share->c, e, &p);
    }
}

static status patches_settle(surface *s, surface_counts *counts)
{
    status r = STATUS_OK;
    for (uint32_t n = 0; n < aged_count(&s->aged); n++) {
        aged_brick *e = aged_at(&s->aged, n);
        if (e->outcome < DID_NOTHING)
            continue;
        totals_settle(s, e, counts);
        if (e->outcome == DID_FAIL) {
            r = STATUS_NO_MEMORY;
            if (patch_at(s, e->slot)->generation == 0)
                close_one(s, e);
        }
    }
    return r;
}

status surface_update(surface *s, const clay *c, surface_counts *counts_out)
{
    surface_counts counts = {0, 0, 0};
    status r = links_grow(s, c);
    if (r == STATUS_OK)
        r = aged_mark(&s->aged, c, s->orphans > 0);
    if (r == STATUS_OK && counts_out)
        r = examined_count(&s->examined, &c->dirty, &counts.treated);
    if (r != STATUS_OK)
        return r;
    update_share share = {s, c};
    crew_run(c->crew, aged_count(&s->aged), examine_job, &share);
    r = patches_open(s, c);
    crew_run(c->crew, aged_count(&s->aged), age_job, &share);
    crew_run(c->crew, aged_count(&s->aged), renew_job, &share);
    status settled = patches_settle(s, &counts);
    if (counts_out)
        *counts_out = counts;
    return r == STATUS_OK ? settled : r;
}

/* --- from nothing --- */

/* Of the bricks that are not stored, the seven below a stored one may cross. Each is left to the first stored brick
   above it. */
static bool answers_for(const brick *b, int down)
{
    const int di = down >> 2, dj = down >> 1 & 1, dk = down & 1;
    if (down != 0 && b->neighbour[brick_neighbour_index(-di, -dj, -dk)] != POOL_NONE)
        return false;
    for (int n = 1; n < down; n++) {
        int ni = n >> 2, nj = n >> 1 & 1, nk = n & 1;
        if (b->neighbour[brick_neighbour_index(ni - di, nj - dj, nk - dk)] != POOL_NONE)
            return false;
    }
    return true;
}

/* May the absent brick `down` below b cross? Asked of all the bricks above it. */
static bool may_cross(const clay *c, const brick *b, int down)
{
    for (int up = 1; up < 8; up++) {
        int di = (up >> 2) - (down >> 2), dj = (up >> 1 & 1) - (down >> 1 & 1), dk = (up & 1) - (down & 1);
        uint32_t id = b->neighbour[brick_neighbour_index(di, dj, dk)];
        if (id != POOL_NONE && brick_comes_to_border(clay_brick(c, id), up))
            return true;
    }
    return false;
}

/* Closes the patches that were not made since. */
static void patches_sweep(surface *s, uint64_t generation)
{
    for (uint32_t slot = 0; slot < surface_slots(s); slot++)
        if (surface_patch(s, slot) && patch_at(s, slot)->generation <= generation)
            patch_close(s, slot);
}

static status brick_rebuild(surface *s, const clay *c, key at, uint32_t brick_id, polygonizer *p,
                            surface_counts *counts, bool counting)
{
    aged_brick e = {.at = at, .brick_id = brick_id, .may_cross = true};
    bool is_other;
    brick_examine(s, c, &e, p);
    if (counting)
        counts->treated += polygonizer_stored_cubes(p);
    if (e.outcome == DO_CLOSE)
        close_one(s, &e);
    if (e.outcome == DO_NOTHING)
        return STATUS_OK;
    if (e.outcome == DO_OPEN)
        e.slot = avl_find(&s->tree, at); /* the link may have been another clay's */
    status r = e.slot == POOL_NONE ? open_one(s, &e) : STATUS_OK;
    if (r != STATUS_OK)
        return r;
    totals_move(s, patch_at(s, e.slot), -1);
    slot_set(s, brick_id, e.slot);
    (void)polygonizer_make(p, &s->cases, &e.crossing, NULL, NULL);
    r = patch_fill(patch_at(s, e.slot), p, POLYGONIZER_ALL, &e.crossing, &is_other);
    e.outcome = r == STATUS_OK ? DID_CHANGE : DID_FAIL;
    totals_settle(s, &e, counts);
    if (r != STATUS_OK && patch_at(s, e.slot)->generation == 0)
        close_one(s, &e);
    return r;
}

/* The brick's own patch, and those of the bricks below that it answers for. */
static status bricks_rebuild(surface *s, const clay *c, uint32_t id, polygonizer *p, surface_counts *counts,
                             bool counting)
{
    const brick *b = clay_brick(c, id);
    status r = brick_rebuild(s, c, b->at, id, p, counts, counting);
    for (int down = 1; down < 8 && r == STATUS_OK; down++)
        if (answers_for(b, down) && (counting || may_cross(c, b, down)))
            r = brick_rebuild(s, c, key_add(b->at, -(down >> 2), -(down >> 1 & 1), -(down & 1)), POOL_NONE, p, counts,
                              counting);
    return r;
}

/* Bricks lie where there was room: of those that come next the memory is asked for early. */
static uint32_t bricks_next(const clay *c, avl_walk *w, bool *more, key *at, uint32_t *id, uint32_t ids[REBUILD_AHEAD])
{
    enum { LINE = 64 };
    uint32_t count = 0;
    for (; *more && count < REBUILD_AHEAD; *more = avl_next(w, at, id)) {
        const char *b = (const char *)clay_brick(c, *id);
        for (size_t n = 0; n < sizeof(brick); n += LINE)
            __builtin_prefetch(b + n);
        ids[count++] = *id;
    }
    return count;
}

static status all_rebuild(surface *s, const clay *c, surface_counts *counts, bool counting)
{
    polygonizer p;
    avl_walk w;
    key at;
    uint32_t id, ids[REBUILD_AHEAD], count;
    status r = STATUS_OK;
    bool more = avl_first(&w, &c->tree, &at, &id);
    while (r == STATUS_OK && (count = bricks_next(c, &w, &more, &at, &id, ids)) > 0)
        for (uint32_t n = 0; n < count && r == STATUS_OK; n++)
            r = bricks_rebuild(s, c, ids[n], &p, counts, counting);
    return r;
}

status surface_rebuild(surface *s, const clay *c, surface_counts *counts_out)
{
    surface_counts counts = {0, 0, 0};
    const uint64_t generation = s->generation;
    status r = links_grow(s, c);
    if (r != STATUS_OK)
        return r;
    r = all_rebuild(s, c, &counts, counts_out != NULL);
    if (r == STATUS_POOL_FULL) { /* those that nothing is left of stood in the way */
        patches_sweep(s, generation);
        counts = (surface_counts){0, 0, 0};
        r = all_rebuild(s, c, &counts, counts_out != NULL);
    } else if (r == STATUS_OK) {
        patches_sweep(s, generation);
    }
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
