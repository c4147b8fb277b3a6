/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What surrounds the piece, lights it and is mirrored in it: four rooms of our own, computed, and any picture
 *          that somebody brings. Made ready for the shaders as a sphere map with levels of roughness, and as nine
 *          coefficients of the light that falls on matt clay.
 * Is not:  What stands behind the piece on the screen (backdrop_shader.h); how the light is used (lighting_shader.h).
 * Shape:   a direction r of eye space (x right, y up, z towards the viewer) is found in the map at
 *              m = 2 sqrt(rx^2 + ry^2 + (rz + 1)^2), s = rx/m + 1/2, t = ry/m + 1/2
 *          so the middle shows what is behind the viewer, the rim what is behind the piece. It turns with the viewer,
 *          not with the piece. Half floats.
 *
 *              mirror           SCENERY_SIDE pixels a side, with the usual mipmaps: what a mirror shows
 *              rough            level n: as a surface of roughness n / SCENERY_ROUGHEST shows it, half the side of
 *                               the one before, the first half the mirror's
 *              irradiance       spherical harmonics to the second order, already convolved with the cosine and divided
 *                               by pi: light on a normal n is the sum over irradiance[i] Y_i(n)
 *
 *          A picture that is about twice as wide as high is taken for a panorama (longitude, latitude), any other for a
 *          photograph of a mirror ball that fills it. Its bytes end at white: what is nearly white is taken for a lamp
 *          and made brighter.
 * Units:   linear light; lamps go beyond 1.
 * Owner:   the caller owns the textures and the picture.
 * Errors:  scenery_open false: no memory on the device.
 * Cost:    some tenths of a second, once for each scenery that is looked at; 5.6 MB.
 * Source:  000 section 5 (sphere mapping). Ramamoorthi and Hanrahan 2001 for the nine coefficients. Walter et al. 2007
 *          for the lobe (GGX).
 */
#ifndef GLAISE_VIEW_SCENERY_H
#define GLAISE_VIEW_SCENERY_H

#include "station/snapshot.h"

#include <GLES3/gl31.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

enum { SCENERY_SIDE = 512, SCENERY_ROUGHEST = 6, SCENERY_COEFFICIENTS = 9 };

using scenery_vector = std::array<double, 3>;

struct scenery_picture {
    int width = 0, height = 0; /* 0: none */
    std::vector<uint8_t> rgba; /* sRGB, top row first */
};

struct scenery {
    GLuint mirror = 0, rough = 0; /* textures */
    std::array<std::array<float, 3>, SCENERY_COEFFICIENTS> irradiance{};
};

/* SNAPSHOT_SCENERY_OWN without a picture is the studio. */
[[nodiscard]] bool scenery_open(scenery *s, snapshot_scenery which, const scenery_picture &own,
                                std::string *trouble_out);
void scenery_close(scenery *s);

/* The light that comes from a unit direction. */
scenery_vector scenery_light(snapshot_scenery which, const scenery_vector &direction);
scenery_vector scenery_light_own(const scenery_picture &own, const scenery_vector &direction);
/* Coefficients of any light. */
std::array<std::array<float, 3>, SCENERY_COEFFICIENTS>
scenery_irradiance(const std::function<scenery_vector(const scenery_vector &)> &light);

/* Where the map has a unit direction (anywhere on the rim for (0, 0, -1)), and the direction at a place inside the unit
   circle. Both in 0..1. */
std::array<double, 2> scenery_place(const scenery_vector &direction);
scenery_vector scenery_direction(const std::array<double, 2> &place);

#endif
