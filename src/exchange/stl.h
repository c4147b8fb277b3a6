/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Binary STL: the surface as a soup of facets, for printers and slicers.
 * Is not:  Able to hold colours (ply.h, obj.h, inventor.h); ASCII STL.
 * Shape:   80 bytes of header, uint32 count, then per facet 12 floats (normal, three corners counter-clockwise seen
 *          from outside) and two zero bytes: 84 + 50 count bytes. The header never begins with "solid", by which some
 *          readers tell ASCII.
 *          Count is the mesh's triangle count, always: a facet whose corners round to equal positions stays, or its
 *          neighbours would lose their partner. The normal is that of the corners as written, so that a
 *          reader who works it out again finds the same; 0 0 0 where they have no area.
 *          Shared corners have equal bits: closedness survives any reader that joins equal positions.
 * Units:   millimetres (the format has no field for it; slicers assume it).
 * Errors:  mesh_file.h's, and the sink's.
 */
#ifndef GLAISE_EXCHANGE_STL_H
#define GLAISE_EXCHANGE_STL_H

#include "exchange/mesh_file.h"

[[nodiscard]] status stl_write(const mesh_file &f, checkpoint_sink sink, void *self);

#endif
