/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The marching-cubes table: for each of the 256 sign patterns of a cube, the triangles between its cut edges.
 *          Generated, not typed: face contours are traced by one rule, then triangulated without face diagonals.
 * Is not:  The exact topology of the tri-linear field (ambiguous faces all follow the one rule: inside corners are
 *          never joined across a face).
 * Shape:   corner c of a cube = dx + 2 dy + 4 dz, with (x,y,z) = (i,j,k). Bit c of an index is set when that corner is
 *          inside (>= iso). Edge e = axis * 4 + (which of the four parallel edges): see case_table.c's drawing.
 *          Triangles are counter-clockwise seen from outside (from the absent side).
 * Owner:   the caller; a table is 256 x 16 bytes and constant once made.
 * Errors:  None.
 * Cost:    case_table_init: well under a millisecond.
 * Source:  000 section 3.2; Lorensen and Cline 1987 for the idea; the face rule keeps neighbouring cubes in agreement,
 *          the ban on diagonals inside a face keeps edges at two triangles.
 */
#ifndef GLAISE_SURFACE_CASE_TABLE_H
#define GLAISE_SURFACE_CASE_TABLE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { CASE_TABLE_CASES = 256, CASE_TABLE_CORNERS = 8, CASE_TABLE_EDGES = 12, CASE_TABLE_TRIANGLES_MAX = 5 };

typedef struct case_table {
    uint8_t triangles[CASE_TABLE_CASES];
    uint8_t edge[CASE_TABLE_CASES][CASE_TABLE_TRIANGLES_MAX * 3];
} case_table;

void case_table_init(case_table *t);
/* Corner pair of an edge, smaller corner first; the axis it runs along is e / 4. */
void case_table_edge(int e, int *from_out, int *to_out);

#ifdef __cplusplus
}
#endif
#endif
