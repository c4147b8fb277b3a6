/* SPDX-License-Identifier: Apache-2.0 */
#include "tests/unit/storage/failing_system.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

failing_system_state failing_system = {SIZE_MAX, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};

void failing_system_reset() { failing_system = {SIZE_MAX, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}; }

namespace {

bool is_regular(int fd)
{
    struct stat is;
    return fstat(fd, &is) == 0 && S_ISREG(is.st_mode);
}

bool interrupted()
{
    failing_system_state &f = failing_system;
    f.reads_and_writes++;
    if (f.interrupt_every == 0 || f.reads_and_writes % f.interrupt_every != 0)
        return false;
    errno = EINTR;
    return true;
}

/* How much of n a write may take; 0 with errno set when it may not. */
size_t allowed(size_t n)
{
    failing_system_state &f = failing_system;
    n = std::min(n, f.at_most);
    if (f.write_error == 0)
        return n;
    n = std::min(n, f.write_bytes_left);
    f.write_bytes_left -= n;
    if (n == 0)
        errno = f.write_error;
    return n;
}

int sync_of(int fd, long call)
{
    failing_system_state &f = failing_system;
    const bool file = is_regular(fd);
    (file ? f.file_syncs : f.folder_syncs)++;
    const int error = file ? f.sync_error : f.folder_sync_error;
    if (error != 0) {
        errno = error;
        return -1;
    }
    return static_cast<int>(syscall(call, fd));
}

} // namespace

/* On this platform's 64-bit file offsets both names lead to the same call. */
extern "C" ssize_t pwrite64(int fd, const void *bytes, size_t n, off64_t offset)
{
    if (interrupted())
        return -1;
    n = allowed(n);
    return n == 0 ? -1 : syscall(SYS_pwrite64, fd, bytes, n, offset);
}

extern "C" ssize_t pread64(int fd, void *bytes, size_t n, off64_t offset)
{
    if (interrupted())
        return -1;
    return syscall(SYS_pread64, fd, bytes, std::min(n, failing_system.at_most), offset);
}

/* The test's own output goes through here as well. */
extern "C" ssize_t write(int fd, const void *bytes, size_t n)
{
    if (is_regular(fd)) {
        if (interrupted())
            return -1;
        n = allowed(n);
        if (n == 0)
            return -1;
    }
    return syscall(SYS_write, fd, bytes, n);
}

extern "C" int fsync(int fd) { return sync_of(fd, SYS_fsync); }
extern "C" int fdatasync(int fd) { return sync_of(fd, SYS_fdatasync); }

extern "C" int sync_file_range(int fd, off64_t offset, off64_t bytes, unsigned flags)
{
    errno = failing_system.settle_error;
    return errno != 0 ? -1 : static_cast<int>(syscall(SYS_sync_file_range, fd, offset, bytes, flags));
}

extern "C" int posix_fadvise64(int fd, off64_t offset, off64_t bytes, int advice)
{
    failing_system.drops += advice == POSIX_FADV_DONTNEED && offset == 0 && bytes == 0 && is_regular(fd);
    return 0;
}
