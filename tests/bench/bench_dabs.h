/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The rows of the workload: dabs of one radius and one action along a spiral over an object, by us and, on the
 *          same dabs, by OpenVDB and the paper's trees; field and surface timed apart.
 * Is not:  The whole surface, memory, history (bench_whole.h, bench_stroke.h).
 * Shape:   a round = the same slice of the spiral by each engine in turn. Rounds in which the machine was somebody
 *          else's are thrown away, until five are kept or fifteen were tried; where fewer are kept the least disturbed
 *          fill up, and the row says so. Median over the dabs of a round, then median over rounds; ratios likewise.
 * Units:   microseconds where a name says so.
 * Owner:   the caller.
 * Errors:  as bench_rig.h: engines that did different work end the program.
 */
#ifndef GLAISE_BENCH_BENCH_DABS_H
#define GLAISE_BENCH_BENCH_DABS_H

#include "bench_clock.h"
#include "bench_record.h"
#include "bench_scene.h"

struct bench_dabs_setting {
    bool quick = false;
    int threads = 1;
    double cache_bytes_per_s = 0, memory_bytes_per_s = 0; /* what memcpy moves: bench_whole.h */
};

struct bench_dabs_row {
    double radius, amount;
    action kind;
    lanes rows;
};

/* The speed table's radii and strengths, four actions each; radius 0: all. */
std::vector<bench_dabs_row> bench_dabs_rows(double radius);
void bench_dabs_print_head(const bench_scene &s);
/* Measures the row on the object as it was and prints it. */
void bench_dabs_measure(bench_scene &s, const bench_dabs_row &row, const bench_dabs_setting &set,
                        bench_clock_probe &probe, bench_record &figures);

#endif
