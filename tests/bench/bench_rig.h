/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The two engines side by side: clay with its surface, and the paper's layout (per_corner.h). Each can be
 *          given a dab, and the two can be compared, corner by corner and vertex by vertex.
 * Is not:  Timing (bench_paper_table.cpp); the work itself (bench_object.h).
 * Owner:   a rig owns both engines; large, not to be copied.
 * Errors:  bench_rig_demand ends the program with a sentence and exit code 1: a benchmark of unequal work says nothing.
 */
#ifndef GLAISE_BENCH_BENCH_RIG_H
#define GLAISE_BENCH_BENCH_RIG_H

#include "bench_object.h"
#include "per_corner.h"
#include "surface/surface.h"
#include "tool/ellipsoid.h"

#include <string>
#include <vector>

struct bench_rig_counts {
    tool_counts tool;
    surface_counts skin; /* ours only */
    uint64_t treated; /* cubes; the reference leaves out those that never had a corner */
};

class bench_rig {
public:
    bench_rig(uint32_t bricks, uint32_t corners);
    ~bench_rig();
    bench_rig(const bench_rig &) = delete;
    bench_rig &operator=(const bench_rig &) = delete;

    /* The two halves of our dab. */
    void field(const bench_object_dab &d, tool_counts *counts_out);
    void surface_of_field(surface_counts *counts_out);
    /* Both, not counted: what is timed. */
    void apply(const bench_object_dab &d);
    bench_rig_counts ours(const bench_object_dab &d);
    bench_rig_counts reference(const bench_object_dab &d);
    /* The reference starts anew with our field. */
    void load_reference();
    /* "" when both hold the same corners (bit by bit), crossing cubes, triangles and vertices (same edge, same colour,
       same place within 1e-4, and if asked the same normal within 1e-3); otherwise the first difference. The paper's
       way lets normals beside a dab age: ask only after load_reference. */
    std::string difference(bool normals) const;
    uint64_t vertices() const; /* each cut edge once, over all patches */
    uint64_t number() const { return dabs_ours; } /* of our next dab */
    void number_from(uint64_t n) { dabs_ours = n; }
    /* Memory held for the field, for the surface: pools, trees, arrays with their spare room. */
    double clay_bytes() const;
    double surface_bytes() const;

    /* The vector instructions our row kernels can be told to use on this machine, widest first; one for as long as the
       compiler alone decides. */
    static std::vector<lanes> choices(); /* of vectors, those that are here: AVX2 first if it is */
    void use_rows(lanes choice);

    clay field_clay = {};
    surface skin = {};
    per_corner paper = {};

private:
    std::string difference_in_corners() const;
    std::string difference_in_patch(const patch &p, bool normals) const;
    tool tool_of(const bench_object_dab &d) const;

    tool_scratch scratch = {};
    ellipsoid ball = {};
    uint32_t reference_corners = 0;
    uint64_t dabs_ours = 0, dabs_reference = 0;
};

void bench_rig_demand(bool good, const std::string &what);

#endif
