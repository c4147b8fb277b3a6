/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    OpenVDB as a sculpting engine, driven as well as its public interface allows: the same dabs on the same
 *          field, and a renewed surface with normals and colours. One thread.
 * Is not:  Part of the program; anything at all where OpenVDB is not installed (vdb_peer_open then answers nothing).
 * Shape:   field: a float grid and a grid of packed colours, leaves of 8^3 like our bricks, k fastest. A dab computes
 *          on leaf buffers, a leaf at a time, in loops the compiler turns into vector instructions; the same roundings
 *          as ours, so that both fields hold the same bits.
 *          surface of a dab: three ways, all with VolumeToMesh at adaptivity 0
 *              masked     leaves round the change, borrowed into a tree of small nodes; a mask says which cells
 *              lent       the same leaves, but their active voxels say which cells: for a moment all of those to be
 *                         renewed and none of the ring. Polygons of other leaves are thrown away
 *              copied     the changed region alone, copied into fresh leaves of 16^3 that begin where it begins.
 *                         Generous: a renderer would still have to cut the old triangles out, cell by cell
 *          then a triangle list, normals (central differences, trilinear) and colours (trilinear, by clay) by us.
 * Units:   lattice steps.
 * Owner:   whoever opened it.
 * Errors:  none of its own; OpenVDB's exceptions end the program.
 */
#ifndef GLAISE_BENCH_VDB_PEER_H
#define GLAISE_BENCH_VDB_PEER_H

#include "bench_object.h"

#include <memory>
#include <string>

struct vdb_peer_counts {
    uint64_t dirtied = 0, changed = 0;  /* corners with a contribution; of these, with another value or colour */
    uint64_t leaves = 0;                /* leaves the surface was renewed in */
    uint64_t points = 0, triangles = 0; /* of the surface made last */
};

enum vdb_peer_way { VDB_PEER_MASKED, VDB_PEER_LENT, VDB_PEER_COPIED };
constexpr int vdb_peer_ways = 3;

class vdb_peer {
public:
    virtual ~vdb_peer() = default;

    /* The field becomes that of the clay; what was saved before is forgotten. */
    virtual void load(const clay &from) = 0;
    /* Back to what was loaded. */
    virtual void restore() = 0;
    /* kind: toothpaste, soft eraser or smooth (asserted); the tool is Wyvill's ellipsoid. */
    virtual void field(const bench_object_dab &d, uint64_t number) = 0;
    /* The surface that depends on what the last dab changed. */
    virtual void surface(vdb_peer_way way) = 0;
    /* All of the surface, with normals and colours. */
    virtual void whole() = 0;

    virtual const vdb_peer_counts &counts() const = 0;
    virtual uint64_t corners() const = 0;
    virtual uint64_t bytes() const = 0; /* of both grids; what was loaded is kept besides */
    /* "" when the field is that of the clay, bit by bit. */
    virtual std::string difference(const clay &from) const = 0;
};

/* Empty where OpenVDB is not here. */
std::unique_ptr<vdb_peer> vdb_peer_open();
/* "10.0.1", "not here". */
std::string vdb_peer_version();

#endif
