/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    `glaise timelapse`: a store's history as pictures. It goes back to the oldest stroke that can be undone, takes
 *          a picture of what was before it, and one after each stroke on the way to where the piece stands.
 * Is not:  History itself (history/history.h); how the piece is shown (portrait.h); the taking (stage.h).
 * Shape:   the way goes over the branch on which the piece stands, and ends there: strokes that were undone are not part
 *          of it. The eye stands still, so that the finished piece fits. The store is opened under an overlay
 *          (station/overlay_store.h): not a byte of it changes.
 * Errors:  told on standard error as "glaise: what: why"; the answer is the program's exit status (arguments.h). A stroke
 *          that cannot be gone over (damage) is where the pictures begin. What was taken before a failure stays, whole.
 * Cost:    memory: the piece, and the records of the way back.
 */
#ifndef GLAISE_WIRING_TIMELAPSE_H
#define GLAISE_WIRING_TIMELAPSE_H

#include "wiring/arguments.h"

/* a.input: the store; a.pictures: the folder. config: the folder of the station's own settings. */
int timelapse(const arguments &a, const std::string &config);

#endif
