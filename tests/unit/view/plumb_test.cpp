/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the plumb line goes from the tool's middle straight down to the floor, the outline on the floor is that of the
 *       tool seen from above, bands and cross measure ten millimetres; there is none where it would mean nothing.
 * Method: points of random ellipsoids projected down, against the outline's equation; lengths of the lines made. */
#include "field_fill.h"
#include "view/plumb.h"

#include <gtest/gtest.h>

#include <random>

namespace {

snapshot with_tool(double x, double y, double z, double r)
{
    snapshot s;
    s.tool_world = frame{};
    s.tool_world.origin[0] = x;
    s.tool_world.origin[1] = y;
    s.tool_world.origin[2] = z;
    for (int a = 0; a < 3; a++)
        s.tool_world.axis[a][a] = r;
    return s;
}

TEST(view_plumb, hangs_from_the_tool_to_the_floor)
{
    snapshot s = with_tool(3, 12, -7, 5);
    s.box_lo = {-50, -40, -50};
    plumb l;
    ASSERT_TRUE(plumb_of(s, &l));
    EXPECT_EQ(l.from, glm::dvec3(3, 12, -7));
    EXPECT_EQ(l.foot, glm::dvec3(3, -40, -7));
    s.box_lo[1] = 12.5;
    EXPECT_FALSE(plumb_of(s, &l)) << "under the floor";
    s.box_lo[1] = -40;
    s.tool_style = SNAPSHOT_TOOL_HIDDEN;
    EXPECT_FALSE(plumb_of(s, &l));
    s.tool_style = SNAPSHOT_TOOL_TRANSPARENT;
    s.look = SNAPSHOT_LOOK_PLAIN;
    EXPECT_TRUE(plumb_of(s, &l)) << "no turntable, but the box is still shown";
    s.box_shown = false;
    EXPECT_FALSE(plumb_of(s, &l));
    s.look = SNAPSHOT_LOOK_CLAY;
    EXPECT_TRUE(plumb_of(s, &l));
    s.tool_world.axis[1][0] = NAN;
    EXPECT_FALSE(plumb_of(s, &l));
}

TEST(view_plumb, outline_is_the_ellipsoids_from_above)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-9, 9);
    for (int n = 0; n < 50; n++) {
        snapshot s = with_tool(1, 30, 2, 0);
        for (auto &axis : s.tool_world.axis)
            for (double &c : axis)
                c = any(random);
        plumb l;
        ASSERT_TRUE(plumb_of(s, &l));
        const glm::dmat3 axes(projection_of_frame(s.tool_world));
        /* in every level direction the outline reaches as far as the ellipsoid */
        for (int degree = 0; degree < 360; degree += 7) {
            const glm::dvec3 way(std::cos(degree * M_PI / 180), 0, std::sin(degree * M_PI / 180));
            const double reach = glm::length(glm::dvec3(glm::dot(axes[0], way), glm::dot(axes[1], way),
                                                        glm::dot(axes[2], way)));
            EXPECT_NEAR(std::hypot(glm::dot(l.reach[0], way), glm::dot(l.reach[1], way)), reach, 1e-9);
        }
        EXPECT_EQ(l.reach[0].y, 0);
        EXPECT_EQ(l.reach[1].y, 0);
    }
}

TEST(view_plumb, of_a_freeform_is_its_surfaces)
{
    field_fill_piece form(2000);
    /* 20 by 8 by 12 steps about (30, -5, 11) */
    form.fill({{10, -20, 0}, {50, 10, 30}}, 0xffffffff, [](double x, double y, double z) {
        const double away = std::sqrt((x - 30) * (x - 30) / 100 + (y + 5) * (y + 5) / 16 + (z - 11) * (z - 11) / 36);
        return POTENTIAL_ISO + 6 * (1 - away);
    });
    form.finish();
    snapshot s = with_tool(0, 20, 0, 0.5);
    s.tool_surface = &form.it->surface;
    s.tool_middle = {28, -5, 11};
    plumb l;
    ASSERT_TRUE(plumb_of(s, &l));
    EXPECT_NEAR(l.from.x, 1, 0.51) << "its middle is two steps from its origin";
    EXPECT_NEAR(l.reach[0].x, 5, 0.51);
    EXPECT_NEAR(l.reach[1].z, 3, 0.51);
    field_fill_piece none(10);
    s.tool_surface = &none.it->surface;
    EXPECT_FALSE(plumb_of(s, &l));
}

TEST(view_plumb, bands_and_cross_measure_ten_millimetres)
{
    snapshot s = with_tool(0, 33, 0, 4);
    s.box_lo = {-50, 0, -50};
    plumb l;
    ASSERT_TRUE(plumb_of(s, &l));
    double upright = 0;
    int bands = 0, arms = 0;
    for (const hairline_line &line : plumb_lines(l, glm::dmat4(1), glm::vec3(1))) {
        const glm::vec3 along = line.into - line.from;
        if (std::abs(along.y) > 1e-6f) {
            upright += along.y;
            bands++;
            EXPECT_NEAR(along.y, line.from.y < 29 ? 10 : 3, 1e-4);
        } else {
            EXPECT_EQ(line.from.y, 0);
            if (glm::length(along) > 5) {
                arms++;
                EXPECT_NEAR(glm::length(along), 20, 1e-4);
            } else {
                EXPECT_NEAR(glm::length(line.from), 4, 1e-4);
            }
        }
    }
    EXPECT_NEAR(upright, 33, 1e-4);
    EXPECT_EQ(bands, 4);
    EXPECT_EQ(arms, 2);
    const projection_ball held = plumb_ball(l, glm::dmat4(1));
    for (const hairline_line &line : plumb_lines(l, glm::dmat4(1), glm::vec3(1)))
        EXPECT_LE(glm::length(glm::dvec3(line.from) - held.middle_eye), held.radius);
}

} // namespace
