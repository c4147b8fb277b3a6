/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Meshes with known answers, made without any clay: closed, outwards, coloured, in bricks on both sides of
 *          zero.
 * Is not:  What surface/ makes (tests/peers uses that).
 * Owner:   the struct owns the arrays its mesh points into; move it, do not copy it.
 */
#ifndef GLAISE_EXCHANGE_HANDMADE_H
#define GLAISE_EXCHANGE_HANDMADE_H

#include "exchange/mesh_file.h"

#include <array>
#include <vector>

struct handmade {
    std::vector<mesh_vertex> vertices;
    std::vector<std::array<uint32_t, 3>> triangles;
    double volume = 0; /* lattice steps cubed, of the triangles */

    handmade() = default;
    handmade(const handmade &) = delete;
    handmade &operator=(const handmade &) = delete;
    handmade(handmade &&) = default;
    handmade &operator=(handmade &&) = default;

    mesh as_mesh();
};

/* Four triangles, corner at the origin, edges of `side` steps. */
handmade handmade_tetrahedron(double side);
/* Octahedron subdivided `depth` times and blown up: 8 * 4^depth triangles. */
handmade handmade_ball(const std::array<double, 3> &middle, double radius, int depth);
/* Ring about z: 2 * around * across triangles. */
handmade handmade_torus(const std::array<double, 3> &middle, double ring, double tube, int around, int across);

#endif
