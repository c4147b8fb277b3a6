/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the program keeps what README says of it: exit statuses, messages that name file and place, nothing done where
 *       something given is wrong, files whole or absent, undo across runs, gestures that no lattice bounds.
 * Method: the real program is started in a child process, in a folder of its own, and what it says and leaves is looked
 *         at. A full disk is a small tmpfs where one may be mounted, and a limit on the size of files everywhere. */
#include "program_shell.h"

#include "station/command.h"
#include "wiring/store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <set>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

const std::string &BALL = PROGRAM_SHELL_BALL;

using outcome = program_shell_outcome;

void put(const fs::path &path, const std::string &text) { std::ofstream(path, std::ios::binary) << text; }

/* In the child: its outputs into files, a limit on what it may write where one is wanted, then the program. */
[[noreturn]] void become_program(const std::vector<std::string> &words, const std::string &out, const std::string &err,
                                 rlim_t file_bytes_max)
{
    if (file_bytes_max) {
        const rlimit limit = {file_bytes_max, file_bytes_max};
        setrlimit(RLIMIT_FSIZE, &limit);
        signal(SIGXFSZ, SIG_IGN); /* the write fails instead, as on a full disk */
    }
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    std::vector<char *> argv = {const_cast<char *>("glaise")};
    for (const std::string &word : words)
        argv.push_back(const_cast<char *>(word.c_str()));
    argv.push_back(nullptr);
    execv(GLAISE_PROGRAM, argv.data());
    _exit(127);
}

class program : public testing::Test {
protected:
    void SetUp() override
    {
        std::string made = testing::TempDir() + "/glaise-program-XXXXXX";
        ASSERT_NE(mkdtemp(made.data()), nullptr);
        base = made;
        folder = base / "work";
        fs::create_directory(folder);
    }
    void TearDown() override { fs::remove_all(base); }

    std::string at(const std::string &name) const { return (folder / name).string(); }

    outcome run(const std::vector<std::string> &words, rlim_t file_bytes_max = 0) const
    {
        const std::string out = (base / "out.txt").string(), err = (base / "err.txt").string();
        const pid_t child = fork();
        if (child == 0)
            become_program(words, out, err, file_bytes_max);
        int answer = 0;
        waitpid(child, &answer, 0);
        return {WIFEXITED(answer) ? WEXITSTATUS(answer) : -1, program_shell_text(out), program_shell_text(err)};
    }

    /* Writes the tape, replays it, and gives the digests of field and mesh, or what went wrong. */
    std::string digests(const std::string &tape, std::vector<std::string> words = {}) const
    {
        put(at("digests.tape"), tape);
        words.insert(words.begin(), {"replay", at("digests.tape"), "--stats", at("digests.json")});
        const outcome o = run(words);
        if (o.exit != 0)
            return "exit " + std::to_string(o.exit) + ": " + o.err;
        const std::string json = program_shell_text(at("digests.json"));
        const size_t from = json.find("\"field_digest\"");
        return json.substr(from, json.find('\n', from) - from);
    }

    std::set<std::string> names() const
    {
        std::set<std::string> all;
        for (const auto &entry : fs::recursive_directory_iterator(folder))
            all.insert(fs::relative(entry.path(), folder).string());
        return all;
    }

    fs::path base, folder;
};

TEST_F(program, exports_the_moment_the_tape_asks_for_while_it_goes_on)
{
    const std::string more = "+0 place 9 0 0\n+0 action stamp\n+0 apply down\n+200 apply up\n";
    put(at("whole.tape"), BALL + "+0 export then.glaise\n+0 export then.ply\n+0 export then.stl\n" + more);
    put(at("first.tape"), BALL);
    const outcome whole = run({"replay", at("whole.tape"), "--pictures", at("out"), "--export", at("end.glaise")});
    ASSERT_EQ(whole.exit, 0) << whole.err;
    ASSERT_EQ(run({"replay", at("first.tape"), "--export", at("first.glaise"), "--export", at("first.ply")}).exit, 0);
    EXPECT_EQ(program_shell_text(at("out/then.glaise")), program_shell_text(at("first.glaise")));
    EXPECT_NE(program_shell_text(at("end.glaise")), program_shell_text(at("first.glaise")));
    EXPECT_GT(program_shell_text(at("out/then.ply")).size(), 1000u);
    EXPECT_GT(program_shell_text(at("out/then.stl")).size(), 1000u);
    for (const char *name : {"then.glaise", "then.ply", "then.stl", "end.glaise"})
        EXPECT_NE(whole.out.find(name), std::string::npos) << whole.out;
}

TEST_F(program, refuses_a_tape_that_exports_what_no_format_is)
{
    put(at("bad.tape"), BALL + "+0 export then.3mf\n");
    const outcome o = run({"replay", at("bad.tape"), "--pictures", at("out"), "--export", at("end.glaise")});
    EXPECT_EQ(o.exit, 2);
    EXPECT_NE(o.err.find("bad.tape:6:"), std::string::npos) << o.err;
    EXPECT_NE(o.err.find(".glaise .stl"), std::string::npos) << o.err;
    EXPECT_FALSE(fs::exists(at("end.glaise")));
}

TEST_F(program, a_full_disk_costs_the_export_not_the_tape)
{
    put(at("whole.tape"), BALL + "+0 export then.glaise\n+0 place 9 0 0\n+0 apply down\n+40 apply up\n");
    const outcome o = run({"replay", at("whole.tape"), "--pictures", at("out"), "--stats", at("end.json")}, 20000);
    EXPECT_EQ(o.exit, 1);
    EXPECT_NE(o.err.find("then.glaise"), std::string::npos) << o.err;
    EXPECT_FALSE(fs::exists(at("out/then.glaise")));
    EXPECT_NE(program_shell_text(at("end.json")).find("field_digest"), std::string::npos);
}

/* --- words --- */

TEST_F(program, wrong_words_are_named)
{
    const outcome unknown = run({"knead"});
    EXPECT_EQ(unknown.exit, 2);
    EXPECT_NE(unknown.err.find("knead"), std::string::npos) << unknown.err;
    EXPECT_EQ(unknown.out, "");
    put(at("ball.tape"), BALL);
    const outcome option = run({"replay", at("ball.tape"), "--colour", "red"});
    EXPECT_EQ(option.exit, 2);
    EXPECT_NE(option.err.find("--colour"), std::string::npos) << option.err;
    for (const char *name : {"--step", "--width", "--height", "--ring"})
        for (const char *value : {"0", "-1", "1e9", "nan", "many", ""}) {
            const outcome o = run({"replay", at("ball.tape"), name, value});
            EXPECT_EQ(o.exit, 2) << name << " " << value;
            EXPECT_NE(o.err.find(name), std::string::npos) << o.err;
            EXPECT_EQ(o.out, "") << name << " " << value;
        }
    EXPECT_EQ(run({}).exit, 2);
    EXPECT_EQ(run({"replay"}).exit, 2);
    EXPECT_EQ(run({"export", at("ball.tape")}).exit, 2);
    EXPECT_EQ(names(), std::set<std::string>{"ball.tape"});
}

TEST_F(program, version_and_help_are_answers)
{
    const outcome version = run({"--version"});
    EXPECT_EQ(version.exit, 0);
    EXPECT_EQ(version.out, "glaise " GLAISE_VERSION "\n");
    EXPECT_EQ(version.err, "");
    const outcome help = run({"--help"});
    EXPECT_EQ(help.exit, 0);
    EXPECT_EQ(help.err, "");
    for (const command_form &form : command_forms())
        EXPECT_NE(help.out.find("  " + command_usage(form) + " "), std::string::npos) << form.name;
    for (const char *task : {"run", "replay", "export", "info"})
        EXPECT_EQ(run({task, "--help"}).exit, 0) << task;
}

/* --- tapes that are wrong: nothing is done --- */

TEST_F(program, an_absent_tape_is_told)
{
    const outcome o = run({"replay", at("no.tape"), "--store", at("store")});
    EXPECT_EQ(o.exit, 2);
    EXPECT_EQ(o.err, "glaise: " + at("no.tape") + ": No such file or directory\n");
    EXPECT_EQ(names(), std::set<std::string>{});
}

TEST_F(program, a_wrong_line_is_named_and_nothing_is_done)
{
    const std::string head = "glaise tape 1\n# a comment\nstep 1\n@0 size 9 9 9\n+0 rate 60\n+0 apply down\n+99 apply up\n";
    const std::vector<std::tuple<std::string, int, std::string>> wrong = {
        {"glaise tape 2\n", 1, "\"glaise tape 1\""},      {"", 1, "\"glaise tape 1\""},
        {head + "+0 knead 1\n", 8, "a command"},          {head + "\n\n+0 size 1 1\n", 10, "size A B C"},
        {head + "+0 size 1 1 1 1\n", 8, "nothing after"}, {head + "@98 undo\n", 8, "at or after"},
        {head + "0 undo\n", 8, "a time"},                 {head + "+0 rate -1\n", 8, "from 0 to"},
        {head + "+0 turn 0 0 0 90\n", 8, "not zero"},     {head + "step 2\n", 8, "step MM once"},
        {head + "+0 colour red\n", 8, "#rrggbb"},         {head + "+0 picture ../a.png\n", 8, "no folder"},
    };
    for (const auto &[text, line, expected] : wrong) {
        put(at("wrong.tape"), text);
        const outcome o = run({"replay", at("wrong.tape"), "--store", at("store"), "--export", at("a.stl"), "--stats",
                               at("a.json"), "--record", at("b.tape"), "--png", at("a.png"), "--pictures", at("p")});
        EXPECT_EQ(o.exit, 2) << text;
        const std::string place = "glaise: " + at("wrong.tape") + ":" + std::to_string(line) + ": expected ";
        EXPECT_TRUE(o.err.starts_with(place)) << o.err << "and not " << place;
        EXPECT_NE(o.err.find(expected), std::string::npos) << o.err;
        EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << "one sentence: " << o.err;
        EXPECT_EQ(names(), std::set<std::string>{"wrong.tape"}) << text;
    }
}

TEST_F(program, wrong_settings_and_recordings_are_named_too)
{
    put(at("ball.tape"), BALL);
    put(at("settings.tape"), "glaise tape 1\n@0 rate 5\n@0 moves puck9 tool\n");
    const outcome settings = run({"replay", at("ball.tape"), "--settings", at("settings.tape"), "--export", at("a.stl")});
    EXPECT_EQ(settings.exit, 2);
    EXPECT_TRUE(settings.err.starts_with("glaise: " + at("settings.tape") + ":3: expected ")) << settings.err;
    put(at("device.hid"), "D: 0\nR: 3 05 01 0g\n");
    put(at("device.tape"), "glaise tape 1\n@0 recording 0 device.hid\n");
    const outcome recording = run({"replay", at("device.tape"), "--export", at("a.stl")});
    EXPECT_EQ(recording.exit, 2);
    EXPECT_TRUE(recording.err.starts_with("glaise: " + at("device.hid") + ":2: expected ")) << recording.err;
    put(at("device.tape"), "glaise tape 1\n@0 recording 0 absent.hid\n");
    const outcome absent = run({"replay", at("device.tape"), "--export", at("a.stl")});
    EXPECT_EQ(absent.exit, 2);
    EXPECT_TRUE(absent.err.starts_with("glaise: " + at("absent.hid") + ": ")) << absent.err;
    EXPECT_FALSE(fs::exists(at("a.stl")));
}

TEST_F(program, an_unknown_ending_is_told_before_sculpting)
{
    put(at("ball.tape"), BALL);
    const outcome o = run({"replay", at("ball.tape"), "--store", at("store"), "--export", at("a.stl"), "--export", at("a.3ds")});
    EXPECT_EQ(o.exit, 2);
    EXPECT_TRUE(o.err.starts_with("glaise: " + at("a.3ds") + ": expected ")) << o.err;
    for (const char *ending : {".glaise", ".stl", ".ply", ".obj", ".iv"})
        EXPECT_NE(o.err.find(ending), std::string::npos) << ending;
    EXPECT_EQ(o.err.find("sculpting"), std::string::npos);
    EXPECT_EQ(names(), std::set<std::string>{"ball.tape"});
}

/* --- sculpture files that are wrong --- */

TEST_F(program, what_is_no_sculpture_is_refused_with_the_offset)
{
    put(at("ball.tape"), BALL);
    const outcome o = run({"export", at("ball.tape"), at("a.stl")});
    EXPECT_EQ(o.exit, 2);
    EXPECT_TRUE(o.err.starts_with("glaise: " + at("ball.tape") + ": offset 0: expected ")) << o.err;
    EXPECT_EQ(o.out, "");
    EXPECT_EQ(names(), std::set<std::string>{"ball.tape"});
    EXPECT_EQ(run({"info", at("ball.tape")}).exit, 2);
    const outcome absent = run({"info", at("no.glaise")});
    EXPECT_NE(absent.exit, 0);
    EXPECT_EQ(absent.err, "glaise: " + at("no.glaise") + ": No such file or directory\n");
}

TEST_F(program, a_cut_or_damaged_sculpture_is_refused_with_the_offset)
{
    put(at("ball.tape"), BALL);
    ASSERT_EQ(run({"replay", at("ball.tape"), "--export", at("ball.glaise")}).exit, 0);
    const outcome whole = run({"info", at("ball.glaise")});
    EXPECT_EQ(whole.exit, 0);
    EXPECT_NE(whole.out.find("digest"), std::string::npos);
    const std::string bytes = program_shell_text(at("ball.glaise"));
    for (size_t size : {size_t{0}, size_t{3}, size_t{40}, bytes.size() / 2, bytes.size() - 1}) {
        put(at("cut.glaise"), bytes.substr(0, size));
        const outcome o = run({"info", at("cut.glaise")});
        EXPECT_EQ(o.exit, 2) << size;
        EXPECT_TRUE(o.err.starts_with("glaise: " + at("cut.glaise") + ": offset ")) << o.err;
        EXPECT_EQ(o.out, "");
    }
    std::string damaged = bytes;
    damaged[bytes.size() / 3] = static_cast<char>(damaged[bytes.size() / 3] ^ 4);
    put(at("cut.glaise"), damaged);
    EXPECT_EQ(run({"info", at("cut.glaise")}).exit, 2);
    EXPECT_EQ(run({"export", at("cut.glaise"), at("a.ply")}).exit, 2);
    EXPECT_FALSE(fs::exists(at("a.ply")));
}

/* --- the world fails --- */

TEST_F(program, a_store_that_another_program_has_open_is_left_alone)
{
    put(at("ball.tape"), BALL);
    byte_store port;
    std::string text;
    store *held = store_open(at("store"), &port, &text);
    ASSERT_NE(held, nullptr) << text;
    const std::set<std::string> before = names();
    const outcome o = run({"replay", at("ball.tape"), "--store", at("store"), "--export", at("a.stl")});
    EXPECT_EQ(o.exit, 1);
    EXPECT_NE(o.err.find("glaise: " + at("store") + ": another glaise"), std::string::npos) << o.err;
    EXPECT_EQ(names(), before);
    store_close(held);
    EXPECT_EQ(run({"replay", at("ball.tape"), "--store", at("store")}).exit, 0);
}

TEST_F(program, a_disk_that_is_full_keeps_what_was_there)
{
    constexpr rlim_t room_bytes = 20000; /* a tenth of what the ball needs */
    put(at("ball.tape"), BALL);
    ASSERT_EQ(run({"replay", at("ball.tape"), "--export", at("ball.glaise")}).exit, 0);
    put(at("old.stl"), "what was there before");
    const std::set<std::string> before = names();
    for (const char *name : {"new.stl", "new.ply", "new.obj", "new.iv", "new.glaise", "old.stl"}) {
        const outcome o = run({"export", at("ball.glaise"), at(name)}, room_bytes);
        EXPECT_EQ(o.exit, 1) << name;
        EXPECT_NE(o.err.find("glaise: " + at(name) + ": File too large"), std::string::npos) << o.err;
        EXPECT_EQ(names(), before);
    }
    EXPECT_EQ(program_shell_text(at("old.stl")), "what was there before");
}

TEST_F(program, a_small_disk_keeps_what_was_there)
{
    put(at("ball.tape"), BALL);
    ASSERT_EQ(run({"replay", at("ball.tape"), "--export", (base / "ball.glaise").string()}).exit, 0);
    fs::create_directory(at("disk"));
    if (mount("tmpfs", at("disk").c_str(), "tmpfs", 0, "size=64k") != 0)
        GTEST_SKIP() << "no tmpfs can be mounted here: " << std::strerror(errno);
    put(at("disk/a.stl"), "what was there before");
    const std::set<std::string> before = names();
    const outcome o = run({"export", (base / "ball.glaise").string(), at("disk/a.stl")});
    const std::set<std::string> after = names();
    const std::string kept = program_shell_text(at("disk/a.stl"));
    umount(at("disk").c_str());
    EXPECT_EQ(o.exit, 1);
    EXPECT_NE(o.err.find("glaise: " + at("disk/a.stl") + ": No space left on device"), std::string::npos) << o.err;
    EXPECT_EQ(after, before);
    EXPECT_EQ(kept, "what was there before");
}

TEST_F(program, a_refused_stroke_ends_in_exit_status_one)
{
    put(at("huge.tape"), "glaise tape 1\nstep 0.001\n@0 size 9999 9999 9999\n+0 apply down\n+100 apply up\n");
    const outcome o = run({"replay", at("huge.tape")});
    EXPECT_EQ(o.exit, 1);
    EXPECT_NE(o.err.find("glaise: a dab was refused: "), std::string::npos) << o.err;
    EXPECT_NE(o.out.find("refused"), std::string::npos) << o.out;
}

/* --- what was done can be done again, taken back, and done finer --- */

TEST_F(program, a_record_does_the_same_again)
{
    const std::string root = SOURCE_ROOT;
    for (const char *tape : {"tests/golden/actions.tape", "tests/golden/recordings/session.tape"}) {
        const outcome first = run({"replay", root + "/" + tape, "--settings", root + "/config/station.tape", "--record",
                                   at("record.tape"), "--export", at("first.glaise")});
        ASSERT_EQ(first.exit, 0) << first.err;
        EXPECT_EQ(program_shell_text(at("record.tape")).find("recording"), std::string::npos) << "reports stand for recordings";
        const outcome again = run({"replay", at("record.tape"), "--export", at("again.glaise"), "--record", at("twice.tape")});
        ASSERT_EQ(again.exit, 0) << again.err;
        EXPECT_EQ(program_shell_text(at("first.glaise")), program_shell_text(at("again.glaise"))) << tape;
        EXPECT_EQ(program_shell_text(at("record.tape")), program_shell_text(at("twice.tape"))) << tape;
        EXPECT_GT(program_shell_text(at("first.glaise")).size(), 10000u);
    }
}

/* A tool of 60 mm covers more bricks than one hand keeps to itself. */
TEST_F(program, vectors_and_hands_leave_the_same_bits)
{
    const std::string tape = "glaise tape 1\n@0 size 60 60 60\n+0 rate 20\n+0 apply down\n+200 apply up\n";
    const std::string one = digests(tape, {"--vectors", "plain", "--hands", "1"});
    ASSERT_EQ(one.rfind("\"field_digest\"", 0), 0u) << one;
    EXPECT_EQ(digests(tape, {"--vectors", "plain", "--hands", "3"}), one);
    EXPECT_EQ(digests(tape, {"--vectors", "best", "--hands", "2"}), one);
    EXPECT_EQ(digests(tape), one);
    EXPECT_NE(digests(BALL), one);
}

TEST_F(program, vectors_and_hands_that_are_not_there_are_refused)
{
    put(at("ball.tape"), BALL);
    for (const std::vector<std::string> &words :
         {std::vector<std::string>{"--vectors", "AVX-9000"}, {"--hands", "17"}, {"--hands", "-1"}}) {
        const outcome o = run({"replay", at("ball.tape"), words[0], words[1]});
        EXPECT_EQ(o.exit, 2) << words[1];
        EXPECT_NE(o.err.find(words[0]), std::string::npos) << o.err;
    }
}

/* What is asked for as statistics is counted as the paper counts: one dab of a ball of radius 20 on a 1 mm lattice. */
TEST_F(program, statistics_count_what_a_dab_visits_computes_dirties_and_treats)
{
    ASSERT_EQ(digests(BALL).rfind("\"field_digest\"", 0), 0u);
    const std::string json = program_shell_text(at("digests.json"));
    double count[4] = {};
    const char *const names[4] = {"\"visited\": ", "\"computed\": ", "\"dirtied\": ", "\"treated\": "};
    for (int n = 0; n < 4; n++) {
        const size_t place = json.find(names[n]);
        ASSERT_NE(place, std::string::npos) << names[n];
        count[n] = std::stod(json.substr(place + std::strlen(names[n])));
    }
    EXPECT_GE(count[0], count[1]);
    EXPECT_GT(count[1], count[2]) << "the box has corners that the ball has not";
    EXPECT_GT(count[3], count[2]) << "more cubes share dirtied corners than there are such corners";
    EXPECT_GT(count[2], 1000.0);
}

TEST_F(program, undo_goes_back_into_an_earlier_run)
{
    const std::string second = "+0 colour #3060a0\n+0 place 15 0 0\n+0 apply down\n+0 glide 25 5 0 200\n+200 apply up\n";
    const std::string third = "glaise tape 1\n@0 action eraser\n+0 size 9 9 9\n+0 apply down\n+50 apply up\n";
    const std::string undo = "glaise tape 1\n@0 undo\n", redo = "glaise tape 1\n@0 redo\n";
    const std::string empty = digests("glaise tape 1\n"), one = digests(BALL), two = digests(BALL + second);
    EXPECT_EQ(std::set<std::string>({empty, one, two}).size(), 3u);
    const std::vector<std::string> store = {"--store", at("store")};
    EXPECT_EQ(digests(BALL + second, store), two);
    const std::string three = digests(third, store);
    EXPECT_NE(three, two);
    EXPECT_EQ(digests(undo, store), two);
    EXPECT_EQ(digests(undo + "+0 undo\n", store), empty);
    EXPECT_EQ(digests(redo, store), one);
    EXPECT_EQ(digests(redo + "+0 redo\n", store), three);
    EXPECT_EQ(digests(undo + "+0 undo\n", store), one);
    EXPECT_EQ(digests("glaise tape 1\n", store), one) << "a run without a stroke changes nothing";
}

/* Volume of a binary STL, by the divergence theorem. */
double volume_mm3(const std::string &stl)
{
    uint32_t count = 0;
    std::memcpy(&count, stl.data() + 80, 4);
    double volume = 0;
    for (uint32_t n = 0; n < count; n++) {
        float v[9]; /* three corners behind the normal */
        std::memcpy(v, stl.data() + 84 + size_t{50} * n + 12, sizeof v);
        const double x = double{v[4]} * v[8] - double{v[5]} * v[7], y = double{v[5]} * v[6] - double{v[3]} * v[8],
                     z = double{v[3]} * v[7] - double{v[4]} * v[6];
        volume += (v[0] * x + v[1] * y + v[2] * z) / 6;
    }
    return volume;
}

TEST_F(program, gestures_know_no_lattice)
{
    put(at("shape.tape"), BALL + "+0 size 9 6 7\n+0 turn 1 2 3 50\n+0 place 14 0 0\n+0 apply down\n+0 glide 30 14 -6 300\n"
                                 "+300 apply up\n+0 action soft-eraser\n+0 rate 20\n+0 place -12 8 0\n+0 apply down\n"
                                 "+0 glide -2 14 6 200\n+200 apply up\n");
    std::vector<double> volumes;
    for (const char *step : {"0.4", "0.8", "1.6"}) {
        ASSERT_EQ(run({"replay", at("shape.tape"), "--step", step, "--export", at("shape.stl")}).exit, 0);
        volumes.push_back(volume_mm3(program_shell_text(at("shape.stl"))));
    }
    EXPECT_GT(volumes[0], 5000);
    EXPECT_NEAR(volumes[1] / volumes[0], 1, 0.01);
    EXPECT_NEAR(volumes[2] / volumes[0], 1, 0.04);
    EXPECT_LT(std::fabs(volumes[1] - volumes[0]), std::fabs(volumes[2] - volumes[0])) << "finer is nearer";
}

} // namespace
