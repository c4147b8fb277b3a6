/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Clay as anybody would write it down first: a sorted map from key to corner. What the bricks must equal.
 * Is not:  Fast; aware of bricks, dirt or undo.
 */
#ifndef GLAISE_PROPERTY_PLAIN_CLAY_H
#define GLAISE_PROPERTY_PLAIN_CLAY_H

#include "clay/clay.h"
#include "clay/colour.h"

#include "tests/property/seeded.h"

#include <map>
#include <string>
#include <tuple>

struct plain_clay_corner {
    float potential;
    uint32_t rgba;
};

using plain_clay_key = std::tuple<int32_t, int32_t, int32_t>;
using plain_clay = std::map<plain_clay_key, plain_clay_corner>;

inline plain_clay_key plain_clay_tuple(key k) { return {k.i, k.j, k.k}; }
inline key plain_clay_untuple(const plain_clay_key &t) { return {std::get<0>(t), std::get<1>(t), std::get<2>(t)}; }

inline plain_clay_corner plain_clay_read(const plain_clay &p, key at)
{
    const auto found = p.find(plain_clay_tuple(at));
    return found == p.end() ? plain_clay_corner{POTENTIAL_MIN, COLOUR_NONE} : found->second;
}

inline void plain_clay_write(plain_clay &p, key at, float potential, uint32_t rgba)
{
    if (potential > POTENTIAL_MIN)
        p[plain_clay_tuple(at)] = {potential < POTENTIAL_MAX ? potential : POTENTIAL_MAX, rgba};
    else
        p.erase(plain_clay_tuple(at));
}

/* Read corner by corner out of the pages. */
inline plain_clay plain_clay_of(const clay *c)
{
    plain_clay p;
    avl_walk w;
    key at;
    uint32_t id;
    for (bool more = avl_first(&w, &c->tree, &at, &id); more; more = avl_next(&w, &at, &id)) {
        const brick *b = clay_brick(c, id);
        const key first = key_of_brick(at);
        for (int n = 0; n < BRICK_CORNERS; n++)
            if (b->page->potential[n] > POTENTIAL_MIN)
                p[plain_clay_tuple(key_add(first, n >> 6, n >> 3 & 7, n & 7))] = {b->page->potential[n],
                                                                                  b->page->rgba[n]};
    }
    return p;
}

/* "" when both hold the same corners bit for bit, else the first difference. */
inline std::string plain_clay_difference(const plain_clay &p, const clay *c)
{
    const plain_clay other = plain_clay_of(c);
    auto a = p.begin(), b = other.begin();
    while (a != p.end() && b != other.end() && a->first == b->first && a->second.potential == b->second.potential &&
           a->second.rgba == b->second.rgba) {
        ++a;
        ++b;
    }
    if (a == p.end() && b == other.end())
        return c->corners == p.size() ? "" : "the clay counts " + std::to_string(c->corners) + " corners";
    const auto text = [](const plain_clay &of, plain_clay::const_iterator it) {
        if (it == of.end())
            return std::string("nothing");
        const auto [i, j, k] = it->first;
        return std::to_string(i) + "," + std::to_string(j) + "," + std::to_string(k) + " = " +
               std::to_string(it->second.potential) + " " + std::to_string(it->second.rgba);
    };
    return "map has " + text(p, a) + ", clay has " + text(other, b);
}

/* A ball of clay with a noisy field and colours, thick enough to hold plateaus, slopes and holes. */
[[nodiscard]] inline status plain_clay_ball(clay *c, seeded &chance, key middle, double radius, double noise)
{
    const int reach = static_cast<int>(radius) + 1;
    for (int i = -reach; i <= reach; i++)
        for (int j = -reach; j <= reach; j++)
            for (int k = -reach; k <= reach; k++) {
                const double d2 = (i * i + j * j + k * k) / (radius * radius);
                if (d2 >= 1)
                    continue;
                const double v = 4.5 * (1 - d2) + seeded_real(chance, -noise, noise);
                const uint32_t rgba = static_cast<uint32_t>(seeded_bits(chance)) | 1u;
                const status s = clay_write(c, key_add(middle, i, j, k), static_cast<float>(v), rgba);
                if (s != STATUS_OK)
                    return s;
            }
    return STATUS_OK;
}

#endif
