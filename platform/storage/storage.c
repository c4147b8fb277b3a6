/* SPDX-License-Identifier: Apache-2.0 */
#include "platform/storage/storage.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FOLDER_MODE = 0755, FILE_MODE = 0644 };

/* --- the folder --- */

/* The new folder's own name must survive as well: its parent is synced. */
static int parent_sync(int folder_fd)
{
    int fd = openat(folder_fd, "..", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0)
        return -errno;
    int result = fsync(fd) == 0 ? 0 : -errno;
    close(fd);
    return result;
}

int storage_open(storage *s, const char *folder)
{
    memset(s, 0, sizeof *s);
    s->folder_fd = -1;
    bool made = mkdir(folder, FOLDER_MODE) == 0;
    if (!made && errno != EEXIST)
        return -errno;
    s->folder_fd = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (s->folder_fd < 0)
        return -errno;
    int result = flock(s->folder_fd, LOCK_EX | LOCK_NB) == 0 ? 0 : -errno;
    if (result == 0 && made)
        result = parent_sync(s->folder_fd);
    if (result == 0 && fsync(s->folder_fd) != 0 && errno != EROFS)
        result = -errno;
    if (result != 0)
        storage_close(s);
    return result;
}

static void file_close(storage_file *f)
{
    if (f->name[0] != '\0' && f->fd >= 0)
        close(f->fd);
    f->name[0] = '\0';
}

void storage_close(storage *s)
{
    for (int n = 0; n < STORAGE_OPEN_MAX; n++)
        file_close(&s->files[n]);
    if (s->folder_fd >= 0)
        close(s->folder_fd); /* and with it the lock goes */
    s->folder_fd = -1;
}

static bool name_is_good(const char *name)
{
    size_t n = strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789._-");
    return n >= 1 && n <= STORAGE_NAME_MAX && name[n] == '\0' && strcmp(name, ".") != 0 && strcmp(name, "..") != 0;
}

/* --- open files --- */

static storage_file *file_find(storage *s, const char *name)
{
    for (int n = 0; n < STORAGE_OPEN_MAX; n++)
        if (strcmp(s->files[n].name, name) == 0)
            return &s->files[n];
    return NULL;
}

static int folder_sync(storage *s)
{
    if (fsync(s->folder_fd) != 0)
        return -errno;
    for (int n = 0; n < STORAGE_OPEN_MAX; n++)
        s->files[n].name_is_new = false;
    return 0;
}

/* What could not be written is clean to Linux, and would be read, until the machine needs the memory, as if the medium
   had it. */
static void lost_drop(int fd)
{
    int error = posix_fadvise(fd, 0, 0, POSIX_FADV_DONTNEED);
    (void)error; /* advice: a medium that cannot forget has nothing else to read from */
}

/* An earlier process may have died before it could sync: what the kernel writes of it by itself, and fails with, is
   told to the first that asks. Nothing to write costs a call; the medium's own cache is left alone. */
static void file_settle(int fd)
{
    const unsigned all = SYNC_FILE_RANGE_WAIT_BEFORE | SYNC_FILE_RANGE_WRITE | SYNC_FILE_RANGE_WAIT_AFTER;
    if (sync_file_range(fd, 0, 0, all) != 0)
        lost_drop(fd);
}

static int file_sync(storage *s, storage_file *f)
{
    if (f->fd < 0)
        return -EIO;
    if (f->written && fdatasync(f->fd) != 0) {
        int error = errno;
        lost_drop(f->fd);
        close(f->fd);
        f->fd = -1;
        return -error;
    }
    f->written = false;
    return f->name_is_new ? folder_sync(s) : 0;
}

/* A place in the table: a free one, or that of the file that has waited longest. A spoilt one keeps its place: only
   that tells it from a good one. */
static int place_find(storage *s, storage_file **place_out)
{
    storage_file *oldest = NULL;
    for (int n = 0; n < STORAGE_OPEN_MAX; n++) {
        storage_file *f = &s->files[n];
        if (f->name[0] == '\0') {
            *place_out = f;
            return 0;
        }
        if (f->fd >= 0 && (!oldest || f->turn < oldest->turn))
            oldest = f;
    }
    if (!oldest)
        return -EIO;
    int result = file_sync(s, oldest);
    if (result != 0)
        return result;
    file_close(oldest);
    *place_out = oldest;
    return 0;
}

/* The file, opened; with `make`, made when it is absent. */
static int file_open(storage *s, const char *name, bool make, storage_file **file_out)
{
    if (!name_is_good(name))
        return -EINVAL;
    storage_file *f = file_find(s, name);
    if (!f) {
        int result = place_find(s, &f);
        if (result != 0)
            return result;
        const int flags = O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
        int fd = openat(s->folder_fd, name, flags);
        bool made = false;
        if (fd < 0 && errno == EROFS)
            fd = openat(s->folder_fd, name, (flags & ~O_RDWR) | O_RDONLY);
        if (fd < 0 && errno == ENOENT && make) {
            fd = openat(s->folder_fd, name, flags | O_CREAT | O_EXCL, FILE_MODE);
            made = fd >= 0;
        }
        if (fd < 0)
            return -errno;
        struct stat is;
        if (fstat(fd, &is) != 0 || !S_ISREG(is.st_mode)) {
            close(fd);
            return -EINVAL;
        }
        if (!made)
            file_settle(fd);
        strcpy(f->name, name);
        f->fd = fd;
        f->written = made;
        f->name_is_new = made;
    }
    f->turn = ++s->turn;
    *file_out = f;
    return f->fd >= 0 ? 0 : -EIO;
}

/* --- reading and writing --- */

static int fd_read(int fd, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    while (*got_out < n) {
        ssize_t got = pread(fd, (char *)bytes + *got_out, n - *got_out, (off_t)(offset + *got_out));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return -errno;
        if (got == 0)
            break;
        *got_out += (size_t)got;
    }
    return 0;
}

int storage_read(storage *s, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    storage_file *f = name_is_good(name) ? file_find(s, name) : NULL;
    *got_out = 0;
    if (offset > INT64_MAX - n)
        return 0;
    if (f && f->fd < 0) { /* spoilt: what was on the medium before still is */
        int fd = openat(s->folder_fd, name, O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
        int read = fd < 0 ? -errno : fd_read(fd, offset, bytes, n, got_out);
        if (fd >= 0)
            close(fd);
        return read;
    }
    int result = file_open(s, name, false, &f);
    if (result != 0)
        return result == -ENOENT ? 0 : result;
    return fd_read(f->fd, offset, bytes, n, got_out);
}

int storage_write(storage *s, const char *name, uint64_t offset, const void *bytes, size_t n)
{
    storage_file *f;
    int result = file_open(s, name, true, &f);
    if (result != 0)
        return result;
    if (offset > INT64_MAX - n)
        return -EFBIG;
    f->written = true;
    for (size_t put = 0; put < n;) {
        ssize_t took = pwrite(f->fd, (const char *)bytes + put, n - put, (off_t)(offset + put));
        if (took < 0 && errno == EINTR)
            continue;
        if (took < 0)
            return -errno;
        if (took == 0)
            return -ENOSPC;
        put += (size_t)took;
    }
    return 0;
}

int storage_size(storage *s, const char *name, uint64_t *bytes_out, bool *exists_out)
{
    struct stat is;
    *bytes_out = 0;
    *exists_out = false;
    if (!name_is_good(name))
        return -EINVAL;
    if (fstatat(s->folder_fd, name, &is, AT_SYMLINK_NOFOLLOW) != 0)
        return errno == ENOENT ? 0 : -errno;
    *exists_out = true;
    *bytes_out = (uint64_t)is.st_size;
    return 0;
}

int storage_truncate(storage *s, const char *name, uint64_t bytes)
{
    storage_file *f;
    int result = file_open(s, name, true, &f);
    if (result != 0)
        return result;
    if (bytes > INT64_MAX)
        return -EFBIG;
    f->written = true;
    do
        result = ftruncate(f->fd, (off_t)bytes) == 0 ? 0 : -errno;
    while (result == -EINTR);
    return result;
}

/* --- keeping --- */

int storage_sync(storage *s, const char *name)
{
    storage_file *f;
    int result = file_open(s, name, false, &f);
    if (result != 0)
        return result;
    /* A file from before this storage was opened: nobody knows what of it is on the medium. */
    f->written = true;
    return file_sync(s, f);
}

int storage_rename(storage *s, const char *from, const char *to)
{
    storage_file *f;
    if (!name_is_good(to))
        return -EINVAL;
    f = name_is_good(from) ? file_find(s, from) : NULL;
    const bool spoilt = f && f->fd < 0;
    int result = spoilt ? 0 : file_open(s, from, false, &f);
    if (result == 0 && !spoilt && f->written)
        result = file_sync(s, f);
    if (result != 0)
        return result;
    if (renameat(s->folder_fd, from, s->folder_fd, to) != 0)
        return -errno;
    if (strcmp(from, to) != 0) {
        storage_file *replaced = file_find(s, to);
        if (replaced)
            file_close(replaced);
        file_close(f);
    }
    return folder_sync(s);
}

int storage_remove(storage *s, const char *name)
{
    if (!name_is_good(name))
        return -EINVAL;
    storage_file *f = file_find(s, name);
    if (unlinkat(s->folder_fd, name, 0) != 0 && errno != ENOENT)
        return -errno;
    if (f)
        file_close(f);
    return 0;
}

int storage_list(storage *s, void (*take)(void *into, const char *name), void *into)
{
    int fd = openat(s->folder_fd, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *folder = fd < 0 ? NULL : fdopendir(fd);
    if (!folder) {
        int error = errno;
        if (fd >= 0)
            close(fd);
        return -error;
    }
    for (;;) {
        errno = 0; /* the end of the folder leaves it alone */
        const struct dirent *entry = readdir(folder);
        if (!entry)
            break;
        struct stat is;
        if (name_is_good(entry->d_name) && fstatat(fd, entry->d_name, &is, AT_SYMLINK_NOFOLLOW) == 0 &&
            S_ISREG(is.st_mode))
            take(into, entry->d_name);
    }
    int result = -errno;
    closedir(folder);
    return result;
}
