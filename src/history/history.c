/* SPDX-License-Identifier: Apache-2.0 */
#include "history/history.h"

#include "history/cursor_file.h"
#include "history/recovery.h"
#include "history/undo_ring.h"
#include "history/whole_file.h"

#include <math.h>

#define FIELD_TEMPORARY HISTORY_FIELD_NAME ".new"

/* A stroke over the whole sculpture needs hundreds of megabytes once; the next hundred strokes do not. */
enum { BUFFER_KEPT_BYTES = 16 * 1024 * 1024 };

static void buffer_shrink(history *h)
{
    if (h->buffer.room > BUFFER_KEPT_BYTES)
        byte_buffer_finish(&h->buffer);
}

/* --- checkpoint and cursor --- */

typedef struct field_sink {
    const byte_store *store;
    uint64_t offset;
} field_sink;

static status field_put(void *self, const void *bytes, size_t n)
{
    field_sink *f = (field_sink *)self;
    status s = f->store->write(f->store->self, FIELD_TEMPORARY, f->offset, bytes, n);
    f->offset += n;
    return s;
}

status history_checkpoint(history *h, const clay *c)
{
    const byte_store *store = &h->store;
    const checkpoint_facts facts = {
        .step_mm = h->step_mm, .sequence = h->cursor, .dab = h->dab, .digest = h->digest};
    field_sink sink = {store, 0};
    status s = store->remove(store->self, FIELD_TEMPORARY);
    if (s == STATUS_OK && c->changes.recording) {
        s = checkpoint_write_before(c, &facts, field_put, &sink);
    } else if (s == STATUS_OK) {
        assert(clay_digest(c) == h->digest); /* or the clay was changed behind history's back */
        s = checkpoint_write(c, &facts, field_put, &sink);
    }
    if (s == STATUS_OK)
        s = store->sync(store->self, FIELD_TEMPORARY);
    if (s != STATUS_OK)
        return s;
    h->checkpoint_known = false;
    s = store->rename(store->self, FIELD_TEMPORARY, HISTORY_FIELD_NAME);
    if (s == STATUS_OK) {
        h->checkpoint = h->cursor;
        h->checkpoint_known = true;
    }
    return s;
}

static status cursor_write(const history *h, uint64_t cursor, uint64_t newest)
{
    const cursor_file f = {.oldest = h->oldest,
                           .cursor = cursor,
                           .newest = newest,
                           .dab = h->dab,
                           .step_mm = h->step_mm,
                           .ring = h->ring};
    return cursor_file_write(&f, &h->store);
}

/* --- opening and closing --- */

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

status history_open(history *h, byte_store store, uint32_t ring, double step_mm, clay *c,
                    history_finding *finding_out)
{
    assert(clay_brick_count(c) == 0 && !c->changes.recording);
    finding_out->text[0] = '\0';
    *h = (history){.store = store, .ring = ring, .step_mm = step_mm, .oldest = 1, .checkpoint_known = true};
    if (ring < 1 || ring > HISTORY_RING_MAX || !isfinite(step_mm) || step_mm <= 0)
        return STATUS_BAD_PARAMETER;
    recovery_writes to_write;
    status s = recovery_run(h, c, &to_write, finding_out);
    if (s == STATUS_OK && to_write.field)
        s = history_checkpoint(h, c);
    if (s == STATUS_OK && to_write.cursor)
        s = cursor_write(h, h->cursor, h->newest);
    if (s == STATUS_OK)
        s = mark_all(c);
    buffer_shrink(h);
    if (s != STATUS_OK) {
        clay_clear(c);
        history_close(h);
    }
    return s;
}

void history_close(history *h) { byte_buffer_finish(&h->buffer); }

/* --- a new stroke --- */

/* H1: may the file of stroke n be replaced, and strokes after the cursor be forgotten? */
static bool checkpoint_is_due(const history *h, uint64_t n)
{
    return !h->checkpoint_known || h->checkpoint > h->cursor || (n > h->ring && n - h->ring > h->checkpoint);
}

static status stroke_write(history *h, const clay *c, const undo_file_facts *facts)
{
    uint64_t n = facts->stroke;
    status s = checkpoint_is_due(h, n) ? history_checkpoint(h, c) : STATUS_OK;
    if (s == STATUS_OK)
        s = whole_file_write(&h->store, UNDO_RING_TEMPORARY, h->buffer.bytes, h->buffer.size);
    if (s != STATUS_OK)
        return s;
    /* From here on, even if the rename fails, what it may have replaced is no longer counted on. */
    h->newest = h->cursor;
    if (n >= h->oldest + h->ring)
        h->oldest = n - h->ring + 1;
    undo_ring_name name = undo_ring_name_of(h->ring, n);
    s = h->store.rename(h->store.self, UNDO_RING_TEMPORARY, name.text);
    if (s == STATUS_OK)
        s = cursor_write(h, n, n);
    if (s == STATUS_OK) {
        h->cursor = h->newest = n;
        h->digest = facts->digest_after;
    }
    return s;
}

status history_commit(history *h, clay *c)
{
    assert(c->changes.recording);
    undo_file_facts facts = {.stroke = h->cursor + 1,
                             .digest_before = h->digest,
                             .digest_after = clay_digest(c),
                             .dab = h->dab,
                             .ring = h->ring};
    status s = undo_file_encode(c, &facts, &h->buffer);
    if (s == STATUS_OK && facts.corners > 0)
        s = stroke_write(h, c, &facts);
    buffer_shrink(h);
    if (s == STATUS_OK)
        clay_change_end(c);
    return s;
}

/* --- back and forth --- */

/* Stroke n cannot be gone over: history ends before it, or after it. */
static status end_at(history *h, const clay *c, uint64_t n, undo_file_direction direction)
{
    bool leads_to_cursor = direction == UNDO_FILE_BACK ? h->checkpoint < n : h->checkpoint >= n;
    status s = leads_to_cursor || !h->checkpoint_known ? history_checkpoint(h, c) : STATUS_OK;
    uint64_t last = direction == UNDO_FILE_BACK ? n : h->newest;
    for (uint64_t stroke = n; s == STATUS_OK && stroke <= last; stroke++)
        s = whole_file_set_aside(&h->store, undo_ring_name_of(h->ring, stroke).text);
    if (s != STATUS_OK)
        return s;
    if (direction == UNDO_FILE_BACK)
        h->oldest = n + 1;
    else
        h->newest = n - 1;
    s = cursor_write(h, h->cursor, h->newest);
    return s == STATUS_OK ? STATUS_CORRUPT : s;
}

/* Goes over stroke n; after STATUS_OK the step is recorded as a change. */
static status go_over(history *h, clay *c, uint64_t n, undo_file_direction direction, uint64_t *digest_out)
{
    bool exists;
    undo_file_facts f;
    preamble_trouble trouble;
    status s = whole_file_read(&h->store, undo_ring_name_of(h->ring, n).text, &h->buffer, &exists);
    if (s == STATUS_OK && !exists)
        s = STATUS_CORRUPT;
    if (s == STATUS_OK)
        s = undo_file_check(&f, h->buffer.bytes, h->buffer.size, &trouble);
    if (s != STATUS_OK)
        return s;
    uint64_t from = direction == UNDO_FILE_BACK ? f.digest_after : f.digest_before;
    uint64_t to = direction == UNDO_FILE_BACK ? f.digest_before : f.digest_after;
    if (f.stroke != n || from != h->digest)
        return STATUS_CORRUPT;
    s = undo_file_apply(c, h->buffer.bytes, h->buffer.size, direction, &trouble);
    if (s == STATUS_OK && clay_digest(c) != to) {
        clay_change_revert(c);
        s = STATUS_CORRUPT;
    }
    *digest_out = to;
    return s;
}

static status step(history *h, clay *c, undo_file_direction direction)
{
    assert(!c->changes.recording);
    uint64_t n = direction == UNDO_FILE_BACK ? h->cursor : h->cursor + 1;
    uint64_t there = direction == UNDO_FILE_BACK ? n - 1 : n;
    uint64_t digest = 0;
    status s = go_over(h, c, n, direction, &digest);
    buffer_shrink(h);
    if (s == STATUS_CORRUPT)
        return end_at(h, c, n, direction);
    if (s != STATUS_OK)
        return s;
    s = cursor_write(h, there, h->newest);
    if (s != STATUS_OK) {
        clay_change_revert(c);
        return s;
    }
    clay_change_end(c);
    h->cursor = there;
    h->digest = digest;
    return STATUS_OK;
}

status history_undo(history *h, clay *c)
{
    return history_can_undo(h) ? step(h, c, UNDO_FILE_BACK) : STATUS_HISTORY_ENDS;
}

status history_redo(history *h, clay *c)
{
    return history_can_redo(h) ? step(h, c, UNDO_FILE_FORTH) : STATUS_HISTORY_ENDS;
}
