/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A byte store laid over another one: reads go through, what is written stays in memory. With it a store can
 *          be opened, and seen what becomes of it, without a byte of it being changed.
 * Is not:  Durable; for sculpting on (every file that is written to is held whole).
 * Owner:   the caller owns both stores; the port refers to the overlay_store, which must outlive it.
 * Errors:  those of the store beneath.
 */
#ifndef GLAISE_STATION_OVERLAY_STORE_H
#define GLAISE_STATION_OVERLAY_STORE_H

#include "sculpture/sculpture.h"

#include <map>
#include <set>
#include <string>

/* What a name stands for, where it is not the file of that name beneath. */
struct overlay_store_file {
    std::string beneath;       /* a file there; empty: `bytes`, or nothing */
    bool is_there = false;
    std::string bytes;
};

struct overlay_store {
    byte_store under{};
    std::map<std::string, overlay_store_file> files;
};

byte_store overlay_store_port(overlay_store *s);
/* Writes every file but those set aside, and those named, into another store, and syncs it. */
[[nodiscard]] status overlay_store_copy(overlay_store *s, const std::set<std::string> &without, const byte_store &to);

#endif
