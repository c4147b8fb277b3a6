/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A height-balanced binary search tree from keys to 32-bit values, its nodes in a pool of its own.
 *          The paper's CornersTree, CubesTree and EdgesTree are this tree; here it is entered once per brick.
 * Is not:  A map of corners (clay.h); thread-safe (one writer, or any number of readers).
 * Shape:   node = key 12 + children 8 + value 4 + height 4 bytes; ids, not pointers, so a tree can be moved.
 * Owner:   the caller owns the struct, the tree its nodes, the caller whatever the values name.
 * Errors:  STATUS_POOL_FULL or STATUS_NO_MEMORY from the node pool; the tree is unchanged then.
 * Cost:    find, insert, remove O(log n), no recursion: an explicit stack of ancestors of AVL_HEIGHT_MAX slots.
 *          Height of n nodes <= 1.4405 log2(n + 2) - 0.328 (Adelson-Velsky and Landis); for the 2^32 - 2 ids
 *          there are that is 45.8, hence 46.
 * Source:  000 section 3 ("balanced binary search trees").
 */
#ifndef GLAISE_LATTICE_AVL_H
#define GLAISE_LATTICE_AVL_H

#include "lattice/key.h"
#include "lattice/pool.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { AVL_HEIGHT_MAX = 46 };

typedef struct avl_node {
    key at;
    uint32_t child[2]; /* smaller, larger; POOL_NONE for none */
    uint32_t value;
    int32_t height; /* of the subtree rooted here, a leaf has 1 */
} avl_node;

typedef struct avl {
    pool nodes;
    uint32_t root;
} avl;

/* Walk in key order: avl_first, then avl_next until it answers false. The tree must not change meanwhile. */
typedef struct avl_walk {
    const avl *tree;
    uint32_t stack[AVL_HEIGHT_MAX + 1];
    int depth;
} avl_walk;

STATUS_CHECKED status avl_init(avl *t, uint32_t limit);
void avl_finish(avl *t);
void avl_clear(avl *t);
/* to (uninitialised) becomes a duplicate of from. STATUS_NO_MEMORY leaves nothing. */
STATUS_CHECKED status avl_copy(avl *to, const avl *from);

static inline uint32_t avl_count(const avl *t) { return t->nodes.count; }
int avl_height(const avl *t); /* 0 when empty */

/* Value at k, POOL_NONE when absent. */
uint32_t avl_find(const avl *t, key k);
/* k must be absent (asserted). value must not be POOL_NONE. */
STATUS_CHECKED status avl_insert(avl *t, key k, uint32_t value);
/* Value that was at k, POOL_NONE when there was none. */
uint32_t avl_remove(avl *t, key k);

bool avl_first(avl_walk *w, const avl *t, key *k_out, uint32_t *value_out);
/* The same from the first key that is not smaller than `from`. */
bool avl_seek(avl_walk *w, const avl *t, key from, key *k_out, uint32_t *value_out);
bool avl_next(avl_walk *w, key *k_out, uint32_t *value_out);

/* Order, heights and balance hold everywhere. O(n): for tests. */
bool avl_is_valid(const avl *t);

#ifdef __cplusplus
}
#endif
#endif
