/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: puck and pedals operate the menu: they point without flicker, choose, go back, change live and put back to the
 *       bit; the tool and the piece stay where they are meanwhile, and presses mean again what they meant.
 * Method: nudges and presses on a whole station, looked at through its snapshot; its recording is replayed. */
#include "menu_desk.h"

#include "station/menu.h"

#include <algorithm>

namespace {

TEST(menu, opens_points_chooses_and_goes_back)
{
    menu_desk d;
    EXPECT_EQ(d.menu().kind, SNAPSHOT_MENU_CLOSED);
    d.open();
    EXPECT_EQ(d.menu().kind, SNAPSHOT_MENU_RING);
    EXPECT_EQ(d.menu().pointed, -1);
    EXPECT_EQ(d.menu().sectors.size(), 8u);
    for (size_t n = 0; n < 8; n++) {
        d.nudge(n);
        EXPECT_EQ(d.menu().pointed, static_cast<int>(n)) << "it stays when the puck springs back";
    }
    d.choose("tool");
    EXPECT_EQ(d.menu().title, "tool");
    EXPECT_EQ(d.menu().pointed, -1);
    d.back();
    EXPECT_EQ(d.menu().title, "menu");
    d.back();
    EXPECT_EQ(d.menu().kind, SNAPSHOT_MENU_CLOSED);
    d.open();
    d.press("button 0 0");
    EXPECT_EQ(d.menu().kind, SNAPSHOT_MENU_CLOSED) << "where nothing is pointed at, its own press shuts it";
    EXPECT_EQ(d.piece->strokes, 0u);
}

TEST(menu, tilting_points_as_pushing_does)
{
    menu_desk d;
    d.open();
    d.do_line("puck 0 0 0 0 -300 0 0"); /* away from the person */
    d.wait(20);
    EXPECT_EQ(d.menu().pointed, 0);
    d.do_line("puck 0 0 0 0 0 -300 0"); /* to the right */
    d.wait(20);
    EXPECT_EQ(d.menu().pointed, 2);
}

TEST(menu, a_puck_held_when_it_opens_does_not_point_until_it_was_let_go)
{
    menu_desk d;
    d.push(0.9, 0);
    d.open();
    d.wait(200);
    EXPECT_EQ(d.menu().pointed, -1);
    d.let_go();
    d.push(0.9, 0);
    EXPECT_EQ(d.menu().pointed, 2);
}

TEST(menu, pointing_has_a_dead_zone_and_a_margin_between_sectors)
{
    menu_desk d;
    d.open();
    d.push(0.9 * MENU_POINTS, 0);
    EXPECT_EQ(d.menu().pointed, -1);
    d.let_go();
    /* Sector 2 ends at 3/16 and 5/16 of a turn; a hand that trembles across that border changes nothing. */
    const auto towards = [&d](double turn) { d.push(0.8 * std::sin(2 * ANGLE_PI * turn), 0.8 * std::cos(2 * ANGLE_PI * turn)); };
    towards(0.25);
    ASSERT_EQ(d.menu().pointed, 2);
    for (int n = 0; n < 10; n++) {
        towards(5.0 / 16 + (n % 2 ? 0.02 : -0.02));
        EXPECT_EQ(d.menu().pointed, 2);
    }
    towards(5.0 / 16 + MENU_MARGIN + 0.01);
    EXPECT_EQ(d.menu().pointed, 3);
    for (int n = 0; n < 10; n++) {
        towards(5.0 / 16 + (n % 2 ? 0.02 : -0.02));
        EXPECT_EQ(d.menu().pointed, 3);
    }
}

TEST(menu, neither_tool_nor_scene_moves_while_it_is_open)
{
    menu_desk d;
    d.do_line("puck 1 0 0 0 0 0 300");
    d.push(0.5, 0.5);
    d.open();
    const auto tool = d.place();
    const snapshot before = station_snapshot(d.desk);
    d.push(1, 1);
    d.do_line("mouse 100 50 2");
    d.wait(500);
    EXPECT_EQ(d.place(), tool);
    const snapshot now = station_snapshot(d.desk);
    EXPECT_EQ(now.scene_turn, before.scene_turn);
    EXPECT_EQ(now.scene_shift, before.scene_shift);
    EXPECT_EQ(now.camera_distance, before.camera_distance);
    d.back();
    d.wait(200);
    EXPECT_NE(d.place(), tool);
}

TEST(menu, opening_ends_a_stroke_and_no_press_inside_begins_one)
{
    menu_desk d;
    d.do_line("pedal 0 down");
    d.wait(100);
    ASSERT_TRUE(station_is_applying(d.desk));
    d.open();
    EXPECT_FALSE(station_is_applying(d.desk));
    EXPECT_EQ(d.piece->strokes, 1u);
    d.do_line("pedal 0 up");
    d.apply();
    d.wait(200);
    EXPECT_EQ(d.piece->strokes, 1u);
    d.back();
    d.do_line("pedal 0 down");
    d.wait(100);
    EXPECT_TRUE(station_is_applying(d.desk)) << "an up that was missed would leave it held for ever, or never begin";
    d.do_line("pedal 0 up");
    EXPECT_FALSE(station_is_applying(d.desk));
}

TEST(menu, presses_held_across_its_opening_and_closing_keep_what_they_were)
{
    menu_desk d;
    d.do_line("pedal 2 down"); /* the clutch, before */
    d.open();
    d.back();
    d.push(0.8, 0);
    EXPECT_EQ(d.place()[0], 0) << "still the scene's";
    d.let_go();
    d.do_line("pedal 2 up");
    d.push(0.8, 0);
    EXPECT_GT(d.place()[0], 0);
    d.let_go();
    /* Down inside, up outside: neither the clutch nor a stroke. */
    d.open();
    d.do_line("pedal 2 down");
    d.do_line("pedal 0 down");
    d.do_line("button 0 0 down");
    d.wait(100);
    ASSERT_EQ(d.menu().kind, SNAPSHOT_MENU_CLOSED);
    EXPECT_FALSE(station_is_applying(d.desk));
    const double x = d.place()[0];
    d.push(0.8, 0);
    EXPECT_GT(d.place()[0], x);
    d.let_go();
    for (const char *up : {"pedal 2 up", "pedal 0 up", "button 0 0 up"})
        d.do_line(up);
    d.do_line("pedal 2 down");
    const double here = d.place()[0];
    d.push(0.8, 0);
    EXPECT_EQ(d.place()[0], here) << "the clutch again";
    d.let_go();
    /* Taken inside: its up outside must not let go of what another press holds. */
    d.do_line("pedal 2 up");
    d.do_line("means-button 1 clutch");
    d.open();
    d.do_line("pedal 2 down");
    d.back();
    d.do_line("button 0 1 down");
    d.do_line("pedal 2 up");
    const double still = d.place()[0];
    d.push(0.8, 0);
    EXPECT_EQ(d.place()[0], still) << "the button's clutch";
    d.let_go();
    d.do_line("button 0 1 up");
    d.push(0.8, 0);
    EXPECT_GT(d.place()[0], still);
}

TEST(menu, a_number_changes_live_and_undo_brings_it_back_to_the_bit)
{
    menu_desk d;
    d.do_line("size 7.3 9.1 11.7");
    const auto axes = [&d] {
        const frame f = station_snapshot(d.desk).tool_world;
        return std::array<double, 3>{f.axis[0][0], f.axis[1][1], f.axis[2][2]};
    };
    const auto before = axes();
    d.open();
    d.choose("tool");
    d.choose("size");
    ASSERT_EQ(d.menu().kind, SNAPSHOT_MENU_VALUE);
    EXPECT_EQ(axes(), before);
    d.push(0.9, 0);
    d.wait(300);
    const auto larger = axes();
    EXPECT_GT(larger[0], 1.1 * before[0]);
    EXPECT_NEAR(larger[2] / larger[0], before[2] / before[0], 1e-9) << "in proportion";
    d.back();
    EXPECT_EQ(axes(), before);
    EXPECT_EQ(d.menu().kind, SNAPSHOT_MENU_RING);
    d.let_go();
    d.choose("size");
    d.push(-0.9, 0);
    d.wait(300);
    const auto smaller = axes();
    EXPECT_LT(smaller[0], before[0]);
    d.let_go();
    d.apply();
    d.back();
    EXPECT_EQ(axes(), smaller) << "kept";
}

TEST(menu, a_small_deflection_is_finer_than_in_proportion)
{
    double grown[2];
    int n = 0;
    for (const double deflected : {0.35, 0.7}) {
        menu_desk d;
        d.open();
        d.choose("tool");
        d.choose("strength");
        d.push(deflected, 0);
        d.wait(400);
        d.let_go();
        grown[n++] = std::stod(d.menu().value) / 6;
    }
    EXPECT_GT(grown[0], 1);
    EXPECT_GT(std::log(grown[1]), 4 * std::log(grown[0]));
}

TEST(menu, numbers_stay_within_what_a_command_may_say)
{
    for (const double way : {1.0, -1.0})
        for (const char *label : {"size", "strength", "spacing", "edge"}) {
            menu_desk d;
            d.open();
            d.choose("tool");
            d.choose(label);
            d.push(way, 0);
            d.wait(9000);
            EXPECT_NEAR(d.menu().number / (way > 0 ? d.menu().most : d.menu().least), 1, 1e-6) << label;
        }
}

TEST(menu, a_colour_is_mixed_by_push_twist_and_lift_and_kept_among_the_last)
{
    menu_desk d;
    d.do_line("colour #804020");
    d.open();
    d.choose("colour");
    d.choose("mix");
    ASSERT_EQ(d.menu().kind, SNAPSHOT_MENU_COLOUR);
    EXPECT_EQ(d.menu().rgb, 0x804020u) << "nothing changes by looking";
    d.push(0, -0.9); /* the bottom of the wheel: half a turn from red */
    d.wait(1500);
    EXPECT_NEAR(d.menu().hue, 0.5, 0.01);
    EXPECT_NEAR(d.menu().lightness, 80 / 255.0, 0.01);
    d.do_line("puck 0 0 0 0 0 0 320"); /* clockwise */
    d.wait(400);
    EXPECT_GT(d.menu().lightness, 0.4);
    const double saturation = d.menu().saturation;
    d.do_line("puck 0 0 0 -320 0 0 0"); /* up */
    d.wait(300);
    EXPECT_GT(d.menu().saturation, saturation + 0.02);
    d.let_go();
    const uint32_t mixed = d.menu().rgb;
    d.apply();
    EXPECT_EQ(d.menu().kind, SNAPSHOT_MENU_CLOSED);
    EXPECT_EQ(station_snapshot(d.desk).strip.rgb, mixed);
    d.open();
    d.choose("colour");
    EXPECT_EQ(d.menu().sectors[1].swatch, mixed);
    EXPECT_EQ(d.menu().sectors[2].swatch, 0x804020u);
    d.choose("mix");
    d.push(0.9, 0);
    d.wait(300);
    EXPECT_NE(station_snapshot(d.desk).strip.rgb, mixed);
    d.back();
    EXPECT_EQ(station_snapshot(d.desk).strip.rgb, mixed);
}

TEST(menu, a_light_goes_with_the_puck_until_it_is_put_down)
{
    menu_desk d;
    d.do_line("light 1 10 20 30 #ffeedd 0.8 scene");
    d.do_line("light-off 1");
    const snapshot_light before = station_snapshot(d.desk).lights[1];
    const auto carry = [&d] {
        d.open();
        d.choose("light");
        d.choose("light 2");
        d.choose("move");
        d.push(0.9, 0);
        d.wait(300);
        d.let_go();
    };
    carry();
    EXPECT_EQ(d.place()[0], 0);
    EXPECT_GT(station_snapshot(d.desk).lights[1].position[0], 15);
    EXPECT_TRUE(station_snapshot(d.desk).lights[1].lit);
    d.back();
    const snapshot_light now = station_snapshot(d.desk).lights[1];
    EXPECT_EQ(now.position, before.position);
    EXPECT_EQ(now.colour, before.colour);
    EXPECT_EQ(now.lit, before.lit);
    d.press("button 0 0");
    carry();
    d.apply();
    d.press("button 0 0");
    EXPECT_GT(station_snapshot(d.desk).lights[1].position[0], 15);
}

TEST(menu, what_a_press_means_is_learnt_from_the_press_itself)
{
    menu_desk d;
    d.open();
    d.choose("station");
    d.choose("a pedal, a button");
    ASSERT_EQ(d.menu().kind, SNAPSHOT_MENU_LEARN);
    d.press("pedal 4");
    EXPECT_EQ(d.menu().title, "station \xe2\x80\xba pedal 5");
    d.choose("redo");
    EXPECT_EQ(d.message(), "");
    d.back();
    d.choose("a pedal, a button");
    d.press("button 0 0"); /* the only one that opens the menu */
    d.choose("undo");
    EXPECT_NE(d.message(), "");
    d.press("button 0 0");
    d.open();
    EXPECT_EQ(d.menu().kind, SNAPSHOT_MENU_RING);
}

TEST(menu, names_are_counted)
{
    menu_desk d;
    d.do_line("names-from 7");
    d.open();
    d.choose("piece");
    d.choose("picture");
    d.choose("picture");
    d.choose("as a file");
    d.choose("stl");
    std::string name;
    ASSERT_TRUE(station_picture_take(d.desk, &name));
    EXPECT_EQ(name, "picture-007.png");
    ASSERT_TRUE(station_picture_take(d.desk, &name));
    EXPECT_EQ(name, "picture-008.png");
    ASSERT_TRUE(station_export_take(d.desk, &name));
    EXPECT_EQ(name, "piece-009.stl");
}

TEST(menu, clearing_asks_first)
{
    menu_desk d;
    d.do_line("apply down");
    d.wait(100);
    d.do_line("apply up");
    const uint64_t corners = d.piece->clay.corners;
    d.open();
    d.choose("piece");
    d.choose("clear all");
    EXPECT_EQ(d.piece->clay.corners, corners);
    d.choose("keep it");
    EXPECT_EQ(d.menu().title, "piece");
    d.choose("clear all");
    d.choose("take all clay away");
    EXPECT_EQ(d.piece->clay.corners, 0u);
}

TEST(menu, a_recording_replays_to_the_same_clay_and_the_same_tool)
{
    menu_desk d;
    d.open();
    d.choose("tool");
    d.choose("size");
    d.push(0.6, 0.2);
    d.wait(333);
    d.let_go();
    d.apply();
    d.back();
    d.choose("action");
    d.choose("toothpaste");
    d.do_line("pedal 0 down");
    d.push(0.7, 0);
    d.wait(150);
    d.do_line("pedal 0 up");
    bench_desk again;
    for (const command &c : station_recording(d.desk))
        station_do(again.desk, c);
    again.until(d.now_ms);
    EXPECT_GT(d.piece->clay.corners, 100u);
    EXPECT_EQ(sculpture_digest(d.piece.get()), sculpture_digest(again.piece.get()));
    EXPECT_EQ(d.place(), again.place());
    EXPECT_EQ(station_snapshot(d.desk).strip.size, station_snapshot(again.desk).strip.size);
}

TEST(menu, a_direction_is_a_part_of_a_turn)
{
    for (int n = 0; n < 16; n++) {
        const double turn = n / 16.0 + 0.01;
        EXPECT_NEAR(menu_turn_of(std::sin(2 * ANGLE_PI * turn), std::cos(2 * ANGLE_PI * turn)), turn, 1e-6);
    }
}

TEST(menu, colours_survive_the_way_to_hue_and_back)
{
    for (uint32_t rgb = 0; rgb < 0x1000000; rgb += 12347)
        EXPECT_EQ(menu_rgb_of(menu_colour_of(rgb)), rgb) << std::hex << rgb;
    EXPECT_EQ(menu_rgb_of({0, 1, 0.5}), 0xff0000u);
    EXPECT_EQ(menu_rgb_of({1 / 3.0, 1, 0.5}), 0x00ff00u);
    EXPECT_EQ(menu_rgb_of({0.5, 1, 0.25}), 0x008080u);
}

} // namespace
