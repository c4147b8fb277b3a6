/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Where a picture is drawn: a multisampled framebuffer of its own, resolved into a texture that can be read
 *          back or shown.
 * Is not:  What is drawn (view.h); a screen or window (platform/display); a picture file (exchange/picture.h).
 * Shape:
 *              colour SRGB8_ALPHA8, N samples  --resolve-->  texture SRGB8_ALPHA8
 *              depth 24 bit, N samples             (dropped)
 *
 *          N is CANVAS_SAMPLES or what the machine has. Shaders write linear light; OpenGL encodes on the way in, so
 *          that blending and resolving happen in linear light. The texture's bytes are sRGB.
 * Units:   pixels.
 * Owner:   the caller owns the struct; a zeroed one is closed. The context must be current throughout.
 * Errors:  canvas_size false: a side out of range or no memory on the device; the canvas is then empty, the trouble
 *          says which. canvas_read false: nothing was resolved yet, or the device refused.
 * Cost:    canvas_size does nothing when the size is what it was.
 * Source:  000 section 5 (multisampling) and figure 13.
 */
#ifndef GLAISE_VIEW_CANVAS_H
#define GLAISE_VIEW_CANVAS_H

#include <GLES3/gl31.h>

#include <cstdint>
#include <string>
#include <vector>

enum {
    CANVAS_SAMPLES = 4,
    CANVAS_SIDE_MAX = 8192, /* or the machine's own limit, where that is smaller */
};
/* 8K UHD: with 4 samples of 8 bytes that is 1 GiB on the device. */
constexpr int64_t CANVAS_PIXELS_MAX = int64_t{7680} * 4320;

struct canvas {
    int width = 0, height = 0;
    int samples = 0;
    bool resolved = false; /* the texture holds a picture of this size */
    GLuint colour = 0, depth = 0, framebuffer = 0;
    GLuint texture = 0, resolve_framebuffer = 0;
};

[[nodiscard]] bool canvas_size(canvas *c, int width, int height, std::string *trouble_out);
void canvas_close(canvas *c);

/* Between these two everything is drawn into the canvas. begin clears depth, not colour. */
void canvas_begin(canvas *c);
void canvas_end(canvas *c);

/* width x height x RGBA8, top row first, encoded as sRGB. */
[[nodiscard]] bool canvas_read(const canvas *c, std::vector<uint8_t> *rgba_out, std::string *trouble_out);

#endif
