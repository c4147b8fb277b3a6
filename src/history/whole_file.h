/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Named files of a byte store taken as wholes: read, replaced atomically, set aside.
 * Is not:  Any format; the store (byte_store.h).
 * Shape:   replacing is: remove what an earlier try left under the temporary name, write it anew, sync, rename. So
 *          bytes that a failed sync may have dropped are never synced a second time, and a reader sees the old file or
 *          the new one.
 * Errors:  what the store answers; STATUS_NO_MEMORY.
 * Cost:    replacing takes two syncs of the store (the file's, the rename's).
 */
#ifndef GLAISE_HISTORY_WHOLE_FILE_H
#define GLAISE_HISTORY_WHOLE_FILE_H

#include "history/byte_buffer.h"
#include "history/byte_store.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The whole file; absent: *exists_out false, size 0. */
STATUS_CHECKED status whole_file_read(const byte_store *store, const char *name, byte_buffer *out, bool *exists_out);

/* The first n bytes, fewer if it has no more; absent: *exists_out false. *size_out is that of the whole file. */
STATUS_CHECKED status whole_file_read_head(const byte_store *store, const char *name, void *bytes, size_t n,
                                           size_t *got_out, uint64_t *size_out, bool *exists_out);

/* The first half of replacing: after STATUS_OK the bytes are durable under the temporary name; the store's rename is
   the other. */
STATUS_CHECKED status whole_file_write(const byte_store *store, const char *temporary, const void *bytes, size_t n);
/* Both halves. */
STATUS_CHECKED status whole_file_replace(const byte_store *store, const char *temporary, const char *name,
                                         const void *bytes, size_t n);

/* Renames to "<name>.set-aside", or to the first of "<name>.set-aside-2", -3, ... that is free. Absent: STATUS_OK. */
STATUS_CHECKED status whole_file_set_aside(const byte_store *store, const char *name);

#ifdef __cplusplus
}
#endif
#endif
