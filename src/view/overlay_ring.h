/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Draws the menu that is open: a ring of sectors, a number's gauge, a colour's wheel, or the card that waits.
 * Is not:  Operating it (station/menu.h); what the pedals do in it: the strip says that (overlay_strip.h).
 * Shape:   a ring stands in the middle, the label large inside it. What is changed while one looks at the piece keeps
 *          to the left:
 *
 *              +-------------------+   +-------------------+
 *              |       7 0 1       |   |  .-.              |
 *              |      6 tool 2     |   | ( 12 )   piece    |
 *              |       5 4 3       |   |  `-'              |
 *              +-------------------+   +-------------------+
 *
 * Units:   pixels.
 */
#ifndef GLAISE_VIEW_OVERLAY_RING_H
#define GLAISE_VIEW_OVERLAY_RING_H

#include "station/snapshot.h"
#include "view/overlay_pen.h"

/* bottom: how much the strip takes of the height. */
void overlay_ring_draw(const overlay_pen &p, const snapshot_menu &m, float bottom);

#endif
