/* SPDX-License-Identifier: Apache-2.0 */
#include "surface/polygonizer.h"

#include <string.h>

void polygonizer_cases_init(polygonizer_cases *p)
{
    case_table t;
    case_table_init(&t);
    memset(p, 0, sizeof *p);
    memcpy(p->triangles, t.triangles, sizeof p->triangles);
    for (int index = 0; index < CASE_TABLE_CASES; index++)
        for (int n = 0; n < 3 * t.triangles[index]; n++) {
            int c, to;
            case_table_edge(t.edge[index][n], &c, &to);
            int slot = ((c & 1) * PATCH_SIDE + (c >> 1 & 1)) * PATCH_SIDE + (c >> 2);
            p->name[index][n] = (uint16_t)(slot * 3 + t.edge[index][n] / 4);
        }
}

void polygonizer_look(polygonizer *p, const clay *c, key brick_at, uint32_t brick_id)
{
    p->of = c;
    p->at = brick_at;
    p->brick_id = brick_id;
    p->above[0] = brick_id == POOL_NONE ? NULL : clay_brick(c, brick_id);
    for (int n = 1; n < 8; n++) {
        uint32_t id = p->above[0] ? p->above[0]->neighbour[brick_neighbour_index(n >> 2, n >> 1 & 1, n & 1)]
                                  : clay_find(c, key_add(brick_at, n >> 2, n >> 1 & 1, n & 1));
        p->above[n] = id == POOL_NONE ? NULL : clay_brick(c, id);
    }
}

/* Bit dk of a row becomes that of corner dk + 1, the last one out of the brick above. */
static uint64_t next_k(uint64_t w, uint64_t above) { return (w >> 1 & ~BRICK_K_LAST) | (above & BRICK_K_FIRST) << 7; }

/* Inside a piece, and away from it, all eight bricks are on one side. */
static bool may_cross(const polygonizer *p)
{
    bool has_inside = false, has_outside = false;
    for (int n = 0; n < 8; n++) {
        has_inside |= p->above[n] && p->above[n]->has_inside;
        has_outside |= !p->above[n] || p->above[n]->has_outside;
    }
    return has_inside && has_outside;
}

/* Of each square of four corners in a layer: is any inside, are all? */
typedef struct layer {
    uint64_t any, all;
} layer;

static inline layer layer_of(const uint64_t *const word[4], int s)
{
    const uint64_t w = word[0][s], wk = next_k(w, word[1][s]);
    const uint64_t j = word[2][s], jk = next_k(j, word[3][s]); /* their first row alone is wanted */
    const uint64_t any = w | wk, all = w & wk;
    return (layer){any | any >> 8 | (j | jk) << 56, all & (all >> 8 | (j & jk) << 56)};
}

void polygonizer_crossing(const polygonizer *p, brick_mask *crossing_out)
{
    static const brick_mask nothing;
    if (!may_cross(p)) {
        *crossing_out = (brick_mask){{0}};
        return;
    }
    const uint64_t *word[8];
    for (int n = 0; n < 8; n++)
        word[n] = p->above[n] ? p->above[n]->inside.slab : nothing.slab;
    layer below = layer_of(word, 0);
    for (int di = 1; di <= BRICK_EDGE; di++) {
        const layer here = di < BRICK_EDGE ? layer_of(word, di) : layer_of(word + 4, 0);
        crossing_out->slab[di - 1] = (here.any | below.any) & ~(here.all & below.all);
        below = here;
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
