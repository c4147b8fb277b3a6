/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What pucks, pedals and buttons do: which moves what and how fast, what a press means, what is held down.
 * Is not:  What a press then causes (station.h); menus (menu.h); drivers (platform).
 * Shape:   a press keeps the meaning it went down with until it comes up, whatever was changed in between. One that a
 *          menu took is nobody else's on its way up:
 *
 *              down --taken? no--> its meaning, down ... up --> the same meaning, up
 *                          yes--> the menu               up --> nothing
 *
 * Units:   millimetres and degrees a second, at a camera distance of 200 mm; counts of the HID frame.
 * Owner:   values.
 */
#ifndef GLAISE_STATION_CONTROLS_H
#define GLAISE_STATION_CONTROLS_H

#include "station/command.h"
#include "station/motion.h"

enum { CONTROLS_PUCKS = 8, CONTROLS_PEDALS = 8, CONTROLS_BUTTONS = 32 };

/* As the command `moves` names them, in its order; one more for each further light. */
enum controls_thing : int { CONTROLS_NOTHING, CONTROLS_SCENE, CONTROLS_TOOL, CONTROLS_LIGHT0 };

/* As the commands means-pedal and means-button name them, in their order. */
enum controls_meaning : int {
    CONTROLS_MEANS_NOTHING,
    CONTROLS_MEANS_APPLY,
    CONTROLS_MEANS_UNDO,
    CONTROLS_MEANS_REDO,
    CONTROLS_MEANS_CLUTCH,
    CONTROLS_MEANS_NEXT_ACTION,
    CONTROLS_MEANS_FORK,
    CONTROLS_MEANS_ENVIRONMENT_NEXT,
    CONTROLS_MEANS_MENU,
    CONTROLS_MEANS_HOLD, /* from here on: as showing_hold has them */
};

/* One pedal or button, as it is now. */
struct controls_press {
    controls_meaning means = CONTROLS_MEANS_NOTHING;
    controls_meaning went_down_as = CONTROLS_MEANS_NOTHING;
    bool held = false, taken = false;
};

struct controls {
    std::array<std::array<int16_t, 6>, CONTROLS_PUCKS> puck{};
    std::array<controls_thing, 1 + CONTROLS_PUCKS> moves{}; /* mouse, then pucks */
    std::array<controls_press, CONTROLS_PEDALS> pedal{};
    std::array<controls_press, CONTROLS_BUTTONS> button{};
    motion_filter filter;
    double speed_mm = 90, speed_degrees = 90;
    bool clutch = false;
};

controls controls_at_first();
/* moves, means-pedal, means-button, speed, filter, and puck. */
void controls_do(controls *d, const command &c);
/* The press that a pedal or button command is about; NULL for a button beyond CONTROLS_BUTTONS. */
controls_press *controls_press_of(controls *d, const command &c);
/* What the edge means; CONTROLS_MEANS_NOTHING where a menu had taken the press. `taken`: a menu takes it now. */
controls_meaning controls_edge(controls_press *p, bool down, bool taken);
/* What a puck moves now: the clutch exchanges tool and scene. */
controls_thing controls_moved(const controls &d, size_t puck);
/* How many pedals and buttons mean this. */
int controls_count(const controls &d, controls_meaning means);

#endif
