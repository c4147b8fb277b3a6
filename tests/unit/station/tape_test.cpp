/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a tape is read as its header says, errors name their line, writing and reading are inverse. */
#include "station/tape.h"

#include <gtest/gtest.h>

namespace {

void refused(const std::string &text, int line, const std::string &part)
{
    tape_trouble trouble;
    EXPECT_FALSE(tape_parse(text, &trouble)) << text;
    EXPECT_EQ(trouble.line, line) << text;
    EXPECT_NE(trouble.expected.find(part), std::string::npos) << trouble.expected;
}

} // namespace

TEST(tape, reads_times_comments_and_step)
{
    tape_trouble trouble;
    auto t = tape_parse("glaise tape 1\r\n# hello\n\n  step 0.5 # fine\n@1.5 undo\n+40 redo # again\n+0 colour #102030\n", &trouble);
    ASSERT_TRUE(t) << trouble.line << trouble.expected;
    EXPECT_EQ(t->step_mm, 0.5);
    ASSERT_EQ(t->commands.size(), 3u);
    EXPECT_EQ(t->commands[0].time_us, 1500);
    EXPECT_EQ(t->commands[1].time_us, 41500);
    EXPECT_EQ(t->commands[2].time_us, 41500);
    EXPECT_EQ(t->commands[2].number[0], 0x102030);
}

TEST(tape, errors_name_line_and_expectation)
{
    refused("", 1, "glaise tape 1");
    refused("glaise tape 2\n", 1, "glaise tape 1");
    refused("glaise tape 1\nundo\n", 2, "@1500");
    refused("glaise tape 1\n@5 undo\n@4 undo\n", 3, "at or after");
    refused("glaise tape 1\n@-1 undo\n", 2, "time");
    refused("glaise tape 1\n@nan undo\n", 2, "time");
    refused("glaise tape 1\n@1undo\n", 2, "time");
    refused("glaise tape 1\n@90000000 undo\n", 2, "time");
    refused("glaise tape 1\n@86400000 undo\n+1 undo\n", 3, "24 hours");
    refused("glaise tape 1\n@0 undo\nstep 1\n", 3, "before any command");
    refused("glaise tape 1\nstep 1\nstep 1\n", 3, "once");
    refused("glaise tape 1\nstep 0\n", 2, "0.001");
    refused("glaise tape 1\nstep nan\n", 2, "0.001");
    refused("glaise tape 1\n@0 size 1 2 zero\n", 2, "C");
}

TEST(tape, text_and_parse_are_inverse)
{
    tape_trouble trouble;
    auto t = tape_parse("glaise tape 1\nstep 0.125\n@0 place 0.1 -2 3e-5\n+33.333 recording 1 a.hid\n+1 orbit 0 0 0 0 1 0 -90 250\n",
                        &trouble);
    ASSERT_TRUE(t);
    auto again = tape_parse(tape_text(*t), &trouble);
    ASSERT_TRUE(again) << trouble.expected;
    EXPECT_EQ(again->step_mm, t->step_mm);
    EXPECT_EQ(again->commands, t->commands);
}

TEST(tape, ends_when_the_last_motion_has_ended)
{
    tape_trouble trouble;
    auto t = tape_parse("glaise tape 1\n@100 glide 1 2 3 400\n@200 spin 0 0 1 90 10\n", &trouble);
    ASSERT_TRUE(t);
    EXPECT_EQ(tape_end_us(*t), 500000);
}
