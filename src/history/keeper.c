/* SPDX-License-Identifier: Apache-2.0 */
#include "history/keeper.h"

static status put(history *h, const keeper_job *job)
{
    status s = history_put(h, &job->changed, job->dab, job->ends, job->rows);
    if (s == STATUS_NO_MEMORY && history_keep(h) == STATUS_OK) /* that gives memory back */
        s = history_put(h, &job->changed, job->dab, job->ends, job->rows);
    return s;
}

void keeper_do(history *h, keeper_job *job)
{
    switch (job->kind) {
    case KEEPER_PUT:
        delta_sort(&job->changed);
        job->outcome = put(h, job);
        break;
    case KEEPER_FETCH: job->outcome = history_fetch(h, job->way, job->stroke, &job->found); break;
    case KEEPER_MOVE: job->outcome = history_move(h, &job->found); break;
    case KEEPER_REFUSE:
        history_refuse(h, &job->found);
        job->outcome = STATUS_OK;
        break;
    case KEEPER_FIELD: job->outcome = history_field_begin(h, job->field); break;
    }
    /* The clay has gone on already: without this record nothing that follows could be told. The program starts again,
       from what is kept. */
    assert(job->kind != KEEPER_PUT || job->outcome == STATUS_OK);
}

void keeper_look(const history *h, keeper_facts *facts_out)
{
    *facts_out = (keeper_facts){
        .put = h->sequence,
        .kept = h->kept,
        .cursor = h->tree.cursor,
        .tip = h->tree.tip,
        .kept_cursor = h->kept_cursor,
        .kept_digest = h->kept_digest,
        .strokes = h->tree.count,
        .branches = tree_branches(&h->tree),
        .can_undo = history_can_undo(h),
        .can_redo = history_can_redo(h),
        .wants_field = h->wants_field && !h->writer && h->medium == HISTORY_MEDIUM_GOOD, /* else it cannot begin */
        .room = history_room(h),
        .medium = h->medium,
        .trouble = h->trouble,
    };
}

/* --- in place --- */

static void in_place_hand(void *self, keeper_job *job)
{
    history *h = (history *)self;
    keeper_do(h, job);
    status s = history_keep(h);
    (void)s; /* the facts tell */
    while (job->kind == KEEPER_FIELD && h->writer)
        history_work(h);
    job->done = true;
}

static bool in_place_is_done(void *self, const keeper_job *job)
{
    (void)self;
    return job->done;
}

static void in_place_await(void *self, const keeper_job *job)
{
    (void)self;
    (void)job;
}

static void in_place_settle(void *self)
{
    status s = history_keep((history *)self);
    (void)s;
}

static void in_place_look(void *self, keeper_facts *facts_out) { keeper_look((const history *)self, facts_out); }

keeper keeper_in_place(history *h)
{
    return (keeper){h, in_place_hand, in_place_is_done, in_place_await, in_place_settle, in_place_look};
}
