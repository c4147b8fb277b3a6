/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What history costs: strokes of a hundred dabs through a sculpture whose undo-files lie in memory, against
 *          the same dabs with nothing recorded, and against a memcpy of the bytes that were recorded.
 * Is not:  A disk.
 * Units:   microseconds a dab, the stroke's end shared out among its dabs.
 * Errors:  as bench_rig.h.
 */
#ifndef GLAISE_BENCH_BENCH_STROKE_H
#define GLAISE_BENCH_BENCH_STROKE_H

#include "bench_clock.h"
#include "bench_record.h"
#include "bench_scene.h"

void bench_stroke_measure(bench_scene &s, bool quick, bench_clock_probe &probe, bench_record &figures);

#endif
