/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Files of the piece that are being written while it is worked on: each shows it as it was when it was sent.
 * Is not:  The store (history's own files, store.h); what a file holds (exchange).
 * Shape:   outbox_send, as often as one likes; outbox_take answers those that are done, in the order they were sent.
 * Owner:   the caller owns the struct and empties it (outbox_take) before the piece is closed.
 * Errors:  a sentence with the path, when it is taken.
 * Cost:    sending freezes the piece (clay/freeze.h: some milliseconds). With CAPACITY_FROZEN files under way it waits
 *          for the first of them.
 */
#ifndef GLAISE_WIRING_OUTBOX_H
#define GLAISE_WIRING_OUTBOX_H

#include "exchange/exchange.h"
#include "station/errand.h"

#include <deque>
#include <memory>
#include <optional>
#include <string>

struct outbox_file {
    std::string path;
    std::string trouble; /* empty: it is written */
};

struct outbox_entry {
    outbox_file file;
    std::unique_ptr<still> moment; /* as long as it is written */
    errand *writing = nullptr;     /* likewise */
};

struct outbox {
    std::deque<outbox_entry> sent;
};

void outbox_send(outbox *o, sculpture *piece, const std::string &path);
/* Of the first that was sent: is it done (also when there is none), and how far is it, 0..1? */
bool outbox_is_done(const outbox *o);
double outbox_part(const outbox *o);
/* The first that was sent, if it is done. */
std::optional<outbox_file> outbox_take(outbox *o);

#endif
