/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The strokes that can be gone over, and which began after which: a tree, since a new stroke after an undo
 *          forks it and takes nothing away.
 * Is not:  What a stroke changed (record.h) or where that lies (ring.h).
 * Shape:   states are numbered by the stroke that made them, 0 is the beginning. Stroke n leads from state `parent` to
 *          state n, and parent < n always. Strokes are kept in order of number.
 *
 *                0 -- 1 -- 2 -- 3 -- 4        cursor 3: undo leads to 2;
 *                      \         \__ 7 tip    redo leads to 7, since the tip lies there
 *                       5 -- 6
 *
 *          The tip is a state that the cursor leads to by redo alone, or the cursor itself. Undo leaves it where it is:
 *          undo, then redo, returns. Where a stroke was forgotten the tree falls apart; what the cursor does not reach
 *          any more is lost, and goes with it.
 * Owner:   the caller owns the struct, the tree its array.
 * Errors:  STATUS_NO_MEMORY.
 * Cost:    a stroke is found in O(log strokes), a way in O(its strokes * log); all else in O(strokes * log), but
 *          tree_tip_of, which is asked when a branch is left. Off the frame path.
 */
#ifndef GLAISE_HISTORY_TREE_H
#define GLAISE_HISTORY_TREE_H

#include "lattice/status.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tree_stroke {
    uint64_t stroke, parent;
    uint64_t digest_before, digest_after;
    uint64_t top;      /* tree_prune's own: the state from which redo leads here over the most strokes */
    uint32_t children; /* strokes that began after it */
} tree_stroke;

typedef struct tree {
    tree_stroke *strokes;
    uint32_t count, room;
    uint64_t cursor, tip;
} tree;

void tree_finish(tree *t); /* a zeroed tree is empty, its cursor at 0 */
/* Adds a stroke, or brings digest_after up to date when it is there. parent < stroke. */
STATUS_CHECKED status tree_put(tree *t, tree_stroke s);
const tree_stroke *tree_find(const tree *t, uint64_t stroke); /* NULL: not kept */

/* Is there a way from one state to the other over strokes that are kept? */
bool tree_leads(const tree *t, uint64_t from, uint64_t to);
/* The next stroke to go over on the way, and in which direction; from != to, and tree_leads. The way there is longest
   at the start: only strokes that are undone, then only such that are redone. */
typedef struct tree_leg {
    uint64_t stroke; /* 0: there is no way */
    bool back;
    uint64_t to; /* the state beyond it */
} tree_leg;
tree_leg tree_next(const tree *t, uint64_t from, uint64_t to);
/* Does the way from one state to the other go over this stroke? */
bool tree_passes(const tree *t, uint64_t from, uint64_t to, uint64_t stroke);

/* Where undo and redo lead; the cursor itself where they do not. */
uint64_t tree_undo(const tree *t);
uint64_t tree_redo(const tree *t);
/* The end of the branch whose end is next older than the tip; after the oldest, the newest. The tip itself where there
   is but one. */
uint64_t tree_fork(const tree *t);
uint32_t tree_branches(const tree *t);
/* The newest stroke that redo alone leads to from a state, over newest strokes; the state itself when there is none. */
uint64_t tree_tip_of(const tree *t, uint64_t state);

/* The oldest stroke that nothing else is lost with: the first one, where it alone leads on from the beginning and the
   cursor lies beyond it; or the last of a branch that was left. 0: there is none. */
uint64_t tree_spare(const tree *t);
/* Forgets a stroke, and all that the cursor does not reach without it; the tip becomes one that it reaches. */
void tree_forget(tree *t, uint64_t stroke);
/* Forgets all that the cursor does not reach. */
void tree_prune(tree *t);

#ifdef __cplusplus
}
#endif
#endif
