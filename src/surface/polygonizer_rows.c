/* SPDX-License-Identifier: Apache-2.0 */
#include "surface/polygonizer.h"

#include "clay/colour_rows.h"

/* Vertices keep this distance, in steps, from the ends of their edges: those of one corner never coincide. */
#define END_CLEARANCE 1e-3f
/* An interpolated gradient shorter than 1e-6 over two steps has no direction worth drawing. */
#define DIFFERENCE_SQUARED_MIN 1e-12f

enum { STRIDE_I = APRON_SIDE_MAX * APRON_SIDE_MAX, STRIDE_J = APRON_SIDE_MAX, STRIDE_K = 1 };
enum { ROW_EDGES = PATCH_SIDE * 3 };

static const int stride_of[3] = {STRIDE_I, STRIDE_J, STRIDE_K};

/* --- bits --- */

/* The rows of nine, out of the masks of the eight bricks. */
static void rows_join(const brick_mask *const mask[8], polygonizer_bits *out)
{
    for (int di = 0; di < PATCH_SIDE; di++) {
        int n = (di >> 3) * 4, s = di & 7;
        uint64_t w = mask[n]->slab[s], k = mask[n + 1]->slab[s];
        for (int dj = 0; dj < BRICK_EDGE; dj++, w >>= 8, k >>= 8)
            out->row[di][dj] = (uint16_t)((w & 0xff) | (k & 1) << 8);
        out->row[di][BRICK_EDGE] = (uint16_t)((mask[n + 2]->slab[s] & 0xff) | (mask[n + 3]->slab[s] & 1) << 8);
    }
}

/* Bit n of nine becomes bit 3 n. */
VEC_INLINE unsigned spread_by_three(unsigned x)
{
#if defined(__BMI2__)
    return _pdep_u32(x, 0x1249249u);
#else
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
#endif
}

/* Bit n of nine becomes bit 4 n. */
VEC_INLINE uint64_t spread_by_four(unsigned x)
{
    uint64_t low = x & 0xff;
    low = (low | low << 12) & 0x000f000fu;
    low = (low | low << 6) & 0x03030303u;
    low = (low | low << 3) & 0x11111111u;
    return low | (uint64_t)(x >> 8 & 1) << 32;
}

/* --- vertices --- */

/* Numbers of VEC_LANES vertices, one array a number. */
typedef struct batch {
    float low[VEC_LANES], high[VEC_LANES];             /* potentials of the edge's two corners */
    float at_low[3][VEC_LANES], at_high[3][VEC_LANES]; /* differences there: twice the gradients */
    uint32_t rgba_low[VEC_LANES], rgba_high[VEC_LANES];
    float along[VEC_LANES];   /* out: distance from the smaller corner */
    float normal[3][VEC_LANES];
    float flat[VEC_LANES];    /* out: where the gradient vanishes, 1 if out is up the edge, else -1; 0 elsewhere */
    uint32_t rgba[VEC_LANES];
} batch;

static inline uint32_t corner_rgba(const polygonizer *p, int di, int dj, int dk)
{
    const brick *b = p->above[(di >> 3) * 4 + (dj >> 3) * 2 + (dk >> 3)];
    return b ? b->page->rgba[(di & 7) << 6 | (dj & 7) << 3 | (dk & 7)] : COLOUR_NONE;
}

static inline void batch_read(batch *b, int n, const polygonizer *p, const polygonizer_order *o)
{
    const float *low = &p->potential[(o->d[0] - APRON_LO) * STRIDE_I + (o->d[1] - APRON_LO) * STRIDE_J +
                                     (o->d[2] - APRON_LO)];
    const float *high = low + stride_of[o->axis];
    b->low[n] = *low;
    b->high[n] = *high;
    for (int a = 0; a < 3; a++) {
        b->at_low[a][n] = low[stride_of[a]] - low[-stride_of[a]];
        b->at_high[a][n] = high[stride_of[a]] - high[-stride_of[a]];
    }
    b->rgba_low[n] = corner_rgba(p, o->d[0], o->d[1], o->d[2]);
    b->rgba_high[n] = corner_rgba(p, o->d[0] + (o->axis == 0), o->d[1] + (o->axis == 1), o->d[2] + (o->axis == 2));
}

/* Position, normal and colour as surface.h has them. Differences are left undivided: twice the gradient has the same
   direction. */
static inline void batch_make(batch *b)
{
    const vec_f one = vec_all(1), zero = vec_all(0);
    vec_f low = vec_load(b->low), high = vec_load(b->high);
    vec_m up = vec_ge(low, vec_all(POTENTIAL_ISO)); /* out of the clay is up the axis */
    vec_f in = vec_pick(up, low, high), out = vec_pick(up, high, low);
    vec_f t = (in - POTENTIAL_ISO) / (in - out);
    vec_f kept = vec_pick(vec_gt(vec_all(END_CLEARANCE), t), vec_all(END_CLEARANCE), t);
    kept = vec_pick(vec_gt(kept, one - END_CLEARANCE), one - END_CLEARANCE, kept);
    vec_store(b->along, vec_pick(up, kept, one - kept));

    vec_f g[3];
    for (int a = 0; a < 3; a++) {
        vec_f at_low = vec_load(b->at_low[a]), at_high = vec_load(b->at_high[a]);
        g[a] = (one - t) * vec_pick(up, at_low, at_high) + t * vec_pick(up, at_high, at_low);
    }
    vec_f squared = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
    vec_m flat = vec_gt(vec_all(DIFFERENCE_SQUARED_MIN), squared);
    vec_f scale = vec_pick(flat, zero, -1.0f / vec_sqrt(squared));
    for (int a = 0; a < 3; a++)
        vec_store(b->normal[a], g[a] * scale);
    vec_store(b->flat, vec_pick(flat, vec_pick(up, one, -one), zero));

    vec_u rgba_low = vec_load_u(b->rgba_low), rgba_high = vec_load_u(b->rgba_high);
    vec_u rgba_in = vec_pick_u(up, rgba_low, rgba_high), rgba_out = vec_pick_u(up, rgba_high, rgba_low);
    rgba_out = vec_pick_u(vec_gt(out, vec_all(POTENTIAL_MIN)), rgba_out, rgba_in);
    vec_f to[4];
    colour_rows_channels(rgba_out, to);
    vec_store_u(b->rgba, colour_rows_mix(rgba_in, to, t, vec_all(0.5f))); /* half way rounds up */
}

static inline void batch_write(const batch *b, int n, const polygonizer_order *o, patch_vertex *v)
{
    for (int a = 0; a < 3; a++) {
        v->position[a] = (float)o->d[a];
        v->normal[a] = b->normal[a][n];
    }
    v->position[o->axis] += b->along[n];
    if (b->flat[n] != 0) {
        v->normal[0] = v->normal[1] = v->normal[2] = 0;
        v->normal[o->axis] = b->flat[n];
    }
    v->rgba = b->rgba[n];
    v->edge = (uint32_t)(((o->d[0] * PATCH_SIDE + o->d[1]) * PATCH_SIDE + o->d[2]) * 3 + o->axis);
}

/* The rows that hold the corners of the edges ordered, and those round them. */
static apron_rows rows_needed(const polygonizer *p)
{
    /* Orders ascend along i. */
    const polygonizer_order *first = &p->orders[0], *last = &p->orders[p->order_count - 1];
    apron_rows r = {(int8_t)(first->d[0] - 1), (int8_t)(last->d[0] + 2), BRICK_EDGE, 0};
    for (uint32_t n = 0; n < p->order_count; n++) {
        int8_t dj = (int8_t)p->orders[n].d[1];
        r.from_j = dj < r.from_j ? dj : r.from_j;
        r.to_j = dj > r.to_j ? dj : r.to_j;
    }
    r.to_i = r.to_i > APRON_HI_MAX ? APRON_HI_MAX : r.to_i;
    r.from_j = (int8_t)(r.from_j - 1);
    r.to_j = r.to_j + 2 > APRON_HI_MAX ? APRON_HI_MAX : (int8_t)(r.to_j + 2);
    return r;
}

/* Makes the vertices ordered. The last batch is filled up with its first vertex. */
static void orders_carry_out(polygonizer *p)
{
    batch b;
    for (uint32_t from = 0; from < p->order_count; from += VEC_LANES) {
        uint32_t count = p->order_count - from < VEC_LANES ? p->order_count - from : VEC_LANES;
        const polygonizer_order *o = &p->orders[from];
        for (uint32_t n = 0; n < VEC_LANES; n++)
            batch_read(&b, (int)n, p, &o[n < count ? n : 0]);
        batch_make(&b);
        for (uint32_t n = 0; n < count; n++)
            batch_write(&b, (int)n, &o[n], &p->vertices[o[n].vertex]);
    }
}

/* --- cut edges --- */

/* For each di the rows dj that may have cut edges: those of crossing cubes. */
static void rows_cut(const brick_mask *crossing, uint16_t rows_out[PATCH_SIDE])
{
    unsigned below = 0;
    for (int di = 0; di < PATCH_SIDE; di++) {
        unsigned here = 0;
        if (di < BRICK_EDGE)
            for (uint64_t left = crossing->slab[di], dj = 0; left; left >>= 8, dj++)
                here |= (unsigned)((left & 0xff) != 0) << dj;
        here |= here << 1;
        rows_out[di] = (uint16_t)(here | below);
        below = here;
    }
}

/* A row's cut edges, bit dk * 3 + axis. */
VEC_INLINE unsigned edges_cut(const polygonizer_bits *in, int di, int dj)
{
    unsigned row = in->row[di][dj];
    unsigned cut_i = di < BRICK_EDGE ? row ^ in->row[di + 1][dj] : 0;
    unsigned cut_j = dj < BRICK_EDGE ? row ^ in->row[di][dj + 1] : 0;
    unsigned cut_k = (row ^ row >> 1) & 0xff;
    if ((cut_i | cut_j | cut_k) == 0)
        return 0;
    return spread_by_three(cut_i) | spread_by_three(cut_j) << 1 | spread_by_three(cut_k) << 2;
}

/* A row's edges with an aged corner, likewise. */
VEC_INLINE unsigned edges_aged(const polygonizer_bits *aged, int di, int dj)
{
    unsigned row = aged->row[di][dj];
    unsigned i = di < BRICK_EDGE ? row | aged->row[di + 1][dj] : row;
    unsigned j = dj < BRICK_EDGE ? row | aged->row[di][dj + 1] : row;
    return spread_by_three(i) | spread_by_three(j) << 1 | spread_by_three(row | row >> 1) << 2;
}

VEC_INLINE void order_add(polygonizer *p, int di, int dj, int name, uint32_t vertex)
{
    const uint8_t dk = (uint8_t)(name * 43 >> 7); /* a third, of what a row has */
    p->orders[p->order_count++] =
        (polygonizer_order){(uint16_t)vertex, {(uint8_t)di, (uint8_t)dj, dk}, (uint8_t)(name - 3 * dk)};
}

/* All vertices in their order: those of aged edges are ordered, the others taken from the old patch. */
static void vertices_renew(polygonizer *p, const brick_mask *crossing, const polygonizer_bits *aged, const patch *old)
{
    const patch_vertex *from = old ? old->vertices : NULL;
    uint16_t rows[PATCH_SIDE];
    rows_cut(crossing, rows);
    uint32_t count = 0;
    for (int di = 0; di < PATCH_SIDE; di++) {
        p->first[di] = (uint16_t)count;
        for (unsigned todo = rows[di]; todo; todo &= todo - 1) {
            const int dj = __builtin_ctz(todo);
            unsigned left = edges_cut(&p->inside, di, dj), made = aged ? edges_aged(aged, di, dj) : ~0u;
            const int row = (di * PATCH_SIDE + dj) * ROW_EDGES;
            for (; left; left &= left - 1, count++) {
                int name = __builtin_ctz(left);
                p->vertex_of[row + name] = (uint16_t)count;
                if (made >> name & 1) {
                    order_add(p, di, dj, name, count);
                    continue;
                }
                /* Neither of its corners changed sides: the old patch has it. */
                while (from->edge < (uint32_t)(row + name))
                    from++;
                p->vertices[count] = *from;
            }
        }
    }
    p->vertex_count = count;
}

static bool slab_is_aged(const polygonizer_bits *aged, int di)
{
    unsigned any = 0;
    for (int dj = 0; dj < PATCH_SIDE; dj++)
        any |= aged->row[di][dj] | (di < BRICK_EDGE ? aged->row[di + 1][dj] : 0);
    return any != 0;
}

/* No corner changed sides: each vertex stays in its place, those of aged edges are ordered. */
static void vertices_refresh(polygonizer *p, const polygonizer_bits *aged, const patch *old)
{
    for (int di = 0; di < PATCH_SIDE; di++) {
        uint32_t count = old->first[di], end = di < BRICK_EDGE ? old->first[di + 1] : old->vertex_count;
        if (count == end || !slab_is_aged(aged, di))
            continue;
        for (int dj = 0; dj < PATCH_SIDE; dj++) {
            unsigned cut = edges_cut(&p->inside, di, dj);
            if (cut == 0)
                continue;
            for (unsigned left = cut & edges_aged(aged, di, dj); left; left &= left - 1) {
                int name = __builtin_ctz(left);
                uint32_t before = (uint32_t)__builtin_popcount(cut & ((1u << name) - 1));
                order_add(p, di, dj, name, count + before);
            }
            count += (uint32_t)__builtin_popcount(cut);
        }
    }
    p->vertex_count = old->vertex_count;
}

/* --- triangles --- */

/* A cube's triangles by its edges' names; the table knows edges only. Writes more than there are: the next cube's come
   over them. */
static inline void triangles_of(uint16_t *out, const uint16_t *vertex, const uint8_t *e, const int *name, int count)
{
    enum { USUAL = 2 };
    for (int n = 0; n < USUAL * 3; n++)
        out[n] = vertex[name[e[n]]];
    if (count > USUAL)
        for (int n = USUAL * 3; n < CASE_TABLE_TRIANGLES_MAX * 3; n++)
            out[n] = vertex[name[e[n]]];
}

static void triangles_make(polygonizer *p, const case_table *t, const brick_mask *crossing)
{
    int name[CASE_TABLE_EDGES]; /* of a cube's edges, for the cube at (0, 0, 0) */
    for (int e = 0; e < CASE_TABLE_EDGES; e++) {
        int c, to;
        case_table_edge(e, &c, &to);
        name[e] = (((c & 1) * PATCH_SIDE + (c >> 1 & 1)) * PATCH_SIDE + (c >> 2)) * 3 + e / 4;
    }
    uint16_t *const begin = (uint16_t *)p->triangles, *out = begin;
    for (int di = 0; di < BRICK_EDGE; di++)
        for (int dj = 0; dj < BRICK_EDGE; dj++) {
            unsigned left = (unsigned)(crossing->slab[di] >> (8 * dj)) & 0xff;
            if (left == 0)
                continue;
            /* Corners c = dx + 2 dy + 4 dz of the cube at dk: the eight bits from 4 dk on. */
            const uint16_t *a = &p->inside.row[di][dj], *b = &p->inside.row[di + 1][dj];
            uint64_t corners = spread_by_four(a[0]) | spread_by_four(b[0]) << 1 | spread_by_four(a[1]) << 2 |
                               spread_by_four(b[1]) << 3;
            for (; left; left &= left - 1) {
                int dk = __builtin_ctz(left);
                unsigned index = (unsigned)(corners >> (4 * dk)) & 0xff;
                triangles_of(out, &p->vertex_of[((di * PATCH_SIDE + dj) * PATCH_SIDE + dk) * 3], t->edge[index], name,
                             t->triangles[index]);
                out += 3 * t->triangles[index];
            }
        }
    p->triangle_count = (uint32_t)(out - begin) / 3;
}

polygonizer_outcome LANES_NAMED(polygonizer_make)(polygonizer *p, const case_table *t, const brick_mask *crossing,
                                                  const brick_mask *const aged[8], const patch *old)
{
    static const brick_mask nothing;
    const brick_mask *inside[8], *age[8];
    polygonizer_bits aged_bits;
    if (!old)
        aged = NULL;
    for (int n = 0; n < 8; n++) {
        inside[n] = p->above[n] ? &p->above[n]->inside : &nothing;
        age[n] = aged && aged[n] ? aged[n] : &nothing;
    }
    rows_join(inside, &p->inside);
    if (aged)
        rows_join(age, &aged_bits);
    p->order_count = 0;
    bool is_same = old && aged && memcmp(old->inside, p->inside.row, sizeof old->inside) == 0;
    if (is_same)
        vertices_refresh(p, &aged_bits, old);
    else
        vertices_renew(p, crossing, aged ? &aged_bits : NULL, old);
    if (is_same && p->order_count == 0)
        return POLYGONIZER_SAME;
    if (p->order_count > 0) {
        uint32_t neighbours[BRICK_NEIGHBOURS];
        if (p->brick_id == POOL_NONE)
            clay_neighbours(p->of, p->at, neighbours);
        apron_gather_rows(p->of, p->brick_id == POOL_NONE ? neighbours : clay_brick(p->of, p->brick_id)->neighbour,
                          APRON_HI_MAX, rows_needed(p), p->potential);
        orders_carry_out(p);
    }
    if (is_same)
        return POLYGONIZER_VERTICES;
    triangles_make(p, t, crossing);
    return POLYGONIZER_ALL;
}
