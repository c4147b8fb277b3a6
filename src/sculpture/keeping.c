/* SPDX-License-Identifier: Apache-2.0 */
#include "sculpture/keeping.h"

#include <string.h>

enum { JOBS_SPARE = 8 }; /* no stroke begins when fewer are left */

/* --- jobs --- */

static keeper_job *job_at(sculpture *s, uint32_t n)
{
    return &s->jobs.at[(s->jobs.first + n) % SCULPTURE_JOBS];
}

void keeping_take(sculpture *s)
{
    while (s->jobs.count > 0) {
        keeper_job *job = job_at(s, 0);
        if (job == s->jobs.fetch || !s->keeper.is_done(s->keeper.self, job))
            return;
        s->jobs.puts -= job->kind == KEEPER_PUT;
        delta_give(&job->changed, &s->clay);
        route_finish(&job->found);
        s->jobs.first = (s->jobs.first + 1) % SCULPTURE_JOBS;
        s->jobs.count--;
    }
}

keeper_job *keeping_job(sculpture *s, keeper_kind kind)
{
    keeping_take(s);
    if (s->jobs.count == SCULPTURE_JOBS) {
        s->keeper.await(s->keeper.self, job_at(s, 0));
        keeping_take(s);
    }
    keeper_job *job = job_at(s, s->jobs.count);
    job->kind = kind;
    job->outcome = STATUS_OK;
    job->done = false;
    job->next = NULL;
    return job;
}

void keeping_send(sculpture *s, keeper_job *job)
{
    s->jobs.count++;
    s->jobs.puts += job->kind == KEEPER_PUT;
    s->keeper.hand(s->keeper.self, job);
}

/* --- strokes --- */

status keeping_hand(sculpture *s, bool ends)
{
    keeper_job *job = keeping_job(s, KEEPER_PUT);
    status outcome = delta_cut(&job->changed, &s->clay);
    if (outcome != STATUS_OK)
        return outcome;
    s->stroke_changed = s->stroke_changed || job->changed.count > 0;
    job->dab = s->dab;
    job->ends = ends;
    job->rows = s->clay.rows;
    keeping_send(s, job);
    return STATUS_OK;
}

void keeping_end(sculpture *s)
{
    keeper_job *job = keeping_job(s, KEEPER_PUT);
    job->dab = s->dab;
    job->ends = true;
    keeping_send(s, job);
}

void sculpture_part(sculpture *s)
{
    if (!s->in_stroke || !s->has_history)
        return;
    keeping_take(s);
    if (s->jobs.puts >= SCULPTURE_PARTS || s->clay.cut + 2 * (uint64_t)change_count(&s->clay.changes) >
                                               s->clay.bricks.limit)
        return;
    status outcome = keeping_hand(s, false);
    (void)outcome; /* it goes with the next one */
}

status sculpture_room(sculpture *s)
{
    if (!s->has_history)
        return STATUS_OK;
    keeping_take(s);
    if (s->jobs.count > SCULPTURE_JOBS - JOBS_SPARE || s->clay.cut > s->clay.bricks.limit)
        return STATUS_BUSY;
    return sculpture_facts(s).room;
}

keeper_facts sculpture_facts(sculpture *s)
{
    keeper_facts facts;
    memset(&facts, 0, sizeof facts);
    if (s->has_history)
        s->keeper.look(s->keeper.self, &facts);
    return facts;
}

/* --- the field as a whole --- */

static void field_take(sculpture *s)
{
    if (!s->jobs.writes_field || !s->keeper.is_done(s->keeper.self, &s->jobs.checkpoint))
        return;
    freeze_end(&s->jobs.field);
    s->jobs.writes_field = false;
}

static status field_hand(sculpture *s)
{
    status outcome = freeze_begin(&s->jobs.field, &s->clay);
    if (outcome != STATUS_OK)
        return outcome;
    s->jobs.checkpoint = (keeper_job){.kind = KEEPER_FIELD, .field = &s->jobs.field.still};
    s->jobs.writes_field = true;
    s->keeper.hand(s->keeper.self, &s->jobs.checkpoint);
    return STATUS_OK;
}

void sculpture_attend(sculpture *s)
{
    if (!s->has_history)
        return;
    keeping_take(s);
    field_take(s);
    if (s->in_stroke || s->jobs.fetch || s->jobs.writes_field || !sculpture_facts(s).wants_field)
        return;
    status outcome = field_hand(s);
    (void)outcome; /* both freezings are in use: another time */
    field_take(s);
}

/* --- the end, and another keeper --- */

static void settle(sculpture *s)
{
    s->keeper.settle(s->keeper.self);
    keeping_take(s);
    if (s->jobs.writes_field)
        s->keeper.await(s->keeper.self, &s->jobs.checkpoint);
    field_take(s);
}

void sculpture_keeper_set(sculpture *s, const keeper *k)
{
    if (!s->has_history)
        return;
    settle(s);
    s->keeper = k ? *k : keeper_in_place(&s->history);
}

status keeping_all(sculpture *s)
{
    sculpture_keeper_set(s, NULL);
    status outcome = history_keep(&s->history);
    if (outcome == STATUS_OK && (!s->history.field.there || s->history.field.sequence != s->history.sequence) &&
        s->history.sequence > 0) {
        outcome = field_hand(s);
        if (outcome == STATUS_OK)
            outcome = s->jobs.checkpoint.outcome;
        field_take(s);
    }
    return outcome;
}

void keeping_finish(sculpture *s)
{
    for (uint32_t n = 0; n < SCULPTURE_JOBS; n++)
        delta_finish(&s->jobs.at[n].changed);
}
