/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Opening a piece off the frame path: reading it and making its surface takes seconds when it is large.
 * Is not:  The opening itself (sculpture_open).
 * Shape:   opening_begin -> opening_part, opening_is_done -> opening_end. Until then the piece is the opening's.
 * Owner:   the caller owns piece and port, which outlive the opening.
 * Errors:  those of sculpture_open.
 */
#ifndef GLAISE_STATION_OPENING_H
#define GLAISE_STATION_OPENING_H

#include "sculpture/sculpture.h"

#include <functional>

struct opening;

opening *opening_begin(sculpture *piece, const byte_store &port, const history_settings &settings, double step_mm);
/* 0..1: bytes read, of those that the sculpture's file has. */
double opening_part(const opening *o);
bool opening_is_done(const opening *o);
[[nodiscard]] status opening_end(opening *o, history_finding *finding_out);

/* The same in the caller's thread, for those who are an errand already; `told` hears the part. */
[[nodiscard]] status opening_here(sculpture *piece, const byte_store &port, const history_settings &settings,
                                  double step_mm, const std::function<void(double)> &told,
                                  history_finding *finding_out);

#endif
