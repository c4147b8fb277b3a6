/* SPDX-License-Identifier: Apache-2.0 */
#include "history/ring.h"

#include "history/sentence.h"
#include "history/stored_file.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { ROOM_FIRST = 64, ZEROS_BYTES = 65536, DIGITS = 4 };

#define NAME_START "undo-"

ring_name ring_name_of(uint32_t file)
{
    ring_name name;
    sentence text = sentence_begin(name.text, sizeof name.text);
    sentence_add(&text, NAME_START);
    sentence_add_number(&text, file, DIGITS);
    return name;
}

/* RING_NONE: the name is not an undo-file's. */
static uint32_t number_of(const char *name)
{
    const size_t start = sizeof NAME_START - 1;
    uint32_t n = 0;
    if (strncmp(name, NAME_START, start) != 0 || strlen(name) != start + DIGITS)
        return RING_NONE;
    for (const char *at = name + start; *at; at++) {
        if (*at < '0' || *at > '9')
            return RING_NONE;
        n = n * 10 + (uint32_t)(*at - '0');
    }
    return n;
}

static status room_for(ring *r, uint32_t file)
{
    if (file < r->room)
        return STATUS_OK;
    uint32_t room = r->room ? r->room : ROOM_FIRST;
    while (room <= file)
        room *= 2;
    ring_file *grown = (ring_file *)realloc(r->files, room * sizeof *grown);
    if (!grown)
        return STATUS_NO_MEMORY;
    memset(grown + r->room, 0, (room - r->room) * sizeof *grown);
    r->files = grown;
    r->room = room;
    return STATUS_OK;
}

static status file_add(ring *r, uint32_t file, uint64_t bytes)
{
    status s = room_for(r, file);
    if (s != STATUS_OK)
        return s;
    r->files[file] = (ring_file){.bytes = bytes, .first = 1, .free = true};
    r->count = file >= r->count ? file + 1 : r->count;
    r->bytes += bytes;
    return STATUS_OK;
}

/* --- the files there are --- */

typedef struct listing {
    ring *into;
    status s;
} listing;

static void take_name(void *into, const char *name)
{
    listing *l = (listing *)into;
    const uint32_t file = number_of(name);
    uint64_t bytes = 0;
    bool exists = false;
    if (l->s != STATUS_OK || file == RING_NONE)
        return;
    l->s = l->into->store->size(l->into->store->self, name, &bytes, &exists);
    if (l->s == STATUS_OK && exists)
        l->s = file_add(l->into, file, bytes);
}

status ring_open(ring *r, const byte_store *store)
{
    *r = (ring){.store = store, .current = RING_NONE};
    listing l = {r, STATUS_OK};
    status s = store->list(store->self, take_name, &l);
    return s == STATUS_OK ? l.s : s;
}

void ring_close(ring *r)
{
    free(r->files);
    memset(r, 0, sizeof *r);
}

status ring_make(ring *r, uint64_t bytes, uint32_t *file_out)
{
    static const uint8_t zeros[ZEROS_BYTES];
    assert(bytes >= RING_FILE_BYTES_MIN && bytes % RECORD_BLOCK_BYTES == 0);
    uint32_t file = 0;
    while (file < r->count && r->files[file].bytes > 0)
        file++;
    if (file == RING_FILES_MAX)
        return STATUS_NO_SPACE;
    status s = room_for(r, file);
    if (s != STATUS_OK)
        return s;
    const ring_name name = ring_name_of(file);
    s = r->store->remove(r->store->self, name.text); /* what an earlier try may have left */
    for (uint64_t at = 0; s == STATUS_OK && at < bytes; at += ZEROS_BYTES)
        s = r->store->write(r->store->self, name.text, at, zeros,
                            bytes - at < ZEROS_BYTES ? (size_t)(bytes - at) : ZEROS_BYTES);
    if (s == STATUS_OK)
        s = r->store->sync(r->store->self, name.text);
    if (s != STATUS_OK) {
        status removed = r->store->remove(r->store->self, name.text);
        (void)removed; /* a file half made is found free at the next start */
        return s;
    }
    *file_out = file;
    return file_add(r, file, bytes);
}

static void forget(ring *r, uint32_t file)
{
    r->bytes -= r->files[file].bytes;
    memset(&r->files[file], 0, sizeof r->files[file]);
    if (r->current == file)
        r->current = RING_NONE;
}

status ring_remove(ring *r, uint32_t file)
{
    status s = r->store->remove(r->store->self, ring_name_of(file).text);
    if (s == STATUS_OK)
        forget(r, file);
    return s;
}

status ring_set_aside(ring *r, uint32_t file)
{
    const ring_name name = ring_name_of(file);
    const stored_file f = {r->store, name.text};
    status s = stored_file_set_aside(&f);
    if (s == STATUS_OK)
        forget(r, file);
    return s;
}

uint32_t ring_free_file(const ring *r, uint64_t bytes_least)
{
    uint32_t best = RING_NONE;
    for (uint32_t n = 0; n < r->count; n++) {
        const ring_file *f = &r->files[n];
        if (!f->free || f->spoilt || f->bytes < bytes_least || f->bytes % RECORD_BLOCK_BYTES != 0)
            continue;
        if (best == RING_NONE || f->use < r->files[best].use)
            best = n;
    }
    return best;
}

/* --- writing --- */

void ring_begin(ring *r, uint32_t file, uint64_t stroke)
{
    ring_file *f = &r->files[file];
    *f = (ring_file){.bytes = f->bytes, .use = ++r->use, .stroke = stroke, .first = 1};
    r->current = file;
}

bool ring_has_room(const ring *r, uint32_t file, uint64_t stored)
{
    const ring_file *f = &r->files[file];
    return !f->spoilt && f->bytes >= f->end && f->bytes - f->end >= record_span(stored);
}

status ring_write(ring *r, uint32_t file, record *written, uint8_t *header)
{
    ring_file *f = &r->files[file];
    written->use = f->use;
    record_seal(written, header);
    const size_t n = RECORD_HEADER_BYTES + (size_t)written->stored;
    status s = r->store->write(r->store->self, ring_name_of(file).text, f->end, header, n);
    if (s != STATUS_OK)
        return s;
    if (f->last < f->first)
        f->first = written->sequence;
    f->last = written->sequence;
    f->end += record_span(written->stored);
    return STATUS_OK;
}

/* --- reading --- */

static status read_all(const ring *r, uint32_t file, uint64_t offset, uint8_t *bytes, size_t n, size_t *have_out)
{
    const ring_name name = ring_name_of(file);
    const stored_file f = {r->store, name.text};
    return stored_file_read(&f, offset, bytes, n, have_out);
}

status ring_read_header(const ring *r, uint32_t file, uint64_t offset, record *r_out)
{
    uint8_t bytes[PREAMBLE_HEADER_BYTES_MAX];
    size_t have = 0;
    preamble_trouble trouble;
    status s = read_all(r, file, offset, bytes, sizeof bytes, &have);
    if (s == STATUS_OK)
        s = record_read(r_out, bytes, have, &trouble);
    if (s == STATUS_OK && record_span(r_out->stored) > r->files[file].bytes - offset)
        s = STATUS_CORRUPT;
    return s;
}

status ring_read_bricks(const ring *r, uint32_t file, uint64_t offset, const record *header, byte_buffer *out)
{
    const size_t bytes = (size_t)header->bytes, stored = (size_t)header->stored;
    preamble_trouble trouble;
    size_t have = 0;
    status s = byte_buffer_reserve(out, bytes + stored + 1); /* a move has neither, and no NULL */
    if (s == STATUS_OK)
        s = read_all(r, file, offset + RECORD_HEADER_BYTES, out->bytes + bytes, stored, &have);
    if (s == STATUS_OK && have < stored)
        s = STATUS_CORRUPT;
    out->size = bytes;
    return s == STATUS_OK ? record_check(header, out->bytes + bytes, out->bytes, &trouble) : s;
}

uint32_t ring_next_file(const ring *r, uint64_t stroke, uint64_t use)
{
    uint32_t best = RING_NONE;
    for (uint32_t n = 0; n < r->count; n++) {
        const ring_file *f = &r->files[n];
        if (f->stroke == stroke && f->last >= f->first && f->use > use &&
            (best == RING_NONE || f->use < r->files[best].use))
            best = n;
    }
    return best;
}
