/* SPDX-License-Identifier: Apache-2.0 */
#include "clay/change.h"

status change_init(change *c, uint32_t limit)
{
    c->recording = false;
    status s = avl_init(&c->index, limit);
    if (s != STATUS_OK)
        return s;
    s = pool_init(&c->images, sizeof(change_image), limit);
    if (s != STATUS_OK)
        avl_finish(&c->index);
    return s;
}

void change_finish(change *c)
{
    avl_finish(&c->index);
    pool_finish(&c->images);
}

void change_clear(change *c)
{
    avl_clear(&c->index);
    pool_clear(&c->images);
    c->recording = false;
}

status change_reserve(change *c, uint32_t more)
{
    status s = pool_reserve(&c->images, more);
    return s == STATUS_OK ? pool_reserve(&c->index.nodes, more) : s;
}

status change_keep(change *c, pages *p, key at, uint32_t brick_id, const brick *b, uint32_t *image_out)
{
    uint32_t id = avl_find(&c->index, at);
    if (id == POOL_NONE) {
        status s = pool_take(&c->images, &id);
        if (s != STATUS_OK)
            return s;
        s = avl_insert(&c->index, at, id);
        if (s != STATUS_OK) {
            pool_give(&c->images, id);
            return s;
        }
        change_image *image = (change_image *)pool_at(&c->images, id);
        *image = (change_image){.at = at, .page_id = POOL_NONE};
        if (b) {
            image->page_id = b->page_id;
            image->stored = b->stored;
            image->inside = b->inside;
            pages_hold(p, b->page_id);
        }
    }
    ((change_image *)pool_at(&c->images, id))->brick_id = brick_id;
    *image_out = id;
    return STATUS_OK;
}
