/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What the mesh writers (stl, ply, obj, inventor) agree on: which meshes they take, where a vertex lies, and
 *          what becomes of a piece's name.
 * Is not:  A format; the mesh itself (surface/mesh.h).
 * Shape:   position = key-space position * step_mm, computed in double and rounded once to float32. Every format
 *          carries that same float, bit for bit, so files of one piece agree with each other.
 *          A format may hold fewer digits than the lattice: further than about 10^4 steps from the origin vertices
 *          can round to one place. Triangles are then written all the same: count and connections are the mesh's.
 * Units:   millimetres in files, lattice steps in the mesh.
 * Owner:   the mesh and the name stay the caller's.
 * Errors:  mesh_file_check, before the first byte: STATUS_BAD_PARAMETER for a mesh without triangles and for a step
 *          outside SCULPTURE_STEP_MM_MIN..MAX; STATUS_TOO_LARGE past MESH_FILE_COUNT_MAX. A triangle that names a
 *          vertex which is not there is our bug, and asserted (Open Inventor readers crash on one).
 *          Why refuse emptiness: an empty mesh file is formally valid, but most programs call it damaged, and it would
 *          replace the export of yesterday under the same name.
 */
#ifndef GLAISE_EXCHANGE_MESH_FILE_H
#define GLAISE_EXCHANGE_MESH_FILE_H

#include "sculpture/sculpture.h"

#include <string>
#include <string_view>

/* Vertices, and triangles: PLY and Inventor index with an int32. */
#define MESH_FILE_COUNT_MAX ((uint32_t)INT32_MAX)
enum { MESH_FILE_NAME_BYTES = 60 };

struct mesh_file {
    const mesh *of;
    double step_mm;
    std::string_view name; /* of the piece, any bytes */
};

[[nodiscard]] status mesh_file_check(const mesh_file &f);
void mesh_file_position(const mesh_file &f, uint32_t vertex, float out[3]);
/* The name as one line that means nothing to any format: control characters become spaces, " becomes ', \ becomes /;
   cut between characters (UTF-8) to MESH_FILE_NAME_BYTES; "piece" when nothing is left. */
std::string mesh_file_name(const mesh_file &f);

#endif
