/* SPDX-License-Identifier: Apache-2.0 */
#include "tool/action.h"

#include "clay/colour.h"
#include "clay/potential.h"

#include <assert.h>

const char *action_name(action a)
{
    static const char *const names[ACTION_COUNT] = {"toothpaste", "soft-eraser", "eraser", "painter",
                                                    "soft-painter", "smooth", "stamp", "print"};
    assert((int)a >= 0 && (int)a < ACTION_COUNT);
    return names[a];
}

bool action_reads_neighbours(action a) { return a == ACTION_SMOOTH || a == ACTION_STAMP; }

bool action_makes_clay(action a) { return a == ACTION_TOOTHPASTE || a == ACTION_SMOOTH || a == ACTION_STAMP; }

/* The part of the effect that one dab has: amounts above one would overshoot and ring. */
static float part(const action_setting *s) { return s->amount < 1 ? s->amount : 1; }

/* amount w */
static float contribution(const action_setting *s, float v_tool) { return s->amount / POTENTIAL_MAX * v_tool; }

bool action_contributes(const action_setting *s, float v_tool)
{
    if (!(v_tool > 0))
        return false;
    switch (s->kind) {
    case ACTION_ERASER:
    case ACTION_PAINTER: return true;
    case ACTION_STAMP:
    case ACTION_PRINT: return part(s) * deform_at(s->def, POTENTIAL_MAX - v_tool) != 0;
    default: return contribution(s, v_tool) != 0;
    }
}

/* --- one corner --- */

static void deposit(const action_setting *s, key at, float v_tool, float *potential, uint32_t *rgba)
{
    float f = *potential, d = contribution(s, v_tool), room = POTENTIAL_MAX - f;
    d = d < room ? d : room;
    if (!(d > 0))
        return;
    *rgba = f > POTENTIAL_MIN ? colour_mix(*rgba, s->rgba, d / (f + d), colour_dither(at, s->dab)) : s->rgba;
    *potential = f + d;
}

static void paint_softly(const action_setting *s, key at, float v_tool, float f, uint32_t *rgba)
{
    float d = contribution(s, v_tool);
    if (f > POTENTIAL_MIN && d > 0)
        *rgba = colour_mix(*rgba, s->rgba, d / (f + d), colour_dither(at, s->dab));
}

/* Binomial weights 1 2 1 on each axis; n counts the 27 places, k fastest. */
static float binomial(int n)
{
    static const float w[3] = {0.25f, 0.5f, 0.25f};
    return w[n / 9] * w[n / 3 % 3] * w[n % 3];
}

static int apron_step(int n)
{
    return ((n / 9 - 1) * ACTION_APRON_SIDE + n / 3 % 3 - 1) * ACTION_APRON_SIDE + n % 3 - 1;
}

static float one_two_one(float a, float b, float c) { return ((a + c) + (b + b)) * 0.25f; }

/* Axis by axis in this order of addition, a constant stays that constant to the bit and nothing leaves the span of
   the 27. */
static float low_pass(const float *apron)
{
    enum { J = ACTION_APRON_SIDE, I = J * J };
    float plane[3];
    for (int i = 0; i < 3; i++) {
        float line[3];
        for (int j = 0; j < 3; j++) {
            const float *p = apron + (i - 1) * I + (j - 1) * J;
            line[j] = one_two_one(p[-1], p[0], p[1]);
        }
        plane[i] = one_two_one(line[0], line[1], line[2]);
    }
    return one_two_one(plane[0], plane[1], plane[2]);
}

uint32_t action_colour_round(const action_setting *s, const float *apron, const uint32_t *apron_rgba)
{
    float weight = 0, channel[4] = {0, 0, 0, 0};
    for (int n = 0; n < 27; n++) {
        int step = apron_step(n);
        float w = binomial(n) * apron[step];
        weight += w;
        for (int c = 0; c < 4; c++)
            channel[c] += w * (float)colour_channel(apron_rgba[step], c);
    }
    if (!(weight > 0))
        return s->rgba;
    uint32_t rgba = 0;
    for (int c = 0; c < 4; c++) {
        float v = channel[c] / weight + 0.5f;
        rgba |= (uint32_t)(v > 255 ? 255 : v) << (8 * c);
    }
    return rgba;
}

static void smooth(const action_setting *s, float v_tool, const float *apron, const uint32_t *apron_rgba,
                   float *potential, uint32_t *rgba)
{
    float f = *potential;
    float to = f + part(s) / POTENTIAL_MAX * v_tool * (low_pass(apron) - f);
    *potential = to > POTENTIAL_FAINT ? to : POTENTIAL_MIN;
    if (!(f > POTENTIAL_MIN) && *potential > POTENTIAL_MIN)
        *rgba = action_colour_round(s, apron, apron_rgba);
}

static void stamp(const action_setting *s, float v_tool, const float *apron, const uint32_t *apron_rgba,
                  float *potential, uint32_t *rgba)
{
    float f = *potential;
    *potential = f + part(s) * deform_at(s->def, POTENTIAL_MAX - v_tool);
    if (!(f > POTENTIAL_MIN) && *potential > POTENTIAL_MIN)
        *rgba = action_colour_round(s, apron, apron_rgba);
}

void action_row(const action_setting *s, key first, unsigned mask, const float v_tool[8], const float *apron_potential,
                const uint32_t *apron_rgba, float potential[8], uint32_t rgba[8])
{
    assert(!action_reads_neighbours(s->kind) || (apron_potential && apron_rgba));
    for (int n = 0; n < 8; n++) {
        if (!(mask >> n & 1))
            continue;
        float v = v_tool[n];
        switch (s->kind) {
        case ACTION_TOOTHPASTE: deposit(s, key_add(first, 0, 0, n), v, &potential[n], &rgba[n]); break;
        case ACTION_SOFT_ERASER: potential[n] -= contribution(s, v); break;
        case ACTION_ERASER: potential[n] = POTENTIAL_MIN; break;
        case ACTION_PAINTER: rgba[n] = s->rgba; break;
        case ACTION_SOFT_PAINTER: paint_softly(s, key_add(first, 0, 0, n), v, potential[n], &rgba[n]); break;
        case ACTION_SMOOTH: smooth(s, v, apron_potential + n, apron_rgba + n, &potential[n], &rgba[n]); break;
        case ACTION_STAMP: stamp(s, v, apron_potential + n, apron_rgba + n, &potential[n], &rgba[n]); break;
        case ACTION_PRINT: potential[n] += part(s) * deform_at(s->def, POTENTIAL_MAX - v) * potential[n]; break;
        }
    }
}
