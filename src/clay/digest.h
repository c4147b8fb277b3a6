/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    64-bit digests of bytes (XXH3), the only door to the hash library: "same input, same bits" is said in them.
 * Is not:  A guard against an adversary; a checksum that is compatible with anything outside glaise.
 * Errors:  None.
 * Cost:    about memory bandwidth.
 */
#ifndef GLAISE_CLAY_DIGEST_H
#define GLAISE_CLAY_DIGEST_H

#include "clay/brick.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

uint64_t digest_bytes(const void *bytes, size_t n, uint64_t seed);
/* What a brick that stores a corner adds to clay_digest. */
uint64_t digest_brick(key at, const brick_page *page);

#ifdef __cplusplus
}
#endif
#endif
