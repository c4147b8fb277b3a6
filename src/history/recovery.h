/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What opening makes of the files it finds: the clay as of the cursor, and how much history leads away from
 *          it; out of damaged files the latest state that can be proven.
 * Is not:  A repair of bytes: a damaged file is set aside as it is.
 * Shape:   the base is "field", or empty clay before stroke 1 when there is no field. From the base, undo-files are
 *          applied as long as number and digests link, to the stroke that "cursor" names:
 *
 *              found                                         the sculpture stands
 *              all sound                                     at the cursor
 *              no sound cursor                               after the last stroke that links onto the base
 *              a file between base and cursor not sound      where the links end; the strokes beyond are set aside
 *              a file on the undo or redo side not sound     at the cursor; history ends on that side
 *              no sound field, but links from stroke 1 on    where the links end
 *              no sound field, no such links                 empty; everything is set aside
 *
 *          A file of another branch (a stroke took an undone one's place, and the power went before the cursor was
 *          written) is no damage: history ends before it without a word.
 * Errors:  STATUS_NEWER before anything is touched; STATUS_CORRUPT: field was not sound and is now set aside;
 *          STATUS_IO when a file on the way cannot be read; STATUS_POOL_FULL, STATUS_NO_MEMORY. The clay is then in no
 *          defined state: history_open empties it. What is read is never asserted.
 * Cost:    the field, the undo-files between it and the cursor, the headers of all others.
 */
#ifndef GLAISE_HISTORY_RECOVERY_H
#define GLAISE_HISTORY_RECOVERY_H

#include "history/history.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the caller must write before it goes on. */
typedef struct recovery_writes {
    bool field, cursor;
} recovery_writes;

/* h has store, ring and step_mm as the caller of history_open gave them; the rest of h is filled. */
STATUS_CHECKED status recovery_run(history *h, clay *c, recovery_writes *writes_out, history_finding *finding_out);

#ifdef __cplusplus
}
#endif
#endif
