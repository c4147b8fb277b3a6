/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A tape: commands with their times, as plain text that a person can write by hand, and that records and
 *          replays everything: tests, demonstrations, bug reports and settings are tapes.
 * Is not:  The commands' meaning (command.h lists them all; `glaise --help` prints that list).
 * Shape:   line by line, UTF-8:
 *
 *              glaise tape 1                first line
 *              # anything                   a comment; also after a command, behind " #"
 *              step 0.5                     lattice step in mm (at most once, before any command; otherwise 1)
 *              @1500 place 0 10 0           at 1500 ms
 *              +40 apply down               40 ms after the line before
 *              +0 glide 30 10 0 800         at the same time as the line before
 *
 *          Times may have decimals down to a microsecond and never go back. Replaying ends when the last motion that
 *          was asked for has ended.
 * Units:   ms in text, microseconds in memory.
 * Errors:  line number and what was expected; a tape is taken whole or not at all.
 */
#ifndef GLAISE_STATION_TAPE_H
#define GLAISE_STATION_TAPE_H

#include "station/command.h"

constexpr int64_t TAPE_TIME_MAX_US = 24LL * 3600 * 1000000; /* a day: longer is a mistake in the writing */

struct tape {
    double step_mm = 1;
    std::vector<command> commands;
};

struct tape_trouble {
    int line = 0;
    std::string expected;
};

std::optional<tape> tape_parse(std::string_view text, tape_trouble *trouble_out);
std::string tape_text(const tape &t);
/* When the last motion it asks for has ended. */
int64_t tape_end_us(const tape &t);

#endif
