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

/* patches: those that are held on the device; cubes_bricks: bricks of what is drawn in place of the clay, or empty. */
projection sight_of(const snapshot &s, const upload &patches, const upload &tool_patches, const box &cubes_bricks,
                    int width, int height);
/* A ball round bricks; a radius of 0 where there are none. */
projection_ball sight_of_bricks(const snapshot &s, const box &b, const glm::dmat4 &eye_from_world);

#endif
