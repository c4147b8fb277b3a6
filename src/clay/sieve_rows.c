/* SPDX-License-Identifier: Apache-2.0 */
#include "clay/sieve_rows.h"

#include "clay/potential.h"
#include "lattice/vec.h"

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "files are little-endian, and so are the machines we know"
#endif

uint32_t LANES_NAMED(sieve_rows_changed)(const brick_page *a, const brick_page *b, brick_mask *mask_out)
{
    const uint32_t *potential_a = (const uint32_t *)(const void *)a->potential;
    const uint32_t *potential_b = (const uint32_t *)(const void *)b->potential;
    for (int s = 0; s < BRICK_EDGE; s++) {
        uint64_t w = 0;
        for (int n = 0; n < 64; n += VEC_LANES) {
            const int at = s * 64 + n;
            vec_u differs = (vec_load_u(potential_a + at) ^ vec_load_u(potential_b + at)) |
                            (vec_load_u(a->rgba + at) ^ vec_load_u(b->rgba + at));
            w |= (uint64_t)vec_bits(vec_any_u(differs)) << n;
        }
        mask_out->slab[s] = w;
    }
    return brick_mask_count(mask_out);
}

uint32_t LANES_NAMED(sieve_rows_stored)(const brick_page *page, brick_mask *mask_out)
{
    for (int s = 0; s < BRICK_EDGE; s++) {
        uint64_t w = 0;
        for (int n = 0; n < 64; n += VEC_LANES)
            w |= (uint64_t)vec_bits(vec_gt(vec_load(page->potential + s * 64 + n), vec_all(POTENTIAL_MIN))) << n;
        mask_out->slab[s] = w;
    }
    return brick_mask_count(mask_out);
}

uint8_t *LANES_NAMED(sieve_rows_take)(uint8_t *to, const void *words, const brick_mask *mask)
{
    const uint32_t *from = (const uint32_t *)words;
    for (int s = 0; s < BRICK_EDGE; s++) {
        const uint64_t w = mask->slab[s];
        if (w == ~(uint64_t)0) {
            memcpy(to, from + s * 64, 64 * sizeof *from);
            to += 64 * sizeof *from;
            continue;
        }
#if defined(__AVX2__)
        for (int n = 0; n < 64 && w >> n != 0; n += VEC_LANES) {
            const uint32_t bits = (uint32_t)(w >> n & (((uint64_t)1 << VEC_LANES) - 1));
            vec_store_u((uint32_t *)(void *)to, vec_close_up(vec_load_u(from + s * 64 + n), bits));
            to += (size_t)__builtin_popcount(bits) * sizeof *from;
        }
#else
        for (uint64_t left = w; left; left &= left - 1, to += sizeof *from)
            memcpy(to, from + s * 64 + __builtin_ctzll(left), sizeof *from);
#endif
    }
    return to;
}
