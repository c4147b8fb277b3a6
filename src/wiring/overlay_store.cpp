/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/overlay_store.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace {

constexpr size_t COPY_BYTES = 1 << 20;

overlay_store &of(void *self) { return *static_cast<overlay_store *>(self); }

/* The file beneath that a name stands for; empty where it stands for none. */
std::string beneath(const overlay_store &s, const std::string &name)
{
    const auto at = s.files.find(name);
    return at == s.files.end() ? name : at->second.beneath;
}

const overlay_store_file *in_memory(const overlay_store &s, const std::string &name)
{
    const auto at = s.files.find(name);
    return at != s.files.end() && at->second.beneath.empty() && at->second.is_there ? &at->second : nullptr;
}

status port_size(void *self, const char *name, uint64_t *bytes_out, bool *exists_out)
{
    overlay_store &s = of(self);
    const std::string file = beneath(s, name);
    if (!file.empty())
        return s.under.size(s.under.self, file.c_str(), bytes_out, exists_out);
    const overlay_store_file *held = in_memory(s, name);
    *exists_out = held != nullptr;
    *bytes_out = held ? held->bytes.size() : 0;
    return STATUS_OK;
}

status port_read(void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    overlay_store &s = of(self);
    const std::string file = beneath(s, name);
    if (!file.empty())
        return s.under.read(s.under.self, file.c_str(), offset, bytes, n, got_out);
    const overlay_store_file *held = in_memory(s, name);
    *got_out = held && offset < held->bytes.size() ? std::min<size_t>(n, held->bytes.size() - offset) : 0;
    if (*got_out > 0)
        std::memcpy(bytes, held->bytes.data() + offset, *got_out);
    return STATUS_OK;
}

/* The file's bytes, in memory from now on. */
status hold(overlay_store &s, const std::string &name, std::string **bytes_out)
{
    overlay_store_file held;
    uint64_t size = 0;
    bool exists = false;
    status outcome = port_size(&s, name.c_str(), &size, &exists);
    held.is_there = true;
    held.bytes.resize(size);
    for (size_t got = 0, more = 1; outcome == STATUS_OK && got < size && more > 0; got += more)
        outcome = port_read(&s, name.c_str(), got, held.bytes.data() + got, size - got, &more);
    if (outcome != STATUS_OK)
        return outcome;
    overlay_store_file &file = s.files[name];
    file = std::move(held);
    *bytes_out = &file.bytes;
    return STATUS_OK;
}

status port_write(void *self, const char *name, uint64_t offset, const void *bytes, size_t n)
{
    std::string *file = nullptr;
    const overlay_store_file *held = in_memory(of(self), name);
    if (held)
        file = &of(self).files[name].bytes;
    else if (const status outcome = hold(of(self), name, &file); outcome != STATUS_OK)
        return outcome;
    if (file->size() < offset + n)
        file->resize(offset + n);
    std::memcpy(file->data() + offset, bytes, n);
    return STATUS_OK;
}

status port_truncate(void *self, const char *name, uint64_t bytes)
{
    std::string *file = nullptr;
    const status outcome = hold(of(self), name, &file);
    if (outcome == STATUS_OK)
        file->resize(bytes);
    return outcome;
}

status port_sync(void *, const char *) { return STATUS_OK; }

status port_rename(void *self, const char *from, const char *to)
{
    overlay_store &s = of(self);
    overlay_store_file moved;
    const overlay_store_file *held = in_memory(s, from);
    if (held)
        moved = *held;
    else
        moved.beneath = beneath(s, from);
    s.files[from] = {};
    s.files[to] = std::move(moved);
    return STATUS_OK;
}

status port_remove(void *self, const char *name)
{
    of(self).files[name] = {};
    return STATUS_OK;
}

status port_list(void *self, void (*take)(void *into, const char *name), void *into)
{
    overlay_store &s = of(self);
    std::set<std::string> names;
    const auto add = [](void *to, const char *name) { static_cast<std::set<std::string> *>(to)->insert(name); };
    const status outcome = s.under.list(s.under.self, add, &names);
    for (const auto &[name, file] : s.files) {
        names.erase(name);
        if (file.is_there || !file.beneath.empty())
            names.insert(name);
    }
    for (const std::string &name : names)
        take(into, name.c_str());
    return outcome;
}

status copy_file(overlay_store &s, const std::string &name, const byte_store &to)
{
    std::vector<char> bytes(COPY_BYTES);
    status outcome = STATUS_OK;
    size_t got = 1;
    for (uint64_t at = 0; outcome == STATUS_OK && got > 0; at += got) {
        outcome = port_read(&s, name.c_str(), at, bytes.data(), bytes.size(), &got);
        if (outcome == STATUS_OK && got > 0)
            outcome = to.write(to.self, name.c_str(), at, bytes.data(), got);
    }
    return outcome == STATUS_OK ? to.sync(to.self, name.c_str()) : outcome;
}

} // namespace

byte_store overlay_store_port(overlay_store *s)
{
    return {s, port_read, port_write, port_size, port_truncate, port_sync, port_rename, port_remove, port_list};
}

status overlay_store_copy(overlay_store *s, const std::set<std::string> &without, const byte_store &to)
{
    std::vector<std::string> names;
    const auto add = [](void *into, const char *name) {
        static_cast<std::vector<std::string> *>(into)->emplace_back(name);
    };
    status outcome = port_list(s, add, &names);
    for (const std::string &name : names)
        if (outcome == STATUS_OK && name.find(".set-aside") == std::string::npos && !without.contains(name))
            outcome = copy_file(*s, name, to);
    return outcome;
}
