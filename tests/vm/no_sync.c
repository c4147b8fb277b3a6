/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    In the guest, loaded before the C library: nothing is synced, and everybody is told it was. With it the test
 *          of power cuts must find losses, or it proves nothing.
 * Is not:  A fault: the program itself is the same.
 */
#include <fcntl.h>
#include <unistd.h>

int fsync(int fd)
{
    (void)fd;
    return 0;
}

int fdatasync(int fd)
{
    (void)fd;
    return 0;
}

int syncfs(int fd)
{
    (void)fd;
    return 0;
}

int sync_file_range(int fd, off64_t offset, off64_t bytes, unsigned flags)
{
    (void)fd, (void)offset, (void)bytes, (void)flags;
    return 0;
}

void sync(void) {}
