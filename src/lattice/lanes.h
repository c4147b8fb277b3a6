/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Which of the machine's vector instructions the row kernels use. Files named *_rows.c are compiled once for
 *          each choice; all choices give the same bits, so that a choice is a matter of speed alone.
 * Is not:  The vectors themselves (vec.h, for those files only); threads (crew.h).
 * Shape:   PLAIN is C with vectors of 16 bytes and nothing a compiler for the machine at hand may not use everywhere:
 *          SSE2 on x86-64, NEON on aarch64. AVX2 is 32 bytes, AVX-512 (F, VL, BW, DQ) 64; both x86-64 only.
 *          A function f of such a file is called f_plain, f_avx2, f_avx512; who includes its header sees LANES_PICK.
 * Errors:  Asking for lanes that the machine lacks is our bug: lanes_are_here says.
 */
#ifndef GLAISE_LATTICE_LANES_H
#define GLAISE_LATTICE_LANES_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lanes { LANES_PLAIN, LANES_AVX2, LANES_AVX512 } lanes;
enum { LANES_COUNT = 3 };

bool lanes_are_here(lanes l);
lanes lanes_best(void);
/* "plain", "AVX2", "AVX-512". Static storage. */
const char *lanes_name(lanes l);

/* The variant of f for lanes l. */
#if defined(__x86_64__)
#define LANES_PICK(f, l) ((l) == LANES_AVX512 ? f##_avx512 : (l) == LANES_AVX2 ? f##_avx2 : f##_plain)
#else
#define LANES_PICK(f, l) ((void)(l), f##_plain)
#endif

/* In a *_rows.c file: the name under which f is compiled this time. The build defines LANES_SUFFIX. */
#define LANES_JOIN_(f, suffix) f##_##suffix
#define LANES_JOIN(f, suffix) LANES_JOIN_(f, suffix)
#ifdef LANES_SUFFIX
#define LANES_NAMED(f) LANES_JOIN(f, LANES_SUFFIX)
#else
#define LANES_NAMED(f) LANES_JOIN(f, plain)
#endif

#ifdef __cplusplus
}
#endif
#endif
