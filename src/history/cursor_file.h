/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The small file that says where in its history a sculpture stands.
 * Is not:  The strokes (undo_file.h) or the field (checkpoint.h): without it both still lead to the last stroke kept.
 * Shape:   little-endian, version 1:
 *            offset size
 *                 0    8  "glcurs\r\n"
 *                 8    4  version (1)
 *                12    4  header bytes (72: all there is; preamble.h says what later versions keep)
 *                16    8  oldest stroke that can be undone
 *                24    8  cursor: the stroke after which the clay stands
 *                32    8  newest stroke that can be redone (the cursor when there is none)
 *                40    8  number of the next dab
 *                48    8  step of the lattice, mm, IEEE double
 *                56    4  files in the ring
 *                60    4  0
 *                64    8  XXH3-64 of bytes 0..63
 *          1 <= oldest <= cursor + 1, cursor <= newest < oldest + ring.
 * Errors:  STATUS_CORRUPT, STATUS_NEWER with the place and what was expected; STATUS_IO.
 * Cost:    rewritten by rename, at every stroke, undo and redo.
 */
#ifndef GLAISE_HISTORY_CURSOR_FILE_H
#define GLAISE_HISTORY_CURSOR_FILE_H

#include "history/byte_store.h"
#include "history/preamble.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CURSOR_FILE_VERSION = 1, CURSOR_FILE_BYTES = 72 };

#define CURSOR_FILE_NAME "cursor"

typedef struct cursor_file {
    uint64_t oldest, cursor, newest;
    uint64_t dab;
    double step_mm;
    uint32_t ring;
} cursor_file;

STATUS_CHECKED status cursor_file_write(const cursor_file *f, const byte_store *store);
/* Absent: STATUS_OK and *exists_out false. */
STATUS_CHECKED status cursor_file_read(cursor_file *f_out, const byte_store *store, bool *exists_out,
                                       preamble_trouble *trouble_out);

#ifdef __cplusplus
}
#endif
#endif
