/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/scratch_store.h"

#include <algorithm>
#include <cstring>

namespace {

auto &files_of(void *self) { return static_cast<scratch_store *>(self)->files; }

status port_read(void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    auto &files = files_of(self);
    auto at = files.find(name);
    *got_out = 0;
    if (at == files.end() || offset >= at->second.size())
        return STATUS_OK;
    *got_out = std::min<size_t>(n, at->second.size() - offset);
    std::memcpy(bytes, at->second.data() + offset, *got_out);
    return STATUS_OK;
}

status port_write(void *self, const char *name, uint64_t offset, const void *bytes, size_t n)
{
    std::string &file = files_of(self)[name];
    if (file.size() < offset + n)
        file.resize(offset + n);
    std::memcpy(file.data() + offset, bytes, n);
    return STATUS_OK;
}

status port_size(void *self, const char *name, uint64_t *bytes_out, bool *exists_out)
{
    auto &files = files_of(self);
    auto at = files.find(name);
    *exists_out = at != files.end();
    *bytes_out = *exists_out ? at->second.size() : 0;
    return STATUS_OK;
}

status port_truncate(void *self, const char *name, uint64_t bytes)
{
    files_of(self)[name].resize(bytes);
    return STATUS_OK;
}

status port_sync(void *, const char *) { return STATUS_OK; }

status port_rename(void *self, const char *from, const char *to)
{
    auto &files = files_of(self);
    auto at = files.find(from);
    if (at == files.end())
        return STATUS_IO;
    std::string bytes = std::move(at->second);
    files.erase(at);
    files[to] = std::move(bytes);
    return STATUS_OK;
}

status port_remove(void *self, const char *name)
{
    files_of(self).erase(name);
    return STATUS_OK;
}

status port_list(void *self, void (*take)(void *into, const char *name), void *into)
{
    for (const auto &[name, bytes] : files_of(self))
        take(into, name.c_str());
    return STATUS_OK;
}

} // namespace

byte_store scratch_store_port(scratch_store *s)
{
    return {s, port_read, port_write, port_size, port_truncate, port_sync, port_rename, port_remove, port_list};
}
