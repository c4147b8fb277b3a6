/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What a replay did, dab by dab: the paper's counts, microseconds by stage, digests; as JSON and as a few
 *          lines for the person.
 * Is not:  A benchmark (tests/bench): one run's times on a busy machine are only that.
 * Shape:   JSON: {"glaise", "step_mm", totals..., "field_digest", "mesh_digest", "dab": [{...}, ...]}; digests are 16
 *          hexadecimal digits, times microseconds with decimals. `triangles` of a dab are those after it.
 */
#ifndef GLAISE_WIRING_STATISTICS_H
#define GLAISE_WIRING_STATISTICS_H

#include "station/station.h"

#include <string>
#include <vector>

struct statistics_line {
    station_dab dab;
    uint64_t triangles = 0, field_digest = 0, mesh_digest = 0;
};

struct statistics {
    bool every_dab = false; /* keep lines with digests (JSON was asked for) */
    std::vector<statistics_line> lines;
    std::vector<float> dab_us;
    uint64_t dabs = 0, refused = 0, strokes = 0, history_steps = 0;
    uint64_t visited = 0, computed = 0, dirtied = 0, treated = 0;
    double field_us = 0, surface_us = 0, history_us = 0;
};

void statistics_dab(statistics *s, const station_dab &d, sculpture *piece);
void statistics_stroke(statistics *s, int64_t history_ns);
std::string statistics_json(const statistics &s, sculpture *piece);
std::string statistics_text(const statistics &s, const sculpture *piece);

#endif
