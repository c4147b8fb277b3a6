/* SPDX-License-Identifier: Apache-2.0 */
#include "clay/apron.h"

#include <string.h>

/* One row of the apron: corner -1, the eight of the middle brick, then one or two of the next. Potentials and colours
   are words of the same size. */
static inline void row_gather(const char *const page[3], size_t at, int hi, char *out)
{
    enum { WORD = 4, ROW = 8 * WORD };
    static const char empty[ROW];
    const char *a = page[0] ? page[0] + at : empty, *b = page[1] ? page[1] + at : empty,
               *d = page[2] ? page[2] + at : empty;
    memcpy(out, a + 7 * WORD, WORD);
    memcpy(out + WORD, b, ROW);
    memcpy(out + WORD + ROW, d, WORD);
    if (hi == APRON_HI_MAX)
        memcpy(out + 2 * WORD + ROW, d + WORD, WORD);
}

/* offset: of the words in a page. */
static void words_gather(const clay *c, const uint32_t neighbours[BRICK_NEIGHBOURS], int hi, apron_rows rows,
                         size_t offset, char *out)
{
    const char *page[BRICK_NEIGHBOURS];
    for (int n = 0; n < BRICK_NEIGHBOURS; n++)
        page[n] = neighbours[n] == POOL_NONE ? NULL : (const char *)clay_brick(c, neighbours[n])->page + offset;
    const size_t side = (size_t)(hi - APRON_LO + 1);
    for (int di = rows.from_i; di <= rows.to_i; di++)
        for (int dj = rows.from_j; dj <= rows.to_j; dj++)
            /* >> 3 of -1, 0..7, 8..9 is -1, 0, 1: which neighbour the row lies in. */
            row_gather(&page[brick_neighbour_index(di >> 3, dj >> 3, -1)],
                       (size_t)((di & 7) << 6 | (dj & 7) << 3) * 4, hi,
                       out + ((size_t)(di - APRON_LO) * side + (size_t)(dj - APRON_LO)) * side * 4);
}

void apron_gather_rows(const clay *c, const uint32_t neighbours[BRICK_NEIGHBOURS], int hi, apron_rows rows,
                       float *potential)
{
    assert(hi >= 8 && hi <= APRON_HI_MAX && rows.from_i >= APRON_LO && rows.from_j >= APRON_LO && rows.to_i <= hi &&
           rows.to_j <= hi);
    words_gather(c, neighbours, hi, rows, offsetof(brick_page, potential), (char *)potential);
}

void apron_gather(const clay *c, const uint32_t neighbours[BRICK_NEIGHBOURS], int hi, float *potential, uint32_t *rgba)
{
    assert(hi >= 8 && hi <= APRON_HI_MAX);
    const apron_rows all = {APRON_LO, (int8_t)hi, APRON_LO, (int8_t)hi};
    if (potential)
        words_gather(c, neighbours, hi, all, offsetof(brick_page, potential), (char *)potential);
    if (rgba)
        words_gather(c, neighbours, hi, all, offsetof(brick_page, rgba), (char *)rgba);
}
