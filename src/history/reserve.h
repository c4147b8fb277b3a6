/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The reserve: one more file of a store, of zeros, that holds space for when the medium is full. It gives it
 *          back piece by piece to what must be written then, and is made whole again when there is room.
 * Is not:  Data: nothing in it is ever read, and whatever its size, or that it is not there, means nothing but how much
 *          it can give. Who gets what of it, and when it is made, is history_keep.c's.
 * Shape:   "reserve", written with zeros and synced, so that its blocks are really there. It gives from its end.
 * Units:   bytes.
 * Owner:   the caller owns struct and store.
 * Errors:  what the store answers. A file that could not be written or synced is removed, and when that fails too it is
 *          left alone from then on (`spoilt`).
 * Cost:    growing: a slice of RESERVE_SLICE_BYTES is written, and now and then synced. Giving: a truncate.
 */
#ifndef GLAISE_HISTORY_RESERVE_H
#define GLAISE_HISTORY_RESERVE_H

#include "history/byte_store.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RESERVE_NAME "reserve"

enum { RESERVE_SLICE_BYTES = 1024 * 1024 };

typedef struct reserve {
    const byte_store *store;
    uint64_t bytes;    /* that it can give */
    uint64_t unsynced; /* of them */
    bool spoilt;
} reserve;

/* Of an earlier process as it was left; what cannot be asked for is taken for absent. */
void reserve_open(reserve *r, const byte_store *store);
/* The medium has up to so many bytes more room; answers how many, 0 when there are none to give. */
uint64_t reserve_give(reserve *r, uint64_t bytes);
/* One slice longer, up to `bytes` in all, which is more than there are; *done_out: it is so long, and synced.
   STATUS_NO_SPACE: it stays as long as it could be made. */
STATUS_CHECKED status reserve_grow(reserve *r, uint64_t bytes, bool *done_out);

#ifdef __cplusplus
}
#endif
#endif
