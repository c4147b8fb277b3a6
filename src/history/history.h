/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Undo and redo through a ring of undo-files, one a stroke, on a byte store; with a checkpoint of the whole
 *          field beneath it, so that a piece and its history come back after a restart.
 * Is not:  The byte store (byte_store.h); what a stroke is (station); what opening makes of damaged files (recovery.h);
 *          a tree of forks (a stroke after an undo takes the place of what was undone).
 * Shape:   strokes are numbered 1, 2, 3, ...; stroke n lives in file "undo-<n mod ring>" until n + ring overwrites it.
 *          `cursor` is the stroke after which the clay stands; strokes oldest..newest are kept:
 *
 *              oldest ... cursor | cursor+1 ... newest
 *                   undo <-      |      -> redo
 *
 *          files: undo-0000 ... (undo_file.h), "cursor" (cursor_file.h), "field" (checkpoint.h), each replaced by
 *          rename from "undo.new", "cursor.new", "field.new".
 *          On open: field is read, then undo-files are walked from field's stroke to the cursor.
 *          H1: the undo-files that lead from the checkpoint to the cursor are always there. What would break that (the
 *          ring coming round, a new stroke in the place of undone ones that the checkpoint holds, a damaged file found
 *          on the way) writes a new checkpoint first. A stroke's file is on the medium before the cursor says so.
 * Owner:   the caller owns the struct and the store; history owns its buffer.
 * Errors:  STATUS_HISTORY_ENDS; STATUS_IO, STATUS_CORRUPT, STATUS_NEWER, STATUS_POOL_FULL, STATUS_NO_MEMORY: the clay
 *          is as it was. A file that is not what it should be ends history on that side: the first undo (redo) that
 *          meets it answers STATUS_CORRUPT, later ones STATUS_HISTORY_ENDS; the file is renamed to "<name>.set-aside",
 *          never deleted.
 * Cost:    a stroke: its changed bricks compared and written once, and clay_digest. An undo: the bricks read, checked
 *          and kept as images until the cursor is written. Four syncs a stroke, two an undo. A checkpoint, the whole
 *          field: at the least once a ring.
 * Source:  000 section 3.3; 002 section 2.3.
 */
#ifndef GLAISE_HISTORY_HISTORY_H
#define GLAISE_HISTORY_HISTORY_H

#include "clay/clay.h"
#include "history/byte_buffer.h"
#include "history/byte_store.h"
#include "history/checkpoint.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HISTORY_RING_DEFAULT = 200, HISTORY_RING_MAX = 9999 };

#define HISTORY_FIELD_NAME "field"

typedef struct history {
    byte_store store;
    uint32_t ring; /* undo-files at most */
    uint64_t oldest, cursor, newest; /* strokes; oldest is the first that can be undone, newest the last to redo */
    uint64_t checkpoint;             /* stroke after which "field" stands */
    bool checkpoint_known;           /* false after a rename that failed: it may have happened or not */
    uint64_t digest;                 /* clay_digest at the cursor */
    double step_mm;
    uint64_t dab; /* number of the next dab, kept across restarts; the caller moves it on before it commits */
    byte_buffer buffer;
} history;

/* What opening found, for the person: one sentence, "" when all was as it should be. */
typedef struct history_finding {
    char text[200];
} history_finding;

/* Opens or makes the store; c (initialised, empty) becomes the sculpture as of the cursor, all of it dirty. step_mm and
   ring are used for a new store; an old one keeps its own (see step_mm and ring afterwards). A field that cannot be
   read is set aside and the answer is STATUS_CORRUPT with a sentence: the caller may open again, which makes the
   sculpture from its undo-files if the first stroke's is still there, and else sets aside what there is and starts
   anew. After anything but STATUS_OK c is empty and there is nothing to close. */
STATUS_CHECKED status history_open(history *h, byte_store store, uint32_t ring, double step_mm, clay *c,
                                   history_finding *finding_out);
void history_close(history *h);

/* Writes the change recorded in c (changes since clay_change_begin) as the next undo-file and ends the change. A stroke
   that changed nothing makes no file. On failure the change is still recorded: revert it, or try again. */
STATUS_CHECKED status history_commit(history *h, clay *c);
/* One stroke back or forth; marks the dirt. Nothing may be recorded at this time. */
STATUS_CHECKED status history_undo(history *h, clay *c);
STATUS_CHECKED status history_redo(history *h, clay *c);

static inline bool history_can_undo(const history *h) { return h->cursor >= h->oldest; }
static inline bool history_can_redo(const history *h) { return h->cursor < h->newest; }

/* Writes "field" as of the cursor, atomically. A change being recorded is left out. */
STATUS_CHECKED status history_checkpoint(history *h, const clay *c);

#ifdef __cplusplus
}
#endif
#endif
