/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The beginning that all files of this room share: a mark, a version, a header that vouches for itself.
 * Is not:  The rest of any header (checkpoint.h, record.h draw their own).
 * Shape:   little-endian, in every version there will be:
 *            offset size
 *                 0    8  mark: which kind of file; ends in "\r\n", so that a text-mode copy spoils it
 *                 8    4  version, from 1
 *                12    4  header bytes H, 24..PREAMBLE_HEADER_BYTES_MAX
 *                16 H-24  what that version says
 *               H-8    8  XXH3-64 of bytes 0..H-9
 *          Because the checksum's place is known, a flipped version is told from a newer one.
 * Errors:  STATUS_CORRUPT, STATUS_NEWER (only when the checksum holds), with the place and what was expected.
 */
#ifndef GLAISE_HISTORY_PREAMBLE_H
#define GLAISE_HISTORY_PREAMBLE_H

#include "lattice/status.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { PREAMBLE_BYTES = 16, PREAMBLE_CHECKSUM_BYTES = 8, PREAMBLE_HEADER_BYTES_MAX = 512 };

typedef struct preamble {
    const char *mark; /* eight characters */
    uint32_t version; /* the one this program writes, and the newest it reads */
    uint32_t header_bytes;
} preamble;

typedef struct preamble_trouble {
    uint64_t offset;
    const char *expected; /* "a mark of ...", static storage */
} preamble_trouble;

/* Fills the first 16 and the last 8 of the header's bytes; the others must be in place. */
void preamble_seal(const preamble *p, uint8_t *header);
/* bytes: the first `have` of the file, PREAMBLE_HEADER_BYTES_MAX of them if it has so many. */
STATUS_CHECKED status preamble_check(const preamble *p, const uint8_t *bytes, size_t have,
                                     preamble_trouble *trouble_out);

#ifdef __cplusplus
}
#endif
#endif
