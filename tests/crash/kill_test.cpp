/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the real program on real files, killed at any instant, comes back exactly: in a state that the uninterrupted
 *       run had, never before the last one it had acknowledged.
 * Method: a tape of strokes, undos, redos and forks on a small ring, so that undo-files are written anew and
 *         checkpoints come often. One run to the end says how every stroke looks after each of its dabs. Then the same
 *         tape again and again, killed (SIGKILL) at a seeded instant between its start and its end; `glaise check` and
 *         a further run say what is there. GLAISE_KILLS says how often, GLAISE_KILL_SEED where chance begins. */
#include "tests/crash/real_life.h"
#include "tests/crash/sim_disk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

class killed : public testing::Test, public real_life {
protected:
    void SetUp() override
    {
        std::string name = (fs::temp_directory_path() / "glaise-kill-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        base = name;
        program = GLAISE_PROGRAM;
    }
    void TearDown() override { fs::remove_all(base); }
};

TEST_F(killed, at_any_instant_it_comes_back_exactly)
{
    const uint64_t kills = real_life_number("GLAISE_KILLS", 200 / SIM_DISK_THIN),
                   seed = real_life_number("GLAISE_KILL_SEED", 1);
    seeded chance{seed};
    real_life_put(base / "life.tape", real_life_tape(chance, 40));
    auto states = real_life_states_of(*this, "life.tape");
    ASSERT_EQ(states.size(), 41u) << said("whole.err") << said("empty.err");
    ASSERT_EQ(run({"check", (base / "store").string()}, "check"), 0) << said("check");
    fs::remove_all(base / "store");

    std::vector<std::string> kept = replay("life.tape");
    kept.emplace_back("--kept");
    const auto begun = steady_clock::now();
    ASSERT_EQ(run(kept, "kept"), 0);
    auto lasts = std::chrono::duration_cast<std::chrono::microseconds>(steady_clock::now() - begun).count();
    uint64_t in_time = 0, with_acknowledged = 0, beyond = 0;
    std::set<uint64_t> where;
    for (uint64_t n = 0; n < kills; n++) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", kill " + std::to_string(n));
        fs::remove_all(base / "store");
        const pid_t child = start(kept, "kept");
        std::this_thread::sleep_for(std::chrono::microseconds(seeded_int(chance, 0, lasts)));
        kill(child, SIGKILL);
        if (end(child) == -SIGKILL)
            in_time++;
        else
            lasts -= lasts / 10; /* the machine is less busy than it was */
        const real_life_kept last = real_life_last_kept(said("kept"));
        with_acknowledged += last.record > 0;
        if (!fs::exists(base / "store"))
            continue;
        ASSERT_EQ(run({"check", (base / "store").string()}, "check"), 0) << said("check") << said("check.err");
        const std::string found = said("check");
        const uint64_t stroke = std::stoull(real_life_value(found, "stroke"));
        const uint64_t record = std::stoull(real_life_value(found, "record"));
        ASSERT_GE(record, last.record) << "an acknowledged record is gone";
        ASSERT_TRUE(states[stroke].count(real_life_value(found, "digest"))) << found;
        if (last.record > 0) {
            ASSERT_TRUE(states[last.stroke].count(last.digest)) << "what was acknowledged never existed";
        }
        beyond += record > last.record;
        where.insert(stroke);
        std::vector<std::string> again = replay("empty.tape");
        again.insert(again.end(), {"--stats", (base / "again.json").string()});
        ASSERT_EQ(run(again, "again"), 0) << said("again.err");
        ASSERT_NE(said("again.json").find(real_life_value(found, "digest")), std::string::npos) << found;
        ASSERT_EQ(run({"check", (base / "store").string()}, "check"), 0) << said("check");
    }
    std::printf("%llu kills from seed %llu: %llu while it ran, %llu with something acknowledged, %llu came back beyond "
                "that, at %zu strokes\n",
                static_cast<unsigned long long>(kills), static_cast<unsigned long long>(seed),
                static_cast<unsigned long long>(in_time), static_cast<unsigned long long>(with_acknowledged),
                static_cast<unsigned long long>(beyond), where.size());
    EXPECT_GT(in_time, kills / 4) << "a program that had ended proves nothing";
    EXPECT_GT(with_acknowledged, kills / 8);
    EXPECT_GT(where.size(), std::min<uint64_t>(kills / 20, 10)) << "always at the same place proves little";
}

} // namespace
