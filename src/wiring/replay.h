/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What the program does once it knows what was asked: replay a tape, run the station, export, inform.
 * Is not:  The command line (arguments.h).
 * Errors:  told on standard error as "glaise: what: why"; the answer is the program's exit status (arguments.h).
 */
#ifndef GLAISE_WIRING_REPLAY_H
#define GLAISE_WIRING_REPLAY_H

#include "wiring/arguments.h"

/* Replays a tape. Everything that can be found wrong is found before the first command is done. */
int replay_tape(const arguments &a);
/* The station. With no display it replays the demonstration that lies in `config`, into the folder a.pictures. */
int replay_demonstration(const arguments &a, const std::string &config);
int replay_export(const arguments &a);
int replay_info(const arguments &a);

#endif
