/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A picture of half the size that says of each point seen how open the sky is there and how the surface bends,
 *          and how deep it lies. The clay's shading reads it, and depth of field.
 * Is not:  How that is found (hollow_shader.h); what is drawn into the relief (view.cpp says).
 * Shape:   per picture: hollow_begin, whoever draws draws clay and turntable with the relief's programs, hollow_end.
 *
 *              relief RGBA16UI + depth  --hidden-->  RGBA8  --smoothed-->  RGBA8 (hollow.smoothed)
 *
 * Units:   pixels; millimetres.
 * Owner:   the caller owns the struct; a zeroed one is closed. The context must be current throughout.
 * Errors:  hollow_open and hollow_size false: the trouble says why; pictures then go without.
 * Cost:    geometry once more, at a quarter of the pixels; then per pixel of the quarter HOLLOW_TAPS + 5 fetches of 8
 *          bytes and 17 of 4. 18 bytes a pixel of the quarter on the device.
 */
#ifndef GLAISE_VIEW_HOLLOW_H
#define GLAISE_VIEW_HOLLOW_H

#include "view/projection.h"

#include <GLES3/gl31.h>

#include <string>

enum { HOLLOW_TAPS = 14, HOLLOW_TAPS_FEWER = 8 };
constexpr double HOLLOW_REACH = 0.075;  /* of the camera's distance */
constexpr double HOLLOW_WIDEST = 0.122; /* and no wider, of the whole picture's height: parts have such a margin */

struct hollow_buffer {
    GLuint texture = 0, framebuffer = 0;
};

struct hollow {
    GLuint hidden_program = 0, smoothed_program = 0;
    GLint depth_range = -1, clip = -1, reach = -1, taps = -1, origin = -1;
    int width = 0, height = 0; /* half the picture's, rounded up */
    hollow_buffer relief, hidden, smoothed;
    GLuint depth = 0, empty_array = 0;
};

[[nodiscard]] bool hollow_open(hollow *h, std::string *trouble_out);
void hollow_close(hollow *h);
/* For a picture of this size. */
[[nodiscard]] bool hollow_size(hollow *h, int picture_width, int picture_height, std::string *trouble_out);

/* widest_pixels: of the picture's. origin: of this part of the picture, from the whole's lower left corner, pixels. */
void hollow_begin(const hollow &h);
void hollow_end(const hollow &h, const projection &p, double reach_mm, double widest_pixels, int taps,
                const glm::vec2 &origin);

#endif
