/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   what history_keep acknowledged survives a power cut at any instant, and what comes back is a state that was.
 * Method: lives of chance on a simulated disk. At every call that changes something on it, before and after it did its
 *         work, the power goes: the disk as it may then be is opened and compared with a book of all that was made. The
 *         same life goes on to real ends: cuts, and the program's death without one.
 */
#include "tests/crash/crash_life.h"

#include <cstdio>

namespace {

/* Lives of one kind, the same number of seeds after each other. */
void live(const char *what, uint64_t lives, const crash_life_kind &kind)
{
    const crash_life_count before = crash_life_counted;
    const uint64_t first = crash_life_seed();
    for (uint64_t n = 0; n < (lives * crash_life_factor() + SIM_DISK_THIN - 1) / SIM_DISK_THIN; n++) {
        ASSERT_NO_FATAL_FAILURE(crash_life_run(first + n, kind));
        if (testing::Test::HasFailure())
            return;
    }
    const crash_life_count &now = crash_life_counted;
    const uint64_t points = now.points - before.points;
    std::printf("%s: seed %llu, %llu lives, %llu crash points, %llu recoveries, %llu cuts, %llu kills, "
                "%llu losses of which %llu told\n",
                what, static_cast<unsigned long long>(first), static_cast<unsigned long long>(now.lives - before.lives),
                static_cast<unsigned long long>(points),
                static_cast<unsigned long long>(now.recoveries - before.recoveries),
                static_cast<unsigned long long>(now.cuts - before.cuts),
                static_cast<unsigned long long>(now.kills - before.kills),
                static_cast<unsigned long long>(now.losses - before.losses),
                static_cast<unsigned long long>(now.losses_told - before.losses_told));
    testing::Test::RecordProperty("crash_points", std::to_string(points));
}

TEST(crash, small_rings)
{
    live("small rings", 60, {});
}

/* Records of one block, many of them in a file: what a cut leaves over fits behind what comes next. */
TEST(crash, many_small_records)
{
    crash_life_kind kind;
    kind.corners = 2;
    kind.large = 0;
    kind.keep_rate = 0.3;
    kind.starts = 12;
    kind.steps = 10;
    kind.probe_rate = 0.3;
    live("many small records", 100, kind);
}

TEST(crash, large_strokes)
{
    crash_life_kind kind;
    kind.large = 0.6;
    kind.corners = 600;
    live("large strokes", 20, kind);
}

TEST(crash, large_clay_in_slices)
{
    crash_life_kind kind;
    kind.dense_bricks = 300;
    kind.bricks = 700;
    kind.starts = 3;
    kind.steps = 20;
    kind.probe_rate = 0.1;
    live("large clay", 4, kind);
}

TEST(crash, failing_medium)
{
    crash_life_kind kind;
    kind.fault_rate = 0.15;
    kind.probe_rate = 0.4;
    live("failing medium", 15, kind);
}

TEST(crash, failing_medium_and_kills)
{
    crash_life_kind kind;
    kind.fault_rate = 0.5;
    kind.kill_rate = 0.9;
    kind.probe_rate = 0.4;
    kind.steps = 10;
    kind.starts = 8;
    live("failing medium, kills", 20, kind);
}

TEST(crash, full_medium)
{
    crash_life_kind kind;
    kind.fills_up = true;
    live("full medium", 40, kind);
}

TEST(crash, lying_medium)
{
    crash_life_kind kind;
    kind.lie_rate = 0.3;
    kind.probe_rate = 0.3;
    live("lying medium", 200, kind);
}

} // namespace
