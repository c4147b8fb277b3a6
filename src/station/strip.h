/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The words of the strip at the bottom of the screen: what is kept, what the puck holds, what each pedal will
 *          do now, the tool; and the card that says how to begin, until something was done.
 * Is not:  Drawing (view/overlay.h); the menu (menu.h).
 * Units:   microseconds of the grid.
 * Owner:   values.
 */
#ifndef GLAISE_STATION_STRIP_H
#define GLAISE_STATION_STRIP_H

#include "station/menu.h"

constexpr int64_t STRIP_TOAST_US = 6000000; /* a sentence is read in this, twice */

struct strip_sight {
    const controls *devices;
    const hand *tool;
    const menu *open;
    keeper_facts facts;
    bool has_history, in_stroke, begun; /* begun: a stroke was made */
    std::string told;                   /* the last message, and when; "" none */
    int64_t told_us, now_us;
};

/* All but `shown`, which is a setting. */
snapshot_menu_strip strip_now(const strip_sight &s);

#endif
