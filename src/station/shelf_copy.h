/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What a duplicate is filled with: all files of a piece that is not open, or the clay of one that is, as it
 *          was at one moment.
 * Is not:  The making of the new piece, which decides when it is one (shelf.h).
 * Shape:   `from` and `to` are folders, `store` is that of `to`, open. Everything is synced at the end. Not copied are
 *          "about", which the new piece has of its own, the reserve (history/reserve.h), which is only space, and names
 *          that begin with a dot: what a cut left of a writing.
 * Owner:   the still is the caller's, and only lent.
 * Errors:  a sentence with the file, empty when it is done; `to` then holds a part.
 * Cost:    every byte read and written.
 */
#ifndef GLAISE_STATION_SHELF_COPY_H
#define GLAISE_STATION_SHELF_COPY_H

#include "sculpture/still.h"
#include "station/shelf_port.h"

using shelf_copy_told = std::function<void(double)>; /* 0..1; may be empty */

/* `bytes`: what the folder takes, for `told`. */
[[nodiscard]] std::string shelf_copy_files(const shelf_port &port, const std::string &from, uint64_t bytes,
                                           const std::string &to, const byte_store &store,
                                           const shelf_copy_told &told);
/* The thumbnail goes along; without one it is a good copy, too. */
[[nodiscard]] std::string shelf_copy_moment(const shelf_port &port, const std::string &from, still *moment,
                                            const std::string &to, const byte_store &store,
                                            const shelf_copy_told &told);
/* More than the file of this moment takes. */
uint64_t shelf_copy_bytes(const still &moment);

#endif
