/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Clay: a potential and a colour at every corner of an unbounded lattice, stored only where it is not empty.
 *          Bricks of 8 x 8 x 8 corners in a pooled AVL tree, linked to their neighbours.
 * Is not:  A surface (surface/), a tool (tool/), a position in millimetres (sculpture.h), a reconstruction between
 *          corners (reconstruct.h), undo (history/).
 * Shape:   corner (i,j,k) -> brick key (i>>3, j>>3, k>>3) -> page slot (i&7, j&7, k&7), k fastest. See brick.h.
 *          Bulk writers speak brick by brick:
 *
 *              clay_brick_open -> write the page -> clay_brick_close   ... and clay_prune when all are closed
 *
 * Units:   lattice steps; potentials in [0, 3] (potential.h).
 * Owner:   the caller owns the struct; clay owns bricks, pages, dirt and images. Page pointers hold until the brick is
 *          closed or settled: what is full of one colour then shares its page (pages.h).
 * Errors:  STATUS_POOL_FULL, STATUS_NO_MEMORY, STATUS_OUT_OF_RANGE; the clay is then as it was.
 * Cost:    a brick is found in O(log bricks), its neighbours in O(1).
 * Source:  000 section 3.1, 002 section 3. We differ: the tree holds bricks, not corners; "less than minVal is removed"
 *          is "at or under", since a corner that holds minVal cannot be told from an absent one.
 */
#ifndef GLAISE_CLAY_CLAY_H
#define GLAISE_CLAY_CLAY_H

#include "clay/brick.h"
#include "clay/change.h"
#include "clay/dirt.h"
#include "clay/potential.h"
#include "lattice/box.h"
#include "lattice/crew.h"
#include "lattice/lanes.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct clay {
    avl tree; /* brick key -> brick id */
    pool bricks;
    struct pages pages;
    uint64_t corners; /* stored corners, over all bricks */
    uint64_t births;  /* bricks made so far */
    const struct crew *crew; /* works on this clay by brick; NULL: the caller alone */
    lanes rows;       /* the vectors that row kernels use on this clay: the best there are, or what a test wants */
    uint32_t frozen;  /* how often (freeze.h) */
    uint64_t cut;     /* holds on pages that deltas have (delta.h) */
    change changes; /* bricks as they were before the stroke under way */
    dirt dirty;     /* corners dirtied since the surface was last brought up to date */
} clay;

/* Limit of bricks; the other limits follow from it by capacity.h's ratios. CAPACITY_BRICKS for a sculpture. */
STATUS_CHECKED status clay_init(clay *c, uint32_t bricks);
void clay_finish(clay *c);
/* Empty, nothing dirty, nothing recorded. */
void clay_clear(clay *c);
/* to (initialised, empty) becomes a duplicate of from: bricks and pages; dirt and images are not copied. */
STATUS_CHECKED status clay_copy(clay *to, const clay *from);

/* --- single corners: for tests, loading, reading a point --- */

/* Potential at a corner, POTENTIAL_MIN when absent; *rgba_out (may be NULL) COLOUR_NONE when absent. */
float clay_read(const clay *c, key corner, uint32_t *rgba_out);
/* Clamps to POTENTIAL_MAX, removes at or under POTENTIAL_MIN (NaN counts as that), marks dirt, gives an emptied brick
   back. */
STATUS_CHECKED status clay_write(clay *c, key corner, float potential, uint32_t rgba);

/* --- bricks --- */

static inline uint32_t clay_find(const clay *c, key brick_at) { return avl_find(&c->tree, brick_at); }
static inline brick *clay_brick(const clay *c, uint32_t id) { return (brick *)pool_at(&c->bricks, id); }
static inline uint32_t clay_brick_count(const clay *c) { return c->bricks.count; }

/* Can `fresh` new bricks be made, `touched` ones be recorded and marked? Ask before the first write of a dab. Takes
   every touched brick for one that has neither image nor mark; clay_need counts those. */
STATUS_CHECKED status clay_room(const clay *c, uint64_t fresh, uint64_t touched);

/* What writing some bricks will take from the pools, to the last item: a stroke that stays where it is never runs
   out. */
typedef struct clay_need {
    uint64_t bricks, pages, images, marks;
} clay_need;

/* What is about to be done to a brick: its dirt marked; besides, clay_brick_open; or clay_brick_turn, whose page the
   caller has taken. */
typedef enum clay_intent { CLAY_MARK, CLAY_OPEN, CLAY_TURN } clay_intent;

/* Adds one brick, each once, with its id (POOL_NONE: not stored). */
void clay_need_add(const clay *c, clay_need *need, key brick_at, uint32_t brick_id, clay_intent intent);
/* Must a brick's page be left as it is, because others hold it or an image is to be kept of it? */
bool clay_page_is_kept(const clay *c, uint32_t id);
/* STATUS_POOL_FULL unless there is room; as many marks as there can be images are held back, so that a change can be
   reverted. */
STATUS_CHECKED status clay_need_fits(const clay *c, const clay_need *need);
/* The same, and asks the machine for the memory now: after STATUS_OK what was counted cannot fail. */
STATUS_CHECKED status clay_reserve(clay *c, const clay_need *need);

/* Ids of the 27 bricks round a brick key, POOL_NONE where absent; by links when the brick itself is stored. */
void clay_neighbours(const clay *c, key brick_at, uint32_t ids_out[BRICK_NEIGHBOURS]);

/* Brick for writing, on a page of its own; made empty if absent; its image is kept if a change is being recorded. */
STATUS_CHECKED status clay_brick_open(clay *c, key brick_at, uint32_t *id_out);
/* The same for who knows the brick's id already (POOL_NONE: not stored; it is then made and its id told), and has
   written on a page of c->pages what is to be in it: the brick becomes that page's holder. */
STATUS_CHECKED status clay_brick_turn(clay *c, key brick_at, uint32_t *id, uint32_t page_id);
/* Ends writing: `dirtied` says which corners had a contribution. Restores the invariant of brick.h on all 512 corners
   (clamps, removes, counts) and marks the dirt. Only that mark can fail, and not where the brick is marked already; the
   page then stays as it was written, and putting it back is the caller's. */
STATUS_CHECKED status clay_brick_close(clay *c, uint32_t id, const brick_mask *dirtied);
/* Marks corners of a brick dirty, stored or not, all of which may have moved. */
STATUS_CHECKED status clay_mark(clay *c, key brick_at, const brick_mask *dirtied);
/* What is marked at a brick, stored or not; NULL when it is not dirty. */
const dirt_entry *clay_dirt(const clay *c, key brick_at);
/* Gives back every brick among those marked dirty that holds no corner any more. */
void clay_prune(clay *c);
/* Ends writing for those who keep the invariant themselves: what the brick has become is taken as told. Room for the
   mark must have been reserved. */
typedef struct clay_written {
    brick_mask inside, dirtied, moved;
    uint32_t stored;
} clay_written;
void clay_brick_settle(clay *c, uint32_t id, const clay_written *now);

/* --- the change under way --- */

/* From now on the first opening of each brick keeps its image. Nothing may be recorded at this time. */
void clay_change_begin(clay *c);
/* Puts every brick back as its image has it, marks those bricks dirty, forgets the images. Cannot fail: the state it
   restores had room. */
void clay_change_revert(clay *c);
void clay_change_end(clay *c); /* forgets the images */
/* What image n (change.h) shows of its brick; an empty page where that was not stored. */
const brick_page *clay_image_page(const clay *c, uint32_t n);

/* Smallest box of stored corners; empty when there are none. O(bricks). */
box clay_box(const clay *c);
/* Independent of the order in which the clay came to be; 0 when empty. O(bricks), pages hashed once per change. */
uint64_t clay_digest(const clay *c);
/* Every invariant of this header and of brick.h. O(corners): for tests. */
bool clay_is_valid(const clay *c);

#ifdef __cplusplus
}
#endif
#endif
