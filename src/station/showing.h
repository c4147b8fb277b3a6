/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    How the piece is looked at: where from, in which light, with which effects; what is held for a moment; the
 *          plane of zero parallax that follows the work. It executes the commands that concern the picture.
 * Is not:  Drawing (view); the tool and devices (hand.h, station.h).
 * Shape:   `base` is what was asked for and stays. What is held lies over it: showing_now lays it over, and when it is
 *          let go there is nothing to put back.
 *
 *              base  --what is held-->  snapshot
 *
 *          The plane of zero parallax goes to the tool's depth, where a tool is shown, else to the point looked at;
 *          at a rate of SHOWING_PLANE_RATE, so that it does not jump with the hand.
 * Units:   millimetres, seconds.
 * Owner:   values.
 * Source:  000 section 2; for the plane: 000 section 5 ("we were not able to find a good way to set" it).
 */
#ifndef GLAISE_STATION_SHOWING_H
#define GLAISE_STATION_SHOWING_H

#include "station/command.h"
#include "station/motion.h"
#include "station/snapshot.h"

#include <optional>

constexpr double SHOWING_PLANE_RATE = 2.5; /* a second: of what is left to go */
/* The plane comes no nearer and goes no farther than these parts of the camera's distance. */
constexpr double SHOWING_PLANE_NEAREST = 0.35, SHOWING_PLANE_FARTHEST = 2.5;

/* As the command `hold` names them, in its order. bare: neither tool, box, lights nor floor. */
enum showing_hold {
    SHOWING_HOLD_RAKING,
    SHOWING_HOLD_SILHOUETTE,
    SHOWING_HOLD_PLAIN,
    SHOWING_HOLD_MIRROR,
    SHOWING_HOLD_BARE,
    SHOWING_HOLDS,
};

struct showing {
    snapshot base;          /* all but the tool and the scene's shift */
    motion_vector centre{}; /* world point the eye looks at */
    double plane_part = 1;  /* where the plane of zero parallax is wanted: of the work's distance */
    double plane_mm = 0;    /* where it is; 0: not yet anywhere */
    std::array<int, SHOWING_HOLDS> held{}; /* by how many pedals, buttons, commands */
    std::string scenery_file;              /* brought and not yet taken */
};

/* A command that concerns the picture, other than picture, export and workspace-fit. */
void showing_do(showing *v, const command &c);
void showing_hold_set(showing *v, showing_hold what, bool down);
void showing_environment_next(showing *v);
/* Puts the workspace box round lo..hi, with a margin, not flatter than a part of its longest side. */
void showing_fit(showing *v, const motion_vector &lo, const motion_vector &hi);
/* The same place, seen now, whatever it moves with from here on. */
void showing_light_with(showing *v, size_t light, bool viewer);
/* Once every grid step. tool_world: where the tool is, if one is shown. */
void showing_advance(showing *v, double seconds, const motion_vector &tool_world);
/* With the scene's shift, the plane, and what is held. */
snapshot showing_now(const showing &v);

#endif
