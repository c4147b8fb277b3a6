/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A byte store in memory that can be told to fail, and that remembers when it was used against the rules of
 *          byte_store.h.
 * Is not:  A disk that loses what was not synced: every write is at once what is read.
 * Shape:   calls are counted from 1; the call of number fail_at (and all after it when fail_on is set) answers
 *          STATUS_IO, before or after it did its work.
 * Owner:   the test; port() holds a pointer to it.
 */
#ifndef GLAISE_UNIT_HISTORY_MEMORY_STORE_H
#define GLAISE_UNIT_HISTORY_MEMORY_STORE_H

#include "history/byte_store.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

struct memory_store {
    std::map<std::string, std::vector<uint8_t>> files;
    uint64_t calls = 0, renames = 0;
    uint64_t fail_at = 0;          /* 0: never */
    bool fail_on = false;          /* and every call after that one */
    bool fail_having_done = false; /* the work was done all the same */
    std::string unreadable;        /* reading this file fails */
    size_t read_at_most = SIZE_MAX;
    std::set<std::string> unsynced, spoilt;
    std::string misuse; /* the first rule that was broken */

    uint64_t most_bytes = UINT64_MAX; /* a file grows only as long as all of them together stay below this */

    byte_store port();
    uint64_t held() const
    {
        uint64_t all = 0;
        for (const auto &[name, bytes] : files)
            all += bytes.size();
        return all;
    }
    bool has(const std::string &name, uint64_t size) const
    {
        const auto at = files.find(name);
        return at != files.end() && at->second.size() >= size;
    }
};

inline memory_store &memory_store_of(void *self) { return *static_cast<memory_store *>(self); }

inline void memory_store_complain(memory_store &m, const std::string &what)
{
    if (m.misuse.empty())
        m.misuse = what;
}

inline void memory_store_check_name(memory_store &m, const std::string &name)
{
    if (name.empty() || name.size() > BYTE_STORE_NAME_MAX || name == "." || name == ".." ||
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789._-") != std::string::npos)
        memory_store_complain(m, "bad name " + name);
}

/* Does `work`, or fails, or both. */
template <typename work_type> status memory_store_call(void *self, const char *name, work_type work)
{
    memory_store &m = memory_store_of(self);
    memory_store_check_name(m, name);
    m.calls++;
    const bool fails = m.fail_at != 0 && (m.calls == m.fail_at || (m.fail_on && m.calls > m.fail_at));
    if (!fails || m.fail_having_done)
        work(m, std::string(name));
    return fails ? STATUS_IO : STATUS_OK;
}

inline status memory_store_read(void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got)
{
    *got = 0;
    if (memory_store_of(self).unreadable == name)
        return STATUS_IO;
    return memory_store_call(self, name, [&](memory_store &m, const std::string &file) {
        const auto at = m.files.find(file);
        if (at == m.files.end() || offset >= at->second.size())
            return;
        *got = std::min({n, at->second.size() - static_cast<size_t>(offset), m.read_at_most});
        std::memcpy(bytes, at->second.data() + offset, *got);
    });
}

inline status memory_store_write(void *self, const char *name, uint64_t offset, const void *bytes, size_t n)
{
    memory_store &room = memory_store_of(self);
    if (room.held() + n > room.most_bytes && !room.has(name, offset + n))
        return STATUS_NO_SPACE;
    return memory_store_call(self, name, [&](memory_store &m, const std::string &file) {
        if (m.spoilt.count(file))
            memory_store_complain(m, "wrote to " + file + ", whose sync had failed");
        std::vector<uint8_t> &f = m.files[file];
        if (f.size() < offset + n)
            f.resize(offset + n);
        std::memcpy(f.data() + offset, bytes, n);
        m.unsynced.insert(file);
    });
}

inline status memory_store_size(void *self, const char *name, uint64_t *bytes, bool *exists)
{
    *bytes = 0;
    *exists = false;
    return memory_store_call(self, name, [&](memory_store &m, const std::string &file) {
        const auto at = m.files.find(file);
        *exists = at != m.files.end();
        *bytes = *exists ? at->second.size() : 0;
    });
}

inline status memory_store_truncate(void *self, const char *name, uint64_t bytes)
{
    return memory_store_call(self, name, [&](memory_store &m, const std::string &file) {
        m.files[file].resize(bytes);
        m.unsynced.insert(file);
    });
}

inline status memory_store_sync(void *self, const char *name)
{
    memory_store &m = memory_store_of(self);
    if (m.spoilt.count(name))
        memory_store_complain(m, std::string("synced again ") + name);
    const status s = memory_store_call(self, name, [](memory_store &, const std::string &) {});
    if (s == STATUS_OK)
        m.unsynced.erase(name);
    else
        m.spoilt.insert(name);
    return s;
}

inline status memory_store_rename(void *self, const char *from, const char *to)
{
    memory_store_check_name(memory_store_of(self), to);
    return memory_store_call(self, from, [&](memory_store &m, const std::string &file) {
        if (!m.files.count(file))
            memory_store_complain(m, "renamed " + file + ", which is not there");
        const bool set_aside = std::string(to).find(".set-aside") != std::string::npos; /* whatever it holds */
        if (!set_aside && (m.unsynced.count(file) || m.spoilt.count(file)))
            memory_store_complain(m, "renamed " + file + ", which is not synced");
        m.files[to] = m.files[file];
        m.files.erase(file);
        m.unsynced.erase(file);
        m.spoilt.erase(file);
        m.renames++;
    });
}

inline status memory_store_remove(void *self, const char *name)
{
    return memory_store_call(self, name, [](memory_store &m, const std::string &file) {
        m.files.erase(file);
        m.unsynced.erase(file);
        m.spoilt.erase(file);
    });
}

inline status memory_store_list(void *self, void (*take)(void *into, const char *name), void *into)
{
    return memory_store_call(self, "list", [&](memory_store &m, const std::string &) {
        for (const auto &[name, bytes] : m.files)
            take(into, name.c_str());
    });
}

inline byte_store memory_store::port()
{
    return {this,
            memory_store_read,
            memory_store_write,
            memory_store_size,
            memory_store_truncate,
            memory_store_sync,
            memory_store_rename,
            memory_store_remove,
            memory_store_list};
}

#endif
