/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A clay as it was at one moment, to be read at leisure, by another thread if need be, while sculpting goes
 *          on: for saving and exporting off the frame path.
 * Is not:  A copy of the piece: it has its own bricks and tree, and holds the pages it shares with the clay. Whoever
 *          writes one of those takes a page of his own first (pages.h).
 * Shape:   `still` is a clay for reading: nothing in it is dirty, nothing recorded; what takes a pointer to a clay that
 *          is not const is not for it, but for clay_digest.
 * Owner:   the caller owns the struct. freeze_begin and freeze_end belong to the thread that writes the clay; in
 *          between `still` belongs to whoever it was handed to. No brick may be open at the time.
 * Errors:  STATUS_POOL_FULL beyond CAPACITY_FROZEN at a time, STATUS_NO_MEMORY; nothing changes then.
 * Cost:    350 bytes copied a brick, 3 to 11 ms at 20 million corners (fresh memory takes longest); later a page for
 *          every brick that is written.
 */
#ifndef GLAISE_CLAY_FREEZE_H
#define GLAISE_CLAY_FREEZE_H

#include "clay/clay.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct freeze {
    clay still;
    clay *of;
} freeze;

STATUS_CHECKED status freeze_begin(freeze *f, clay *of);
void freeze_end(freeze *f);

#ifdef __cplusplus
}
#endif
#endif
