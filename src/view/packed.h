/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A patch in the form the device draws: 16 bytes a vertex, 16-bit indices that name vertices of a whole page.
 * Is not:  The page (page.h); what the bytes mean to the shader (patch_shader.h says it once more, in its own words).
 * Shape:   a range of neighbouring units of a page, from unit `first` on:
 *
 *              unit      32 vertices of 16 bytes, 64 triangles, and where lines are wanted 96 lines, of 16-bit indices
 *              vertex    offset in the brick, 3 x u16, 1/4096 step; number of the range's first unit, u16;
 *                        normal, octahedral, 2 x i16; RGBA8
 *
 *          Vertices end where the patch's do; indices fill the units, those unused name one vertex three times: nothing
 *          is drawn there. A border vertex has offset 0 in one patch and 8 in the other; both are exact, and so are the
 *          offsets between: see patch_shader.h.
 * Units:   lattice steps.
 * Owner:   the caller owns the struct, which is scratch: memory stays for the next patch.
 * Cost:    by vertex and index; with lines, twice more by index.
 */
#ifndef GLAISE_VIEW_PACKED_H
#define GLAISE_VIEW_PACKED_H

#include "sculpture/sculpture.h"

#include <cstdint>
#include <vector>

enum {
    PACKED_UNIT_VERTICES = 32,
    PACKED_UNIT_TRIANGLES = 64,
    PACKED_UNIT_LINES = 96, /* of 64 triangles with 192 sides, each side drawn once */
    PACKED_UNITS_MAX = (PATCH_VERTICES_MAX + PACKED_UNIT_VERTICES - 1) / PACKED_UNIT_VERTICES,
};

struct packed_vertex {
    uint16_t place[3];
    uint16_t unit;
    int16_t normal[2];
    uint32_t rgba;
};
static_assert(sizeof(packed_vertex) == 16);

constexpr size_t PACKED_VERTEX_BYTES = sizeof(packed_vertex) * PACKED_UNIT_VERTICES; /* these three: of one unit */
constexpr size_t PACKED_TRIANGLE_BYTES = sizeof(uint16_t) * 3 * PACKED_UNIT_TRIANGLES;
constexpr size_t PACKED_LINE_BYTES = sizeof(uint16_t) * 2 * PACKED_UNIT_LINES;

struct packed {
    std::vector<packed_vertex> vertices;
    std::vector<uint16_t> triangles, lines; /* lines: empty where none are wanted */
};

/* Units that the patch needs. */
int packed_units(const patch &p, bool with_lines);
void packed_make(packed *to, const patch &p, int first, int units, bool with_lines);

#endif
