/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The ground behind the piece, drawn first, over every pixel.
 * Is not:  Its look (backdrop_shader.h); what surrounds the piece (scenery.h).
 * Shape:   where its program does not compile the ground is even.
 * Units:   pixels.
 * Owner:   the caller owns the struct; a zeroed one is closed. The context must be current throughout.
 * Errors:  backdrop_open false: the trouble holds the compiler's words.
 * Cost:    one triangle.
 */
#ifndef GLAISE_VIEW_BACKDROP_H
#define GLAISE_VIEW_BACKDROP_H

#include "view/projection.h"

#include <GLES3/gl31.h>

#include <string>

struct backdrop {
    GLuint program = 0, empty_array = 0;
    GLint aspect = -1, part = -1, look = -1, shift = -1;
};

/* What is drawn of it. */
struct backdrop_place {
    int width, height;       /* of the whole picture */
    double aspect;           /* of the whole as it looks when it is shown */
    projection_part part;
    double far_shift;        /* for an eye beside the middle (stereo.h) */
};

[[nodiscard]] bool backdrop_open(backdrop *b, std::string *trouble_out);
void backdrop_close(backdrop *b);
/* Leaves the depth test on. */
void backdrop_draw(const backdrop &b, snapshot_look look, const backdrop_place &at);

#endif
