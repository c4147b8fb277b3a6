/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The projection of a picture: near and far planes that just hold everything that is drawn in it.
 * Is not:  The matrices themselves (projection.h).
 * Units:   pixels, millimetres.
 */
#ifndef GLAISE_VIEW_SIGHT_H
#define GLAISE_VIEW_SIGHT_H

#include "view/projection.h"
#include "view/upload.h"

/* clay, tool: the patches that are held on the device. */
projection sight_of(const snapshot &s, const upload &patches, const upload &tool_patches, int width, int height);
/* A ball round the clay; a radius of 0 where there is none. */
projection_ball sight_of_clay(const snapshot &s, const upload &patches, const glm::dmat4 &eye_from_world);

#endif
