/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    colour_mix on VEC_LANES colours at once, bit by bit the same. For *_rows.c files.
 * Is not:  The definition (colour.h).
 * Errors:  None.
 */
#ifndef GLAISE_CLAY_COLOUR_ROWS_H
#define GLAISE_CLAY_COLOUR_ROWS_H

#include "clay/colour.h"
#include "lattice/vec.h"

VEC_INLINE void colour_rows_channels(vec_u rgba, vec_f channel_out[4])
{
    for (int n = 0; n < 4; n++)
        channel_out[n] = vec_float_of((vec_i)(rgba >> (8 * n) & 255));
}

/* to: its four channels. */
VEC_INLINE vec_u colour_rows_mix(vec_u from, const vec_f to[4], vec_f weight, vec_f threshold)
{
    vec_f a[4];
    vec_u out = {0};
    colour_rows_channels(from, a);
    for (int n = 0; n < 4; n++)
        out |= (vec_u)vec_int_of(a[n] + (to[n] - a[n]) * weight + threshold) << (8 * n);
    return out;
}

#endif
