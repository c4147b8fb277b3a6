/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/store.h"

#include "platform/storage/storage.h"
#include "platform/storage/storage_export.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

struct store {
    storage files;
};

namespace {

storage *of(void *self) { return &static_cast<store *>(self)->files; }
status answer(int error)
{
    const bool full = error == -ENOSPC || error == -EDQUOT || error == -EFBIG;
    return error == 0 ? STATUS_OK : full ? STATUS_NO_SPACE : STATUS_IO;
}

status port_read(void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    return answer(storage_read(of(self), name, offset, bytes, n, got_out));
}

status port_write(void *self, const char *name, uint64_t offset, const void *bytes, size_t n)
{
    return answer(storage_write(of(self), name, offset, bytes, n));
}

status port_size(void *self, const char *name, uint64_t *bytes_out, bool *exists_out)
{
    return answer(storage_size(of(self), name, bytes_out, exists_out));
}

status port_truncate(void *self, const char *name, uint64_t bytes)
{
    return answer(storage_truncate(of(self), name, bytes));
}
status port_sync(void *self, const char *name) { return answer(storage_sync(of(self), name)); }
status port_rename(void *self, const char *from, const char *to) { return answer(storage_rename(of(self), from, to)); }
status port_remove(void *self, const char *name) { return answer(storage_remove(of(self), name)); }
status port_list(void *self, void (*take)(void *into, const char *name), void *into)
{
    return answer(storage_list(of(self), take, into));
}

status sink_write(void *self, const void *bytes, size_t n)
{
    return answer(storage_export_write(static_cast<storage_export *>(self), bytes, n));
}

status source_read(void *self, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    *got_out = 0;
    while (*got_out < n) {
        ssize_t got = pread(*static_cast<int *>(self), static_cast<char *>(bytes) + *got_out, n - *got_out,
                            static_cast<off_t>(offset + *got_out));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return STATUS_IO;
        if (got == 0)
            break;
        *got_out += static_cast<size_t>(got);
    }
    return STATUS_OK;
}

} // namespace

store *store_open(const std::string &folder, byte_store *port_out, std::string *text_out)
{
    auto *s = new store;
    int error = storage_open(&s->files, folder.c_str());
    if (error != 0) {
        *text_out =
            folder + ": " + (error == -EWOULDBLOCK ? "another glaise has this store open" : std::strerror(-error));
        delete s;
        return nullptr;
    }
    *port_out = {s, port_read, port_write, port_size, port_truncate, port_sync, port_rename, port_remove,
                 port_list};
    return s;
}

void store_close(store *s)
{
    if (!s)
        return;
    storage_close(&s->files);
    delete s;
}

bool store_export(const std::string &path, const std::function<status(checkpoint_sink, void *)> &write,
                  std::string *text_out)
{
    storage_export e;
    storage_export_begin(&e, path.c_str()); /* its error comes back from the end */
    status s = write(sink_write, &e);
    if (s != STATUS_OK && e.error == 0) {
        storage_export_abandon(&e);
        *text_out = path + ": " + status_text(s);
        return false;
    }
    int error = storage_export_end(&e);
    if (error != 0)
        *text_out = path + ": " + std::strerror(-error);
    return error == 0;
}

bool store_import(const std::string &path, const std::function<bool(checkpoint_source, void *)> &read,
                  std::string *text_out)
{
    struct stat facts;
    int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0 || fstat(fd, &facts) != 0 || !S_ISREG(facts.st_mode)) {
        *text_out = path + ": " + (fd >= 0 ? "expected a plain file" : std::strerror(errno));
        if (fd >= 0)
            close(fd);
        return false;
    }
    bool good = read(source_read, &fd);
    close(fd);
    return good;
}
