/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A byte store in memory, for replays that keep nothing: undo works there as it does on disk.
 * Is not:  Durable; bounded by anything but the ring of undo-files.
 * Owner:   the caller; the port refers to the scratch_store, which must outlive it.
 * Errors:  none but absence, which is a state.
 */
#ifndef GLAISE_WIRING_SCRATCH_STORE_H
#define GLAISE_WIRING_SCRATCH_STORE_H

#include "history/byte_store.h"

#include <map>
#include <string>

struct scratch_store {
    std::map<std::string, std::string> files;
};

byte_store scratch_store_port(scratch_store *s);

#endif
