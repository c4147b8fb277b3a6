/* SPDX-License-Identifier: Apache-2.0 */
#include "per_corner.h"

#include "clay/colour.h"
#include "clay/potential.h"
#include "tool/walk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A lone corner has eight cubes; at most six edges end at one corner. */
enum { CUBES_PER_CORNER = 8, EDGES_PER_CORNER = 6 };

static status tree_and_items_init(avl *tree, pool *items, size_t item_bytes, uint32_t limit)
{
    status s = avl_init(tree, limit);
    return s == STATUS_OK ? pool_init(items, item_bytes, limit) : s;
}

status per_corner_init(per_corner *p, uint32_t corners)
{
    assert(corners >= 1 && corners < POOL_NONE / CUBES_PER_CORNER);
    memset(p, 0, sizeof *p);
    status s = tree_and_items_init(&p->corners, &p->corner_items, sizeof(per_corner_corner), corners);
    if (s == STATUS_OK)
        s = tree_and_items_init(&p->cubes, &p->cube_items, sizeof(per_corner_cube), corners * CUBES_PER_CORNER);
    if (s == STATUS_OK)
        s = tree_and_items_init(&p->edges, &p->edge_items, sizeof(per_corner_edge), corners * EDGES_PER_CORNER);
    if (s == STATUS_OK)
        s = avl_init(&p->crossing, corners * CUBES_PER_CORNER);
    if (s == STATUS_OK)
        s = avl_init(&p->modified, corners);
    if (s != STATUS_OK)
        per_corner_finish(p);
    return s;
}

void per_corner_finish(per_corner *p)
{
    avl *trees[] = {&p->corners, &p->cubes, &p->edges, &p->crossing, &p->modified};
    for (size_t n = 0; n < sizeof trees / sizeof *trees; n++)
        avl_finish(trees[n]);
    pool_finish(&p->corner_items);
    pool_finish(&p->cube_items);
    pool_finish(&p->edge_items);
    free(p->treated);
    memset(p, 0, sizeof *p);
}

size_t per_corner_bytes(const per_corner *p)
{
    const pool *pools[] = {&p->corners.nodes,  &p->cubes.nodes,  &p->edges.nodes, &p->crossing.nodes,
                           &p->modified.nodes, &p->corner_items, &p->cube_items,  &p->edge_items};
    size_t bytes = p->treated_room * sizeof *p->treated;
    for (size_t n = 0; n < sizeof pools / sizeof *pools; n++)
        bytes += pool_bytes(pools[n]);
    return bytes;
}

/* --- finding and making --- */

/* New item at k, its bytes unset. */
static status item_make(avl *tree, pool *items, key k, uint32_t *id_out)
{
    status s = pool_take(items, id_out);
    if (s != STATUS_OK)
        return s;
    s = avl_insert(tree, k, *id_out);
    if (s != STATUS_OK)
        pool_give(items, *id_out);
    return s;
}

static void *item_find(const avl *tree, const pool *items, key k)
{
    uint32_t id = avl_find(tree, k);
    return id == POOL_NONE ? NULL : pool_at(items, id);
}

static void item_drop(avl *tree, pool *items, key k)
{
    uint32_t id = avl_remove(tree, k);
    assert(id != POOL_NONE);
    pool_give(items, id);
}

static per_corner_corner *corner_find(const per_corner *p, key at)
{
    return (per_corner_corner *)item_find(&p->corners, &p->corner_items, at);
}

static key edge_key(key smaller, int axis)
{
    key k = {smaller.i, smaller.j, 3 * smaller.k + 2 - axis};
    return k;
}

const per_corner_corner *per_corner_find(const per_corner *p, key at) { return corner_find(p, at); }

const per_corner_edge *per_corner_find_edge(const per_corner *p, key smaller, int axis)
{
    return (const per_corner_edge *)item_find(&p->edges, &p->edge_items, edge_key(smaller, axis));
}

const per_corner_cube *per_corner_find_cube(const per_corner *p, key at)
{
    return (const per_corner_cube *)item_find(&p->cubes, &p->cube_items, at);
}

/* --- the dab --- */

static status corner_make(per_corner *p, key at, per_corner_corner **corner_out)
{
    uint32_t id;
    status s = item_make(&p->corners, &p->corner_items, at, &id);
    if (s != STATUS_OK)
        return s;
    *corner_out = (per_corner_corner *)pool_at(&p->corner_items, id);
    **corner_out = (per_corner_corner){.at = at, .id = id, .position = {(float)at.i, (float)at.j, (float)at.k}};
    return STATUS_OK;
}

static status corner_modified(per_corner *p, per_corner_corner *c)
{
    if (c->modified)
        return STATUS_OK;
    c->modified = true;
    return avl_insert(&p->modified, c->at, c->id);
}

static float wyvill(float rho2)
{
    float q = 1 - rho2;
    return rho2 < 1 ? q * q * (9 - 4 * rho2) * (POTENTIAL_MAX / 9) : POTENTIAL_MIN;
}

static status deposit(per_corner *p, key at, float d, uint32_t rgba, uint64_t dab)
{
    per_corner_corner *c = corner_find(p, at);
    if (!c) {
        status s = corner_make(p, at, &c);
        if (s != STATUS_OK)
            return s;
    }
    float f = c->potential, room = POTENTIAL_MAX - f;
    d = d < room ? d : room;
    float sum = f + d;
    if (!(d > 0))
        return corner_modified(p, c);
    c->rgba = f > POTENTIAL_MIN ? colour_mix(c->rgba, rgba, d / sum, colour_dither(at, dab)) : rgba;
    c->potential = sum > POTENTIAL_MAX ? POTENTIAL_MAX : sum;
    return corner_modified(p, c);
}

static status erase_softly(per_corner *p, key at, float d)
{
    per_corner_corner *c = corner_find(p, at);
    if (!c)
        return STATUS_OK;
    float left = c->potential - d;
    c->potential = left > POTENTIAL_MIN ? left : POTENTIAL_MIN;
    return corner_modified(p, c);
}

/* Tool-space point of a corner by addition. row is renewed where a run of eight begins, so that drift stays small. */
static void step_to(const walk *w, key at, float row[3], float point_out[3])
{
    if (at.k == w->corners.min.k || (at.k & 7) == 0) {
        walk_start(w, key_brick(at), row);
        for (int a = 0; a < 3; a++)
            row[a] += w->along[a][at.i & 7];
    }
    for (int a = 0; a < 3; a++)
        point_out[a] = row[a] + w->plane[a][(at.j & 7) * 8 + (at.k & 7)];
}

status per_corner_apply(per_corner *p, action kind, uint32_t rgba, const tool_dab *d, tool_counts *counts_out)
{
    const shape unit_ball = {NULL, NULL, {-1, -1, -1}, {1, 1, 1}, true, true};
    assert(kind == ACTION_TOOTHPASTE || kind == ACTION_SOFT_ERASER);
    memset(counts_out, 0, sizeof *counts_out);
    float amount = (float)d->amount, row[3] = {0, 0, 0}, x[3];
    walk w;
    status s = walk_begin(&w, &d->at, &unit_ball);
    if (s != STATUS_OK)
        return s;
    key at;
    for (at.i = w.corners.min.i; at.i <= w.corners.max.i; at.i++)
        for (at.j = w.corners.min.j; at.j <= w.corners.max.j; at.j++)
            for (at.k = w.corners.min.k; at.k <= w.corners.max.k; at.k++) {
                step_to(&w, at, row, x);
                counts_out->visited++;
                if (!(x[0] > -1 && x[0] < 1 && x[1] > -1 && x[1] < 1 && x[2] > -1 && x[2] < 1))
                    continue;
                counts_out->computed++;
                float contribution = amount / POTENTIAL_MAX * wyvill(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
                if (!(contribution > 0))
                    continue;
                counts_out->dirtied++;
                s = kind == ACTION_TOOTHPASTE ? deposit(p, at, contribution, rgba, d->number)
                                              : erase_softly(p, at, contribution);
                if (s != STATUS_OK)
                    return s;
            }
    return STATUS_OK;
}

status per_corner_write(per_corner *p, key at, float potential, uint32_t rgba)
{
    per_corner_corner *c = corner_find(p, at);
    if (!c) {
        status s = corner_make(p, at, &c);
        if (s != STATUS_OK)
            return s;
    }
    c->potential = potential;
    c->rgba = rgba;
    return corner_modified(p, c);
}

/* --- edges --- */

/* Corner pair of edge e: the smaller one, and the larger is one step along axis e / 4. */
static const uint8_t edge_from[PER_CORNER_EDGES] = {0, 2, 4, 6, 0, 1, 4, 5, 0, 1, 2, 3};

static float potential_at(const per_corner *p, key at)
{
    const per_corner_corner *c = corner_find(p, at);
    return c ? c->potential : POTENTIAL_MIN;
}

/* Gradient at corner n of a cube. An absent corner has nowhere to keep it. */
static void gradient_at(const per_corner *p, const per_corner_cube *cube, int n, float out[3])
{
    per_corner_corner *c = cube->corner[n];
    if (c && c->gradient_stamp == p->update) {
        memcpy(out, c->gradient, sizeof c->gradient);
        return;
    }
    key at = key_add(cube->at, n & 1, n >> 1 & 1, n >> 2);
    for (int a = 0; a < 3; a++) {
        float above = potential_at(p, key_add(at, a == 0, a == 1, a == 2));
        float below = potential_at(p, key_add(at, -(a == 0), -(a == 1), -(a == 2)));
        out[a] = (above - below) * 0.5f;
    }
    if (c) {
        memcpy(c->gradient, out, sizeof c->gradient);
        c->gradient_stamp = p->update;
    }
}

static void normal_set(per_corner_edge *edge, const float g[3], int axis, bool to_is_outside)
{
    float length = sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    for (int a = 0; a < 3; a++) {
        float flat = a != axis ? 0.0f : to_is_outside ? 1.0f : -1.0f;
        edge->normal[a] = length > 1e-12f ? -g[a] / length : flat;
    }
}

/* Where the surface cuts edge e of the cube, with normal and colour. */
static void edge_refresh(const per_corner *p, const per_corner_cube *cube, int e)
{
    per_corner_edge *edge = cube->edge[e];
    if (edge->stamp == p->update)
        return;
    edge->stamp = p->update;
    int axis = e / 4, from = edge_from[e], to = from | 1 << axis;
    bool from_is_inside = cube->index >> from & 1;
    int in = from_is_inside ? from : to, out = from_is_inside ? to : from;
    const per_corner_corner *a = cube->corner[in], *b = cube->corner[out];
    float f_in = a->potential, f_out = b ? b->potential : POTENTIAL_MIN;
    float t = (f_in - POTENTIAL_ISO) / (f_in - f_out);
    float kept = t < 1e-3f ? 1e-3f : t > 1 - 1e-3f ? 1 - 1e-3f : t;
    memcpy(edge->position, a->position, sizeof edge->position);
    edge->position[axis] += from_is_inside ? kept : -kept;
    float g[3], h[3];
    gradient_at(p, cube, in, g);
    gradient_at(p, cube, out, h);
    for (int n = 0; n < 3; n++)
        g[n] += (h[n] - g[n]) * t;
    normal_set(edge, g, axis, from_is_inside);
    edge->rgba = b ? colour_mix(a->rgba, b->rgba, t, 0.5f) : a->rgba;
}

static status edge_join(per_corner *p, per_corner_cube *cube, int e)
{
    int from = edge_from[e];
    key k = edge_key(key_add(cube->at, from & 1, from >> 1 & 1, from >> 2), e / 4);
    per_corner_edge *edge = (per_corner_edge *)item_find(&p->edges, &p->edge_items, k);
    if (!edge) {
        uint32_t id;
        status s = item_make(&p->edges, &p->edge_items, k, &id);
        if (s != STATUS_OK)
            return s;
        edge = (per_corner_edge *)pool_at(&p->edge_items, id);
        *edge = (per_corner_edge){.users = 0};
    }
    edge->users++;
    cube->edge[e] = edge;
    return STATUS_OK;
}

static void edge_leave(per_corner *p, per_corner_cube *cube, int e)
{
    int from = edge_from[e];
    assert(cube->edge[e]->users > 0);
    if (--cube->edge[e]->users == 0)
        item_drop(&p->edges, &p->edge_items, edge_key(key_add(cube->at, from & 1, from >> 1 & 1, from >> 2), e / 4));
    cube->edge[e] = NULL;
}

/* --- cubes --- */

static bool crosses(uint32_t index) { return index != 0 && index != 255; }

static status cube_edges_update(per_corner *p, per_corner_cube *cube)
{
    for (int e = 0; e < PER_CORNER_EDGES; e++) {
        int from = edge_from[e], to = from | 1 << e / 4;
        if ((cube->index >> from ^ cube->index >> to) & 1) {
            status s = cube->edge[e] ? STATUS_OK : edge_join(p, cube, e);
            if (s != STATUS_OK)
                return s;
            edge_refresh(p, cube, e);
        } else if (cube->edge[e]) {
            edge_leave(p, cube, e);
        }
    }
    return STATUS_OK;
}

/* A cube without corners left goes, after its edges. */
static status cube_examine(per_corner *p, per_corner_cube *cube)
{
    uint32_t before = cube->index, index = 0;
    bool any = false;
    for (int n = 0; n < PER_CORNER_CORNERS; n++)
        if (cube->corner[n]) {
            any = true;
            index |= (uint32_t)(cube->corner[n]->potential >= POTENTIAL_ISO) << n;
        }
    cube->index = index;
    status s = STATUS_OK;
    if (crosses(index) && !crosses(before))
        s = avl_insert(&p->crossing, cube->at, index);
    else if (!crosses(index) && crosses(before))
        avl_remove(&p->crossing, cube->at);
    if (s == STATUS_OK && (crosses(index) || crosses(before)))
        s = cube_edges_update(p, cube);
    if (s == STATUS_OK && !any)
        item_drop(&p->cubes, &p->cube_items, cube->at);
    return s;
}

static status treated_add(per_corner *p, per_corner_cube *cube)
{
    if (p->treated_count == p->treated_room) {
        size_t room = p->treated_room ? 2 * p->treated_room : 4096;
        per_corner_cube **more = (per_corner_cube **)realloc(p->treated, room * sizeof *more);
        if (!more)
            return STATUS_NO_MEMORY;
        p->treated = more;
        p->treated_room = room;
    }
    p->treated[p->treated_count++] = cube;
    return STATUS_OK;
}

/* Links or unlinks a modified corner in one of its eight cubes, and notes that cube down once. */
static status cube_reach(per_corner *p, per_corner_corner *c, int n, bool stays)
{
    key at = key_add(c->at, -(n & 1), -(n >> 1 & 1), -(n >> 2));
    per_corner_cube *cube = (per_corner_cube *)item_find(&p->cubes, &p->cube_items, at);
    if (!cube) {
        uint32_t id;
        status s = item_make(&p->cubes, &p->cube_items, at, &id);
        if (s != STATUS_OK)
            return s;
        cube = (per_corner_cube *)pool_at(&p->cube_items, id);
        *cube = (per_corner_cube){.at = at};
    }
    cube->corner[n] = stays ? c : NULL;
    if (cube->stamp == p->update)
        return STATUS_OK;
    cube->stamp = p->update;
    return treated_add(p, cube);
}

status per_corner_update(per_corner *p, uint64_t *treated_out)
{
    avl_walk w;
    key at;
    uint32_t id;
    p->update++;
    p->treated_count = 0;
    for (bool more = avl_first(&w, &p->modified, &at, &id); more; more = avl_next(&w, &at, &id)) {
        per_corner_corner *c = (per_corner_corner *)pool_at(&p->corner_items, id);
        bool stays = c->potential > POTENTIAL_MIN;
        c->modified = false;
        for (int n = 0; n < PER_CORNER_CORNERS; n++) {
            status s = cube_reach(p, c, n, stays);
            if (s != STATUS_OK)
                return s;
        }
        if (!stays)
            item_drop(&p->corners, &p->corner_items, at);
    }
    avl_clear(&p->modified);
    for (size_t n = 0; n < p->treated_count; n++) {
        status s = cube_examine(p, p->treated[n]);
        if (s != STATUS_OK)
            return s;
    }
    *treated_out = p->treated_count;
    return STATUS_OK;
}

/* Adds the cube's stored corners to *corners. */
static bool cube_is_valid(const per_corner *p, const per_corner_cube *cube, uint64_t *corners)
{
    bool any = false;
    for (int n = 0; n < PER_CORNER_CORNERS; n++) {
        if (cube->corner[n] != corner_find(p, key_add(cube->at, n & 1, n >> 1 & 1, n >> 2)))
            return false;
        any |= cube->corner[n] != NULL;
        *corners += cube->corner[n] != NULL;
    }
    for (int e = 0; e < PER_CORNER_EDGES; e++) {
        int from = edge_from[e], to = from | 1 << e / 4;
        if (((cube->index >> from ^ cube->index >> to) & 1) != (cube->edge[e] != NULL))
            return false;
    }
    return any;
}

bool per_corner_is_valid(const per_corner *p)
{
    avl_walk w;
    key at;
    uint32_t id;
    uint64_t corners = 0;
    for (bool more = avl_first(&w, &p->cubes, &at, &id); more; more = avl_next(&w, &at, &id))
        if (!cube_is_valid(p, (const per_corner_cube *)pool_at(&p->cube_items, id), &corners))
            return false;
    return corners == (uint64_t)PER_CORNER_CORNERS * avl_count(&p->corners) && avl_count(&p->modified) == 0;
}
