/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What opening makes of the files it finds: the latest state of the clay that can be proven, and the tree of
 *          strokes that leads away from it.
 * Is not:  A repair of bytes: what is damaged is set aside as it is.
 * Shape:   1. every undo-file's records, from its beginning to the first place where none follows on;
 *          2. files in order of use: where one goes on from a record that an earlier file has too, the later one counts
 *             (a sync had failed); one that goes on from nothing that counts is what a cut left over;
 *          3. the base: "field", else "field.before", else empty clay;
 *          4. from the base's record on, one by one, each sealed by the one before and its bricks sound, to the first
 *             break: the tail is cut behind the last whole record;
 *          5. the way over the tree of strokes from where the base stands to where that record stands, each stroke
 *             proven by its digest; where a stroke cannot be gone over, to the latest record that can be reached;
 *          6. a look beyond the break: a record there that was written when more had already been kept shows that the
 *             medium lost what it had acknowledged. That is told, and its file set aside.
 * Errors:  STATUS_NEWER before anything is touched; STATUS_IO where the store cannot even be listed; STATUS_POOL_FULL,
 *          STATUS_NO_MEMORY. The clay is then in no defined state: history_open empties it. What is read is never
 *          asserted.
 * Cost:    the base, the records since, 512 bytes of every other record.
 */
#ifndef GLAISE_HISTORY_RECOVERY_H
#define GLAISE_HISTORY_RECOVERY_H

#include "history/history.h"

#ifdef __cplusplus
extern "C" {
#endif

/* h has store, settings, step_mm and an opened ring; the rest of h is filled. */
STATUS_CHECKED status recovery_run(history *h, clay *c, history_finding *finding_out);

#ifdef __cplusplus
}
#endif
#endif
