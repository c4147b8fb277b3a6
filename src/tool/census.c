/* SPDX-License-Identifier: Apache-2.0 */
#include "tool/census.h"

static uint64_t brick_census(const shape *form, const action_setting *set, const walk *w, key at, uint64_t *computed)
{
    float start[3], x[8], y[8], z[8], v[8];
    uint64_t dirtied = 0;
    walk_start(w, at, start);
    for (int row = 0; row < BRICK_ROWS; row++) {
        walk_row(w, start, row >> 3, row & 7, x, y, z);
        unsigned inside = walk_inside(w, at, row >> 3, row & 7, x, y, z);
        if (inside == 0)
            continue;
        form->evaluate(form->self, x, y, z, v, 8);
        for (int n = 0; n < 8; n++)
            dirtied += inside >> n & 1 && action_contributes(set, v[n]);
        *computed += (uint64_t)__builtin_popcount(inside);
    }
    return dirtied;
}

tool_counts census_take(const shape *form, const action_setting *set, const walk *w)
{
    tool_counts counts = {.visited = (uint64_t)w->visited};
    key at;
    for (at.i = w->bricks.min.i; at.i <= w->bricks.max.i; at.i++)
        for (at.j = w->bricks.min.j; at.j <= w->bricks.max.j; at.j++)
            for (at.k = w->bricks.min.k; at.k <= w->bricks.max.k; at.k++) {
                if (!walk_touches(w, at))
                    continue;
                uint64_t dirtied = brick_census(form, set, w, at, &counts.computed);
                counts.dirtied += dirtied;
                counts.bricks += dirtied > 0;
            }
    return counts;
}
