/* SPDX-License-Identifier: Apache-2.0 */
#include "history/recovery.h"

#include "history/cursor_file.h"
#include "history/sentence.h"
#include "history/undo_ring.h"
#include "history/whole_file.h"

#include <stdlib.h>

typedef struct slot {
    undo_ring_slot is;
    bool aside; /* to be set aside when all is decided */
} slot;

/* How much a finding matters to the person; only the greatest is told. */
typedef enum weight { WEIGHT_NONE, WEIGHT_SIDE, WEIGHT_CURSOR, WEIGHT_SCULPTURE, WEIGHT_FIELD } weight;

typedef struct recovery {
    history *h;
    clay *c;
    history_finding *finding;
    weight told;
    cursor_file was; /* when cursor_known */
    bool cursor_exists, cursor_known;
    bool field_exists;
    slot *slots; /* h->ring of them */
} recovery;

/* Is this worth more than what was told? Then the sentence begins anew. */
static bool tells(recovery *r, weight w, sentence *text_out)
{
    if (w <= r->told)
        return false;
    r->told = w;
    *text_out = sentence_begin(r->finding->text, sizeof r->finding->text);
    return true;
}

static void tell(recovery *r, weight w, const char *what, const char *rest)
{
    sentence text;
    if (!tells(r, w, &text))
        return;
    sentence_add(&text, what);
    sentence_add(&text, rest);
}

/* " is damaged at byte 12 (expected ...)" */
static void add_damage(sentence *text, uint64_t offset, const char *expected)
{
    sentence_add(text, " is damaged at byte ");
    sentence_add_number(text, offset, 1);
    sentence_add(text, " (expected ");
    sentence_add(text, expected);
    sentence_add(text, ")");
}

static slot *slot_of(const recovery *r, uint64_t stroke) { return &r->slots[stroke % r->h->ring]; }

static bool holds(const slot *s, uint64_t stroke)
{
    return s->is.state == UNDO_RING_GOOD && s->is.facts.stroke == stroke;
}

/* Does stroke n lead from a clay with this digest in that direction? */
static bool links(const recovery *r, uint64_t n, uint64_t digest, undo_file_direction direction)
{
    const slot *s = slot_of(r, n);
    return holds(s, n) &&
           digest == (direction == UNDO_FILE_FORTH ? s->is.facts.digest_before : s->is.facts.digest_after);
}

static void damage(slot *s, preamble_trouble trouble)
{
    s->is.state = UNDO_RING_DAMAGED;
    s->is.trouble = trouble;
}

/* --- looking --- */

static const char written_by_newer[] = " was written by a newer version of this program";

static status look_at_cursor(recovery *r)
{
    preamble_trouble trouble;
    status s = cursor_file_read(&r->was, &r->h->store, &r->cursor_exists, &trouble);
    r->cursor_known = s == STATUS_OK && r->cursor_exists;
    if (r->cursor_known) {
        r->h->ring = r->was.ring;
        r->h->step_mm = r->was.step_mm;
        r->h->dab = r->was.dab;
    }
    if (s == STATUS_NEWER)
        tell(r, WEIGHT_FIELD, CURSOR_FILE_NAME, written_by_newer);
    return s == STATUS_CORRUPT ? STATUS_OK : s;
}

static status look_at_slots(recovery *r)
{
    free(r->slots);
    r->slots = (slot *)calloc(r->h->ring, sizeof *r->slots);
    if (!r->slots)
        return STATUS_NO_MEMORY;
    for (uint32_t n = 0; n < r->h->ring; n++) {
        status s = undo_ring_look(&r->slots[n].is, &r->h->store, r->h->ring, n);
        if (s == STATUS_NEWER)
            tell(r, WEIGHT_FIELD, undo_ring_name_of(r->h->ring, n).text, written_by_newer);
        if (s != STATUS_OK)
            return s;
    }
    return STATUS_OK;
}

/* The ring that the newest of the undo-files was written into: for when the cursor cannot say it. */
static uint32_t ring_found(const recovery *r)
{
    uint64_t newest = 0;
    uint32_t ring = r->h->ring;
    for (uint32_t n = 0; n < r->h->ring; n++) {
        const undo_ring_slot *s = &r->slots[n].is;
        if (s->state == UNDO_RING_GOOD && s->facts.stroke > newest && s->facts.ring <= HISTORY_RING_MAX) {
            newest = s->facts.stroke;
            ring = s->facts.ring;
        }
    }
    return ring;
}

static status look_at_ring(recovery *r)
{
    status s = look_at_slots(r);
    if (s == STATUS_OK && !r->cursor_known && ring_found(r) != r->h->ring) {
        r->h->ring = ring_found(r);
        s = look_at_slots(r);
    }
    for (uint32_t n = 0; s == STATUS_OK && n < r->h->ring; n++) {
        const undo_file_facts *f = &r->slots[n].is.facts;
        if (r->slots[n].is.state == UNDO_RING_GOOD && (f->ring != r->h->ring || f->stroke % f->ring != n))
            damage(&r->slots[n], (preamble_trouble){16, "a stroke that belongs in this place of the ring"});
    }
    return s;
}

/* --- the base --- */

static status field_get(void *self, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    const byte_store *store = (const byte_store *)self;
    return store->read(store->self, HISTORY_FIELD_NAME, offset, bytes, n, got_out);
}

static status field_set_aside(recovery *r, uint64_t offset, const char *expected)
{
    sentence text;
    if (tells(r, WEIGHT_FIELD, &text)) {
        sentence_add(&text, HISTORY_FIELD_NAME);
        add_damage(&text, offset, expected);
        sentence_add(&text, " and was set aside");
    }
    status s = whole_file_set_aside(&r->h->store, HISTORY_FIELD_NAME);
    return s == STATUS_OK ? STATUS_CORRUPT : s;
}

static status read_base(recovery *r)
{
    history *h = r->h;
    uint64_t size;
    h->cursor = 0;
    h->digest = 0; /* clay_digest of empty clay */
    status s = h->store.size(h->store.self, HISTORY_FIELD_NAME, &size, &r->field_exists);
    if (s != STATUS_OK || !r->field_exists)
        return s;
    checkpoint_facts facts;
    checkpoint_trouble trouble;
    s = checkpoint_read(r->c, &facts, field_get, &h->store, &trouble);
    if (s == STATUS_NEWER)
        tell(r, WEIGHT_FIELD, HISTORY_FIELD_NAME, written_by_newer);
    if (s == STATUS_CORRUPT)
        return field_set_aside(r, trouble.offset, trouble.expected);
    if (s != STATUS_OK)
        return s;
    if (facts.sequence > UNDO_FILE_STROKE_MAX / 2)
        return field_set_aside(r, 24, "a number of strokes");
    h->cursor = facts.sequence;
    h->digest = facts.digest;
    h->step_mm = facts.step_mm;
    h->dab = facts.dab > h->dab ? facts.dab : h->dab;
    return STATUS_OK;
}

/* --- from the base to the cursor --- */

/* *moved_out false: the file is not what it should be, and its slot now says so. */
static status go_over(recovery *r, uint64_t n, undo_file_direction direction, bool *moved_out)
{
    history *h = r->h;
    slot *at = slot_of(r, n);
    *moved_out = false;
    if (at->is.state == UNDO_RING_UNREADABLE)
        return STATUS_IO;
    if (!links(r, n, h->digest, direction))
        return STATUS_OK;
    bool exists;
    undo_file_facts f;
    preamble_trouble trouble;
    status s = whole_file_read(&h->store, undo_ring_name_of(h->ring, n).text, &h->buffer, &exists);
    if (s == STATUS_OK)
        s = undo_file_check(&f, h->buffer.bytes, h->buffer.size, &trouble);
    if (s == STATUS_OK) {
        /* All that opening brings up is dirty in the end; until then the dirt would only fill up. */
        dirt_clear(&r->c->dirty);
        s = undo_file_apply(r->c, h->buffer.bytes, h->buffer.size, direction, &trouble);
    }
    uint64_t to = direction == UNDO_FILE_FORTH ? at->is.facts.digest_after : at->is.facts.digest_before;
    if (s == STATUS_OK && clay_digest(r->c) != to) {
        clay_change_revert(r->c);
        trouble = (preamble_trouble){direction == UNDO_FILE_FORTH ? 32 : 24, "the digest of the clay it makes"};
        s = STATUS_CORRUPT;
    }
    if (s == STATUS_CORRUPT) {
        damage(at, trouble);
        return STATUS_OK;
    }
    if (s != STATUS_OK)
        return s;
    clay_change_end(r->c);
    h->cursor = direction == UNDO_FILE_FORTH ? n : n - 1;
    h->digest = to;
    h->dab = f.dab > h->dab ? f.dab : h->dab;
    *moved_out = true;
    return STATUS_OK;
}

static status walk(recovery *r)
{
    uint64_t target = r->cursor_known ? r->was.cursor : UINT64_MAX;
    bool moved = true;
    status s = STATUS_OK;
    while (s == STATUS_OK && moved && r->h->cursor < target)
        s = go_over(r, r->h->cursor + 1, UNDO_FILE_FORTH, &moved);
    while (s == STATUS_OK && moved && r->h->cursor > target)
        s = go_over(r, r->h->cursor, UNDO_FILE_BACK, &moved);
    return s;
}

/* --- how far history reaches from there --- */

/* Known history ends at stroke n: why, and what follows from it for the stroke at which the clay stands. */
static void tell_end(recovery *r, uint64_t n, weight w, const char *follows)
{
    const undo_ring_slot *s = &slot_of(r, n)->is;
    sentence text;
    if (!tells(r, w, &text))
        return;
    sentence_add(&text, undo_ring_name_of(r->h->ring, n).text);
    switch (s->state) {
    case UNDO_RING_DAMAGED: add_damage(&text, s->trouble.offset, s->trouble.expected); break;
    case UNDO_RING_ABSENT: sentence_add(&text, " is missing"); break;
    case UNDO_RING_UNREADABLE: sentence_add(&text, " cannot be read"); break;
    case UNDO_RING_GOOD: sentence_add(&text, " is of another stroke"); break;
    }
    sentence_add(&text, ": ");
    sentence_add(&text, follows);
    sentence_add_number(&text, r->h->cursor, 1);
}

static const char stands_after[] = "the sculpture stands as after stroke ";

static void find_oldest(recovery *r)
{
    history *h = r->h;
    uint64_t lowest = r->cursor_known ? r->was.oldest : 1, n = h->cursor, digest = h->digest;
    while (n >= lowest && n >= 1 && links(r, n, digest, UNDO_FILE_BACK)) {
        digest = slot_of(r, n)->is.facts.digest_before;
        n--;
    }
    h->oldest = n + 1;
    if (!r->cursor_known || n < lowest || holds(slot_of(r, n), n + h->ring))
        return; /* that far it should reach; or the ring came round and the power went before the cursor was written */
    if (h->cursor > r->was.cursor)
        tell_end(r, n, WEIGHT_SCULPTURE, stands_after);
    else
        tell_end(r, n, WEIGHT_SIDE, "not every stroke can be undone before stroke ");
}

static void find_newest(recovery *r)
{
    history *h = r->h;
    uint64_t highest = r->cursor_known ? r->was.newest : UINT64_MAX, n = h->cursor + 1, digest = h->digest;
    while (n <= highest && links(r, n, digest, UNDO_FILE_FORTH)) {
        digest = slot_of(r, n)->is.facts.digest_after;
        n++;
    }
    h->newest = n - 1;
    if (n > highest)
        return;
    if (r->cursor_known && n > r->was.cursor && holds(slot_of(r, n), n))
        return; /* of another branch */
    if (r->cursor_known && h->cursor < r->was.cursor)
        tell_end(r, n, WEIGHT_SCULPTURE, stands_after);
    else if (r->cursor_known)
        tell_end(r, n, WEIGHT_SIDE, "not every stroke can be redone after stroke ");
    /* Without stroke n nothing leads to those beyond, and new strokes would overwrite them. */
    for (uint32_t k = 0; k < h->ring; k++) {
        slot *s = &r->slots[k];
        if (s->is.state == UNDO_RING_GOOD && s->is.facts.stroke >= n && s->is.facts.stroke <= highest)
            s->aside = true;
    }
}

/* --- putting it in order --- */

static bool any_slot(const recovery *r)
{
    for (uint32_t n = 0; n < r->h->ring; n++)
        if (r->slots[n].is.state != UNDO_RING_ABSENT)
            return true;
    return false;
}

static void tell_of_base(recovery *r)
{
    const uint64_t cursor = r->h->cursor;
    bool any = r->cursor_exists || any_slot(r);
    sentence text;
    if (!r->field_exists && any && cursor == 0)
        tell(r, WEIGHT_FIELD, HISTORY_FIELD_NAME, " is missing: the sculpture is empty, all else is set aside");
    if (!r->field_exists && any && cursor > 0 && tells(r, WEIGHT_FIELD, &text)) {
        sentence_add(&text, HISTORY_FIELD_NAME " is missing: the undo-files made the sculpture again, up to stroke ");
        sentence_add_number(&text, cursor, 1);
    }
    if (any && !r->cursor_known && tells(r, WEIGHT_CURSOR, &text)) {
        sentence_add(&text, CURSOR_FILE_NAME);
        sentence_add(&text, r->cursor_exists ? " is damaged: " : " is missing: ");
        sentence_add(&text, stands_after);
        sentence_add_number(&text, cursor, 1);
        sentence_add(&text, ", the last one kept");
    }
}

static status set_aside(recovery *r)
{
    const byte_store *store = &r->h->store;
    status s = STATUS_OK;
    for (uint32_t n = 0; s == STATUS_OK && n < r->h->ring; n++) {
        const slot *at = &r->slots[n];
        if (at->aside || at->is.state == UNDO_RING_DAMAGED)
            s = whole_file_set_aside(store, undo_ring_name_of(r->h->ring, n).text);
        if (at->is.state == UNDO_RING_DAMAGED)
            tell(r, WEIGHT_SIDE, undo_ring_name_of(r->h->ring, n).text, " is damaged and was set aside");
    }
    if (s == STATUS_OK && r->cursor_exists && !r->cursor_known)
        s = whole_file_set_aside(store, CURSOR_FILE_NAME);
    return s;
}

static status run(recovery *r)
{
    status s = look_at_cursor(r);
    if (s == STATUS_OK)
        s = look_at_ring(r);
    if (s == STATUS_OK)
        s = read_base(r);
    if (s != STATUS_OK)
        return s;
    r->h->checkpoint = r->h->cursor;
    s = walk(r);
    if (s != STATUS_OK)
        return s;
    find_oldest(r);
    find_newest(r);
    tell_of_base(r);
    return set_aside(r);
}

status recovery_run(history *h, clay *c, recovery_writes *writes_out, history_finding *finding_out)
{
    recovery r = {.h = h, .c = c, .finding = finding_out};
    status s = run(&r);
    free(r.slots);
    writes_out->field = !r.field_exists;
    writes_out->cursor = !r.cursor_known || r.was.cursor != h->cursor || r.was.oldest != h->oldest ||
                         r.was.newest != h->newest;
    return s;
}
