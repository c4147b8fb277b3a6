/* SPDX-License-Identifier: Apache-2.0 */
#include "surface/polygonizer.h"

#include "clay/colour.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Vertices keep this distance, in steps, from the ends of their edges: those of one corner never coincide. */
#define END_CLEARANCE 1e-3f
/* An interpolated gradient shorter than 1e-6 over two steps has no direction worth drawing. */
#define DIFFERENCE_SQUARED_MIN 1e-12f

enum { STRIDE_I = APRON_SIDE_MAX * APRON_SIDE_MAX, STRIDE_J = APRON_SIDE_MAX, STRIDE_K = 1 };

static const int stride_of[3] = {STRIDE_I, STRIDE_J, STRIDE_K};

/* --- which cubes cross --- */

/* Bit n: row[n] >= at_least. */
static unsigned eight_bits(const float *row, float at_least)
{
    uint8_t flag[8];
    for (int n = 0; n < 8; n++)
        flag[n] = row[n] >= at_least;
    uint64_t bytes;
    memcpy(&bytes, flag, sizeof bytes);
    /* Byte n holds 0 or 1; the product moves it to bit 56 + n, no two terms meet. Our machines are little-endian. */
    return (unsigned)(bytes * 0x0102040810204080u >> 56);
}

/* The corners 0..8 an axis that are at or over a potential, read where they lie. */
static void rows_read(const polygonizer *p, float at_least, uint16_t rows_out[PATCH_SIDE][PATCH_SIDE])
{
    for (int di = 0; di < PATCH_SIDE; di++)
        for (int dj = 0; dj < PATCH_SIDE; dj++) {
            const brick_page *const *page = &p->page[(di >> 3) * 4 + (dj >> 3) * 2];
            int slot = (di & 7) << 6 | (dj & 7) << 3;
            unsigned bits = page[0] ? eight_bits(&page[0]->potential[slot], at_least) : 0;
            if (page[1])
                bits |= (unsigned)(page[1]->potential[slot] >= at_least) << 8;
            rows_out[di][dj] = (uint16_t)bits;
        }
}

void polygonizer_look(polygonizer *p, const clay *c, key brick_at)
{
    p->of = c;
    p->at = brick_at;
    uint32_t self = clay_find(c, brick_at);
    for (int n = 0; n < 8; n++) {
        /* Most empty bricks at the clay's border cross nothing: their cubes' corners are all that is searched for. */
        int di = n >> 2, dj = n >> 1 & 1, dk = n & 1;
        uint32_t id = self != POOL_NONE ? clay_brick(c, self)->neighbour[brick_neighbour_index(di, dj, dk)]
                      : n > 0           ? clay_find(c, key_add(brick_at, di, dj, dk))
                                        : POOL_NONE;
        p->page[n] = id == POOL_NONE ? NULL : clay_brick(c, id)->page;
    }
    rows_read(p, POTENTIAL_ISO, p->inside);
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
    uint16_t stored[PATCH_SIDE][PATCH_SIDE];
    rows_read(p, FLT_TRUE_MIN, stored);
    uint32_t sum = 0;
    for (int di = 0; di < BRICK_EDGE; di++)
        for (int dj = 0; dj < BRICK_EDGE; dj++) {
            unsigned any = stored[di][dj] | stored[di][dj + 1] | stored[di + 1][dj] | stored[di + 1][dj + 1];
            sum += (uint32_t)__builtin_popcount((any | any >> 1) & 0xff);
        }
    return sum;
}

/* --- vertices --- */

static const float *apron_at(const polygonizer *p, int di, int dj, int dk)
{
    return &p->potential[(di - APRON_LO) * STRIDE_I + (dj - APRON_LO) * STRIDE_J + (dk - APRON_LO)];
}

/* Of a stored corner, 0..8 an axis. */
static uint32_t corner_rgba(const polygonizer *p, const int d[3])
{
    const brick_page *page = p->page[(d[0] >> 3) * 4 + (d[1] >> 3) * 2 + (d[2] >> 3)];
    return page->rgba[(d[0] & 7) << 6 | (d[1] & 7) << 3 | (d[2] & 7)];
}

/* Twice the gradient at a corner would be the same direction: differences are left undivided. */
static void normal_make(const float *in, const float *out, float t, int axis, bool upwards, float normal_out[3])
{
    float g[3];
    for (int n = 0; n < 3; n++) {
        float at_in = in[stride_of[n]] - in[-stride_of[n]], at_out = out[stride_of[n]] - out[-stride_of[n]];
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

static void vertex_make(const polygonizer *p, int di, int dj, int dk, int axis, patch_vertex *v)
{
    const float *low = apron_at(p, di, dj, dk), *high = low + stride_of[axis];
    bool upwards = *low >= POTENTIAL_ISO; /* out of the clay is up the axis */
    const float *in = upwards ? low : high, *out = upwards ? high : low;
    float t = (*in - POTENTIAL_ISO) / (*in - *out);
    float kept = t < END_CLEARANCE ? END_CLEARANCE : t;
    kept = kept > 1.0f - END_CLEARANCE ? 1.0f - END_CLEARANCE : kept;

    v->position[0] = (float)di;
    v->position[1] = (float)dj;
    v->position[2] = (float)dk;
    v->position[axis] += upwards ? kept : 1.0f - kept;
    normal_make(in, out, t, axis, upwards, v->normal);

    int d_in[3] = {di, dj, dk}, d_out[3] = {di, dj, dk};
    d_in[axis] += !upwards;
    d_out[axis] += upwards;
    uint32_t rgba_in = corner_rgba(p, d_in), rgba_out = *out > POTENTIAL_MIN ? corner_rgba(p, d_out) : rgba_in;
    v->rgba = colour_mix(rgba_in, rgba_out, t, 0.5f);
}

/* Bit n of nine becomes bit 3 n. */
static unsigned spread_by_three(unsigned x)
{
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

/* Every sign change between neighbours among the 9^3 corners is a cut edge of some cube of the patch. */
static void vertices_make(polygonizer *p)
{
    p->vertex_count = 0;
    for (int di = 0; di < PATCH_SIDE; di++)
        for (int dj = 0; dj < PATCH_SIDE; dj++) {
            unsigned row = p->inside[di][dj];
            unsigned cut_i = di < BRICK_EDGE ? row ^ p->inside[di + 1][dj] : 0;
            unsigned cut_j = dj < BRICK_EDGE ? row ^ p->inside[di][dj + 1] : 0;
            unsigned cut_k = (row ^ row >> 1) & 0xff;
            if ((cut_i | cut_j | cut_k) == 0)
                continue;
            unsigned left = spread_by_three(cut_i) | spread_by_three(cut_j) << 1 | spread_by_three(cut_k) << 2;
            for (; left; left &= left - 1) {
                int name = __builtin_ctz(left), edge = (di * PATCH_SIDE + dj) * PATCH_SIDE * 3 + name;
                patch_vertex *v = &p->vertices[p->vertex_count];
                vertex_make(p, di, dj, name / 3, name % 3, v);
                v->edge = (uint32_t)edge;
                p->vertex_of[edge] = (uint16_t)p->vertex_count++;
            }
        }
}

/* --- triangles --- */

/* Corners c = dx + 2 dy + 4 dz of the cube at (di, dj, dk). */
static int cube_index(const polygonizer *p, int di, int dj, int dk)
{
    const uint16_t *a = &p->inside[di][dj], *b = &p->inside[di + 1][dj];
    unsigned r[4] = {(unsigned)a[0] >> dk, (unsigned)b[0] >> dk, (unsigned)a[1] >> dk, (unsigned)b[1] >> dk};
    unsigned near = (r[0] & 1) | (r[1] & 1) << 1 | (r[2] & 1) << 2 | (r[3] & 1) << 3;
    unsigned far = (r[0] & 2) << 3 | (r[1] & 2) << 4 | (r[2] & 2) << 5 | (r[3] & 2) << 6;
    return (int)(near | far);
}

static void triangles_make(polygonizer *p, const case_table *t, const brick_mask *crossing)
{
    int name[CASE_TABLE_EDGES]; /* of a cube's edges, for the cube at (0, 0, 0) */
    for (int e = 0; e < CASE_TABLE_EDGES; e++) {
        int c, to;
        case_table_edge(e, &c, &to);
        name[e] = (((c & 1) * PATCH_SIDE + (c >> 1 & 1)) * PATCH_SIDE + (c >> 2)) * 3 + e / 4;
    }
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

void polygonizer_make(polygonizer *p, const case_table *t, const brick_mask *crossing)
{
    uint32_t neighbours[BRICK_NEIGHBOURS];
    clay_neighbours(p->of, p->at, neighbours);
    apron_gather(p->of, neighbours, APRON_HI_MAX, p->potential, NULL);
    vertices_make(p);
    triangles_make(p, t, crossing);
}
