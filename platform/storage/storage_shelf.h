/* SPDX-License-Identifier: Apache-2.0 */
#ifndef GLAISE_STORAGE_STORAGE_SHELF_H
#define GLAISE_STORAGE_STORAGE_SHELF_H

/*
 * What    Folders inside a storage's folder: told, measured, renamed, removed with the files in them. A file in one is
 *         read without opening the folder as a storage.
 * Is not  The files of an open folder (storage.h). The writing of one (storage_export.h).
 * Shape   Names as storage.h has them; only real folders, no links to some. One storage holds the outer folder open and
 *         thereby keeps other stations out; each inner one is locked by the storage that opened it.
 * Units   Bytes.
 * Owner   The storage stays the caller's. Nothing in it changes, so several threads may call at a time.
 * Errors  0, or a negative errno. -EINVAL: not a name, or not a plain file. -EWOULDBLOCK: the folder to be renamed or
 *         removed is open. -ENOTEMPTY: something in it is no file: it stays, the files are gone.
 * Cost    A rename is one fsync of the outer folder. A removal is not synced: a cut may bring back what was removed.
 */

#include "platform/storage/storage.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Tells every folder's name, in any order. */
STORAGE_CHECKED int storage_shelf_list(const storage *s, void (*take)(void *into, const char *name), void *into);
/* The first n bytes, fewer if the file has no more. Absent: 0 with *exists_out false. */
STORAGE_CHECKED int storage_shelf_read(const storage *s, const char *folder, const char *file, void *bytes, size_t n,
                                       size_t *got_out, bool *exists_out);
/* After 0 the name `to` stands for the folder, on the medium. */
STORAGE_CHECKED int storage_shelf_rename(const storage *s, const char *from, const char *to);
/* Absent: 0. */
STORAGE_CHECKED int storage_shelf_remove(const storage *s, const char *folder);
/* What the files in it take on the medium. */
STORAGE_CHECKED int storage_shelf_bytes(const storage *s, const char *folder, uint64_t *bytes_out);
/* What is free on the medium, for who this is. */
STORAGE_CHECKED int storage_shelf_free(const storage *s, uint64_t *bytes_out);

#ifdef __cplusplus
}
#endif

#endif
