/* SPDX-License-Identifier: Apache-2.0 */
#include "tests/unit/station/shelf_disk.h"

#include <algorithm>
#include <cstring>

struct shelf_disk_store {
    shelf_disk *disk;
    std::string folder;
};

namespace {

/* How much of this call is done, and whether it says so. */
struct verdict {
    shelf_disk_part part;
    bool fails;
};

verdict judge(shelf_disk *d)
{
    d->calls++;
    if (d->dead)
        return {SHELF_DISK_NOTHING, true};
    if (d->calls != d->strike_at)
        return {SHELF_DISK_ALL, false};
    d->dead = d->cuts;
    return {d->done, true};
}

using work = std::function<std::string(shelf_disk_part part)>;

std::string call(shelf_disk *d, const std::string &folder, const std::string &name, const work &does)
{
    if (d->watch)
        d->watch(folder, name);
    const std::lock_guard<std::mutex> lock(d->guard);
    const verdict v = judge(d);
    std::string text = v.part == SHELF_DISK_NOTHING ? "" : does(v.part);
    return v.fails ? folder + ": struck" : text;
}

/* --- a store that is open --- */

status store_call(void *self, const char *name, const std::function<void(shelf_disk_folder &, shelf_disk_part)> &does)
{
    auto *s = static_cast<shelf_disk_store *>(self);
    const std::string text = call(s->disk, s->folder, name, [&](shelf_disk_part part) {
        does(s->disk->folders[s->folder], part);
        return "";
    });
    return text.empty() ? STATUS_OK : STATUS_IO;
}

status store_read(void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    *got_out = 0;
    return store_call(self, "read", [&](shelf_disk_folder &f, shelf_disk_part) {
        const auto file = f.find(name);
        if (file == f.end() || offset >= file->second.now.size())
            return;
        *got_out = std::min(n, file->second.now.size() - static_cast<size_t>(offset));
        std::memcpy(bytes, file->second.now.data() + offset, *got_out);
    });
}

status store_write(void *self, const char *name, uint64_t offset, const void *bytes, size_t n)
{
    return store_call(self, "write", [&](shelf_disk_folder &f, shelf_disk_part part) {
        const size_t written = part == SHELF_DISK_HALF ? n / 2 : n;
        std::string &now = f[name].now;
        now.resize(std::max(now.size(), static_cast<size_t>(offset) + written));
        std::memcpy(now.data() + offset, bytes, written);
    });
}

status store_size(void *self, const char *name, uint64_t *bytes_out, bool *exists_out)
{
    *bytes_out = 0;
    *exists_out = false;
    return store_call(self, "size", [&](shelf_disk_folder &f, shelf_disk_part) {
        *exists_out = f.count(name) > 0;
        *bytes_out = *exists_out ? f[name].now.size() : 0;
    });
}

status store_truncate(void *self, const char *name, uint64_t bytes)
{
    return store_call(self, "truncate", [&](shelf_disk_folder &f, shelf_disk_part) {
        f[name].now.resize(static_cast<size_t>(bytes));
    });
}

status store_sync(void *self, const char *name)
{
    return store_call(self, "sync", [&](shelf_disk_folder &f, shelf_disk_part part) {
        shelf_disk_file &file = f[name];
        file.durable = part == SHELF_DISK_HALF ? file.now.substr(0, file.now.size() / 2) : file.now;
    });
}

status store_rename(void *self, const char *from, const char *to)
{
    return store_call(self, "rename", [&](shelf_disk_folder &f, shelf_disk_part) {
        const shelf_disk_file file = f[from];
        f.erase(from);
        f[to] = file;
    });
}

status store_remove(void *self, const char *name)
{
    return store_call(self, "remove", [&](shelf_disk_folder &f, shelf_disk_part) { f.erase(name); });
}

status store_list(void *self, void (*take)(void *into, const char *name), void *into)
{
    std::vector<std::string> names; /* who takes one may call again */
    const status s = store_call(self, "list", [&](shelf_disk_folder &f, shelf_disk_part) {
        for (const auto &[name, file] : f)
            names.push_back(name);
    });
    for (const std::string &name : names)
        take(into, name.c_str());
    return s;
}

/* --- the port --- */

std::string replace(shelf_disk *d, const std::string &folder, const std::string &file, const std::string &bytes,
                    shelf_disk_part part)
{
    if (!d->folders.count(folder))
        return folder + ": no such folder";
    if (part == SHELF_DISK_HALF)
        d->folders[folder]["." + file + ".part"] = {bytes.substr(0, bytes.size() / 2), std::nullopt};
    else
        d->folders[folder][file] = {bytes, bytes};
    return "";
}

std::string store_open(shelf_disk *d, const std::string &folder, byte_store *store_out)
{
    if (d->stores.count(folder))
        return folder + ": is open";
    d->folders[folder];
    d->stores[folder] = std::make_unique<shelf_disk_store>(shelf_disk_store{d, folder});
    *store_out = {d->stores[folder].get(), store_read, store_write, store_size, store_truncate, store_sync,
                  store_rename, store_remove, store_list};
    return "";
}

std::string rename_folder(shelf_disk *d, const std::string &from, const std::string &to)
{
    if (d->stores.count(from) || !d->folders.count(from) || d->folders.count(to))
        return from + ": is open, not there, or " + to + " is there";
    auto node = d->folders.extract(from);
    node.key() = to;
    d->folders.insert(std::move(node));
    return "";
}

std::string remove_folder(shelf_disk *d, const std::string &folder, shelf_disk_part part)
{
    if (d->stores.count(folder))
        return folder + ": is open";
    const auto at = d->folders.find(folder);
    if (at == d->folders.end())
        return "";
    d->removed[folder] = at->second;
    if (part == SHELF_DISK_ALL)
        d->folders.erase(at);
    else if (!at->second.empty())
        at->second.erase(at->second.begin());
    return "";
}

} // namespace

shelf_disk::shelf_disk() = default;
shelf_disk::~shelf_disk() = default;

uint64_t shelf_disk::held() const
{
    uint64_t all = 0;
    for (const auto &[name, folder] : folders)
        for (const auto &[file, content] : folder)
            all += content.now.size();
    return all;
}

void shelf_disk::put(const std::string &folder, const std::string &file, const std::string &bytes)
{
    folders[folder][file] = {bytes, bytes};
}

void shelf_disk::after_cut(shelf_disk_part unsynced, bool removed_comes_back)
{
    for (auto &[name, folder] : folders)
        for (auto file = folder.begin(); file != folder.end();) {
            shelf_disk_file &f = file->second;
            if (unsynced == SHELF_DISK_NOTHING && f.durable != f.now)
                f.now = f.durable.value_or("");
            if (unsynced == SHELF_DISK_HALF && f.durable != f.now)
                f.now.resize(f.now.size() / 2);
            const bool absent = unsynced == SHELF_DISK_NOTHING && !f.durable;
            f.durable = f.now;
            file = absent ? folder.erase(file) : std::next(file);
        }
    for (auto &[name, folder] : removed)
        if (removed_comes_back)
            folders[name].insert(folder.begin(), folder.end());
    removed.clear();
    stores.clear();
    dead = cuts = false;
    calls = strike_at = 0;
}

shelf_port shelf_disk::port()
{
    shelf_port p;
    p.list = [this](auto *names_out) {
        return call(this, "shelf", "list", [&](auto) {
            for (const auto &[name, folder] : folders)
                names_out->push_back(name);
            return "";
        });
    };
    p.read = [this](auto &folder, auto &file, size_t most, auto *bytes_out) {
        return call(this, folder, "look", [&](auto) {
            const auto at = folders[folder].find(file);
            if (at != folders[folder].end())
                *bytes_out = at->second.now.substr(0, most);
            return "";
        });
    };
    p.replace = [this](auto &folder, auto &file, auto &bytes) {
        return call(this, folder, "replace", [&](auto part) { return replace(this, folder, file, bytes, part); });
    };
    p.open = [this](auto &folder, byte_store *store_out) {
        std::string text = call(this, folder, "open", [&](auto) { return store_open(this, folder, store_out); });
        const std::lock_guard<std::mutex> lock(guard);
        if (text.find("struck") != std::string::npos)
            stores.erase(folder); /* who gets no store closes none */
        return text;
    };
    p.close = [this](const byte_store &store) {
        const std::lock_guard<std::mutex> lock(guard);
        stores.erase(static_cast<shelf_disk_store *>(store.self)->folder);
    };
    p.rename = [this](auto &from, auto &to) {
        return call(this, from, "move", [&](auto) { return rename_folder(this, from, to); });
    };
    p.remove = [this](auto &folder) {
        return call(this, folder, "clear", [&](auto part) { return remove_folder(this, folder, part); });
    };
    p.bytes = [this](auto &folder, uint64_t *bytes_out) {
        return call(this, folder, "bytes", [&](auto) {
            *bytes_out = 0;
            for (const auto &[name, file] : folders[folder])
                *bytes_out += file.now.size();
            return "";
        });
    };
    p.free = [this](uint64_t *bytes_out) {
        return call(this, "shelf", "free", [&](auto) {
            *bytes_out = capacity - std::min(capacity, held());
            return "";
        });
    };
    return p;
}
