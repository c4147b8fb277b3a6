/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Where a dab's surface is to be renewed: the leaves with a crossing cube that sees a corner whose potential,
 *          colour or gradient changed. As exact as our own engine's, so that OpenVDB is not given more to do.
 * Is not:  The mesher (vdb_skin.h).
 * Shape:   changed corners come leaf by leaf as masks; star of six round each, then the eight cubes round those.
 * Units:   lattice steps; leaves by brick key (first corner / 8).
 * Owner:   the caller.
 */
#ifndef GLAISE_BENCH_VDB_REGION_H
#define GLAISE_BENCH_VDB_REGION_H

#include "vdb_dab.h"

#include <openvdb/openvdb.h>

#include <vector>

using vdb_region_tree = openvdb::FloatTree;

class vdb_region {
public:
    /* leaves: all that can be named afterwards. */
    void begin(box leaves);
    void add(key leaf, const vdb_dab_change &c);
    void end(const vdb_region_tree &field);

    openvdb::CoordBBox corners;         /* round all changed corners */
    std::vector<openvdb::Coord> leaves; /* first corners, ascending, each once */

private:
    struct mark {
        uint64_t slab[8];
        bool changed, candidate;
    };
    mark &at(key leaf);
    void changed_rows(key leaf, uint16_t rows_out[11][11]);
    bool is_stale(key leaf, const uint8_t crossing[8][8]);

    box range = {};
    int side[3] = {};
    std::vector<mark> marks;
};

#endif
