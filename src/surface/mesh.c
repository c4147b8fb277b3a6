/* SPDX-License-Identifier: Apache-2.0 */
#include "surface/mesh.h"

#include <stdlib.h>
#include <string.h>

enum { BORDERS = 8 }; /* a patch itself and the seven upper neighbours that own edges of it, an axis a bit */

/* Which mesh vertex each patch vertex became: patch in `slot`, vertex v -> of[first[slot] + v]. */
typedef struct weld {
    uint32_t *of;
    uint64_t *first;
} weld;

/* Where on the patch's upper borders an edge's smaller corner lies: 0 when the patch owns it. */
static int edge_border(uint32_t edge)
{
    uint32_t slot = edge / 3, dk = slot % PATCH_SIDE, dj = slot / PATCH_SIDE % PATCH_SIDE;
    uint32_t di = slot / (PATCH_SIDE * PATCH_SIDE);
    return (int)((di >> 3) << 2 | (dj >> 3) << 1 | dk >> 3);
}

/* The same edge as the patch across that border names it. */
static uint32_t edge_across(uint32_t edge, int border)
{
    uint32_t back = 0;
    for (int axis = 0; axis < 3; axis++)
        back = back * PATCH_SIDE + (border >> (2 - axis) & 1 ? BRICK_EDGE : 0);
    return edge - back * 3;
}

/* Vertices ascend by edge. */
static uint32_t vertex_find(const patch *p, uint32_t edge)
{
    uint32_t low = 0, high = p->vertex_count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (p->vertices[middle].edge < edge)
            low = middle + 1;
        else
            high = middle;
    }
    /* The owner's cube at the edge's smaller corner is cut as well. */
    assert(low < p->vertex_count && p->vertices[low].edge == edge);
    return low;
}

static void vertices_own(mesh *m, weld *w, const patch *p, uint64_t first)
{
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        const patch_vertex *from = &p->vertices[v];
        if (edge_border(from->edge) != 0)
            continue;
        mesh_vertex *to = &m->vertices[m->vertex_count];
        to->brick = p->at;
        memcpy(to->offset, from->position, sizeof to->offset);
        memcpy(to->normal, from->normal, sizeof to->normal);
        to->rgba = from->rgba;
        w->of[first + v] = m->vertex_count++;
    }
}

static void vertices_borrow(weld *w, const surface *s, const patch *p, uint64_t first)
{
    uint32_t slot[BORDERS];
    for (int b = 0; b < BORDERS; b++)
        slot[b] = b == 0 ? POOL_NONE : avl_find(&s->tree, key_add(p->at, b >> 2, b >> 1 & 1, b & 1));
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        int b = edge_border(p->vertices[v].edge);
        if (b == 0)
            continue;
        assert(slot[b] != POOL_NONE);
        uint32_t theirs = vertex_find(surface_patch(s, slot[b]), edge_across(p->vertices[v].edge, b));
        w->of[first + v] = w->of[w->first[slot[b]] + theirs];
    }
}

static void triangles_add(mesh *m, const weld *w, const patch *p, uint64_t first)
{
    for (uint32_t t = 0; t < p->triangle_count; t++) {
        uint32_t *to = m->triangles[m->triangle_count++];
        for (int n = 0; n < 3; n++)
            to[n] = w->of[first + p->triangles[t][n]];
    }
}

static void mesh_weld(mesh *m, weld *w, const surface *s)
{
    avl_walk walk;
    key at;
    uint32_t slot;
    uint64_t next = 0;
    for (bool more = avl_first(&walk, &s->tree, &at, &slot); more; more = avl_next(&walk, &at, &slot)) {
        const patch *p = surface_patch(s, slot);
        w->first[slot] = next;
        next += p->vertex_count;
        vertices_own(m, w, p, w->first[slot]);
    }
    for (bool more = avl_first(&walk, &s->tree, &at, &slot); more; more = avl_next(&walk, &at, &slot)) {
        vertices_borrow(w, s, surface_patch(s, slot), w->first[slot]);
        triangles_add(m, w, surface_patch(s, slot), w->first[slot]);
    }
}

status mesh_init(mesh *m, const surface *s)
{
    memset(m, 0, sizeof *m);
    if (s->triangles == 0)
        return STATUS_OK;
    /* s->vertices counts those on borders more than once: an upper bound. */
    if (s->vertices >= UINT32_MAX || s->triangles >= UINT32_MAX)
        return STATUS_TOO_LARGE;
    weld w = {malloc(s->vertices * sizeof *w.of), malloc(surface_slots(s) * sizeof *w.first)};
    m->vertices = malloc(s->vertices * sizeof *m->vertices);
    m->triangles = malloc(s->triangles * sizeof *m->triangles);
    bool have = w.of && w.first && m->vertices && m->triangles;
    if (have)
        mesh_weld(m, &w, s);
    else
        mesh_finish(m);
    free(w.of);
    free(w.first);
    return have ? STATUS_OK : STATUS_NO_MEMORY;
}

void mesh_finish(mesh *m)
{
    free(m->vertices);
    free(m->triangles);
    memset(m, 0, sizeof *m);
}

/* --- measures --- */

/* Edges by their lower vertex: those of vertex v are other[end[v - 1] .. end[v]), each the higher vertex times two,
   plus one when the triangle runs from the higher to the lower. */
static void edges_sort(const mesh *m, uint64_t *end, uint64_t *other)
{
    for (int fill = 0; fill < 2; fill++) {
        for (uint32_t t = 0; t < m->triangle_count; t++)
            for (int n = 0; n < 3; n++) {
                uint32_t a = m->triangles[t][n], b = m->triangles[t][(n + 1) % 3], low = a < b ? a : b;
                if (fill)
                    other[end[low]++] = (uint64_t)(a ^ b ^ low) * 2 + (a > b);
                else if (low + 1 < m->vertex_count)
                    end[low + 1]++;
            }
        if (!fill)
            for (uint32_t v = 1; v < m->vertex_count; v++)
                end[v] += end[v - 1];
    }
}

/* Each value has exactly one partner that differs in the lowest bit: the same edge the other way. Of doubles, the
   partner would have two. */
static bool edges_pair(const uint64_t *other, uint64_t count)
{
    for (uint64_t a = 0; a < count; a++) {
        int partners = 0;
        for (uint64_t b = 0; b < count; b++)
            partners += other[b] == (other[a] ^ 1);
        if (partners != 1)
            return false;
    }
    return true;
}

bool mesh_is_closed(const mesh *m)
{
    if (m->triangle_count == 0)
        return true;
    uint64_t *end = calloc(m->vertex_count, sizeof *end);
    uint64_t *other = malloc((uint64_t)m->triangle_count * 3 * sizeof *other);
    bool closed = end && other;
    if (closed)
        edges_sort(m, end, other);
    for (uint32_t v = 0; closed && v < m->vertex_count; v++) {
        uint64_t begin = v ? end[v - 1] : 0;
        closed = edges_pair(other + begin, end[v] - begin);
    }
    free(end);
    free(other);
    return closed;
}

int64_t mesh_euler(const mesh *m)
{
    return (int64_t)m->vertex_count - (int64_t)m->triangle_count * 3 / 2 + (int64_t)m->triangle_count;
}

/* By the divergence theorem along x alone: each triangle's area seen from x times its mean x. Only the latter knows how
   far out a piece lies, so that pieces far apart cost few digits. */
double mesh_volume(const mesh *m)
{
    double six = 0;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        const mesh_vertex *v[3];
        for (int n = 0; n < 3; n++)
            v[n] = &m->vertices[m->triangles[t][n]];
        double along[2][2], x = 0;
        for (int n = 0; n < 2; n++) {
            along[n][0] = 8.0 * ((double)v[n + 1]->brick.j - v[0]->brick.j) + v[n + 1]->offset[1] - v[0]->offset[1];
            along[n][1] = 8.0 * ((double)v[n + 1]->brick.k - v[0]->brick.k) + v[n + 1]->offset[2] - v[0]->offset[2];
        }
        for (int n = 0; n < 3; n++)
            x += 8.0 * ((double)v[n]->brick.i - m->vertices[0].brick.i) + v[n]->offset[0];
        six += (along[0][0] * along[1][1] - along[0][1] * along[1][0]) * x;
    }
    return six / 6;
}
