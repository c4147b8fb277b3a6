/* SPDX-License-Identifier: Apache-2.0 */
#include "surface/examined.h"

#include <string.h>

status examined_init(examined *e, uint32_t limit) { return dirt_init(&e->cubes, limit); }

void examined_finish(examined *e) { dirt_finish(&e->cubes); }

/* One step down an axis: what stays in the brick, and what lands in the one below. */
static void mask_down(const brick_mask *m, int axis, brick_mask *own_out, brick_mask *below_out)
{
    memset(below_out, 0, sizeof *below_out);
    for (int n = 0; n < BRICK_EDGE; n++) {
        uint64_t w = m->slab[n];
        if (axis == 0) {
            own_out->slab[n] = n < BRICK_EDGE - 1 ? m->slab[n + 1] : 0;
        } else if (axis == 1) {
            own_out->slab[n] = w >> 8;
            below_out->slab[n] = w << 56;
        } else {
            own_out->slab[n] = (w & ~BRICK_K_FIRST) >> 1;
            below_out->slab[n] = (w & BRICK_K_FIRST) << 7;
        }
    }
    if (axis == 0)
        below_out->slab[BRICK_EDGE - 1] = m->slab[0];
}

/* Marks m, and m moved down the axes from `axis` on. */
static status cubes_add(examined *e, key at, const brick_mask *m, int axis)
{
    if (brick_mask_is_empty(m))
        return STATUS_OK;
    if (axis == 3)
        return dirt_mark(&e->cubes, at, m);
    brick_mask own, below;
    mask_down(m, axis, &own, &below);
    brick_mask_unite(&own, m);
    status r = cubes_add(e, at, &own, axis + 1);
    return r == STATUS_OK ? cubes_add(e, key_add(at, -(axis == 0), -(axis == 1), -(axis == 2)), &below, axis + 1) : r;
}

status examined_count(examined *e, const dirt *d, uint64_t *cubes_out)
{
    status r = STATUS_OK;
    *cubes_out = 0;
    dirt_clear(&e->cubes);
    for (uint32_t n = 0; n < dirt_count(d) && r == STATUS_OK; n++)
        r = cubes_add(e, dirt_at(d, n)->at, &dirt_at(d, n)->corners, 0);
    for (uint32_t n = 0; n < dirt_count(&e->cubes) && r == STATUS_OK; n++)
        *cubes_out += brick_mask_count(&dirt_at(&e->cubes, n)->corners);
    return r;
}
