/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the real program on real files, killed at any instant, comes back exactly: in a state that the uninterrupted
   run
 *       had, never before the last one it had acknowledged.
 * Method: a tape of strokes, undos, redos and forks on a small ring, so that undo-files are written anew and
 *         checkpoints come often. One run to the end says how every stroke looks after each of its dabs. Then the same
 *         tape again and again, killed (SIGKILL) at a seeded instant between its start and its end; `glaise check` and
 *         a further run say what is there. GLAISE_KILLS says how often, GLAISE_KILL_SEED where chance begins. */
#include "tests/crash/sim_disk.h"
#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

const std::string EMPTY_TAPE = "glaise tape 1\n";

uint64_t number_from(const char *variable, uint64_t usual)
{
    const char *text = std::getenv(variable);
    return text ? std::strtoull(text, nullptr, 10) : usual;
}

std::string text_of(const fs::path &path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void put(const fs::path &path, const std::string &text) { std::ofstream(path, std::ios::binary) << text; }

/* Strokes that all change something, each elsewhere and in another colour, and steps through history between them. */
std::string tape_text(seeded &chance, int strokes)
{
    std::ostringstream tape;
    tape << "glaise tape 1\n@0 size 7 7 7\n+0 rate 30\n";
    for (int n = 0; n < strokes; n++) {
        char colour[16];
        std::snprintf(colour, sizeof colour, "#%06x", 0x102030 + n * 0x0301);
        const int64_t x = seeded_int(chance, -30, 30), y = seeded_int(chance, -30, 30), z = seeded_int(chance, -30, 30);
        tape << "+20 colour " << colour << "\n+0 place " << x << ' ' << y << ' ' << z << "\n+0 apply down\n+0 glide "
             << x + 12 << ' ' << y + n % 5 << ' ' << z << " 400\n+" << seeded_int(chance, 60, 400) << " apply up\n";
        if (seeded_chance(chance, 0.25))
            tape << "+10 undo\n+10 undo\n+10 redo\n";
        if (seeded_chance(chance, 0.2))
            tape << "+10 undo\n";
        if (seeded_chance(chance, 0.1))
            tape << "+10 fork\n";
    }
    return tape.str();
}

class killed : public testing::Test {
protected:
    void SetUp() override
    {
        std::string name = (fs::temp_directory_path() / "glaise-kill-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        base = name;
        put(base / "empty.tape", EMPTY_TAPE);
    }
    void TearDown() override { fs::remove_all(base); }

    pid_t start(std::vector<std::string> words, const std::string &out)
    {
        const pid_t child = fork();
        if (child != 0)
            return child;
        dup2(open((base / out).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
        dup2(open((base / (out + ".err")).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
        std::vector<char *> argv = {const_cast<char *>("glaise")};
        for (std::string &word : words)
            argv.push_back(word.data());
        argv.push_back(nullptr);
        execv(GLAISE_PROGRAM, argv.data());
        _exit(127);
    }
    static int end(pid_t child)
    {
        int how = 0;
        waitpid(child, &how, 0);
        return WIFEXITED(how) ? WEXITSTATUS(how) : -WTERMSIG(how);
    }
    int run(const std::vector<std::string> &words, const std::string &out) { return end(start(words, out)); }
    std::string said(const std::string &out) const { return text_of(base / out); }
    std::vector<std::string> replay(const char *tape) const
    {
        return {"replay", (base / tape).string(), "--store", (base / "store").string(), "--ring", "12", "--hands", "1"};
    }

    fs::path base;
};

/* Word by word what stands behind `key` in a line that begins with it. */
std::string value_of(const std::string &text, const std::string &key)
{
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string first, second;
        words >> first >> second;
        if (first == key)
            return second.substr(0, second.find(','));
    }
    return "";
}

/* Stroke -> digests after each of its dabs, of the statistics that --stats wrote. */
std::map<uint64_t, std::set<std::string>> states_of(const std::string &json)
{
    std::map<uint64_t, std::set<std::string>> states;
    const std::string stroke = "\"stroke\": ", field = "\"field_digest\": \"";
    for (size_t at = json.find("\"dab\": ["); (at = json.find(stroke, at)) != std::string::npos;) {
        const uint64_t n = std::stoull(json.substr(at + stroke.size()));
        at = json.find(field, at) + field.size();
        states[n].insert(json.substr(at, 16));
    }
    return states;
}

struct acknowledged {
    uint64_t record = 0, stroke = 0;
    std::string digest;
};

acknowledged last_kept(const std::string &out)
{
    acknowledged last;
    std::istringstream lines(out);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        acknowledged now;
        std::string kept;
        if (words >> kept >> now.record >> now.stroke >> now.digest && kept == "kept" && now.digest.size() == 16 &&
            out.find(line + "\n") != std::string::npos)
            last = now;
    }
    return last;
}

TEST_F(killed, at_any_instant_it_comes_back_exactly)
{
    const uint64_t kills = number_from("GLAISE_KILLS", 200 / SIM_DISK_THIN), seed = number_from("GLAISE_KILL_SEED", 1);
    seeded chance{seed};
    put(base / "life.tape", tape_text(chance, 40));
    std::vector<std::string> whole = replay("life.tape");
    whole.insert(whole.end(), {"--stats", (base / "whole.json").string()});
    ASSERT_EQ(run(whole, "whole"), 0) << said("whole.err");
    ASSERT_EQ(run({"check", (base / "store").string()}, "check"), 0) << said("check");
    auto states = states_of(said("whole.json"));
    ASSERT_EQ(states.size(), 40u);
    fs::remove_all(base / "store");
    ASSERT_EQ(run({"replay", (base / "empty.tape").string(), "--stats", (base / "empty.json").string()}, "empty"), 0);
    const std::string none = said("empty.json");
    states[0].insert(none.substr(none.find("\"field_digest\": \"") + 17, 16));

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
        const acknowledged last = last_kept(said("kept"));
        with_acknowledged += last.record > 0;
        if (!fs::exists(base / "store"))
            continue;
        ASSERT_EQ(run({"check", (base / "store").string()}, "check"), 0) << said("check") << said("check.err");
        const std::string found = said("check");
        const uint64_t stroke = std::stoull(value_of(found, "stroke")), record = std::stoull(value_of(found, "record"));
        ASSERT_GE(record, last.record) << "an acknowledged record is gone";
        ASSERT_TRUE(states[stroke].count(value_of(found, "digest"))) << found;
        if (last.record > 0) {
            ASSERT_TRUE(states[last.stroke].count(last.digest)) << "what was acknowledged never existed";
        }
        beyond += record > last.record;
        where.insert(stroke);
        std::vector<std::string> again = replay("empty.tape");
        again.insert(again.end(), {"--stats", (base / "again.json").string()});
        ASSERT_EQ(run(again, "again"), 0) << said("again.err");
        ASSERT_NE(said("again.json").find(value_of(found, "digest")), std::string::npos) << found;
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
