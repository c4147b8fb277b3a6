/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Opening a store that the last start did not come to the end of: first in a process of its own, which may
 *          crash. What crashed it is set aside, and it is tried again, until one comes to its end.
 * Is not:  Recovery (history/recovery.h), which reads the bytes and is meant to crash on none of them: this is for the
 *          day when it does all the same, and the station would start and crash, start and crash.
 * Shape:   rehearsal_begin -> opening -> rehearsal_end. In between the store holds the file REHEARSAL_MARK; that it
 *          is there at the beginning shows that the last opening did not end. A power cut, or a kill, leaves it too:
 *          then the rehearsal comes to its end, and nothing is set aside.
 *          The rehearsing process sees the store through an overlay: nothing in it is changed. What it read last, a
 *          file of the store, is what crashed it.
 * Owner:   nothing is kept.
 * Errors:  none: where the mark cannot be written, or no process can be made, the opening goes on without.
 * Cost:    two small writes; after an opening that did not end, an opening more, and its memory.
 */
#ifndef GLAISE_STATION_REHEARSAL_H
#define GLAISE_STATION_REHEARSAL_H

#include "sculpture/sculpture.h"

#include <functional>

inline constexpr char REHEARSAL_MARK[] = "opening";

/* What opening does with a store; it is called in another process, with a port of its own. */
using rehearsal_opening = std::function<void(const byte_store &port)>;

/* finding_out says what was set aside, and is empty when nothing was. */
void rehearsal_begin(const byte_store &port, const rehearsal_opening &open, history_finding *finding_out);
void rehearsal_end(const byte_store &port);

#endif
