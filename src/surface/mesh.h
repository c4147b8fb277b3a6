/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The whole surface as one welded indexed mesh: each cut edge one vertex, closed and oriented.
 * Is not:  Kept up to date: it is made when asked for (exports, measuring, tests).
 * Shape:   vertices in key order of their patches, within one by edge; a cut edge belongs to the brick of its smaller
 *          corner. Triangles in key order of their patches index them, counter-clockwise seen from outside.
 *          Position of vertex v in lattice steps: 8 * brick + offset, kept apart so that no digit is lost far out.
 * Units:   lattice steps.
 * Owner:   the caller; mesh_finish frees.
 * Errors:  STATUS_NO_MEMORY; 2^32 - 1 vertices or triangles or more: STATUS_TOO_LARGE. The mesh is empty then.
 *          A surface that was left partly updated does not join up: asserted.
 * Cost:    O(vertices + triangles), one tree entry per patch and border.
 */
#ifndef GLAISE_SURFACE_MESH_H
#define GLAISE_SURFACE_MESH_H

#include "surface/surface.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mesh_vertex {
    key brick;
    float offset[3]; /* lattice steps from the brick's smallest corner */
    float normal[3];
    uint32_t rgba;
} mesh_vertex;

typedef struct mesh {
    mesh_vertex *vertices;
    uint32_t (*triangles)[3];
    uint32_t vertex_count;
    uint32_t triangle_count;
} mesh;

STATUS_CHECKED status mesh_init(mesh *m, const surface *s);
void mesh_finish(mesh *m);

/* Position in lattice steps. */
static inline void mesh_position(const mesh_vertex *v, double out[3])
{
    out[0] = 8.0 * v->brick.i + v->offset[0];
    out[1] = 8.0 * v->brick.j + v->offset[1];
    out[2] = 8.0 * v->brick.k + v->offset[2];
}

/* Every edge a triangle uses is used by exactly one other, the other way. False too when the machine has no memory to
   find out (8 bytes a vertex, 24 a triangle). */
bool mesh_is_closed(const mesh *m);
/* Vertices - edges + triangles: 2 a sphere, 0 a torus, summed over the pieces. Only meaningful when closed. */
int64_t mesh_euler(const mesh *m);
/* Enclosed volume in lattice steps cubed; positive when triangles face outwards. */
double mesh_volume(const mesh *m);

#ifdef __cplusplus
}
#endif
#endif
