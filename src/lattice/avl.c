/* SPDX-License-Identifier: Apache-2.0 */
#include "lattice/avl.h"

#include <string.h>

static avl_node *node_at(const avl *t, uint32_t id) { return (avl_node *)pool_at(&t->nodes, id); }
static int height_of(const avl *t, uint32_t id) { return id == POOL_NONE ? 0 : node_at(t, id)->height; }

status avl_init(avl *t, uint32_t limit)
{
    t->root = POOL_NONE;
    return pool_init(&t->nodes, sizeof(avl_node), limit);
}

void avl_finish(avl *t)
{
    pool_finish(&t->nodes);
    t->root = POOL_NONE;
}

void avl_clear(avl *t)
{
    pool_clear(&t->nodes);
    t->root = POOL_NONE;
}

status avl_copy(avl *to, const avl *from)
{
    to->root = from->root;
    return pool_copy(&to->nodes, &from->nodes);
}

int avl_height(const avl *t) { return height_of(t, t->root); }

uint32_t avl_find(const avl *t, key k)
{
    uint32_t id = t->root;
    while (id != POOL_NONE) {
        const avl_node *n = node_at(t, id);
        int c = key_compare(k, n->at);
        if (c == 0)
            return n->value;
        id = n->child[c > 0];
    }
    return POOL_NONE;
}

static void height_update(const avl *t, avl_node *n)
{
    int a = height_of(t, n->child[0]), b = height_of(t, n->child[1]);
    n->height = 1 + (a > b ? a : b);
}

/*
 * Rotation towards `side` (drawn for side 1; x is too deep on its 0 side):
 *
 *        x            y
 *       / \          / \
 *      y   C   ->   A   x
 *     / \              / \
 *    A   B            B   C
 */
static uint32_t rotate(avl *t, uint32_t x, int side)
{
    avl_node *nx = node_at(t, x);
    uint32_t y = nx->child[!side];
    avl_node *ny = node_at(t, y);
    nx->child[!side] = ny->child[side];
    ny->child[side] = x;
    height_update(t, nx);
    height_update(t, ny);
    return y;
}

/* Balances the subtree at id, both of whose children are balanced; answers its new root. */
static uint32_t balance(avl *t, uint32_t id)
{
    avl_node *n = node_at(t, id);
    int lean = height_of(t, n->child[1]) - height_of(t, n->child[0]);
    if (lean >= -1 && lean <= 1) {
        height_update(t, n);
        return id;
    }
    int deep = lean > 0;
    avl_node *c = node_at(t, n->child[deep]);
    /* Leaning inwards: straighten the child first, or the rotation would only mirror the trouble. */
    if (height_of(t, c->child[!deep]) > height_of(t, c->child[deep]))
        n->child[deep] = rotate(t, n->child[deep], deep);
    return rotate(t, id, !deep);
}

/* slots[0..depth-1] are the places (root or child fields) that lead down to a change; mends them upwards. */
static void balance_upwards(avl *t, uint32_t **slots, int depth)
{
    while (depth > 0) {
        uint32_t *slot = slots[--depth];
        if (*slot == POOL_NONE)
            continue;
        int before = node_at(t, *slot)->height;
        *slot = balance(t, *slot);
        if (node_at(t, *slot)->height == before)
            return; /* the ancestors cannot see any difference */
    }
}

status avl_insert(avl *t, key k, uint32_t value)
{
    assert(value != POOL_NONE);
    uint32_t *slots[AVL_HEIGHT_MAX + 1];
    int depth = 0;
    uint32_t *slot = &t->root;
    while (*slot != POOL_NONE) {
        avl_node *n = node_at(t, *slot);
        int c = key_compare(k, n->at);
        assert(c != 0);
        slots[depth++] = slot;
        slot = &n->child[c > 0];
    }
    uint32_t id;
    status s = pool_take(&t->nodes, &id);
    if (s != STATUS_OK)
        return s;
    avl_node *n = node_at(t, id);
    n->at = k;
    n->child[0] = n->child[1] = POOL_NONE;
    n->value = value;
    n->height = 1;
    *slot = id;
    balance_upwards(t, slots, depth);
    return STATUS_OK;
}

uint32_t avl_remove(avl *t, key k)
{
    uint32_t *slots[AVL_HEIGHT_MAX + 1];
    int depth = 0;
    uint32_t *slot = &t->root;
    avl_node *n = NULL;
    while (*slot != POOL_NONE) {
        n = node_at(t, *slot);
        int c = key_compare(k, n->at);
        if (c == 0)
            break;
        slots[depth++] = slot;
        slot = &n->child[c > 0];
    }
    if (*slot == POOL_NONE)
        return POOL_NONE;
    uint32_t gone = *slot, value = n->value;
    if (n->child[0] == POOL_NONE || n->child[1] == POOL_NONE) {
        *slot = n->child[n->child[0] == POOL_NONE];
        slots[depth++] = slot;
    } else {
        /* Two children: the next larger node's entry moves up, and that node, which has at most one child, goes. */
        slots[depth++] = slot;
        uint32_t *next = &n->child[1];
        while (node_at(t, *next)->child[0] != POOL_NONE) {
            slots[depth++] = next;
            next = &node_at(t, *next)->child[0];
        }
        avl_node *m = node_at(t, *next);
        n->at = m->at;
        n->value = m->value;
        gone = *next;
        *next = m->child[1];
        slots[depth++] = next;
    }
    pool_give(&t->nodes, gone);
    /* The lowest slot's own subtree was balanced already; its parents may not be. */
    balance_upwards(t, slots, depth - 1);
    return value;
}

static void walk_down(avl_walk *w, uint32_t id)
{
    for (; id != POOL_NONE; id = node_at(w->tree, id)->child[0])
        w->stack[w->depth++] = id;
}

bool avl_first(avl_walk *w, const avl *t, key *k_out, uint32_t *value_out)
{
    w->tree = t;
    w->depth = 0;
    walk_down(w, t->root);
    return avl_next(w, k_out, value_out);
}

bool avl_seek(avl_walk *w, const avl *t, key from, key *k_out, uint32_t *value_out)
{
    w->tree = t;
    w->depth = 0;
    for (uint32_t id = t->root; id != POOL_NONE;) {
        const avl_node *n = node_at(t, id);
        bool is_smaller = key_compare(n->at, from) < 0;
        if (!is_smaller)
            w->stack[w->depth++] = id; /* comes after what lies below it on the left */
        id = n->child[is_smaller];
    }
    return avl_next(w, k_out, value_out);
}

bool avl_next(avl_walk *w, key *k_out, uint32_t *value_out)
{
    if (w->depth == 0)
        return false;
    const avl_node *n = node_at(w->tree, w->stack[--w->depth]);
    *k_out = n->at;
    *value_out = n->value;
    walk_down(w, n->child[1]);
    return true;
}

bool avl_is_valid(const avl *t)
{
    avl_walk w;
    key k, last = {0, 0, 0};
    uint32_t value, n = 0;
    for (bool more = avl_first(&w, t, &k, &value); more; more = avl_next(&w, &k, &value)) {
        if (n++ > 0 && key_compare(last, k) >= 0)
            return false;
        last = k;
        if (w.depth > AVL_HEIGHT_MAX)
            return false;
    }
    if (n != t->nodes.count)
        return false;
    uint32_t stack[AVL_HEIGHT_MAX * 2 + 2];
    int depth = 0;
    if (t->root != POOL_NONE)
        stack[depth++] = t->root;
    while (depth > 0) {
        const avl_node *m = node_at(t, stack[--depth]);
        int a = height_of(t, m->child[0]), b = height_of(t, m->child[1]);
        if (m->height != 1 + (a > b ? a : b) || a - b > 1 || b - a > 1)
            return false;
        for (int side = 0; side < 2; side++)
            if (m->child[side] != POOL_NONE)
                stack[depth++] = m->child[side];
    }
    return true;
}
