/* SPDX-License-Identifier: Apache-2.0 */
#include "clay/clay.h"

#include "clay/capacity.h"
#include "clay/colour.h"
#include "clay/digest.h"

#include <string.h>

static void image_give(clay *c, const change_image *image)
{
    if (image->page_id != POOL_NONE)
        pages_give(&c->pages, image->page_id);
}

/* --- making and ending --- */

status clay_init(clay *c, uint32_t bricks)
{
    assert(bricks >= 1 && bricks <= CAPACITY_BRICKS);
    memset(c, 0, sizeof *c);
    c->tree.root = POOL_NONE;
    c->rows = lanes_best();
    status s = avl_init(&c->tree, bricks);
    if (s == STATUS_OK)
        s = pool_init(&c->bricks, sizeof(brick), bricks);
    if (s == STATUS_OK)
        s = pages_init(&c->pages, CAPACITY_PAGES(bricks));
    if (s == STATUS_OK)
        s = change_init(&c->changes, (uint32_t)((uint64_t)bricks * CAPACITY_IMAGES / CAPACITY_BRICKS));
    if (s == STATUS_OK)
        s = dirt_init(&c->dirty, (uint32_t)((uint64_t)bricks * CAPACITY_DIRT / CAPACITY_BRICKS));
    if (s != STATUS_OK)
        clay_finish(c);
    return s;
}

void clay_finish(clay *c)
{
    assert(c->frozen == 0);
    avl_finish(&c->tree);
    pool_finish(&c->bricks);
    pages_finish(&c->pages);
    change_finish(&c->changes);
    dirt_finish(&c->dirty);
    c->corners = 0;
}

void clay_clear(clay *c)
{
    for (uint32_t n = 0; n < change_count(&c->changes); n++)
        image_give(c, change_at(&c->changes, n));
    for (uint32_t id = 0; id < c->bricks.fresh; id++)
        if (clay_brick(c, id)->page != NULL)
            pages_give(&c->pages, clay_brick(c, id)->page_id);
    avl_clear(&c->tree);
    pool_clear(&c->bricks);
    change_clear(&c->changes);
    dirt_clear(&c->dirty);
    c->corners = 0;
}

/* --- bricks come and go --- */

/* Three bricks in a row along k follow each other in the tree: nine searches for all 27. */
static void neighbours_search(const clay *c, key at, uint32_t ids_out[BRICK_NEIGHBOURS])
{
    for (int row = 0; row < BRICK_NEIGHBOURS; row += 3) {
        avl_walk w;
        key next;
        uint32_t id;
        bool more = avl_seek(&w, &c->tree, brick_neighbour_key(at, row), &next, &id);
        for (int n = row; n < row + 3; n++) {
            bool is_it = more && key_equal(next, brick_neighbour_key(at, n));
            ids_out[n] = is_it ? id : POOL_NONE;
            if (is_it)
                more = avl_next(&w, &next, &id);
        }
    }
}

void clay_neighbours(const clay *c, key brick_at, uint32_t ids_out[BRICK_NEIGHBOURS])
{
    uint32_t id = clay_find(c, brick_at);
    if (id != POOL_NONE)
        memcpy(ids_out, clay_brick(c, id)->neighbour, sizeof(uint32_t) * BRICK_NEIGHBOURS);
    else
        neighbours_search(c, brick_at, ids_out);
}

/* The newcomer and those round it learn of each other. */
static void link_up(clay *c, uint32_t id)
{
    brick *b = clay_brick(c, id);
    neighbours_search(c, b->at, b->neighbour);
    for (int n = 0; n < BRICK_NEIGHBOURS; n++)
        if (n != BRICK_SELF && b->neighbour[n] != POOL_NONE)
            clay_brick(c, b->neighbour[n])->neighbour[BRICK_NEIGHBOURS - 1 - n] = id;
}

/* page_id: what is in the brick; its hold goes over to it. */
static status brick_make(clay *c, key at, uint32_t page_id, uint32_t *id_out)
{
    uint32_t id;
    status s = pool_take(&c->bricks, &id);
    if (s != STATUS_OK)
        return s;
    s = avl_insert(&c->tree, at, id);
    brick *b = clay_brick(c, id);
    if (s != STATUS_OK) {
        b->page = NULL; /* or clay_digest would take it for a brick */
        pool_give(&c->bricks, id);
        return s;
    }
    *b = (brick){.at = at, .born = ++c->births, .image = POOL_NONE, .has_outside = true, .page_id = page_id};
    b->page = pages_at(&c->pages, page_id);
    link_up(c, id);
    dirt_born(&c->dirty, b, id);
    *id_out = id;
    return STATUS_OK;
}

static void brick_drop(clay *c, uint32_t id)
{
    brick *b = clay_brick(c, id);
    assert(b->stored == 0);
    for (int n = 0; n < BRICK_NEIGHBOURS; n++)
        if (n != BRICK_SELF && b->neighbour[n] != POOL_NONE)
            clay_brick(c, b->neighbour[n])->neighbour[BRICK_NEIGHBOURS - 1 - n] = POOL_NONE;
    avl_remove(&c->tree, b->at);
    dirt_gone(&c->dirty, b);
    b->page = NULL; /* how clay_digest knows a given-back brick */
    pages_give(&c->pages, b->page_id);
    pool_give(&c->bricks, id);
}

/* The hold on a page goes over to the brick, for that on the one it had. */
static void brick_page_set(clay *c, brick *b, uint32_t page_id)
{
    pages_give(&c->pages, b->page_id);
    b->page_id = page_id;
    b->page = pages_at(&c->pages, page_id);
}

/* Of what is full of one colour, one page is enough. */
static void brick_fold(clay *c, brick *b)
{
    if (b->has_outside || !pages_is_full(b->page))
        return;
    b->page_id = pages_fold(&c->pages, b->page_id);
    b->page = pages_at(&c->pages, b->page_id);
}

/* --- room --- */

bool clay_page_is_kept(const clay *c, uint32_t id)
{
    const brick *b = clay_brick(c, id);
    return (c->changes.recording && b->image == POOL_NONE) || pages_is_shared(&c->pages, b->page_id);
}

void clay_need_add(const clay *c, clay_need *need, key brick_at, uint32_t brick_id, clay_intent intent)
{
    const bool opened = intent != CLAY_MARK;
    if (intent == CLAY_OPEN)
        need->pages += brick_id == POOL_NONE || clay_page_is_kept(c, brick_id);
    if (brick_id != POOL_NONE) {
        const brick *b = clay_brick(c, brick_id);
        need->marks += dirt_of(&c->dirty, b) == POOL_NONE;
        need->images += opened && c->changes.recording && b->image == POOL_NONE;
        return;
    }
    need->marks += avl_find(&c->dirty.absent, brick_at) == POOL_NONE;
    need->bricks += opened;
    need->images += opened && c->changes.recording && avl_find(&c->changes.index, brick_at) == POOL_NONE;
}

status clay_need_fits(const clay *c, const clay_need *need)
{
    if (need->bricks > pool_room(&c->bricks) || need->images > pool_room(&c->changes.images) ||
        need->pages > pool_room(&c->pages.of))
        return STATUS_POOL_FULL;
    return need->marks + c->changes.images.limit > dirt_room(&c->dirty) ? STATUS_POOL_FULL : STATUS_OK;
}

status clay_reserve(clay *c, const clay_need *need)
{
    status s = clay_need_fits(c, need);
    if (s == STATUS_OK)
        s = pool_reserve(&c->bricks, (uint32_t)need->bricks);
    if (s == STATUS_OK)
        s = pages_reserve(&c->pages, (uint32_t)need->pages);
    if (s == STATUS_OK)
        s = pool_reserve(&c->tree.nodes, (uint32_t)need->bricks);
    if (s == STATUS_OK)
        s = change_reserve(&c->changes, (uint32_t)need->images);
    return s == STATUS_OK ? dirt_reserve(&c->dirty, (uint32_t)need->marks) : s;
}

status clay_room(const clay *c, uint64_t fresh, uint64_t touched)
{
    const clay_need need = {fresh, touched, c->changes.recording ? touched : 0, touched};
    return clay_need_fits(c, &need);
}

/* --- writing --- */

/* Of a brick just made there was none. */
static status image_keep(clay *c, uint32_t id, bool fresh)
{
    brick *b = clay_brick(c, id);
    if (!c->changes.recording || b->image != POOL_NONE)
        return STATUS_OK;
    return change_keep(&c->changes, &c->pages, b->at, id, fresh ? NULL : b, &b->image);
}

status clay_brick_turn(clay *c, key brick_at, uint32_t *id, uint32_t page_id)
{
    if (!key_brick_in_range(brick_at))
        return STATUS_OUT_OF_RANGE;
    const bool fresh = *id == POOL_NONE;
    status s = fresh ? brick_make(c, brick_at, page_id, id) : STATUS_OK;
    if (s != STATUS_OK)
        return s;
    s = image_keep(c, *id, fresh);
    if (s == STATUS_OK && !fresh) {
        brick_page_set(c, clay_brick(c, *id), page_id);
        clay_brick(c, *id)->digest_known = false;
    } else if (s != STATUS_OK && fresh) {
        pages_hold(&c->pages, page_id); /* the caller's still */
        brick_drop(c, *id);
        *id = POOL_NONE;
    }
    return s;
}

/* A copy of the brick's page, or an empty one. */
static status page_copy(clay *c, uint32_t id, uint32_t *page_id_out)
{
    status s = pages_take(&c->pages, page_id_out);
    if (s != STATUS_OK)
        return s;
    brick_page *page = pages_at(&c->pages, *page_id_out);
    if (id == POOL_NONE)
        memset(page, 0, sizeof *page);
    else
        *page = *clay_brick(c, id)->page;
    return STATUS_OK;
}

status clay_brick_open(clay *c, key brick_at, uint32_t *id_out)
{
    if (!key_brick_in_range(brick_at))
        return STATUS_OUT_OF_RANGE;
    uint32_t id = clay_find(c, brick_at), page_id;
    if (id != POOL_NONE && !clay_page_is_kept(c, id)) {
        clay_brick(c, id)->digest_known = false;
        *id_out = id;
        return STATUS_OK;
    }
    status s = page_copy(c, id, &page_id);
    if (s != STATUS_OK)
        return s;
    s = clay_brick_turn(c, brick_at, &id, page_id);
    if (s != STATUS_OK)
        pages_give(&c->pages, page_id);
    else
        *id_out = id;
    return s;
}

/* Restores the invariant on one row of eight. */
static void row_close(float *potential, uint32_t *rgba, uint32_t *inside_out, uint32_t *stored)
{
    uint32_t inside = 0;
    for (int n = 0; n < BRICK_EDGE; n++) {
        float v = potential[n];
        v = v > POTENTIAL_MAX ? POTENTIAL_MAX : v;
        v = v > POTENTIAL_MIN ? v : POTENTIAL_MIN; /* NaN is not above the minimum either */
        potential[n] = v;
        rgba[n] = v > POTENTIAL_MIN ? rgba[n] : COLOUR_NONE;
        inside |= (uint32_t)(v >= POTENTIAL_ISO) << n;
        *stored += v > POTENTIAL_MIN;
    }
    *inside_out = inside;
}

static status stored_mark(clay *c, uint32_t id, const brick_mask *dirtied, const brick_mask *moved)
{
    uint32_t entry;
    status s = dirt_open_stored(&c->dirty, clay_brick(c, id), id, &entry);
    if (s == STATUS_OK) {
        brick_mask_unite(&dirt_at(&c->dirty, entry)->corners, dirtied);
        brick_mask_unite(&dirt_at(&c->dirty, entry)->moved, moved);
    }
    return s;
}

status clay_brick_close(clay *c, uint32_t id, const brick_mask *dirtied)
{
    brick *b = clay_brick(c, id);
    uint32_t stored = 0;
    brick_mask all_inside = {{0}};
    for (int row = 0; row < BRICK_ROWS; row++) {
        uint32_t inside;
        row_close(b->page->potential + row * 8, b->page->rgba + row * 8, &inside, &stored);
        all_inside.slab[row >> 3] |= (uint64_t)inside << ((row & 7) * 8);
    }
    brick_set_inside(b, &all_inside);
    c->corners += (uint64_t)stored - b->stored;
    b->stored = stored;
    status s = stored_mark(c, id, dirtied, dirtied);
    if (s == STATUS_OK)
        brick_fold(c, b);
    return s;
}

status clay_mark(clay *c, key brick_at, const brick_mask *dirtied)
{
    uint32_t id = clay_find(c, brick_at);
    return id == POOL_NONE ? dirt_mark(&c->dirty, brick_at, dirtied) : stored_mark(c, id, dirtied, dirtied);
}

const dirt_entry *clay_dirt(const clay *c, key brick_at)
{
    uint32_t id = clay_find(c, brick_at);
    uint32_t entry = id == POOL_NONE ? avl_find(&c->dirty.absent, brick_at) : dirt_of(&c->dirty, clay_brick(c, id));
    return entry == POOL_NONE ? NULL : dirt_at(&c->dirty, entry);
}

void clay_brick_settle(clay *c, uint32_t id, const clay_written *now)
{
    brick *b = clay_brick(c, id);
    c->corners += (uint64_t)now->stored - b->stored;
    b->stored = now->stored;
    brick_set_inside(b, &now->inside);
    b->digest_known = false;
    status s = stored_mark(c, id, &now->dirtied, &now->moved);
    assert(s == STATUS_OK);
    (void)s;
    brick_fold(c, b);
}

void clay_prune(clay *c)
{
    for (uint32_t n = 0; n < dirt_count(&c->dirty); n++) {
        uint32_t id = dirt_at(&c->dirty, n)->brick_id;
        if (id != POOL_NONE && clay_brick(c, id)->stored == 0)
            brick_drop(c, id);
    }
}

static status brick_copy(clay *to, const brick *from, uint32_t *id_out)
{
    uint32_t page_id;
    status s = pages_take(&to->pages, &page_id);
    if (s != STATUS_OK)
        return s;
    *pages_at(&to->pages, page_id) = *from->page;
    s = brick_make(to, from->at, page_id, id_out);
    if (s != STATUS_OK) {
        pages_give(&to->pages, page_id);
        return s;
    }
    brick *b = clay_brick(to, *id_out);
    b->stored = from->stored;
    brick_set_inside(b, &from->inside);
    brick_fold(to, b);
    return STATUS_OK;
}

/* --- whole clays --- */

status clay_copy(clay *to, const clay *from)
{
    assert(clay_brick_count(to) == 0);
    if (from->bricks.count > to->bricks.limit)
        return STATUS_POOL_FULL;
    avl_walk w;
    key at;
    uint32_t id;
    for (bool more = avl_first(&w, &from->tree, &at, &id); more; more = avl_next(&w, &at, &id)) {
        uint32_t copy;
        status s = brick_copy(to, clay_brick(from, id), &copy);
        if (s != STATUS_OK) {
            clay_clear(to);
            return s;
        }
    }
    to->corners = from->corners;
    return STATUS_OK;
}

/* --- single corners --- */

float clay_read(const clay *c, key corner, uint32_t *rgba_out)
{
    uint32_t id = clay_find(c, key_brick(corner));
    if (id == POOL_NONE) {
        if (rgba_out)
            *rgba_out = COLOUR_NONE;
        return POTENTIAL_MIN;
    }
    const brick_page *p = clay_brick(c, id)->page;
    if (rgba_out)
        *rgba_out = p->rgba[key_slot(corner)];
    return p->potential[key_slot(corner)];
}

status clay_write(clay *c, key corner, float potential, uint32_t rgba)
{
    if (!key_in_range(corner))
        return STATUS_OUT_OF_RANGE;
    key at = key_brick(corner);
    int slot = key_slot(corner);
    bool opened = potential > POTENTIAL_MIN || clay_find(c, at) != POOL_NONE; /* nothing is removed from nothing */
    clay_need need = {0, 0, 0, 0};
    clay_need_add(c, &need, at, clay_find(c, at), opened ? CLAY_OPEN : CLAY_MARK);
    status s = clay_reserve(c, &need); /* nothing is refused from here on */
    brick_mask m = {{0}};
    brick_mask_set(&m, slot);
    if (s != STATUS_OK || !opened)
        return s == STATUS_OK ? dirt_mark(&c->dirty, at, &m) : s;
    uint32_t id;
    s = clay_brick_open(c, at, &id);
    if (s != STATUS_OK)
        return s;
    brick *b = clay_brick(c, id);
    b->page->potential[slot] = potential;
    b->page->rgba[slot] = rgba;
    s = clay_brick_close(c, id, &m);
    assert(s == STATUS_OK);
    if (b->stored == 0)
        brick_drop(c, id);
    return s;
}

/* --- the change under way --- */

void clay_change_begin(clay *c)
{
    assert(!c->changes.recording && change_count(&c->changes) == 0);
    c->changes.recording = true;
}

/* Bricks that still stand must forget their images before those go. */
static void images_forget(clay *c)
{
    for (uint32_t n = 0; n < change_count(&c->changes); n++) {
        const change_image *image = change_at(&c->changes, n);
        uint32_t id = clay_find(c, image->at);
        if (id != POOL_NONE)
            clay_brick(c, id)->image = POOL_NONE;
        image_give(c, image);
    }
    change_clear(&c->changes);
}

/* The brick as its image has it; its marks were held back. */
static void image_put_back(clay *c, const change_image *image)
{
    static const brick_mask all = BRICK_MASK_ALL;
    uint32_t id = clay_find(c, image->at);
    status s = STATUS_OK;
    if (image->page_id != POOL_NONE) {
        pages_hold(&c->pages, image->page_id);
        if (id == POOL_NONE)
            s = brick_make(c, image->at, image->page_id, &id);
        else
            brick_page_set(c, clay_brick(c, id), image->page_id);
    }
    assert(s == STATUS_OK);
    const clay_written as_it_was = {.inside = image->inside, .dirtied = all, .moved = all, .stored = image->stored};
    clay_brick_settle(c, id, &as_it_was);
}

void clay_change_revert(clay *c)
{
    c->changes.recording = false;
    /* Empty what was made since first, so that there is room to bring back what went. */
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t n = 0; n < change_count(&c->changes); n++) {
            const change_image *image = change_at(&c->changes, n);
            const bool was_empty = image->stored == 0;
            if (was_empty != (pass == 0) || (was_empty && clay_find(c, image->at) == POOL_NONE))
                continue;
            image_put_back(c, image);
        }
        clay_prune(c);
    }
    images_forget(c);
}

const brick_page *clay_image_page(const clay *c, uint32_t n)
{
    static const brick_page empty;
    const change_image *image = change_at(&c->changes, n);
    return image->page_id == POOL_NONE ? &empty : pages_at(&c->pages, image->page_id);
}

void clay_change_end(clay *c) { images_forget(c); }

/* --- questions about the whole --- */

static box brick_box(const brick *b)
{
    box r = box_empty();
    key first = key_of_brick(b->at);
    for (int n = 0; n < BRICK_CORNERS; n++)
        if (b->page->potential[n] > POTENTIAL_MIN)
            r = box_include(r, key_add(first, n >> 6, n >> 3 & 7, n & 7));
    return r;
}

box clay_box(const clay *c)
{
    box r = box_empty();
    avl_walk w;
    key at;
    uint32_t id;
    for (bool more = avl_first(&w, &c->tree, &at, &id); more; more = avl_next(&w, &at, &id)) {
        key first = key_of_brick(at);
        if (!box_is_empty(r) && box_contains(r, first) && box_contains(r, key_add(first, 7, 7, 7)))
            continue;
        box b = brick_box(clay_brick(c, id));
        if (!box_is_empty(b))
            r = box_include(box_include(r, b.min), b.max);
    }
    return r;
}

uint64_t clay_digest(const clay *c)
{
    uint64_t sum = 0;
    for (uint32_t id = 0, seen = 0; seen < c->bricks.count; id++) {
        brick *b = clay_brick(c, id);
        if (b->page == NULL)
            continue;
        seen++;
        if (!b->digest_known) {
            b->digest = digest_brick(b->at, b->page);
            b->digest_known = true;
        }
        sum += b->stored ? b->digest : 0;
    }
    return sum;
}

static bool brick_is_valid(const clay *c, uint32_t id)
{
    const brick *b = clay_brick(c, id);
    uint32_t stored = 0;
    if (b->page != pages_at(&c->pages, b->page_id))
        return false;
    for (int n = 0; n < BRICK_CORNERS; n++) {
        float v = b->page->potential[n];
        if (brick_mask_has(&b->inside, n) != (v >= POTENTIAL_ISO))
            return false;
        if (!(v >= POTENTIAL_MIN && v <= POTENTIAL_MAX) || (v == POTENTIAL_MIN && b->page->rgba[n] != COLOUR_NONE))
            return false;
        stored += v > POTENTIAL_MIN;
    }
    const uint32_t inside = brick_mask_count(&b->inside);
    if (stored != b->stored || stored == 0 || b->has_inside != (inside > 0) ||
        b->has_outside != (inside < BRICK_CORNERS))
        return false;
    for (int n = 0; n < BRICK_NEIGHBOURS; n++)
        if (b->neighbour[n] != clay_find(c, brick_neighbour_key(b->at, n)))
            return false;
    return true;
}

/* Has every page as many holders as there are that know of it? Frozen clays are not asked. */
static bool pages_are_valid(const clay *c)
{
    uint64_t known = c->bricks.count + c->cut;
    for (uint32_t n = 0; n < change_count(&c->changes); n++)
        known += change_at(&c->changes, n)->page_id != POOL_NONE;
    return pages_are_held(&c->pages, known, c->frozen > 0);
}

bool clay_is_valid(const clay *c)
{
    if (!avl_is_valid(&c->tree) || avl_count(&c->tree) != c->bricks.count)
        return false;
    uint64_t corners = 0;
    avl_walk w;
    key at;
    uint32_t id;
    for (bool more = avl_first(&w, &c->tree, &at, &id); more; more = avl_next(&w, &at, &id)) {
        if (!key_equal(clay_brick(c, id)->at, at) || !brick_is_valid(c, id))
            return false;
        corners += clay_brick(c, id)->stored;
    }
    return corners == c->corners && pages_are_valid(c);
}
