/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A fixed-limit pool of equal items named by 32-bit ids. Memory comes in slabs as it is first needed
 *          and stays with the pool; an item never moves, so a pointer holds until its item is given back.
 * Is not:  A general allocator (one size only); thread-safe (one writer).
 * Shape:   items 0..limit-1 in slabs of 2^slab_shift items, 64-byte aligned; given-back ids form a stack inside
 *          the items themselves, lowest fresh id next when the stack is empty.
 * Owner:   the caller owns the struct; pool_finish frees every slab.
 * Errors:  STATUS_POOL_FULL at the limit, STATUS_NO_MEMORY when the machine refuses a slab; nothing changes then.
 *          A foreign id is our bug: asserted. Giving an item back twice is a bug that pool_count exposes, not an
 *          assert: the pool keeps no mark per item.
 * Cost:    take and give O(1); a take that opens a slab pays one allocation.
 */
#ifndef GLAISE_LATTICE_POOL_H
#define GLAISE_LATTICE_POOL_H

#include "lattice/status.h"

#include <assert.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define POOL_NONE UINT32_MAX /* no item */

typedef struct pool {
    void **slabs;
    size_t item_bytes; /* rounded up to a multiple of 8 */
    uint32_t limit;
    uint32_t slab_shift;
    uint32_t fresh;     /* ids below were taken at least once */
    uint32_t free_head; /* top of the stack of given-back ids, POOL_NONE when empty */
    uint32_t count;     /* items now taken */
} pool;

/* item_bytes >= 4, limit >= 1. Allocates only the slab directory. */
STATUS_CHECKED status pool_init(pool *p, size_t item_bytes, uint32_t limit);
void pool_finish(pool *p); /* a zeroed pool is fine */

/* The next `more` takes will not fail. */
STATUS_CHECKED status pool_reserve(pool *p, uint32_t more);
/* The item's bytes are whatever they were: the taker fills them. */
STATUS_CHECKED status pool_take(pool *p, uint32_t *id_out);
void pool_give(pool *p, uint32_t id);
/* Everything back at once; slabs stay. */
void pool_clear(pool *p);
/* to (uninitialised) becomes a duplicate of from, ids and all. STATUS_NO_MEMORY leaves nothing. */
STATUS_CHECKED status pool_copy(pool *to, const pool *from);

/* Somebody's own notes on a pool's items, kept beside it: grows *array, of *room items of item_bytes, until every id
   that was ever taken has one; new ones are zero. STATUS_NO_MEMORY leaves the array as it was. The caller frees it. */
STATUS_CHECKED status pool_shadow(const pool *p, void **array, uint32_t *room, size_t item_bytes);

static inline uint32_t pool_room(const pool *p) { return p->limit - p->count; }
size_t pool_bytes(const pool *p); /* memory held in slabs */

static inline void *pool_at(const pool *p, uint32_t id)
{
    assert(id < p->fresh);
    return (char *)p->slabs[id >> p->slab_shift] + (size_t)(id & ((1u << p->slab_shift) - 1)) * p->item_bytes;
}

#ifdef __cplusplus
}
#endif
#endif
