/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The triangles of one brick's cubes, ready to be uploaded: vertices and indices of its own.
 * Is not:  The whole mesh (mesh.h welds patches); world space (positions are relative to the patch).
 * Shape:   cube (di,dj,dk) of the patch has its smallest corner there, so the cubes reach one corner into the next
 *          bricks: positions lie in [0, 8]. A cut edge is named by its smaller corner (0..8 an axis, k fastest, side 9)
 *          and its axis: edge = slot * 3 + axis. Each cut edge of the patch owns exactly one vertex, vertices ascend by
 *          edge; a cut edge on a border is in every patch that uses it, with the same bits (but for the patch's own
 *          place, 8 in one and 0 in the other), and `edge` says so: welding needs no tolerance.
 *          Triangles follow their cubes, k fastest.
 * Units:   lattice steps from the patch's smallest corner; normals have length 1 and point out of the clay.
 * Owner:   surface; pointers hold until the next surface_update.
 * Source:  000 sections 3.1 (Edge), 3.2 (interpolation). We differ: a cube's index is not kept, it follows from rows of
 *          inside bits faster than it is read back; which cubes cross is kept.
 */
#ifndef GLAISE_SURFACE_PATCH_H
#define GLAISE_SURFACE_PATCH_H

#include "clay/brick.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Edges of 8^3 cubes: three axes of 8 x 9 x 9, named with room to spare by 9^3 corners. */
enum {
    PATCH_SIDE = 9,
    PATCH_EDGE_NAMES = PATCH_SIDE * PATCH_SIDE * PATCH_SIDE * 3,
    PATCH_VERTICES_MAX = 3 * (int)BRICK_EDGE * PATCH_SIDE * PATCH_SIDE
};

typedef struct patch_vertex {
    float position[3];
    float normal[3];
    uint32_t rgba;
    uint32_t edge; /* ((di*9 + dj)*9 + dk)*3 + axis */
} patch_vertex;

typedef struct patch {
    key at;              /* brick key */
    uint64_t generation; /* of the surface when vertices or triangles last changed; no two changes share one; never 0 */
    uint32_t vertex_count;
    uint32_t triangle_count;
    patch_vertex *vertices;
    uint16_t (*triangles)[3]; /* indices into vertices, counter-clockwise seen from outside */
    brick_mask crossing;      /* cubes that cross the surface: the paper's crossList, by brick */
    uint32_t crossing_count;
    uint16_t inside[PATCH_SIDE][PATCH_SIDE]; /* [di][dj], bit dk: corners 0..8 at or over iso */
    uint16_t first[PATCH_SIDE]; /* vertex whose edge's smaller corner has this di, or a greater one */
    bool is_orphan; /* its brick is not stored: only those above are */
    uint64_t digest;
    bool digest_known;
    uint32_t vertex_room, triangle_room;
} patch;

#ifdef __cplusplus
}
#endif
#endif
