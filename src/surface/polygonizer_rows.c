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

typedef uint8_t eight_u8 __attribute__((vector_size(8)));
typedef uint16_t eight_u16 __attribute__((vector_size(16)));

VEC_INLINE eight_u16 widened(uint64_t bytes)
{
    eight_u8 narrow;
    memcpy(&narrow, &bytes, sizeof narrow);
    return __builtin_convertvector(narrow, eight_u16);
}

/* The rows of nine, out of the masks of the eight bricks. */
static void rows_join(const brick_mask *const mask[8], polygonizer_bits *out)
{
    for (int di = 0; di < PATCH_SIDE; di++) {
        const int n = (di >> 3) * 4, s = di & 7;
        const eight_u16 rows = widened(mask[n]->slab[s]) | widened(mask[n + 1]->slab[s] & BRICK_K_FIRST) << 8;
        memcpy(out->row[di], &rows, sizeof rows);
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
#if defined(__BMI2__)
    return _pdep_u64(x, 0x111111111u);
#else
    uint64_t low = x & 0xff;
    low = (low | low << 12) & 0x000f000fu;
    low = (low | low << 6) & 0x03030303u;
    low = (low | low << 3) & 0x11111111u;
    return low | (uint64_t)(x >> 8 & 1) << 32;
#endif
}

/* --- vertices --- */

/* Numbers of VEC_LANES vertices, one array a number. */
typedef struct batch {
    uint32_t place_low[VEC_LANES], place_high[VEC_LANES];   /* of the edge's two corners in the apron */
    uint32_t colour_low[VEC_LANES], colour_high[VEC_LANES]; /* and in the pages: brick above * 512 + slot */
    float low[VEC_LANES], high[VEC_LANES];                  /* potentials */
    float at_low[3][VEC_LANES], at_high[3][VEC_LANES];      /* differences: twice the gradients */
    uint32_t rgba_low[VEC_LANES], rgba_high[VEC_LANES];
} batch;

/* Where the corner d lies in the pages of the eight bricks. */
VEC_INLINE vec_u colour_place(const vec_u d[3])
{
    const vec_u above = (d[0] >> 3) << 2 | (d[1] >> 3) << 1 | d[2] >> 3;
    return above << 9 | (d[0] & 7) << 6 | (d[1] & 7) << 3 | (d[2] & 7);
}

/* The orders, read: corners d, axes, and where everything lies. */
VEC_INLINE void batch_place(batch *b, const uint32_t *order, vec_u d[3], vec_u *axis)
{
    const vec_u o = vec_load_u(order), one = vec_all_u(1), zero = vec_all_u(0);
    vec_u high[3], stride = vec_all_u(STRIDE_K);
    *axis = o >> 24;
    for (uint32_t a = 0; a < 3; a++) {
        const vec_m is = vec_eq_u(*axis, vec_all_u(a));
        d[a] = o >> (8 * a) & 255;
        high[a] = d[a] + vec_pick_u(is, one, zero);
        if (a < 2)
            stride = vec_pick_u(is, vec_all_u(a == 0 ? STRIDE_I : STRIDE_J), stride);
    }
    const vec_u low = d[0] * STRIDE_I + d[1] * STRIDE_J + d[2] - APRON_LO * (STRIDE_I + STRIDE_J + STRIDE_K);
    vec_store_u(b->place_low, low);
    vec_store_u(b->place_high, low + stride);
    vec_store_u(b->colour_low, colour_place(d));
    vec_store_u(b->colour_high, colour_place(high));
}

static inline uint32_t corner_rgba(const polygonizer *p, uint32_t place)
{
    return p->rgba[place >> 9][place & (BRICK_CORNERS - 1)];
}

static inline void batch_read(batch *b, int n, const polygonizer *p)
{
    const float *low = p->potential + b->place_low[n], *high = p->potential + b->place_high[n];
    b->low[n] = *low;
    b->high[n] = *high;
    for (int a = 0; a < 3; a++) {
        b->at_low[a][n] = low[stride_of[a]] - low[-stride_of[a]];
        b->at_high[a][n] = high[stride_of[a]] - high[-stride_of[a]];
    }
    b->rgba_low[n] = corner_rgba(p, b->colour_low[n]);
    b->rgba_high[n] = corner_rgba(p, b->colour_high[n]);
}

/* Where the gradient vanishes the normal is the edge's axis. */
VEC_INLINE void normals_flat(vec_f normal[3], vec_m flat, vec_f up, vec_u axis)
{
    for (uint32_t a = 0; a < 3; a++)
        normal[a] = vec_pick(flat, vec_pick(vec_eq_u(axis, vec_all_u(a)), up, vec_all(0)), normal[a]);
}

/* Position, normal and colour as surface.h has them, as rows of a patch_vertex. Differences are left undivided: twice
   the gradient has the same direction. */
VEC_INLINE void batch_make(const batch *b, const vec_u d[3], vec_u axis, float *rows_out)
{
    const vec_f one = vec_all(1), zero = vec_all(0);
    vec_f row[8];
    vec_f low = vec_load(b->low), high = vec_load(b->high);
    vec_m up = vec_ge(low, vec_all(POTENTIAL_ISO)); /* out of the clay is up the axis */
    vec_f in = vec_pick(up, low, high), out = vec_pick(up, high, low);
    vec_f t = (in - POTENTIAL_ISO) / (in - out);
    vec_f kept = vec_pick(vec_gt(vec_all(END_CLEARANCE), t), vec_all(END_CLEARANCE), t);
    kept = vec_pick(vec_gt(kept, one - END_CLEARANCE), one - END_CLEARANCE, kept);
    vec_f along = vec_pick(up, kept, one - kept); /* from the smaller corner */
    for (uint32_t a = 0; a < 3; a++)
        row[a] = vec_float_of((vec_i)d[a]) + vec_pick(vec_eq_u(axis, vec_all_u(a)), along, zero);

    for (int a = 0; a < 3; a++) {
        vec_f at_low = vec_load(b->at_low[a]), at_high = vec_load(b->at_high[a]);
        row[3 + a] = (one - t) * vec_pick(up, at_low, at_high) + t * vec_pick(up, at_high, at_low);
    }
    vec_f squared = row[3] * row[3] + row[4] * row[4] + row[5] * row[5];
    vec_m flat = vec_gt(vec_all(DIFFERENCE_SQUARED_MIN), squared);
    vec_f scale = -1.0f / vec_sqrt(squared);
    for (int a = 0; a < 3; a++)
        row[3 + a] *= scale;
    if (vec_bits(flat) != 0)
        normals_flat(&row[3], flat, vec_pick(up, one, -one), axis);

    vec_u rgba_low = vec_load_u(b->rgba_low), rgba_high = vec_load_u(b->rgba_high);
    vec_u rgba_in = vec_pick_u(up, rgba_low, rgba_high), rgba_out = vec_pick_u(up, rgba_high, rgba_low);
    rgba_out = vec_pick_u(vec_gt(out, vec_all(POTENTIAL_MIN)), rgba_out, rgba_in);
    vec_f to[4];
    colour_rows_channels(rgba_out, to);
    row[6] = (vec_f)colour_rows_mix(rgba_in, to, t, vec_all(0.5f)); /* half way rounds up */
    row[7] = (vec_f)(((d[0] * PATCH_SIDE + d[1]) * PATCH_SIDE + d[2]) * 3 + axis);
    vec_store_rows(rows_out, row);
}

/* The rows that hold the corners of the edges ordered, and those round them. */
static apron_rows rows_needed(const polygonizer *p)
{
    /* Orders ascend along i. */
    int from_i = p->order[0] & 255, to_i = p->order[p->order_count - 1] & 255, from_j = BRICK_EDGE, to_j = 0;
    for (uint32_t n = 0; n < p->order_count; n++) {
        int dj = p->order[n] >> 8 & 255;
        from_j = dj < from_j ? dj : from_j;
        to_j = dj > to_j ? dj : to_j;
    }
    to_i = to_i + 2 > APRON_HI_MAX ? APRON_HI_MAX : to_i + 2;
    to_j = to_j + 2 > APRON_HI_MAX ? APRON_HI_MAX : to_j + 2;
    return (apron_rows){(int8_t)(from_i - 1), (int8_t)to_i, (int8_t)(from_j - 1), (int8_t)to_j};
}

/* Makes the vertices ordered. The last batch is filled up with the first order. */
static void orders_carry_out(polygonizer *p)
{
    static const uint32_t none[BRICK_CORNERS]; /* COLOUR_NONE */
    _Static_assert(sizeof(patch_vertex) == 8 * sizeof(float), "eight words");
    for (int n = 0; n < 8; n++)
        p->rgba[n] = p->above[n] ? p->above[n]->page->rgba : none;
    for (uint32_t n = 0; n < VEC_LANES; n++)
        p->order[p->order_count + n] = p->order[0];
    for (uint32_t from = 0; from < p->order_count; from += VEC_LANES) {
        uint32_t count = p->order_count - from < VEC_LANES ? p->order_count - from : VEC_LANES;
        batch b;
        vec_u d[3], axis;
        float rows[8 * VEC_LANES];
        batch_place(&b, &p->order[from], d, &axis);
        for (int n = 0; n < VEC_LANES; n++)
            batch_read(&b, n, p);
        batch_make(&b, d, axis, rows);
        const uint16_t *vertex = &p->order_vertex[from];
        if (count == VEC_LANES && vertex[VEC_LANES - 1] - vertex[0] == VEC_LANES - 1)
            memcpy(&p->vertices[vertex[0]], rows, sizeof rows); /* they follow each other */
        else
            for (uint32_t n = 0; n < count; n++)
                memcpy(&p->vertices[vertex[n]], rows + (size_t)8 * n, sizeof(patch_vertex));
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

/* Of the edges of a row, by name: dk and axis as an order has them. */
#define ORDERS_AT(dk) (dk) << 16, (dk) << 16 | 1 << 24, (dk) << 16 | 2 << 24
static const uint32_t order_of[ROW_EDGES] = {ORDERS_AT(0), ORDERS_AT(1), ORDERS_AT(2), ORDERS_AT(3), ORDERS_AT(4),
                                             ORDERS_AT(5), ORDERS_AT(6), ORDERS_AT(7), ORDERS_AT(8)};

/* row: di and dj, as an order has them. */
VEC_INLINE void order_add(polygonizer *p, uint32_t at, uint32_t row, int name, uint32_t vertex)
{
    p->order_vertex[at] = (uint16_t)vertex;
    p->order[at] = row | order_of[name];
}

/* All vertices in their order: those of aged edges are ordered, the others taken from the old patch. */
static void vertices_renew(polygonizer *p, const brick_mask *crossing, const polygonizer_bits *aged, const patch *old)
{
    const patch_vertex *from = old ? old->vertices : NULL;
    uint16_t rows[PATCH_SIDE];
    rows_cut(crossing, rows);
    uint32_t count = 0, orders = 0;
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
                    order_add(p, orders++, (uint32_t)(di | dj << 8), name, count);
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
    p->order_count = orders;
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
    uint32_t orders = 0;
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
                order_add(p, orders++, (uint32_t)(di | dj << 8), name, count + before);
            }
            count += (uint32_t)__builtin_popcount(cut);
        }
    }
    p->vertex_count = old->vertex_count;
    p->order_count = orders;
}

/* --- triangles --- */

/* A cube's triangles. Writes more than there are: the next cube's come over them. */
static inline void triangles_of(uint16_t *out, const uint16_t *vertex, const uint16_t *name, int count)
{
    enum { USUAL = 2 };
    for (int n = 0; n < USUAL * 3; n++)
        out[n] = vertex[name[n]];
    if (count > USUAL)
        for (int n = USUAL * 3; n < CASE_TABLE_TRIANGLES_MAX * 3; n++)
            out[n] = vertex[name[n]];
}

static void triangles_make(polygonizer *p, const polygonizer_cases *t, const brick_mask *crossing)
{
    uint16_t *const begin = (uint16_t *)p->triangles, *out = begin;
    for (int di = 0; di < BRICK_EDGE; di++) {
        const uint16_t *a = p->inside.row[di], *b = p->inside.row[di + 1];
        int dj = 0;
        for (uint64_t slab = crossing->slab[di]; slab != 0; slab >>= 8, dj++) {
            unsigned left = (unsigned)slab & 0xff;
            if (left == 0)
                continue;
            /* Corners c = dx + 2 dy + 4 dz of the cube at dk: the eight bits from 4 dk on. */
            uint64_t corners = spread_by_four(a[dj]) | spread_by_four(b[dj]) << 1 | spread_by_four(a[dj + 1]) << 2 |
                               spread_by_four(b[dj + 1]) << 3;
            const uint16_t *vertex = &p->vertex_of[(di * PATCH_SIDE + dj) * ROW_EDGES];
            for (; left; left &= left - 1) {
                int dk = __builtin_ctz(left);
                unsigned index = (unsigned)(corners >> (4 * dk)) & 0xff;
                triangles_of(out, vertex + 3 * dk, t->name[index], t->triangles[index]);
                out += 3 * t->triangles[index];
            }
        }
    }
    p->triangle_count = (uint32_t)(out - begin) / 3;
    p->crossing_count = brick_mask_count(crossing);
}

polygonizer_outcome LANES_NAMED(polygonizer_make)(polygonizer *p, const polygonizer_cases *t,
                                                  const brick_mask *crossing, const brick_mask *const aged[8],
                                                  const patch *old)
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
