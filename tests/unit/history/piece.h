/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Clay with a history for tests, strokes of chance to work on it, and a model of clay that shares nothing with
 *          it: a sorted map of corners.
 * Is not:  A sculpture: no tools, no surface. Strokes write corners as a tool would, brick by brick.
 */
#ifndef GLAISE_UNIT_HISTORY_PIECE_H
#define GLAISE_UNIT_HISTORY_PIECE_H

#include "history/history.h"

#include "tests/property/seeded.h"

#include <array>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

struct piece_corner {
    key at;
    float potential; /* 0: removed */
    uint32_t rgba;
};

using piece_stroke = std::vector<piece_corner>;

/* Corner -> potential and colour, of stored corners only. */
using piece_model = std::map<std::tuple<int32_t, int32_t, int32_t>, std::pair<float, uint32_t>>;

enum { PIECE_BRICKS = 400 };

/* Clay that finishes itself. */
struct piece_clay {
    clay c;
    explicit piece_clay(uint32_t bricks = PIECE_BRICKS) { EXPECT_EQ(clay_init(&c, bricks), STATUS_OK); }
    ~piece_clay() { clay_finish(&c); }
    piece_clay(const piece_clay &) = delete;
    piece_clay &operator=(const piece_clay &) = delete;
};

/* What a tool does: opens bricks, writes, closes, prunes. STATUS_OK only when every corner was written. */
inline status piece_write(clay *c, const piece_stroke &stroke)
{
    std::map<std::tuple<int32_t, int32_t, int32_t>, std::vector<piece_corner>> bricks;
    for (const piece_corner &p : stroke) {
        const key b = key_brick(p.at);
        bricks[{b.i, b.j, b.k}].push_back(p);
    }
    for (const auto &[at, corners] : bricks) {
        uint32_t id;
        brick_mask mask = {};
        status s = clay_brick_open(c, {std::get<0>(at), std::get<1>(at), std::get<2>(at)}, &id);
        if (s != STATUS_OK)
            return s;
        for (const piece_corner &p : corners) {
            clay_brick(c, id)->page->potential[key_slot(p.at)] = p.potential;
            clay_brick(c, id)->page->rgba[key_slot(p.at)] = p.rgba;
            brick_mask_set(&mask, key_slot(p.at));
        }
        s = clay_brick_close(c, id, &mask);
        if (s != STATUS_OK)
            return s;
    }
    clay_prune(c);
    return STATUS_OK;
}

inline void piece_write_model(piece_model &m, const piece_stroke &stroke)
{
    for (const piece_corner &p : stroke)
        if (p.potential > 0)
            m[{p.at.i, p.at.j, p.at.k}] = {p.potential, p.rgba};
        else
            m.erase({p.at.i, p.at.j, p.at.k});
}

/* Up to `corners` corners in a few bricks on both sides of the origin: some removed, some again as they were, a few
   stored without a colour. */
inline piece_stroke piece_stroke_random(seeded &chance, int corners, int reach = 12)
{
    piece_stroke stroke;
    const key centre = seeded_key(chance, -reach, reach);
    const int n = static_cast<int>(seeded_int(chance, 1, corners));
    for (int c = 0; c < n; c++) {
        const key d = seeded_key(chance, -4, 4);
        piece_corner p = {key_add(centre, d.i, d.j, d.k), 0, 0};
        if (!seeded_chance(chance, 0.3)) {
            p.potential = static_cast<float>(seeded_int(chance, 1, 3000)) / 1000;
            p.rgba = seeded_chance(chance, 0.1) ? 0 : static_cast<uint32_t>(seeded_bits(chance));
        }
        stroke.push_back(p);
    }
    return stroke;
}

/* One that surely changes something: a corner of its own for every number. */
inline piece_stroke piece_stroke_numbered(int number, int corners = 3)
{
    piece_stroke stroke;
    for (int c = 0; c < corners; c++)
        stroke.push_back({{number - 7, c * 5, -c}, 0.5f + static_cast<float>(number % 5) / 4, 0xff000000u + number});
    return stroke;
}

/* Every corner of the model is in the clay, and nothing else. */
inline void piece_expect(const clay *c, const piece_model &m)
{
    ASSERT_TRUE(clay_is_valid(c));
    ASSERT_EQ(c->corners, m.size());
    for (const auto &[at, held] : m) {
        uint32_t rgba;
        const float v = clay_read(c, {std::get<0>(at), std::get<1>(at), std::get<2>(at)}, &rgba);
        ASSERT_EQ(v, held.first);
        ASSERT_EQ(rgba, held.second);
    }
}

/* Digest of clay that is made from the model, corner by corner. */
inline uint64_t piece_digest(const piece_model &m)
{
    piece_clay made;
    for (const auto &[at, held] : m)
        EXPECT_EQ(clay_write(&made.c, {std::get<0>(at), std::get<1>(at), std::get<2>(at)}, held.first, held.second),
                  STATUS_OK);
    return clay_digest(&made.c);
}

/* Small undo-files, so that strokes fill them. */
struct piece_ring {
    uint32_t strokes = HISTORY_STROKES_DEFAULT;
    uint64_t file_bytes = RING_FILE_BYTES_MIN;
    uint64_t budget_bytes = uint64_t{RING_FILE_BYTES_MIN} * 1000;
    uint32_t reserve_files = HISTORY_RESERVE_FILES_DEFAULT;
};

/* Clay with its history on some store, which does everything at once that a keeper does: keeps, and writes a checkpoint
   as soon as one is due. */
struct piece {
    clay c;
    history h;
    history_finding finding;
    status opened;
    delta changed = {nullptr, 0, 0};

    explicit piece(byte_store store, piece_ring limits = {}, uint32_t bricks = PIECE_BRICKS)
    {
        EXPECT_EQ(clay_init(&c, bricks), STATUS_OK);
        const history_settings settings = {limits.strokes, limits.file_bytes, limits.budget_bytes,
                                           HISTORY_HELD_BYTES_DEFAULT, limits.reserve_files};
        opened = history_open(&h, store, &settings, 0.5, &c, &finding);
    }
    ~piece()
    {
        if (opened == STATUS_OK)
            history_close(&h);
        delta_finish(&changed);
        clay_finish(&c);
    }
    piece(const piece &) = delete;
    piece &operator=(const piece &) = delete;

    /* A stretch of a stroke: written to the clay and put, not kept. */
    status stretch(const piece_stroke &s, bool ends)
    {
        clay_change_begin(&c);
        status done = piece_write(&c, s);
        if (done == STATUS_OK)
            done = delta_cut(&changed, &c);
        delta_sort(&changed);
        if (done == STATUS_OK)
            done = history_put(&h, &changed, h.dab + 1, ends, c.rows);
        delta_give(&changed, &c);
        if (done == STATUS_OK)
            clay_change_end(&c);
        else
            clay_change_revert(&c);
        dirt_clear(&c.dirty);
        return done;
    }
    status keep()
    {
        const status s = history_keep(&h);
        if (s == STATUS_OK && h.wants_field && !h.in_stroke)
            (void)!field();
        return s;
    }
    status stroke(const piece_stroke &s)
    {
        const status done = stretch(s, true);
        return done == STATUS_OK ? keep() : done;
    }
    /* A checkpoint, all of it. */
    status field()
    {
        const status s = history_field_begin(&h, &c);
        while (s == STATUS_OK && history_work(&h))
            continue;
        return s;
    }
    status go(history_way way, uint64_t to = 0)
    {
        route r = {};
        status s = history_fetch(&h, way, to, &r);
        if (s == STATUS_OK)
            s = route_apply(&r, &c);
        if (s == STATUS_OK) {
            clay_change_end(&c);
            s = history_move(&h, &r);
        }
        route_finish(&r);
        dirt_clear(&c.dirty);
        return s == STATUS_OK ? keep() : s;
    }
    status undo() { return go(HISTORY_BACK); }
    status redo() { return go(HISTORY_FORTH); }
    uint64_t digest() const { return clay_digest(&c); }
};

#endif
