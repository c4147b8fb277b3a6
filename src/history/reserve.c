/* SPDX-License-Identifier: Apache-2.0 */
#include "history/reserve.h"

#include <assert.h>

enum { ZEROS_BYTES = 65536, SYNC_SLICES = 8 };

void reserve_open(reserve *r, const byte_store *store)
{
    bool exists = false;
    *r = (reserve){.store = store};
    if (store->size(store->self, RESERVE_NAME, &r->bytes, &exists) != STATUS_OK || !exists)
        r->bytes = 0;
}

static void drop(reserve *r)
{
    r->spoilt = r->store->remove(r->store->self, RESERVE_NAME) != STATUS_OK;
    r->bytes = r->unsynced = 0;
}

uint64_t reserve_give(reserve *r, uint64_t bytes)
{
    const uint64_t had = r->bytes;
    if (r->spoilt || had == 0)
        return 0;
    r->bytes = had > bytes ? had - bytes : 0;
    if (r->bytes == 0 || r->store->truncate(r->store->self, RESERVE_NAME, r->bytes) != STATUS_OK)
        drop(r); /* what cannot be cut may yet go as a whole */
    return r->spoilt ? 0 : had - r->bytes;
}

static status put_zeros(reserve *r, uint64_t end)
{
    static const uint8_t zeros[ZEROS_BYTES];
    status s = STATUS_OK;
    while (s == STATUS_OK && r->bytes < end) {
        const uint64_t left = end - r->bytes;
        const size_t n = left < ZEROS_BYTES ? (size_t)left : ZEROS_BYTES;
        s = r->store->write(r->store->self, RESERVE_NAME, r->bytes, zeros, n);
        if (s == STATUS_OK) {
            r->bytes += n;
            r->unsynced += n;
        }
    }
    return s;
}

/* What was written before the medium was full is kept, what came half is cut off. */
static status end_short(reserve *r)
{
    status s = r->store->truncate(r->store->self, RESERVE_NAME, r->bytes);
    return s == STATUS_OK ? r->store->sync(r->store->self, RESERVE_NAME) : s;
}

status reserve_grow(reserve *r, uint64_t bytes, bool *done_out)
{
    assert(bytes > r->bytes && !r->spoilt);
    const uint64_t end = bytes - r->bytes < RESERVE_SLICE_BYTES ? bytes : r->bytes + RESERVE_SLICE_BYTES;
    status s = put_zeros(r, end), kept = STATUS_OK;
    *done_out = s == STATUS_OK && end == bytes;
    if (s == STATUS_NO_SPACE && r->bytes > 0)
        kept = end_short(r);
    else if (s == STATUS_OK && (*done_out || r->unsynced >= SYNC_SLICES * (uint64_t)RESERVE_SLICE_BYTES))
        kept = r->store->sync(r->store->self, RESERVE_NAME);
    if (kept != STATUS_OK || (s != STATUS_OK && (s != STATUS_NO_SPACE || r->bytes == 0)))
        drop(r);
    if (s == STATUS_NO_SPACE || r->unsynced >= SYNC_SLICES * (uint64_t)RESERVE_SLICE_BYTES || *done_out)
        r->unsynced = 0;
    *done_out = *done_out && kept == STATUS_OK;
    return s == STATUS_OK ? kept : s;
}
