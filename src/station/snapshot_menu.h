/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What the screen says beside the picture: the menu that is open, and the strip at the bottom. Words, numbers
 *          and which picture goes with them, ready to be set.
 * Is not:  What they look like (view/overlay.h); how a menu is operated (menu.h); the rest of a picture (snapshot.h).
 * Shape:   sectors go round clockwise, sector 0 is at the top: away from the person.
 *
 *                 7  0  1
 *                 6     2      pointed: the one that the puck points at, -1 none
 *                 5  4  3
 *
 * Units:   colours as 0xrrggbb, sRGB. Words are UTF-8.
 * Owner:   values.
 */
#ifndef GLAISE_STATION_SNAPSHOT_MENU_H
#define GLAISE_STATION_SNAPSHOT_MENU_H

#include <array>
#include <cstdint>
#include <string>
#include <vector>

enum { SNAPSHOT_MENU_SECTORS = 8, SNAPSHOT_MENU_PEDALS = 3 };

enum snapshot_menu_kind {
    SNAPSHOT_MENU_CLOSED,
    SNAPSHOT_MENU_RING,
    SNAPSHOT_MENU_VALUE,  /* one number, turned up and down */
    SNAPSHOT_MENU_COLOUR, /* hue round the ring, lightness by twist, saturation by lifting */
    SNAPSHOT_MENU_CARRY,  /* a light goes with the puck */
    SNAPSHOT_MENU_LEARN,  /* waits for the pedal or button that is meant */
};

enum snapshot_menu_icon {
    SNAPSHOT_MENU_ICON_NONE,
    SNAPSHOT_MENU_ICON_BALL,
    SNAPSHOT_MENU_ICON_CUBE,
    SNAPSHOT_MENU_ICON_STAR,
    SNAPSHOT_MENU_ICON_SIZE,
    SNAPSHOT_MENU_ICON_STRETCH,
    SNAPSHOT_MENU_ICON_RATE,
    SNAPSHOT_MENU_ICON_SPACING,
    SNAPSHOT_MENU_ICON_EDGE,
    SNAPSHOT_MENU_ICON_BULGE,
    SNAPSHOT_MENU_ICON_ADD,
    SNAPSHOT_MENU_ICON_TAKE,
    SNAPSHOT_MENU_ICON_PAINT,
    SNAPSHOT_MENU_ICON_SMOOTH,
    SNAPSHOT_MENU_ICON_STAMP,
    SNAPSHOT_MENU_ICON_EYE,
    SNAPSHOT_MENU_ICON_NEARER,
    SNAPSHOT_MENU_ICON_AIM,
    SNAPSHOT_MENU_ICON_SUN,
    SNAPSHOT_MENU_ICON_MOVE,
    SNAPSHOT_MENU_ICON_LOOK,
    SNAPSHOT_MENU_ICON_PIECE,
    SNAPSHOT_MENU_ICON_UNDO,
    SNAPSHOT_MENU_ICON_REDO,
    SNAPSHOT_MENU_ICON_FORK,
    SNAPSHOT_MENU_ICON_CLEAR,
    SNAPSHOT_MENU_ICON_PICTURE,
    SNAPSHOT_MENU_ICON_EXPORT,
    SNAPSHOT_MENU_ICON_BOX,
    SNAPSHOT_MENU_ICON_PUCK,
    SNAPSHOT_MENU_ICON_PEDAL,
    SNAPSHOT_MENU_ICON_STEREO,
    SNAPSHOT_MENU_ICON_SWATCH,
    SNAPSHOT_MENU_ICON_ON,
    SNAPSHOT_MENU_ICON_OFF,
    SNAPSHOT_MENU_ICONS,
};

struct snapshot_menu_sector {
    std::string label;
    std::string value; /* what it is now; may be empty */
    snapshot_menu_icon icon = SNAPSHOT_MENU_ICON_NONE;
    uint32_t swatch = 0; /* with SNAPSHOT_MENU_ICON_SWATCH */
    bool chosen = false; /* it is so now */
    bool leads = false;  /* to another ring */
};

struct snapshot_menu {
    snapshot_menu_kind kind = SNAPSHOT_MENU_CLOSED;
    std::string title;                         /* where one is: "light 2 > strength" */
    std::vector<snapshot_menu_sector> sectors; /* SNAPSHOT_MENU_SECTORS at most */
    int pointed = -1;
    std::array<double, 2> puck{}; /* deflection, right and up, -1..1 */
    std::string value;            /* VALUE: the number with its unit */
    double number = 0, least = 0, most = 1; /* VALUE: where it is between what */
    bool times = false;           /* VALUE: twice as much is as far as from half as much */
    double push = 0;              /* VALUE: how hard it is being turned, -1..1 */
    uint32_t rgb = 0, rgb_before = 0;
    double hue = 0, saturation = 0, lightness = 0; /* COLOUR: parts of a turn clockwise from the top, and 0..1 */
    std::string how;                               /* one line: what the puck does now */
};

struct snapshot_menu_strip {
    bool shown = false;
    std::string keeping; /* "kept", "keeping ...", "NOT KEPT: disk full" */
    std::string mode;    /* what the puck holds */
    std::array<std::string, SNAPSHOT_MENU_PEDALS> pedals;
    std::array<bool, SNAPSHOT_MENU_PEDALS> pedals_down{};
    std::string action, size, rate, undo; /* undo: how many strokes lie under this one */
    uint32_t rgb = 0;
    std::string toast; /* the last message, for a while */
    std::vector<std::array<std::string, 2>> hint; /* nothing was done yet: with what, what for */
};

#endif
