/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    In the guest: takes what `glaise replay --kept` says and writes each "kept" line to a place on the disk that
 *          no file system uses, so that the log of the disk's writes says what had been promised at each instant.
 * Is not:  A record that lasts: nothing here is synced.
 * Shape:   promise DEVICE OFFSET: one block of 4 KiB at OFFSET, the line and zeros; past the kernel's cache, and before
 *          whoever spoke goes on: it runs ahead of all others.
 * Errors:  exit status 1. Lines of another kind are passed on.
 */
#include <fcntl.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { BLOCK_BYTES = 4096 };

static _Alignas(BLOCK_BYTES) char block[BLOCK_BYTES];

int main(int count, char **words)
{
    const struct sched_param first = {.sched_priority = 1};
    if (count != 3 || sched_setscheduler(0, SCHED_FIFO, &first) != 0)
        return 1;
    const off_t offset = (off_t)strtoull(words[2], NULL, 10);
    const int fd = open(words[1], O_WRONLY | O_DIRECT | O_CLOEXEC);
    if (fd < 0)
        return 1;
    char line[256];
    while (fgets(line, sizeof line, stdin)) {
        if (strncmp(line, "kept ", 5) != 0) {
            fputs(line, stdout);
            continue;
        }
        memset(block, 0, sizeof block);
        memcpy(block, line, strlen(line));
        if (pwrite(fd, block, sizeof block, offset) != sizeof block)
            return 1;
    }
    return close(fd) != 0;
}
