/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The bytes history needs: a flat folder of named files behind eight calls. Real files implement it
 *          (platform/storage, joined in wiring), so does the tests' failing disk.
 * Is not:  A file system: no folders, no permissions, no clock.
 * Shape:   names are 1 to 63 of [a-z0-9._-], not "." or "..". Offsets and sizes are uint64 bytes.
 * Owner:   whoever made `self`.
 * Errors:  STATUS_IO whenever the medium fails, STATUS_NO_SPACE when it is full; what a failed write left behind is
 *          undefined until it is read again, and a rename that failed may have happened. After a failed sync nothing
 *          more is written to the file: its bytes go to a new one.
 *          A file that is not there is a state: read answers 0 bytes, size answers 0 with *exists_out false.
 * Cost:    `sync` and `rename` may take long (5 to 30 ms on a card).
 */
#ifndef GLAISE_HISTORY_BYTE_STORE_H
#define GLAISE_HISTORY_BYTE_STORE_H

#include "lattice/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { BYTE_STORE_NAME_MAX = 63 };

typedef struct byte_store {
    void *self;
    /* Up to n bytes from offset; fewer only at the end of the file. */
    status (*read)(void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got_out);
    /* Makes the file when absent; a gap before offset reads as zero. */
    status (*write)(void *self, const char *name, uint64_t offset, const void *bytes, size_t n);
    status (*size)(void *self, const char *name, uint64_t *bytes_out, bool *exists_out);
    /* Cuts, or lengthens with zeros; makes the file when absent. */
    status (*truncate)(void *self, const char *name, uint64_t bytes);
    /* After it returned STATUS_OK the file's bytes and its name are on the medium. */
    status (*sync)(void *self, const char *name);
    /* Atomic replacement, durable when it returned STATUS_OK. `from` must exist and have been synced, unless it is only
       put out of the way. */
    status (*rename)(void *self, const char *from, const char *to);
    /* Absent: STATUS_OK. Until the next sync or rename a power cut may bring it back. */
    status (*remove)(void *self, const char *name);
    /* Tells every file's name, in any order. */
    status (*list)(void *self, void (*take)(void *into, const char *name), void *into);
} byte_store;

#ifdef __cplusplus
}
#endif
#endif
