/* SPDX-License-Identifier: Apache-2.0 */
#include "history/packing.h"

#include <string.h>

#ifdef GLAISE_PACKING

#include <zstd.h>

enum { LEVEL = 1 };

/* The bytes it took; 0 where that would not be fewer. */
static size_t pack(uint8_t *to, const uint8_t *from, size_t n)
{
    const size_t took = n > 1 ? ZSTD_compress(to, n - 1, from, n, LEVEL) : 0;
    return ZSTD_isError(took) ? 0 : took;
}

static status unpack(uint8_t *to, size_t n, const uint8_t *from, size_t packed)
{
    if (ZSTD_getFrameContentSize(from, packed) != n)
        return STATUS_CORRUPT;
    return ZSTD_decompress(to, n, from, packed) == n ? STATUS_OK : STATUS_CORRUPT;
}

#else

static size_t pack(uint8_t *to, const uint8_t *from, size_t n)
{
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

size_t packing_pack(uint8_t *to, const uint8_t *from, size_t n)
{
    const size_t took = pack(to, from, n);
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
