/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Draws the strip at the bottom, the toast above it, the card that says how to begin, and where there is no
 *          strip the dot that says whether all is kept.
 * Is not:  Their words (station/strip.h).
 * Shape:   what there is no room for is left out, the last of this list first: kept, pedals, action, mode, size, rate,
 *          strokes. What is left is made smaller until it fits.
 *
 *              * kept  (puck) tool   |  \ apply  \ undo  \ clutch  |  (o) toothpaste  10 mm  8/s   12 strokes
 *
 * Units:   pixels.
 */
#ifndef GLAISE_VIEW_OVERLAY_STRIP_H
#define GLAISE_VIEW_OVERLAY_STRIP_H

#include "station/snapshot.h"
#include "view/overlay_pen.h"

/* A menu changes what pedals do: while one is open the strip is there, whatever was asked for. */
bool overlay_strip_is_shown(const snapshot &s);
/* How much it takes of the picture's height. */
float overlay_strip_height(const overlay_pen &p, const snapshot &s);
void overlay_strip_draw(const overlay_pen &p, const snapshot &s);

#endif
