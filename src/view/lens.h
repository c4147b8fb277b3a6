/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Depth of field: a finished picture, its depths, and which distance is sharp; the picture as a lens sees it.
 * Is not:  The depths (hollow.h has them).
 * Units:   pixels, millimetres.
 * Owner:   the caller owns the struct; a zeroed one is closed. The context must be current throughout.
 * Errors:  lens_open false: the trouble holds the compiler's words; pictures then go without.
 * Cost:    33 fetches of 4 bytes a pixel, as many of depth.
 * Source:  000 section 5 names it as future work.
 */
#ifndef GLAISE_VIEW_LENS_H
#define GLAISE_VIEW_LENS_H

#include "view/projection.h"

#include <GLES3/gl31.h>

#include <string>

/* What is infinitely far is spread so wide by a lens that is all open, and nothing wider than the limit: parts of the
   picture's height. */
constexpr double LENS_WIDEST = 0.11, LENS_LIMIT = 0.014;

struct lens {
    GLuint program = 0, empty_array = 0;
    GLint depth_range = -1, at = -1, origin = -1;
};

[[nodiscard]] bool lens_open(lens *l, std::string *trouble_out);
void lens_close(lens *l);
/* Into the framebuffer that is bound. sharp, hollow: textures. height: of the whole picture; origin: of this part, from
   the whole's lower left corner; pixels. */
void lens_draw(const lens &l, GLuint sharp, GLuint hollow, const projection &p, double focus_mm, double blur,
               int height, const glm::vec2 &origin);

#endif
