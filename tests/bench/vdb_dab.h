/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A dab of an ellipsoid on plain buffers of 8^3 corners, as the OpenVDB peer has them: where the tool is, what
 *          it contributes, what becomes of a leaf. Written out here so that the peer's loops are compiled for the
 *          machine at hand and do not change with ours.
 * Is not:  Our engine's (tool/); the tree the leaves hang in (vdb_peer.cpp).
 * Shape:   corner (di,dj,dk) at di*64 + dj*8 + dk. Same roundings as tool/walk.h and tool/action.h.
 *          A leaf's neighbourhood for smoothing is an apron of 10^3, corner (-1,-1,-1) first.
 * Units:   lattice steps, potential.
 * Owner:   nothing is kept between calls.
 */
#ifndef GLAISE_BENCH_VDB_DAB_H
#define GLAISE_BENCH_VDB_DAB_H

#include "bench_object.h"

constexpr int vdb_dab_corners = 512, vdb_dab_apron_side = 10, vdb_dab_apron_corners = 1000;

struct vdb_dab {
    action kind;
    uint32_t rgba;
    float amount;
    uint64_t number;
    double row[3][3], origin[3]; /* tool from key */
    float along[3][8], plane[3][64]; /* [tool axis][di], [dj * 8 + dk] */
    box corners;
};

vdb_dab vdb_dab_of(const bench_object_dab &d, uint64_t number);
/* False when no corner of the leaf can lie inside the tool's box. */
bool vdb_dab_touches(const vdb_dab &d, key leaf);
/* The tool's potential at every corner of the leaf, 0 outside; answers how many have a contribution. */
int vdb_dab_evaluate(const vdb_dab &d, key leaf, float potential_out[vdb_dab_corners]);

/* Which corners of a leaf have another value or colour now. */
struct vdb_dab_change {
    int corners = 0;
    uint64_t slab[8] = {}; /* word di, bit dj*8 + dk */
};

/* Bit n: corner n of a slab of 64 is `least` or more. */
uint64_t vdb_dab_at_least(const float *slab, float least);

/* Toothpaste and soft eraser. */
vdb_dab_change vdb_dab_act(const vdb_dab &d, key leaf, const float *v_tool, float *potential, uint32_t *rgba);
/* Smooth: the new leaf, from the old one's apron. The apron's colours are asked for only where clay comes to be. */
struct vdb_dab_apron {
    float potential[vdb_dab_apron_corners];
    uint32_t rgba[vdb_dab_apron_corners];
};
/* Answers whether colours were missing: then gather them into the apron and call again. */
bool vdb_dab_smooth(const vdb_dab &d, const float *v_tool, const vdb_dab_apron &near, bool has_rgba, float *potential,
                    uint32_t *rgba, vdb_dab_change *change_out);

#endif
