/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Where a picture is drawn: a multisampled framebuffer, and textures that it is resolved into, which can be
 *          read back, worked on or shown.
 * Is not:  What is drawn (view.h); a screen or window (platform/display); a picture file (exchange/picture.h).
 * Shape:
 *              canvas: colour SRGB8_ALPHA8, N samples  --canvas_end-->  target: texture SRGB8_ALPHA8
 *                      depth 24, stencil 8, N samples      (dropped)
 *
 *          N is what was asked for, CANVAS_SAMPLES at most, or what the machine has. Shaders write linear light; OpenGL
 *          encodes on the way in, so that blending and resolving happen in linear light. The texture's bytes are sRGB.
 * Units:   pixels.
 * Owner:   the caller owns the structs; a zeroed one is closed. The context must be current throughout.
 * Errors:  canvas_size, canvas_target_size false: a side out of range or no memory on the device; it is then closed,
 *          the trouble says which. canvas_read false: there is nothing in it, or the device refused.
 * Cost:    sizing does nothing when the size is what it was.
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

struct canvas_target {
    int width = 0, height = 0;
    GLuint texture = 0, framebuffer = 0;
};

struct canvas {
    int width = 0, height = 0;
    int samples = 0; /* per pixel; 0: one */
    int wanted = -1; /* samples that were asked for */
    GLuint colour = 0, depth = 0, framebuffer = 0;
};

/* Can a picture of this size be drawn in one? */
[[nodiscard]] bool canvas_fits(int width, int height, std::string *trouble_out);
[[nodiscard]] bool canvas_size(canvas *c, int width, int height, int samples, std::string *trouble_out);
void canvas_close(canvas *c);
/* As many as this machine has, at most `wanted`. */
int canvas_samples_here(int wanted);

[[nodiscard]] bool canvas_target_size(canvas_target *t, int width, int height, std::string *trouble_out);
void canvas_target_close(canvas_target *t);

/* Between these two everything is drawn into the canvas; the target has its size. begin clears depth, not colour. */
void canvas_begin(const canvas &c);
void canvas_end(const canvas &c, const canvas_target &into);
/* Larger or smaller: by the mean of the nearest four. */
void canvas_copy(const canvas_target &from, const canvas_target &into);

/* width x height x RGBA8, top row first, encoded as sRGB. */
[[nodiscard]] bool canvas_read(const canvas_target &t, std::vector<uint8_t> *rgba_out, std::string *trouble_out);

#endif
