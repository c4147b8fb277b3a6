/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What the benchmarks work on: seeded dabs that make a small character of the paper's size and a lump of a
 *          million corners, the paper's six tool poses with the figures it prints, and paths over a surface.
 * Is not:  Timing (bench_paper_table.cpp); the engines (bench_rig.h).
 * Shape:   everything follows from fixed seeds, so that two runs, two machines and two engines do the same work.
 * Units:   lattice steps, radians, potential.
 * Owner:   nothing is kept between calls.
 * Source:  000 section 6; the poses were found by fitting its table.
 */
#ifndef GLAISE_BENCH_BENCH_OBJECT_H
#define GLAISE_BENCH_BENCH_OBJECT_H

#include "clay/clay.h"
#include "tool/tool.h"

#include <vector>

struct bench_object_dab {
    action kind;
    uint32_t rgba;
    tool_dab dab;
};

/* What the paper prints of its object (figure 2) and its machine. */
constexpr uint32_t bench_object_paper_corners = 15573, bench_object_paper_vertices = 4200,
                   bench_object_paper_triangles = 8392;
constexpr int bench_object_paper_heights[3] = {14, 16, 13}; /* corners, cubes, edges */

/* One row of the paper's table; the centre is relative to a corner. */
struct bench_object_pose {
    const char *name;
    double radius, centre[3], turn[3]; /* turn: rotation vector */
    uint64_t visited, computed, dirtied, cubes;
    const char *frames_per_s;
};
constexpr int bench_object_pose_count = 6;
extern const bench_object_pose bench_object_poses[bench_object_pose_count];

/* The tool's frame: semi-axes turned about `centre`. */
frame bench_object_frame(const double centre[3], const double semi[3], const double turn[3]);
bench_object_dab bench_object_pose_dab(const bench_object_pose &pose, key at, action kind, double amount);

std::vector<bench_object_dab> bench_object_character();
/* `times` larger along every axis: 1 makes a million corners, 2.72 twenty. */
std::vector<bench_object_dab> bench_object_million(double times = 1);

/* Corners at the outside of the surface, seen from the origin, spread evenly over all directions. */
std::vector<key> bench_object_sites(const clay &c, int count);
/* Toothpaste along a spiral over the surface, the tool turning from dab to dab: semi-axes radius x (1.25, 1, 0.8). */
std::vector<bench_object_dab> bench_object_spiral(const clay &c, double radius, double amount, int count);

#endif
