/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Calls about names and folders that fail on demand, for the whole test program: renameat, unlinkat, fstatvfs.
 * Is not:  Writes and syncs (failing_system.h).
 * Shape:   an error of 0: the call does its work. Else it fails with that error, from the call of number `from` on.
 * Owner:   the test sets it back.
 */
#ifndef GLAISE_UNIT_STORAGE_FAILING_FOLDERS_H
#define GLAISE_UNIT_STORAGE_FAILING_FOLDERS_H

struct failing_folders_state {
    int rename_error, remove_error, measure_error;
    int removals, removals_from; /* those before are done */
};

extern failing_folders_state failing_folders;

#endif
