/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What the picture does without when the box cannot hold its frame rate, step by step in one order, and when
 *          it takes something back.
 * Is not:  A clock: whoever draws says how long a frame took. Not a setting: what the sculptor asked for stays asked.
 * Shape:   the levels, each with all before it:
 *
 *              0   everything that is asked for
 *              1   no depth of field
 *              2   shadows and hollows from fewer looks
 *              3   hollows are not darker
 *              4   no shadows
 *              5   half as many samples a pixel
 *              6   three quarters of the pixels each way
 *              7   half the pixels each way
 *
 *          Down one when QUALITY_LATE of the last QUALITY_WINDOW frames took longer than a frame may; up one when for
 *          QUALITY_CALM frames all took less than QUALITY_ROOM of it. Where going up was followed by going down within
 *          QUALITY_CALM frames, the next try waits twice as long, up to QUALITY_WAIT_MAX times.
 * Units:   nanoseconds, frames.
 * Owner:   values.
 */
#ifndef GLAISE_VIEW_QUALITY_H
#define GLAISE_VIEW_QUALITY_H

#include "station/snapshot.h"

#include <cstdint>

enum { QUALITY_LEVELS = 8, QUALITY_WINDOW = 30, QUALITY_LATE = 20, QUALITY_CALM = 240, QUALITY_WAIT_MAX = 16 };
constexpr int64_t QUALITY_FRAME_NS = 16666667; /* at 60 Hz */
constexpr double QUALITY_ROOM = 0.6;

struct quality {
    int level = 0;
    int64_t frame_ns = QUALITY_FRAME_NS;
    int frames = 0, late = 0; /* in the window under way */
    int calm = 0;             /* frames with room, in a row */
    int wait = 1;             /* how many times QUALITY_CALM */
    int since_up = 0;         /* frames; 0: none is to be judged */
};

struct quality_rules {
    bool blur = true;
    int shadow_taps = 0, hollow_taps = 0; /* 0: none */
    int samples = 0;                      /* at most */
    double scale = 1;                     /* of the picture's sides */
};

/* True when the level has changed. */
bool quality_frame(quality *q, int64_t took_ns);
quality_rules quality_rules_of(int level);
/* What is left out at this level, for the person: "no depth of field, ..."; empty at 0. */
const char *quality_text(int level);

#endif
