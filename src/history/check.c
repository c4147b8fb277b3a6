/* SPDX-License-Identifier: Apache-2.0 */
#include "history/check.h"

#include "clay/clay.h"
#include "history/checkpoint.h"
#include "history/history.h"
#include "history/ring.h"
#include "history/stored_file.h"

#include <string.h>

#define WHOLE_FILE UINT64_MAX

/* A record's place in the life of the sculpture. */
typedef struct link {
    uint64_t sequence, seal, use;
} link;

typedef struct check {
    const byte_store *store;
    check_teller tell;
    void *self;
    check_facts *facts;
    struct ring files;
    link base;           /* of the newest sound checkpoint */
    uint64_t beneath;    /* the last sequence that both checkpoints hold; 0: there are not two */
    uint64_t newest;     /* use of the file that was written last */
    uint32_t half_begun; /* the one file that may be neither what it was nor what it was to become, or RING_NONE */
    byte_buffer bricks;
} check;

static void problem(check *c, const char *file, uint64_t offset, const char *expected)
{
    c->facts->problems++;
    c->tell(c->self, CHECK_PROBLEM, file, offset, expected);
}

static void note(check *c, const char *file, uint64_t offset, const char *expected)
{
    c->tell(c->self, CHECK_NOTE, file, offset, expected);
}

/* --- undo-files --- */

/* The header at a place, with what is wrong with it; *have_out: bytes that are there. */
static status look_at(const check *c, const char *name, uint64_t offset, record *r, uint8_t *bytes, size_t *have_out,
                      preamble_trouble *trouble)
{
    const stored_file f = {c->store, name};
    *trouble = (preamble_trouble){0, "readable bytes"};
    status s = stored_file_read(&f, offset, bytes, PREAMBLE_HEADER_BYTES_MAX, have_out);
    return s == STATUS_OK ? record_read(r, bytes, *have_out, trouble) : s;
}

static bool is_record(const uint8_t *bytes, size_t have) { return have >= 8 && memcmp(bytes, "glring\r\n", 8) == 0; }
static bool is_older(const uint8_t *bytes, size_t have) { return have >= 8 && memcmp(bytes, "glundo\r\n", 8) == 0; }

static bool is_zero(const uint8_t *bytes, size_t have)
{
    for (size_t n = 0; n < have; n++)
        if (bytes[n] != 0)
            return false;
    return true;
}

/* Nothing follows on at this place: is that as it may be? */
static void end_of_file(check *c, uint32_t file, uint64_t offset, status why, const uint8_t *bytes, size_t have,
                        const preamble_trouble *trouble)
{
    const ring_name name = ring_name_of(file);
    const ring_file *f = &c->files.files[file];
    if (why == STATUS_NEWER || why == STATUS_IO) {
        problem(c, name.text, offset + trouble->offset, trouble->expected);
    } else if (offset == 0 && is_older(bytes, have)) {
        note(c, name.text, WHOLE_FILE, "is an undo-file of an earlier form: its stroke cannot be undone any more");
    } else if (is_record(bytes, have) && f->use >= c->newest) {
        note(c, name.text, offset, "nothing: a record that a power cut left unfinished, it will be cut off");
    } else if (is_record(bytes, have)) {
        problem(c, name.text, offset + trouble->offset, trouble->expected);
    } else if (offset == 0 && !is_zero(bytes, have)) {
        problem(c, name.text, 0, "the mark of a record");
    } else if (f->bytes < RING_FILE_BYTES_MIN || f->bytes % RECORD_BLOCK_BYTES != 0) {
        note(c, name.text, f->bytes, "a length of whole blocks: its making was cut short, or its end is gone");
    }
}

/* Bricks that are not what their header says: is that as it may be? A cut while a file is begun anew can leave headers
   of what it held, and other bricks behind them. That is one file, and both checkpoints hold what it had. */
static void unsound_bricks(check *c, uint32_t file, uint64_t offset, const record *r)
{
    const ring_name name = ring_name_of(file);
    if (r->use >= c->newest) {
        note(c, name.text, offset, "sound bricks: a record that a power cut left unfinished, it will be cut off");
    } else if (r->sequence <= c->beneath && (c->half_begun == RING_NONE || c->half_begun == file)) {
        c->half_begun = file;
        note(c, name.text, offset, "sound bricks: its file was being begun anew, or is damaged; what it had is not "
                                   "needed but to be undone");
    } else {
        problem(c, name.text, offset + RECORD_HEADER_BYTES, "the bricks that this record's checksum vouches for");
    }
}

static status look_at_file(check *c, uint32_t file)
{
    const ring_name name = ring_name_of(file);
    ring_file *f = &c->files.files[file];
    uint8_t bytes[PREAMBLE_HEADER_BYTES_MAX];
    size_t have = 0;
    record r, last = {.use = 0};
    preamble_trouble trouble = {0, ""};
    uint64_t offset = 0;
    status s = STATUS_OK;
    for (;; offset += record_span(r.stored)) {
        s = look_at(c, name.text, offset, &r, bytes, &have, &trouble);
        if (s != STATUS_OK || (last.use != 0 && r.use != last.use))
            break;
        if (last.use != 0 && (r.sequence != last.sequence + 1 || r.before != last.seal))
            break; /* left over from before a power cut */
        f->use = r.use;
        f->first = last.use ? f->first : r.sequence;
        f->last = r.sequence;
        last = r;
        s = ring_read_bricks(&c->files, file, offset, &r, &c->bricks);
        if (s == STATUS_NO_MEMORY)
            return s;
        if (s == STATUS_OK)
            c->facts->records++;
        else
            unsound_bricks(c, file, offset, &r);
    }
    if (s != STATUS_OK)
        end_of_file(c, file, offset, s, bytes, have, &trouble);
    c->facts->undo_files += last.use != 0;
    return STATUS_OK;
}

/* The use that was given last, by first records alone. */
static void find_newest(check *c)
{
    record r;
    for (uint32_t n = 0; n < c->files.count; n++)
        if (c->files.files[n].bytes > 0 && ring_read_header(&c->files, n, 0, &r) == STATUS_OK && r.use > c->newest)
            c->newest = r.use;
}

/* --- checkpoints --- */

static status look_at_field(check *c, const char *name)
{
    stored_file from = {c->store, name};
    uint64_t size = 0;
    bool exists = false;
    status s = c->store->size(c->store->self, name, &size, &exists);
    if (s == STATUS_OK && !exists)
        return STATUS_OK;
    clay read;
    if (s == STATUS_OK)
        s = clay_init(&read, CAPACITY_BRICKS);
    if (s != STATUS_OK)
        return s;
    checkpoint_facts facts;
    checkpoint_trouble trouble;
    s = checkpoint_read(&read, &facts, stored_file_get, &from, &trouble);
    clay_finish(&read);
    if (s == STATUS_NO_MEMORY)
        return s;
    if (s != STATUS_OK) {
        problem(c, name, trouble.offset, trouble.expected);
        return STATUS_OK;
    }
    c->beneath = c->facts->checkpoints++ == 0 || facts.sequence < c->beneath ? facts.sequence : c->beneath;
    if (facts.sequence >= c->base.sequence)
        c->base = (link){facts.sequence, facts.seal, 0};
    return STATUS_OK;
}

/* --- do the records since then follow on? --- */

/* The undo-file whose records go on with this sequence; the latest written of them. */
static uint32_t file_with(const check *c, uint64_t sequence)
{
    uint32_t best = RING_NONE;
    for (uint32_t n = 0; n < c->files.count; n++) {
        const ring_file *f = &c->files.files[n];
        if (f->use != 0 && f->first <= sequence && sequence <= f->last &&
            (best == RING_NONE || f->use > c->files.files[best].use))
            best = n;
    }
    return best;
}

static void look_for_gaps(check *c)
{
    uint64_t last = 0;
    for (uint32_t n = 0; n < c->files.count; n++)
        last = c->files.files[n].use != 0 && c->files.files[n].last > last ? c->files.files[n].last : last;
    for (uint64_t at = c->base.sequence + 1; at <= last;) {
        const uint32_t file = file_with(c, at);
        if (file == RING_NONE) {
            problem(c, HISTORY_FIELD_NAME, WHOLE_FILE,
                    "is not followed on by all records that were made since: some undo-file is missing or damaged");
            return;
        }
        at = c->files.files[file].last + 1;
    }
}

static void take_name(void *self, const char *name)
{
    if (strstr(name, ".set-aside"))
        note((check *)self, name, WHOLE_FILE, "was set aside earlier");
}

status check_run(const byte_store *store, check_teller tell, void *self, check_facts *facts_out)
{
    check c = {.store = store, .tell = tell, .self = self, .facts = facts_out, .half_begun = RING_NONE};
    memset(facts_out, 0, sizeof *facts_out);
    status s = ring_open(&c.files, store);
    if (s == STATUS_OK)
        s = look_at_field(&c, HISTORY_FIELD_BEFORE_NAME);
    if (s == STATUS_OK)
        s = look_at_field(&c, HISTORY_FIELD_NAME);
    if (facts_out->checkpoints < 2)
        c.beneath = 0;
    if (s == STATUS_OK) {
        find_newest(&c);
        for (uint32_t n = 0; s == STATUS_OK && n < c.files.count; n++)
            if (c.files.files[n].bytes > 0)
                s = look_at_file(&c, n);
    }
    if (s == STATUS_OK) {
        look_for_gaps(&c);
        s = store->list(store->self, take_name, &c);
    }
    byte_buffer_finish(&c.bricks);
    ring_close(&c.files);
    return s;
}
