/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A byte store on real files for the tests of history: platform/storage behind history's port.
 * Is not:  The one the station uses (wiring joins the two there).
 * Shape:   storage's source is compiled into the one test that includes this, because a unit test links its own room
 *          and the rooms beneath it, and no platform room lies beneath history.
 */
#ifndef GLAISE_UNIT_HISTORY_STORAGE_STORE_H
#define GLAISE_UNIT_HISTORY_STORAGE_STORE_H

#include "history/byte_store.h"

#include <cerrno>

extern "C" {
#include "platform/storage/storage.c"
}

inline storage *storage_store_of(void *self) { return static_cast<storage *>(self); }
inline status storage_store_status(int result)
{
    return result == 0 ? STATUS_OK : result == -ENOSPC ? STATUS_NO_SPACE : STATUS_IO;
}

inline byte_store storage_store_port(storage *s)
{
    byte_store b = {};
    b.self = s;
    b.read = [](void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got) {
        return storage_store_status(storage_read(storage_store_of(self), name, offset, bytes, n, got));
    };
    b.write = [](void *self, const char *name, uint64_t offset, const void *bytes, size_t n) {
        return storage_store_status(storage_write(storage_store_of(self), name, offset, bytes, n));
    };
    b.size = [](void *self, const char *name, uint64_t *bytes, bool *exists) {
        return storage_store_status(storage_size(storage_store_of(self), name, bytes, exists));
    };
    b.truncate = [](void *self, const char *name, uint64_t bytes) {
        return storage_store_status(storage_truncate(storage_store_of(self), name, bytes));
    };
    b.sync = [](void *self, const char *name) {
        return storage_store_status(storage_sync(storage_store_of(self), name));
    };
    b.rename = [](void *self, const char *from, const char *to) {
        return storage_store_status(storage_rename(storage_store_of(self), from, to));
    };
    b.remove = [](void *self, const char *name) {
        return storage_store_status(storage_remove(storage_store_of(self), name));
    };
    b.list = [](void *self, void (*take)(void *into, const char *name), void *into) {
        return storage_store_status(storage_list(storage_store_of(self), take, into));
    };
    return b;
}

#endif
