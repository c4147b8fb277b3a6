/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Every pool's limit, with the arithmetic that leads to it. One home for all of them.
 * Is not:  A promise that the machine has the memory: slabs come as needed, and a refused slab is STATUS_NO_MEMORY.
 * Units:   items, unless the name says otherwise.
 */
#ifndef GLAISE_CLAY_CAPACITY_H
#define GLAISE_CLAY_CAPACITY_H

/* A 4 GB box gives the sculpture 2 GiB: a brick is a 4 KiB page, its entry (300 B) and a tree node (28 B), and a
   patch with its vertices about as much again at usual occupancy: 2 GiB / 8.5 KiB = 250 thousand bricks, which at
   170 stored corners a brick is 42 million corners. */
#define CAPACITY_BRICKS 250000u

/* Images of bricks as they were before the stroke: a stroke may touch the whole sculpture once. */
#define CAPACITY_IMAGES CAPACITY_BRICKS

/* Bricks marked dirty at one time: all of them (after a load), as many empty ones that an eraser passes (marked where
   dabs are counted), and one for every image, held back so that a change can be reverted whatever is marked. */
#define CAPACITY_DIRT (2u * CAPACITY_BRICKS + CAPACITY_IMAGES)

/* Patches: one per brick, and one per empty brick whose cubes reach into a stored one. */
#define CAPACITY_PATCHES (2u * CAPACITY_BRICKS)

/* Bricks one dab may cover: a tool of 32 steps needs about 1,300; this is a tool of 128 steps. A page more for each
   that is not acted on where it lies. */
#define CAPACITY_DAB_BRICKS 65536u

/* Frozen clays at one time (freeze.h): one that is being saved, one that is being exported. */
#define CAPACITY_FROZEN 2u

/* Colours whose full bricks share a page (pages.h): a palette's worth. */
#define CAPACITY_FULL_COLOURS 64u

/* Pages: besides those of bricks, what images, frozen clays and deltas (delta.h: as many bricks as a sculpture may
   have, in all that are not yet written down) may still hold of bricks written since, those of the dab under way, and
   full ones kept for their colours. */
#define CAPACITY_PAGES_MORE (CAPACITY_DAB_BRICKS + CAPACITY_FULL_COLOURS)
#define CAPACITY_PAGES(bricks) ((3u + CAPACITY_FROZEN) * (bricks) + CAPACITY_PAGES_MORE)

#endif
