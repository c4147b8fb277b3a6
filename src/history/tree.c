/* SPDX-License-Identifier: Apache-2.0 */
#include "history/tree.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

enum { ROOM_FIRST = 64 };

void tree_finish(tree *t)
{
    free(t->strokes);
    memset(t, 0, sizeof *t);
}

/* The first that is not before the stroke. */
static uint32_t place_of(const tree *t, uint64_t stroke)
{
    uint32_t lo = 0, hi = t->count;
    while (lo < hi) {
        const uint32_t middle = lo + (hi - lo) / 2;
        if (t->strokes[middle].stroke < stroke)
            lo = middle + 1;
        else
            hi = middle;
    }
    return lo;
}

const tree_stroke *tree_find(const tree *t, uint64_t stroke)
{
    const uint32_t n = place_of(t, stroke);
    return n < t->count && t->strokes[n].stroke == stroke ? &t->strokes[n] : NULL;
}

status tree_put(tree *t, tree_stroke s)
{
    assert(s.parent < s.stroke);
    const uint32_t n = place_of(t, s.stroke);
    if (n < t->count && t->strokes[n].stroke == s.stroke) {
        t->strokes[n].digest_after = s.digest_after;
        return STATUS_OK;
    }
    if (t->count == t->room) {
        const uint32_t room = t->room ? t->room * 2 : ROOM_FIRST;
        tree_stroke *grown = (tree_stroke *)realloc(t->strokes, room * sizeof *grown);
        if (!grown)
            return STATUS_NO_MEMORY;
        t->strokes = grown;
        t->room = room;
    }
    memmove(&t->strokes[n + 1], &t->strokes[n], (t->count - n) * sizeof s);
    t->strokes[n] = s;
    t->count++;
    t->strokes[n].children = 0;
    for (uint32_t other = n + 1; other < t->count; other++)
        t->strokes[n].children += t->strokes[other].parent == s.stroke;
    const uint32_t parent = place_of(t, s.parent);
    if (parent < n && t->strokes[parent].stroke == s.parent)
        t->strokes[parent].children++;
    return STATUS_OK;
}

/* --- ways --- */

/* Where two states' ways to the beginning meet: since parents are smaller, the larger one steps back until they are
   the same. False where a stroke on the way is not kept. */
static bool meet(const tree *t, uint64_t a, uint64_t b, uint64_t *at_out)
{
    while (a != b) {
        uint64_t *larger = a > b ? &a : &b;
        const tree_stroke *s = tree_find(t, *larger);
        if (!s)
            return false;
        *larger = s->parent;
    }
    *at_out = a;
    return true;
}

bool tree_leads(const tree *t, uint64_t from, uint64_t to)
{
    uint64_t at;
    return meet(t, from, to, &at);
}

/* The stroke on the way from `to` back to `from` that began at `from`. */
static uint64_t child_towards(const tree *t, uint64_t from, uint64_t to)
{
    while (to > from) {
        const tree_stroke *s = tree_find(t, to);
        if (!s)
            return 0;
        if (s->parent == from)
            return to;
        to = s->parent;
    }
    return 0;
}

tree_leg tree_next(const tree *t, uint64_t from, uint64_t to)
{
    uint64_t at;
    if (!meet(t, from, to, &at))
        return (tree_leg){0, false, from};
    if (from != at)
        return (tree_leg){from, true, tree_find(t, from)->parent};
    const uint64_t child = child_towards(t, from, to);
    return (tree_leg){child, false, child ? child : from};
}

bool tree_passes(const tree *t, uint64_t from, uint64_t to, uint64_t stroke)
{
    uint64_t at;
    if (!meet(t, from, to, &at))
        return false;
    for (int side = 0; side < 2; side++)
        for (uint64_t state = side ? from : to; state > at; state = tree_find(t, state)->parent)
            if (state == stroke)
                return true;
    return false;
}

uint64_t tree_undo(const tree *t)
{
    const tree_stroke *s = tree_find(t, t->cursor);
    return s ? s->parent : t->cursor;
}

uint64_t tree_redo(const tree *t)
{
    const uint64_t child = child_towards(t, t->cursor, t->tip);
    return child ? child : t->cursor;
}

/* --- branches --- */

uint64_t tree_fork(const tree *t)
{
    uint64_t older = 0, newest = 0;
    for (uint32_t n = 0; n < t->count; n++) {
        const uint64_t stroke = t->strokes[n].stroke;
        if (t->strokes[n].children > 0)
            continue;
        if (stroke < t->tip)
            older = stroke;
        newest = stroke;
    }
    return older ? older : newest ? newest : t->tip;
}

uint32_t tree_branches(const tree *t)
{
    uint32_t ends = 0;
    for (uint32_t n = 0; n < t->count; n++)
        ends += t->strokes[n].children == 0;
    return ends;
}

uint64_t tree_tip_of(const tree *t, uint64_t state)
{
    for (uint32_t n = t->count; n > 0; n--) {
        const uint64_t stroke = t->strokes[n - 1].stroke;
        uint64_t at;
        if (stroke > state && meet(t, state, stroke, &at) && at == state)
            return stroke;
    }
    return state;
}

/* --- forgetting --- */

/* The top of a state is the same for all that it is connected with. */
static uint64_t top_of(const tree *t, uint64_t state)
{
    const tree_stroke *s = tree_find(t, state);
    return s ? s->top : state;
}

uint64_t tree_spare(const tree *t)
{
    uint32_t first = 0, firsts = 0;
    for (uint32_t n = 0; n < t->count; n++) {
        if (tree_find(t, t->strokes[n].parent))
            continue;
        first = n;
        firsts++;
    }
    const bool beyond = firsts == 1 && t->strokes[first].parent != t->cursor;
    for (uint32_t n = 0; n < t->count; n++) { /* oldest first */
        const tree_stroke *s = &t->strokes[n];
        const bool end = s->children == 0 && s->stroke != t->tip && s->stroke != t->cursor;
        if (end || (beyond && n == first))
            return s->stroke;
    }
    return 0;
}

static void count_children(tree *t)
{
    for (uint32_t n = 0; n < t->count; n++)
        t->strokes[n].children = 0;
    for (uint32_t n = 0; n < t->count; n++) {
        const uint32_t parent = place_of(t, t->strokes[n].parent);
        if (parent < t->count && t->strokes[parent].stroke == t->strokes[n].parent)
            t->strokes[parent].children++;
    }
}

void tree_prune(tree *t)
{
    for (uint32_t n = 0; n < t->count; n++) /* parents come first */
        t->strokes[n].top = top_of(t, t->strokes[n].parent);
    const uint64_t top = top_of(t, t->cursor);
    uint32_t kept = 0;
    for (uint32_t n = 0; n < t->count; n++)
        if (t->strokes[n].top == top)
            t->strokes[kept++] = t->strokes[n];
    t->count = kept;
    count_children(t);
    uint64_t at;
    if (!meet(t, t->cursor, t->tip, &at) || at != t->cursor)
        t->tip = tree_tip_of(t, t->cursor);
}

void tree_forget(tree *t, uint64_t stroke)
{
    const uint32_t n = place_of(t, stroke);
    if (n == t->count || t->strokes[n].stroke != stroke)
        return;
    memmove(&t->strokes[n], &t->strokes[n + 1], (t->count - n - 1) * sizeof *t->strokes);
    t->count--;
    tree_prune(t);
}
