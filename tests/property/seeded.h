/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Repeatable chance for tests: the same numbers on every machine, compiler and library.
 * Is not:  std::mt19937 with a std distribution, whose answers differ between libraries.
 * Shape:   a 64-bit counter, mixed (SplitMix64).
 */
#ifndef GLAISE_PROPERTY_SEEDED_H
#define GLAISE_PROPERTY_SEEDED_H

#include "lattice/key.h"

#include <cstdint>
#include <cstdlib>

struct seeded {
    uint64_t state;
};

inline uint64_t seeded_bits(seeded &s)
{
    uint64_t z = s.state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/* lo..hi, both included. */
inline int64_t seeded_int(seeded &s, int64_t lo, int64_t hi)
{
    return lo + static_cast<int64_t>(seeded_bits(s) % static_cast<uint64_t>(hi - lo + 1));
}

/* [lo, hi) */
inline double seeded_real(seeded &s, double lo, double hi)
{
    return lo + (hi - lo) * (static_cast<double>(seeded_bits(s) >> 11) * 0x1p-53);
}

inline bool seeded_chance(seeded &s, double p) { return seeded_real(s, 0, 1) < p; }

inline key seeded_key(seeded &s, int lo, int hi)
{
    key k;
    k.i = static_cast<int32_t>(seeded_int(s, lo, hi));
    k.j = static_cast<int32_t>(seeded_int(s, lo, hi));
    k.k = static_cast<int32_t>(seeded_int(s, lo, hi));
    return k;
}

/* A rotation in rows, uniform over all of them. */
inline void seeded_rotation(seeded &s, double out[3][3])
{
    double q[4], length2;
    do {
        length2 = 0;
        for (double &c : q) {
            c = seeded_real(s, -1, 1);
            length2 += c * c;
        }
    } while (length2 > 1 || length2 < 0.01);
    const double t = 2 / length2, w = q[0], x = q[1], y = q[2], z = q[3];
    const double m[3][3] = {{1 - t * (y * y + z * z), t * (x * y - w * z), t * (x * z + w * y)},
                            {t * (x * y + w * z), 1 - t * (x * x + z * z), t * (y * z - w * x)},
                            {t * (x * z - w * y), t * (y * z + w * x), 1 - t * (x * x + y * y)}};
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            out[a][b] = m[a][b];
}

/* Steps of a property test: twenty times as many when GLAISE_LONG is set. */
inline int seeded_steps(int usual) { return std::getenv("GLAISE_LONG") ? usual * 20 : usual; }

#endif
