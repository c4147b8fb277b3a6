/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Cuts the path of a tool into dabs, by distance and by time, never by frame.
 * Is not:  Undo's stroke record (history); the motion itself (motion.h).
 * Shape:   stroke_begin at the pedal's press, stroke_step at every grid point, stroke_end at its release:
 *
 *              press   grid    grid    grid       release
 *              begin   dab 1   (wait)  dabs 2..4  dab 5      each carries the time since the one before
 *
 *          The seconds of all dabs together are the time from press to release, however they were cut.
 * Units:   millimetres, seconds.
 * Source:  000 section 3.2; even strokes at any speed are ours.
 */
#ifndef GLAISE_STATION_STROKE_H
#define GLAISE_STATION_STROKE_H

#include "station/motion.h"

#include <vector>

struct stroke_dab {
    motion_pose pose;
    double seconds;
};

struct stroke_rule {
    double spacing_mm; /* at most this far apart */
    double reach_mm;   /* radius at which turning counts as moving */
    double wait_s;     /* at most this long apart */
    int most;          /* dabs in one step at most */
};

struct stroke {
    motion_pose last;
    double waiting_s = 0;
    bool fresh = true; /* nothing dabbed yet */
};

stroke stroke_begin(const motion_pose &now);
/* The tool was put elsewhere without moving through space: no dabs on the way. */
void stroke_jump(stroke *s, const motion_pose &now);
/* `seconds` went by and the tool is at `now`; appends the dabs that became due. */
void stroke_step(stroke *s, const motion_pose &now, double seconds, const stroke_rule &rule,
                 std::vector<stroke_dab> *out);
/* The last part of the path. */
void stroke_end(stroke *s, const motion_pose &now, const stroke_rule &rule, std::vector<stroke_dab> *out);

#endif
