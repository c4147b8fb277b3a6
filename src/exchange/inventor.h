/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Open Inventor 2.1, ASCII: the welded surface with normals and a packed colour at every vertex, the paper's
 *          way out to other programs.
 * Is not:  VRML; a scene (no lights, no camera: those are the view's).
 * Shape:   one Separator of Info, ShapeHints, Material, PackedColor, MaterialBinding, Normal, NormalBinding,
 *          Coordinate3 and IndexedFaceSet, in that order: PackedColor has to follow Material, whose diffuse colour
 *          and transparency it replaces. Both bindings are PER_VERTEX_INDEXED and coordIndex serves for all three.
 *          ShapeHints says SOLID and COUNTERCLOCKWISE: viewers leave out what faces away, so triangles must face
 *          outwards (mesh.h's word). Alpha is Inventor's opacity.
 * Units:   millimetres (said in Info). No Units node: readers would answer it by scaling, and the numbers would no
 *          longer be those of the other formats.
 * Errors:  mesh_file.h's, and the sink's. Indices are checked there: Coin crashes on one out of range.
 * Source:  000 section 2 (export to Inventor).
 */
#ifndef GLAISE_EXCHANGE_INVENTOR_H
#define GLAISE_EXCHANGE_INVENTOR_H

#include "exchange/mesh_file.h"

[[nodiscard]] status inventor_write(const mesh_file &f, checkpoint_sink sink, void *self);

#endif
