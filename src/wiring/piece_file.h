/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A native sculpture file as a piece: for tasks that look at one and keep nothing.
 * Is not:  The format (exchange/exchange.h); opening a store (store.h, station/opening.h).
 * Owner:   the caller closes the piece that was opened.
 * Errors:  told on standard error as "glaise: file: why"; the answer is the program's exit status (arguments.h), 0 when
 *          the piece is open.
 */
#ifndef GLAISE_WIRING_PIECE_FILE_H
#define GLAISE_WIRING_PIECE_FILE_H

#include "exchange/exchange.h"

#include <string>

/* Opens a piece without history and fills it. */
[[nodiscard]] int piece_file_open(sculpture *piece, const std::string &path);

#endif
