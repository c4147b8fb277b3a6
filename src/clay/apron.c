/* SPDX-License-Identifier: Apache-2.0 */
#include "clay/apron.h"

#include <string.h>

enum { WORD = 4, ROW = 8 * WORD };

/* Where the words of a page begin that is not stored: nothing is read beyond a row, since its stride is 0. */
static const char empty_row[ROW];

/* The rows from..to an axis that lie in one column of three bricks. Potentials and colours are words of the same
   size. */
static void block_gather(const char *const page[3], apron_rows rows, int hi, char *out)
{
    const size_t side = (size_t)(hi - APRON_LO + 1);
    const char *a = page[0] ? page[0] : empty_row, *b = page[1] ? page[1] : empty_row;
    const char *d = page[2] ? page[2] : empty_row;
    const size_t a_step = page[0] ? ROW : 0, b_step = page[1] ? ROW : 0, d_step = page[2] ? ROW : 0;
    const bool is_wide = hi == APRON_HI_MAX;
    for (int di = rows.from_i; di <= rows.to_i; di++) {
        const size_t row = (size_t)((di & 7) << 3 | (rows.from_j & 7));
        const char *at_a = a + row * a_step + 7 * WORD, *at_b = b + row * b_step, *at_d = d + row * d_step;
        char *to = out + ((size_t)(di - APRON_LO) * side + (size_t)(rows.from_j - APRON_LO)) * side * WORD;
        for (int dj = rows.from_j; dj <= rows.to_j; dj++) {
            memcpy(to, at_a, WORD);
            memcpy(to + WORD, at_b, ROW);
            memcpy(to + WORD + ROW, at_d, WORD);
            if (is_wide)
                memcpy(to + 2 * WORD + ROW, at_d + WORD, WORD);
            at_a += a_step;
            at_b += b_step;
            at_d += d_step;
            to += side * WORD;
        }
    }
}

static int8_t least(int a, int b) { return (int8_t)(a < b ? a : b); }
static int8_t most(int a, int b) { return (int8_t)(a > b ? a : b); }

/* offset: of the words in a page. */
static void words_gather(const clay *c, const uint32_t neighbours[BRICK_NEIGHBOURS], int hi, apron_rows rows,
                         size_t offset, char *out)
{
    /* Corner -1 lies in the brick below, 0..7 in the middle one, 8 and 9 in the one above. */
    for (int i = -1; i <= 1; i++)
        for (int j = -1; j <= 1; j++) {
            const apron_rows part = {most(rows.from_i, 8 * i), least(rows.to_i, 8 * i + 7), most(rows.from_j, 8 * j),
                                     least(rows.to_j, 8 * j + 7)};
            if (part.from_i > part.to_i || part.from_j > part.to_j)
                continue;
            const uint32_t *id = &neighbours[brick_neighbour_index(i, j, -1)];
            const char *page[3];
            for (int n = 0; n < 3; n++)
                page[n] = id[n] == POOL_NONE ? NULL : (const char *)clay_brick(c, id[n])->page + offset;
            block_gather(page, part, hi, out);
        }
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
