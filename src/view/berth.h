/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Which units of a page are taken: ranges of neighbouring units are taken and given back.
 * Is not:  What lies in them (page.h); which page a patch lies in (upload.h).
 * Shape:   BERTH_UNITS units in a row, a bit each. A range is taken at the lowest place where it fits; ranges given
 *          back join with what is free beside them.
 *
 *              |####|..|######|...|###|................|
 *                                     ^ top: free from here to the end
 *
 *          Fragmentation: where a range of n units finds no place, no n neighbouring units are free, so that at least
 *          BERTH_UNITS / n of them, rounded down, are taken. First fit needs at the very worst some log2(n) times the
 *          units in use (n the longest range): 6 times for a patch's 61, whatever the order of takes and gives.
 * Units:   units of a page.
 * Owner:   the caller owns the struct.
 * Errors:  giving what is not taken is our bug: asserted.
 * Cost:    take: a look at 64 units at a time up to the place; none where it is known that nothing so long is free.
 * Source:  for the factor: J. M. Robson, Worst case fragmentation of first fit and best fit storage allocation
 *          strategies, 1977.
 */
#ifndef GLAISE_VIEW_BERTH_H
#define GLAISE_VIEW_BERTH_H

#include <array>
#include <cstdint>

enum { BERTH_UNITS = 2048, BERTH_NONE = -1 };

struct berth {
    std::array<uint64_t, BERTH_UNITS / 64> taken{}; /* bit n: unit n */
    int top = 0;                                    /* units from here on are free */
    int longest = BERTH_UNITS;                      /* no longer run of free units exists */
    int count = 0;                                  /* units taken */
};

/* First unit of the range, BERTH_NONE when none is long enough. units: 1..BERTH_UNITS. */
int berth_take(berth *b, int units);
/* Exactly there; false when some of it is taken. */
bool berth_take_at(berth *b, int first, int units);
void berth_give(berth *b, int first, int units);

#endif
