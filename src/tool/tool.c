/* SPDX-License-Identifier: Apache-2.0 */
#include "tool/tool.h"

#include "clay/apron.h"
#include "clay/capacity.h"
#include "tool/action_rows.h"
#include "tool/census.h"
#include "tool/walk.h"

#include <string.h>

/* One brick of the dab. */
typedef struct tool_work {
    uint32_t id;        /* POOL_NONE: not stored yet */
    bool is_dirtied;
    uint32_t page_id; /* of the page it is acted on, to be the brick's next; POOL_NONE: the brick's own */
    action_rows_brick rows;
} tool_work;

status tool_scratch_init(tool_scratch *s, uint32_t bricks)
{
    memset(s, 0, sizeof *s);
    return pool_init(&s->works, sizeof(tool_work), bricks);
}

void tool_scratch_finish(tool_scratch *s) { pool_finish(&s->works); }

static tool_work *work_at(const tool_scratch *s, uint32_t n) { return (tool_work *)pool_at(&s->works, n); }

/* Has the brick's page to stay as it is, for others or for its neighbours' sake, or may the dab come to nothing? */
static bool needs_page(const action_setting *set, const clay *c, uint32_t id)
{
    return id == POOL_NONE || action_reads_neighbours(set->kind) || clay_page_is_kept(c, id);
}

static status work_add(const action_setting *set, clay *c, key at, uint32_t id, tool_scratch *scratch)
{
    uint32_t n;
    status s = pool_take(&scratch->works, &n);
    if (s != STATUS_OK)
        return s == STATUS_POOL_FULL ? STATUS_TOO_LARGE : s;
    tool_work *work = work_at(scratch, n);
    work->id = id;
    work->page_id = POOL_NONE;
    work->rows.at = at;
    return needs_page(set, c, id) ? pages_take(&c->pages, &work->page_id) : STATUS_OK;
}

static void asides_give(clay *c, const tool_scratch *scratch)
{
    for (uint32_t n = 0; n < scratch->works.count; n++)
        if (work_at(scratch, n)->page_id != POOL_NONE)
            pages_give(&c->pages, work_at(scratch, n)->page_id);
}

/* Which of the bricks that are not stored are wanted. */
typedef enum air {
    AIR_NONE,
    AIR_RIM, /* those that may touch a stored one: smoothing spreads clay no further */
    AIR_ALL,
} air;

static air air_wanted(const action_setting *set, bool counting)
{
    if (counting) /* the paper counts what nothing can come of as well */
        return AIR_ALL;
    return set->kind == ACTION_SMOOTH ? AIR_RIM : action_makes_clay(set->kind) ? AIR_ALL : AIR_NONE;
}

/* What lies beyond the box is not looked at: on its faces, any brick may touch a stored one. */
static bool is_on_face(box b, key at)
{
    return at.i == b.min.i || at.i == b.max.i || at.j == b.min.j || at.j == b.max.j || at.k == b.min.k ||
           at.k == b.max.k;
}

typedef struct rim {
    uint64_t seen[CAPACITY_DAB_BRICKS / 64]; /* a bit a brick of the box */
} rim;

static void rim_begin(rim *r, box in)
{
    const int64_t bricks =
        (int64_t)(in.max.i - in.min.i + 1) * (in.max.j - in.min.j + 1) * (in.max.k - in.min.k + 1);
    memset(r->seen, 0, bricks > 0 ? (size_t)(bricks + 63) / 64 * sizeof r->seen[0] : 0);
}

/* Is this its first time? */
static bool rim_see(rim *r, box in, key at)
{
    const int64_t row = (int64_t)(at.i - in.min.i) * (in.max.j - in.min.j + 1) + at.j - in.min.j;
    const int64_t place = row * (in.max.k - in.min.k + 1) + at.k - in.min.k;
    const uint64_t bit = (uint64_t)1 << (place & 63), was = r->seen[place >> 6];
    r->seen[place >> 6] = was | bit;
    return (was & bit) == 0;
}

static status rim_add(rim *r, const action_setting *set, const walk *w, clay *c, const brick *b, tool_scratch *scratch)
{
    status s = STATUS_OK;
    for (int n = 0; n < BRICK_NEIGHBOURS && s == STATUS_OK; n++) {
        const key at = brick_neighbour_key(b->at, n);
        if (b->neighbour[n] == POOL_NONE && n != BRICK_SELF && box_contains(w->reached, at) &&
            !is_on_face(w->reached, at) && rim_see(r, w->reached, at) && walk_reaches(w, at))
            s = work_add(set, c, at, POOL_NONE, scratch);
    }
    return s;
}

/* Which bricks the tool's box touches. */
static status gather(const action_setting *set, const walk *w, clay *c, tool_scratch *scratch, air wanted)
{
    rim r;
    key at;
    status s = STATUS_OK;
    pool_clear(&scratch->works);
    if (wanted == AIR_RIM)
        rim_begin(&r, w->reached);
    for (at.i = w->reached.min.i; at.i <= w->reached.max.i; at.i++)
        for (at.j = w->reached.min.j; at.j <= w->reached.max.j; at.j++) {
            avl_walk row; /* the stored bricks of a row follow each other in the tree */
            key next;
            uint32_t next_id;
            at.k = w->reached.min.k;
            bool more = avl_seek(&row, &c->tree, at, &next, &next_id);
            for (; at.k <= w->reached.max.k && s == STATUS_OK; at.k++) {
                uint32_t id = POOL_NONE;
                if (more && key_equal(next, at)) {
                    id = next_id;
                    more = avl_next(&row, &next, &next_id);
                    if (wanted == AIR_RIM)
                        s = rim_add(&r, set, w, c, clay_brick(c, id), scratch);
                }
                bool is_wanted = id != POOL_NONE || wanted == AIR_ALL ||
                                 (wanted == AIR_RIM && is_on_face(w->reached, at));
                if (s == STATUS_OK && is_wanted && walk_reaches(w, at))
                    s = work_add(set, c, at, id, scratch);
            }
            if (s != STATUS_OK)
                return s;
        }
    return s;
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

/* What the brick becomes, on its own page or on its next. Reads the clay, and writes none of it but that page. */
static void act(const action_rows_dab *dab, const clay *c, tool_work *work)
{
    const brick *b = work->id == POOL_NONE ? NULL : clay_brick(c, work->id);
    float apron[APRON_CORNERS_MAX], mean[BRICK_CORNERS];
    uint32_t ids[BRICK_NEIGHBOURS];
    bool near = action_reads_neighbours(dab->set->kind);
    work->rows.page = work->page_id != POOL_NONE ? pages_at(&c->pages, work->page_id) : b->page;
    work->rows.mean = dab->set->kind == ACTION_SMOOTH ? mean : NULL;
    work->rows.now.inside = b ? b->inside : (brick_mask){{0}};
    work->rows.now.stored = b ? b->stored : 0;
    if (work->page_id != POOL_NONE && b)
        *work->rows.page = *b->page;
    else if (!b)
        memset(work->rows.page, 0, sizeof *work->rows.page);
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

/* The bricks that get a page, or those where they lie. */
typedef struct act_share {
    const action_rows_dab *dab;
    const clay *c;
    const tool_scratch *scratch;
    bool aside;
} act_share;

static void act_job(void *on, uint32_t hand, uint32_t hands)
{
    const act_share *share = (const act_share *)on;
    for (uint32_t n = 0; n < share->scratch->works.count; n++) {
        tool_work *work = work_at(share->scratch, n);
        if (crew_hand_of(work->rows.at, hands) == hand && (work->page_id != POOL_NONE) == share->aside)
            act(share->dab, share->c, work);
    }
}

static void act_all(const action_rows_dab *dab, const clay *c, const tool_scratch *scratch, bool aside)
{
    act_share share = {dab, c, scratch, aside};
    crew_run(c->crew, scratch->works.count, act_job, &share);
}

/* A new brick is made only for clay. Without it, what the tool passed is at most marked. */
static bool stays_absent(const tool_work *work) { return work->id == POOL_NONE && work->rows.now.stored == 0; }

/* What was acted on aside is known; of the others, all are taken for dirtied. */
static status reserve(clay *c, const tool_scratch *scratch)
{
    clay_need need = {0, 0, 0, 0};
    for (uint32_t n = 0; n < scratch->works.count; n++) {
        const tool_work *work = work_at(scratch, n);
        if (work->page_id == POOL_NONE)
            clay_need_add(c, &need, work->rows.at, work->id, CLAY_OPEN);
        else if (work->is_dirtied)
            clay_need_add(c, &need, work->rows.at, work->id, stays_absent(work) ? CLAY_MARK : CLAY_TURN);
    }
    return clay_reserve(c, &need);
}

/* Room was reserved: nothing is refused here. Marks in the air change nothing: they are made to be counted. */
static void settle(clay *c, tool_work *work, bool counting)
{
    status s = STATUS_OK;
    if (work->is_dirtied && stays_absent(work)) {
        if (counting)
            s = dirt_mark(&c->dirty, work->rows.at, &work->rows.now.dirtied);
    } else if (work->is_dirtied) {
        if (work->page_id != POOL_NONE)
            s = clay_brick_turn(c, work->rows.at, &work->id, work->page_id);
        work->page_id = POOL_NONE;
        clay_brick_settle(c, work->id, &work->rows.now);
    }
    assert(s == STATUS_OK);
    (void)s;
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
    s = gather(&set, &w, c, scratch, air_wanted(&set, counts_out != NULL));
    if (s == STATUS_OK) {
        act_all(&dab, c, scratch, true);
        s = reserve(c, scratch);
    }
    if (s == STATUS_OK) {
        act_all(&dab, c, scratch, false);
        for (uint32_t n = 0; n < scratch->works.count; n++)
            settle(c, work_at(scratch, n), counts_out != NULL);
    }
    asides_give(c, scratch);
    if (s != STATUS_OK)
        return s;
    clay_prune(c);
    if (counts_out)
        *counts_out = census_take(&t->form, &set, &w);
    return STATUS_OK;
}
