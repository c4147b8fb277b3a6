/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/shelf_store.h"

#include "platform/storage/storage_shelf.h"
#include "wiring/store.h"

#include <cerrno>
#include <cstring>

struct shelf_store {
    std::string path;
    storage outer;
};

namespace {

std::string path_of(const shelf_store *s, const std::string &folder) { return s->path + "/" + folder; }

std::string sentence(const std::string &path, int error)
{
    if (error == 0)
        return "";
    return path + ": " + (error == -EWOULDBLOCK ? "is open" : error == -EINVAL ? "expected a plain file"
                                                                             : std::strerror(-error));
}

std::string port_list(const shelf_store *s, std::vector<std::string> *names_out)
{
    const auto take = [](void *into, const char *name) {
        static_cast<std::vector<std::string> *>(into)->emplace_back(name);
    };
    return sentence(s->path, storage_shelf_list(&s->outer, take, names_out));
}

std::string port_read(const shelf_store *s, const std::string &folder, const std::string &file, size_t most,
                      std::optional<std::string> *bytes_out)
{
    std::string bytes(most, '\0');
    size_t got = 0;
    bool exists = false;
    const int error =
        storage_shelf_read(&s->outer, folder.c_str(), file.c_str(), bytes.data(), most, &got, &exists);
    bytes.resize(got);
    *bytes_out = exists && error == 0 ? std::optional(bytes) : std::nullopt;
    return sentence(path_of(s, folder) + "/" + file, error);
}

std::string port_replace(const shelf_store *s, const std::string &folder, const std::string &file,
                         const std::string &bytes)
{
    std::string text;
    const auto write = [&bytes](checkpoint_sink sink, void *self) { return sink(self, bytes.data(), bytes.size()); };
    const bool done = store_export(path_of(s, folder) + "/" + file, write, &text);
    return done ? "" : text;
}

std::string port_open(const shelf_store *s, const std::string &folder, byte_store *store_out)
{
    std::string text;
    return store_open(path_of(s, folder), store_out, &text) ? "" : text;
}

} // namespace

shelf_store *shelf_store_open(const std::string &folder, shelf_port *port_out, std::string *text_out)
{
    auto *s = new shelf_store;
    s->path = folder;
    const int error = storage_open(&s->outer, folder.c_str());
    if (error != 0) {
        *text_out =
            folder + ": " + (error == -EWOULDBLOCK ? "another glaise has this shelf open" : std::strerror(-error));
        delete s;
        return nullptr;
    }
    port_out->list = [s](auto *names_out) { return port_list(s, names_out); };
    port_out->read = [s](auto &in, auto &file, size_t most, auto *out) { return port_read(s, in, file, most, out); };
    port_out->replace = [s](auto &in, auto &file, auto &bytes) { return port_replace(s, in, file, bytes); };
    port_out->open = [s](auto &name, byte_store *store_out) { return port_open(s, name, store_out); };
    port_out->close = [](const byte_store &b) { store_close(static_cast<store *>(b.self)); };
    port_out->rename = [s](auto &from, auto &to) {
        return sentence(path_of(s, from), storage_shelf_rename(&s->outer, from.c_str(), to.c_str()));
    };
    port_out->remove = [s](auto &name) {
        return sentence(path_of(s, name), storage_shelf_remove(&s->outer, name.c_str()));
    };
    port_out->bytes = [s](auto &name, uint64_t *bytes_out) {
        return sentence(path_of(s, name), storage_shelf_bytes(&s->outer, name.c_str(), bytes_out));
    };
    port_out->free = [s](uint64_t *bytes_out) { return sentence(s->path, storage_shelf_free(&s->outer, bytes_out)); };
    return s;
}

void shelf_store_close(shelf_store *s)
{
    if (!s)
        return;
    storage_close(&s->outer);
    delete s;
}
