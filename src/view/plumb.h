/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Where the tool is above the floor: a line down from it, banded every ten millimetres, and on the floor the
 *          tool's outline from above, a soft shadow in it, and a cross with arms of ten millimetres.
 * Is not:  The tool (marker.h); the turntable (wheel.h). It stands in for what a second eye would tell: depth
 *          and size.
 * Shape:
 *              |  bands of 10 mm, light and faint
 *           .--+--.   the outline of the tool's limit of influence, projected straight down
 *           '--+--'
 *
 *          The floor is y = snapshot.box_lo[1]. Nothing is drawn where neither turntable nor box is shown, where the
 *          tool is hidden, or at or under the floor. A freeform's outline is that of a ball stretched to its surface's
 *          box.
 * Units:   millimetres, world space.
 * Owner:   nothing is kept but the device's; see hairline.h.
 * Cost:    a hundred lines, one call; a look at a freeform's patches.
 */
#ifndef GLAISE_VIEW_PLUMB_H
#define GLAISE_VIEW_PLUMB_H

#include "view/hairline.h"

#include <vector>

constexpr double PLUMB_BAND_MM = 10;

/* Where the tool stands over the floor; reach: of the outline, from the foot along two level directions. */
struct plumb {
    glm::dvec3 from, foot;
    glm::dvec3 reach[2];
};

/* false: nothing is to be drawn. */
bool plumb_of(const snapshot &s, plumb *out);
/* Holds line and outline, for the planes of the projection. */
projection_ball plumb_ball(const plumb &l, const glm::dmat4 &eye_from_world);
/* In eye space. */
std::vector<hairline_line> plumb_lines(const plumb &l, const glm::dmat4 &eye_from_world, const glm::vec3 &colour);

#endif
