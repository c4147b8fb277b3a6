/* SPDX-License-Identifier: Apache-2.0 */
/* Clay from a function of space, written brick by brick: large pieces in little time, for tests and measuring. */
#ifndef GLAISE_TESTS_FIELD_FILL_H
#define GLAISE_TESTS_FIELD_FILL_H

#include "sculpture/sculpture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

inline void field_fill_demand(status s)
{
    assert(s == STATUS_OK);
    (void)s;
}

template <typename potential> void field_fill_brick(clay *c, key at, uint32_t rgba, const potential &potential_at)
{
    float values[BRICK_CORNERS];
    bool any = false;
    const key from = key_of_brick(at);
    for (int n = 0; n < BRICK_CORNERS; n++) {
        const double p = potential_at(from.i + (n >> 6), from.j + (n >> 3 & 7), from.k + (n & 7));
        values[n] = static_cast<float>(std::clamp<double>(p, POTENTIAL_MIN, POTENTIAL_MAX));
        any = any || values[n] > 0;
    }
    if (!any)
        return;
    uint32_t id;
    field_fill_demand(clay_brick_open(c, at, &id));
    brick_page *to = clay_brick(c, id)->page;
    for (int n = 0; n < BRICK_CORNERS; n++) {
        if (values[n] > to->potential[n]) {
            to->potential[n] = values[n];
            to->rgba[n] = rgba;
        }
    }
    const brick_mask all = BRICK_MASK_ALL;
    field_fill_demand(clay_brick_close(c, id, &all));
}

/* potential_at(x, y, z) at every corner of the bricks that touch `within`, in lattice steps; what is there already stays
   where it is more. */
template <typename potential>
void field_fill(clay *c, const box &within, uint32_t rgba, const potential &potential_at)
{
    const key lo = key_brick(within.min), hi = key_brick(within.max);
    for (int32_t i = lo.i; i <= hi.i; i++)
        for (int32_t j = lo.j; j <= hi.j; j++)
            for (int32_t k = lo.k; k <= hi.k; k++)
                field_fill_brick(c, {i, j, k}, rgba, potential_at);
}

/* The surface, all of it, of what was filled. */
inline void field_fill_finish(sculpture *s)
{
    clay_prune(&s->clay);
    field_fill_demand(surface_rebuild(&s->surface, &s->clay, nullptr));
    dirt_clear(&s->clay.dirty);
}

/* A sculpture without history, larger than view_stage_piece's. */
class field_fill_piece {
  public:
    explicit field_fill_piece(uint32_t bricks) : it(new sculpture{})
    {
        it->step_mm = 1;
        field_fill_demand(clay_init(&it->clay, bricks));
        field_fill_demand(surface_init(&it->surface, 2 * bricks));
    }
    ~field_fill_piece()
    {
        surface_finish(&it->surface);
        clay_finish(&it->clay);
        delete it;
    }
    field_fill_piece(const field_fill_piece &) = delete;
    field_fill_piece &operator=(const field_fill_piece &) = delete;

    template <typename potential> void fill(const box &within, uint32_t rgba, const potential &potential_at)
    {
        field_fill(&it->clay, within, rgba, potential_at);
    }
    void finish() { field_fill_finish(it); }

    sculpture *const it;
};

#endif
