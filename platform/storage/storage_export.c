/* SPDX-License-Identifier: Apache-2.0 */
#include "platform/storage/storage_export.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FILE_MODE = 0644, PART_TRIES = 1000 };

static void put_down(storage_export *e)
{
    if (e->fd >= 0)
        close(e->fd);
    if (e->folder_fd >= 0)
        close(e->folder_fd);
    e->fd = e->folder_fd = -1;
}

static int fail(storage_export *e, int error)
{
    if (e->fd >= 0)
        unlinkat(e->folder_fd, e->part, 0);
    put_down(e);
    e->error = error;
    return error;
}

static int folder_open(const char *path, size_t folder_length)
{
    const int flags = O_RDONLY | O_DIRECTORY | O_CLOEXEC;
    if (folder_length == 0)
        return open(".", flags);
    char *folder = strndup(path, folder_length);
    if (!folder) {
        errno = ENOMEM;
        return -1;
    }
    int fd = open(folder, flags);
    int error = errno;
    free(folder);
    errno = error;
    return fd;
}

/* A part that an earlier program of the same number left behind is not ours to touch: the next name is tried. */
static int part_open(storage_export *e)
{
    for (int n = 0; n < PART_TRIES; n++) {
        int length = snprintf(e->part, sizeof e->part, ".%s.%ld-%d.part", e->name, (long)getpid(), n);
        if (length < 0 || (size_t)length >= sizeof e->part)
            return -ENAMETOOLONG;
        e->fd = openat(e->folder_fd, e->part, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, FILE_MODE);
        if (e->fd >= 0)
            return 0;
        if (errno != EEXIST)
            return -errno;
    }
    return -EEXIST;
}

int storage_export_begin(storage_export *e, const char *path)
{
    memset(e, 0, sizeof *e);
    e->fd = e->folder_fd = -1;
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    if (name[0] == '\0' || strcmp(name, ".") == 0 || strcmp(name, "..") == 0)
        return fail(e, -EINVAL);
    if (strlen(name) >= sizeof e->name)
        return fail(e, -ENAMETOOLONG);
    strcpy(e->name, name);
    e->folder_fd = folder_open(path, (size_t)(name - path));
    if (e->folder_fd < 0)
        return fail(e, -errno);
    int result = part_open(e);
    return result == 0 ? 0 : fail(e, result);
}

int storage_export_write(storage_export *e, const void *bytes, size_t n)
{
    if (e->error != 0)
        return e->error;
    for (size_t put = 0; put < n;) {
        ssize_t took = write(e->fd, (const char *)bytes + put, n - put);
        if (took < 0 && errno == EINTR)
            continue;
        if (took <= 0)
            return fail(e, took < 0 ? -errno : -ENOSPC);
        put += (size_t)took;
    }
    return 0;
}

int storage_export_end(storage_export *e)
{
    if (e->error != 0)
        return e->error;
    /* Some media find out that they are full only now. */
    if (fsync(e->fd) != 0)
        return fail(e, -errno);
    if (renameat(e->folder_fd, e->part, e->folder_fd, e->name) != 0)
        return fail(e, -errno);
    int result = fsync(e->folder_fd) == 0 ? 0 : -errno;
    put_down(e);
    e->error = result;
    return result;
}

void storage_export_abandon(storage_export *e)
{
    if (e->fd >= 0)
        fail(e, -ECANCELED);
}
