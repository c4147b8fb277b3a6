/* SPDX-License-Identifier: Apache-2.0 */
#include "tool/tool.h"

#include "clay/apron.h"
#include "tool/action_rows.h"
#include "tool/census.h"
#include "tool/walk.h"

#include <string.h>

/* One brick of the dab. */
typedef struct tool_work {
    uint32_t id;        /* POOL_NONE: not stored yet */
    bool is_dirtied;
    brick_page *page;   /* in scratch, or NULL: the brick's own */
    action_rows_brick rows;
} tool_work;

status tool_scratch_init(tool_scratch *s, uint32_t bricks)
{
    memset(s, 0, sizeof *s);
    status outcome = pool_init(&s->works, sizeof(tool_work), bricks);
    if (outcome == STATUS_OK)
        outcome = pool_init(&s->pages, sizeof(brick_page), bricks);
    if (outcome != STATUS_OK)
        tool_scratch_finish(s);
    return outcome;
}

void tool_scratch_finish(tool_scratch *s)
{
    pool_finish(&s->works);
    pool_finish(&s->pages);
}

static tool_work *work_at(const tool_scratch *s, uint32_t n) { return (tool_work *)pool_at(&s->works, n); }

/* Does the action have to see the brick as it was while others are written, or may it still come to nothing? */
static bool needs_page(const action_setting *set, const clay *c, uint32_t id)
{
    return id == POOL_NONE || action_reads_neighbours(set->kind) ||
           (c->changes.recording && clay_brick(c, id)->image == POOL_NONE);
}

static status work_add(const action_setting *set, const clay *c, key at, uint32_t id, tool_scratch *scratch)
{
    uint32_t n, page;
    status s = pool_take(&scratch->works, &n);
    if (s != STATUS_OK)
        return s == STATUS_POOL_FULL ? STATUS_TOO_LARGE : s;
    tool_work *work = work_at(scratch, n);
    work->id = id;
    work->page = NULL;
    work->rows.at = at;
    if (needs_page(set, c, id)) {
        s = pool_take(&scratch->pages, &page);
        if (s != STATUS_OK)
            return s;
        work->page = (brick_page *)pool_at(&scratch->pages, page);
    }
    return STATUS_OK;
}

/* Which bricks the tool's box touches; where there is no clay and none can come to be, only if all are wanted. */
static status gather(const action_setting *set, const walk *w, const clay *c, tool_scratch *scratch, bool all)
{
    pool_clear(&scratch->works);
    pool_clear(&scratch->pages);
    key at;
    for (at.i = w->reached.min.i; at.i <= w->reached.max.i; at.i++)
        for (at.j = w->reached.min.j; at.j <= w->reached.max.j; at.j++) {
            avl_walk row; /* the stored bricks of a row follow each other in the tree */
            key next;
            uint32_t next_id;
            at.k = w->reached.min.k;
            bool more = avl_seek(&row, &c->tree, at, &next, &next_id);
            for (; at.k <= w->reached.max.k; at.k++) {
                uint32_t id = POOL_NONE;
                if (more && key_equal(next, at)) {
                    id = next_id;
                    more = avl_next(&row, &next, &next_id);
                }
                if (!walk_reaches(w, at) || (id == POOL_NONE && !all && !action_makes_clay(set->kind)))
                    continue;
                status s = work_add(set, c, at, id, scratch);
                if (s != STATUS_OK)
                    return s;
            }
        }
    return STATUS_OK;
}

/* Clay that smooth or stamp made out of nothing takes the colour of the clay round it. */
static void colour_fresh(const action_setting *set, const clay *c, const uint32_t ids[BRICK_NEIGHBOURS],
                         const float *apron, const action_rows_brick *rows)
{
    uint32_t apron_rgba[APRON_CORNERS_MAX];
    if (brick_mask_is_empty(&rows->fresh))
        return;
    apron_gather(c, ids, 8, NULL, apron_rgba);
    for (int di = 0; di < BRICK_EDGE; di++)
        for (uint64_t left = rows->fresh.slab[di]; left; left &= left - 1) {
            int n = __builtin_ctzll(left);
            int place = ((di + 1) * ACTION_APRON_SIDE + (n >> 3) + 1) * ACTION_APRON_SIDE + (n & 7) + 1;
            rows->page->rgba[di * 64 + n] = action_colour_round(set, apron + place, apron_rgba + place);
        }
}

/* What the brick becomes, on its own page or in scratch. Reads the clay, and writes none of it but that page. */
static void act(const action_rows_dab *dab, const clay *c, tool_work *work)
{
    const brick *b = work->id == POOL_NONE ? NULL : clay_brick(c, work->id);
    float apron[APRON_CORNERS_MAX], mean[BRICK_CORNERS];
    uint32_t ids[BRICK_NEIGHBOURS];
    bool near = action_reads_neighbours(dab->set->kind);
    work->rows.page = work->page ? work->page : b->page;
    work->rows.mean = dab->set->kind == ACTION_SMOOTH ? mean : NULL;
    work->rows.now.inside = b ? b->inside : (brick_mask){{0}};
    work->rows.now.stored = b ? b->stored : 0;
    if (work->page && b)
        *work->page = *b->page;
    else if (work->page)
        memset(work->page, 0, sizeof *work->page);
    if (near) {
        clay_neighbours(c, work->rows.at, ids);
        apron_gather(c, ids, 8, apron, NULL);
    }
    if (work->rows.mean)
        action_rows_mean(apron, mean, c->rows);
    work->is_dirtied = action_rows(dab, &work->rows, c->rows);
    if (near)
        colour_fresh(dab->set, c, ids, apron, &work->rows);
}

/* The bricks in scratch, or those where they lie. */
typedef struct act_share {
    const action_rows_dab *dab;
    const clay *c;
    const tool_scratch *scratch;
    bool in_scratch;
} act_share;

static void act_job(void *on, uint32_t hand, uint32_t hands)
{
    const act_share *share = (const act_share *)on;
    for (uint32_t n = 0; n < share->scratch->works.count; n++) {
        tool_work *work = work_at(share->scratch, n);
        if (crew_hand_of(work->rows.at, hands) == hand && (work->page != NULL) == share->in_scratch)
            act(share->dab, share->c, work);
    }
}

static void act_all(const action_rows_dab *dab, const clay *c, const tool_scratch *scratch, bool in_scratch)
{
    act_share share = {dab, c, scratch, in_scratch};
    crew_run(c->crew, scratch->works.count, act_job, &share);
}

/* A new brick is made only for clay. Without it, what the tool passed is at most marked. */
static bool stays_absent(const tool_work *work) { return work->id == POOL_NONE && work->rows.now.stored == 0; }

/* What was acted on in scratch is known; of the others, all are taken for dirtied. */
static status reserve(clay *c, const tool_scratch *scratch)
{
    clay_need need = {0, 0, 0};
    for (uint32_t n = 0; n < scratch->works.count; n++) {
        const tool_work *work = work_at(scratch, n);
        if (!work->page || work->is_dirtied)
            clay_need_add(c, &need, work->rows.at, work->id, !stays_absent(work));
    }
    return clay_reserve(c, &need);
}

/* Room was reserved: what is opened here cannot be refused. */
static void settle(clay *c, tool_work *work)
{
    status s = STATUS_OK;
    if (!work->is_dirtied)
        return;
    if (stays_absent(work)) {
        s = dirt_mark(&c->dirty, work->rows.at, &work->rows.now.dirtied);
        assert(s == STATUS_OK);
        return;
    }
    if (work->page) {
        s = clay_brick_open(c, work->rows.at, &work->id);
        assert(s == STATUS_OK);
        *clay_brick(c, work->id)->page = *work->page;
    }
    clay_brick_settle(c, work->id, &work->rows.now);
}

status tool_apply(const tool *t, const tool_dab *d, clay *c, tool_scratch *scratch, tool_counts *counts_out)
{
    if (counts_out)
        memset(counts_out, 0, sizeof *counts_out);
    if (!(d->amount >= 0 && d->amount <= TOOL_AMOUNT_MAX) || (int)t->kind < 0 || (int)t->kind >= ACTION_COUNT)
        return STATUS_BAD_PARAMETER;
    walk w;
    status s = walk_begin(&w, &d->at, &t->form);
    if (s != STATUS_OK)
        return s;
    const action_setting set = {t->kind, t->rgba, (float)d->amount, &t->def, d->number};
    const action_rows_dab dab = action_rows_begin(&set, &t->form, &w);
    s = gather(&set, &w, c, scratch, counts_out != NULL);
    if (s != STATUS_OK)
        return s;
    act_all(&dab, c, scratch, true);
    s = reserve(c, scratch);
    if (s != STATUS_OK)
        return s;
    act_all(&dab, c, scratch, false);
    for (uint32_t n = 0; n < scratch->works.count; n++)
        settle(c, work_at(scratch, n));
    clay_prune(c);
    if (counts_out)
        *counts_out = census_take(&t->form, &set, &w);
    return STATUS_OK;
}
