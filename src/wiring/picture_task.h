/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    `glaise picture`: a sculpture file as a picture, or as the pictures of one turn.
 * Is not:  How it is shown (portrait.h); the taking (stage.h, sequence.h); a piece's history (timelapse.h).
 * Errors:  told on standard error as "glaise: what: why"; the answer is the program's exit status (arguments.h). A
 *          scenery that cannot be read costs the scenery, and the status is ARGUMENTS_EXIT_TROUBLE.
 */
#ifndef GLAISE_WIRING_PICTURE_TASK_H
#define GLAISE_WIRING_PICTURE_TASK_H

#include "wiring/arguments.h"

/* config: the folder of the station's own settings. */
int picture_task(const arguments &a, const std::string &config);

#endif
