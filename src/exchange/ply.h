/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Binary little-endian PLY: the welded surface with a normal and a colour at every vertex.
 * Is not:  ASCII PLY.
 * Shape:   text header, then per vertex  float x y z nx ny nz, uchar red green blue alpha  (28 bytes), then per
 *          triangle  uchar 3, int a b c  (13 bytes), counter-clockwise seen from outside. Vertices keep the mesh's
 *          order.
 * Units:   millimetres (said in a comment line).
 * Errors:  mesh_file.h's, and the sink's.
 */
#ifndef GLAISE_EXCHANGE_PLY_H
#define GLAISE_EXCHANGE_PLY_H

#include "exchange/mesh_file.h"

[[nodiscard]] status ply_write(const mesh_file &f, checkpoint_sink sink, void *self);

#endif
