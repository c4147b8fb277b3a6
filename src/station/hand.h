/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The tool in the hand: its shape, size, action, colour and rate, its pose, and the glides that carry it.
 * Is not:  One dab (tool.h) or the path's cutting (stroke.h).
 * Shape:   one ellipsoid and one freeform tool (with its own surface, for drawing); `shape` says which is held.
 * Units:   millimetres.
 * Owner:   hand owns the freeform tool and its surface.
 * Source:  000 sections 2, 4.1.
 */
#ifndef GLAISE_STATION_HAND_H
#define GLAISE_STATION_HAND_H

#include "station/motion.h"
#include "station/stroke.h"

#include "sculpture/sculpture.h"

enum hand_shape { HAND_ELLIPSOID, HAND_BOX, HAND_FREEFORM };

enum hand_glide_kind { HAND_GLIDE_NONE, HAND_GLIDE_LINE, HAND_GLIDE_ORBIT, HAND_GLIDE_SPIN };

/* A motion asked for at start_us that ends at end_us. */
struct hand_glide {
    hand_glide_kind kind = HAND_GLIDE_NONE;
    int64_t start_us = 0, end_us = 0;
    motion_pose from;
    motion_vector to{}, axis{}; /* line: where to; orbit: a point of its axis */
    double radians = 0;
};

struct hand {
    hand_shape shape = HAND_ELLIPSOID;
    motion_vector size_mm{10, 10, 10};
    motion_vector scale{1, 1, 1};
    double border = 0.2, spacing = 0.25, rate = 6;
    uint32_t rgba = colour_pack(0xc8, 0x7a, 0x50, 255);
    action kind = ACTION_TOOTHPASTE;
    deform def = deform_default();

    motion_pose pose;
    hand_glide carry, spin; /* a line or an orbit, and a spin beside it */

    bool has_freeform = false;
    freeform made{};
    surface made_surface{};
    double made_step_mm = 1;
    ellipsoid round{};
};

void hand_finish(hand *h);
/* Duplicates the clay as the freeform tool; the one before is given back only when that worked. */
STATUS_CHECKED status hand_make_tool(hand *h, const sculpture *piece);
/* Poses at time_us; a glide that has ended is over. */
void hand_advance(hand *h, int64_t time_us);
/* The tool as the engine wants it, for a lattice of step_mm. Refers into h. */
tool hand_tool(hand *h, double step_mm);
frame hand_frame(const hand *h, const motion_pose &at);
stroke_rule hand_rule(const hand *h);

#endif
