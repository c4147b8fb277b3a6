/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The environment that clay mirrors: a photographer's studio, computed, as a sphere map. Two soft boxes, a
 *          horizon, a floor.
 * Is not:  What stands behind the piece on the screen (backdrop_shader.h); how much of it is seen (clay_shader.h).
 * Shape:   a direction r of eye space (x right, y up, z towards the viewer) is found at
 *              m = 2 sqrt(rx^2 + ry^2 + (rz + 1)^2), s = rx/m + 1/2, t = ry/m + 1/2
 *          so the middle shows what is behind the viewer, the rim what is behind the piece. It turns with the viewer,
 *          not with the piece. Half floats, all mipmap levels.
 * Units:   linear light; soft boxes go beyond 1.
 * Owner:   the caller owns the texture.
 * Errors:  studio_open false: no memory on the device.
 * Cost:    some tens of milliseconds, once; 2.8 MB.
 * Source:  000 section 5 (sphere mapping).
 */
#ifndef GLAISE_VIEW_STUDIO_H
#define GLAISE_VIEW_STUDIO_H

#include <GLES3/gl31.h>

#include <array>
#include <string>

enum { STUDIO_SIDE = 512 };

[[nodiscard]] bool studio_open(GLuint *texture_out, std::string *trouble_out);

/* The light that comes from a unit direction. */
std::array<double, 3> studio_light(const std::array<double, 3> &direction);
/* Where the map has a unit direction (anywhere on the rim for (0, 0, -1)), and the direction at a place inside the unit
   circle. Both in 0..1. */
std::array<double, 2> studio_place(const std::array<double, 3> &direction);
std::array<double, 3> studio_direction(const std::array<double, 2> &place);

#endif
