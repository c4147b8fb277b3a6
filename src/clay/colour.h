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

#define COLOUR_WHOLE 16777216.0f /* 2^24: parts of a channel's step that mixing can tell apart */

/* Threshold in [0, 1) for rounding at corner `at` during dab number `dab`: a hash of those two and nothing else. A
   multiple of 2^-24. */
static inline float colour_dither(key at, uint64_t dab)
{
    uint32_t h = (uint32_t)at.i * 0x9E3779B1u ^ (uint32_t)at.j * 0x85EBCA77u ^ (uint32_t)at.k * 0xC2B2AE3Du;
    h ^= (uint32_t)dab * 0x27D4EB2Fu ^ (uint32_t)(dab >> 32) * 0x165667B1u;
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    h ^= h >> 12;
    h *= 0x297A2D39u;
    h ^= h >> 15;
    return (float)(h >> 8) / COLOUR_WHOLE;
}

/* from + weight (to - from) per channel, weight in [0, 1], rounded up with a chance equal to the fraction.
   weight 0 and 1 are exact; a channel never leaves the span between its two ends. In whole numbers: as floats, 255
   and a threshold just under one would round up to 256 and carry into the next channel. */
static inline uint32_t colour_mix(uint32_t from, uint32_t to, float weight, float dither)
{
    const int64_t w = (int64_t)(weight * COLOUR_WHOLE), threshold = (int64_t)(dither * COLOUR_WHOLE);
    uint32_t out = 0;
    for (int n = 0; n < 4; n++) {
        int64_t a = colour_channel(from, n), b = colour_channel(to, n);
        out |= (uint32_t)((a * (int64_t)COLOUR_WHOLE + (b - a) * w + threshold) >> 24) << (8 * n);
    }
    return out;
}

#ifdef __cplusplus
}
#endif
#endif
