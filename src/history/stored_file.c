/* SPDX-License-Identifier: Apache-2.0 */
#include "history/stored_file.h"

#include "history/sentence.h"

enum { SET_ASIDE_TRIES = 10000 };

status stored_file_read(const stored_file *f, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    status s = STATUS_OK;
    *got_out = 0;
    while (s == STATUS_OK && *got_out < n) {
        size_t got = 0;
        s = f->store->read(f->store->self, f->name, offset + *got_out, (uint8_t *)bytes + *got_out, n - *got_out, &got);
        if (got == 0)
            break;
        *got_out += got;
    }
    return s;
}

status stored_file_get(void *self, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    return stored_file_read((const stored_file *)self, offset, bytes, n, got_out);
}

status stored_file_set_aside(const stored_file *f)
{
    const byte_store *store = f->store;
    uint64_t size;
    bool exists = false;
    status s = store->size(store->self, f->name, &size, &exists);
    if (s != STATUS_OK || !exists)
        return s;
    for (int n = 1; n < SET_ASIDE_TRIES; n++) {
        char aside[BYTE_STORE_NAME_MAX + 1];
        sentence text = sentence_begin(aside, sizeof aside);
        sentence_add(&text, f->name);
        sentence_add(&text, n == 1 ? ".set-aside" : ".set-aside-");
        if (n > 1)
            sentence_add_number(&text, (uint64_t)n, 1);
        s = store->size(store->self, aside, &size, &exists);
        if (s != STATUS_OK)
            return s;
        if (!exists)
            return store->rename(store->self, f->name, aside);
    }
    return STATUS_IO;
}
