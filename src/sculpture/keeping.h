/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What sculpture.c and keeping.c share: how a stroke gets to the keeper, and how that gets its pages back.
 * Is not:  For anybody outside this room (sculpture.h); the keeper (history/keeper.h).
 * Shape:   jobs wait in a ring in the order in which they were handed, until they are done and taken in.
 * Errors:  STATUS_NO_MEMORY from keeping_hand: nothing is handed, the change goes on being recorded.
 * Cost:    keeping_hand: clay/delta.h.
 */
#ifndef GLAISE_SCULPTURE_KEEPING_H
#define GLAISE_SCULPTURE_KEEPING_H

#include "sculpture/sculpture.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the stroke changed since the last time. */
STATUS_CHECKED status keeping_hand(sculpture *s, bool ends);
/* The stroke is over, and there is nothing more to tell of it. */
void keeping_end(sculpture *s);
/* A job to be filled in; keeping_send hands it. Where all are under way it waits for the first. */
keeper_job *keeping_job(sculpture *s, keeper_kind kind);
void keeping_send(sculpture *s, keeper_job *job);
/* Takes in what is done. */
void keeping_take(sculpture *s);
/* Everything kept, and the whole field written if anything was made since it last was. */
STATUS_CHECKED status keeping_all(sculpture *s);
void keeping_finish(sculpture *s);

#ifdef __cplusplus
}
#endif
#endif
