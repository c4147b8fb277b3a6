/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The port between the thread that has the clay and the one that has its history: jobs are handed over, and
 *          done in the order in which they were handed. Sculpture asks; who has a thread for it is station's.
 * Is not:  A thread (station/history_thread.h). keeper_in_place does every job at once, for those who have none.
 * Shape:   hand -> is_done, now and then -> whoever handed it looks at the outcome. A job is done when the history has
 *          taken it in; that it is kept, facts say later.
 *
 *              job            given                    comes back
 *              KEEPER_PUT     changed, dab, ends       -
 *              KEEPER_FETCH   way, stroke              outcome, found
 *              KEEPER_MOVE    found                    -
 *              KEEPER_REFUSE  found                    -
 *              KEEPER_FIELD   field                    when it is written, or given up
 *
 * Owner:   a job is the keeper's until it is done. Pages of `changed` and the clay `field` are held by whoever handed
 *          it.
 * Errors:  KEEPER_FETCH: those of history_fetch. For the others the facts tell.
 * Cost:    handing: some hundred ns. Nothing of this waits for the medium but await and settle.
 */
#ifndef GLAISE_HISTORY_KEEPER_H
#define GLAISE_HISTORY_KEEPER_H

#include "history/history.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum keeper_kind { KEEPER_PUT, KEEPER_FETCH, KEEPER_MOVE, KEEPER_REFUSE, KEEPER_FIELD } keeper_kind;

typedef struct keeper_job {
    keeper_kind kind;
    delta changed;
    uint64_t dab;
    bool ends;
    lanes rows;
    history_way way;
    uint64_t stroke;
    route found;
    const clay *field;
    status outcome;
    bool done; /* the keeper's, like next */
    struct keeper_job *next;
} keeper_job;

/* How history stands, for the screen. */
typedef struct keeper_facts {
    uint64_t put, kept;     /* sequences: equal when all is acknowledged */
    uint64_t cursor, tip;   /* strokes: where the clay stands, where redo leads */
    uint64_t kept_cursor, kept_digest; /* where it stood as last acknowledged, and clay_digest then */
    uint32_t strokes, branches;
    bool can_undo, can_redo, wants_field;
    status room;            /* STATUS_OK: a stroke may begin */
    history_medium medium;
    history_finding trouble; /* what went wrong last */
} keeper_facts;

typedef struct keeper {
    void *self;
    void (*hand)(void *self, keeper_job *job);
    bool (*is_done)(void *self, const keeper_job *job);
    /* Until the job is done; until all that was handed is, and was tried to be kept. */
    void (*await)(void *self, const keeper_job *job);
    void (*settle)(void *self);
    void (*look)(void *self, keeper_facts *facts_out);
} keeper;

keeper keeper_in_place(history *h);

/* For those who implement the port: does what the job asks; KEEPER_FIELD only begins. Keeps nothing. */
void keeper_do(history *h, keeper_job *job);
void keeper_look(const history *h, keeper_facts *facts_out);

#ifdef __cplusplus
}
#endif
#endif
