/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The port through which work that is divisible by brick is given to several threads at once. The rooms that
 *          work on clay see this; who asks for threads and has them is station's.
 * Is not:  Threads (station/crew_of_threads.h); a queue: each brick is always the same hand's, so that it stays in that
 *          hand's cache, and the outcome never depends on how many hands there are.
 * Shape:   run calls job(on, hand, hands) once for each hand 0..hands-1, at the same time where it can, and returns
 *          when all have returned. A job does those bricks for which crew_hand_of answers its hand.
 * Owner:   whoever made `self`.
 * Errors:  None.
 */
#ifndef GLAISE_LATTICE_CREW_H
#define GLAISE_LATTICE_CREW_H

#include "lattice/key.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef void (*crew_job)(void *on, uint32_t hand, uint32_t hands);

typedef struct crew {
    void *self;
    void (*run)(void *self, crew_job job, void *on);
    uint32_t hands; /* at least 1 */
} crew;

/* Bricks worth waking anybody for: below, waiting for the others costs more than they do. */
enum { CREW_BRICKS_LEAST = 96 };

/* Runs job by all hands, or where c is NULL or the bricks are few by the caller alone. */
static inline void crew_run(const crew *c, uint32_t bricks, crew_job job, void *on)
{
    if (c && c->hands > 1 && bricks >= CREW_BRICKS_LEAST)
        c->run(c->self, job, on);
    else
        job(on, 0, 1);
}

/* Blocks of 2 x 2 x 2 bricks share a hand: neighbours read each other. */
static inline uint32_t crew_hand_of(key brick_at, uint32_t hands)
{
    uint32_t h = (uint32_t)(brick_at.i >> 1) * 0x9E3779B1u + (uint32_t)(brick_at.j >> 1) * 0x85EBCA77u +
                 (uint32_t)(brick_at.k >> 1) * 0xC2B2AE3Du;
    return hands == 1 ? 0 : (h >> 16) % hands;
}

#ifdef __cplusplus
}
#endif
#endif
