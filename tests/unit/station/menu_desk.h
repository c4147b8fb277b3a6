/* SPDX-License-Identifier: Apache-2.0 */
/* A station with a menu on button 0 and pedals as they are shipped, operated as a person would: nudges and presses. */
#ifndef GLAISE_TESTS_STATION_MENU_DESK_H
#define GLAISE_TESTS_STATION_MENU_DESK_H

#include "bench_desk.h"

#include "station/angle.h"

#include <cmath>

struct menu_desk : bench_desk {
    double now_ms = 0;

    menu_desk()
    {
        do_line("means-button 0 menu");
        do_line("means-pedal 2 clutch");
    }
    void do_line(const std::string &line) { at(now_ms, line); }
    void wait(double ms) { until(now_ms += ms); }
    /* By push alone, in parts of full deflection. */
    void push(double right, double away)
    {
        do_line("puck 0 " + std::to_string(std::lround(350 * right)) + " " + std::to_string(std::lround(-350 * away)) +
                " 0 0 0 0");
        wait(20);
    }
    void let_go() { push(0, 0); }
    void press(const std::string &what)
    {
        do_line(what + " down");
        do_line(what + " up");
        wait(20);
    }
    void open() { press("button 0 0"); }
    void apply() { press("pedal 0"); }
    void back() { press("pedal 1"); }
    snapshot_menu menu() const { return station_snapshot(desk).menu; }
    /* Pushes towards a sector, lets go. */
    void nudge(size_t sector)
    {
        const double angle = 2 * ANGLE_PI * static_cast<double>(sector) / static_cast<double>(menu().sectors.size());
        push(0.8 * std::sin(angle), 0.8 * std::cos(angle));
        let_go();
    }
    /* Chooses the sector with this label. */
    void choose(const std::string &label)
    {
        const auto sectors = menu().sectors;
        for (size_t n = 0; n < sectors.size(); n++)
            if (sectors[n].label == label) {
                nudge(n);
                EXPECT_EQ(menu().pointed, static_cast<int>(n)) << label;
                apply();
                return;
            }
        ADD_FAILURE() << "no \"" << label << "\" in " << menu().title;
    }
};

#endif
