/* SPDX-License-Identifier: Apache-2.0 */
#include "tool/tool.h"

#include "clay/apron.h"
#include "tool/walk.h"

#include <math.h>
#include <string.h>

/* One brick of the dab: the tool's potential first, what the brick becomes afterwards. */
typedef struct tool_work {
    key at;
    brick_mask dirtied;
    float v_tool[BRICK_CORNERS];
    brick_page page;
    bool needed; /* the clay has to be written here */
} tool_work;

status tool_scratch_init(tool_scratch *s, uint32_t bricks)
{
    s->used = 0;
    return pool_init(&s->pages, sizeof(tool_work), bricks);
}

void tool_scratch_finish(tool_scratch *s) { pool_finish(&s->pages); }

static tool_work *work_at(const tool_scratch *s, uint32_t n) { return (tool_work *)pool_at(&s->pages, n); }

/* Evaluates the tool on one brick; counts, and says whether any corner is dirtied. */
static bool evaluate(const tool *t, const action_setting *set, const walk *w, tool_work *work, tool_counts *counts)
{
    float start[3], x[8], y[8], z[8];
    uint64_t dirtied = 0;
    work->dirtied = (brick_mask){{0}};
    walk_start(w, work->at, start);
    for (int row = 0; row < BRICK_ROWS; row++) {
        walk_row(w, start, row >> 3, row & 7, x, y, z);
        unsigned inside = walk_inside(w, work->at, row >> 3, row & 7, x, y, z), hit = 0;
        if (inside == 0)
            continue;
        float *v = work->v_tool + row * 8;
        t->form.evaluate(t->form.self, x, y, z, v, 8);
        for (int n = 0; n < 8; n++)
            hit |= (unsigned)(inside >> n & 1 && action_contributes(set, v[n])) << n;
        counts->computed += (uint64_t)__builtin_popcount(inside);
        dirtied += (uint64_t)__builtin_popcount(hit);
        work->dirtied.slab[row >> 3] |= (uint64_t)hit << ((row & 7) * 8);
    }
    counts->dirtied += dirtied;
    return dirtied > 0;
}

/* First pass: which bricks, with what potential of the tool. */
static status gather(const tool *t, const action_setting *set, const walk *w, tool_scratch *scratch,
                     tool_counts *counts)
{
    pool_clear(&scratch->pages);
    scratch->used = 0;
    uint32_t id = POOL_NONE;
    key at;
    for (at.i = w->bricks.min.i; at.i <= w->bricks.max.i; at.i++)
        for (at.j = w->bricks.min.j; at.j <= w->bricks.max.j; at.j++)
            for (at.k = w->bricks.min.k; at.k <= w->bricks.max.k; at.k++) {
                if (!walk_touches(w, at))
                    continue;
                if (id == POOL_NONE) {
                    status s = pool_take(&scratch->pages, &id);
                    if (s != STATUS_OK)
                        return s == STATUS_POOL_FULL ? STATUS_TOO_LARGE : s;
                }
                work_at(scratch, id)->at = at;
                if (evaluate(t, set, w, work_at(scratch, id), counts)) {
                    assert(id == scratch->used);
                    scratch->used++;
                    id = POOL_NONE; /* used up; otherwise the page serves the next brick */
                }
            }
    counts->bricks = scratch->used;
    return STATUS_OK;
}

static bool page_has_clay(const brick_page *p)
{
    for (int n = 0; n < BRICK_CORNERS; n++)
        if (p->potential[n] > POTENTIAL_MIN)
            return true;
    return false;
}

/* Second pass: what each brick becomes, old values only, nothing written to the clay. */
static void act(const action_setting *set, const clay *c, tool_work *work, uint32_t id)
{
    float apron[APRON_CORNERS_MAX];
    uint32_t apron_rgba[APRON_CORNERS_MAX];
    bool near = action_reads_neighbours(set->kind);
    if (id != POOL_NONE)
        work->page = *clay_brick(c, id)->page;
    else
        memset(&work->page, 0, sizeof work->page);
    if (near) {
        uint32_t ids[BRICK_NEIGHBOURS];
        clay_neighbours(c, work->at, ids);
        apron_gather(c, ids, 8, apron, apron_rgba);
    }
    key first = key_of_brick(work->at);
    for (int row = 0; row < BRICK_ROWS; row++) {
        unsigned mask = (unsigned)(work->dirtied.slab[row >> 3] >> ((row & 7) * 8)) & 255u;
        if (mask == 0)
            continue;
        int place = (((row >> 3) + 1) * ACTION_APRON_SIDE + (row & 7) + 1) * ACTION_APRON_SIDE + 1;
        action_row(set, key_add(first, row >> 3, row & 7, 0), mask, work->v_tool + row * 8, near ? apron + place : NULL,
                   near ? apron_rgba + place : NULL, work->page.potential + row * 8, work->page.rgba + row * 8);
    }
    work->needed = id != POOL_NONE || (action_makes_clay(set->kind) && page_has_clay(&work->page));
}

/* Marks come first, so that whatever was opened is closed and pruned without fail. Memory the pools have not asked
   the machine for yet may still be refused in the middle: then what was written goes back. */
static status write_back(clay *c, tool_scratch *scratch, uint32_t *written)
{
    *written = 0;
    for (uint32_t n = 0; n < scratch->used; n++) {
        status s = dirt_mark(&c->dirty, work_at(scratch, n)->at, &work_at(scratch, n)->dirtied);
        if (s != STATUS_OK)
            return s;
    }
    for (; *written < scratch->used; ++*written) {
        tool_work *work = work_at(scratch, *written);
        if (!work->needed)
            continue;
        uint32_t id;
        status s = clay_brick_open(c, work->at, &id);
        if (s != STATUS_OK)
            return s;
        brick_page before = *clay_brick(c, id)->page;
        *clay_brick(c, id)->page = work->page;
        work->page = before;
        s = clay_brick_close(c, id, &work->dirtied);
        assert(s == STATUS_OK);
    }
    return STATUS_OK;
}

static void put_back(clay *c, tool_scratch *scratch, uint32_t written)
{
    for (uint32_t n = 0; n < written; n++) {
        tool_work *work = work_at(scratch, n);
        if (!work->needed)
            continue;
        uint32_t id = clay_find(c, work->at);
        *clay_brick(c, id)->page = work->page;
        status s = clay_brick_close(c, id, &work->dirtied);
        assert(s == STATUS_OK);
    }
    clay_prune(c);
}

status tool_apply(const tool *t, const tool_dab *d, clay *c, tool_scratch *scratch, tool_counts *counts_out)
{
    memset(counts_out, 0, sizeof *counts_out);
    if (!(d->amount >= 0 && d->amount <= TOOL_AMOUNT_MAX) || (int)t->kind < 0 || (int)t->kind >= ACTION_COUNT)
        return STATUS_BAD_PARAMETER;
    walk w;
    status s = walk_begin(&w, &d->at, &t->form);
    if (s != STATUS_OK)
        return s;
    const action_setting set = {t->kind, t->rgba, (float)d->amount, &t->def, d->number};
    tool_counts counts = {.visited = (uint64_t)w.visited};
    s = gather(t, &set, &w, scratch, &counts);
    if (s != STATUS_OK)
        return s;
    clay_need need = {0, 0, 0};
    for (uint32_t n = 0; n < scratch->used; n++) {
        tool_work *work = work_at(scratch, n);
        act(&set, c, work, clay_find(c, work->at));
        clay_need_add(c, &need, work->at, work->needed);
    }
    s = clay_need_fits(c, &need);
    if (s != STATUS_OK)
        return s;
    uint32_t written;
    s = write_back(c, scratch, &written);
    if (s != STATUS_OK) {
        put_back(c, scratch, written);
        return s;
    }
    clay_prune(c);
    *counts_out = counts;
    return STATUS_OK;
}
