/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What everything that a menu can set is now, as the command that would set it so.
 * Is not:  Doing commands (station.h); which menu sets what (menu_tree.h).
 * Shape:   a menu changes one number of such a command and has it done; what it was before brings everything back as
 *          it was, to the last bit.
 * Units:   as in the commands.
 * Owner:   values; a sight is only good for the moment it was made for.
 */
#ifndef GLAISE_STATION_MENU_NOW_H
#define GLAISE_STATION_MENU_NOW_H

#include "station/controls.h"
#include "station/hand.h"
#include "station/showing.h"

enum { MENU_NOW_SWATCHES = 7 };

/* What a menu sees of the station. */
struct menu_now_sight {
    const hand *tool = nullptr;
    const showing *shown = nullptr;
    const controls *devices = nullptr;
    bool has_piece = false; /* there is clay, in lo..hi, mm */
    motion_vector lo{}, hi{};
    std::array<uint32_t, MENU_NOW_SWATCHES> swatches{}; /* the last colours, newest first */
    int name = 1;                                       /* the number that the next picture or export is called by */
};

/* index: of a light, a device, a pedal, a button, where the command has one. Only for commands that set something. */
command menu_now(const menu_now_sight &sight, command_kind kind, int index = 0);
/* The commands that bring back what a command of this kind may change. */
std::vector<command> menu_now_all(const menu_now_sight &sight, command_kind kind, int index = 0);
/* A command out of text that is known to be one. */
command menu_now_line(const std::string &text);

uint32_t menu_now_rgb(const std::array<float, 3> &colour);

#endif
