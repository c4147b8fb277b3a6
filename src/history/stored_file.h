/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A named file of a byte store: read from any place, read as a checkpoint is, set aside.
 * Is not:  Any format; the store (byte_store.h); the undo-files, of which there are many (ring.h).
 * Errors:  what the store answers.
 */
#ifndef GLAISE_HISTORY_STORED_FILE_H
#define GLAISE_HISTORY_STORED_FILE_H

#include "history/byte_store.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct stored_file {
    const byte_store *store;
    const char *name;
} stored_file;

/* n bytes from offset; fewer only where the file ends, or is not there. A store that gives less than it has is asked
   again. */
STATUS_CHECKED status stored_file_read(const stored_file *f, uint64_t offset, void *bytes, size_t n, size_t *got_out);
/* The same as a checkpoint_source (checkpoint.h): self is a stored_file. */
STATUS_CHECKED status stored_file_get(void *self, uint64_t offset, void *bytes, size_t n, size_t *got_out);

/* Renames to "<name>.set-aside", or to the first of "<name>.set-aside-2", -3, ... that is free. Absent: STATUS_OK. */
STATUS_CHECKED status stored_file_set_aside(const stored_file *f);

#ifdef __cplusplus
}
#endif
#endif
