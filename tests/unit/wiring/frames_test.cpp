/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the same device reports give the same field, bit for bit, wherever frames fall between them. Method: recordings of
   two kinds of device are decoded by the driver's own parser and fed to stations whose frames come at 30, 60 and 144 a
   second, at random, and with stalls; a frame delivers what arrived before it and then lets time pass up to itself. */
#include "station/station.h"
#include "wiring/playlist.h"
#include "wiring/scratch_store.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <memory>
#include <random>

namespace {

struct outcome {
    uint64_t field = 0, mesh = 0, corners = 0, strokes = 0;
    bool operator==(const outcome &) const = default;
};

/* next_frame: microseconds until the next frame. */
template <typename frames> outcome play(const std::vector<command> &commands, frames next_frame)
{
    scratch_store scratch;
    byte_store port = scratch_store_port(&scratch);
    auto piece = std::make_unique<sculpture>();
    history_finding finding;
    EXPECT_EQ(sculpture_open(piece.get(), &port, 50000, nullptr, 1.0, &finding), STATUS_OK);
    station *desk = station_open(piece.get(), {});
    int64_t end_us = commands.back().time_us + 100000;
    size_t next = 0;
    for (int64_t frame_us = 0; frame_us < end_us;) {
        frame_us = std::min(end_us, frame_us + next_frame());
        for (; next < commands.size() && commands[next].time_us <= frame_us; next++)
            station_do(desk, commands[next]);
        station_advance(desk, frame_us);
    }
    station_close(desk);
    outcome out{sculpture_digest(piece.get()), surface_digest(&piece->surface), piece->clay.corners, piece->strokes};
    EXPECT_EQ(sculpture_close(piece.get()), STATUS_OK);
    return out;
}

std::vector<command> recording(const std::string &name)
{
    std::string bytes, text;
    std::vector<command> commands;
    std::string path = std::string(SOURCE_ROOT) + "/tests/golden/recordings/" + name;
    EXPECT_TRUE(playlist_file(path, &bytes, &text)) << text;
    EXPECT_TRUE(playlist_decode(bytes, 0, 0, &commands, &text)) << text;
    return commands;
}

class frames : public testing::TestWithParam<const char *> {
};

} // namespace

TEST_P(frames, do_not_matter)
{
    std::vector<command> commands = recording(GetParam());
    ASSERT_GT(commands.size(), 500u);
    outcome steady = play(commands, [] { return 16667; });
    EXPECT_GE(steady.strokes, 1u);
    EXPECT_GT(steady.corners, 1000u);
    EXPECT_EQ(play(commands, [] { return 33333; }), steady);
    EXPECT_EQ(play(commands, [] { return 6944; }), steady);
    const int seeds = getenv("GLAISE_LONG") ? 200 : 6;
    for (int seed = 0; seed < seeds; seed++) {
        std::mt19937_64 random(static_cast<uint64_t>(seed));
        auto jittery = [&random] {
            bool stall = random() % 40 == 0;
            return static_cast<int64_t>(stall ? 100000 + random() % 900000 : 1 + random() % 40000);
        };
        EXPECT_EQ(play(commands, jittery), steady) << "seed " << seed;
    }
}

TEST_P(frames, but_the_reports_do)
{
    std::vector<command> commands = recording(GetParam());
    outcome whole = play(commands, [] { return 16667; });
    for (command &c : commands)
        if (c.kind == COMMAND_PUCK && c.time_us > commands.back().time_us / 2)
            c.number[1] += 25;
    EXPECT_FALSE(play(commands, [] { return 16667; }) == whole);
}

INSTANTIATE_TEST_SUITE_P(recordings, frames, testing::Values("spacenavigator.hid", "spacemouse_wireless.hid"));
