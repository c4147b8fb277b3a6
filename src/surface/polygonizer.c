/* SPDX-License-Identifier: Apache-2.0 */
#include "surface/polygonizer.h"

#include "clay/colour.h"

#include <math.h>

/* Vertices keep this distance, in steps, from the ends of their edges: those of one corner never coincide. */
#define END_CLEARANCE 1e-3f
/* An interpolated gradient shorter than 1e-6 over two steps has no direction worth drawing. */
#define DIFFERENCE_SQUARED_MIN 1e-12f

enum { STRIDE_I = APRON_SIDE_MAX * APRON_SIDE_MAX, STRIDE_J = APRON_SIDE_MAX, STRIDE_K = 1 };

static int apron_slot(int di, int dj, int dk)
{
    return (di - APRON_LO) * STRIDE_I + (dj - APRON_LO) * STRIDE_J + (dk - APRON_LO);
}

/* Bits dk 0..8 of one row of corners: potential >= at_least. */
static unsigned row_bits(const float *row, float at_least)
{
    unsigned bits = 0;
    for (int dk = 0; dk < PATCH_SIDE; dk++)
        bits |= (unsigned)(row[dk] >= at_least) << dk;
    return bits;
}

void polygonizer_fill(polygonizer *p, const clay *c, const uint32_t neighbours[BRICK_NEIGHBOURS])
{
    apron_gather(c, neighbours, APRON_HI_MAX, p->potential, NULL);
    for (int di = 0; di < PATCH_SIDE; di++)
        for (int dj = 0; dj < PATCH_SIDE; dj++)
            p->inside[di][dj] = (uint16_t)row_bits(&p->potential[apron_slot(di, dj, 0)], POTENTIAL_ISO);
    for (int n = 0; n < 8; n++) {
        uint32_t id = neighbours[brick_neighbour_index(n >> 2, n >> 1 & 1, n & 1)];
        p->rgba[n] = id == POOL_NONE ? NULL : clay_brick(c, id)->page->rgba;
    }
}

void polygonizer_crossing(const polygonizer *p, brick_mask *crossing_out)
{
    for (int di = 0; di < BRICK_EDGE; di++) {
        uint64_t slab = 0;
        for (int dj = 0; dj < BRICK_EDGE; dj++) {
            const uint16_t *a = &p->inside[di][dj], *b = &p->inside[di + 1][dj];
            unsigned any = a[0] | a[1] | b[0] | b[1], all = a[0] & a[1] & b[0] & b[1];
            slab |= (uint64_t)(((any | any >> 1) & ~(all & all >> 1)) & 0xff) << (8 * dj);
        }
        crossing_out->slab[di] = slab;
    }
}

uint32_t polygonizer_stored_cubes(const polygonizer *p)
{
    unsigned stored[PATCH_SIDE][PATCH_SIDE];
    uint32_t sum = 0;
    for (int di = 0; di < PATCH_SIDE; di++)
        for (int dj = 0; dj < PATCH_SIDE; dj++) {
            stored[di][dj] = 0;
            for (int dk = 0; dk < PATCH_SIDE; dk++)
                stored[di][dj] |= (unsigned)(p->potential[apron_slot(di, dj, dk)] > POTENTIAL_MIN) << dk;
        }
    for (int di = 0; di < BRICK_EDGE; di++)
        for (int dj = 0; dj < BRICK_EDGE; dj++) {
            unsigned any = stored[di][dj] | stored[di][dj + 1] | stored[di + 1][dj] | stored[di + 1][dj + 1];
            sum += (uint32_t)__builtin_popcount((any | any >> 1) & 0xff);
        }
    return sum;
}

/* COLOUR_NONE and false when the corner is not stored. */
static bool corner_rgba(const polygonizer *p, const int d[3], float potential, uint32_t *rgba_out)
{
    if (!(potential > POTENTIAL_MIN))
        return false;
    const uint32_t *page = p->rgba[(d[0] >> 3) * 4 + (d[1] >> 3) * 2 + (d[2] >> 3)];
    *rgba_out = page[(d[0] & 7) << 6 | (d[1] & 7) << 3 | (d[2] & 7)];
    return true;
}

/* Twice the gradient at a corner would be the same direction: differences are left undivided. */
static void normal_make(const float *in, const float *out, float t, int axis, bool upwards, float normal_out[3])
{
    static const int stride[3] = {STRIDE_I, STRIDE_J, STRIDE_K};
    float g[3];
    for (int n = 0; n < 3; n++) {
        float at_in = in[stride[n]] - in[-stride[n]], at_out = out[stride[n]] - out[-stride[n]];
        g[n] = (1.0f - t) * at_in + t * at_out;
    }
    float squared = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
    if (squared < DIFFERENCE_SQUARED_MIN) {
        normal_out[0] = normal_out[1] = normal_out[2] = 0.0f;
        normal_out[axis] = upwards ? 1.0f : -1.0f;
        return;
    }
    float scale = -1.0f / sqrtf(squared);
    for (int n = 0; n < 3; n++)
        normal_out[n] = g[n] * scale;
}

static void vertex_make(polygonizer *p, int di, int dj, int dk, int axis)
{
    static const int stride[3] = {STRIDE_I, STRIDE_J, STRIDE_K};
    patch_vertex *v = &p->vertices[p->vertex_count];
    const float *low = &p->potential[apron_slot(di, dj, dk)], *high = low + stride[axis];
    bool upwards = *low >= POTENTIAL_ISO; /* out of the clay is up the axis */
    const float *in = upwards ? low : high, *out = upwards ? high : low;
    float t = (*in - POTENTIAL_ISO) / (*in - *out);
    float t_kept = t < END_CLEARANCE ? END_CLEARANCE : t > 1.0f - END_CLEARANCE ? 1.0f - END_CLEARANCE : t;

    int d_in[3] = {di, dj, dk}, d_out[3] = {di, dj, dk};
    (upwards ? d_out : d_in)[axis]++;
    v->position[0] = (float)di;
    v->position[1] = (float)dj;
    v->position[2] = (float)dk;
    v->position[axis] += upwards ? t_kept : 1.0f - t_kept;
    normal_make(in, out, t, axis, upwards, v->normal);
    uint32_t rgba_in = COLOUR_NONE, rgba_out = COLOUR_NONE;
    corner_rgba(p, d_in, *in, &rgba_in);
    v->rgba = corner_rgba(p, d_out, *out, &rgba_out) ? colour_mix(rgba_in, rgba_out, t, 0.5f) : rgba_in;
    v->edge = (uint32_t)(((di * PATCH_SIDE + dj) * PATCH_SIDE + dk) * 3 + axis);
    p->vertex_of[v->edge] = (uint16_t)p->vertex_count++;
}

/* Every sign change between neighbours among the 9^3 corners is a cut edge of some cube of the patch. */
static void vertices_make(polygonizer *p)
{
    p->vertex_count = 0;
    for (int di = 0; di < PATCH_SIDE; di++)
        for (int dj = 0; dj < PATCH_SIDE; dj++) {
            unsigned row = p->inside[di][dj], cut[3];
            cut[0] = di < BRICK_EDGE ? row ^ p->inside[di + 1][dj] : 0;
            cut[1] = dj < BRICK_EDGE ? row ^ p->inside[di][dj + 1] : 0;
            cut[2] = (row ^ row >> 1) & 0xff;
            for (unsigned left = cut[0] | cut[1] | cut[2]; left; left &= left - 1) {
                int dk = __builtin_ctz(left);
                for (int axis = 0; axis < 3; axis++)
                    if (cut[axis] >> dk & 1)
                        vertex_make(p, di, dj, dk, axis);
            }
        }
}

/* Corners c = dx + 2 dy + 4 dz of the cube at (di, dj, dk). */
static int cube_index(const polygonizer *p, int di, int dj, int dk)
{
    const uint16_t *a = &p->inside[di][dj], *b = &p->inside[di + 1][dj];
    unsigned r[4] = {a[0] >> dk, b[0] >> dk, a[1] >> dk, b[1] >> dk};
    unsigned near = (r[0] & 1) | (r[1] & 1) << 1 | (r[2] & 1) << 2 | (r[3] & 1) << 3;
    unsigned far = (r[0] & 2) << 3 | (r[1] & 2) << 4 | (r[2] & 2) << 5 | (r[3] & 2) << 6;
    return (int)(near | far);
}

void polygonizer_make(polygonizer *p, const case_table *t, const brick_mask *crossing)
{
    int name[CASE_TABLE_EDGES]; /* of a cube's edges, for the cube at (0, 0, 0) */
    for (int e = 0; e < CASE_TABLE_EDGES; e++) {
        int c, to;
        case_table_edge(e, &c, &to);
        name[e] = (((c & 1) * PATCH_SIDE + (c >> 1 & 1)) * PATCH_SIDE + (c >> 2)) * 3 + e / 4;
    }
    vertices_make(p);
    p->triangle_count = 0;
    for (int di = 0; di < BRICK_EDGE; di++)
        for (uint64_t left = crossing->slab[di]; left; left &= left - 1) {
            int row = __builtin_ctzll(left), dj = row >> 3, dk = row & 7;
            int index = cube_index(p, di, dj, dk), base = ((di * PATCH_SIDE + dj) * PATCH_SIDE + dk) * 3;
            const uint8_t *e = t->edge[index];
            for (int n = 0; n < t->triangles[index]; n++, e += 3) {
                uint16_t *out = p->triangles[p->triangle_count++];
                for (int corner = 0; corner < 3; corner++)
                    out[corner] = p->vertex_of[base + name[e[corner]]];
            }
        }
}
