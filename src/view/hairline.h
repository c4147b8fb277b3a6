/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Thin lines, smooth on any device: drawn as rectangles on the screen. Either lines that stay on the device
 *          and are moved by a matrix, or lines made for one picture, each with a colour.
 * Is not:  What the lines show (marker.h, plumb.h); the sides of patches' triangles (upload_draw_lines), which the
 *          device draws as it can.
 * Shape:   a line is 40 bytes: from, into, colour with straight alpha. Lines of one picture are in eye space.
 * Units:   millimetres; width in pixels of a picture 1080 pixels high: others draw them as much wider or thinner, but
 *          one pixel at least.
 * Owner:   the caller owns the structs. The context must be current throughout. Blending, depth test and depth mask are
 *          the caller's to set.
 * Errors:  hairline_open false: the trouble holds the compiler's words.
 * Cost:    one call a draw; lines of one picture are sent anew: some kilobytes.
 */
#ifndef GLAISE_VIEW_HAIRLINE_H
#define GLAISE_VIEW_HAIRLINE_H

#include "view/projection.h"

#include <GLES3/gl31.h>

#include <string>
#include <vector>

struct hairline_line {
    glm::vec3 from, into;
    glm::vec4 colour{1}; /* of lines that stay it does not count: the picture gives one to all */
};

struct hairline {
    GLuint program = 0;
    GLint eye_from_lines = -1, eye_normal = -1, clip_from_eye = -1, viewport = -1, width = -1, away = -1, dash = -1;
    GLuint array = 0, kept = 0, fleeting = 0;
    GLsizei kept_count = 0;
};

struct hairline_look {
    float width = 1;
    float away = 1; /* part of the alpha where the line, on the unit sphere, turns from the viewer */
    bool dashed = false;
};

/* keep: lines that stay. */
[[nodiscard]] bool hairline_open(hairline *h, const std::vector<hairline_line> &keep, std::string *trouble_out);
void hairline_close(hairline *h); /* a fresh one is fine */

void hairline_draw_kept(const hairline &h, const snapshot &s, const projection &p, const glm::dmat4 &eye_from_lines,
                        const glm::vec4 &colour, const hairline_look &look);
void hairline_draw(const hairline &h, const snapshot &s, const projection &p, const std::vector<hairline_line> &lines,
                   const hairline_look &look);

/* Height in pixels of the whole picture, of which what is drawn now may be a part. */
double hairline_picture_height(const snapshot &s, const projection &p);

#endif
