/* SPDX-License-Identifier: Apache-2.0 */
#include "history/recovery.h"

#include "history/sentence.h"
#include "history/stored_file.h"

#include <stdlib.h>
#include <string.h>

/* A record that was found, and where. */
typedef struct found {
    record r;
    uint32_t file;
    uint64_t offset;
} found;

typedef struct found_list {
    found *at;
    size_t count, room;
} found_list;

/* How much a finding matters to the person; only the greatest is told. */
typedef enum weight { WEIGHT_NONE, WEIGHT_UNDO, WEIGHT_FIELD, WEIGHT_LOST, WEIGHT_NEWER } weight;

typedef struct recovery {
    history *h;
    clay *c;
    history_finding *finding;
    weight told;
    found_list seen;  /* file by file, in the order in which they lie there */
    found_list whole; /* those that count, by sequence */
    checkpoint_facts base;
    uint32_t unread; /* files that cannot be read */
    uint32_t tail;   /* the file of the last one that counts, or RING_NONE */
    uint64_t newest; /* use of a file in which one counts, or would if its stretch were whole */
    uint64_t sound;  /* the last that follows on from the base, whole or not */
} recovery;

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

static status list_add(found_list *l, const found *f)
{
    enum { ROOM_FIRST = 256 };
    if (l->count == l->room) {
        const size_t room = l->room ? l->room * 2 : ROOM_FIRST;
        found *grown = (found *)realloc(l->at, room * sizeof *grown);
        if (!grown)
            return STATUS_NO_MEMORY;
        l->at = grown;
        l->room = room;
    }
    l->at[l->count++] = *f;
    return STATUS_OK;
}

static bool follows(const record *r, const record *before)
{
    return r->sequence == before->sequence + 1 && r->before == before->seal;
}

/* --- 1. what lies in the files --- */

static status scan(recovery *r, uint32_t file)
{
    ring *of = &r->h->ring;
    found f = {.file = file};
    record last = {.use = 0};
    status s = STATUS_OK;
    for (;;) {
        s = ring_read_header(of, file, f.offset, &f.r);
        if (s != STATUS_OK || (last.use != 0 && (f.r.use != last.use || !follows(&f.r, &last))))
            break;
        s = list_add(&r->seen, &f);
        if (s != STATUS_OK)
            return s;
        last = f.r;
        f.offset += record_span(f.r.stored);
        of->files[file].use = last.use;
        of->use = last.use > of->use ? last.use : of->use;
    }
    if (s == STATUS_NEWER)
        tell(r, WEIGHT_NEWER, ring_name_of(file).text, " was written by a newer version of this program");
    if (s == STATUS_IO) {
        r->unread++;
        of->files[file].spoilt = true;
        tell(r, WEIGHT_UNDO, ring_name_of(file).text, " cannot be read: not every stroke can be undone");
    }
    return s == STATUS_NEWER ? s : STATUS_OK;
}

/* --- 2. which of the records count --- */

/* The same record may have been written twice, because the sync of its first file failed (H5), and the second file be
   lost since: what the first says is true all the same. */
static bool leads_to(const record *before, const record *r)
{
    const bool same_stroke = r->stroke != 0 && before->stroke == r->stroke;
    const bool in_place = same_stroke ? r->part == before->part + 1 : r->stroke == 0 || r->parent == before->cursor;
    return before->digest_after == r->digest_before && in_place;
}

/* Records first..end-1 of r->seen are one file's, the uses before it are done. Where it was begun, the clay stood at
   the record before its first one: what earlier files say of that sequence and those behind it is no more, and so is
   a record before that is not the one it goes on from. */
static status take_file(recovery *r, size_t first, size_t end)
{
    found_list *l = &r->whole;
    const record *start = &r->seen.at[first].r;
    while (l->count > 0 && l->at[l->count - 1].r.sequence >= start->sequence)
        l->count--;
    const record *last = l->count > 0 ? &l->at[l->count - 1].r : NULL;
    if (last && last->sequence + 1 == start->sequence && !follows(start, last) && !leads_to(last, start))
        l->count--;
    status s = STATUS_OK;
    for (size_t n = first; s == STATUS_OK && n < end; n++)
        s = list_add(l, &r->seen.at[n]);
    return s;
}

static status take_files(recovery *r)
{
    status s = STATUS_OK;
    for (uint64_t use = 0; s == STATUS_OK;) {
        size_t best = r->seen.count;
        for (size_t n = 0; n < r->seen.count; n++)
            if (r->seen.at[n].offset == 0 && r->seen.at[n].r.use > use &&
                (best == r->seen.count || r->seen.at[n].r.use < r->seen.at[best].r.use))
                best = n;
        if (best == r->seen.count)
            break;
        use = r->seen.at[best].r.use;
        size_t end = best + 1;
        while (end < r->seen.count && r->seen.at[end].file == r->seen.at[best].file)
            end++;
        s = take_file(r, best, end);
    }
    return s;
}

/* --- 3. the base --- */

static void field_set_aside(recovery *r, const stored_file *f, const checkpoint_trouble *trouble)
{
    sentence text;
    status s = stored_file_set_aside(f);
    if (!tells(r, WEIGHT_FIELD, &text))
        return;
    sentence_add(&text, f->name);
    sentence_add(&text, " is damaged at byte ");
    sentence_add_number(&text, trouble->offset, 1);
    sentence_add(&text, " (expected ");
    sentence_add(&text, trouble->expected);
    sentence_add(&text, s == STATUS_OK ? ") and was set aside" : ")");
}

/* Reads one of the two into the clay, if it is there and sound. */
static status read_field(recovery *r, const char *name, history_base *base_out, bool *read_out)
{
    stored_file source = {&r->h->store, name};
    checkpoint_trouble trouble;
    uint64_t size;
    bool exists = false;
    *read_out = false;
    status s = r->h->store.size(r->h->store.self, name, &size, &exists);
    if (s != STATUS_OK || !exists)
        return STATUS_OK;
    checkpoint_facts facts;
    s = checkpoint_read(r->c, &facts, stored_file_get, &source, &trouble);
    if (s == STATUS_IO)
        tell(r, WEIGHT_FIELD, name, " cannot be read");
    if (s == STATUS_CORRUPT)
        field_set_aside(r, &source, &trouble);
    if (s == STATUS_CORRUPT || s == STATUS_IO)
        return STATUS_OK;
    if (s != STATUS_OK)
        return s;
    *base_out = (history_base){true, facts.sequence, facts.cursor};
    r->base = facts;
    *read_out = true;
    return STATUS_OK;
}

/* The header alone: is it of a version that can be read? Of the one before, that is enough as long as the newest is
   sound. */
static status look_at_field(recovery *r, const char *name, history_base *base_out)
{
    stored_file source = {&r->h->store, name};
    checkpoint_facts facts;
    checkpoint_trouble trouble;
    status s = checkpoint_read_facts(&facts, stored_file_get, &source, &trouble);
    if (s == STATUS_NEWER)
        tell(r, WEIGHT_NEWER, name, " was written by a newer version of this program");
    *base_out = (history_base){.there = s == STATUS_OK};
    if (s == STATUS_OK)
        *base_out = (history_base){true, facts.sequence, facts.cursor};
    return s == STATUS_NEWER ? s : STATUS_OK;
}

static status read_base(recovery *r)
{
    history *h = r->h;
    bool read = false;
    r->base = (checkpoint_facts){.step_mm = h->step_mm};
    status s = look_at_field(r, HISTORY_FIELD_NAME, &h->field);
    if (s == STATUS_OK)
        s = look_at_field(r, HISTORY_FIELD_BEFORE_NAME, &h->before);
    h->field.there = false;
    if (s == STATUS_OK)
        s = read_field(r, HISTORY_FIELD_NAME, &h->field, &read);
    if (s != STATUS_OK || read)
        return s;
    h->before.there = false;
    s = read_field(r, HISTORY_FIELD_BEFORE_NAME, &h->before, &read);
    h->wants_field = read || r->told >= WEIGHT_FIELD;
    return s;
}

/* --- 4. the tail --- */

static bool bricks_are_sound(recovery *r, const found *f, byte_buffer *buffer)
{
    return ring_read_bricks(&r->h->ring, f->file, f->offset, &f->r, buffer) == STATUS_OK;
}

/* Checkpoints stand between strokes: a part of one that began before the base is of an earlier life, whose sync failed
   and whose bytes came up all the same. */
static bool goes_on(const record *r, const record *last)
{
    return follows(r, last) && (r->part == 0 || r->stroke == last->stroke);
}

/* Leaves only records up to the last whole one that follows on from the base. */
static void cut_tail(recovery *r)
{
    found_list *l = &r->whole;
    byte_buffer buffer = {NULL, 0, 0};
    size_t kept = 0;
    while (kept < l->count && l->at[kept].r.sequence <= r->base.sequence)
        kept++;
    record last = {.sequence = r->base.sequence, .seal = r->base.seal};
    for (size_t n = kept; n < l->count && goes_on(&l->at[n].r, &last) && bricks_are_sound(r, &l->at[n], &buffer); n++) {
        last = l->at[n].r;
        r->newest = last.use;
        if (last.marks & RECORD_WHOLE)
            kept = n + 1;
    }
    l->count = kept;
    r->sound = last.sequence;
    byte_buffer_finish(&buffer);
}

/* What the records that count make of their files. */
static void settle_files(recovery *r)
{
    ring *of = &r->h->ring;
    for (size_t n = 0; n < r->whole.count; n++) {
        const found *f = &r->whole.at[n];
        ring_file *file = &of->files[f->file];
        if (file->free)
            file->first = f->r.sequence;
        file->free = false;
        file->last = f->r.sequence;
        file->end = f->offset + record_span(f->r.stored);
        file->stroke = f->r.stroke ? f->r.stroke : file->stroke;
        of->current = f->file;
        r->newest = file->use > r->newest ? file->use : r->newest;
    }
    r->tail = of->current;
    if (of->current != RING_NONE && of->files[of->current].spoilt)
        of->current = RING_NONE;
}

/* --- 5. the tree, and the way to where the clay stood --- */

static status put_stroke(history *h, const tree_stroke *s, bool sound)
{
    return sound && s->stroke != 0 && !tree_find(&h->tree, s->stroke) ? tree_put(&h->tree, *s) : STATUS_OK;
}

/* A state is what the records say that begin or end there: the last parts of a stroke that does not lead to it are
   gone, and so is the stroke. */
static void forget_unless(history *h, uint64_t state, uint64_t digest)
{
    const tree_stroke *s = tree_find(&h->tree, state);
    if (s && s->digest_after != digest)
        tree_forget(&h->tree, state);
}

static void forget_cut_short(recovery *r)
{
    forget_unless(r->h, r->base.cursor, r->base.digest);
    for (size_t n = 0; n < r->whole.count; n++) {
        const record *at = &r->whole.at[n].r;
        if (at->stroke == 0)
            forget_unless(r->h, at->cursor, at->digest_after);
        else if (at->part == 0)
            forget_unless(r->h, at->parent, at->digest_before);
    }
}

/* Strokes of which every part is there. */
static status plant(recovery *r)
{
    tree_stroke stroke = {.stroke = 0};
    uint32_t part = 0;
    bool sound = false;
    uint64_t sequence = 0;
    status s = STATUS_OK;
    for (size_t n = 0; s == STATUS_OK && n < r->whole.count; n++) {
        const record *now = &r->whole.at[n].r;
        if (now->stroke != 0 && now->stroke == stroke.stroke) {
            sound = sound && now->part == ++part && now->sequence == sequence + 1;
        } else if (now->stroke != 0) {
            s = put_stroke(r->h, &stroke, sound);
            stroke = (tree_stroke){.stroke = now->stroke, .parent = now->parent, .digest_before = now->digest_before};
            part = 0;
            sound = now->part == 0;
        }
        if (now->stroke != 0)
            stroke.digest_after = now->digest_after;
        sequence = now->sequence;
    }
    if (s == STATUS_OK)
        s = put_stroke(r->h, &stroke, sound);
    if (s == STATUS_OK)
        forget_cut_short(r);
    return s;
}

/* One stroke further; false when it cannot be gone over, and is no more. */
static status go(recovery *r, tree_leg leg, bool *gone_out)
{
    history *h = r->h;
    route way = {.from = 0};
    *gone_out = false;
    status s = history_fetch(h, HISTORY_TO, leg.to, &way);
    if (s == STATUS_OK) {
        dirt_clear(&r->c->dirty); /* all that opening brings up is dirty in the end */
        s = route_apply(&way, r->c);
        if (s == STATUS_CORRUPT)
            history_refuse(h, &way);
    } else if (s == STATUS_IO) {
        tree_forget(&h->tree, leg.stroke);
        s = STATUS_CORRUPT;
    }
    if (s == STATUS_OK) {
        clay_change_end(r->c);
        h->tree.cursor = way.cursor;
        h->digest = way.digest_after;
        *gone_out = true;
    }
    route_finish(&way);
    return s == STATUS_CORRUPT ? STATUS_OK : s;
}

/* The latest whole record whose state can be reached from where the clay stands; 0: none. */
static const record *latest_reachable(const recovery *r)
{
    for (size_t n = r->whole.count; n > 0; n--) {
        const record *at = &r->whole.at[n - 1].r;
        if (at->marks & RECORD_WHOLE && tree_leads(&r->h->tree, r->h->tree.cursor, at->cursor))
            return at;
    }
    return NULL;
}

static status walk(recovery *r, uint64_t to)
{
    history *h = r->h;
    status s = STATUS_OK;
    bool gone = true;
    while (s == STATUS_OK && h->tree.cursor != to) {
        const tree_leg leg = tree_next(&h->tree, h->tree.cursor, to);
        gone = false;
        if (leg.stroke != 0)
            s = go(r, leg, &gone);
        if (s != STATUS_OK || gone)
            continue;
        const record *reachable = latest_reachable(r);
        to = reachable ? reachable->cursor : h->tree.cursor;
        tell(r, WEIGHT_LOST, "undo-files are damaged: the sculpture stands at the latest state that could be reached",
             "");
    }
    return s;
}

static status stand(recovery *r)
{
    history *h = r->h;
    const bool on = r->whole.count > 0 && r->whole.at[r->whole.count - 1].r.sequence > r->base.sequence;
    const record *last = on ? &r->whole.at[r->whole.count - 1].r : NULL;
    const uint64_t cursor = last ? last->cursor : r->base.cursor, tip = last ? last->tip : r->base.tip;
    h->sequence = h->kept = last ? last->sequence : r->base.sequence;
    h->seal = last ? last->seal : r->base.seal;
    h->dab = last ? last->dab : r->base.dab;
    h->step_mm = last ? last->step_mm : r->base.step_mm;
    h->digest = r->base.digest;
    h->tree.cursor = h->tree.tip = r->base.cursor;
    status s = plant(r);
    h->stroke = tip > r->base.tip ? tip : r->base.tip;
    for (size_t n = 0; n < r->whole.count; n++) /* also those that cannot be gone over: no number is given twice */
        h->stroke = r->whole.at[n].r.stroke > h->stroke ? r->whole.at[n].r.stroke : h->stroke;
    if (s == STATUS_OK)
        s = walk(r, cursor);
    if (s != STATUS_OK)
        return s;
    h->tree.tip = h->tree.cursor == cursor ? tip : h->tree.cursor;
    h->kept_cursor = h->tree.cursor;
    h->kept_digest = h->digest;
    tree_prune(&h->tree);
    if (h->tree.cursor == cursor)
        return STATUS_OK;
    const route here = {.from = h->tree.cursor,
                        .cursor = h->tree.cursor,
                        .tip = h->tree.tip,
                        .digest_before = h->digest,
                        .digest_after = h->digest};
    h->wants_field = true;
    return history_move(h, &here);
}

/* --- 6. beyond the break --- */

/* Does this record show that one was kept which is not there any more? What an earlier cut left over does not: files
   were begun since. */
static bool shows_loss(const recovery *r, const record *at) { return at->kept > r->sound && at->use >= r->newest; }

static bool loss_in(const recovery *r, uint32_t file)
{
    for (size_t n = 0; n < r->seen.count; n++)
        if (r->seen.at[n].file == file && shows_loss(r, &r->seen.at[n].r))
            return true;
    return false;
}

/* The same for what a scan from the file's beginning does not come to. A use that is found there is not given again. */
static bool loss_behind(recovery *r, uint32_t file)
{
    ring *of = &r->h->ring;
    const ring_file *f = &of->files[file];
    bool lost = false;
    record at;
    for (uint64_t offset = f->end; offset + RECORD_BLOCK_BYTES <= f->bytes; offset += RECORD_BLOCK_BYTES) {
        if (ring_read_header(of, file, offset, &at) != STATUS_OK)
            continue;
        of->use = at.use > of->use ? at.use : of->use;
        lost = lost || shows_loss(r, &at);
    }
    return lost;
}

static void look_beyond(recovery *r)
{
    ring *of = &r->h->ring;
    bool lost = false;
    for (uint32_t n = 0; n < of->count; n++) {
        ring_file *f = &of->files[n];
        const bool may = f->use >= r->newest || f->use == 0; /* or its first record cannot be read */
        if (f->bytes == 0 || !(loss_in(r, n) || (may && loss_behind(r, n))))
            continue;
        lost = true;
        f->spoilt = true; /* set aside as soon as nothing in it is needed */
        if (of->current == n)
            of->current = RING_NONE;
        if (f->free) {
            status s = ring_set_aside(of, n);
            (void)s; /* where that fails it stays, and nothing is written to it */
        }
    }
    /* What a cut left over in a later file must not come between this one's records and those that follow. */
    if (of->current != RING_NONE && of->files[of->current].use < of->use)
        of->current = RING_NONE;
    sentence text;
    if (!lost || !tells(r, WEIGHT_LOST, &text))
        return;
    sentence_add(&text, "the medium lost what it had said was kept: the sculpture stands as after stroke ");
    sentence_add_number(&text, r->h->tree.cursor, 1);
    sentence_add(&text, ", what was found beyond is set aside");
}

/* A file that is not empty, and has no record at its beginning: of an earlier form, which is no damage; damaged; or a
   cut fell into its being written anew. Nobody can tell the last two apart, so it is kept (H6) without a word. */
static void put_unread_aside(recovery *r, uint32_t file)
{
    uint8_t mark[8] = {0};
    static const uint8_t none[sizeof mark];
    size_t got = 0;
    record first;
    const ring_name name = ring_name_of(file);
    const stored_file f = {&r->h->store, name.text};
    if (stored_file_read(&f, 0, mark, sizeof mark, &got) != STATUS_OK || memcmp(mark, none, sizeof mark) == 0 ||
        ring_read_header(&r->h->ring, file, 0, &first) != STATUS_CORRUPT ||
        ring_set_aside(&r->h->ring, file) != STATUS_OK)
        return;
    if (memcmp(mark, "glundo\r\n", sizeof mark) == 0)
        tell(r, WEIGHT_UNDO, name.text,
             " is of an earlier form and was set aside: its stroke cannot be undone any more");
}

/* --- in this order --- */

/* What was read may only be in the machine's memory yet: whoever wrote it may have been killed before he synced. */
static void sync_tail(recovery *r)
{
    const uint32_t file = r->tail;
    if (file == RING_NONE)
        return;
    if (r->h->store.sync(r->h->store.self, ring_name_of(file).text) == STATUS_OK)
        return;
    r->h->ring.files[file].spoilt = true;
    if (r->h->ring.current == file)
        r->h->ring.current = RING_NONE;
    r->h->wants_field = true;
    tell(r, WEIGHT_UNDO, ring_name_of(file).text, " cannot be written any more");
}

static status run(recovery *r)
{
    status s = STATUS_OK;
    for (uint32_t n = 0; s == STATUS_OK && n < r->h->ring.count; n++)
        if (r->h->ring.files[n].bytes > 0)
            s = scan(r, n);
    r->h->ring.use += r->unread; /* their uses, which are not given again */
    if (s == STATUS_OK)
        s = take_files(r);
    if (s == STATUS_OK)
        s = read_base(r);
    if (s != STATUS_OK)
        return s;
    cut_tail(r);
    settle_files(r);
    s = stand(r);
    if (s != STATUS_OK)
        return s;
    look_beyond(r);
    for (uint32_t n = 0; n < r->h->ring.count; n++)
        if (r->h->ring.files[n].bytes > 0 && r->h->ring.files[n].free)
            put_unread_aside(r, n);
    sync_tail(r);
    return STATUS_OK;
}

status recovery_run(history *h, clay *c, history_finding *finding_out)
{
    recovery r = {.h = h, .c = c, .finding = finding_out};
    status s = run(&r);
    free(r.seen.at);
    free(r.whole.at);
    return s;
}
