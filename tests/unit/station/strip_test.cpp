/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the strip says what is so: what the puck holds, what each pedal will do, the tool, the last message for a while,
 *       and how to begin until something was done. Method: a station's snapshot, before and after. */
#include "menu_desk.h"

#include "station/strip.h"

namespace {

TEST(strip, says_what_the_puck_holds_and_what_the_pedals_do)
{
    menu_desk d;
    snapshot_menu_strip t = station_snapshot(d.desk).strip;
    EXPECT_FALSE(t.shown);
    EXPECT_EQ(t.mode, "tool");
    EXPECT_EQ(t.pedals, (std::array<std::string, 3>{"apply", "undo", "clutch"}));
    d.do_line("strip-shown on");
    d.do_line("pedal 2 down");
    t = station_snapshot(d.desk).strip;
    EXPECT_TRUE(t.shown);
    EXPECT_EQ(t.mode, "scene");
    EXPECT_EQ(t.pedals_down, (std::array<bool, 3>{false, false, true}));
    d.do_line("pedal 2 up");
    d.open();
    t = station_snapshot(d.desk).strip;
    EXPECT_EQ(t.mode, "menu");
    EXPECT_EQ(t.pedals[0], "choose");
    EXPECT_EQ(t.pedals[1], "back");
    d.choose("tool");
    d.choose("size");
    t = station_snapshot(d.desk).strip;
    EXPECT_EQ(t.pedals[0], "keep");
    EXPECT_EQ(t.pedals[1], "as before");
}

TEST(strip, lights_are_counted_from_one_as_the_menu_does)
{
    menu_desk d;
    d.do_line("moves puck0 light2");
    EXPECT_EQ(station_snapshot(d.desk).strip.mode, "light 3");
}

TEST(strip, says_what_the_tool_is)
{
    menu_desk d;
    for (const char *line : {"size 4 12.5 3", "action soft-eraser", "rate 250", "colour #102030"})
        d.do_line(line);
    const snapshot_menu_strip t = station_snapshot(d.desk).strip;
    EXPECT_EQ(t.size, "12.5 mm");
    EXPECT_EQ(t.action, "soft eraser");
    EXPECT_EQ(t.rate, "strength 250");
    EXPECT_EQ(t.rgb, 0x102030u);
}

TEST(strip, the_hint_is_there_until_the_first_stroke_and_names_what_is_there)
{
    menu_desk d;
    const auto hint = [&d] { return station_snapshot(d.desk).strip.hint; };
    ASSERT_EQ(hint().size(), 5u);
    EXPECT_EQ(hint()[1][0], "left pedal");
    EXPECT_EQ(hint()[4][0], "left button");
    d.do_line("means-button 0 nothing");
    EXPECT_EQ(hint().size(), 4u);
    d.press("pedal 0");
    EXPECT_TRUE(hint().empty());
}

TEST(strip, a_message_stands_for_a_while)
{
    menu_desk d;
    d.do_line("tool freeform");
    EXPECT_NE(station_snapshot(d.desk).strip.toast, "");
    EXPECT_NE(d.message(), "") << "told elsewhere too";
    d.wait(STRIP_TOAST_US / 1000 - 100);
    EXPECT_NE(station_snapshot(d.desk).strip.toast, "");
    d.wait(200);
    EXPECT_EQ(station_snapshot(d.desk).strip.toast, "");
}

TEST(strip, says_whether_all_is_kept)
{
    controls devices;
    hand tool;
    menu closed;
    strip_sight s{&devices, &tool, &closed, {}, true, false, true, "", 0, 0};
    EXPECT_EQ(strip_now(s).keeping, "kept");
    s.facts.put = 2;
    EXPECT_EQ(strip_now(s).keeping, "keeping \xe2\x80\xa6");
    s.facts.medium = HISTORY_MEDIUM_FULL;
    EXPECT_EQ(strip_now(s).keeping, "NOT KEPT: disk full");
    s.facts.medium = HISTORY_MEDIUM_FAILS;
    EXPECT_EQ(strip_now(s).keeping, "NOT KEPT: disk fails");
    s.has_history = false;
    EXPECT_EQ(strip_now(s).keeping, "");
}

} // namespace
