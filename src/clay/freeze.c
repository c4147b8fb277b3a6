/* SPDX-License-Identifier: Apache-2.0 */
#include "clay/freeze.h"

#include "clay/capacity.h"

#include <string.h>

status freeze_begin(freeze *f, clay *of)
{
    clay *still = &f->still;
    if (of->frozen == CAPACITY_FROZEN)
        return STATUS_POOL_FULL;
    memset(f, 0, sizeof *f);
    status s = pool_copy(&still->bricks, &of->bricks);
    if (s != STATUS_OK)
        return s;
    s = avl_copy(&still->tree, &of->tree);
    if (s != STATUS_OK) {
        pool_finish(&still->bricks);
        return s;
    }
    for (uint32_t id = 0; id < still->bricks.fresh; id++) {
        brick *b = clay_brick(still, id);
        if (b->page == NULL)
            continue;
        pages_hold(&of->pages, b->page_id);
        b->dirt_round = UINT32_MAX; /* `still` is in round 0: nothing is dirty */
        b->image = POOL_NONE;
    }
    still->rows = of->rows;
    still->corners = of->corners;
    f->of = of;
    of->frozen++;
    return STATUS_OK;
}

void freeze_end(freeze *f)
{
    assert(f->of->frozen > 0);
    for (uint32_t id = 0; id < f->still.bricks.fresh; id++)
        if (clay_brick(&f->still, id)->page != NULL)
            pages_give(&f->of->pages, clay_brick(&f->still, id)->page_id);
    f->of->frozen--;
    clay_finish(&f->still);
    memset(f, 0, sizeof *f);
}
