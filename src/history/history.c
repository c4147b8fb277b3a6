/* SPDX-License-Identifier: Apache-2.0 */
#include "history/history.h"

#include "clay/digest.h"
#include "clay/sieve_rows.h"
#include "history/recovery.h"
#include "history/sentence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A record's bricks take this much at most, and a quarter of an undo-file: what does not fit its end is little. */
enum { RECORD_BYTES_MOST = 256 * 1024 };

/* --- opening and closing --- */

static bool settings_are_good(const history_settings *s, double step_mm)
{
    return s->strokes >= 1 && s->strokes <= HISTORY_STROKES_MAX && s->file_bytes >= RING_FILE_BYTES_MIN &&
           s->file_bytes % RECORD_BLOCK_BYTES == 0 && s->file_bytes <= s->budget_bytes && isfinite(step_mm) &&
           step_mm > 0;
}

static status mark_all(clay *c)
{
    const brick_mask all = BRICK_MASK_ALL;
    avl_walk w;
    key at;
    uint32_t id;
    status s = STATUS_OK;
    dirt_clear(&c->dirty);
    for (bool more = avl_first(&w, &c->tree, &at, &id); s == STATUS_OK && more; more = avl_next(&w, &at, &id))
        s = clay_mark(c, at, &all);
    return s;
}

static uint64_t size_of(const history *h, const char *name)
{
    uint64_t bytes = 0;
    bool exists = false;
    return h->store.size(h->store.self, name, &bytes, &exists) == STATUS_OK && exists ? bytes : 0;
}

static void measure(history *h)
{
    reserve_open(&h->reserve, &h->store);
    h->field_bytes = size_of(h, HISTORY_FIELD_NAME);
    h->before_bytes = size_of(h, HISTORY_FIELD_BEFORE_NAME);
}

status history_open(history *h, byte_store store, const history_settings *settings, double step_mm, clay *c,
                    history_finding *finding_out)
{
    assert(clay_brick_count(c) == 0 && !c->changes.recording);
    finding_out->text[0] = '\0';
    *h = (history){.store = store, .settings = *settings, .step_mm = step_mm};
    if (!settings_are_good(settings, step_mm))
        return STATUS_BAD_PARAMETER;
    h->packs = packing_open();
    status s = ring_open(&h->ring, &h->store);
    if (s == STATUS_OK)
        s = recovery_run(h, c, finding_out);
    if (s == STATUS_OK)
        measure(h);
    if (s == STATUS_OK)
        s = mark_all(c);
    if (s != STATUS_OK) {
        clay_clear(c);
        history_close(h);
    }
    return s;
}

static void held_free(history_held *first)
{
    while (first) {
        history_held *next = first->next;
        free(first);
        first = next;
    }
}

void history_close(history *h)
{
    held_free(h->held_first);
    h->held_first = h->held_last = NULL;
    free(h->writer);
    h->writer = NULL;
    packing_close(h->packs);
    h->packs = NULL;
    tree_finish(&h->tree);
    ring_close(&h->ring);
}

status history_room(const history *h)
{
    if (h->medium == HISTORY_MEDIUM_FULL || (h->medium == HISTORY_MEDIUM_GOOD && h->spent))
        return STATUS_NO_SPACE;
    if (h->held_bytes > h->settings.held_bytes)
        return h->medium == HISTORY_MEDIUM_GOOD ? STATUS_NO_MEMORY : STATUS_IO;
    return STATUS_OK;
}

/* --- what was done, as records in memory --- */

static uint64_t brick_digest(key at, const brick_page *page, lanes rows)
{
    brick_mask mask;
    return page && sieve_rows_stored(page, &mask, rows) > 0 ? digest_brick(at, page) : 0;
}

static size_t record_bytes_most(const history *h)
{
    const uint64_t quarter = h->settings.file_bytes / 4;
    return quarter < RECORD_BYTES_MOST ? (size_t)quarter : RECORD_BYTES_MOST;
}

/* Records laid out, not yet put. */
typedef struct layout {
    history_held *first, *last;
    uint64_t digest, bytes;
    uint8_t *bricks; /* of the record that is being laid out, not packed */
} layout;

static void layout_add(layout *l, history_held *held)
{
    held->next = NULL;
    if (l->last)
        l->last->next = held;
    else
        l->first = held;
    l->last = held;
    l->bytes += RECORD_HEADER_BYTES + held->r.stored;
}

/* A record of the bricks in l->bricks, as it will lie on the medium. */
static status layout_add_packed(layout *l, const record *r, packing *with)
{
    const size_t room = sizeof(history_held) + RECORD_HEADER_BYTES;
    history_held *held = (history_held *)malloc(room + (size_t)r->bytes);
    if (!held)
        return STATUS_NO_MEMORY;
    held->r = *r;
    record_pack(&held->r, with, (uint8_t *)held + room, l->bricks);
    history_held *fits = (history_held *)realloc(held, room + (size_t)held->r.stored);
    held = fits ? fits : held;
    held->bytes = (uint8_t *)(held + 1);
    layout_add(l, held);
    return STATUS_OK;
}

/* As many bricks as one record takes, from *at on; no record when none of them changed. */
static status lay_record(const history *h, const delta *d, lanes rows, uint32_t *at, layout *l)
{
    const size_t most = record_bytes_most(h);
    record r = {.digest_before = l->digest};
    for (; *at < d->count && r.bytes + RECORD_BRICK_BYTES_MAX <= most; ++*at) {
        const delta_brick *b = &d->bricks[*at];
        const size_t took = record_put_brick(l->bricks + r.bytes, b->at, b->old, b->now, rows);
        r.bytes += took;
        r.bricks += took > 0;
        if (took > 0)
            l->digest += brick_digest(b->at, b->now, rows) - brick_digest(b->at, b->old, rows);
    }
    r.digest_after = l->digest;
    return r.bricks > 0 ? layout_add_packed(l, &r, h->packs) : STATUS_OK;
}

/* All of a delta. On failure there is nothing to free. */
static status layout_fill(layout *l, const history *h, const delta *d, lanes rows)
{
    l->bricks = (uint8_t *)malloc(record_bytes_most(h) + SIEVE_ROWS_SLACK_BYTES);
    status s = l->bricks ? STATUS_OK : STATUS_NO_MEMORY;
    for (uint32_t at = 0; s == STATUS_OK && at < d->count;)
        s = lay_record(h, d, rows, &at, l);
    free(l->bricks);
    if (s != STATUS_OK)
        held_free(l->first);
    return s;
}

/* Takes the layout over: its records have their numbers from now on. */
static void put(history *h, const layout *l)
{
    for (history_held *held = l->first; held; held = held->next) {
        held->r.sequence = ++h->sequence;
        held->r.step_mm = h->step_mm;
        held->r.dab = h->dab;
        held->r.cursor = h->tree.cursor;
        held->r.tip = h->tree.tip;
    }
    if (h->held_last)
        h->held_last->next = l->first;
    else
        h->held_first = l->first;
    h->held_last = l->last;
    h->held_bytes += l->bytes;
    h->put_since += l->bytes;
    h->digest = l->digest;
}

/* Checkpoints should not cost more writing than strokes do: a large piece waits for more of them, but not for ever,
   because no undo-file can be written anew before (H3), and opening goes over all of them. */
static void checkpoint_when_due(history *h)
{
    const uint64_t strokes = h->settings.strokes, bytes = h->settings.budget_bytes / 8;
    const bool pays = h->put_since > h->field_bytes / 2;
    if ((pays && h->strokes_since > strokes / 4) || h->strokes_since > strokes || h->put_since > bytes)
        h->wants_field = true;
}

status history_put(history *h, const delta *d, uint64_t dab, bool ends, lanes rows)
{
    layout l = {.digest = h->digest};
    status s = layout_fill(&l, h, d, rows);
    if (s != STATUS_OK)
        return s;
    const bool begins = !h->in_stroke;
    const tree_stroke stroke = {.stroke = begins ? h->stroke + 1 : h->stroke,
                                .parent = begins ? h->tree.cursor : 0,
                                .digest_before = h->digest,
                                .digest_after = l.digest};
    if (l.first)
        s = tree_put(&h->tree, stroke); /* one that is there keeps its parent */
    if (s != STATUS_OK || !l.first) {
        held_free(l.first);
        h->in_stroke = h->in_stroke && !(s == STATUS_OK && ends);
        return s;
    }
    if (begins) {
        h->stroke++;
        h->part = 0;
        h->strokes_since++;
    }
    h->tree.cursor = h->tree.tip = h->stroke;
    h->dab = dab;
    for (history_held *held = l.first; held; held = held->next) {
        held->r.stroke = h->stroke;
        held->r.parent = tree_find(&h->tree, h->stroke)->parent;
        held->r.part = h->part++;
        held->r.marks = held->next ? 0 : RECORD_WHOLE;
    }
    put(h, &l);
    h->in_stroke = !ends;
    checkpoint_when_due(h);
    return STATUS_OK;
}

status history_move(history *h, const route *gone)
{
    assert(gone->from == h->tree.cursor && !h->in_stroke);
    h->tree.cursor = gone->cursor;
    h->tree.tip = gone->tip;
    layout l = {.digest = gone->digest_after};
    history_held *held = (history_held *)malloc(sizeof *held + RECORD_HEADER_BYTES);
    if (!held) { /* only that the person went there is forgotten by a power cut: strokes know where they began */
        h->digest = gone->digest_after;
        return STATUS_NO_MEMORY;
    }
    held->bytes = (uint8_t *)(held + 1);
    held->r = (record){
        .marks = RECORD_WHOLE, .digest_before = gone->digest_before, .digest_after = gone->digest_after};
    layout_add(&l, held);
    put(h, &l);
    checkpoint_when_due(h);
    return STATUS_OK;
}

/* --- reading a way --- */

/* What reading a stroke is about. */
typedef struct reading {
    const history *h;
    route *into;
    uint64_t stroke;
    uint32_t part, group; /* the next ones */
    uint64_t digest_before, digest_after;
} reading;

/* Takes `own` over: the record's bricks, in memory of their own. */
static status take_record(reading *g, const record *r, uint8_t *own)
{
    const bool follows = r->part == g->part && (r->part == 0 || r->digest_before == g->digest_after);
    status s = follows ? route_add(g->into, own, (size_t)r->bytes, g->group) : STATUS_CORRUPT;
    if (s != STATUS_OK) {
        free(own);
        return s;
    }
    if (r->part == 0)
        g->digest_before = r->digest_before;
    g->digest_after = r->digest_after;
    g->part++;
    g->group += (r->marks & RECORD_WHOLE) != 0;
    return STATUS_OK;
}

static status take_kept(reading *g, uint32_t file, uint64_t offset, const record *r)
{
    byte_buffer buffer = {NULL, 0, 0};
    status s = ring_read_bricks(&g->h->ring, file, offset, r, &buffer);
    if (s == STATUS_OK)
        return take_record(g, r, buffer.bytes);
    byte_buffer_finish(&buffer);
    return s;
}

static status take_held(reading *g, const history_held *held)
{
    uint8_t *own = (uint8_t *)malloc((size_t)held->r.bytes);
    status s = own ? record_unpack(&held->r, held->bytes + RECORD_HEADER_BYTES, own) : STATUS_NO_MEMORY;
    if (s == STATUS_OK)
        return take_record(g, &held->r, own);
    free(own);
    return s;
}

static status read_file(reading *g, uint32_t file)
{
    const ring *of = &g->h->ring;
    const ring_file *f = &of->files[file];
    status s = STATUS_OK;
    for (uint64_t offset = 0; s == STATUS_OK && offset < f->end;) {
        record r;
        s = ring_read_header(of, file, offset, &r);
        if (s == STATUS_OK && r.use != f->use)
            s = STATUS_CORRUPT;
        if (s != STATUS_OK || r.sequence > f->last)
            break;
        if (r.stroke == g->stroke)
            s = take_kept(g, file, offset, &r);
        offset += record_span(r.stored);
    }
    return s;
}

/* All of a stroke, first part first. */
static status read_stroke(reading *g)
{
    const ring *of = &g->h->ring;
    status s = STATUS_OK;
    uint64_t use = 0;
    for (uint32_t file; s == STATUS_OK && (file = ring_next_file(of, g->stroke, use)) != RING_NONE;) {
        use = of->files[file].use;
        s = read_file(g, file);
    }
    for (const history_held *held = g->h->held_first; s == STATUS_OK && held; held = held->next)
        if (held->r.stroke == g->stroke)
            s = take_held(g, held);
    const tree_stroke *known = tree_find(&g->h->tree, g->stroke);
    if (s == STATUS_OK && (g->part == 0 || g->digest_before != known->digest_before ||
                           g->digest_after != known->digest_after))
        s = STATUS_CORRUPT;
    return s;
}

static status read_leg(const history *h, tree_leg leg, route *into)
{
    reading g = {.h = h, .into = into, .stroke = leg.stroke};
    const uint32_t from = into->count;
    g.group = from > 0 ? into->legs[from - 1].group + 1 : 0;
    status s = read_stroke(&g);
    if (s == STATUS_OK && (leg.back ? g.digest_after : g.digest_before) != into->digest_after)
        s = STATUS_CORRUPT;
    if (s != STATUS_OK)
        return s;
    if (leg.back)
        route_reverse(into, from);
    into->digest_after = leg.back ? g.digest_before : g.digest_after;
    return STATUS_OK;
}

/* Where the way ends; the cursor when there is none. */
static uint64_t target_of(const history *h, history_way way, uint64_t stroke)
{
    switch (way) {
    case HISTORY_BACK: return tree_undo(&h->tree);
    case HISTORY_FORTH: return tree_redo(&h->tree);
    case HISTORY_FORK: return tree_fork(&h->tree);
    case HISTORY_TO: break;
    }
    return tree_leads(&h->tree, h->tree.cursor, stroke) ? stroke : h->tree.cursor;
}

/* A stroke that cannot be gone over: it is no more, and its files will be set aside. */
static void lose(history *h, uint64_t stroke)
{
    sentence text = sentence_begin(h->trouble.text, sizeof h->trouble.text);
    sentence_add(&text, "stroke ");
    sentence_add_number(&text, stroke, 1);
    sentence_add(&text, " cannot be gone over: its undo-file is damaged and will be set aside");
    for (uint32_t n = 0; n < h->ring.count; n++)
        if (h->ring.files[n].stroke == stroke)
            h->ring.files[n].spoilt = true;
    tree_forget(&h->tree, stroke);
    h->wants_field = true;
}

status history_fetch(history *h, history_way way, uint64_t stroke, route *route_out)
{
    const uint64_t to = target_of(h, way, stroke);
    if (to == h->tree.cursor)
        return STATUS_HISTORY_ENDS;
    route *r = route_out;
    *r = (route){.from = h->tree.cursor, .digest_before = h->digest, .digest_after = h->digest};
    status s = STATUS_OK;
    tree_leg leg = {0, false, 0};
    for (uint64_t at = r->from; s == STATUS_OK && at != to; at = leg.to) {
        leg = tree_next(&h->tree, at, to);
        assert(leg.stroke != 0);
        r->first = r->first ? r->first : leg.stroke;
        s = read_leg(h, leg, r);
    }
    if (s != STATUS_OK) {
        route_finish(r);
        if (s == STATUS_CORRUPT)
            lose(h, leg.stroke);
        return s;
    }
    r->cursor = to;
    /* The tip stays where it is as long as redo leads there. */
    r->tip = to <= h->tree.tip && tree_next(&h->tree, to, h->tree.tip).back == false ? h->tree.tip
                                                                                      : tree_tip_of(&h->tree, to);
    return STATUS_OK;
}

void history_refuse(history *h, const route *refused) { lose(h, refused->first); }
