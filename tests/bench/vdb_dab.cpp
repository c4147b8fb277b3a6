/* SPDX-License-Identifier: Apache-2.0 */
#include "vdb_dab.h"

#include "bench_rig.h"
#include "clay/colour.h"
#include "clay/potential.h"

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstring>
#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace {

int32_t floored(double x) { return static_cast<int32_t>(std::floor(x)); }

double bound(const vdb_dab &d, int a)
{
    double size = 1;
    for (int c = 0; c < 3; c++)
        size += 8 * std::fabs(d.row[a][c]);
    return 4 * static_cast<double>(FLT_EPSILON) * size;
}

void to_tool(const vdb_dab &d, double i, double j, double k, double out[3])
{
    const double from[3] = {i - d.origin[0], j - d.origin[1], k - d.origin[2]};
    for (int a = 0; a < 3; a++)
        out[a] = d.row[a][0] * from[0] + d.row[a][1] * from[1] + d.row[a][2] * from[2];
}

/* A row of eight corners in vector registers (gcc and clang alike). */
typedef float row_f __attribute__((vector_size(32)));
typedef int32_t row_i __attribute__((vector_size(32)));
typedef uint32_t row_u __attribute__((vector_size(32)));

constexpr row_i counting = {0, 1, 2, 3, 4, 5, 6, 7};

template <class row, class value> row loaded(const value *from)
{
    row r;
    std::memcpy(&r, from, sizeof r);
    return r;
}
template <class row, class value> void store(value *to, row r) { std::memcpy(to, &r, sizeof r); }

template <class row> row chosen(row_i mask, row yes, row no)
{
    return (row)(((row_i)yes & mask) | ((row_i)no & ~mask));
}

/* A bit for every lane that is all ones. */
unsigned bits_of(row_i mask)
{
#if defined(__AVX__)
    return static_cast<unsigned>(_mm256_movemask_ps((__m256)mask));
#else
    unsigned out = 0;
    for (int n = 0; n < 8; n++)
        out |= static_cast<unsigned>(mask[n] & 1) << n;
    return out;
#endif
}

/* Eight colours at once, as colour_mix has it. */
row_u mix_row(const vdb_dab &d, key first, row_f f, row_f by, row_u rgba)
{
    const row_f weight = by / (f + by);
    const row_u h = (row_u)(counting + first.k) * COLOUR_STEP_K + (static_cast<uint32_t>(first.i) * COLOUR_STEP_I +
                    static_cast<uint32_t>(first.j) * COLOUR_STEP_J + static_cast<uint32_t>(d.number) * COLOUR_STEP_DAB);
    const row_f threshold = __builtin_convertvector((row_i)(h >> 16), row_f) / COLOUR_WHOLE;
    row_u mixed = {};
    for (int c = 0; c < 4; c++) {
        const row_f from = __builtin_convertvector((row_i)(rgba >> (8 * c) & 255), row_f);
        const float to = static_cast<float>(d.rgba >> (8 * c) & 255);
        mixed |= (row_u)__builtin_convertvector(from + (to - from) * weight + threshold, row_i) << (8 * c);
    }
    return chosen<row_u>(f > POTENTIAL_MIN, mixed, row_u{} + d.rgba);
}

void put_row(int row, row_f f, row_u colour, float *potential, uint32_t *rgba, vdb_dab_change *change_out)
{
    const row_f old = loaded<row_f>(potential + row * 8), most = row_f{} + POTENTIAL_MAX;
    const row_u old_colour = loaded<row_u>(rgba + row * 8);
    const row_f clamped = chosen<row_f>(f > most, most, chosen<row_f>(f > POTENTIAL_MIN, f, row_f{}));
    const row_u kept = (row_u)((row_i)colour & (f > POTENTIAL_MIN));
    const unsigned differs = bits_of((clamped != old) | (kept != old_colour));
    store(potential + row * 8, clamped);
    store(rgba + row * 8, kept);
    change_out->corners += std::popcount(differs);
    change_out->slab[row >> 3] |= static_cast<uint64_t>(differs) << ((row & 7) * 8);
}

row_f one_two_one(row_f a, row_f b, row_f c) { return ((a + c) + (b + b)) * 0.25f; }

/* Axis by axis, k first: the order in which ours adds. */
void low_pass(const float *apron, float out[vdb_dab_corners])
{
    constexpr int side = vdb_dab_apron_side;
    row_f line[side * side], plane[side * 8];
    for (int r = 0; r < side * side; r++) {
        const float *p = apron + r * side;
        line[r] = one_two_one(loaded<row_f>(p), loaded<row_f>(p + 1), loaded<row_f>(p + 2));
    }
    for (int i = 0; i < side; i++)
        for (int j = 0; j < 8; j++)
            plane[i * 8 + j] =
                one_two_one(line[i * side + j], line[i * side + j + 1], line[i * side + j + 2]);
    for (int r = 0; r < 64; r++)
        store(out + r * 8, one_two_one(plane[r], plane[r + 8], plane[r + 16]));
}

/* Mean colour round an apron's corner, by clay. */
uint32_t colour_round(const vdb_dab_apron &near, int at, uint32_t none)
{
    static const float third[3] = {0.25f, 0.5f, 0.25f};
    constexpr int side = vdb_dab_apron_side;
    float weight = 0, channel[4] = {0, 0, 0, 0};
    for (int n = 0; n < 27; n++) {
        const int place = at + ((n / 9 - 1) * side + n / 3 % 3 - 1) * side + n % 3 - 1;
        const float w = third[n / 9] * third[n / 3 % 3] * third[n % 3] * near.potential[place];
        weight += w;
        for (int c = 0; c < 4; c++)
            channel[c] += w * static_cast<float>(colour_channel(near.rgba[place], c));
    }
    if (!(weight > 0))
        return none;
    uint32_t rgba = 0;
    for (int c = 0; c < 4; c++)
        rgba |= static_cast<uint32_t>(std::min(channel[c] / weight + 0.5f, 255.0f)) << (8 * c);
    return rgba;
}

} // namespace

vdb_dab vdb_dab_of(const bench_object_dab &of, uint64_t number)
{
    vdb_dab d = {};
    d.kind = of.kind;
    d.rgba = of.rgba;
    d.amount = static_cast<float>(of.dab.amount);
    d.number = number;
    bench_rig_demand(frame_invert(&of.dab.at, d.row) == STATUS_OK, "a tool without volume");
    int32_t lo[3], hi[3];
    for (int c = 0; c < 3; c++) {
        d.origin[c] = of.dab.at.origin[c];
        double extent = 0;
        for (int a = 0; a < 3; a++)
            extent += std::fabs(of.dab.at.axis[a][c]);
        lo[c] = floored(d.origin[c] - extent);
        hi[c] = floored(d.origin[c] + extent);
    }
    for (int a = 0; a < 3; a++) {
        for (int n = 0; n < 8; n++)
            d.along[a][n] = static_cast<float>(d.row[a][0] * n);
        for (int n = 0; n < 64; n++)
            d.plane[a][n] = static_cast<float>(d.row[a][1] * (n >> 3) + d.row[a][2] * (n & 7));
    }
    d.corners = {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
    return d;
}

bool vdb_dab_touches(const vdb_dab &d, key leaf)
{
    const key first = key_of_brick(leaf);
    double middle[3];
    to_tool(d, first.i + 3.5, first.j + 3.5, first.k + 3.5, middle);
    for (int a = 0; a < 3; a++) {
        const double extent =
            3.5 * (std::fabs(d.row[a][0]) + std::fabs(d.row[a][1]) + std::fabs(d.row[a][2])) + bound(d, a);
        if (middle[a] - extent > 1 || middle[a] + extent < -1)
            return false;
    }
    return true;
}

int vdb_dab_evaluate(const vdb_dab &d, key leaf, float potential_out[vdb_dab_corners])
{
    const key first = key_of_brick(leaf);
    double p[3];
    to_tool(d, first.i, first.j, first.k, p);
    const float start[3] = {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
    const row_i k = counting + first.k, k_in = (k >= d.corners.min.k) & (k <= d.corners.max.k);
    const float gain = d.amount / POTENTIAL_MAX;
    row_i hits = {};
    for (int row = 0; row < 64; row++) {
        const int i = first.i + (row >> 3), j = first.j + (row & 7);
        row_f rho2 = {};
        for (int a = 0; a < 3; a++) {
            const row_f x = (start[a] + d.along[a][row >> 3]) + loaded<row_f>(d.plane[a] + (row & 7) * 8);
            rho2 = a == 0 ? x * x : rho2 + x * x;
        }
        const row_f q = 1 - rho2, wyvill = q * q * (9 - 4 * rho2) * (POTENTIAL_MAX / 9);
        const bool in = i >= d.corners.min.i && i <= d.corners.max.i && j >= d.corners.min.j && j <= d.corners.max.j;
        const row_i hit = (rho2 < 1) & (gain * wyvill > 0) & k_in & (row_i{} - in);
        store(potential_out + row * 8, (row_f)((row_i)wyvill & hit));
        hits -= hit;
    }
    int sum = 0;
    for (int n = 0; n < 8; n++)
        sum += hits[n];
    return sum;
}

uint64_t vdb_dab_at_least(const float *slab, float least)
{
    uint64_t out = 0;
    for (int row = 0; row < 8; row++)
        out |= static_cast<uint64_t>(bits_of(loaded<row_f>(slab + row * 8) >= least)) << (8 * row);
    return out;
}

vdb_dab_change vdb_dab_act(const vdb_dab &d, key leaf, const float *v_tool, float *potential, uint32_t *rgba)
{
    const key first = key_of_brick(leaf);
    vdb_dab_change differs;
    for (int row = 0; row < 64; row++) {
        const row_f f = loaded<row_f>(potential + row * 8), room = POTENTIAL_MAX - f;
        row_f by = d.amount / POTENTIAL_MAX * loaded<row_f>(v_tool + row * 8);
        if (d.kind == ACTION_TOOTHPASTE)
            by = chosen<row_f>(by < room, by, room);
        const row_i hit = by > 0;
        if (bits_of(hit) == 0)
            continue;
        row_u colour = loaded<row_u>(rgba + row * 8);
        if (d.kind == ACTION_TOOTHPASTE) {
            colour = chosen<row_u>(hit, mix_row(d, key_add(first, row >> 3, row & 7, 0), f, by, colour), colour);
            put_row(row, f + by, colour, potential, rgba, &differs);
        } else {
            put_row(row, f - by, colour, potential, rgba, &differs);
        }
    }
    return differs;
}

bool vdb_dab_smooth(const vdb_dab &d, const float *v_tool, const vdb_dab_apron &near, bool has_rgba, float *potential,
                    uint32_t *rgba, vdb_dab_change *change_out)
{
    const float part = d.amount < 1 ? d.amount : 1;
    float made[vdb_dab_corners];
    row_i comes_to_be = {};
    low_pass(near.potential, made);
    for (int row = 0; row < 64; row++) {
        const row_f v = loaded<row_f>(v_tool + row * 8), f = loaded<row_f>(potential + row * 8);
        const row_f to = f + part / POTENTIAL_MAX * v * (loaded<row_f>(made + row * 8) - f);
        const row_f kept = chosen<row_f>(v > 0, chosen<row_f>(to > POTENTIAL_FAINT, to, row_f{}), f);
        comes_to_be |= (f <= POTENTIAL_MIN) & (kept > POTENTIAL_MIN);
        store(made + row * 8, kept);
    }
    const bool mends = bits_of(comes_to_be) != 0;
    if (mends && !has_rgba)
        return true;
    *change_out = {};
    for (int row = 0; row < 64; row++) {
        uint32_t colour[8];
        std::memcpy(colour, rgba + row * 8, sizeof colour);
        for (int n = 0; mends && n < 8; n++) {
            const int at = row * 8 + n;
            if (!(potential[at] > POTENTIAL_MIN) && made[at] > POTENTIAL_MIN)
                colour[n] = colour_round(near, (((at >> 6) + 1) * 10 + (at >> 3 & 7) + 1) * 10 + (at & 7) + 1, d.rgba);
        }
        put_row(row, loaded<row_f>(made + row * 8), loaded<row_u>(colour), potential, rgba, change_out);
    }
    return false;
}
