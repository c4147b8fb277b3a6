/* SPDX-License-Identifier: Apache-2.0 */
#include "clay/digest.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

uint64_t digest_bytes(const void *bytes, size_t n, uint64_t seed) { return XXH3_64bits_withSeed(bytes, n, seed); }

uint64_t digest_brick(key at, const brick_page *page)
{
    const int32_t k[3] = {at.i, at.j, at.k};
    return digest_bytes(page, sizeof *page, digest_bytes(k, sizeof k, 0));
}
