/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What does not go dab by dab: the whole surface by every engine, memory a corner, what memcpy moves, and the
 *          soak: a hundred thousand dabs under which memory must stay flat.
 * Is not:  Dabs (bench_dabs.h), history (bench_stroke.h).
 * Units:   seconds and bytes inside, what the tables say outside.
 * Errors:  as bench_rig.h: another number of triangles (by more than one in a hundred) ends the program.
 */
#ifndef GLAISE_BENCH_BENCH_WHOLE_H
#define GLAISE_BENCH_BENCH_WHOLE_H

#include "bench_clock.h"
#include "bench_record.h"
#include "bench_scene.h"

/* Bytes read and written by memcpy in a second, best of several: blocks that stay in cache, blocks that do not. */
struct bench_whole_bandwidth {
    double cache, memory;
};
bench_whole_bandwidth bench_whole_measure_bandwidth(bench_record &figures);

void bench_whole_measure(bench_scene &s, bool quick, bench_clock_probe &probe, bench_record &figures);
/* Adds, erases and smooths all over the object; answers whether memory stayed flat after the first tenth. */
bool bench_whole_soak(bench_scene &s, int dabs, bench_record &figures);

#endif
