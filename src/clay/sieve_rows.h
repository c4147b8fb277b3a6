/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Sifts a brick's 512 corners: which changed, which hold clay; and lays those of a mask close together, as
 *          files have them.
 * Is not:  A format (history's record.h, checkpoint.h).
 * Shape:   512 words of 4 bytes, potentials or colours, in slot order; taken, those of the mask in the same order.
 * Errors:  None. All lanes give the same bytes.
 * Cost:    some 100 ns a brick: a fraction of what a hash of the bytes takes.
 */
#ifndef GLAISE_CLAY_SIEVE_ROWS_H
#define GLAISE_CLAY_SIEVE_ROWS_H

#include "clay/brick.h"
#include "lattice/lanes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* sieve_rows_take writes whole vectors: so many bytes beyond the last word may be anything afterwards. */
enum { SIEVE_ROWS_SLACK_BYTES = 64 };

uint32_t sieve_rows_changed_plain(const brick_page *a, const brick_page *b, brick_mask *mask_out);
uint32_t sieve_rows_changed_avx2(const brick_page *a, const brick_page *b, brick_mask *mask_out);
uint32_t sieve_rows_changed_avx512(const brick_page *a, const brick_page *b, brick_mask *mask_out);
uint32_t sieve_rows_stored_plain(const brick_page *page, brick_mask *mask_out);
uint32_t sieve_rows_stored_avx2(const brick_page *page, brick_mask *mask_out);
uint32_t sieve_rows_stored_avx512(const brick_page *page, brick_mask *mask_out);
uint8_t *sieve_rows_take_plain(uint8_t *to, const void *words, const brick_mask *mask);
uint8_t *sieve_rows_take_avx2(uint8_t *to, const void *words, const brick_mask *mask);
uint8_t *sieve_rows_take_avx512(uint8_t *to, const void *words, const brick_mask *mask);

/* Corners whose potential or colour is not the same, bit by bit; answers how many. */
static inline uint32_t sieve_rows_changed(const brick_page *a, const brick_page *b, brick_mask *mask_out, lanes l)
{
    return LANES_PICK(sieve_rows_changed, l)(a, b, mask_out);
}
/* Corners above POTENTIAL_MIN; answers how many. */
static inline uint32_t sieve_rows_stored(const brick_page *page, brick_mask *mask_out, lanes l)
{
    return LANES_PICK(sieve_rows_stored, l)(page, mask_out);
}
/* The words of the mask's corners, little-endian, from `to` on; answers where they end. */
static inline uint8_t *sieve_rows_take(uint8_t *to, const void *words, const brick_mask *mask, lanes l)
{
    return LANES_PICK(sieve_rows_take, l)(to, words, mask);
}

#ifdef __cplusplus
}
#endif
#endif
