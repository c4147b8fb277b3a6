/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Wavefront OBJ as text: the welded surface with normals, and colours in the common extension of the v line.
 * Is not:  Able to hold alpha; a material library (no .mtl is referred to).
 * Shape:   "o name", then  v x y z r g b  per vertex, then  vn x y z  per vertex, then  f a//a b//b c//c  per triangle,
 *          numbered from 1, counter-clockwise seen from outside. Vertices keep the mesh's order. r g b are the
 *          corner's bytes / 255, not made linear: that is how the programs that read the extension show them.
 * Units:   millimetres (said in a comment line); colours 0..1.
 * Errors:  mesh_file.h's, and the sink's.
 */
#ifndef GLAISE_EXCHANGE_OBJ_H
#define GLAISE_EXCHANGE_OBJ_H

#include "exchange/mesh_file.h"

[[nodiscard]] status obj_write(const mesh_file &f, checkpoint_sink sink, void *self);

#endif
