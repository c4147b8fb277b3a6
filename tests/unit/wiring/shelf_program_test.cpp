/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: `glaise shelf` and a replay on a shelf do what --help says of them: pieces are made, copied with their
 *       history, set aside, discarded and brought back;
 *       exit statuses; sentences that name file and place.
 * Method: the real program is started by the shell, in a folder of its own, and what it says and leaves is looked at. */
#include "program_shell.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

const std::string &BALL = PROGRAM_SHELL_BALL;

using outcome = program_shell_outcome;

class shelf_program : public testing::Test {
protected:
    void SetUp() override
    {
        std::string made = testing::TempDir() + "/glaise-shelf-XXXXXX";
        ASSERT_NE(mkdtemp(made.data()), nullptr);
        folder = made;
        std::ofstream(folder / "ball.tape") << BALL;
        std::ofstream(folder / "undo.tape") << "glaise tape 1\n@0 undo\n";
        std::ofstream(folder / "none.tape") << "glaise tape 1\n";
    }
    void TearDown() override { fs::remove_all(folder); }

    outcome run(const std::string &words) const
    {
        return program_shell_run(folder, folder, words);
    }
    /* What `list` says of a piece; "" when it is not there. */
    std::string line_of(int number) const
    {
        const std::string out = run("shelf s").out;
        const size_t at = ("\n" + out).find("\n   " + std::to_string(number) + "  ");
        return at == std::string::npos ? "" : out.substr(at, out.find('\n', at) - at);
    }
    std::string digest(int number, const std::string &tape) const
    {
        const outcome o =
            run("replay " + tape + " --shelf s --piece " + std::to_string(number) + " --stats stats.json");
        EXPECT_EQ(o.exit, 0) << o.err;
        const std::string json = program_shell_text(folder / "stats.json");
        const size_t from = json.find("\"field_digest\"");
        return json.substr(from, json.find('\n', from) - from);
    }
    void make(const std::string &name) const { ASSERT_EQ(run("shelf s new '" + name + "'").exit, 0); }

    fs::path folder;
};

TEST_F(shelf_program, makes_names_and_lists)
{
    make("The cat");
    make("\xc3\x84pfel");
    EXPECT_NE(line_of(1).find("on "), std::string::npos);
    EXPECT_NE(line_of(1).find("The cat"), std::string::npos);
    EXPECT_NE(line_of(2).find("\xc3\x84pfel"), std::string::npos);
    ASSERT_EQ(run("shelf s rename 1 'The dog'").exit, 0);
    EXPECT_NE(line_of(1).find("The dog"), std::string::npos);
}

TEST_F(shelf_program, a_piece_is_worked_on_and_copied_with_its_history)
{
    make("one");
    const std::string empty = digest(1, "none.tape"), ball = digest(1, "ball.tape");
    EXPECT_NE(ball, empty);
    ASSERT_EQ(run("shelf s duplicate 1").exit, 0);
    EXPECT_NE(line_of(2).find("one (copy)"), std::string::npos);
    EXPECT_EQ(digest(2, "none.tape"), ball);
    EXPECT_EQ(digest(2, "undo.tape"), empty) << "the copy remembers the strokes";
    EXPECT_EQ(digest(1, "none.tape"), ball) << "and the piece is as it was";
}

TEST_F(shelf_program, a_replay_leaves_a_thumbnail_or_says_why_not)
{
    make("one");
    const outcome o = run("replay ball.tape --shelf s --piece 1");
    ASSERT_EQ(o.exit, 0) << o.err;
    const std::string png = program_shell_text(folder / "s/piece-0001/thumbnail.png");
    if (png.empty()) {
        EXPECT_NE(o.err.find("no thumbnail: "), std::string::npos) << o.err;
        return;
    }
    ASSERT_GT(png.size(), 24u);
    EXPECT_EQ(png.substr(16, 8), std::string("\0\0\1\0\0\0\0\xc0", 8)) << "256 x 192";
}

TEST_F(shelf_program, nothing_goes_without_two_acts_and_need)
{
    make("one");
    EXPECT_EQ(run("shelf s discard 1").exit, 1);
    ASSERT_EQ(run("shelf s set-aside 1").exit, 0);
    ASSERT_EQ(run("shelf s discard 1").exit, 0);
    ASSERT_EQ(run("shelf s make-room 1").exit, 0);
    EXPECT_NE(line_of(1).find("discarded"), std::string::npos) << "there was room";
    ASSERT_EQ(run("shelf s bring-back 1").exit, 0);
    EXPECT_EQ(run("shelf s make-room 1000000000").exit, 1);
    EXPECT_NE(line_of(1), "");
    ASSERT_EQ(run("shelf s set-aside 1").exit, 0);
    ASSERT_EQ(run("shelf s discard 1").exit, 0);
    EXPECT_EQ(run("shelf s make-room 1000000000").exit, 1);
    EXPECT_EQ(line_of(1), "");
    EXPECT_TRUE(fs::is_empty(folder / "s"));
}

TEST_F(shelf_program, wrong_words_are_told_and_change_nothing)
{
    EXPECT_EQ(run("shelf s").exit, 1);
    EXPECT_FALSE(fs::exists(folder / "s")) << "looking makes nothing";
    EXPECT_EQ(run("shelf s new \"$(printf 'a\\033[2J')\"").exit, 2);
    EXPECT_FALSE(fs::exists(folder / "s"));
    make("one");
    const outcome o = run("shelf s set-aside 7");
    EXPECT_EQ(o.exit, 2);
    EXPECT_NE(o.err.find("not 7"), std::string::npos) << o.err;
    for (const char *words : {"shelf s set-aside", "shelf s set-aside x", "shelf s new", "shelf s rename 1 ''", "shelf",
                              "replay none.tape --shelf s", "replay none.tape --piece 1",
                              "replay none.tape --shelf s --piece 1 --store t", "replay none.tape --shelf s --piece 2"})
        EXPECT_EQ(run(words).exit, 2) << words;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "s"), {}), 1);
}

TEST_F(shelf_program, what_cannot_be_understood_is_told_with_its_place)
{
    make("one");
    std::ofstream(folder / "s/piece-0001/about") << "glaise piece 1\nname a\nstate gone\nturn 1\n";
    const outcome o = run("shelf s");
    EXPECT_EQ(o.exit, 0);
    EXPECT_NE(o.err.find("piece-0001/about:3: expected"), std::string::npos) << o.err;
    EXPECT_NE(line_of(1).find("piece-0001"), std::string::npos);
    EXPECT_EQ(run("shelf s set-aside 1").exit, 1);
    EXPECT_EQ(run("replay ball.tape --shelf s --piece 1").exit, 0) << "it can be opened all the same";
}

TEST_F(shelf_program, one_program_at_a_time_has_the_shelf)
{
    make("one");
    const outcome o = run("shelf s >/dev/null; flock s '" GLAISE_PROGRAM "' shelf s");
    EXPECT_EQ(o.exit, 1);
    EXPECT_NE(o.err.find("another glaise"), std::string::npos) << o.err;
}

} // namespace
