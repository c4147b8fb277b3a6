/* SPDX-License-Identifier: Apache-2.0 */
#include "tool/action_rows.h"

#include "lattice/vec.h"

#define KERNEL static inline __attribute__((always_inline))

/* What one vector of corners becomes. */
typedef struct outcome {
    vec_f potential;
    vec_u rgba;
    vec_m dirtied;
} outcome;

/* A dab's constants in every lane. */
typedef struct constants {
    float gain, part;       /* amount / 3, min(amount, 1) */
    float channel[4];       /* the tool's colour */
    float joint[3];         /* s, s + m, s + m + r of the deformation */
} constants;

KERNEL constants constants_of(const action_rows_dab *d)
{
    const action_setting *s = d->set;
    constants k = {.gain = s->amount / POTENTIAL_MAX, .part = s->amount < 1 ? s->amount : 1};
    for (int n = 0; n < 4; n++)
        k.channel[n] = (float)colour_channel(s->rgba, n);
    if (s->kind == ACTION_STAMP || s->kind == ACTION_PRINT) {
        k.joint[0] = (float)s->def->s;
        k.joint[1] = k.joint[0] + (float)s->def->m;
        k.joint[2] = k.joint[1] + (float)s->def->r;
    }
    return k;
}

/* ellipsoid_wyvill. */
KERNEL vec_f wyvill(vec_f x, vec_f y, vec_f z, vec_m *within)
{
    vec_f rho2 = x * x + y * y + z * z, q = 1 - rho2;
    *within = vec_gt(vec_all(1), rho2);
    return vec_pick(*within, q * q * (9 - 4 * rho2) * (POTENTIAL_MAX / 9), vec_all(POTENTIAL_MIN));
}

/* deform_at, all three pieces in every lane. */
KERNEL vec_f deform_of(const deform *def, const constants *k, vec_f v)
{
    vec_m later = vec_ge(v, vec_all(k->joint[0])), last = vec_ge(v, vec_all(k->joint[1]));
    vec_f u = v - vec_pick(last, vec_all(k->joint[1]), vec_pick(later, vec_all(k->joint[0]), vec_all(0)));
    u = vec_pick(vec_gt(u, vec_all(0)), u, vec_all(0));
    vec_f p[4];
    for (int n = 0; n < 4; n++)
        p[n] = vec_pick(last, vec_all(def->piece[2][n]),
                        vec_pick(later, vec_all(def->piece[1][n]), vec_all(def->piece[0][n])));
    return vec_pick(vec_ge(v, vec_all(k->joint[2])), vec_all(0), ((p[0] * u + p[1]) * u + p[2]) * u + p[3]);
}

/* colour_mix with colour_dither. */
KERNEL vec_u mix(const constants *k, vec_u from, vec_f weight, vec_u dither)
{
    vec_f threshold = vec_float_of((vec_i)(dither >> 16)) / COLOUR_WHOLE;
    vec_u out = {0};
    for (int n = 0; n < 4; n++) {
        vec_f a = vec_float_of((vec_i)(from >> (8 * n) & 255));
        out |= (vec_u)vec_int_of(a + (k->channel[n] - a) * weight + threshold) << (8 * n);
    }
    return out;
}

KERNEL outcome act(const action kind, const action_setting *s, const constants *k, vec_f v, vec_f f, vec_u rgba,
                   vec_u dither, const float *mean)
{
    const vec_f zero = vec_all(0);
    outcome o = {f, rgba, vec_gt(v, zero)};
    vec_f d = k->gain * v;
    switch (kind) {
    case ACTION_TOOTHPASTE:
        o.dirtied = vec_gt(d, zero);
        o.potential = f + d;
        o.rgba = vec_pick_u(vec_gt(f, zero), mix(k, rgba, d / (f + d), dither), vec_all_u(s->rgba));
        break;
    case ACTION_SOFT_ERASER:
        o.dirtied = vec_gt(d, zero);
        o.potential = f - d;
        break;
    case ACTION_ERASER: o.potential = zero; break;
    case ACTION_PAINTER: o.rgba = vec_all_u(s->rgba); break;
    case ACTION_SOFT_PAINTER:
        o.dirtied = vec_gt(d, zero);
        o.rgba = mix(k, rgba, d / (f + d), dither);
        break;
    case ACTION_SMOOTH: {
        vec_f to = f + k->part / POTENTIAL_MAX * v * (vec_load(mean) - f);
        o.dirtied = vec_gt(d, zero);
        o.potential = vec_pick(vec_gt(to, vec_all(POTENTIAL_FAINT)), to, zero);
        break;
    }
    case ACTION_STAMP:
    case ACTION_PRINT: {
        vec_f e = k->part * deform_of(s->def, k, POTENTIAL_MAX - v);
        /* Where the tool is not its potential is 0, and the deformation beyond all its pieces. */
        o.dirtied = vec_ne(vec_pick(o.dirtied, e, zero), zero);
        o.potential = f + (kind == ACTION_PRINT ? e * f : e);
        break;
    }
    }
    return o;
}

/* Replaces the bits of one vector's lanes. */
KERNEL void bits_put(uint64_t *slab, int n, unsigned bits)
{
    const uint64_t lanes_all = ((uint64_t)1 << VEC_LANES) - 1;
    *slab = (*slab & ~(lanes_all << n)) | (uint64_t)bits << n;
}

/* Writes what became of the corners from slot di * 64 + n on. */
KERNEL void settle(action_rows_brick *b, int di, int n, vec_f f, vec_u rgba, outcome o)
{
    const vec_f zero = vec_all(POTENTIAL_MIN), most = vec_all(POTENTIAL_MAX);
    vec_f to = vec_pick(vec_gt(o.potential, most), most, o.potential);
    to = vec_pick(vec_gt(to, zero), to, zero);
    to = vec_pick(o.dirtied, to, f);
    vec_m is = vec_gt(to, zero), was = vec_gt(f, zero);
    vec_store(b->page->potential + di * 64 + n, to);
    vec_store_u(b->page->rgba + di * 64 + n,
                vec_pick_u(is, vec_pick_u(o.dirtied, o.rgba, rgba), vec_all_u(COLOUR_NONE)));
    unsigned now = vec_bits(is), before = vec_bits(was);
    b->now.stored += (uint32_t)__builtin_popcount(now) - (uint32_t)__builtin_popcount(before);
    b->fresh.slab[di] |= (uint64_t)(now & ~before) << n;
    b->now.dirtied.slab[di] |= (uint64_t)vec_bits(o.dirtied) << n;
    b->now.moved.slab[di] |= (uint64_t)vec_bits(vec_ne(to, f)) << n;
    bits_put(&b->now.inside.slab[di], n, vec_bits(vec_ge(to, vec_all(POTENTIAL_ISO))));
}

/* The tool's potential on a slab, by the shape's own function. */
static void slab_evaluate(const action_rows_dab *d, const float at[3], float v_tool[64])
{
    float p[3][64];
    for (int a = 0; a < 3; a++)
        for (int n = 0; n < 64; n++)
            p[a][n] = at[a] + d->path->plane[a][n];
    d->form->evaluate(d->form->self, p[0], p[1], p[2], v_tool, 64);
}

KERNEL bool brick_act(const action kind, const bool is_wyvill, const action_rows_dab *d, action_rows_brick *b)
{
    const constants k = constants_of(d);
    const key first = key_of_brick(b->at);
    float start[3], v_tool[64];
    uint64_t any = 0;
    walk_start(d->path, b->at, start);
    for (int di = 0; di < BRICK_EDGE; di++) {
        float at[3];
        for (int a = 0; a < 3; a++)
            at[a] = start[a] + d->path->along[a][di];
        if (!is_wyvill)
            slab_evaluate(d, at, v_tool);
        const uint32_t dither = (uint32_t)(first.i + di) * COLOUR_STEP_I + (uint32_t)first.j * COLOUR_STEP_J +
                                (uint32_t)first.k * COLOUR_STEP_K;
        for (int n = 0; n < 64; n += VEC_LANES) {
            vec_m within;
            vec_f v;
            if (is_wyvill) {
                v = wyvill(at[0] + vec_load(d->path->plane[0] + n), at[1] + vec_load(d->path->plane[1] + n),
                           at[2] + vec_load(d->path->plane[2] + n), &within);
            } else {
                v = vec_load(v_tool + n);
                within = vec_gt(v, vec_all(0));
            }
            if (vec_bits(within) == 0)
                continue;
            vec_f f = vec_load(b->page->potential + di * 64 + n);
            vec_u rgba = vec_load_u(b->page->rgba + di * 64 + n);
            settle(b, di, n, f, rgba,
                   act(kind, d->set, &k, v, f, rgba, dither + vec_load_u(d->dither + n),
                       b->mean ? b->mean + di * 64 + n : NULL));
        }
        any |= b->now.dirtied.slab[di];
    }
    return any != 0;
}

bool LANES_NAMED(action_rows)(const action_rows_dab *d, action_rows_brick *b)
{
    /* One copy of the loop for each action, so that none is chosen inside it. */
#define ACTION_CASE(kind)                                                                                              \
    case kind: return d->form->wyvill ? brick_act(kind, true, d, b) : brick_act(kind, false, d, b)
    switch (d->set->kind) {
        ACTION_CASE(ACTION_TOOTHPASTE);
        ACTION_CASE(ACTION_SOFT_ERASER);
        ACTION_CASE(ACTION_ERASER);
        ACTION_CASE(ACTION_PAINTER);
        ACTION_CASE(ACTION_SOFT_PAINTER);
        ACTION_CASE(ACTION_SMOOTH);
        ACTION_CASE(ACTION_STAMP);
        ACTION_CASE(ACTION_PRINT);
    }
#undef ACTION_CASE
    return false;
}

/* --- the mean round a corner --- */

KERNEL float one_two_one(float a, float b, float c) { return ((a + c) + (b + b)) * 0.25f; }

/* Along k, then j, then i, in the order of additions that action.c's definition has. */
void LANES_NAMED(action_rows_mean)(const float *apron, float mean_out[BRICK_CORNERS])
{
    enum { SIDE = ACTION_APRON_SIDE };
    float along_k[SIDE][SIDE][8], along_j[SIDE][64];
    for (int row = 0; row < SIDE * SIDE; row++)
        for (int n = 0; n < 8; n++)
            along_k[row / SIDE][row % SIDE][n] =
                one_two_one(apron[row * SIDE + n], apron[row * SIDE + n + 1], apron[row * SIDE + n + 2]);
    for (int i = 0; i < SIDE; i++)
        for (int n = 0; n < 64; n++)
            along_j[i][n] = one_two_one(along_k[i][n >> 3][n & 7], along_k[i][(n >> 3) + 1][n & 7],
                                        along_k[i][(n >> 3) + 2][n & 7]);
    for (int i = 0; i < BRICK_EDGE; i++)
        for (int n = 0; n < 64; n++)
            mean_out[i * 64 + n] = one_two_one(along_j[i][n], along_j[i + 1][n], along_j[i + 2][n]);
}
