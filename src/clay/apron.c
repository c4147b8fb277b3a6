/* SPDX-License-Identifier: Apache-2.0 */
#include "clay/apron.h"

#include "clay/colour.h"

#include <string.h>

/* One row of the apron: corner -1, the eight of the middle brick, then one or two of the next. */
static void row_potential(const clay *c, const uint32_t *ids, int slot, int hi, float *out)
{
    const float *a = ids[0] == POOL_NONE ? NULL : clay_brick(c, ids[0])->page->potential + slot;
    const float *b = ids[1] == POOL_NONE ? NULL : clay_brick(c, ids[1])->page->potential + slot;
    const float *d = ids[2] == POOL_NONE ? NULL : clay_brick(c, ids[2])->page->potential + slot;
    out[0] = a ? a[7] : POTENTIAL_MIN;
    for (int n = 0; n < 8; n++)
        out[1 + n] = b ? b[n] : POTENTIAL_MIN;
    for (int n = 8; n <= hi; n++)
        out[1 + n] = d ? d[n - 8] : POTENTIAL_MIN;
}

static void row_rgba(const clay *c, const uint32_t *ids, int slot, int hi, uint32_t *out)
{
    const uint32_t *a = ids[0] == POOL_NONE ? NULL : clay_brick(c, ids[0])->page->rgba + slot;
    const uint32_t *b = ids[1] == POOL_NONE ? NULL : clay_brick(c, ids[1])->page->rgba + slot;
    const uint32_t *d = ids[2] == POOL_NONE ? NULL : clay_brick(c, ids[2])->page->rgba + slot;
    out[0] = a ? a[7] : COLOUR_NONE;
    for (int n = 0; n < 8; n++)
        out[1 + n] = b ? b[n] : COLOUR_NONE;
    for (int n = 8; n <= hi; n++)
        out[1 + n] = d ? d[n - 8] : COLOUR_NONE;
}

void apron_gather(const clay *c, const uint32_t neighbours[BRICK_NEIGHBOURS], int hi, float *potential, uint32_t *rgba)
{
    assert(hi >= 8 && hi <= APRON_HI_MAX);
    int side = hi - APRON_LO + 1;
    for (int di = APRON_LO; di <= hi; di++)
        for (int dj = APRON_LO; dj <= hi; dj++) {
            /* >> 3 of -1, 0..7, 8..9 is -1, 0, 1: which neighbour the row lies in. */
            const uint32_t *ids = &neighbours[brick_neighbour_index(di >> 3, dj >> 3, -1)];
            int slot = (di & 7) << 6 | (dj & 7) << 3;
            size_t at = ((size_t)(di - APRON_LO) * (size_t)side + (size_t)(dj - APRON_LO)) * (size_t)side;
            row_potential(c, ids, slot, hi, potential + at);
            if (rgba)
                row_rgba(c, ids, slot, hi, rgba + at);
        }
}
