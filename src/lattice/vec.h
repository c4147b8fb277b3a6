/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The widest vectors of the instruction set a file is compiled for: VEC_LANES floats or integers that are
 *          computed with at once. + - * / & | ^ ~ << >> between vectors are the compiler's own.
 * Is not:  A choice at run time (lanes.h): only *_rows.c files include it.
 * Shape:   vec_f floats, vec_i int32, vec_u uint32, vec_m one truth a lane. VEC_LANES is 4, 8 or 16, so that a slab of
 *          64 corners is a whole number of vectors. Everything rounds as the scalar operation does.
 * Errors:  None.
 */
#ifndef GLAISE_LATTICE_VEC_H
#define GLAISE_LATTICE_VEC_H

#include <stdint.h>
#include <string.h>

#if defined(__x86_64__)
#include <immintrin.h>
#else
#include <math.h>
#endif

#if defined(__AVX512F__)
enum { VEC_LANES = 16 };
#elif defined(__AVX2__)
enum { VEC_LANES = 8 };
#else
enum { VEC_LANES = 4 };
#endif

typedef float vec_f __attribute__((vector_size(VEC_LANES * 4)));
typedef int32_t vec_i __attribute__((vector_size(VEC_LANES * 4)));
typedef uint32_t vec_u __attribute__((vector_size(VEC_LANES * 4)));

#define VEC_INLINE static inline __attribute__((always_inline))

VEC_INLINE vec_f vec_load(const float *p)
{
    vec_f v;
    memcpy(&v, p, sizeof v);
    return v;
}
VEC_INLINE void vec_store(float *p, vec_f v) { memcpy(p, &v, sizeof v); }
VEC_INLINE vec_u vec_load_u(const uint32_t *p)
{
    vec_u v;
    memcpy(&v, p, sizeof v);
    return v;
}
VEC_INLINE void vec_store_u(uint32_t *p, vec_u v) { memcpy(p, &v, sizeof v); }

/* The same in every lane. (x - 0 is x, bit by bit.) */
VEC_INLINE vec_f vec_all(float x)
{
    const vec_f zero = {0};
    return x - zero;
}
VEC_INLINE vec_u vec_all_u(uint32_t x)
{
    const vec_u zero = {0};
    return x - zero;
}

VEC_INLINE vec_f vec_float_of(vec_i v) { return __builtin_convertvector(v, vec_f); }
/* Towards zero; in int32's range. */
VEC_INLINE vec_i vec_int_of(vec_f v) { return __builtin_convertvector(v, vec_i); }

#if defined(__AVX512F__)

typedef __mmask16 vec_m;
VEC_INLINE vec_m vec_gt(vec_f a, vec_f b) { return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_GT_OQ); }
VEC_INLINE vec_m vec_ge(vec_f a, vec_f b) { return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_GE_OQ); }
VEC_INLINE vec_m vec_ne(vec_f a, vec_f b) { return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_NEQ_UQ); }
VEC_INLINE vec_f vec_pick(vec_m m, vec_f yes, vec_f no)
{
    return (vec_f)_mm512_mask_blend_ps(m, (__m512)no, (__m512)yes);
}
VEC_INLINE vec_u vec_pick_u(vec_m m, vec_u yes, vec_u no)
{
    return (vec_u)_mm512_mask_blend_epi32(m, (__m512i)no, (__m512i)yes);
}
/* a < b ? a : b, and a > b ? a : b: the second where one is not a number. */
VEC_INLINE vec_f vec_least(vec_f a, vec_f b) { return (vec_f)_mm512_min_ps((__m512)a, (__m512)b); }
VEC_INLINE vec_f vec_most(vec_f a, vec_f b) { return (vec_f)_mm512_max_ps((__m512)a, (__m512)b); }
/* Bit n: lane n. */
VEC_INLINE unsigned vec_bits(vec_m m) { return m; }
VEC_INLINE vec_f vec_sqrt(vec_f v) { return (vec_f)_mm512_sqrt_ps((__m512)v); }
/* Lanes that are not zero. */
VEC_INLINE vec_m vec_any_u(vec_u v) { return _mm512_test_epi32_mask((__m512i)v, (__m512i)v); }
VEC_INLINE vec_m vec_eq_u(vec_u a, vec_u b) { return _mm512_cmpeq_epi32_mask((__m512i)a, (__m512i)b); }
/* The lanes of the bits, close together in the lowest places; what is above them may be anything. Not for plain C. */
VEC_INLINE vec_u vec_close_up(vec_u v, uint32_t bits)
{
    return (vec_u)_mm512_maskz_compress_epi32((__mmask16)bits, (__m512i)v);
}

#elif defined(__AVX2__)

typedef vec_i vec_m;
VEC_INLINE vec_m vec_gt(vec_f a, vec_f b) { return a > b; }
VEC_INLINE vec_m vec_ge(vec_f a, vec_f b) { return a >= b; }
VEC_INLINE vec_m vec_ne(vec_f a, vec_f b) { return a != b; }
VEC_INLINE vec_f vec_pick(vec_m m, vec_f yes, vec_f no)
{
    return (vec_f)_mm256_blendv_ps((__m256)no, (__m256)yes, (__m256)m);
}
VEC_INLINE vec_u vec_pick_u(vec_m m, vec_u yes, vec_u no) { return (vec_u)vec_pick(m, (vec_f)yes, (vec_f)no); }
VEC_INLINE vec_f vec_least(vec_f a, vec_f b) { return (vec_f)_mm256_min_ps((__m256)a, (__m256)b); }
VEC_INLINE vec_f vec_most(vec_f a, vec_f b) { return (vec_f)_mm256_max_ps((__m256)a, (__m256)b); }
VEC_INLINE unsigned vec_bits(vec_m m) { return (unsigned)_mm256_movemask_ps((__m256)m); }
VEC_INLINE vec_f vec_sqrt(vec_f v) { return (vec_f)_mm256_sqrt_ps((__m256)v); }
VEC_INLINE vec_m vec_any_u(vec_u v) { return v != 0; }
VEC_INLINE vec_m vec_eq_u(vec_u a, vec_u b) { return a == b; }
VEC_INLINE vec_u vec_close_up(vec_u v, uint32_t bits)
{
    /* A byte a lane: those of the bits, then their numbers, close together. */
    const uint64_t chosen = _pdep_u64(bits, 0x0101010101010101u) * 0xff;
    const __m128i places = _mm_cvtsi64_si128((long long)_pext_u64(0x0706050403020100u, chosen));
    return (vec_u)_mm256_permutevar8x32_epi32((__m256i)v, _mm256_cvtepu8_epi32(places));
}

#else

typedef vec_i vec_m;
VEC_INLINE vec_m vec_gt(vec_f a, vec_f b) { return a > b; }
VEC_INLINE vec_m vec_ge(vec_f a, vec_f b) { return a >= b; }
VEC_INLINE vec_m vec_ne(vec_f a, vec_f b) { return a != b; }
VEC_INLINE vec_u vec_pick_u(vec_m m, vec_u yes, vec_u no) { return (yes & (vec_u)m) | (no & ~(vec_u)m); }
VEC_INLINE vec_f vec_pick(vec_m m, vec_f yes, vec_f no) { return (vec_f)vec_pick_u(m, (vec_u)yes, (vec_u)no); }
VEC_INLINE vec_m vec_any_u(vec_u v) { return v != 0; }
VEC_INLINE vec_m vec_eq_u(vec_u a, vec_u b) { return a == b; }
#if defined(__SSE2__)
VEC_INLINE vec_f vec_least(vec_f a, vec_f b) { return (vec_f)_mm_min_ps((__m128)a, (__m128)b); }
VEC_INLINE vec_f vec_most(vec_f a, vec_f b) { return (vec_f)_mm_max_ps((__m128)a, (__m128)b); }
VEC_INLINE unsigned vec_bits(vec_m m) { return (unsigned)_mm_movemask_ps((__m128)m); }
VEC_INLINE vec_f vec_sqrt(vec_f v) { return (vec_f)_mm_sqrt_ps((__m128)v); }
#else
VEC_INLINE vec_f vec_least(vec_f a, vec_f b) { return vec_pick(a < b, a, b); }
VEC_INLINE vec_f vec_most(vec_f a, vec_f b) { return vec_pick(a > b, a, b); }
VEC_INLINE unsigned vec_bits(vec_m m)
{
    const vec_i places = {1, 2, 4, 8};
    const vec_i one_each = m & places;
    return (unsigned)(one_each[0] | one_each[1] | one_each[2] | one_each[3]);
}
VEC_INLINE vec_f vec_sqrt(vec_f v)
{
    const vec_f root = {sqrtf(v[0]), sqrtf(v[1]), sqrtf(v[2]), sqrtf(v[3])};
    return root;
}
#endif

#endif

/* Eight numbers a lane become eight in a row: lane n's lie from to + 8 n on. */
#if defined(__AVX2__)
VEC_INLINE void vec_rows_of_eight(float *to, const __m256 f[8])
{
    __m256 pair[8], four[8];
    for (int n = 0; n < 8; n += 2) {
        pair[n] = _mm256_unpacklo_ps(f[n], f[n + 1]);
        pair[n + 1] = _mm256_unpackhi_ps(f[n], f[n + 1]);
    }
    for (int n = 0; n < 8; n += 4) {
        four[n] = _mm256_shuffle_ps(pair[n], pair[n + 2], 0x44);
        four[n + 1] = _mm256_shuffle_ps(pair[n], pair[n + 2], 0xee);
        four[n + 2] = _mm256_shuffle_ps(pair[n + 1], pair[n + 3], 0x44);
        four[n + 3] = _mm256_shuffle_ps(pair[n + 1], pair[n + 3], 0xee);
    }
    for (int n = 0; n < 4; n++) {
        _mm256_storeu_ps(to + 8 * n, _mm256_permute2f128_ps(four[n], four[n + 4], 0x20));
        _mm256_storeu_ps(to + 8 * (n + 4), _mm256_permute2f128_ps(four[n], four[n + 4], 0x31));
    }
}
#endif
VEC_INLINE void vec_store_rows(float *to, const vec_f f[8])
{
#if defined(__AVX512F__)
    __m256 half[8];
    for (int n = 0; n < 8; n++)
        half[n] = _mm512_castps512_ps256((__m512)f[n]);
    vec_rows_of_eight(to, half);
    for (int n = 0; n < 8; n++)
        half[n] = _mm512_extractf32x8_ps((__m512)f[n], 1);
    vec_rows_of_eight(to + 64, half);
#elif defined(__AVX2__)
    __m256 whole[8];
    for (int n = 0; n < 8; n++)
        whole[n] = (__m256)f[n];
    vec_rows_of_eight(to, whole);
#else
    for (int n = 0; n < 8; n += 4) {
        const vec_f a = __builtin_shufflevector(f[n], f[n + 1], 0, 4, 1, 5);
        const vec_f b = __builtin_shufflevector(f[n], f[n + 1], 2, 6, 3, 7);
        const vec_f c = __builtin_shufflevector(f[n + 2], f[n + 3], 0, 4, 1, 5);
        const vec_f d = __builtin_shufflevector(f[n + 2], f[n + 3], 2, 6, 3, 7);
        vec_store(to + n, __builtin_shufflevector(a, c, 0, 1, 4, 5));
        vec_store(to + 8 + n, __builtin_shufflevector(a, c, 2, 3, 6, 7));
        vec_store(to + 16 + n, __builtin_shufflevector(b, d, 0, 1, 4, 5));
        vec_store(to + 24 + n, __builtin_shufflevector(b, d, 2, 3, 6, 7));
    }
#endif
}

#endif
