/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The structure under the surface, drawn instead of it: the cubes that have a corner stored, or those that the
 *          surface passes through, as boxes.
 * Is not:  The surface (upload.h); what makes a cube cross (surface/patch.h); the brick as the clay stores it
 *          (clay/brick.h).
 * Shape:   sets are kept as 512 bits for a brick's cubes. A cube's face is listed where the cube beyond it is not in
 *          the set, so that what is inside costs nothing:
 *
 *              stored corners --OR of eight neighbours--> cubes --AND NOT neighbour, six ways--> faces, 8 bytes each
 *
 *          Faces lie in spans of CUBES_SPAN cubes along each axis, one draw call each: nearly always there is one,
 *          eight where the origin is inside. Where a set has more than CUBES_FACES_MAX faces, bricks are shown in
 *          place of cubes: each as one box, if any of its cubes is in the set.
 * Units:   lattice steps; millimetres in the snapshot.
 * Owner:   the caller owns the structs; cubes_close frees the device's memory. The context must be current, but for
 *          cubes_list.
 * Errors:  cubes_open and cubes_update false: no memory on the device, or the compiler's words; then no cubes are
 *          drawn, and the next update tries again.
 * Cost:    update: nothing while neither surface nor clay changed, else the whole set: some 15 ms at a million corners,
 *          and for that time 64 bytes a brick. On the device 16 MiB at CUBES_FACES_MAX, 36 MiB at the very most.
 *          draw: one call a span.
 * Source:  000 section 3.1 (CubesTree, crossList) and figure 5 a, b.
 */
#ifndef GLAISE_VIEW_CUBES_H
#define GLAISE_VIEW_CUBES_H

#include "view/projection.h"

#include <GLES3/gl31.h>

#include <cstdint>
#include <string>
#include <vector>

enum {
    CUBES_FACES_MAX = 1 << 21, /* 4 million triangles, which small machines still turn */
    CUBES_SPAN_BRICKS = 2048,
    CUBES_SPAN = CUBES_SPAN_BRICKS * BRICK_EDGE,
};

struct cubes_face {
    uint16_t place[3]; /* of the cube or brick, from the span's smallest corner, in cubes or bricks */
    uint16_t side;     /* 2 axis + (1: the upper one) */
};

struct cubes_span {
    key at; /* of its smallest brick */
    size_t first, count;
};

struct cubes_faces {
    std::vector<cubes_face> faces;
    std::vector<cubes_span> spans;
    uint64_t cubes = 0;   /* in the set, hidden ones too */
    uint64_t bricks = 0;  /* that have any of them */
    bool are_bricks = false;
    box within = box_empty(); /* bricks: holds all of them */
};

/* What there was when the faces were made. */
struct cubes_seen {
    const sculpture *of = nullptr;
    snapshot_structure structure = SNAPSHOT_STRUCTURE_SURFACE;
    uint64_t generation = 0, triangles = 0, corners = 0, births = 0, dab = 0, strokes = 0;
    bool operator==(const cubes_seen &) const = default;
};

struct cubes {
    GLuint program = 0, buffer = 0, array = 0;
    GLint eye_from_units = -1, eye_normal = -1, clip_from_eye = -1, colour = -1;
    GLint light_count = -1, light_place = -1, light_colour = -1;
    cubes_faces shown; /* its faces themselves are on the device only */
    cubes_seen seen;
};

[[nodiscard]] bool cubes_open(cubes *c, std::string *trouble_out);
void cubes_close(cubes *c); /* a fresh one is fine */
/* Shows nothing any more; the device's memory is given back. For SNAPSHOT_STRUCTURE_SURFACE, and before another
   sculpture. */
void cubes_clear(cubes *c);

/* structure: not SNAPSHOT_STRUCTURE_SURFACE. */
[[nodiscard]] bool cubes_update(cubes *c, const sculpture *s, snapshot_structure structure, std::string *trouble_out);
void cubes_draw(const cubes &c, const snapshot &s, const projection &p);

/* The faces of a set; for cubes_update, and for who wants to count. */
void cubes_list(const sculpture *s, snapshot_structure structure, size_t faces_max, cubes_faces *out);

#endif
