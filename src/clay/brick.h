/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A brick: 8 x 8 x 8 corners, potentials and colours, the unit in which clay is stored, dirtied, logged and
 *          polygonized. It knows its 26 neighbours by id, so that nothing is searched for per corner.
 * Is not:  The way in (clay.h opens, closes and finds bricks); the images kept for undo (change.h).
 * Shape:   page = 512 floats, then 512 RGBA8: 4 KiB. Corner (di,dj,dk) of the brick lies at di*64 + dj*8 + dk:
 *          rows of eight along k are the inner loop everywhere.
 *
 *              neighbour[(di+1)*9 + (dj+1)*3 + (dk+1)], d in -1..1; [13] is the brick itself
 *
 *          Invariant: potential in (0, 3] and any colour, or potential 0 and COLOUR_NONE; `stored` counts the former,
 *          `inside` says which are at or over iso.
 * Owner:   clay's pools.
 */
#ifndef GLAISE_CLAY_BRICK_H
#define GLAISE_CLAY_BRICK_H

#include "lattice/key.h"
#include "lattice/pool.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { BRICK_EDGE = 8, BRICK_ROWS = 64, BRICK_CORNERS = 512, BRICK_NEIGHBOURS = 27, BRICK_SELF = 13 };

typedef struct brick_page {
    float potential[BRICK_CORNERS];
    uint32_t rgba[BRICK_CORNERS];
} brick_page;

/* One bit a corner: word di, bit dj*8 + dk. */
typedef struct brick_mask {
    uint64_t slab[BRICK_EDGE];
} brick_mask;

typedef struct brick {
    key at; /* brick key: its smallest corner divided by 8 */
    uint32_t neighbour[BRICK_NEIGHBOURS];
    brick_mask inside; /* corners at or over POTENTIAL_ISO */
    bool has_inside, has_outside; /* is any corner inside, is any not? */
    uint64_t born;     /* number of its making: ids are used again, these are not */
    uint32_t stored;   /* corners above POTENTIAL_MIN */
    uint32_t image;    /* its image before the stroke (change.h), or POOL_NONE */
    uint32_t dirt;     /* its entry (dirt.h), where dirt_round is that of the dirt */
    uint32_t dirt_round;
    bool digest_known; /* digest is that of the page as it is */
    uint64_t digest;
    uint32_t page_id;
    brick_page *page;
} brick;

/* A mask of every corner, to begin one with. */
#define BRICK_MASK_ALL {{~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull}}

/* Bits of a slab with dk 0, and with dk 7. */
#define BRICK_K_FIRST 0x0101010101010101u
#define BRICK_K_LAST 0x8080808080808080u

static inline int brick_neighbour_index(int di, int dj, int dk) { return (di + 1) * 9 + (dj + 1) * 3 + (dk + 1); }
static inline key brick_neighbour_key(key at, int n) { return key_add(at, n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1); }
static inline void brick_mask_set(brick_mask *m, int slot) { m->slab[slot >> 6] |= (uint64_t)1 << (slot & 63); }
static inline bool brick_mask_has(const brick_mask *m, int slot) { return m->slab[slot >> 6] >> (slot & 63) & 1; }
static inline void brick_mask_unite(brick_mask *m, const brick_mask *with)
{
    for (int s = 0; s < BRICK_EDGE; s++)
        m->slab[s] |= with->slab[s];
}
static inline uint32_t brick_mask_count(const brick_mask *m)
{
    uint32_t n = 0;
    for (int s = 0; s < BRICK_EDGE; s++)
        n += (uint32_t)__builtin_popcountll(m->slab[s]);
    return n;
}
static inline bool brick_mask_is_empty(const brick_mask *m)
{
    uint64_t any = 0;
    for (int s = 0; s < BRICK_EDGE; s++)
        any |= m->slab[s];
    return any == 0;
}

static inline void brick_set_inside(brick *b, const brick_mask *inside)
{
    uint64_t any = 0, all = ~(uint64_t)0;
    for (int s = 0; s < BRICK_EDGE; s++) {
        any |= inside->slab[s];
        all &= inside->slab[s];
    }
    b->inside = *inside;
    b->has_inside = any != 0;
    b->has_outside = all != ~(uint64_t)0;
}

/* Has it a corner at or over iso on the border to the brick `down` (an axis a bit: i 4, j 2, k 1) below? Where that one
   is not stored, only then can cubes between them cross the surface. */
static inline bool brick_comes_to_border(const brick *b, int down)
{
    const uint64_t rows = down & 2 ? 0xff : ~(uint64_t)0;
    uint64_t any = b->inside.slab[0];
    for (int di = 1; di < BRICK_EDGE && !(down & 4); di++)
        any |= b->inside.slab[di];
    return (any & rows & (down & 1 ? BRICK_K_FIRST : ~(uint64_t)0)) != 0;
}

#ifdef __cplusplus
}
#endif
#endif
