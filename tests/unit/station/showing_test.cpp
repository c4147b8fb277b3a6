/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: how the piece is looked at: what is held comes and goes without a trace, lights change company without moving,
 *       the workspace box goes round the piece, the plane of zero parallax goes where the work is.
 * Method: commands as a tape has them; places worked out by hand. */
#include "station/showing.h"

#include <gtest/gtest.h>

namespace {

command parsed(const char *text)
{
    std::string expected;
    const std::optional<command> c = command_parse(text, &expected);
    EXPECT_TRUE(c) << text << ": expected " << expected;
    return c.value_or(command{});
}

void tell(showing *v, std::initializer_list<const char *> lines)
{
    for (const char *line : lines)
        showing_do(v, parsed(line));
}

TEST(showing, what_is_held_is_let_go_without_a_trace)
{
    showing v;
    tell(&v, {"look clay", "mirror on"});
    tell(&v, {"hold raking down", "hold mirror down", "hold bare down"});
    const snapshot held = showing_now(v);
    EXPECT_EQ(held.look, SNAPSHOT_LOOK_RAKING);
    EXPECT_FALSE(held.effects.mirrored) << "held, it shows the other side";
    EXPECT_FALSE(held.box_shown || held.lights_shown || held.effects.floor);
    EXPECT_EQ(held.tool_style, SNAPSHOT_TOOL_HIDDEN);
    tell(&v, {"tool-style transparent", "hold mirror up", "hold bare up"});
    tell(&v, {"hold raking down", "hold raking up"}); /* a second pedal */
    EXPECT_EQ(showing_now(v).look, SNAPSHOT_LOOK_RAKING);
    tell(&v, {"hold raking up", "hold raking up"});
    const snapshot after = showing_now(v);
    EXPECT_EQ(after.look, SNAPSHOT_LOOK_CLAY);
    EXPECT_TRUE(after.effects.mirrored && after.box_shown && after.lights_shown && after.effects.floor);
    EXPECT_EQ(after.tool_style, SNAPSHOT_TOOL_TRANSPARENT) << "what was asked for meanwhile";
    tell(&v, {"hold raking down"});
    EXPECT_EQ(showing_now(v).look, SNAPSHOT_LOOK_RAKING) << "one up too many is none";
}

TEST(showing, environments_go_round)
{
    showing v;
    tell(&v, {"environment none 0.5"});
    for (snapshot_environment e : {SNAPSHOT_ENVIRONMENT_OPAQUE, SNAPSHOT_ENVIRONMENT_SEMI,
                                   SNAPSHOT_ENVIRONMENT_CLEARCOAT, SNAPSHOT_ENVIRONMENT_NONE}) {
        tell(&v, {"environment-next"});
        EXPECT_EQ(showing_now(v).environment, e);
        EXPECT_EQ(showing_now(v).environment_strength, 0.5f);
    }
}

/* Eye space of a world point, by hand: turned by 90 degrees about y, (x, y, z) goes to (z, y, -x). */
TEST(showing, a_light_changes_company_where_it_is)
{
    showing v;
    tell(&v, {"view 0 1 0 90 200", "centre 10 20 30", "light 2 1 2 3 #ffffff 1 scene", "light-with 2 viewer"});
    snapshot_light l = showing_now(v).lights[2];
    EXPECT_TRUE(l.with_viewer && l.lit);
    EXPECT_NEAR(l.position[0], 3 - 30, 1e-9);
    EXPECT_NEAR(l.position[1], 2 - 20, 1e-9);
    EXPECT_NEAR(l.position[2], -(1 - 10) - 200, 1e-9);
    tell(&v, {"light-with 2 viewer", "light-with 2 scene"});
    l = showing_now(v).lights[2];
    EXPECT_FALSE(l.with_viewer);
    for (size_t a = 0; a < 3; a++)
        EXPECT_NEAR(l.position[a], 1.0 + static_cast<double>(a), 1e-9);
}

TEST(showing, the_box_goes_round_the_piece_which_stands_on_its_bottom)
{
    showing v;
    showing_fit(&v, {-10, 5, 0}, {30, 25, 2});
    const snapshot s = showing_now(v);
    EXPECT_LT(s.box_lo[0], -10);
    EXPECT_GT(s.box_hi[0], 30);
    EXPECT_EQ(s.box_lo[1], 5);
    EXPECT_GT(s.box_hi[1], 25);
    EXPECT_GE(s.box_hi[2] - s.box_lo[2], 20) << "not flatter than half its longest side";
    EXPECT_NEAR(0.5 * (s.box_lo[2] + s.box_hi[2]), 1, 1e-9);
}

TEST(showing, the_plane_of_zero_parallax_follows_the_work)
{
    showing v;
    tell(&v, {"view 0 1 0 0 200", "tool-style wireframe", "stereo-eyes 0.03 1"});
    const motion_vector near_hand{0, 0, 60}, far_hand{0, 0, -50};
    showing_advance(&v, 0.004, near_hand);
    EXPECT_NEAR(showing_now(v).eyes.plane_mm, 140, 1e-9) << "at once, the first time";
    showing_advance(&v, 0.004, far_hand);
    const double first = showing_now(v).eyes.plane_mm;
    EXPECT_GT(first, 140);
    EXPECT_LT(first, 150) << "it does not jump";
    for (int n = 0; n < 2000; n++)
        showing_advance(&v, 0.004, far_hand);
    EXPECT_NEAR(showing_now(v).eyes.plane_mm, 250, 0.1);
    tell(&v, {"stereo-eyes 0.03 1.5"});
    EXPECT_NEAR(showing_now(v).eyes.plane_mm, 375, 0.2) << "as far from the work as is wanted";
    tell(&v, {"tool-style hidden", "stereo-eyes 0.03 1"});
    for (int n = 0; n < 2000; n++)
        showing_advance(&v, 0.004, far_hand);
    EXPECT_NEAR(showing_now(v).eyes.plane_mm, 200, 0.1) << "no tool: the point looked at";
    tell(&v, {"tool-style wireframe"});
    for (int n = 0; n < 4000; n++)
        showing_advance(&v, 0.004, {0, 0, 199});
    EXPECT_NEAR(showing_now(v).eyes.plane_mm, 200 * SHOWING_PLANE_NEAREST, 0.1) << "but not up to the eyes";
}

} // namespace
