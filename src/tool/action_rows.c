/* SPDX-License-Identifier: Apache-2.0 */
#include "tool/action_rows.h"

#include "clay/colour_rows.h"

/* What one vector of corners becomes. */
typedef struct outcome {
    vec_f potential;
    vec_u rgba;
    vec_m dirtied;
} outcome;

/* A dab's constants in every lane. */
typedef struct constants {
    float gain, part;       /* amount / 3, min(amount, 1) */
    vec_f channel[4];       /* the tool's colour */
    float joint[3];         /* s, s + m, s + m + r of the deformation */
} constants;

VEC_INLINE constants constants_of(const action_rows_dab *d)
{
    const action_setting *s = d->set;
    constants k = {.gain = s->amount / POTENTIAL_MAX, .part = s->amount < 1 ? s->amount : 1};
    for (int n = 0; n < 4; n++)
        k.channel[n] = vec_all((float)colour_channel(s->rgba, n));
    if (s->kind == ACTION_STAMP || s->kind == ACTION_PRINT) {
        k.joint[0] = (float)s->def->s;
        k.joint[1] = k.joint[0] + (float)s->def->m;
        k.joint[2] = k.joint[1] + (float)s->def->r;
    }
    return k;
}

/* ellipsoid_wyvill. */
VEC_INLINE vec_f wyvill(vec_f x, vec_f y, vec_f z, vec_m *within)
{
    vec_f rho2 = x * x + y * y + z * z, q = 1 - rho2;
    *within = vec_gt(vec_all(1), rho2);
    return vec_pick(*within, q * q * (9 - 4 * rho2) * (POTENTIAL_MAX / 9), vec_all(POTENTIAL_MIN));
}

/* deform_at, all three pieces in every lane. */
VEC_INLINE vec_f deform_of(const deform *def, const constants *k, vec_f v)
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

/* colour_mix with the tool's colour and colour_dither. */
VEC_INLINE vec_u mix(const constants *k, vec_u from, vec_f weight, vec_u dither)
{
    return colour_rows_mix(from, k->channel, weight, vec_float_of((vec_i)(dither >> 16)) / COLOUR_WHOLE);
}

VEC_INLINE outcome act(const action kind, const action_setting *s, const constants *k, vec_f v, vec_f f, vec_u rgba,
                   vec_u dither, const float *mean)
{
    const vec_f zero = vec_all(0);
    outcome o = {f, rgba, vec_gt(v, zero)};
    vec_f d = k->gain * v;
    switch (kind) {
    case ACTION_TOOTHPASTE:
        o.dirtied = vec_gt(d, zero);
        d = vec_least(d, POTENTIAL_MAX - f);
        o.potential = f + d;
        o.rgba = rgba;
        if (vec_bits(vec_gt(d, zero)) != 0) /* not all are full */
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

/* What comes of a slab, gathered in words. */
typedef struct slab_words {
    uint64_t reached; /* by the tool: of the others nothing was looked at */
    uint64_t was, is; /* clay, before and now, where reached */
    uint64_t inside, dirtied, moved;
} slab_words;

/* Writes what became of some corners. */
VEC_INLINE void settle(const action kind, float *potential, uint32_t *rgba_at, int n, vec_f f, vec_u rgba, outcome o,
                   slab_words *w)
{
    const vec_f zero = vec_all(POTENTIAL_MIN);
    const bool moves = kind != ACTION_PAINTER && kind != ACTION_SOFT_PAINTER, adds = kind == ACTION_TOOTHPASTE;
    vec_f to = vec_pick(o.dirtied, vec_most(vec_least(o.potential, vec_all(POTENTIAL_MAX)), zero), f);
    vec_m is = vec_gt(to, zero);
    vec_u coloured = vec_pick_u(o.dirtied, o.rgba, rgba);
    if (moves)
        vec_store(potential, to);
    vec_store_u(rgba_at, adds ? coloured : vec_pick_u(is, coloured, vec_all_u(COLOUR_NONE)));
    w->reached |= (((uint64_t)1 << VEC_LANES) - 1) << n;
    w->was |= (uint64_t)vec_bits(vec_gt(f, zero)) << n;
    w->is |= (uint64_t)vec_bits(is) << n;
    w->inside |= (uint64_t)vec_bits(vec_ge(to, vec_all(POTENTIAL_ISO))) << n;
    w->dirtied |= (uint64_t)vec_bits(o.dirtied) << n;
    w->moved |= (uint64_t)(moves ? vec_bits(vec_ne(to, f)) : 0) << n;
}

VEC_INLINE void slab_settle(action_rows_brick *b, int di, const slab_words *w)
{
    b->now.stored += (uint32_t)__builtin_popcountll(w->is) - (uint32_t)__builtin_popcountll(w->was);
    b->now.inside.slab[di] = (b->now.inside.slab[di] & ~w->reached) | w->inside;
    b->now.dirtied.slab[di] = w->dirtied;
    b->now.moved.slab[di] = w->moved;
    b->fresh.slab[di] = w->is & ~w->was;
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

/* May the slab that begins at this point reach into the unit ball? Never false wrongly. */
VEC_INLINE bool is_near_ball(const walk *w, const float at[3])
{
    float squared = 0;
    for (int a = 0; a < 3; a++) {
        float middle = at[a] + w->slab_middle[a], gap = (middle < 0 ? -middle : middle) - w->slab_reach[a];
        squared += gap > 0 ? gap * gap : 0;
    }
    return squared <= 1.001f;
}

VEC_INLINE bool brick_act(const action kind, const bool is_wyvill, const action_rows_dab *d, action_rows_brick *b)
{
    const constants k = constants_of(d);
    const key first = key_of_brick(b->at);
    float start[3], v_tool[64];
    float *potential = b->page->potential;
    uint32_t *rgba_at = b->page->rgba;
    const float *const x = d->path->plane[0], *const y = d->path->plane[1], *const z = d->path->plane[2];
    uint64_t any = 0;
    walk_start(d->path, b->at, start);
    for (int di = 0; di < BRICK_EDGE; di++, potential += 64, rgba_at += 64) {
        slab_words words = {0};
        float at[3];
        for (int a = 0; a < 3; a++)
            at[a] = start[a] + d->path->along[a][di];
        if (is_wyvill && !is_near_ball(d->path, at)) {
            slab_settle(b, di, &words);
            continue;
        }
        if (!is_wyvill)
            slab_evaluate(d, at, v_tool);
        const uint32_t dither = (uint32_t)(first.i + di) * COLOUR_STEP_I + (uint32_t)first.j * COLOUR_STEP_J +
                                (uint32_t)first.k * COLOUR_STEP_K;
        for (int n = 0; n < 64; n += VEC_LANES) {
            vec_m within;
            vec_f v;
            if (is_wyvill) {
                v = wyvill(at[0] + vec_load(x + n), at[1] + vec_load(y + n), at[2] + vec_load(z + n), &within);
            } else {
                v = vec_load(v_tool + n);
                within = vec_gt(v, vec_all(0));
            }
            if (vec_bits(within) == 0)
                continue;
            vec_f f = vec_load(potential + n);
            vec_u rgba = vec_load_u(rgba_at + n);
            settle(kind, potential + n, rgba_at + n, n, f, rgba,
                   act(kind, d->set, &k, v, f, rgba, dither + vec_load_u(d->dither + n),
                       kind == ACTION_SMOOTH ? b->mean + di * 64 + n : NULL),
                   &words);
        }
        slab_settle(b, di, &words);
        any |= words.dirtied;
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

/* A row of a brick, or half of one where vectors are no longer. */
enum { PIECE = VEC_LANES < 8 ? VEC_LANES : 8 };
typedef float piece __attribute__((vector_size(PIECE * 4)));

VEC_INLINE piece piece_load(const float *p)
{
    piece v;
    memcpy(&v, p, sizeof v);
    return v;
}

VEC_INLINE piece one_two_one(piece before, piece at, piece after) { return ((before + after) + (at + at)) * 0.25f; }

/* Along k, then j: part of the eight rows of one plane of the apron, from its first row on. */
VEC_INLINE void plane_mean(const float *apron, float *mean_out)
{
    piece along_k[ACTION_APRON_SIDE];
    for (int j = 0; j < ACTION_APRON_SIDE; j++, apron += ACTION_APRON_SIDE)
        along_k[j] = one_two_one(piece_load(apron), piece_load(apron + 1), piece_load(apron + 2));
    for (int j = 0; j < BRICK_EDGE; j++) {
        const piece mean = one_two_one(along_k[j], along_k[j + 1], along_k[j + 2]);
        memcpy(mean_out + (size_t)j * 8, &mean, sizeof mean);
    }
}

/* Along k, then j, then i, in the order of additions that action.c's definition has. */
void LANES_NAMED(action_rows_mean)(const float *apron, float mean_out[BRICK_CORNERS])
{
    enum { SIDE = ACTION_APRON_SIDE, PLANE = SIDE * SIDE };
    float plane[SIDE][64];
    for (int i = 0; i < SIDE; i++)
        for (int k = 0; k < BRICK_EDGE; k += PIECE)
            plane_mean(apron + (size_t)i * PLANE + k, plane[i] + k);
    for (int i = 0; i < BRICK_EDGE; i++)
        for (int n = 0; n < 64; n += VEC_LANES) {
            const vec_f a = vec_load(plane[i] + n), b = vec_load(plane[i + 1] + n), c = vec_load(plane[i + 2] + n);
            vec_store(mean_out + i * 64 + n, ((a + c) + (b + b)) * 0.25f);
        }
}
