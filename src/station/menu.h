/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The menu that puck and pedals operate: rings of at most eight sectors. The puck points, apply or the menu's
 *          own press chooses, undo goes back; a number is turned up and down, and a colour mixed, while one looks.
 * Is not:  What stands in the rings (menu_tree.h); drawing (view/overlay.h); doing the commands it answers (station.h).
 * Shape:
 *              press menu -> ring -> ring -> does its commands           stays open: the next look is one push away
 *                             ^       |----> a number, a colour, a light: changed live, apply keeps it,
 *                             +- undo -+                                  undo brings back what was
 *
 *          The puck's push and tilt are one direction. A sector is pointed at once the deflection passes MENU_POINTS,
 *          and stays so when the puck springs back; another takes over MENU_MARGIN beyond the border between them.
 *          Every ring and number waits until the puck has been let go once, so that the push that chose does nothing
 *          more.
 *
 *          Numbers change at a rate that grows with the deflection's third power: far is coarse, near is fine.
 * Units:   parts of full deflection, seconds.
 * Owner:   values. The caller does the commands, in order, at once.
 * Cost:    closed: nothing. Open: a ring is made for a press and for a picture, a command a grid step.
 * Source:  ours; 000 section 2 has a menu on the screen's border and a mouse.
 */
#ifndef GLAISE_STATION_MENU_H
#define GLAISE_STATION_MENU_H

#include "station/menu_tree.h"

constexpr double MENU_POINTS = 0.35;  /* so far out the puck points */
constexpr double MENU_LET_GO = 0.15;  /* nearer in it counts as let go */
constexpr double MENU_MARGIN = 0.035; /* of a turn: more than half a sector and this away, another takes over */
constexpr double MENU_EVEN_RATE = 0.45; /* of the whole range a second, at full deflection */
constexpr double MENU_TIMES_RATE = 1.5; /* a second, likewise: 4.5 times as much after one */
constexpr double MENU_FINE = 0.06;      /* of the rate: what is left of it near the middle */
constexpr double MENU_HUE_RATE = 0.7, MENU_SHADE_RATE = 0.5; /* turns, and parts, a second */

struct menu_level {
    menu_tree_ring ring = MENU_TREE_ROOT;
    int argument = 0;
    int pointed = -1;
};

struct menu_colour {
    double hue = 0, saturation = 0, lightness = 0;
};

struct menu {
    std::vector<menu_level> way; /* from the root; empty: closed */
    snapshot_menu_kind kind = SNAPSHOT_MENU_CLOSED;
    menu_tree_entry doing;       /* VALUE, COLOUR, CARRY */
    std::vector<command> before; /* brings back what was when it began */
    bool armed = false;          /* the puck was let go since this began */
    motion_speed puck;           /* the strongest, as it is now */
    menu_colour mixed;
    uint32_t rgb_before = 0;
    std::array<uint32_t, MENU_NOW_SWATCHES> swatches;
    int name = 1;
    menu();
};

/* What is to be done now. */
struct menu_answer {
    std::vector<command> commands;
    std::string said; /* for the person */
};

bool menu_is_open(const menu &m);
/* A press with this meaning went down: opens, chooses, goes back. Others do nothing while it is open. */
menu_answer menu_press(menu *m, controls_meaning means, const menu_now_sight &sight);
/* Waits for the pedal or button that is meant: this is it. False when it does not wait. */
bool menu_learns(menu *m, const command &pedal_or_button);
/* Once every grid step. */
menu_answer menu_advance(menu *m, double seconds, const menu_now_sight &sight);
/* Shuts it; what was being changed stays as it is. */
void menu_close(menu *m);
/* What the puck carries: a light, or CONTROLS_NOTHING. */
controls_thing menu_carries(const menu &m);
snapshot_menu menu_shown(const menu &m, const menu_now_sight &sight);

/* Parts of a turn, clockwise from up, in 0..1; x to the right. The same bits everywhere. */
double menu_turn_of(double x, double y);
uint32_t menu_rgb_of(const menu_colour &c);
menu_colour menu_colour_of(uint32_t rgb);

#endif
