/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: tool, lights and box are drawn where they are and change no pixel elsewhere; what clay hides of the tool is
 *       fainter, blue and striped; the pedal shows; a freeform tool shows its own surface.
 * Method: pictures with and without each of them are compared; where a change may lie comes from projecting the tool's
 *         bounding ball or the box's corners. */
#include "view/marker.h"
#include "view_stage.h"

#include <algorithm>

namespace {

class view_marker : public view_stage {
  protected:
    static snapshot with_tool(double x, double y, double z, double r)
    {
        snapshot s = plain();
        s.tool_style = SNAPSHOT_TOOL_WIREFRAME;
        s.tool_world.origin[0] = x;
        s.tool_world.origin[1] = y;
        s.tool_world.origin[2] = z;
        for (int a = 0; a < 3; a++)
            s.tool_world.axis[a][a] = r;
        return s;
    }

    static snapshot without_tool(snapshot s)
    {
        s.tool_style = SNAPSHOT_TOOL_HIDDEN;
        return s;
    }

    /* Is the point inside the picture of a ball, grown by `margin` pixels? Middle not far from the axis. */
    static std::function<bool(double, double)> inside_ball(const snapshot &s, std::array<double, 3> m, double r,
                                                           double margin)
    {
        const double ahead = s.camera_distance - m[2], f = focal_pixels(s);
        const double x = width / 2.0 + f * m[0] / ahead, y = height / 2.0 - f * m[1] / ahead;
        const double away = std::sqrt(ahead * ahead + m[0] * m[0] + m[1] * m[1]);
        /* off the axis the picture of a ball is an ellipse: its long half axis is at most this */
        const double stretch = away / ahead;
        const double pixels = f * r / std::sqrt(away * away - r * r) * stretch * stretch;
        return [=](double px, double py) { return std::hypot(px - x, py - y) <= pixels + margin; };
    }

    static std::function<bool(double, double)> outside(std::function<bool(double, double)> inside)
    {
        return [inside](double x, double y) { return !inside(x, y); };
    }
};

TEST_F(view_marker, tool_styles_change_pixels_only_where_the_tool_is)
{
    view_stage_piece piece;
    piece.ball({0, 0, 0}, 20, view_stage_rgba(180, 120, 90));
    update(piece);
    snapshot s = with_tool(14, 6, 20, 10);
    const auto inside = inside_ball(s, {14, 6, 20}, 10, 2);
    const view_stage_picture hidden = draw(without_tool(s));
    const view_stage_picture wire = draw(s);
    s.tool_style = SNAPSHOT_TOOL_TRANSPARENT;
    const view_stage_picture glass = draw(s);
    EXPECT_EQ(wire.changed(hidden, outside(inside)), 0);
    EXPECT_EQ(glass.changed(hidden, outside(inside)), 0);
    const int wire_pixels = wire.changed(hidden), glass_pixels = glass.changed(hidden);
    EXPECT_GT(wire_pixels, 200);
    EXPECT_GT(glass_pixels, wire_pixels * 5 / 4) << "glass fills, wire does not";
    EXPECT_GT(wire.changed(glass), 200);
}

TEST_F(view_marker, an_ellipsoids_axes_are_its_half_axes)
{
    snapshot s = with_tool(0, 0, 0, 20);
    s.tool_world.axis[0][0] = 0;
    s.tool_world.axis[0][1] = 30; /* the first axis stands upright, */
    s.tool_world.axis[1][0] = -12; /* the second lies to the left */
    s.tool_world.axis[1][1] = 0;
    const view_stage_picture p = draw(s), none = draw(without_tool(s));
    int left = width, right = 0, top = height, bottom = 0;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            if (p.apart(none, x, y) < 6)
                continue;
            left = std::min(left, x);
            right = std::max(right, x + 1);
            top = std::min(top, y);
            bottom = std::max(bottom, y + 1);
        }
    }
    const double scale = focal_pixels(s) / s.camera_distance;
    EXPECT_NEAR((right - left) / 2.0, 12 * scale, 2.5);
    EXPECT_NEAR((bottom - top) / 2.0, 30 * scale, 2.5);
}

/* Sum of what a style adds, over the picture. */
double strength(const view_stage_picture &with, const view_stage_picture &without)
{
    double sum = 0;
    for (int y = 0; y < with.height; y++)
        for (int x = 0; x < with.width; x++)
            sum += with.apart(without, x, y);
    return sum;
}

/* How much bluer than red a picture is than another, over the picture. */
double blueness(const view_stage_picture &with, const view_stage_picture &without)
{
    double sum = 0;
    for (int y = 0; y < with.height; y++)
        for (int x = 0; x < with.width; x++)
            sum += (with.linear(x, y, 2) - with.linear(x, y, 0)) - (without.linear(x, y, 2) - without.linear(x, y, 0));
    return sum;
}

TEST_F(view_marker, what_clay_hides_of_the_tool_is_fainter_and_blue)
{
    view_stage_piece wall;
    wall.ball({0, 0, 0}, 30, view_stage_rgba(120, 120, 120));
    update(wall);
    for (snapshot_tool_style style : {SNAPSHOT_TOOL_WIREFRAME, SNAPSHOT_TOOL_TRANSPARENT}) {
        snapshot before = with_tool(0, 0, 50, 8), behind = with_tool(0, 0, -50, 16); /* as large in the picture */
        before.tool_style = behind.tool_style = style;
        const view_stage_picture none = draw(plain()), seen = draw(before), hidden = draw(behind);
        double light_seen = 0, light_hidden = 0;
        for (int y = 0; y < height; y++) {
            for (int x = 0; x < width; x++) {
                light_seen += std::abs(seen.light(x, y) - none.light(x, y));
                light_hidden += std::abs(hidden.light(x, y) - none.light(x, y));
            }
        }
        EXPECT_GT(strength(hidden, none), 0.1 * strength(seen, none)) << style;
        EXPECT_LT(light_hidden, 0.6 * light_seen) << style;
        EXPECT_GT(blueness(hidden, none), 4 * std::abs(blueness(seen, none))) << style;
    }
}

TEST_F(view_marker, what_clay_hides_is_in_stripes)
{
    view_stage_piece wall;
    wall.ball({0, 0, 0}, 30, view_stage_rgba(120, 120, 120));
    update(wall);
    snapshot s = with_tool(0, 0, -50, 20);
    s.tool_style = SNAPSHOT_TOOL_TRANSPARENT;
    const int tall = 540, wide = 720;
    const view_stage_picture p = draw(s, wide, tall), none = draw(without_tool(s), wide, tall);
    int turns = 0, way = 0, before = 0; /* going right through the middle the strength rises and falls, stripe by stripe */
    for (int x = wide / 2 - 30; x < wide / 2 + 30; x++) {
        const int now = p.apart(none, x, tall / 2);
        const int step = now > before + 1 ? 1 : now < before - 1 ? -1 : 0;
        turns += step != 0 && way != 0 && step != way;
        way = step != 0 ? step : way;
        before = now;
    }
    EXPECT_GE(turns, 10);
}

TEST_F(view_marker, a_ring_shows_where_the_tool_meets_the_clay)
{
    /* the tool's middle lies behind the clay's, so that its outline and the ring are far apart in the picture */
    const double clay_radius = 24, tool_radius = 31, tool_z = -10;
    view_stage_piece piece;
    piece.ball({0, 0, 0}, clay_radius, view_stage_rgba(90, 60, 50));
    update(piece);
    snapshot s = with_tool(0, 0, tool_z, tool_radius);
    const view_stage_picture none = draw(without_tool(s)), p = draw(s);
    /* the two spheres meet in a circle at this height, of this radius */
    const double z = (tool_radius * tool_radius - clay_radius * clay_radius - tool_z * tool_z) / (-2 * tool_z);
    const double ring = std::sqrt(clay_radius * clay_radius - z * z);
    const double pixels = focal_pixels(s) * ring / (s.camera_distance - z);
    int marked = 0;
    for (int degree = 0; degree < 360; degree++) {
        const double a = degree * M_PI / 180;
        const int x = static_cast<int>(width / 2 + pixels * std::cos(a));
        const int y = static_cast<int>(height / 2 - pixels * std::sin(a));
        int most = 0;
        for (int d = -1; d <= 1; d++)
            most = std::max({most, p.apart(none, x + d, y), p.apart(none, x, y + d)});
        marked += most > 20;
    }
    EXPECT_GT(marked, 350);
}

TEST_F(view_marker, the_pedal_shows_unless_the_tool_is_hidden)
{
    view_stage_piece piece;
    piece.ball({0, 0, 0}, 20, view_stage_rgba(180, 120, 90));
    update(piece);
    snapshot s = with_tool(0, 0, 24, 12);
    s.tool_colour = {0.1f, 0.2f, 0.9f};
    for (snapshot_tool_style style : {SNAPSHOT_TOOL_WIREFRAME, SNAPSHOT_TOOL_TRANSPARENT}) {
        s.tool_style = style;
        s.tool_working = false;
        const view_stage_picture idle = draw(s);
        s.tool_working = true;
        const view_stage_picture working = draw(s);
        double warmer = 0;
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++)
                warmer += (working.linear(x, y, 0) - working.linear(x, y, 2)) -
                          (idle.linear(x, y, 0) - idle.linear(x, y, 2));
        EXPECT_GT(working.changed(idle), 200) << style;
        EXPECT_GT(warmer, 20) << style;
    }
    s.tool_style = SNAPSHOT_TOOL_HIDDEN;
    const view_stage_picture working = draw(s);
    s.tool_working = false;
    EXPECT_EQ(draw(s).apart(working), 0);
}

TEST_F(view_marker, a_mirrored_tool_looks_like_its_image)
{
    view_stage_piece form;
    form.ball({0, 0, 14}, 10, view_stage_rgba(255, 255, 255));
    form.ball({0, 0, -14}, 10, view_stage_rgba(255, 255, 255));
    snapshot s = with_tool(0, 0, 0, 1);
    s.tool_surface = &form.it->surface;
    s.tool_style = SNAPSHOT_TOOL_TRANSPARENT;
    const view_stage_picture p = draw(s);
    s.tool_world.axis[0][0] = -s.tool_world.axis[0][0];
    EXPECT_LE(draw(s).changed(p, 6), 8)
        << "two balls, one behind the other: only the near side of the near one is blended";
}

TEST_F(view_marker, a_flat_tool_is_not_drawn)
{
    snapshot s = with_tool(0, 0, 0, 20);
    const view_stage_picture none = draw(without_tool(s));
    s.tool_world.axis[2][2] = 0;
    EXPECT_EQ(draw(s).apart(none), 0);
    s.tool_world.axis[2][2] = NAN;
    EXPECT_EQ(draw(s).apart(none), 0);
}

TEST_F(view_marker, a_freeform_tool_shows_its_own_surface)
{
    view_stage_piece form;
    form.ball({100, -40, 60}, 10, view_stage_rgba(255, 255, 255));
    snapshot s = with_tool(12, -8, 10, 1);
    s.tool_surface = &form.it->surface;
    s.tool_middle = {100, -40, 60};
    const auto inside = inside_ball(s, {12, -8, 10}, 10, 2);
    const view_stage_picture none = draw(without_tool(s)), wire = draw(s);
    s.tool_style = SNAPSHOT_TOOL_TRANSPARENT;
    const view_stage_picture glass = draw(s);
    EXPECT_GT(wire.changed(none), 300);
    EXPECT_EQ(wire.changed(none, outside(inside)), 0);
    EXPECT_EQ(glass.changed(none, outside(inside)), 0);
    const auto core = inside_ball(s, {12, -8, 10}, 10, -2);
    int area = 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            area += core(x + 0.5, y + 0.5);
    EXPECT_GT(area, 1000);
    EXPECT_EQ(glass.changed(none, core), area) << "glass covers all of it";
    s.tool_style = SNAPSHOT_TOOL_WIREFRAME;
    const uint64_t sent = view_count(it).uploaded_bytes;
    s.tool_surface = nullptr;
    EXPECT_GT(draw(s).changed(none), 0) << "back to an ellipsoid of one millimetre";
    EXPECT_EQ(view_count(it).uploaded_bytes, sent);
}

TEST_F(view_marker, lights_are_small_balls_of_their_own_colour)
{
    snapshot s = plain();
    s.lights[0] = light_at(20, 12, 5);
    const view_stage_picture none = draw(s);
    s.lights_shown = true;
    const auto inside = inside_ball(s, {20, 12, 5}, 0.03 * s.camera_distance, 0);
    const double f = focal_pixels(s) / (s.camera_distance - 5);
    const int x = static_cast<int>(width / 2 + 20 * f), y = static_cast<int>(height / 2 - 12 * f);
    for (int own = 0; own < 3; own++) {
        s.lights[0].colour = {0.2f, 0.2f, 0.2f};
        s.lights[0].colour[static_cast<size_t>(own)] = 0.6f;
        const view_stage_picture p = draw(s);
        EXPECT_GT(p.changed(none), 10);
        EXPECT_EQ(p.changed(none, outside(inside)), 0);
        EXPECT_GT(p.linear(x, y, own), 0.7);
        for (int other = 0; other < 3; other++)
            if (other != own) {
                EXPECT_LT(p.linear(x, y, other), 0.75 * p.linear(x, y, own)) << own;
            }
    }
    s.lights[0].lit = false;
    EXPECT_EQ(draw(s).apart(none), 0) << "nothing is drawn where no light is";
}

TEST_F(view_marker, a_light_that_goes_with_the_viewer_wears_a_ring)
{
    snapshot s = plain();
    s.lights_shown = true;
    s.lights[0] = light_at(20, 12, 5);
    const view_stage_picture fixed = draw(s);
    s.lights[0].with_viewer = true;
    s.lights[0].position[2] -= s.camera_distance; /* the same place, said from the eye */
    const view_stage_picture carried = draw(s);
    const double f = focal_pixels(s) / (s.camera_distance - 5), radius = 1.9 * MARKER_LIGHT_RADIUS * s.camera_distance;
    const double x = width / 2 + 20 * f, y = height / 2 - 12 * f;
    const auto near_ring = [&](double px, double py) {
        return std::abs(std::hypot(px - x, py - y) - radius * f) < 3;
    };
    EXPECT_GT(carried.changed(fixed, near_ring, 8), 20);
    EXPECT_EQ(carried.changed(fixed, outside(near_ring), 8), 0);
}

TEST_F(view_marker, the_workspace_box_lies_along_its_sides)
{
    snapshot s = plain();
    s.box_lo = {-30, -20, -10};
    s.box_hi = {30, 25, 15};
    const view_stage_picture none = draw(s);
    s.box_shown = true;
    const view_stage_picture p = draw(s);
    auto project = [&](double x, double y, double z) {
        const double f = focal_pixels(s) / (s.camera_distance - z);
        return std::array<double, 2>{width / 2.0 + f * x, height / 2.0 - f * y};
    };
    EXPECT_GT(p.changed(none), 500);
    for (double z : {-10.0, 15.0}) { /* points along the upper sides */
        for (double x = -29; x <= 29; x += 2) {
            const auto at = project(x, 25, z);
            int most = 0;
            for (int d = -1; d <= 1; d++)
                most = std::max(most, p.apart(none, static_cast<int>(at[0]), static_cast<int>(at[1]) + d));
            EXPECT_GT(most, 10) << x << ", " << z;
        }
    }
    const auto corner_lo = project(-30, -20, 15), corner_hi = project(30, 25, 15);
    EXPECT_EQ(p.changed(none,
                        [&](double x, double y) {
                            return x < corner_lo[0] - 2 || x > corner_hi[0] + 2 || y < corner_hi[1] - 2 ||
                                   y > corner_lo[1] + 2;
                        }),
              0);
    EXPECT_EQ(p.apart(none, width / 2, height / 2), 0) << "its middle is empty";
}

/* A box seen straight on, in a tall picture: its lower front side and marks along it. */
TEST_F(view_marker, the_box_has_a_mark_every_ten_millimetres)
{
    snapshot s = plain();
    s.box_lo = {-35, -20, -10};
    s.box_hi = {35, 25, 15};
    s.box_shown = true;
    const int wide = 960, tall = 720;
    const view_stage_picture p = draw(s, wide, tall);
    s.box_shown = false;
    const view_stage_picture none = draw(s, wide, tall);
    const double z = 14.2, f = focal_pixels(s, tall) / (s.camera_distance - z); /* half way along a mark, inwards */
    for (int mm = -34; mm <= 34; mm++) {
        const int x = static_cast<int>(wide / 2.0 + f * mm), y = static_cast<int>(tall / 2.0 + f * 20);
        int most = 0;
        for (int d = -1; d <= 1; d++)
            most = std::max(most, p.apart(none, x + d, y));
        EXPECT_EQ(most > 10, (mm + 35) % 10 == 0) << mm;
    }
}

TEST_F(view_marker, sides_behind_are_fainter)
{
    snapshot s = plain();
    s.box_lo = {-30, -20, -10};
    s.box_hi = {30, 25, 15};
    s.box_shown = true;
    const view_stage_picture p = draw(s);
    s.box_shown = false;
    const view_stage_picture none = draw(s);
    const auto strongest = [&](double z) { /* of a lower side */
        const double f = focal_pixels(s) / (s.camera_distance - z);
        int most = 0;
        for (int d = -1; d <= 1; d++)
            most = std::max(most, p.apart(none, width / 2 + 7, static_cast<int>(height / 2 + 20 * f) + d));
        return most;
    };
    EXPECT_GT(strongest(-10), 8);
    EXPECT_LT(strongest(-10), 0.8 * strongest(15));
}

TEST_F(view_marker, clay_hides_box_and_lights)
{
    view_stage_piece wall;
    wall.ball({0, 0, 0}, 30, view_stage_rgba(120, 120, 120));
    update(wall);
    snapshot s = plain();
    s.lights[0] = light_at(0, 0, -60);
    s.box_lo = {-4, -4, -40};
    s.box_hi = {4, 4, -36};
    const view_stage_picture none = draw(s);
    s.lights_shown = s.box_shown = true;
    EXPECT_EQ(draw(s).changed(none), 0);
}

} // namespace
