/* SPDX-License-Identifier: Apache-2.0 */
#include "history/route.h"

#include "clay/colour.h"
#include "clay/digest.h"
#include "history/byte_order.h"

#include <stdlib.h>
#include <string.h>

enum { ROOM_FIRST = 16 };

status route_add(route *r, uint8_t *bricks, size_t size, uint32_t group)
{
    if (r->count == r->room) {
        const uint32_t room = r->room ? r->room * 2 : ROOM_FIRST;
        route_leg *grown = (route_leg *)realloc(r->legs, room * sizeof *grown);
        if (!grown)
            return STATUS_NO_MEMORY;
        r->legs = grown;
        r->room = room;
    }
    r->legs[r->count++] = (route_leg){bricks, size, group};
    return STATUS_OK;
}

void route_reverse(route *r, uint32_t from)
{
    for (uint32_t a = from, b = r->count; a + 1 < b; a++) {
        const route_leg leg = r->legs[a];
        r->legs[a] = r->legs[--b];
        r->legs[b] = leg;
    }
}

void route_finish(route *r)
{
    for (uint32_t n = 0; n < r->count; n++)
        free(r->legs[n].bricks);
    free(r->legs);
    memset(r, 0, sizeof *r);
}

/* --- one brick --- */

/* What the brick's page becomes; false where a corner would be none that clay can hold. */
static bool page_beyond(brick_page *p, const record_brick *b)
{
    const uint8_t *potential = b->potential, *rgba = b->rgba;
    for (int s = 0; s < BRICK_EDGE; s++)
        for (uint64_t left = b->mask.slab[s]; left; left &= left - 1, potential += 4, rgba += 4) {
            const int n = s * 64 + __builtin_ctzll(left);
            uint32_t bits;
            memcpy(&bits, &p->potential[n], sizeof bits);
            bits ^= byte_order_get_u32(potential);
            memcpy(&p->potential[n], &bits, sizeof bits);
            p->rgba[n] ^= byte_order_get_u32(rgba);
            if (bits == 0 ? p->rgba[n] != COLOUR_NONE
                          : !(p->potential[n] > POTENTIAL_MIN && p->potential[n] <= POTENTIAL_MAX))
                return false;
        }
    return true;
}

static const brick_page empty_page;

static const brick_page *page_of(const clay *c, key at)
{
    const uint32_t id = clay_find(c, at);
    return id == POOL_NONE ? &empty_page : clay_brick(c, id)->page;
}

static bool is_empty(const brick_page *p)
{
    return memcmp(p->potential, empty_page.potential, sizeof p->potential) == 0;
}

static uint64_t digest_of(key at, const brick_page *p) { return is_empty(p) ? 0 : digest_brick(at, p); }

static status brick_go(clay *c, const record_brick *b, const brick_page *to)
{
    uint32_t id;
    status s = clay_brick_open(c, b->at, &id);
    if (s != STATUS_OK)
        return s;
    *clay_brick(c, id)->page = *to;
    return clay_brick_close(c, id, &b->mask);
}

/* --- the way --- */

/* The legs of one group: each of their bricks is in one leg only. */
typedef struct group {
    const route *r;
    uint32_t first, end; /* legs */
    uint8_t *gone;       /* for each brick, in order: was it emptied? */
} group;

/* What goes empty goes first: a full sculpture has no room for the one side beside the other. */
typedef enum pass { PASS_EMPTIED, PASS_OTHERS } pass;

static status brick_pass(clay *c, const record_brick *b, pass which, uint8_t *gone, uint64_t *digest)
{
    const brick_page *now = page_of(c, b->at);
    brick_page to = *now;
    if (*gone)
        return STATUS_OK;
    const bool sound = page_beyond(&to, b);
    if (which == PASS_OTHERS && !sound)
        return STATUS_CORRUPT;
    if (!sound || is_empty(&to) != (which == PASS_EMPTIED))
        return STATUS_OK;
    *gone = which == PASS_EMPTIED;
    *digest += digest_of(b->at, &to) - digest_of(b->at, now);
    return brick_go(c, b, &to);
}

static status group_pass(clay *c, const group *g, pass which, uint64_t *digest)
{
    record_brick b;
    status s = STATUS_OK;
    size_t place = 0;
    for (uint32_t n = g->first; n < g->end; n++) {
        const route_leg *leg = &g->r->legs[n];
        for (size_t offset = 0, taken; s == STATUS_OK && offset < leg->size; offset += taken, place++) {
            taken = record_get_brick(&b, leg->bricks + offset, leg->size - offset);
            assert(taken > 0);
            s = brick_pass(c, &b, which, &g->gone[place], digest);
        }
    }
    clay_prune(c);
    return s;
}

static status group_go(clay *c, group *g, uint64_t *digest)
{
    size_t bricks_most = 1;
    for (uint32_t n = g->first; n < g->end; n++)
        bricks_most += g->r->legs[n].size / RECORD_BRICK_HEAD_BYTES;
    g->gone = (uint8_t *)calloc(bricks_most, 1);
    if (!g->gone)
        return STATUS_NO_MEMORY;
    status s = group_pass(c, g, PASS_EMPTIED, digest);
    if (s == STATUS_OK)
        s = group_pass(c, g, PASS_OTHERS, digest);
    free(g->gone);
    return s;
}

status route_apply(const route *r, clay *c)
{
    assert(!c->changes.recording);
    clay_change_begin(c);
    uint64_t digest = r->digest_before;
    status s = STATUS_OK;
    for (group g = {.r = r}; s == STATUS_OK && g.first < r->count; g.first = g.end) {
        for (g.end = g.first + 1; g.end < r->count && r->legs[g.end].group == r->legs[g.first].group; g.end++)
            continue;
        s = group_go(c, &g, &digest);
    }
    if (s == STATUS_OK && digest != r->digest_after)
        s = STATUS_CORRUPT;
    if (s != STATUS_OK)
        clay_change_revert(c);
    return s;
}
