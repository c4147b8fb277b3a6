/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Clay and its surface in one scope for tests, edits written as functions of the corner, and the question
 *          whether two surfaces are the same bit for bit.
 * Is not:  A tool: edits go straight through clay_brick_open and clay_brick_close.
 * Shape:   an edit is bool(key, float &potential, uint32_t &rgba): true when it dirties that corner,
 *          which then takes the two values.
 * Owner:   sample_clay owns both; a refusal fails the test that runs.
 */
#ifndef GLAISE_SURFACE_SAMPLE_CLAY_H
#define GLAISE_SURFACE_SAMPLE_CLAY_H

#include "clay/colour.h"
#include "surface/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

struct sample_clay {
    clay field{};
    surface skin{};

    explicit sample_clay(uint32_t bricks = 4096, uint32_t patches = 8192)
    {
        EXPECT_EQ(clay_init(&field, bricks), STATUS_OK);
        EXPECT_EQ(surface_init(&skin, patches), STATUS_OK);
    }
    ~sample_clay()
    {
        surface_finish(&skin);
        clay_finish(&field);
    }
    sample_clay(const sample_clay &) = delete;
    sample_clay &operator=(const sample_clay &) = delete;
};

inline box sample_clay_box(key centre, int reach)
{
    const auto keep = [](int64_t c) { return static_cast<int32_t>(std::clamp<int64_t>(c, KEY_MIN, KEY_MAX)); };
    const auto low = [=](int32_t c) { return keep(int64_t{c} - reach); };
    const auto high = [=](int32_t c) { return keep(int64_t{c} + reach); };
    return {{low(centre.i), low(centre.j), low(centre.k)}, {high(centre.i), high(centre.j), high(centre.k)}};
}

/* Distance of a corner from a point near it, exact far from the origin too. */
inline double sample_clay_distance(key corner, key base, double x, double y, double z)
{
    const double dx = double(corner.i) - base.i - x, dy = double(corner.j) - base.j - y;
    const double dz = double(corner.k) - base.k - z;
    return std::sqrt(dx * dx + dy * dy + dz * dz);
}

/* Edits every corner of the box; answers the corners dirtied. */
template <typename edit> std::vector<key> sample_clay_edit(clay *c, box where, edit dirties)
{
    std::vector<key> dirtied;
    const box bricks = box_of_bricks(where);
    for (int32_t bi = bricks.min.i; bi <= bricks.max.i; bi++)
        for (int32_t bj = bricks.min.j; bj <= bricks.max.j; bj++)
            for (int32_t bk = bricks.min.k; bk <= bricks.max.k; bk++) {
                uint32_t id = POOL_NONE;
                const status opened = clay_brick_open(c, {bi, bj, bk}, &id);
                EXPECT_EQ(opened, STATUS_OK);
                if (opened != STATUS_OK)
                    continue;
                brick_mask mask{};
                brick_page *page = clay_brick(c, id)->page;
                for (int n = 0; n < BRICK_CORNERS; n++) {
                    const key corner = key_add(key_of_brick({bi, bj, bk}), n >> 6, n >> 3 & 7, n & 7);
                    float potential = page->potential[n];
                    uint32_t rgba = page->rgba[n];
                    if (!box_contains(where, corner) || !dirties(corner, potential, rgba))
                        continue;
                    page->potential[n] = potential;
                    page->rgba[n] = rgba;
                    brick_mask_set(&mask, n);
                    dirtied.push_back(corner);
                }
                EXPECT_EQ(clay_brick_close(c, id, &mask), STATUS_OK);
            }
    clay_prune(c);
    return dirtied;
}

/* A ball of radius r about base + (x, y, z), its potential falling by `slope` a step through iso at r. */
inline void sample_clay_ball(clay *c, key base, double x, double y, double z, double r, double slope)
{
    const int reach = static_cast<int>(r + 1.5 / slope + std::max({std::fabs(x), std::fabs(y), std::fabs(z)})) + 2;
    sample_clay_edit(c, sample_clay_box(base, reach), [=](key corner, float &potential, uint32_t &rgba) {
        const double v = 1.5 + slope * (r - sample_clay_distance(corner, base, x, y, z));
        if (v <= potential)
            return false;
        potential = static_cast<float>(v);
        rgba = colour_pack(200, 100, 50, 255);
        return true;
    });
}

inline void sample_clay_put(clay *c, key corner, float potential, uint32_t rgba = colour_pack(10, 20, 30, 255))
{
    EXPECT_EQ(clay_write(c, corner, potential, rgba), STATUS_OK);
}

/* Brings the surface up to date and clears the dirt, as sculpture does. */
inline surface_counts sample_clay_update(sample_clay *s)
{
    surface_counts counts{};
    EXPECT_EQ(surface_update(&s->skin, &s->field, &counts), STATUS_OK);
    dirt_clear(&s->field.dirty);
    return counts;
}

inline bool sample_clay_same_patch(const patch *a, const patch *b)
{
    return key_equal(a->at, b->at) && a->vertex_count == b->vertex_count && a->triangle_count == b->triangle_count &&
           std::memcmp(a->vertices, b->vertices, a->vertex_count * sizeof *a->vertices) == 0 &&
           std::memcmp(a->triangles, b->triangles, a->triangle_count * sizeof *a->triangles) == 0 &&
           std::memcmp(&a->crossing, &b->crossing, sizeof a->crossing) == 0;
}

/* Same patches with the same bits, same totals, same digest. */
inline bool sample_clay_same(surface *a, surface *b)
{
    if (a->patches.count != b->patches.count || a->triangles != b->triangles || a->vertices != b->vertices ||
        a->crossing != b->crossing)
        return false;
    for (uint32_t slot = 0; slot < surface_slots(a); slot++) {
        const patch *p = surface_patch(a, slot);
        const patch *q = p ? surface_find(b, p->at) : nullptr;
        if (p && (!q || !sample_clay_same_patch(p, q)))
            return false;
    }
    return surface_digest(a) == surface_digest(b);
}

/* Is the surface what surface_rebuild makes of the clay? */
inline bool sample_clay_is_current(sample_clay *s)
{
    surface fresh{};
    EXPECT_EQ(surface_init(&fresh, s->skin.patches.limit), STATUS_OK);
    EXPECT_EQ(surface_rebuild(&fresh, &s->field, nullptr), STATUS_OK);
    const bool same = sample_clay_same(&s->skin, &fresh);
    surface_finish(&fresh);
    return same;
}

#endif
