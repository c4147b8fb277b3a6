/* SPDX-License-Identifier: Apache-2.0 */
#include "surface/polygonizer.h"

void polygonizer_look(polygonizer *p, const clay *c, key brick_at, uint32_t brick_id)
{
    p->of = c;
    p->at = brick_at;
    p->brick_id = brick_id;
    for (int n = 0; n < 8; n++) {
        int di = n >> 2, dj = n >> 1 & 1, dk = n & 1;
        uint32_t id = brick_id != POOL_NONE ? clay_brick(c, brick_id)->neighbour[brick_neighbour_index(di, dj, dk)]
                      : n > 0               ? clay_find(c, key_add(brick_at, di, dj, dk))
                                            : POOL_NONE;
        p->above[n] = id == POOL_NONE ? NULL : clay_brick(c, id);
    }
}

/* Word s of the inside bits of a brick above. */
static uint64_t word_of(const polygonizer *p, int n, int s) { return p->above[n] ? p->above[n]->inside.slab[s] : 0; }

/* Bit dk of a row becomes that of corner dk + 1, the last one out of the brick above. */
static uint64_t next_k(uint64_t w, uint64_t above) { return (w >> 1 & ~BRICK_K_LAST) | (above & BRICK_K_FIRST) << 7; }

void polygonizer_crossing(const polygonizer *p, brick_mask *crossing_out)
{
    uint64_t any_below = 0, all_below = 0;
    for (int di = 0; di < PATCH_SIDE; di++) {
        int n = (di >> 3) * 4, s = di & 7;
        uint64_t w = word_of(p, n, s), wk = next_k(w, word_of(p, n + 1, s));
        uint64_t j = word_of(p, n + 2, s), jk = next_k(j, word_of(p, n + 3, s));
        uint64_t any = w | wk, all = w & wk;
        any |= any >> 8 | (j | jk) << 56;
        all &= all >> 8 | (j & jk) << 56;
        if (di > 0)
            crossing_out->slab[di - 1] = (any | any_below) & ~(all & all_below);
        any_below = any;
        all_below = all;
    }
}

uint32_t polygonizer_stored_cubes(const polygonizer *p)
{
    uint16_t stored[PATCH_SIDE][PATCH_SIDE] = {{0}};
    for (int n = 0; n < PATCH_SIDE * PATCH_SIDE * PATCH_SIDE; n++) {
        int di = n / (PATCH_SIDE * PATCH_SIDE), dj = n / PATCH_SIDE % PATCH_SIDE, dk = n % PATCH_SIDE;
        const brick *b = p->above[(di >> 3) * 4 + (dj >> 3) * 2 + (dk >> 3)];
        bool is = b && b->page->potential[(di & 7) << 6 | (dj & 7) << 3 | (dk & 7)] > POTENTIAL_MIN;
        stored[di][dj] = (uint16_t)(stored[di][dj] | is << dk);
    }
    uint32_t sum = 0;
    for (int di = 0; di < BRICK_EDGE; di++)
        for (int dj = 0; dj < BRICK_EDGE; dj++) {
            unsigned any = stored[di][dj] | stored[di][dj + 1] | stored[di + 1][dj] | stored[di + 1][dj + 1];
            sum += (uint32_t)__builtin_popcount((any | any >> 1) & 0xff);
        }
    return sum;
}
