/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    System calls of this test program that can be told to fail: pwrite, write, pread, fsync, fdatasync, sync_file_range. They
 *          stand before the system library's own when the program is linked.
 * Is not:  A disk: what succeeds really happens.
 * Owner:   failing_system is the one state; failing_system_reset() before and after each test.
 */
#ifndef GLAISE_UNIT_STORAGE_FAILING_SYSTEM_H
#define GLAISE_UNIT_STORAGE_FAILING_SYSTEM_H

#include <cstddef>

struct failing_system_state {
    size_t at_most;       /* bytes that one read or write takes */
    int interrupt_every;  /* every n-th read or write answers EINTR; 0: none */
    int write_error;      /* errno of every write, once write_bytes_left is used up; 0: none */
    size_t write_bytes_left;
    int sync_error;       /* errno of fdatasync, and of fsync on a file */
    int folder_sync_error; /* errno of fsync on a folder */
    int reads_and_writes, file_syncs, folder_syncs;
    int settle_error; /* errno of sync_file_range */
    int drops;        /* of what the machine holds of a file: posix_fadvise */
};

extern failing_system_state failing_system;
void failing_system_reset();

#endif
