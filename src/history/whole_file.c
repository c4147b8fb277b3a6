/* SPDX-License-Identifier: Apache-2.0 */
#include "history/whole_file.h"

#include "history/sentence.h"

enum { SET_ASIDE_TRIES = 10000 };

status whole_file_read(const byte_store *store, const char *name, byte_buffer *out, bool *exists_out)
{
    uint64_t size = 0;
    *exists_out = false;
    out->size = 0;
    status s = store->size(store->self, name, &size, exists_out);
    if (s != STATUS_OK || !*exists_out)
        return s;
    if (size > SIZE_MAX)
        return STATUS_NO_MEMORY;
    s = byte_buffer_reserve(out, (size_t)size);
    while (s == STATUS_OK && out->size < size) {
        size_t got = 0;
        s = store->read(store->self, name, out->size, out->bytes + out->size, (size_t)size - out->size, &got);
        if (got == 0)
            break;
        out->size += got;
    }
    return s;
}

status whole_file_write(const byte_store *store, const char *temporary, const void *bytes, size_t n)
{
    status s = store->remove(store->self, temporary);
    if (s == STATUS_OK)
        s = store->write(store->self, temporary, 0, bytes, n);
    return s == STATUS_OK ? store->sync(store->self, temporary) : s;
}

status whole_file_replace(const byte_store *store, const char *temporary, const char *name, const void *bytes, size_t n)
{
    status s = whole_file_write(store, temporary, bytes, n);
    return s == STATUS_OK ? store->rename(store->self, temporary, name) : s;
}

status whole_file_set_aside(const byte_store *store, const char *name)
{
    uint64_t size;
    bool exists = false;
    status s = store->size(store->self, name, &size, &exists);
    if (s != STATUS_OK || !exists)
        return s;
    for (int n = 1; n < SET_ASIDE_TRIES; n++) {
        char aside[BYTE_STORE_NAME_MAX + 1];
        sentence text = sentence_begin(aside, sizeof aside);
        sentence_add(&text, name);
        sentence_add(&text, n == 1 ? ".set-aside" : ".set-aside-");
        if (n > 1)
            sentence_add_number(&text, (uint64_t)n, 1);
        s = store->size(store->self, aside, &size, &exists);
        if (s != STATUS_OK)
            return s;
        if (!exists)
            return store->rename(store->self, name, aside);
    }
    return STATUS_IO;
}
