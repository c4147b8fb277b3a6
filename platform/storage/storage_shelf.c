/* SPDX-License-Identifier: Apache-2.0 */
#include "platform/storage/storage_shelf.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

enum { STAT_BLOCK_BYTES = 512 }; /* stat(2): of st_blocks, whatever the file system's own are */

static bool name_is_good(const char *name)
{
    size_t n = strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789._-");
    return n >= 1 && n <= STORAGE_NAME_MAX && name[n] == '\0' && strcmp(name, ".") != 0 && strcmp(name, "..") != 0;
}

static int folder_open(const storage *s, const char *folder, int *fd_out)
{
    *fd_out = -1;
    if (!name_is_good(folder))
        return -EINVAL;
    *fd_out = openat(s->folder_fd, folder, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    return *fd_out < 0 ? -errno : 0;
}

/* Nobody has it open, and until it is closed nobody can. */
static int folder_lock(const storage *s, const char *folder, int *fd_out)
{
    int result = folder_open(s, folder, fd_out);
    if (result == 0 && flock(*fd_out, LOCK_EX | LOCK_NB) != 0) {
        result = -errno;
        close(*fd_out);
        *fd_out = -1;
    }
    return result;
}

/* --- walking through a folder --- */

typedef int (*visitor)(void *into, int folder_fd, const char *name);

/* Everything in it, until the visitor answers other than 0. The descriptor stays open. */
static int folder_walk(int folder_fd, visitor visit, void *into)
{
    int fd = openat(folder_fd, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *folder = fd < 0 ? NULL : fdopendir(fd);
    int result = 0;
    if (!folder) {
        result = -errno;
        if (fd >= 0)
            close(fd);
        return result;
    }
    while (result == 0) {
        errno = 0; /* the end of the folder leaves it alone */
        const struct dirent *entry = readdir(folder);
        if (!entry) {
            result = -errno;
            break;
        }
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            result = visit(into, fd, entry->d_name);
    }
    closedir(folder);
    return result;
}

typedef struct taking {
    void (*take)(void *into, const char *name);
    void *into;
} taking;

static int visit_folder(void *into, int folder_fd, const char *name)
{
    const taking *t = into;
    struct stat is;
    if (name_is_good(name) && fstatat(folder_fd, name, &is, AT_SYMLINK_NOFOLLOW) == 0 && S_ISDIR(is.st_mode))
        t->take(t->into, name);
    return 0;
}

static int visit_to_measure(void *into, int folder_fd, const char *name)
{
    uint64_t *bytes = into;
    struct stat is;
    if (fstatat(folder_fd, name, &is, AT_SYMLINK_NOFOLLOW) == 0)
        *bytes += (uint64_t)is.st_blocks * STAT_BLOCK_BYTES;
    else if (errno != ENOENT)
        return -errno;
    return 0;
}

static int visit_to_remove(void *into, int folder_fd, const char *name)
{
    (void)into;
    if (unlinkat(folder_fd, name, 0) == 0 || errno == ENOENT || errno == EISDIR)
        return 0; /* a folder in it is found out when the whole is to go */
    return -errno;
}

int storage_shelf_list(const storage *s, void (*take)(void *into, const char *name), void *into)
{
    taking t = {take, into};
    return folder_walk(s->folder_fd, visit_folder, &t);
}

int storage_shelf_bytes(const storage *s, const char *folder, uint64_t *bytes_out)
{
    int fd;
    *bytes_out = 0;
    int result = folder_open(s, folder, &fd);
    if (result == 0) {
        result = folder_walk(fd, visit_to_measure, bytes_out);
        close(fd);
    }
    return result;
}

int storage_shelf_remove(const storage *s, const char *folder)
{
    int fd;
    int result = folder_lock(s, folder, &fd);
    if (result != 0)
        return result == -ENOENT ? 0 : result;
    result = folder_walk(fd, visit_to_remove, NULL);
    if (result == 0 && unlinkat(s->folder_fd, folder, AT_REMOVEDIR) != 0)
        result = -errno;
    close(fd);
    return result;
}

/* --- the rest --- */

static int fd_read(int fd, void *bytes, size_t n, size_t *got_out)
{
    struct stat is;
    if (fstat(fd, &is) != 0 || !S_ISREG(is.st_mode))
        return -EINVAL;
    while (*got_out < n) {
        ssize_t got = pread(fd, (char *)bytes + *got_out, n - *got_out, (off_t)*got_out);
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

int storage_shelf_read(const storage *s, const char *folder, const char *file, void *bytes, size_t n, size_t *got_out,
                       bool *exists_out)
{
    int folder_fd;
    *got_out = 0;
    *exists_out = false;
    int result = name_is_good(file) ? folder_open(s, folder, &folder_fd) : -EINVAL;
    if (result != 0)
        return result;
    int fd = openat(folder_fd, file, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    result = fd < 0 ? -errno : 0;
    close(folder_fd);
    if (fd < 0)
        return result == -ENOENT ? 0 : result == -ELOOP ? -EINVAL : result;
    *exists_out = true;
    result = fd_read(fd, bytes, n, got_out);
    close(fd);
    return result;
}

int storage_shelf_rename(const storage *s, const char *from, const char *to)
{
    int fd;
    if (!name_is_good(to))
        return -EINVAL;
    int result = folder_lock(s, from, &fd);
    if (result != 0)
        return result;
    if (renameat(s->folder_fd, from, s->folder_fd, to) != 0 || fsync(s->folder_fd) != 0)
        result = -errno;
    close(fd);
    return result;
}

int storage_shelf_free(const storage *s, uint64_t *bytes_out)
{
    struct statvfs is;
    *bytes_out = 0;
    if (fstatvfs(s->folder_fd, &is) != 0)
        return -errno;
    *bytes_out = (uint64_t)is.f_bavail * is.f_frsize;
    return 0;
}
