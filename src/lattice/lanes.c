/* SPDX-License-Identifier: Apache-2.0 */
#include "lattice/lanes.h"

#include <assert.h>

bool lanes_are_here(lanes l)
{
#if defined(__x86_64__)
    if (l == LANES_AVX512)
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
               __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("bmi2");
    if (l == LANES_AVX2)
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
#endif
    return l == LANES_PLAIN;
}

lanes lanes_best(void)
{
    return lanes_are_here(LANES_AVX512) ? LANES_AVX512 : lanes_are_here(LANES_AVX2) ? LANES_AVX2 : LANES_PLAIN;
}

const char *lanes_name(lanes l)
{
    static const char *const names[LANES_COUNT] = {"plain", "AVX2", "AVX-512"};
    assert((int)l >= 0 && (int)l < LANES_COUNT);
    return names[l];
}
