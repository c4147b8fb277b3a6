/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What long work costs those who sculpt meanwhile: dabs of R = 16 alone, and while the piece is saved, exported
 *          and another one opened, each on a thread of its own.
 * Is not:  The dabs themselves (bench_dabs.h).
 * Units:   microseconds a dab; milliseconds for freezing and thawing; seconds for the work.
 */
#ifndef GLAISE_BENCH_BENCH_LONG_H
#define GLAISE_BENCH_BENCH_LONG_H

#include "bench_record.h"
#include "bench_scene.h"

void bench_long_measure(bench_scene &s, bool quick, bench_record &figures);

#endif
