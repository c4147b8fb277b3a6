/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Real files joined to the engine's ports: a folder as history's byte store, a file as a checkpoint's
 *          source, and an export that appears whole or not at all.
 * Is not:  The files themselves (platform/storage); formats (exchange).
 * Owner:   store_close gives a store back; sources and exports last for one call.
 * Errors:  a sentence with the path; the port's own calls answer STATUS_IO.
 */
#ifndef GLAISE_WIRING_STORE_H
#define GLAISE_WIRING_STORE_H

#include "exchange/exchange.h"
#include "history/byte_store.h"

#include <functional>
#include <string>

struct store; /* an open folder */

/* Makes the folder when absent; one program at a time may have it. */
store *store_open(const std::string &folder, byte_store *port_out, std::string *text_out);
void store_close(store *s); /* NULL is fine */

/* Writes path through `write`, which is given a sink. Nothing is left behind when it fails. */
[[nodiscard]] bool store_export(const std::string &path, const std::function<status(checkpoint_sink, void *)> &write,
                                std::string *text_out);
/* Reads path through `read`, which is given a source. */
[[nodiscard]] bool store_import(const std::string &path, const std::function<bool(checkpoint_source, void *)> &read,
                                std::string *text_out);

#endif
