/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What the shelf needs of the medium: folders side by side, with files in them. Real folders implement it
 *          (platform/storage, joined in wiring), so do the tests' failing ones.
 * Is not:  The shelf (shelf.h); the files of one piece while it is open (history/byte_store.h).
 * Shape:   names as those of a byte store: 1 to 63 of [a-z0-9._-], not "." or "..".
 * Owner:   whoever filled it in; it outlives all who have a copy. Different folders may be asked about from different
 *          threads at a time.
 * Errors:  every call answers a sentence for the person, empty when it did what it says. A call that failed may have
 *          done its work, or `remove` a part of it.
 * Cost:    any of them may take long.
 */
#ifndef GLAISE_STATION_SHELF_PORT_H
#define GLAISE_STATION_SHELF_PORT_H

#include "sculpture/sculpture.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

struct shelf_port {
    /* Names of folders, in any order. */
    std::function<std::string(std::vector<std::string> *names_out)> list;
    /* Up to `most` bytes of a file; nothing when it is absent. */
    std::function<std::string(const std::string &folder, const std::string &file, size_t most,
                              std::optional<std::string> *bytes_out)>
        read;
    /* The file is the old one or the new one, whole, and the new one on the medium when this was answered "". */
    std::function<std::string(const std::string &folder, const std::string &file, const std::string &bytes)> replace;
    /* Makes the folder when absent. Nobody else can open, rename or remove it until it is closed. */
    std::function<std::string(const std::string &folder, byte_store *store_out)> open;
    std::function<void(const byte_store &store)> close;
    /* Atomic, and on the medium when answered "". Refused while the folder is open. */
    std::function<std::string(const std::string &from, const std::string &to)> rename;
    /* The folder and the files in it. Absent: "". A cut may bring back what was removed. */
    std::function<std::string(const std::string &folder)> remove;
    /* What the folder takes; what is free on the medium. */
    std::function<std::string(const std::string &folder, uint64_t *bytes_out)> bytes;
    std::function<std::string(uint64_t *bytes_out)> free;
};

#endif
