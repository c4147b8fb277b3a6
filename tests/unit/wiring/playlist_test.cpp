/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a tape with a recording becomes one list of commands in time; every fault names its file and line. */
#include "wiring/playlist.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace {

struct folder {
    std::filesystem::path path;
    folder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "glaise-playlist-XXXXXX").string();
        path = mkdtemp(name.data());
    }
    folder(const folder &) = delete;
    ~folder() { std::filesystem::remove_all(path); }
    std::string put(const std::string &name, const std::string &text) const
    {
        std::ofstream(path / name) << text;
        return (path / name).string();
    }
};

std::string recorded()
{
    std::string bytes, text;
    EXPECT_TRUE(playlist_file(std::string(SOURCE_ROOT) + "/tests/golden/recordings/spacenavigator.hid", &bytes, &text));
    return bytes;
}

} // namespace

TEST(playlist, puts_settings_first_and_recordings_in_their_place)
{
    folder f;
    f.put("puck.hid", recorded());
    std::string settings = f.put("s.tape", "glaise tape 1\n@500 rate 3\n");
    std::string tape = f.put("t.tape", "glaise tape 1\nstep 2\n@0 rate 4\n@1000 recording 1 puck.hid\n@1500 undo\n");
    playlist list;
    std::string text;
    ASSERT_TRUE(playlist_load(settings, tape, &list, &text)) << text;
    EXPECT_EQ(list.step_mm, 2);
    EXPECT_EQ(list.commands[0].number[0], 3);
    EXPECT_EQ(list.commands[1].number[0], 4);
    size_t pucks = 0, undo_at = 0;
    for (size_t n = 0; n < list.commands.size(); n++) {
        const command &c = list.commands[n];
        EXPECT_NE(c.kind, COMMAND_RECORDING);
        if (n) {
            EXPECT_GE(c.time_us, list.commands[n - 1].time_us);
        }
        undo_at = c.kind == COMMAND_UNDO ? n : undo_at;
        pucks += c.kind == COMMAND_PUCK;
        if (c.kind == COMMAND_PUCK) {
            EXPECT_EQ(c.number[0], 1);
            EXPECT_GE(c.time_us, 1000000);
        }
    }
    EXPECT_GT(pucks, 500u);
    EXPECT_GT(undo_at, 10u); /* reports before and after it */
    EXPECT_LT(undo_at, list.commands.size() - 10);
}

TEST(playlist, faults_name_file_and_line)
{
    folder f;
    playlist list;
    std::string text;
    EXPECT_FALSE(playlist_load("", f.put("a.tape", "glaise tape 1\n@0 size 1 1\n"), &list, &text));
    EXPECT_NE(text.find("a.tape:2: expected C"), std::string::npos) << text;
    EXPECT_FALSE(playlist_load("", (f.path / "none.tape").string(), &list, &text));
    EXPECT_NE(text.find("none.tape: No such file"), std::string::npos) << text;
    EXPECT_FALSE(playlist_load("", f.path.string(), &list, &text));
    EXPECT_FALSE(playlist_load("", f.put("b.tape", "glaise tape 1\n@0 recording 0 gone.hid\n"), &list, &text));
    EXPECT_NE(text.find("gone.hid"), std::string::npos) << text;
    f.put("bad.hid", "R: 2 05\n");
    EXPECT_FALSE(playlist_load("", f.put("c.tape", "glaise tape 1\n@0 recording 0 bad.hid\n"), &list, &text));
    EXPECT_NE(text.find("bad.hid:1: expected"), std::string::npos) << text;
    EXPECT_TRUE(list.commands.empty());
}
