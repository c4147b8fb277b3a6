/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    RGBA8 colours: packing, and mixing that neither stalls nor depends on the machine.
 * Is not:  Light (the view works in linear sRGB); gradients of colour (reconstruct.h).
 * Shape:   uint32 with red in the lowest byte, so that little-endian memory reads R, G, B, A. A corner that is not
 *          stored has COLOUR_NONE, and that colour never takes part in a mix.
 * Cost:    a mix is a few dozen instructions, no branch on the data.
 * Source:  000 section 4.2 for what is mixed; the dither is ours: with 8 bits a weak soft stroke would round back to
 *          the colour it started from and never arrive.
 */
#ifndef GLAISE_CLAY_COLOUR_H
#define GLAISE_CLAY_COLOUR_H

#include "lattice/key.h"

#ifdef __cplusplus
extern "C" {
#endif

#define COLOUR_NONE 0u

static inline uint32_t colour_pack(unsigned r, unsigned g, unsigned b, unsigned a)
{
    return r | g << 8 | b << 16 | a << 24;
}
static inline unsigned colour_channel(uint32_t rgba, int n) { return rgba >> (8 * n) & 255u; }

/* The dither's steps along i, j, k and from dab to dab: powers of 1/1.16730..., the root of x^5 = x + 1, as parts of
   2^32. Points of this sequence lie as evenly as points can, over the corners of one dab and over the dabs on one
   corner. */
#define COLOUR_STEP_I 0xDB4F0B91u
#define COLOUR_STEP_J 0xBBE05633u
#define COLOUR_STEP_K 0xA0F2EC77u
#define COLOUR_STEP_DAB 0x89E18285u
#define COLOUR_WHOLE 65536.0f /* thresholds are multiples of 2^-16: with 255 they still fit a float */

/* Threshold in [0, 1) for rounding at corner `at` during dab number `dab`. */
static inline float colour_dither(key at, uint64_t dab)
{
    uint32_t h = (uint32_t)at.i * COLOUR_STEP_I + (uint32_t)at.j * COLOUR_STEP_J + (uint32_t)at.k * COLOUR_STEP_K +
                 (uint32_t)dab * COLOUR_STEP_DAB;
    return (float)(h >> 16) / COLOUR_WHOLE;
}

/* from + weight (to - from) per channel, weight in [0, 1], rounded up with a chance equal to the fraction.
   weight 0 and 1 are exact; a channel never leaves the span between its two ends: every step rounds monotonously. */
static inline uint32_t colour_mix(uint32_t from, uint32_t to, float weight, float dither)
{
    uint32_t out = 0;
    for (int n = 0; n < 4; n++) {
        float a = (float)colour_channel(from, n), b = (float)colour_channel(to, n);
        out |= (uint32_t)(a + (b - a) * weight + dither) << (8 * n);
    }
    return out;
}

#ifdef __cplusplus
}
#endif
#endif
