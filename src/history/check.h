/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Looks through all the files of a store and names everything that is not as it should be, with file and
 *          offset. Nothing is changed.
 * Is not:  Recovery (recovery.h), which finds the latest state and sets things in order; it is told here what it made
 *          of a copy (wiring/check_store.h).
 * Shape:   both checkpoints, read whole; then the undo-files one by one, every record with its bricks; then whether the
 *          records since the newest sound checkpoint follow on. What a power cut leaves behind is no problem but a
 *          note: a torn record at the end of what was written last, a half-made file, and one file that was being begun
 *          anew. Nothing tells that from damage; both checkpoints hold what it had, and undo ends there.
 * Owner:   the caller owns the store and what `tell` is given for.
 * Errors:  STATUS_IO where the store cannot be listed, STATUS_NO_MEMORY. Everything else is told.
 * Cost:    every byte is read, and the checkpoints are made into clay.
 */
#ifndef GLAISE_HISTORY_CHECK_H
#define GLAISE_HISTORY_CHECK_H

#include "history/byte_store.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum check_weight {
    CHECK_NOTE,    /* as it may be */
    CHECK_PROBLEM,
} check_weight;

/* expected: what should have been there, or a sentence about the file as a whole (offset UINT64_MAX). */
typedef void (*check_teller)(void *self, check_weight weight, const char *file, uint64_t offset, const char *expected);

typedef struct check_facts {
    uint32_t undo_files, records, checkpoints; /* sound ones */
    uint32_t problems;
} check_facts;

STATUS_CHECKED status check_run(const byte_store *store, check_teller tell, void *self, check_facts *facts_out);

#ifdef __cplusplus
}
#endif
#endif
