/* SPDX-License-Identifier: Apache-2.0 */
#include "history/whole_file.h"

#include "history/sentence.h"

enum { SET_ASIDE_TRIES = 10000 };

/* A store that gives less than it has is asked again: only nothing at all means the end. */
static status read_from_start(const byte_store *store, const char *name, uint8_t *bytes, size_t n, size_t *got_out)
{
    status s = STATUS_OK;
    *got_out = 0;
    while (s == STATUS_OK && *got_out < n) {
        size_t got = 0;
        s = store->read(store->self, name, *got_out, bytes + *got_out, n - *got_out, &got);
        if (got == 0)
            break;
        *got_out += got;
    }
    return s;
}

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
    return s == STATUS_OK ? read_from_start(store, name, out->bytes, (size_t)size, &out->size) : s;
}

status whole_file_read_head(const byte_store *store, const char *name, void *bytes, size_t n, size_t *got_out,
                            uint64_t *size_out, bool *exists_out)
{
    *got_out = 0;
    *exists_out = false;
    status s = store->size(store->self, name, size_out, exists_out);
    if (s != STATUS_OK || !*exists_out)
        return s;
    return read_from_start(store, name, (uint8_t *)bytes, n, got_out);
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
