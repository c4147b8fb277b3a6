/* SPDX-License-Identifier: Apache-2.0 */
#ifndef GLAISE_STORAGE_STORAGE_H
#define GLAISE_STORAGE_STORAGE_H

/*
 * What    Named files in one folder, with the promises a power cut tests: what a sync acknowledged is on the medium, a
 *         rename replaces atomically, and two stations never share a folder.
 * Is not  A format, a history (wiring hands these calls to it as its byte store). Files elsewhere that a person asked
 *         for (storage_export.h).
 * Shape   Names are 1 to 63 of [a-z0-9._-], not "." or ".."; only regular files. A file that was written stays open
 *         until it is renamed or removed, so that no error of the kernel's own writing is lost between a write and its
 *         sync. STORAGE_OPEN_MAX files may be so at a time; one more syncs and closes the one that has waited longest.
 * Units   Bytes.
 * Owner   The caller owns the struct; storage_close releases the folder.
 * Errors  0, or a negative errno. -EINVAL: not a name, or not a regular file. -EWOULDBLOCK: another storage holds
 *         the folder. Absence is a state where a function says so, else -ENOENT.
 *         After a failed sync Linux takes the lost pages for clean, and a second sync would succeed without them. So
 *         the file is spoilt: nothing is written to it or synced any more (-EIO) until it is removed or replaced by a
 *         rename. It may be read, and renamed to be kept aside. What Linux holds of those pages is dropped at once, so
 *         that it is the medium that is read, also by the next process. One that died before its sync leaves pages that
 *         Linux goes on to write: they are waited for when the file is opened, and dropped if that failed. What is left
 *         is a process killed between the sync that failed and the drop, some microseconds.
 * Cost    A sync is one fdatasync, and one fsync of the folder when the name is new; a rename one fsync of the folder.
 *         Opening a file of which nothing waits to be written: a system call more, below a microsecond.
 * Source  facts/devices.md section G1; rename(2), fsync(2).
 */

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define STORAGE_CHECKED __attribute__((warn_unused_result))

enum { STORAGE_NAME_MAX = 63, STORAGE_OPEN_MAX = 8 };

typedef struct storage_file {
    char name[STORAGE_NAME_MAX + 1]; /* "": this place is free */
    int fd;                          /* -1: spoilt */
    bool written;                    /* since its last sync */
    bool name_is_new;                /* since the folder's last sync */
    uint64_t turn;                   /* when it was last used */
} storage_file;

typedef struct storage {
    int folder_fd; /* locked */
    uint64_t turn;
    storage_file files[STORAGE_OPEN_MAX];
} storage;

/* Makes the folder if it is not there (its parent must be), locks it, and syncs it: names that an earlier storage left
   are on the medium, or this fails. A folder on a medium that may only be read is opened all the same. */
STORAGE_CHECKED int storage_open(storage *s, const char *folder);
/* Syncs nothing. */
void storage_close(storage *s);

/* Up to n bytes from offset; fewer only at the end of the file. Absent: 0 bytes. */
STORAGE_CHECKED int storage_read(storage *s, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got_out);
/* Makes the file when absent; a gap before offset reads as zero. */
STORAGE_CHECKED int storage_write(storage *s, const char *name, uint64_t offset, const void *bytes, size_t n);
STORAGE_CHECKED int storage_size(storage *s, const char *name, uint64_t *bytes_out, bool *exists_out);
/* Cuts, or lengthens with zeros; makes the file when absent. */
STORAGE_CHECKED int storage_truncate(storage *s, const char *name, uint64_t bytes);
/* After 0 the file's bytes and its name are on the medium. */
STORAGE_CHECKED int storage_sync(storage *s, const char *name);
/* After 0 the name `to` stands for the file, on the medium. A file not yet synced is synced first. */
STORAGE_CHECKED int storage_rename(storage *s, const char *from, const char *to);
/* Absent: 0. Until the next sync or rename a power cut may bring it back. */
STORAGE_CHECKED int storage_remove(storage *s, const char *name);
/* Tells the name of every regular file that has a good one, in any order. */
STORAGE_CHECKED int storage_list(storage *s, void (*take)(void *into, const char *name), void *into);

#ifdef __cplusplus
}
#endif

#endif
