/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A surface made by OpenVDB's mesher, ready for a renderer: triangle list, normals, colours. Of a whole field,
 *          or of some leaves of it (the three ways of vdb_peer.h).
 * Is not:  The field (vdb_peer.cpp).
 * Shape:   the mesher gives points inside cubes and quads round edges; a quad belongs to the leaf that holds its
 *          edge's smaller corner, and that is how the ways compare. Buffers are kept from call to call.
 * Units:   lattice steps.
 * Owner:   the caller owns the fields; borrowed leaves are given back before a call ends.
 */
#ifndef GLAISE_BENCH_VDB_SKIN_H
#define GLAISE_BENCH_VDB_SKIN_H

#include "vdb_peer.h"
#include "vdb_region.h"

#include <openvdb/openvdb.h>

#include <vector>

using vdb_skin_tree = openvdb::FloatTree;
using vdb_skin_leaf = vdb_skin_tree::LeafNodeType;
using vdb_skin_colours = openvdb::Int32Tree;

struct vdb_skin_field {
    vdb_skin_tree *potential;
    const vdb_skin_colours *rgba;
};

class vdb_skin {
public:
    void of_region(const vdb_skin_field &f, const vdb_region &r, vdb_peer_way way);
    void of_whole(const openvdb::FloatGrid &grid, const vdb_skin_field &f);
    uint64_t points() const { return point.size(); }
    uint64_t triangles() const { return triangle.size() / 3; }

private:
    void borrowed(const vdb_skin_field &f, const vdb_region &r, bool masked);
    void copied(const vdb_skin_field &f, const vdb_region &r);
    template <class mesher> void take(const mesher &m, const openvdb::Coord &offset);
    void keep_leaves(const vdb_region &r);
    void dress(const vdb_skin_field &f);

    std::vector<openvdb::Vec3s> point, normal;
    std::vector<uint32_t> rgba, triangle;
};

#endif
