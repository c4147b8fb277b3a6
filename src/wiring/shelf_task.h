/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What `glaise shelf` does, and a replay on a piece that lies on a shelf.
 * Is not:  The shelf (station/shelf.h); the replay (replay.h).
 * Errors:  told on standard error as "glaise: what: why"; the answer is the program's exit status (arguments.h). What
 *          the shelf refuses because of what was asked (a name, a number, a state) is ARGUMENTS_EXIT_WRONG where that
 *          can be told beforehand, else ARGUMENTS_EXIT_TROUBLE.
 */
#ifndef GLAISE_WIRING_SHELF_TASK_H
#define GLAISE_WIRING_SHELF_TASK_H

#include "wiring/arguments.h"

int shelf_task(const arguments &a);
/* The shelf is this program's as long as the replay takes. */
int shelf_task_replay(const arguments &a);

#endif
