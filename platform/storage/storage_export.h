/* SPDX-License-Identifier: Apache-2.0 */
#ifndef GLAISE_STORAGE_STORAGE_EXPORT_H
#define GLAISE_STORAGE_STORAGE_EXPORT_H

/*
 * What    One file at any path, written as a whole: it appears complete and on the medium, or not at all. For what a
 *         person asked for: a mesh, a picture, a piece on a stick.
 * Is not  The sculpture's own store (storage.h). A reader.
 * Shape   begin -> write ... -> end, or abandon. The bytes go to ".<name>.<number>.part" in the same folder, which is
 *         synced and renamed to <name>. A file of that name is replaced in that instant, and kept until then.
 * Owner   The caller owns the struct; _end and _abandon leave nothing to release, and after an error there is nothing
 *         either.
 * Errors  0, or a negative errno. The first error removes the part; every later call answers the same error, so that a
 *         caller may look at the answer of _end alone. A power cut may leave a part behind, never a half <name>.
 * Cost    One system call a write: write in blocks. _end is two syncs.
 */

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { STORAGE_EXPORT_NAME_BYTES = 256 };

typedef struct storage_export {
    int folder_fd, fd; /* -1: not open */
    int error;         /* 0, or the first that happened */
    char name[STORAGE_EXPORT_NAME_BYTES], part[STORAGE_EXPORT_NAME_BYTES];
} storage_export;

/* The folder must be there. */
int storage_export_begin(storage_export *e, const char *path);
int storage_export_write(storage_export *e, const void *bytes, size_t n);
__attribute__((warn_unused_result)) int storage_export_end(storage_export *e);
/* Harmless after _end, and after an error. */
void storage_export_abandon(storage_export *e);

#ifdef __cplusplus
}
#endif

#endif
