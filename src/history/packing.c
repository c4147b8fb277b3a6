/* SPDX-License-Identifier: Apache-2.0 */
#include "history/packing.h"

#include <string.h>

#ifdef GLAISE_PACKING

#include <zstd.h>

/* Twice as fast as level 1, and a twentieth larger. */
enum { LEVEL = -1 };

packing *packing_open(void) { return (packing *)ZSTD_createCCtx(); }
void packing_close(packing *p) { ZSTD_freeCCtx((ZSTD_CCtx *)p); }

/* The bytes it took; 0 where that would not be fewer. */
static size_t pack(packing *p, uint8_t *to, const uint8_t *from, size_t n)
{
    const size_t took = p && n > 1 ? ZSTD_compressCCtx((ZSTD_CCtx *)p, to, n - 1, from, n, LEVEL) : 0;
    return ZSTD_isError(took) ? 0 : took;
}

static status unpack(uint8_t *to, size_t n, const uint8_t *from, size_t packed)
{
    return ZSTD_decompress(to, n, from, packed) == n ? STATUS_OK : STATUS_CORRUPT;
}

#else

packing *packing_open(void) { return NULL; }
void packing_close(packing *p) { (void)p; }

static size_t pack(packing *p, uint8_t *to, const uint8_t *from, size_t n)
{
    (void)p;
    (void)to;
    (void)from;
    (void)n;
    return 0;
}

static status unpack(uint8_t *to, size_t n, const uint8_t *from, size_t packed)
{
    (void)to;
    (void)n;
    (void)from;
    (void)packed;
    return STATUS_NEWER;
}

#endif

size_t packing_pack(packing *p, uint8_t *to, const uint8_t *from, size_t n)
{
    const size_t took = pack(p, to, from, n);
    if (took > 0)
        return took;
    memcpy(to, from, n);
    return n;
}

status packing_unpack(uint8_t *to, size_t n, const uint8_t *from, size_t packed)
{
    if (packed > n)
        return STATUS_CORRUPT;
    if (packed < n)
        return unpack(to, n, from, packed);
    if (n > 0)
        memcpy(to, from, n);
    return STATUS_OK;
}
