/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The piece as the first lamp sees it: a map of depths, from which the shading knows what stands in the way.
 * Is not:  The lookup (lighting_shader.h); who is drawn into it (view.cpp).
 * Shape:   the lamp's eye space looks at the middle of the ball that is to throw shadows; its frustum just holds the
 *          ball. A lamp inside the ball's surroundings (nearer than SHADOW_NEAREST radii) is moved out along its own
 *          direction, one far away is a perspective as narrow as it takes.
 *
 *              eye --lamp_from_eye--> lamp's clip space --(+1)/2--> map
 *
 *          Depth 24 bit, SHADOW_SIDE a side; compared by the sampler, and read bare through a sampler object.
 * Units:   millimetres.
 * Owner:   the caller owns the struct; a zeroed one is closed. The context must be current throughout.
 * Errors:  shadow_open false: no memory, the trouble says so; pictures then go without.
 * Cost:    the piece's geometry once more, only when it, the lamp or the eye's place round it changed; 16 MB.
 * Source:  Williams 1978.
 */
#ifndef GLAISE_VIEW_SHADOW_H
#define GLAISE_VIEW_SHADOW_H

#include "view/projection.h"

#include <GLES3/gl31.h>

#include <string>

enum { SHADOW_SIDE = 2048, SHADOW_TAPS = 10, SHADOW_TAPS_FEWER = 4 };
constexpr double SHADOW_NEAREST = 1.6;     /* of the ball's radius, from its middle */
constexpr double SHADOW_LAMP_WIDTH = 0.11; /* half a lamp's width, of its distance */

struct shadow {
    GLuint texture = 0, framebuffer = 0;
    GLuint bare = 0; /* sampler object: without comparison */
    uint64_t generation = 0; /* of the surface in it */
    glm::dmat4 drawn{0};     /* clip_from_world that it was drawn with */
};

/* What the lamp sees. */
struct shadow_sight {
    projection from_lamp;        /* eye_from_world is the lamp's */
    glm::dmat4 lamp_from_eye{1}; /* clip space of the lamp */
    double texel_mm = 0;         /* at 1 mm from the lamp */
    double lamp_half_width = 0;  /* mm */
};

[[nodiscard]] bool shadow_open(shadow *s, std::string *trouble_out);
void shadow_close(shadow *s);

/* ball: in the world's eye space; lamp likewise. */
shadow_sight shadow_look(const projection &p, const projection_ball &ball, const glm::dvec3 &lamp_eye);
/* Whether it must be drawn anew. */
bool shadow_is_stale(const shadow &s, const shadow_sight &sight, uint64_t generation);
/* Between these the piece's triangles are drawn, by a program that writes depth. */
void shadow_begin(const shadow &s);
void shadow_end(shadow *s, const shadow_sight &sight, uint64_t generation);

#endif
