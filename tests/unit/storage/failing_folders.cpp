/* SPDX-License-Identifier: Apache-2.0 */
#include "tests/unit/storage/failing_folders.h"

#include <cerrno>
#include <cstdio>
#include <sys/statfs.h>
#include <sys/statvfs.h>
#include <sys/syscall.h>
#include <unistd.h>

failing_folders_state failing_folders = {};

namespace {

int fail(int error)
{
    errno = error;
    return -1;
}

} // namespace

extern "C" int renameat(int from_fd, const char *from, int to_fd, const char *to) noexcept
{
    if (failing_folders.rename_error)
        return fail(failing_folders.rename_error);
    return static_cast<int>(syscall(SYS_renameat2, from_fd, from, to_fd, to, 0));
}

extern "C" int unlinkat(int fd, const char *name, int flags) noexcept
{
    if (failing_folders.remove_error && ++failing_folders.removals >= failing_folders.removals_from)
        return fail(failing_folders.remove_error);
    return static_cast<int>(syscall(SYS_unlinkat, fd, name, flags));
}

extern "C" int fstatvfs64(int fd, struct statvfs64 *is) noexcept
{
    if (failing_folders.measure_error)
        return fail(failing_folders.measure_error);
    struct statfs64 plain;
    if (fstatfs64(fd, &plain) != 0)
        return -1;
    *is = {};
    is->f_frsize = static_cast<unsigned long>(plain.f_frsize);
    is->f_bsize = static_cast<unsigned long>(plain.f_bsize);
    is->f_blocks = plain.f_blocks;
    is->f_bfree = plain.f_bfree;
    is->f_bavail = plain.f_bavail;
    return 0;
}
