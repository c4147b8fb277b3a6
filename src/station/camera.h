/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Where the eye stands when nobody leads it: so far off that the whole piece is seen, and the piece turned
 *          before it as on a turntable.
 * Is not:  How a person leads it (showing.h, station.h); the drawing (view).
 * Shape:   the piece is known by boxes, one for each of its patches. The eye keeps its direction and its lens and looks
 *          at the piece's middle; its distance is the least at which every box is in the picture, and CAMERA_AIR of the
 *          half picture is left on every side. The axis of the turntable is vertical in the world (y).
 * Units:   millimetres in world space, radians.
 * Owner:   values.
 * Errors:  none: a piece without a surface leaves the snapshot as it is.
 * Cost:    camera_boxes_of: every vertex once. Fitting: by box.
 */
#ifndef GLAISE_STATION_CAMERA_H
#define GLAISE_STATION_CAMERA_H

#include "station/motion.h"
#include "station/snapshot.h"

#include <vector>

constexpr double CAMERA_AIR = 0.08;

struct camera_box {
    motion_vector lo, hi;
};

using camera_boxes = std::vector<camera_box>;

camera_boxes camera_boxes_of(const sculpture *piece);
/* The middle of the box round them all; the origin where there are none. */
motion_vector camera_middle(const camera_boxes &boxes);

/* aspect: the picture's width over its height. */
void camera_fit(snapshot *s, const camera_boxes &boxes, double aspect);
/* The same for every picture of a turn about the piece's middle. */
void camera_fit_turning(snapshot *s, const camera_boxes &boxes, double aspect);

/* The world point that the eye looks at. */
motion_vector camera_looked_at(const snapshot &s);
/* The piece, and all that stands in the world with it, turned about the vertical through `at`; anticlockwise as seen
   from above. What is with the viewer stays. */
snapshot camera_turned(snapshot s, const motion_vector &at, double radians);

#endif
