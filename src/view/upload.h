/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A surface's patches on the graphics device, kept up to date by generation: what did not change is not sent.
 *          Many patches share one pair of buffers and are drawn by one call.
 * Is not:  The surface itself (surface.h); how it is lit (clay_shader.h).
 * Shape:   pages; a page has UPLOAD_UNITS units, a patch takes as many neighbouring units as it needs and keeps them
 *          while it fits:
 *
 *              unit      32 vertices of 16 bytes, 64 triangles, and where lines are wanted 96 lines, of 16-bit indices
 *              page      2,048 units = 65,536 vertices (what 16 bits can name) = 1 MiB + 768 KiB (+ 768 KiB)
 *              vertex    offset in the brick, 3 x u16, 1/4096 step; number of the patch's first unit, u16;
 *                        normal, octahedral, 2 x i16; RGBA8
 *              u_bricks  per page a texture, 2,048 x 1 texels: brick key of the patch that begins at that unit
 *
 *          Unused indices name one vertex three times: nothing is drawn there. A border vertex has offset 0 in one
 *          patch and 8 in the other; both are exact, and so are the offsets between: see patch_shader.h.
 * Units:   lattice steps.
 * Owner:   the caller owns the struct; upload_finish frees the device's memory. The context must be current throughout.
 * Errors:  upload_update false: no memory on the device, or UPLOAD_PAGES_MAX; what was sent stays, what was not will be
 *          tried again next time.
 * Cost:    update: a look at every slot, and the bytes of the changed patches. draw: one call a page.
 */
#ifndef GLAISE_VIEW_UPLOAD_H
#define GLAISE_VIEW_UPLOAD_H

#include "sculpture/sculpture.h"

#include <GLES3/gl31.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

enum {
    UPLOAD_UNITS = 2048,
    UPLOAD_UNIT_VERTICES = 32,
    UPLOAD_UNIT_TRIANGLES = 64,
    UPLOAD_UNIT_LINES = 96, /* of 64 triangles with 192 sides, each side drawn once */
    /* 33 million vertices, 0.9 GiB: what a full sculpture's patches would take at 4 units each. */
    UPLOAD_PAGES_MAX = 512,
};

struct upload_vertex {
    uint16_t place[3];
    uint16_t unit;
    int16_t normal[2];
    uint32_t rgba;
};
static_assert(sizeof(upload_vertex) == 16);

struct upload_page {
    GLuint array = 0, line_array = 0;
    GLuint vertices = 0, triangles = 0, lines = 0, bricks = 0;
    std::array<uint64_t, UPLOAD_UNITS / 64> taken{}; /* bit n: unit n */
    int top = 0;                                     /* units from here on are free */
    int longest = UPLOAD_UNITS;                      /* no longer run of free units exists */
};

struct upload_slot {
    uint64_t generation = 0;
    key at{};
    uint32_t page = 0;
    int first = 0;
    int units = 0; /* 0: nothing on the device */
};

struct upload_counts {
    uint64_t bytes = 0;   /* sent to the device since upload_init */
    uint64_t patches = 0; /* sent, likewise */
    uint32_t held = 0;    /* patches on the device now */
};

struct upload {
    bool with_lines = false;
    std::vector<upload_page> pages;
    std::vector<upload_slot> slots;
    uint64_t newest = 0;        /* generation of the surface last looked at */
    box bricks = box_empty();   /* of the patches held */
    upload_counts counts;
    std::vector<upload_vertex> packed; /* scratch of one patch */
    std::vector<uint16_t> indices;
};

/* Makes nothing on the device yet. with_lines: each side of each triangle can be drawn once. */
void upload_init(upload *u, bool with_lines);
void upload_finish(upload *u);
/* Nothing held any more; the memory stays. For when another surface is to be shown. */
void upload_clear(upload *u);

[[nodiscard]] bool upload_update(upload *u, const surface *s, std::string *trouble_out);

/* The program in use must be built on patch_shader.h. Texture unit 0 holds u_bricks. */
void upload_draw_triangles(const upload &u);
void upload_draw_lines(const upload &u);

#endif
