/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    `glaise check`: says of a store what is wrong with it and what opening it would make of it; on demand writes
 *          what can be had of it as a new store beside it.
 * Is not:  The looking (history/check.h) or the recovery (history/recovery.h). The store itself is not changed.
 * Errors:  told on standard error as "glaise: what: why". The answer is the exit status: 0 nothing is wrong, 1
 *          something is (each on a line of its own), 2 what was given is no store.
 */
#ifndef GLAISE_WIRING_CHECK_STORE_H
#define GLAISE_WIRING_CHECK_STORE_H

#include "wiring/arguments.h"

/* a.input: the store; a.repair: the new one goes to "<store>.repaired". */
int check_store(const arguments &a);

#endif
