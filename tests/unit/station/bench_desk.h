/* SPDX-License-Identifier: Apache-2.0 */
/* A station on a small piece without history, driven by lines of a tape: what station tests share. */
#ifndef GLAISE_TESTS_STATION_BENCH_DESK_H
#define GLAISE_TESTS_STATION_BENCH_DESK_H

#include "station/station.h"

#include <gtest/gtest.h>
#include <memory>

struct bench_desk {
    std::unique_ptr<sculpture> piece = std::make_unique<sculpture>();
    station *desk = nullptr;
    std::vector<station_dab> dabs;
    int64_t now_us = 0;

    explicit bench_desk(uint32_t bricks = 20000)
    {
        history_finding finding;
        status s = sculpture_open(piece.get(), nullptr, bricks, nullptr, 1.0, &finding);
        EXPECT_EQ(s, STATUS_OK);
        station_ears ears;
        ears.records = true;
        ears.dab = [this](const station_dab &d) { dabs.push_back(d); };
        desk = station_open(piece.get(), ears);
    }
    bench_desk(const bench_desk &) = delete;
    ~bench_desk()
    {
        station_close(desk);
        EXPECT_EQ(sculpture_close(piece.get()), STATUS_OK);
    }

    void at(double ms, const std::string &line)
    {
        std::string expected;
        std::optional<command> c = command_parse(line, &expected);
        ASSERT_TRUE(c) << line << ": " << expected;
        c->time_us = static_cast<int64_t>(ms * 1000);
        station_do(desk, *c);
    }
    void until(double ms) { station_advance(desk, static_cast<int64_t>(ms * 1000)); }
    std::array<double, 3> place() const
    {
        snapshot s = station_snapshot(desk);
        return {s.tool_world.origin[0], s.tool_world.origin[1], s.tool_world.origin[2]};
    }
    std::string message()
    {
        std::string text;
        return station_message_take(desk, &text) ? text : "";
    }
};

#endif
