/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The thread that has a piece's history: it writes what strokes did while the next is being made, so that the
 *          frame never waits for the medium.
 * Is not:  What is written (history/); an errand (errand.h: that one ends).
 * Shape:   from history_thread_open to history_thread_close the thread is the sculpture's keeper, and the history its
 *          own. It takes in all that waits, then keeps it with one write and one sync, and what can wait (checkpoints,
 *          in slices) goes between.
 * Owner:   the caller owns the sculpture.
 * Errors:  in the facts (history/keeper.h). What the medium refused is tried again every HISTORY_THREAD_AGAIN_MS.
 *          Where the system gives no thread: NULL, and everything stays in place.
 */
#ifndef GLAISE_STATION_HISTORY_THREAD_H
#define GLAISE_STATION_HISTORY_THREAD_H

#include "sculpture/sculpture.h"

#include <functional>

constexpr int HISTORY_THREAD_AGAIN_MS = 1000;

struct history_thread;

/* `kept` (may be empty) is called from the thread each time more is acknowledged. */
history_thread *history_thread_open(sculpture *piece, std::function<void(const keeper_facts &)> kept);
/* Waits until what was handed is done, and a checkpoint under way written; from then on the sculpture keeps in place.
   NULL is fine. */
void history_thread_close(history_thread *t);

#endif
