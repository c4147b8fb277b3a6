/* SPDX-License-Identifier: Apache-2.0 */
/* What history.h does with the medium once it is open: which undo-file is written, and what is done beside. */
#include "history/history.h"

#include "history/sentence.h"
#include "history/stored_file.h"

#include <stdlib.h>

#define FIELD_TEMPORARY HISTORY_FIELD_NAME ".new"

enum {
    SYNC_BYTES = 8 * 1024 * 1024, /* of a checkpoint, between two syncs: the last one should not take long */
    FIELDS_TO_GET_BENEATH = 2,
    GIVEN_BYTES = 256 * 1024, /* from the reserve to a checkpoint, at a time */
};

static void tell(history *h, const char *what, status why)
{
    sentence text = sentence_begin(h->trouble.text, sizeof h->trouble.text);
    sentence_add(&text, what);
    sentence_add(&text, ": ");
    sentence_add(&text, status_text(why));
}

/* --- which undo-file may be written anew --- */

/* The newest record that is in both checkpoints. Until there are two, empty clay stands for the older. */
static uint64_t beneath(const history *h)
{
    if (!h->field.there || !h->before.there)
        return 0;
    return h->field.sequence < h->before.sequence ? h->field.sequence : h->before.sequence;
}

/* Does the way from a checkpoint, also from one that is being written, to this state go over the stroke? */
static bool is_on_a_way(const history *h, uint64_t state, uint64_t stroke)
{
    return tree_passes(&h->tree, h->field.cursor, state, stroke) ||
           tree_passes(&h->tree, h->before.cursor, state, stroke) ||
           (h->writer && tree_passes(&h->tree, h->writing.cursor, state, stroke));
}

/* H3, for a stroke. Until all is kept, a cut may leave the clay at any state since the last one that was. */
static bool may_go(const history *h, uint64_t stroke)
{
    for (uint32_t n = 0; n < h->ring.count; n++)
        if (h->ring.files[n].stroke == stroke && h->ring.files[n].last > beneath(h))
            return false;
    for (const history_held *held = h->held_first; held; held = held->next)
        if (held->r.stroke == stroke || is_on_a_way(h, held->r.cursor, stroke))
            return false;
    return beneath(h) > 0 && !is_on_a_way(h, h->kept_cursor, stroke) && !is_on_a_way(h, h->tree.cursor, stroke);
}

/* Forgets the oldest stroke that nothing else is lost with, if it may go and is not the only one. */
static bool forget_one(history *h)
{
    const uint64_t spare = h->tree.count > 1 ? tree_spare(&h->tree) : 0;
    if (spare == 0)
        return false;
    if (!may_go(h, spare))
        return false;
    tree_forget(&h->tree, spare);
    return true;
}

/* Frees the files that nobody needs; spoilt ones are set aside. */
static void reclaim(history *h)
{
    for (uint32_t n = 0; n < h->ring.count; n++) {
        ring_file *f = &h->ring.files[n];
        if (f->bytes == 0 || f->free || n == h->ring.current || f->last > beneath(h))
            continue;
        if (f->stroke != 0 && tree_find(&h->tree, f->stroke))
            continue;
        f->free = !f->spoilt;
        const bool small = f->free && f->bytes < h->settings.file_bytes / 2; /* file_from_reserve made it */
        if (f->spoilt || small) {
            status s = small ? ring_remove(&h->ring, n) : ring_set_aside(&h->ring, n);
            (void)s; /* another time */
        }
    }
}

/* Files that other settings made, or that were cut short, are good for as long as a record fits. */
static uint32_t free_file(history *h)
{
    reclaim(h);
    return ring_free_file(&h->ring, h->settings.file_bytes / 2);
}

/* --- a medium that is full: H7 --- */

/* Undo reaches less far, and the medium has room for an undo-file more. */
static bool space_from_undo(history *h)
{
    uint32_t file = free_file(h);
    while (file == RING_NONE && forget_one(h))
        file = free_file(h);
    return file != RING_NONE && ring_remove(&h->ring, file) == STATUS_OK;
}

/* As long as what is held of one stroke, and a file at the most. */
static uint64_t least_file(const history *h)
{
    uint64_t bytes = 0, stroke = 0;
    for (const history_held *held = h->held_first; held; held = held->next) {
        stroke = stroke ? stroke : held->r.stroke;
        if (held->r.stroke != 0 && held->r.stroke != stroke)
            break;
        bytes += record_span(held->r.stored);
    }
    bytes = bytes > RING_FILE_BYTES_MIN ? bytes : RING_FILE_BYTES_MIN;
    return bytes < h->settings.file_bytes ? bytes : h->settings.file_bytes;
}

/* For what is made already: as small as it can be, since nobody knows how much is still to come. */
static status file_from_reserve(history *h, uint32_t *file_out)
{
    const uint64_t bytes = least_file(h);
    status s = h->ring.count < RING_FILES_MAX ? ring_make(&h->ring, bytes, file_out) : STATUS_NO_SPACE;
    while (s == STATUS_NO_SPACE && h->ring.count < RING_FILES_MAX && reserve_give(&h->reserve, bytes) > 0)
        s = ring_make(&h->ring, bytes, file_out);
    h->fields_owed = FIELDS_TO_GET_BENEATH;
    h->reserve_aim = 0;
    h->spent = s == STATUS_OK && !h->field_short &&
               h->reserve.bytes < h->settings.reserve_files * h->settings.file_bytes / 2;
    return s;
}

/* What the reserve must hold for checkpoints of so many bytes: the second has the place that the first makes free. */
static uint64_t reserve_for(const history *h, uint64_t field)
{
    const uint64_t freed = h->before_bytes < field ? h->before_bytes : field;
    return 2 * field - freed + h->settings.reserve_files * h->settings.file_bytes;
}

/* Begins or ends its growing. A quarter more than the last checkpoint had, and let be between that and its double. */
static void reserve_aim(history *h)
{
    uint64_t field = h->field_bytes > h->field_missed ? h->field_bytes : h->field_missed;
    field = field > 0 ? field : h->put_since;
    const uint64_t whole = h->settings.reserve_files > 0 ? reserve_for(h, field + field / 4) : 0;
    const bool may = !h->reserve_tried && !h->reserve.spoilt && h->medium == HISTORY_MEDIUM_GOOD &&
                     !(h->fields_owed > 0 && h->wants_field);
    if (h->reserve_aim > 0 || !may)
        return;
    if (h->reserve.bytes > 2 * whole)
        reserve_give(&h->reserve, h->reserve.bytes - whole);
    else if (whole > 0 && h->reserve.bytes < reserve_for(h, field))
        h->reserve_aim = whole;
}

/* A tape brings strokes faster than there is time for what can wait: with each file that is made for several of them
   the reserve grows, or it would not be there when they have filled the medium. */
static void reserve_beside(history *h)
{
    bool done = false;
    if (h->held_first->r.stroke == h->held_last->r.stroke)
        return;
    reserve_aim(h);
    if (h->reserve_aim == 0)
        return;
    const status s = reserve_grow(&h->reserve, h->reserve_aim, &done);
    h->reserve_aim = s == STATUS_OK && !done ? h->reserve_aim : 0;
    h->reserve_tried = s != STATUS_OK;
}

/* An undo-file to begin. When the medium is full, undo reaches less far. */
static status file_take(history *h, uint32_t *file_out)
{
    status s = STATUS_NO_SPACE;
    *file_out = h->medium == HISTORY_MEDIUM_FAILS ? RING_NONE : free_file(h);
    if (*file_out != RING_NONE)
        return STATUS_OK;
    const bool within_budget = h->ring.bytes + h->settings.file_bytes <= h->settings.budget_bytes;
    if (within_budget || h->medium == HISTORY_MEDIUM_FAILS)
        s = ring_make(&h->ring, h->settings.file_bytes, file_out);
    if (s == STATUS_OK)
        reserve_beside(h);
    while (s == STATUS_NO_SPACE && *file_out == RING_NONE && forget_one(h))
        if ((*file_out = free_file(h)) != RING_NONE)
            s = STATUS_OK;
    h->wants_field = h->wants_field || (s == STATUS_NO_SPACE && !h->field_short); /* what may not go now will then */
    if (s == STATUS_NO_SPACE && !within_budget)
        s = ring_make(&h->ring, h->settings.file_bytes, file_out);
    if (s == STATUS_NO_SPACE)
        s = file_from_reserve(h, file_out);
    return s;
}

/* The medium took what was held: it is not what it was. */
static void has_room_again(history *h)
{
    h->field_short = h->reserve_tried = h->spent = false;
    h->wants_field = h->wants_field || h->fields_owed > 0;
}

/* --- keeping --- */

static bool goes_into(const history *h, uint32_t file, const record *r)
{
    return file != RING_NONE && (r->stroke == 0 || r->stroke == h->ring.files[file].stroke) &&
           ring_has_room(&h->ring, file, r->stored);
}

static void held_drop(history *h, const history_held *end)
{
    while (h->held_first != end) {
        history_held *held = h->held_first;
        h->held_first = held->next;
        if (held->r.marks & RECORD_WHOLE) {
            h->kept_cursor = held->r.cursor;
            h->kept_digest = held->r.digest_after;
        }
        h->held_bytes -= RECORD_HEADER_BYTES + held->r.stored;
        free(held);
    }
    if (!h->held_first)
        h->held_last = NULL;
}

/* As many of the records as one file takes: written, synced, and only then kept. */
static status keep_batch(history *h)
{
    uint32_t file = h->ring.current;
    status s = STATUS_OK;
    if (!goes_into(h, file, &h->held_first->r)) {
        s = file_take(h, &file);
        if (s != STATUS_OK)
            return s;
        ring_begin(&h->ring, file, h->held_first->r.stroke);
    }
    const ring_file was = h->ring.files[file];
    history_held *held = h->held_first;
    uint64_t seal = h->seal, last = h->kept;
    while (s == STATUS_OK && held && goes_into(h, file, &held->r)) {
        held->r.before = seal;
        held->r.kept = h->kept;
        s = ring_write(&h->ring, file, &held->r, held->bytes);
        seal = held->r.seal;
        last = held->r.sequence;
        held = held->next;
    }
    if (s == STATUS_OK)
        s = h->store.sync(h->store.self, ring_name_of(file).text);
    if (s != STATUS_OK) { /* H5 */
        h->ring.files[file] = was;
        h->ring.files[file].spoilt = true;
        h->ring.current = RING_NONE;
        return s;
    }
    h->seal = seal;
    h->kept = last;
    held_drop(h, held);
    return STATUS_OK;
}

status history_keep(history *h)
{
    status s = STATUS_OK;
    bool tried = h->medium == HISTORY_MEDIUM_FAILS;
    while (h->held_first) {
        s = keep_batch(h);
        if (s != STATUS_OK && (tried || s != STATUS_IO))
            break;
        tried = tried || s != STATUS_OK;
    }
    if (s == STATUS_OK || !h->held_first) {
        if (h->medium != HISTORY_MEDIUM_GOOD)
            has_room_again(h);
        h->medium = HISTORY_MEDIUM_GOOD;
    } else {
        h->medium = s == STATUS_NO_SPACE ? HISTORY_MEDIUM_FULL : HISTORY_MEDIUM_FAILS;
        tell(h, "what was made last is only in memory", s);
    }
    while (h->tree.count > h->settings.strokes && forget_one(h))
        continue;
    return s;
}

/* --- checkpoints --- */

static status field_put(void *self, const void *bytes, size_t n)
{
    history *h = (history *)self;
    status s = STATUS_NO_SPACE;
    do
        s = h->store.write(h->store.self, FIELD_TEMPORARY, h->written, bytes, n);
    while (s == STATUS_NO_SPACE && (reserve_give(&h->reserve, GIVEN_BYTES) > 0 || space_from_undo(h)));
    h->written += s == STATUS_OK ? n : 0;
    h->unsynced += s == STATUS_OK ? n : 0;
    return s;
}

status history_field_begin(history *h, const clay *c)
{
    assert(!h->writer && !h->in_stroke);
    status s = history_keep(h); /* the seal of its last record must be known */
    if (s != STATUS_OK)
        return s;
    h->wants_field = false; /* whatever becomes of it, it is not begun again at once */
    h->reserve_aim = 0;
    s = h->store.remove(h->store.self, FIELD_TEMPORARY);
    h->writer = s == STATUS_OK ? (checkpoint_writer *)malloc(sizeof *h->writer) : NULL;
    h->spent = h->spent && h->writer;
    if (!h->writer)
        return s == STATUS_OK ? STATUS_NO_MEMORY : s;
    h->writing = (checkpoint_facts){.step_mm = h->step_mm,
                                    .sequence = h->sequence,
                                    .cursor = h->tree.cursor,
                                    .tip = h->tree.tip,
                                    .seal = h->seal,
                                    .dab = h->dab,
                                    .digest = h->digest};
    h->written = h->unsynced = 0;
    h->strokes_since = 0;
    h->put_since = 0;
    checkpoint_writer_begin(h->writer, c, &h->writing, h->packs, field_put, h);
    return STATUS_OK;
}

/* The new one takes its place, and the one that had it is the one before. At no time is there none. h->field says which
   one lies under its name, if one does; `there`, that it is known to. */
static status field_place(history *h)
{
    const byte_store *store = &h->store;
    const stored_file placed = {store, HISTORY_FIELD_NAME};
    uint64_t bytes;
    bool exists = false;
    status s = store->sync(store->self, FIELD_TEMPORARY);
    if (s == STATUS_OK)
        s = store->size(store->self, HISTORY_FIELD_NAME, &bytes, &exists);
    const bool unread = exists && !h->field.there && h->field.sequence == 0; /* opening could not read it: H6 */
    if (s == STATUS_OK && unread)
        s = stored_file_set_aside(&placed);
    if (s == STATUS_OK && exists && !unread) {
        h->before.there = false;
        s = store->rename(store->self, HISTORY_FIELD_NAME, HISTORY_FIELD_BEFORE_NAME);
        if (s == STATUS_OK) {
            h->before = (history_base){true, h->field.sequence, h->field.cursor};
            h->before_bytes = h->field_bytes;
        }
    }
    if (s != STATUS_OK)
        return s;
    h->field = (history_base){false, h->writing.sequence, h->writing.cursor};
    s = store->rename(store->self, FIELD_TEMPORARY, HISTORY_FIELD_NAME);
    h->field.there = s == STATUS_OK;
    h->field_bytes = h->written;
    return s;
}

static void field_placed(history *h)
{
    h->fields_owed -= h->fields_owed > 0;
    h->wants_field = h->wants_field || h->fields_owed > 0;
    h->spent = h->spent && h->fields_owed > 0;
    h->field_missed = 0;
    h->field_short = h->reserve_tried = false;
}

static void field_given_up(history *h, status why)
{
    tell(h, "the sculpture as a whole could not be written, its strokes are", why);
    status s = h->store.remove(h->store.self, FIELD_TEMPORARY);
    (void)s; /* the next one does it */
    h->spent = false;
    if (why != STATUS_NO_SPACE)
        return;
    h->wants_field = false;
    h->field_missed = h->written;
    h->field_short = true;
    h->reserve_tried = false;
}

static void field_work(history *h)
{
    bool done = false;
    status s = checkpoint_writer_step(h->writer, HISTORY_SLICE_BYTES, &done);
    if (s == STATUS_OK && !done && h->unsynced >= SYNC_BYTES) {
        s = h->store.sync(h->store.self, FIELD_TEMPORARY);
        h->unsynced = 0;
    }
    if (s == STATUS_OK && done)
        s = field_place(h);
    if (s == STATUS_OK && !done)
        return;
    free(h->writer);
    h->writer = NULL;
    if (s == STATUS_OK)
        field_placed(h);
    else
        field_given_up(h, s);
}

/* --- what can wait --- */

/* A file made before it is needed, or one too many removed. */
static bool files_work(history *h)
{
    const uint64_t bytes = h->settings.file_bytes;
    const uint32_t file = free_file(h);
    if (h->medium != HISTORY_MEDIUM_GOOD)
        return false;
    if (file == RING_NONE && h->tree.count < h->settings.strokes && h->ring.bytes + bytes <= h->settings.budget_bytes) {
        uint32_t made;
        status s = ring_make(&h->ring, bytes, &made);
        (void)s; /* it will be tried again when it is needed, and then told */
        return false;
    }
    if (file == RING_NONE || h->ring.bytes <= h->settings.budget_bytes)
        return false;
    const bool removed = ring_remove(&h->ring, file) == STATUS_OK;
    if (!removed) /* or it is no more, and a record in it would make a file that is too short */
        h->ring.files[file].spoilt = true;
    return removed;
}

/* One slice of it. Where there is no room it takes undo's, as long as undo has more. */
static bool reserve_work(history *h)
{
    bool done = false;
    reserve_aim(h);
    if (h->reserve_aim == 0)
        return false;
    const status s = reserve_grow(&h->reserve, h->reserve_aim, &done);
    if ((s == STATUS_OK && !done) ||
        (s == STATUS_NO_SPACE && h->ring.bytes > h->reserve.bytes && space_from_undo(h)))
        return true;
    h->reserve_aim = 0;
    h->reserve_tried = s != STATUS_OK;
    h->field_short = h->field_short && s != STATUS_OK;
    return false;
}

bool history_work(history *h)
{
    if (h->writer)
        field_work(h);
    else
        return (h->reserve_aim == 0 && files_work(h)) || reserve_work(h);
    return true;
}
