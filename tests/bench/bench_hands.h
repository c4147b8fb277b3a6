/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What a second thread brings: toothpaste dabs of every radius by one hand and by two, turn and turn about.
 * Is not:  Beside other engines (bench_dabs.h): those have one thread.
 * Units:   microseconds a dab, median over rounds; the ratio is the median of the rounds' own.
 * Errors:  as bench_rig.h; the two must leave the same bits.
 */
#ifndef GLAISE_BENCH_BENCH_HANDS_H
#define GLAISE_BENCH_BENCH_HANDS_H

#include "bench_record.h"
#include "bench_scene.h"

/* No probe may hold the calling thread to one core. */
void bench_hands_measure(bench_scene &s, bool quick, bench_record &figures);

#endif
