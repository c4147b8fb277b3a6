/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    VTK's FlyingEdges3D over a dense grid of the field: a whole surface with normals, and with colours if asked.
 *          One thread.
 * Is not:  An engine for dabs: it knows no change, only everything. Anything at all where VTK is not installed.
 * Shape:   the dense grid is the box of stored corners and one empty corner round it.
 * Owner:   the peer copies the field.
 */
#ifndef GLAISE_BENCH_VTK_PEER_H
#define GLAISE_BENCH_VTK_PEER_H

#include "clay/clay.h"

#include <memory>
#include <string>

class vtk_peer {
public:
    virtual ~vtk_peer() = default;
    /* Answers the number of triangles. */
    virtual uint64_t whole(bool colours) = 0;
};

/* Empty where VTK is not here. */
std::unique_ptr<vtk_peer> vtk_peer_open(const clay &from);
std::string vtk_peer_version(); /* "9.1.0", "not here" */

#endif
