/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The undo-files: which there are, what lies in each, and the writing and reading of records in them.
 * Is not:  What a record says (record.h); which file may be written anew (history.c); which records count (recovery.h).
 * Shape:   files "undo-0000", "undo-0001", ... of a fixed size each, written with zeros when they are made, so that a
 *          record never makes a file longer. Every file that is begun, or begun anew, gets the next use; its records
 *          lie one behind the other from its beginning and carry that use, so that what an earlier use left behind them
 *          is told apart. A stroke begins a file and goes on in as many as it needs; moves follow wherever there is
 *          room.
 *
 *              undo-0003   use 17   | stroke 5 part 0 | part 1 | part 2 | move | move | ...left from use 9... |
 *              undo-0000   use 18   | stroke 6 part 0 | part 1 |
 *
 * Owner:   the caller owns the struct and the store; the ring its table.
 * Errors:  what the store answers; STATUS_NO_MEMORY; STATUS_CORRUPT and STATUS_NEWER from reading a record.
 *          A file whose writing or sync failed is spoilt: what it held before may be read, nothing more is written.
 * Cost:    a record is one write; making a file writes and syncs all of it.
 */
#ifndef GLAISE_HISTORY_RING_H
#define GLAISE_HISTORY_RING_H

#include "history/byte_buffer.h"
#include "history/byte_store.h"
#include "history/record.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { RING_FILES_MAX = 10000, RING_NAME_BYTES = 10, RING_FILE_BYTES_MIN = 32768 };

#define RING_NONE UINT32_MAX

typedef struct ring_file {
    uint64_t bytes;       /* its size; 0: there is no such file */
    uint64_t use;         /* 0: nothing was ever found in it */
    uint64_t stroke;      /* whose records it has, 0: nobody's */
    uint64_t first, last; /* sequences of the records that count; last < first: none do */
    uint64_t end;         /* where the next record goes */
    bool free;            /* may be begun anew */
    bool spoilt;
} ring_file;

typedef struct ring {
    const byte_store *store;
    ring_file *files; /* by number */
    uint32_t count, room;
    uint32_t current; /* the file being written, or RING_NONE */
    uint64_t use;     /* the last one given */
    uint64_t bytes;   /* of all files */
} ring;

typedef struct ring_name {
    char text[RING_NAME_BYTES];
} ring_name;

ring_name ring_name_of(uint32_t file);

/* Finds the files there are; what lies in them is not looked at: use 0, all free. */
STATUS_CHECKED status ring_open(ring *r, const byte_store *store);
void ring_close(ring *r); /* a zeroed ring is fine */

/* Makes one more file, under the lowest number that has none. */
STATUS_CHECKED status ring_make(ring *r, uint64_t bytes, uint32_t *file_out);
/* A file is the ring's no more: removed from the store, or set aside there (stored_file.h). */
STATUS_CHECKED status ring_remove(ring *r, uint32_t file);
STATUS_CHECKED status ring_set_aside(ring *r, uint32_t file);
/* The free file of so many bytes that was begun longest ago; RING_NONE: there is none. */
uint32_t ring_free_file(const ring *r, uint64_t bytes_least);
/* It becomes current, empty, of the next use. */
void ring_begin(ring *r, uint32_t file, uint64_t stroke);
bool ring_has_room(const ring *r, uint32_t file, uint64_t stored);
/* Seals the record and writes it: header and bricks lie in one piece, header first. It counts from then on. */
STATUS_CHECKED status ring_write(ring *r, uint32_t file, record *written, uint8_t *header);

/* The header at a place. STATUS_CORRUPT: no record lies there. */
STATUS_CHECKED status ring_read_header(const ring *r, uint32_t file, uint64_t offset, record *r_out);
/* The bricks of a record whose header was read; STATUS_CORRUPT when they are not what it says. */
STATUS_CHECKED status ring_read_bricks(const ring *r, uint32_t file, uint64_t offset, const record *header,
                                       byte_buffer *out);

/* The first file in which records of this stroke count, then the next: those of use above `use`. RING_NONE: no more. */
uint32_t ring_next_file(const ring *r, uint64_t stroke, uint64_t use);

#ifdef __cplusplus
}
#endif
#endif
