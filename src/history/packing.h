/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Bytes made fewer before they go to the medium, and back: zstd, fast before small, every piece by itself.
 * Is not:  A checksum: whoever lays pieces down vouches for what lies there (record.h, checkpoint.h).
 * Shape:   one zstd frame; whoever unpacks knows how many bytes it had.
 * Owner:   the caller owns all bytes; a packing is room to work in, which one thread at a time may use.
 * Errors:  STATUS_CORRUPT: not what was packed. STATUS_NEWER where the program was built without zstd
 *          (GLAISE_PACKING=OFF, for machines whose libraries are not at hand): it packs nothing.
 * Cost:    600 MB/s to pack, 1.5 GB/s to unpack; some 100 KiB of room. A field takes a quarter of its bytes, strokes
 *          take less than half. The same bytes pack to the same as long as the library is the same.
 */
#ifndef GLAISE_HISTORY_PACKING_H
#define GLAISE_HISTORY_PACKING_H

#include "lattice/status.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct packing packing;

/* NULL when there is no memory for one: packing then packs nothing. */
packing *packing_open(void);
void packing_close(packing *p); /* NULL is fine */

/* At `to`, where there is room for n: the bytes it took, fewer than n, packed; or n, as they are, where packing gains
   nothing. */
size_t packing_pack(packing *p, uint8_t *to, const uint8_t *from, size_t n);
/* Exactly n bytes, from `packed` bytes that packing_pack answered; packed == n: as they are. Never writes beyond n,
   whatever it reads. */
STATUS_CHECKED status packing_unpack(uint8_t *to, size_t n, const uint8_t *from, size_t packed);

#ifdef __cplusplus
}
#endif
#endif
