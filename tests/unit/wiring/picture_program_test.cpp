/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: `glaise picture`, `glaise timelapse`, and what a replay does about pictures, are what --help says of them: the
 *       piece fits, settings are kept, a store is not changed, history's end and branches are minded; exit statuses,
 *       sentences that name the file, files whole or absent.
 * Method: the real program is started by the shell, in a folder of its own, and what it says and leaves is looked at.
 *         Pictures of the same moment, taken in different ways, are compared byte for byte. */
#ifdef GLAISE_VIEW

#include "program_shell.h"

#include "exchange/picture.h"
#include "exchange/picture_source.h"
#include "wiring/large_picture.h"
#include "wiring/store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sys/wait.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

const std::string &BALL = PROGRAM_SHELL_BALL;
/* Nothing in it depends on the piece: pictures of different moments can be compared. */
const std::string FIXED = "glaise tape 1\n@0 light 0 -120 160 160 #fff2e0 1 viewer\n+0 view 0 1 0 30 150\n"
                          "+0 centre 10 0 0\n+0 workspace -50 -50 -50 50 50 50\n+0 workspace-shown on\n"
                          "+0 tool-style wireframe\n";

std::string ball_at(int x, const std::string &colour)
{
    return "+0 place " + std::to_string(x) + " 0 0\n+0 colour " + colour + "\n+0 apply down\n+60 apply up\n";
}

using outcome = program_shell_outcome;

class picture_program : public testing::Test {
protected:
    void SetUp() override
    {
        std::string made = testing::TempDir() + "/glaise-picture-XXXXXX";
        ASSERT_NE(mkdtemp(made.data()), nullptr);
        base = made;
        folder = base / "work";
        fs::create_directory(folder);
        put("ball.tape", BALL);
        put("fixed.tape", FIXED);
    }
    void TearDown() override { fs::remove_all(base); }

    void put(const std::string &name, const std::string &text) const
    {
        std::ofstream(folder / name, std::ios::binary) << text;
    }
    outcome run(const std::string &words, const std::string &before = "") const
    {
        return program_shell_run(folder, base, words, before);
    }
    void must(const std::string &words) const
    {
        const outcome o = run(words);
        ASSERT_EQ(o.exit, 0) << words << "\n" << o.err;
    }
    std::string bytes(const std::string &name) const { return program_shell_text(folder / name); }
    bool is_there(const std::string &name) const { return fs::exists(folder / name); }
    std::map<std::string, std::string> all_in(const std::string &name) const
    {
        std::map<std::string, std::string> all;
        for (const auto &entry : fs::recursive_directory_iterator(folder / name))
            if (entry.is_regular_file())
                all[entry.path().string()] = program_shell_text(entry.path());
        return all;
    }
    picture_source read(const std::string &name) const
    {
        picture_source p;
        std::string text;
        EXPECT_TRUE(store_import(
            (folder / name).string(),
            [&p](checkpoint_source source, void *self) {
                return picture_source_read(source, self, &p).state == STATUS_OK;
            },
            &text)) << name << text;
        return p;
    }
    void refused(const std::string &words, int exit, const std::string &sentence) const
    {
        const outcome o = run(words);
        EXPECT_EQ(o.exit, exit) << words << "\n" << o.err;
        EXPECT_NE(o.err.find(sentence), std::string::npos) << words << ": " << o.err << "and not " << sentence;
        EXPECT_EQ(o.out, "") << words;
    }

    fs::path base, folder;
};

/* Columns in which a pixel is much redder than blue. */
std::pair<int, int> red_columns(const picture_source &p)
{
    int first = static_cast<int>(p.width), last = -1;
    for (uint32_t y = 0; y < p.height; y++)
        for (uint32_t x = 0; x < p.width; x++) {
            const uint8_t *at = &p.rgba[4 * (size_t{y} * p.width + x)];
            if (at[0] > at[2] + 25) {
                first = std::min(first, static_cast<int>(x));
                last = std::max(last, static_cast<int>(x));
            }
        }
    return {first, last};
}

} // namespace

TEST_F(picture_program, a_piece_fits_wherever_it_lies)
{
    put("far.tape", "glaise tape 1\nstep 0.5\n@0 size 9 9 9\n+0 rate 900\n+0 colour #e02010\n+0 place 400 70 -90\n"
                    "+0 apply down\n+100 apply up\n");
    must("replay far.tape --export far.glaise --store store");
    must("picture far.glaise far.png --width 200 --height 300");
    const picture_source p = read("far.png");
    EXPECT_EQ(p.width, 200u);
    EXPECT_EQ(p.height, 300u);
    const auto [first, last] = red_columns(p);
    EXPECT_NEAR(first + last, 199, 3);
    EXPECT_GT(last - first, 165); /* of 200, less twice the air and what lies in shade */
    EXPECT_LT(last - first, 190);
    must("picture store/field same.png --width 200 --height 300");
    EXPECT_EQ(bytes("same.png"), bytes("far.png"));
}

TEST_F(picture_program, settings_say_how_it_is_looked_at)
{
    must("replay ball.tape --export ball.glaise");
    put("bare.tape", FIXED.substr(0, FIXED.find("+0 tool-style")));
    put("near.tape", FIXED + "+0 view 0 1 0 30 75\n");
    put("hands.tape", FIXED + "+0 place 5 5 5\n+0 apply down\n+9 apply up\n+0 picture no.png\n+0 clear\n");
    for (const char *name : {"fixed", "bare", "near", "hands"})
        must(std::string("picture ball.glaise --settings ") + name + ".tape " + name + ".png --width 200 --height 150");
    EXPECT_EQ(bytes("bare.png"), bytes("fixed.png")); /* no tool, whatever the settings say */
    EXPECT_EQ(bytes("hands.png"), bytes("fixed.png"));
    EXPECT_NE(bytes("near.png"), bytes("fixed.png")); /* a centre keeps the distance */
    put("turned.tape", "glaise tape 1\n@0 light 0 9 90 90 #ffffff 1 viewer\n+0 view 0 1 0 0 100\n");
    put("farther.tape", "glaise tape 1\n@0 light 0 9 90 90 #ffffff 1 viewer\n+0 view 0 1 0 0 1000\n");
    for (const char *name : {"turned", "farther"})
        must(std::string("picture ball.glaise --settings ") + name + ".tape " + name + ".png --width 200 --height 150");
    const auto near = red_columns(read("turned.png")), far = red_columns(read("farther.png"));
    EXPECT_GT(near.second - near.first, 80);
    EXPECT_NEAR(near.second - near.first, far.second - far.first, 6); /* without one it fits */
}

TEST_F(picture_program, a_turn_is_numbered_and_comes_from_all_sides)
{
    put("two.tape", "glaise tape 1\n@0 size 9 9 9\n+0 rate 900\n" + ball_at(-12, "#e02010") + ball_at(12, "#3060e0"));
    must("replay two.tape --export two.glaise");
    const outcome o = run("picture two.glaise turn.png --turntable 4 --width 120 --height 90");
    ASSERT_EQ(o.exit, 0) << o.err;
    EXPECT_EQ(o.out, "wrote     turn-000.png\nwrote     turn-001.png\n"
                     "wrote     turn-002.png\nwrote     turn-003.png\n");
    EXPECT_NE(o.err.find("turning 100 %"), std::string::npos) << o.err;
    const auto front = red_columns(read("turn-000.png")), back = red_columns(read("turn-002.png"));
    EXPECT_LT(front.second, 62);
    EXPECT_GT(back.first, 57);
    /* a quarter anticlockwise brings what is on the left to the front */
    const auto quarter = red_columns(read("turn-001.png")), last = red_columns(read("turn-003.png"));
    EXPECT_GT(quarter.second - quarter.first, last.second - last.first);
    EXPECT_FALSE(is_there("turn.png"));
    EXPECT_FALSE(is_there("turn-004.png"));
}

TEST_F(picture_program, a_tape_asks_for_a_turn_of_its_moment)
{
    put("turn.tape", BALL + "+0 picture then.png\n+0 turntable then.png 3\n+0 place 15 0 0\n+0 apply down\n"
                            "+60 apply up\n+0 picture later.png\n");
    const outcome o = run("replay turn.tape --settings fixed.tape --pictures out --width 64 --height 48");
    ASSERT_EQ(o.exit, 0) << o.err;
    EXPECT_EQ(bytes("out/then-000.png"), bytes("out/then.png"));
    EXPECT_NE(bytes("out/later.png"), bytes("out/then.png"));
    for (const char *name : {"then-001.png", "then-002.png"})
        EXPECT_NE(o.out.find(std::string("wrote     out/") + name), std::string::npos) << o.out;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "out"), {}), 5);
    must("replay turn.tape --settings fixed.tape"); /* where no pictures are wanted */
}

TEST_F(picture_program, a_time_lapse_shows_every_stroke_and_changes_nothing)
{
    const std::string head = "glaise tape 1\n@0 size 9 9 9\n+0 rate 900\n";
    const std::string one = ball_at(-12, "#e02010"), two = ball_at(0, "#20c040"), three = ball_at(12, "#3060e0");
    put("all.tape", head + one + "+0 export 1.glaise\n" + two + "+0 export 2.glaise\n" + three);
    must("replay all.tape --store store --pictures . --export 3.glaise");
    const auto before = all_in("store");
    const outcome o = run("timelapse store film --settings fixed.tape --width 96 --height 64");
    ASSERT_EQ(o.exit, 0) << o.err;
    EXPECT_EQ(o.out, "wrote     film/frame-000.png to film/frame-003.png\n");
    EXPECT_NE(o.err.find("time-lapse 100 %  4 pictures"), std::string::npos) << o.err;
    EXPECT_TRUE(all_in("store") == before);
    for (const char *n : {"1", "2", "3"}) {
        must(std::string("picture ") + n + ".glaise --settings fixed.tape " + n + ".png --width 96 --height 64");
        EXPECT_EQ(bytes(std::string("film/frame-00") + n + ".png"), bytes(std::string(n) + ".png")) << n;
    }
    EXPECT_LT(red_columns(read("film/frame-000.png")).second, 0); /* nothing yet */
    must("timelapse store film2 --every 2 --width 96 --height 64");
    must("picture store/field end.png --width 96 --height 64");
    EXPECT_EQ(bytes("film2/frame-002.png"), bytes("end.png")); /* the eye is where the finished piece wants it */
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "film2"), {}), 3);
    EXPECT_TRUE(all_in("store") == before);
}

TEST_F(picture_program, a_time_lapse_goes_over_the_branch_the_piece_stands_on)
{
    const std::string head = "glaise tape 1\n@0 size 9 9 9\n+0 rate 900\n";
    const std::string one = ball_at(-12, "#e02010"), two = ball_at(0, "#20c040"), three = ball_at(12, "#3060e0");
    put("fork.tape", head + one + two + "+0 undo\n" + three + ball_at(24, "#ffffff") + "+0 undo\n");
    put("straight.tape", head + one + three);
    must("replay fork.tape --store fork");
    must("replay straight.tape --store straight");
    must("timelapse fork film --settings fixed.tape --width 96 --height 64");
    must("timelapse straight film2 --settings fixed.tape --width 96 --height 64");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "film"), {}), 3); /* what was undone is no part of it */
    for (const char *name : {"frame-000.png", "frame-001.png", "frame-002.png"})
        EXPECT_EQ(bytes(std::string("film/") + name), bytes(std::string("film2/") + name)) << name;
}

TEST_F(picture_program, a_time_lapse_begins_where_history_does)
{
    const std::string head = "glaise tape 1\n@0 size 9 9 9\n+0 rate 900\n";
    for (int n = 0; n < 6; n++) { /* closing writes what lies beneath, so that strokes can be forgotten */
        put("more.tape", head + ball_at(-20 + 6 * n, "#e02010") + ball_at(-17 + 6 * n, "#e0c010"));
        must("replay more.tape --store store --ring 3");
    }
    const auto before = all_in("store");
    must("timelapse store film --settings fixed.tape --width 96 --height 64");
    const auto frames = std::distance(fs::directory_iterator(folder / "film"), {});
    EXPECT_GE(frames, 4);
    EXPECT_LT(frames, 13); /* 12 strokes were made */
    const auto [first, last] = red_columns(read("film/frame-000.png"));
    EXPECT_GT(last - first, 10); /* what is forgotten is still there */
    must("picture store/field end.png --settings fixed.tape --width 96 --height 64");
    char name[40];
    snprintf(name, sizeof name, "film/frame-%03d.png", static_cast<int>(frames) - 1);
    EXPECT_EQ(bytes(name), bytes("end.png"));
    EXPECT_TRUE(all_in("store") == before);
}

TEST_F(picture_program, a_time_lapse_refuses_what_it_cannot_or_must_not_do)
{
    must("replay ball.tape --store store");
    const auto before = all_in("store");
    fs::create_directory(folder / "empty");
    put("file", "a plain file");
    refused("timelapse no film", 2, "glaise: no: expected a store, which is a folder");
    refused("timelapse file film", 2, "glaise: file: expected a store, which is a folder");
    refused("timelapse empty film", 2, "glaise: empty: expected a store with strokes in it");
    EXPECT_TRUE(all_in("empty").empty());
    refused("timelapse store store", 2, "glaise: store: expected a folder outside the store");
    refused("timelapse store ./store/film", 2, "glaise: ./store/film: expected a folder outside the store");
    refused("timelapse store film --settings no.tape", 2, "glaise: no.tape: No such file or directory");
    refused("timelapse store film --every 0", 2, "--every");
    EXPECT_FALSE(is_there("film"));
    refused("timelapse store file", 2, "glaise: file: ");
    must("timelapse store film --width 9 --height 9");
    refused("timelapse store film", 2, "film: expected a folder without pictures of a time-lapse, not frame-00");
    byte_store port;
    std::string text;
    store *held = store_open((folder / "store").string(), &port, &text);
    ASSERT_NE(held, nullptr) << text;
    refused("timelapse store film2", 1, "glaise: store: another glaise has this store open");
    store_close(held);
    EXPECT_TRUE(all_in("store") == before);
}

TEST_F(picture_program, sizes_that_cannot_be_are_refused_before_anything_is_done)
{
    must("replay ball.tape --export ball.glaise --store store");
    for (const std::string task :
         {"replay ball.tape --png a.png", "picture ball.glaise a.png", "timelapse store film"}) {
        for (const char *name : {"--width", "--height"})
            for (const char *value : {"0", "-1", "65537", "1e9", "nan", "wide", "''"})
                refused(task + " " + name + " " + value, 2, name);
        for (const char *value : {"0", "5", "1.5", "''"})
            refused(task + " --supersample " + value, 2, "--supersample");
        refused(task + " --width 20000 --supersample 4", 2,
                "glaise: a picture of 20000 x 960 pixels, drawn 4 times as large: expected sides of 1 to 16384");
    }
    refused("picture ball.glaise a.png --turntable 0", 2, "--turntable");
    refused("picture ball.glaise a.jpg", 2, "glaise: a.jpg: expected a name that ends in .png");
    refused("picture ball.tape a.png", 2, "glaise: ball.tape: offset 0: expected ");
    refused("picture no.glaise a.png", 1, "glaise: no.glaise: No such file or directory");
    put("wrong.tape", "glaise tape 1\n@0 light 9 0 0 0 #ffffff 1 scene\n");
    refused("picture ball.glaise a.png --settings wrong.tape", 2, "glaise: wrong.tape:2: expected ");
    EXPECT_FALSE(is_there("a.png"));
    EXPECT_FALSE(is_there("film"));
}

TEST_F(picture_program, larger_than_a_canvas_and_finer_than_a_pixel)
{
    must("replay ball.tape --settings fixed.tape --png wide.png --width 9000 --height 20 --export ball.glaise");
    EXPECT_EQ(read("wide.png").width, 9000u);
    must("picture ball.glaise fine.png --width 60 --height 50 --supersample 4");
    must("picture ball.glaise drawn.png --width 240 --height 200");
    const picture_source fine = read("fine.png"), drawn = read("drawn.png");
    std::vector<uint8_t> mean(60 * 50 * 4);
    large_picture_average(drawn.rgba.data(), 240 * 4, 4, 60, 50, mean.data(), 60 * 4);
    EXPECT_TRUE(fine.rgba == mean);
}

TEST_F(picture_program, a_disk_that_is_full_keeps_what_was_there)
{
    must("replay ball.tape --export ball.glaise --store store");
    put("old.png", "what was there before");
    const std::string full = "trap '' XFSZ; ulimit -f 4; "; /* a few KiB */
    for (const char *name : {"old.png", "new.png"}) {
        const outcome o = run(std::string("picture ball.glaise ") + name, full);
        EXPECT_EQ(o.exit, 1) << o.err;
        EXPECT_NE(o.err.find(std::string("glaise: ") + name + ": File too large"), std::string::npos) << o.err;
    }
    EXPECT_EQ(bytes("old.png"), "what was there before");
    EXPECT_FALSE(is_there("new.png"));
    const outcome turn = run("picture ball.glaise new.png --turntable 3", full);
    EXPECT_EQ(turn.exit, 1);
    EXPECT_NE(turn.err.find("glaise: new-000.png: File too large"), std::string::npos) << turn.err;
    const outcome film = run("timelapse store film", full);
    EXPECT_EQ(film.exit, 1);
    EXPECT_NE(film.err.find("glaise: film/frame-000.png: File too large"), std::string::npos) << film.err;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "film"), {}), 0);
    EXPECT_EQ(run("picture ball.glaise no/new.png").exit, 1);
    EXPECT_EQ(run("picture ball.glaise no/new.png").err.find("glaise: no/new.png: No such file or directory"), 0u)
        << run("picture ball.glaise no/new.png").err;
    for (const auto &[name, text] : all_in("."))
        EXPECT_EQ(name.find(".part"), std::string::npos) << name;
}

TEST_F(picture_program, scenery_lies_beside_the_tape_or_is_told)
{
    const std::vector<uint8_t> pixels(8 * 4 * 4, 200);
    const picture p = {8, 4, 4, pixels.data(), 8 * 4};
    std::string text;
    fs::create_directory(folder / "set");
    for (const char *name : {"set/sky.png", "beside.png"})
        ASSERT_TRUE(store_export(
            (folder / name).string(),
            [&p](checkpoint_sink sink, void *self) { return picture_write(p, sink, self); }, &text));
    put("set/set.tape", FIXED + "+0 scenery-picture sky.png\n");
    put("good.tape", BALL + "+0 scenery-picture beside.png\n");
    put("broken.tape", BALL + "+0 scenery-picture broken.png\n+0 scenery studio\n");
    put("plain.tape", BALL + "+0 scenery studio\n");
    put("broken.png", bytes("beside.png").substr(0, 50));
    const std::string size = " --width 64 --height 48 --png ";
    must("replay good.tape --settings set/set.tape" + size + "good.png --export ball.glaise");
    const outcome o = run("replay broken.tape --settings set/set.tape" + size + "a.png");
    EXPECT_EQ(o.exit, 1);
    EXPECT_NE(o.err.find("the scenery stays as it is: broken.png: offset 50: expected more"), std::string::npos)
        << o.err;
    must("replay plain.tape --settings set/set.tape" + size + "b.png");
    EXPECT_EQ(bytes("a.png"), bytes("b.png")); /* everything else goes on */
    must("replay broken.tape --settings set/set.tape"); /* who wants no picture needs none */
    must("picture ball.glaise --settings set/set.tape c.png --width 64 --height 48");
    fs::remove(folder / "set/sky.png");
    const outcome gone = run("picture ball.glaise --settings set/set.tape d.png --width 64 --height 48");
    EXPECT_EQ(gone.exit, 1);
    EXPECT_NE(gone.err.find("glaise: the scenery stays as it is: set/sky.png: No such file"), std::string::npos)
        << gone.err;
    EXPECT_TRUE(is_there("d.png"));
}

#endif
