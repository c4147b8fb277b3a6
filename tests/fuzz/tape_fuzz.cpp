/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal    No text makes the tape's reader read outside it or accept what its writer cannot say; no accepted tape makes
 *         the station or the clay crash, leak, or give different bits when the same commands come in other frames.
 * Method  The input is the text, as an exact-size heap copy that is gone before the tape is looked at. Short tapes with
 *         small tools are then played twice on a piece of a few bricks, so that refusals are frequent, once command by
 *         command and once with frames between; what would take long is read but not played.
 */
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "station/station.h"
#include "station/tape.h"
#include "wiring/scratch_store.h"

namespace {

constexpr int64_t PLAYED_US_MAX = 2000000, FRAME_US = 16667;
constexpr size_t PLAYED_COMMANDS_MAX = 200;
constexpr double TOOL_STEPS_MAX = 8, REACH_STEPS_MAX = 10; /* larger ones cost their cube */
constexpr double TOOL_STEPS_ABSURD = 500;                  /* refused before a corner is looked at */
constexpr uint64_t VISITED_MAX = 1000000;                  /* corners in one performance */
constexpr uint32_t BRICKS = 60;
constexpr history_settings settings = {3, RING_FILE_BYTES_MIN, 1 << 24, 1 << 24, 4};

void require(bool truth)
{
    if (!truth)
        std::abort();
}

struct ending {
    uint64_t field = 0, mesh = 0;
    bool whole = true; /* false: broken off, it took too long */
};

bool all_within(const command &c, size_t first, double limit)
{
    return std::all_of(c.number.begin() + first, c.number.begin() + first + 3, [=](double v) { return std::fabs(v) <= limit; });
}

bool tool_is_quick(const command &c, double step_mm)
{
    switch (c.kind) {
    case COMMAND_SIZE:
        return all_within(c, 0, TOOL_STEPS_MAX * step_mm) ||
               *std::min_element(c.number.begin(), c.number.begin() + 3) > TOOL_STEPS_ABSURD * step_mm;
    case COMMAND_SCALE: return all_within(c, 0, 1.5);
    case COMMAND_SPACING: return c.number[0] >= 0.1;
    default: return true;
    }
}

/* Pieces far apart make a large freeform tool: whoever makes one stays near the origin, by command only. */
bool stays_near(const command &c, double step_mm)
{
    if (c.kind == COMMAND_PLACE || c.kind == COMMAND_GLIDE || c.kind == COMMAND_ORBIT)
        return all_within(c, 0, REACH_STEPS_MAX * step_mm);
    return c.kind != COMMAND_PUCK && c.kind != COMMAND_MOUSE;
}

bool is_quick(const tape &t)
{
    if (t.commands.size() > PLAYED_COMMANDS_MAX || tape_end_us(t) > PLAYED_US_MAX)
        return false;
    bool makes_tool = std::any_of(t.commands.begin(), t.commands.end(),
                                  [](const command &c) { return c.kind == COMMAND_MAKE_TOOL; });
    for (const command &c : t.commands)
        if (!tool_is_quick(c, t.step_mm) || (makes_tool && !stays_near(c, t.step_mm)))
            return false;
    return true;
}

/* The tool starts at 10 mm: it is brought down to the lattice before the tape begins. */
command size_at_start(double step_mm)
{
    command c;
    c.kind = COMMAND_SIZE;
    c.number[0] = c.number[1] = c.number[2] = std::clamp(5 * step_mm, 0.01, 10.0);
    return c;
}

ending play(const tape &t, int64_t frame_us)
{
    scratch_store scratch;
    byte_store port = scratch_store_port(&scratch);
    auto piece = std::make_unique<sculpture>();
    history_finding finding;
    require(sculpture_open(piece.get(), &port, BRICKS, &settings, t.step_mm, &finding) == STATUS_OK);
    uint64_t visited = 0;
    station_ears ears;
    ears.dab = [&](const station_dab &d) { visited += d.counts.tool.visited; };
    station *desk = station_open(piece.get(), ears);
    station_do(desk, size_at_start(t.step_mm));
    std::string said;
    int64_t end_us = tape_end_us(t);
    size_t next = 0;
    for (int64_t now_us = 0; now_us <= end_us && visited < VISITED_MAX; now_us += frame_us) {
        for (; next < t.commands.size() && t.commands[next].time_us <= now_us && visited < VISITED_MAX; next++)
            station_do(desk, t.commands[next]);
        station_advance(desk, now_us);
        while (station_message_take(desk, &said) || station_picture_take(desk, &said))
            require(!said.empty());
        snapshot shown = station_snapshot(desk);
        require(std::isfinite(shown.camera_distance) && shown.camera_distance > 0);
    }
    bool whole = visited < VISITED_MAX;
    for (; whole && next < t.commands.size(); next++)
        station_do(desk, t.commands[next]);
    if (whole)
        station_advance(desk, end_us);
    station_close(desk);
    ending e = {sculpture_digest(piece.get()), surface_digest(&piece->surface), whole && visited < VISITED_MAX};
    require(clay_brick_count(&piece->clay) <= BRICKS);
    status closed = sculpture_close(piece.get());
    require(closed == STATUS_OK);
    return e;
}

/* Wholly zero axes and non-numbers never get this far; what is written reads back as it was. */
void check_text(const tape &t)
{
    const std::string text = tape_text(t);
    tape_trouble trouble;
    std::optional<tape> back = tape_parse(text, &trouble);
    require(back.has_value());
    require(back->step_mm == t.step_mm && back->commands == t.commands);
    require(tape_text(*back) == text);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *copy = static_cast<char *>(std::malloc(size));
    if (size > 0)
        std::memcpy(copy, data, size);
    tape_trouble trouble;
    std::optional<tape> t = tape_parse(std::string_view(copy, size), &trouble);
    std::free(copy);
    if (!t) {
        require(trouble.line >= 1 && static_cast<size_t>(trouble.line) <= size + 1 && !trouble.expected.empty());
        return 0;
    }
    check_text(*t);
    if (!is_quick(*t))
        return 0;
    const ending one = play(*t, STATION_STEP_US), other = play(*t, FRAME_US);
    if (one.whole && other.whole)
        require(one.field == other.field && one.mesh == other.mesh);
    return 0;
}
