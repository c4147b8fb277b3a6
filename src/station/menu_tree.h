/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Every ring of the menu: what stands in its sectors, and what each of them does. All that the station can do
 *          is found here, or tests/unit/station/menu_tree_test.cpp says why it is not.
 * Is not:  How a ring is operated (menu.h); what it looks like (view/overlay.h).
 * Shape:   a ring is made for the moment, out of what the station is now:
 *
 *              tool     size shape stretch rate spacing edge bulge place
 *              action   one sector each
 *              colour   mix, and the last seven
 *              view     from six sides, fit, nearer
 *              light    1 2 3 4, scenery, glaze, shine, lamps
 *              look     looks, structure, hollows, shadows, floor, blur, mirror, stereo
 *              piece    undo redo fork clear picture export workspace
 *              station  who moves what, pedals and buttons, feel, screen
 *
 * Units:   as in the commands.
 * Owner:   values.
 */
#ifndef GLAISE_STATION_MENU_TREE_H
#define GLAISE_STATION_MENU_TREE_H

#include "station/menu_now.h"

enum menu_tree_ring {
    MENU_TREE_ROOT,
    MENU_TREE_TOOL,
    MENU_TREE_SHAPE,
    MENU_TREE_STRETCH,
    MENU_TREE_BULGE,
    MENU_TREE_PLACE,
    MENU_TREE_STYLE,
    MENU_TREE_ACTION,
    MENU_TREE_COLOUR, /* argument: a light, or MENU_TREE_OF_TOOL */
    MENU_TREE_VIEW,
    MENU_TREE_LIGHTS,
    MENU_TREE_LIGHT, /* argument: which */
    MENU_TREE_SCENERY,
    MENU_TREE_GLAZE,
    MENU_TREE_SHINE,
    MENU_TREE_LOOK,
    MENU_TREE_LOOKS,
    MENU_TREE_STRUCTURE,
    MENU_TREE_STEREO,
    MENU_TREE_STEREO_SIDE,
    MENU_TREE_STEREO_TOP,
    MENU_TREE_STEREO_WOVEN,
    MENU_TREE_PIECE,
    MENU_TREE_CLEAR,
    MENU_TREE_EXPORT,
    MENU_TREE_WORKSPACE,
    MENU_TREE_STATION,
    MENU_TREE_MOVES,
    MENU_TREE_MOVED, /* argument: the device */
    MENU_TREE_MEANS, /* argument: a pedal, or MENU_TREE_BUTTON and on */
    MENU_TREE_MEANS_MORE,
    MENU_TREE_FEEL,
    MENU_TREE_SCREEN,
    MENU_TREE_RINGS,
};

enum { MENU_TREE_OF_TOOL = -1, MENU_TREE_BUTTON = 100 };

enum menu_tree_entry_kind {
    MENU_TREE_LEADS,  /* to ring, argument */
    MENU_TREE_DOES,   /* lines */
    MENU_TREE_VALUE,  /* value, turned up and down */
    MENU_TREE_MIXES,  /* a colour: of the tool, or of light `argument` */
    MENU_TREE_CARRIES, /* light `argument` */
    MENU_TREE_LEARNS, /* which pedal or button is meant */
    MENU_TREE_BACK,
};

enum menu_tree_law {
    MENU_TREE_EVEN,  /* so much a second */
    MENU_TREE_TIMES, /* so many times as much a second; all numbers by the same factor */
    MENU_TREE_BOX,   /* X0 Y0 Z0 X1 Y1 Z1 about the middle of its bottom, by a factor */
};

/* Numbers first..last of a command, between least and most. */
struct menu_tree_value {
    command_kind kind = COMMAND_SIZE;
    int index = 0;
    size_t first = 0, last = 0;
    menu_tree_law law = MENU_TREE_EVEN;
    double least = 0, most = 1;
    double shown_times = 1; /* 100: as a percentage */
    const char *unit = "";
};

struct menu_tree_entry {
    menu_tree_entry_kind kind = MENU_TREE_DOES;
    std::string label, value;
    snapshot_menu_icon icon = SNAPSHOT_MENU_ICON_NONE;
    uint32_t swatch = 0;
    bool chosen = false; /* it is so now */
    bool closes = false; /* the menu, once it is done: there is sculpting to do with it */
    menu_tree_ring ring = MENU_TREE_ROOT;
    int argument = 0;
    std::vector<std::string> lines; /* commands */
    menu_tree_value turned;
};

struct menu_tree_page {
    std::string title;
    std::vector<menu_tree_entry> entries; /* SNAPSHOT_MENU_SECTORS at most */
};

menu_tree_page menu_tree_make(menu_tree_ring which, int argument, const menu_now_sight &sight);
/* The number as a person reads it: "12.4 mm". */
std::string menu_tree_text(const menu_tree_value &v, const command &now);
/* The numbers' size, on which `part` and the text are based. */
double menu_tree_number(const menu_tree_value &v, const command &now);
/* The word that a command's argument has for a number: "toothpaste"; lights are counted from 1. */
std::string menu_tree_word(command_kind kind, size_t argument, double number);

#endif
