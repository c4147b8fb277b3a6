/* SPDX-License-Identifier: Apache-2.0 */
/* Clay from a function of space, written brick by brick: large pieces in little time, for tests and measuring. */
#ifndef GLAISE_TESTS_FIELD_FILL_H
#define GLAISE_TESTS_FIELD_FILL_H

#include "sculpture/sculpture.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

/* A sculpture without history, larger than view_stage_piece's. */
class field_fill_piece {
  public:
    explicit field_fill_piece(uint32_t bricks) : it(new sculpture{})
    {
        it->step_mm = 1;
        demand(clay_init(&it->clay, bricks));
        demand(surface_init(&it->surface, 2 * bricks));
    }
    ~field_fill_piece()
    {
        surface_finish(&it->surface);
        clay_finish(&it->clay);
        delete it;
    }
    field_fill_piece(const field_fill_piece &) = delete;
    field_fill_piece &operator=(const field_fill_piece &) = delete;

    /* potential_at(x, y, z) at every corner of `within`, in lattice steps; what is there already stays where it is
       more. */
    template <typename potential> void fill(const box &within, uint32_t rgba, const potential &potential_at)
    {
        const key lo = key_brick(within.min), hi = key_brick(within.max);
        for (int32_t i = lo.i; i <= hi.i; i++)
            for (int32_t j = lo.j; j <= hi.j; j++)
                for (int32_t k = lo.k; k <= hi.k; k++)
                    fill_brick({i, j, k}, rgba, potential_at);
    }

    /* Brings the surface up to date, all of it. */
    void finish()
    {
        clay_prune(&it->clay);
        demand(surface_rebuild(&it->surface, &it->clay, nullptr));
        dirt_clear(&it->clay.dirty);
    }

    sculpture *const it;

  private:
    static void demand(status s)
    {
        assert(s == STATUS_OK);
        (void)s;
    }

    template <typename potential> void fill_brick(key at, uint32_t rgba, const potential &potential_at)
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
        demand(clay_brick_open(&it->clay, at, &id));
        brick_page *to = clay_brick(&it->clay, id)->page;
        for (int n = 0; n < BRICK_CORNERS; n++) {
            if (values[n] > to->potential[n]) {
                to->potential[n] = values[n];
                to->rgba[n] = rgba;
            }
        }
        const brick_mask all = BRICK_MASK_ALL;
        demand(clay_brick_close(&it->clay, id, &all));
    }
};

#endif
