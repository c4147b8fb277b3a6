/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The person's state: which tool is in the hand and where, what each device moves, which pedals are down,
 *          how the scene is looked at. It executes commands, integrates poses over real time and cuts strokes into
 *          dabs.
 * Is not:  Drawing (view reads a snapshot); files, devices, clocks (wiring brings them); the clay (sculpture.h).
 * Shape:   time runs on a grid of STATION_STEP_US, absolute from 0. At each grid point, in this order: devices move
 *          what they move, glides carry the tool, a stroke under way may dab.
 *
 *              command     command        command
 *          ------v-----------v--------------v------> time
 *          |     |     |     |     |     |     |     grid: the only times at which anything moves
 *
 *          A command acts at its own time, so its consequence is seen at the next grid point; where frames fall between
 *          them cannot matter. A stroke dabs when the tool has moved by `spacing`, or every STATION_DAB_US; a tool
 *          faster than that is dabbed along its way.
 * Units:   microseconds; millimetres.
 * Owner:   the caller owns sculpture and station; the station ends a stroke under way when it is closed.
 * Errors:  a command that the clay refuses leaves everything as it was and says so in a message (station_message_take).
 *          Commands come in order of time (asserted).
 * Cost:    a grid point without motion: some nanoseconds.
 * Source:  000 section 2.
 */
#ifndef GLAISE_STATION_STATION_H
#define GLAISE_STATION_STATION_H

#include "station/command.h"
#include "station/snapshot.h"

#include <functional>

constexpr int64_t STATION_STEP_US = 4000; /* 250 a second: twice the SpaceNavigator's own rate */
constexpr int64_t STATION_DAB_US = 40000; /* a tool at rest dabs so often */
constexpr int64_t STATION_PART_US = 60000; /* a stroke is handed on so often: kept within 100 ms and a sync */
constexpr int STATION_DABS_A_STEP = 256;  /* a tool that jumps far in one step is dabbed no denser than this */

struct station;

/* What became of one dab. */
struct station_dab {
    int64_t time_us = 0;
    uint64_t stroke = 0; /* 1 the first */
    status outcome = STATUS_OK;
    sculpture_counts counts{};
    int64_t field_ns = 0, surface_ns = 0; /* by the clock that was given */
};

/* One full turn of the piece in so many pictures. */
struct station_turntable {
    std::string name;
    int frames = 1;
};

struct station_ears {
    bool counts = false;                           /* count dabs as the paper does: takes longer than the dabs */
    bool records = false;                          /* remember everything that is done (station_recording): grows */
    std::function<int64_t()> clock_ns;             /* for the two times above; none: they stay 0 */
    std::function<void(const station_dab &)> dab;  /* after every dab */
    std::function<void(status, int64_t history_ns)> stroke; /* after every stroke, undo, redo and clear */
};

station *station_open(sculpture *piece, station_ears ears);
void station_close(station *s); /* ends a stroke under way; NULL is fine */

/* Moves to time_us, then executes c at its own time. */
void station_do(station *s, const command &c);
/* Moves everything up to and including time_us. Once a frame at the least. */
void station_advance(station *s, int64_t time_us);
/* Does a step through history (undo, redo, fork) still wait for the medium? Until then time stands still for the clay:
   what comes in waits. station_do and station_advance do not ask, they wait themselves. */
bool station_is_waiting(station *s);

snapshot station_snapshot(const station *s);
bool station_is_applying(const station *s);
/* Pictures that were asked for and not yet taken: name of the next, false when none. */
bool station_picture_take(station *s, std::string *name_out);
/* Turns that were asked for, likewise. */
bool station_turntable_take(station *s, station_turntable *out);
/* Files of the piece that were asked for, likewise. */
bool station_export_take(station *s, std::string *name_out);
/* The picture that was brought as scenery, likewise. */
bool station_scenery_take(station *s, std::string *name_out);
/* Sentences for the person, oldest first; false when none. */
bool station_message_take(station *s, std::string *text_out);
/* Everything done since opening, as a tape's commands would have it; nothing where nobody asked for it. */
const std::vector<command> &station_recording(const station *s);

#endif
