/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Small pictures that say what a sector does where words would take longer.
 * Is not:  Where they stand (overlay_ring.h, overlay_strip.h).
 * Units:   pixels; `size` is the side of the square that one fills, about `at`.
 */
#ifndef GLAISE_VIEW_OVERLAY_ICON_H
#define GLAISE_VIEW_OVERLAY_ICON_H

#include "station/snapshot.h"
#include "view/overlay_pen.h"

void overlay_icon_draw(const overlay_pen &p, snapshot_menu_icon icon, ImVec2 at, float size, ImU32 colour,
                       ImU32 swatch);
/* A pedal from the side, up or pressed. */
void overlay_icon_pedal(const overlay_pen &p, ImVec2 at, float size, ImU32 colour, bool down);

#endif
