/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: what the person asks for happens: devices move what they were told to, presses begin and end strokes, commands do
   what their line in the manual says. Method: a station on a small piece, looked at through its snapshot and dabs. */
#include "bench_desk.h"

#include <cmath>

TEST(station, a_puck_moves_the_tool_in_the_viewers_frame)
{
    bench_desk d;
    d.at(0, "speed 100 90");
    d.at(0, "filter 0 0");
    d.at(0, "puck 0 350 0 0 0 0 0");
    d.until(1000);
    EXPECT_NEAR(d.place()[0], 100, 0.5);
    d.at(1000, "puck 0 0 0 0 0 0 0");
    d.until(2000);
    EXPECT_NEAR(d.place()[0], 100, 0.5);
    /* With the scene turned a quarter about y, the viewer's right is along the world's z. */
    d.at(2000, "place 0 0 0");
    d.at(2000, "view 0 1 0 90 200");
    d.at(2000, "puck 0 350 0 0 0 0 0");
    d.until(3000);
    EXPECT_NEAR(d.place()[0], 0, 1e-6);
    EXPECT_NEAR(std::fabs(d.place()[2]), 100, 0.5);
}

TEST(station, speed_follows_the_eyes_distance)
{
    bench_desk near, far;
    for (bench_desk *d : {&near, &far}) {
        d->at(0, d == &near ? "view 0 1 0 0 100" : "view 0 1 0 0 400");
        d->at(0, "puck 0 200 0 0 0 0 0");
        d->until(500);
    }
    EXPECT_NEAR(far.place()[0] / near.place()[0], 4, 1e-9);
}

TEST(station, moves_says_which_device_moves_what)
{
    bench_desk d;
    d.at(0, "moves puck0 scene");
    d.at(0, "puck 0 0 0 0 0 0 300");
    d.until(300);
    EXPECT_EQ(d.place()[0], 0);
    EXPECT_LT(station_snapshot(d.desk).scene_turn[0], 0.999);
    d.at(300, "puck 0 0 0 0 0 0 0");
    d.at(300, "moves puck0 light2");
    d.at(300, "light 2 0 0 50 #ffffff 1 viewer");
    d.at(300, "puck 0 350 0 0 0 0 0");
    d.until(800);
    EXPECT_GT(station_snapshot(d.desk).lights[2].position[0], 10);
    d.at(800, "moves mouse tool");
    d.at(800, "mouse 100 0 0");
    EXPECT_GT(std::hypot(d.place()[0], d.place()[1], d.place()[2]), 1);
    d.at(800, "moves puck0 nothing");
    auto before = station_snapshot(d.desk).lights[2].position;
    d.until(1200);
    EXPECT_EQ(station_snapshot(d.desk).lights[2].position, before);
}

TEST(station, the_mouse_turns_the_scene_while_the_puck_moves_the_tool)
{
    bench_desk d;
    d.at(0, "mouse 200 0 0");
    d.at(0, "puck 0 0 0 -300 0 0 0");
    d.until(100);
    EXPECT_GT(d.place()[1], 1);
    EXPECT_LT(station_snapshot(d.desk).scene_turn[0], 0.95);
}

TEST(station, the_clutch_swaps_tool_and_scene_while_held_without_a_jump)
{
    bench_desk d;
    d.at(0, "means-pedal 2 clutch");
    d.at(0, "puck 0 300 0 0 0 0 0");
    d.until(100);
    double x = d.place()[0];
    d.at(100, "pedal 2 down");
    EXPECT_EQ(d.place()[0], x);
    d.until(200);
    EXPECT_EQ(d.place()[0], x);
    EXPECT_NE(station_snapshot(d.desk).scene_shift[0], 0);
    d.at(200, "pedal 2 up");
    d.until(300);
    EXPECT_GT(d.place()[0], x);
}

TEST(station, pedal_button_and_command_all_hold_one_stroke)
{
    bench_desk d;
    d.at(0, "pedal 0 down");
    d.at(20, "button 0 0 down");
    d.at(100, "pedal 0 up");
    EXPECT_TRUE(station_is_applying(d.desk));
    d.at(200, "button 0 0 up");
    EXPECT_FALSE(station_is_applying(d.desk));
    EXPECT_EQ(d.piece->strokes, 1u);
    EXPECT_EQ(d.dabs.front().stroke, 1u);
    EXPECT_EQ(d.dabs.back().stroke, 1u);
    EXPECT_GT(d.piece->clay.corners, 100u);
}

TEST(station, deposit_is_per_second_not_per_dab)
{
    /* The same second, cut densely or sparsely, leaves the same potential at the tool's centre. */
    float centre[2];
    int n = 0;
    for (const char *spacing : {"spacing 0.02", "spacing 1"}) {
        bench_desk d;
        d.at(0, spacing);
        d.at(0, "rate 2");
        d.at(0, "size 12 12 12");
        d.at(0, "apply down");
        d.at(0, "spin 0 0 1 720 1000"); /* turning makes dabs, a ball deposits alike whatever its turn */
        d.at(1000, "apply up");
        centre[n++] = clay_read(&d.piece->clay, key{0, 0, 0}, nullptr);
    }
    EXPECT_NEAR(centre[0], 2, 1e-3);
    EXPECT_NEAR(centre[0], centre[1], 1e-3);
}

TEST(station, glide_spin_and_orbit_end_where_they_were_told)
{
    bench_desk d;
    d.at(0, "place 10 0 0");
    d.at(0, "glide 10 20 -5 400");
    d.until(200);
    EXPECT_NEAR(d.place()[1], 10, 1e-9);
    d.until(400);
    EXPECT_EQ(d.place()[1], 20);
    EXPECT_EQ(d.place()[2], -5);
    d.at(400, "place 10 0 0");
    d.at(400, "orbit 0 0 0 0 1 0 90 300");
    d.until(1000);
    EXPECT_NEAR(d.place()[0], 0, 1e-9);
    EXPECT_NEAR(d.place()[2], -10, 1e-9);
    d.at(1000, "turn 1 0 0 0");
    d.at(1000, "size 1 2 3");
    d.at(1000, "spin 0 0 1 90 100");
    d.until(1100);
    EXPECT_NEAR(station_snapshot(d.desk).tool_world.axis[0][1], 1, 1e-9);
    EXPECT_NEAR(station_snapshot(d.desk).tool_world.axis[1][0], -2, 1e-9);
}

TEST(station, make_tool_needs_clay_and_then_is_a_tool)
{
    bench_desk d;
    d.at(0, "make-tool");
    EXPECT_NE(d.message().find("no clay"), std::string::npos);
    d.at(0, "tool freeform");
    EXPECT_NE(d.message().find("make-tool"), std::string::npos);
    EXPECT_EQ(station_snapshot(d.desk).tool_surface, nullptr);
    d.at(0, "rate 60");
    d.at(0, "apply down");
    d.at(100, "apply up");
    d.at(100, "make-tool");
    d.at(100, "tool freeform");
    EXPECT_EQ(d.message(), "");
    ASSERT_NE(station_snapshot(d.desk).tool_surface, nullptr);
    EXPECT_GT(station_snapshot(d.desk).tool_surface->triangles, 100u);
    uint64_t before = d.piece->clay.corners;
    d.at(100, "place 40 0 0");
    d.at(100, "apply down");
    d.at(200, "apply up");
    EXPECT_GT(d.piece->clay.corners, before + before / 2);
}

TEST(station, a_refused_dab_is_told_once_and_the_stroke_goes_on)
{
    bench_desk d(8); /* room for eight bricks */
    d.at(0, "size 40 40 40");
    d.at(0, "apply down");
    d.until(500);
    EXPECT_NE(d.message().find("refused"), std::string::npos);
    EXPECT_EQ(d.message(), "");
    EXPECT_EQ(d.piece->clay.corners, 0u);
    d.at(500, "size 2 2 2");
    d.at(500, "place 4 4 4");
    d.at(1000, "apply up");
    EXPECT_GT(d.piece->clay.corners, 0u);
}

TEST(station, undo_without_history_says_so)
{
    bench_desk d;
    d.at(0, "undo");
    EXPECT_NE(d.message().find("history ends"), std::string::npos);
}

TEST(station, next_action_cycles_through_all)
{
    bench_desk d;
    d.at(0, "means-button 3 next-action");
    d.at(0, "rate 60");
    for (int n = 0; n < ACTION_COUNT; n++) {
        d.at(n, "button 0 3 down");
        d.at(n, "button 0 3 up");
    }
    d.at(100, "apply down"); /* back at toothpaste: it deposits */
    d.at(200, "apply up");
    EXPECT_GT(d.piece->clay.corners, 0u);
}

TEST(station, pictures_are_asked_for_in_order)
{
    bench_desk d;
    d.at(0, "picture one.png");
    d.at(0, "picture two.png");
    std::string name;
    EXPECT_TRUE(station_picture_take(d.desk, &name));
    EXPECT_EQ(name, "one.png");
    EXPECT_TRUE(station_picture_take(d.desk, &name));
    EXPECT_EQ(name, "two.png");
    EXPECT_FALSE(station_picture_take(d.desk, &name));
}

TEST(station, what_was_done_is_recorded_and_does_it_again)
{
    const char *lines[] = {"rate 40", "apply down", "glide 20 5 0 300", "puck 0 0 120 0 50 0 0"};
    bench_desk first;
    double ms = 3.7;
    for (const char *line : lines)
        first.at(ms += 7.3, line);
    first.at(400, "apply up");
    bench_desk second;
    for (const command &c : station_recording(first.desk))
        station_do(second.desk, c);
    EXPECT_EQ(sculpture_digest(first.piece.get()), sculpture_digest(second.piece.get()));
    EXPECT_NE(sculpture_digest(first.piece.get()), sculpture_digest(bench_desk().piece.get()));
}

TEST(station, picture_commands_reach_the_snapshot)
{
    bench_desk d;
    d.at(0, "environment clearcoat 0.5");
    d.at(0, "tool-style transparent");
    d.at(0, "workspace -1 -2 -3 1 2 3");
    d.at(0, "workspace-shown off");
    d.at(0, "light 3 1 2 3 #ff8000 2 scene");
    d.at(0, "material 0.5 10 0.1");
    d.at(0, "colour #ff0000");
    d.at(0, "centre 5 0 0");
    snapshot s = station_snapshot(d.desk);
    EXPECT_EQ(s.environment, SNAPSHOT_ENVIRONMENT_CLEARCOAT);
    EXPECT_EQ(s.tool_style, SNAPSHOT_TOOL_TRANSPARENT);
    EXPECT_EQ(s.box_hi[2], 3);
    EXPECT_FALSE(s.box_shown);
    EXPECT_TRUE(s.lights[3].lit);
    EXPECT_FALSE(s.lights[3].with_viewer);
    EXPECT_NEAR(s.lights[3].colour[1], 128 / 255.0, 1e-6);
    EXPECT_EQ(s.material.shininess, 10);
    EXPECT_EQ(s.tool_colour[0], 1);
    EXPECT_EQ(s.scene_shift[0], -5);
    d.at(0, "light-off 3");
    EXPECT_FALSE(station_snapshot(d.desk).lights[3].lit);
}
