/* SPDX-License-Identifier: Apache-2.0 */
#include "sculpture/sculpture.h"

#include "clay/digest.h"
#include "history/stored_file.h"
#include "sculpture/keeping.h"

#include <math.h>
#include <string.h>

/* --- opening and closing --- */

static status rooms_init(sculpture *s, uint32_t bricks)
{
    status outcome = clay_init(&s->clay, bricks);
    if (outcome == STATUS_OK)
        outcome = surface_init(&s->surface, (uint32_t)((uint64_t)bricks * CAPACITY_PATCHES / CAPACITY_BRICKS));
    if (outcome == STATUS_OK)
        outcome = tool_scratch_init(&s->scratch, CAPACITY_DAB_BRICKS);
    return outcome;
}

static void rooms_finish(sculpture *s)
{
    tool_scratch_finish(&s->scratch);
    surface_finish(&s->surface);
    clay_finish(&s->clay);
}

status sculpture_open(sculpture *s, const byte_store *store, uint32_t bricks, const history_settings *settings,
                      double step_mm, history_finding *finding_out)
{
    const history_settings usual = HISTORY_SETTINGS_DEFAULT;
    memset(s, 0, sizeof *s);
    finding_out->text[0] = '\0';
    if (!(step_mm >= SCULPTURE_STEP_MM_MIN && step_mm <= SCULPTURE_STEP_MM_MAX) || bricks < 1 ||
        bricks > CAPACITY_BRICKS)
        return STATUS_BAD_PARAMETER;
    s->step_mm = step_mm;
    status outcome = rooms_init(s, bricks);
    if (outcome == STATUS_OK && store) {
        outcome = history_open(&s->history, *store, settings ? settings : &usual, step_mm, &s->clay, finding_out);
        s->has_history = outcome == STATUS_OK;
    }
    if (outcome == STATUS_OK && s->has_history) {
        surface_counts counts;
        s->keeper = keeper_in_place(&s->history);
        s->step_mm = s->history.step_mm;
        s->dab = s->history.dab;
        outcome = surface_rebuild(&s->surface, &s->clay, &counts);
        dirt_clear(&s->clay.dirty);
    }
    if (outcome != STATUS_OK) {
        if (s->has_history)
            history_close(&s->history);
        rooms_finish(s);
    }
    return outcome;
}

status sculpture_close(sculpture *s)
{
    status outcome = s->in_stroke ? sculpture_stroke_end(s) : STATUS_OK;
    if (s->has_history) {
        const status kept = keeping_all(s);
        outcome = outcome == STATUS_OK ? kept : outcome;
        history_close(&s->history);
        keeping_finish(s);
    }
    rooms_finish(s);
    return outcome;
}

/* --- strokes --- */

void sculpture_stroke_begin(sculpture *s)
{
    assert(!s->in_stroke);
    assert(!s->jobs.fetch);
    clay_change_begin(&s->clay);
    s->in_stroke = true;
    s->stroke_changed = false;
}

/* The clay was put back to what the surface showed before: that fits again. */
static void surface_put_back(sculpture *s)
{
    status outcome = surface_update(&s->surface, &s->clay, NULL);
    if (outcome != STATUS_OK)
        outcome = surface_rebuild(&s->surface, &s->clay, NULL);
    assert(outcome == STATUS_OK);
    (void)outcome;
    dirt_clear(&s->clay.dirty);
}

static void stroke_revert(sculpture *s)
{
    clay_change_revert(&s->clay);
    surface_put_back(s);
    s->in_stroke = false;
    if (s->has_history)
        keeping_end(s);
}

status sculpture_apply_field(sculpture *s, const tool *t, const sculpture_dab *d, tool_counts *counts_out)
{
    assert(s->in_stroke);
    tool_dab dab = {.amount = d->rate * d->seconds, .number = s->dab};
    for (int c = 0; c < 3; c++) {
        dab.at.origin[c] = d->at_world.origin[c] / s->step_mm;
        for (int a = 0; a < 3; a++)
            dab.at.axis[a][c] = d->at_world.axis[a][c] / s->step_mm;
    }
    status outcome = tool_apply(t, &dab, &s->clay, &s->scratch, counts_out);
    if (outcome == STATUS_OK)
        s->dab++;
    return outcome;
}

status sculpture_apply_surface(sculpture *s, surface_counts *counts_out)
{
    status outcome = surface_update(&s->surface, &s->clay, counts_out);
    if (outcome == STATUS_OK)
        dirt_clear(&s->clay.dirty);
    else if (s->in_stroke)
        stroke_revert(s);
    return outcome;
}

status sculpture_apply(sculpture *s, const tool *t, const sculpture_dab *d, sculpture_counts *counts_out)
{
    if (counts_out)
        memset(counts_out, 0, sizeof *counts_out);
    status outcome = sculpture_apply_field(s, t, d, counts_out ? &counts_out->tool : NULL);
    return outcome == STATUS_OK ? sculpture_apply_surface(s, counts_out ? &counts_out->surface : NULL) : outcome;
}

status sculpture_stroke_end(sculpture *s)
{
    assert(s->in_stroke);
    s->stroke_changed = s->stroke_changed || change_count(&s->clay.changes) > 0;
    const status outcome = s->has_history ? keeping_hand(s, true) : STATUS_OK;
    if (outcome != STATUS_OK) {
        stroke_revert(s);
        return outcome;
    }
    clay_change_end(&s->clay);
    s->in_stroke = false;
    s->strokes += s->stroke_changed;
    return STATUS_OK;
}

/* --- back and forth --- */

void sculpture_step_begin(sculpture *s, history_way way, uint64_t stroke)
{
    assert(!s->in_stroke && !s->jobs.fetch);
    if (!s->has_history)
        return;
    keeper_job *job = keeping_job(s, KEEPER_FETCH);
    job->way = way;
    job->stroke = stroke;
    s->jobs.fetch = job;
    keeping_send(s, job);
}

bool sculpture_step_is_ready(sculpture *s)
{
    return !s->jobs.fetch || s->keeper.is_done(s->keeper.self, s->jobs.fetch);
}

/* The clay and its surface go the way, or stay. */
static status go(sculpture *s, const route *way)
{
    surface_counts counts;
    status outcome = route_apply(way, &s->clay);
    if (outcome == STATUS_OK) {
        outcome = surface_update(&s->surface, &s->clay, &counts);
        if (outcome != STATUS_OK)
            clay_change_revert(&s->clay);
        else
            clay_change_end(&s->clay);
    }
    if (outcome != STATUS_OK)
        surface_put_back(s);
    dirt_clear(&s->clay.dirty);
    return outcome;
}

status sculpture_step_end(sculpture *s)
{
    keeper_job *fetch = s->jobs.fetch;
    if (!fetch)
        return STATUS_HISTORY_ENDS;
    s->keeper.await(s->keeper.self, fetch);
    status outcome = fetch->outcome;
    if (outcome == STATUS_OK)
        outcome = go(s, &fetch->found);
    if (outcome == STATUS_OK || (outcome == STATUS_CORRUPT && fetch->outcome == STATUS_OK)) {
        keeper_job *job = keeping_job(s, outcome == STATUS_OK ? KEEPER_MOVE : KEEPER_REFUSE);
        job->found = fetch->found;
        memset(&fetch->found, 0, sizeof fetch->found);
        keeping_send(s, job);
    }
    s->jobs.fetch = NULL;
    keeping_take(s);
    return outcome;
}

status sculpture_step(sculpture *s, history_way way, uint64_t stroke)
{
    sculpture_step_begin(s, way, stroke);
    return sculpture_step_end(s);
}

status sculpture_undo(sculpture *s) { return sculpture_step(s, HISTORY_BACK, 0); }
status sculpture_redo(sculpture *s) { return sculpture_step(s, HISTORY_FORTH, 0); }

/* --- the piece as a whole --- */

status sculpture_duplicate(const sculpture *s, freeform *tool_out) { return freeform_init(tool_out, &s->clay); }

static const brick_mask every_corner = BRICK_MASK_ALL;

static status brick_set(clay *c, key at, const brick_page *page)
{
    uint32_t id;
    status outcome = clay_brick_open(c, at, &id);
    if (outcome != STATUS_OK)
        return outcome;
    if (page)
        *clay_brick(c, id)->page = *page;
    else
        memset(clay_brick(c, id)->page, 0, sizeof(brick_page));
    return clay_brick_close(c, id, &every_corner);
}

/* Sets the clay brick by brick to what `with` holds; NULL empties it. Part of a stroke. */
static status clay_replace(clay *c, const clay *with)
{
    avl_walk w;
    key at;
    uint32_t id;
    status outcome = STATUS_OK;
    for (bool more = avl_first(&w, &c->tree, &at, &id); more && outcome == STATUS_OK; more = avl_next(&w, &at, &id))
        if (!with || clay_find(with, at) == POOL_NONE)
            outcome = brick_set(c, at, NULL);
    clay_prune(c);
    if (!with || outcome != STATUS_OK)
        return outcome;
    for (bool more = avl_first(&w, &with->tree, &at, &id); more && outcome == STATUS_OK; more = avl_next(&w, &at, &id))
        outcome = brick_set(c, at, clay_brick(with, id)->page);
    return outcome;
}

static status replace_as_stroke(sculpture *s, const clay *with)
{
    surface_counts counts;
    sculpture_stroke_begin(s);
    status outcome = clay_replace(&s->clay, with);
    if (outcome != STATUS_OK) {
        stroke_revert(s);
        return outcome;
    }
    outcome = sculpture_apply_surface(s, &counts);
    return outcome == STATUS_OK ? sculpture_stroke_end(s) : outcome;
}

status sculpture_clear(sculpture *s) { return replace_as_stroke(s, NULL); }

status sculpture_read(sculpture *s, checkpoint_source source, void *self, checkpoint_trouble *trouble_out)
{
    clay read;
    checkpoint_facts facts;
    status outcome = clay_init(&read, s->clay.bricks.limit);
    if (outcome != STATUS_OK)
        return outcome;
    outcome = checkpoint_read(&read, &facts, source, self, trouble_out);
    bool fresh = !s->has_history && clay_brick_count(&s->clay) == 0;
    if (outcome == STATUS_OK && !fresh && facts.step_mm != s->step_mm)
        outcome = STATUS_BAD_PARAMETER;
    if (outcome == STATUS_OK)
        outcome = replace_as_stroke(s, &read);
    if (outcome == STATUS_OK && fresh)
        s->step_mm = facts.step_mm;
    clay_finish(&read);
    return outcome;
}

status sculpture_check(const byte_store *store, check_teller tell, void *self, check_facts *facts_out)
{
    return check_run(store, tell, self, facts_out);
}

uint64_t sculpture_digest_of(double step_mm, uint64_t digest)
{
    return digest_bytes(&step_mm, sizeof step_mm, digest);
}

static void bounds_take(const patch *p, double step_mm, double lo[3], double hi[3])
{
    const int32_t at[3] = {p->at.i, p->at.j, p->at.k};
    for (uint32_t n = 0; n < p->vertex_count; n++) {
        for (int a = 0; a < 3; a++) {
            const double mm = step_mm * ((double)at[a] * BRICK_EDGE + (double)p->vertices[n].position[a]);
            lo[a] = mm < lo[a] ? mm : lo[a];
            hi[a] = mm > hi[a] ? mm : hi[a];
        }
    }
}

bool sculpture_bounds_mm(const sculpture *s, double lo_out[3], double hi_out[3])
{
    double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t slot = 0; slot < surface_slots(&s->surface); slot++) {
        const patch *p = surface_patch(&s->surface, slot);
        if (p)
            bounds_take(p, s->step_mm, lo, hi);
    }
    if (!(lo[0] <= hi[0]))
        return false;
    memcpy(lo_out, lo, sizeof lo);
    memcpy(hi_out, hi, sizeof hi);
    return true;
}

uint64_t sculpture_digest(const sculpture *s) { return sculpture_digest_of(s->step_mm, clay_digest(&s->clay)); }

status sculpture_set_aside(const byte_store *store, const char *file)
{
    const stored_file f = {store, file};
    return stored_file_set_aside(&f);
}
