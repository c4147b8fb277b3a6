/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: each eye's projection is right by geometry: nothing is higher in one eye than in the other, the plane lies on
 *       the same pixels, near is crossed and far is not, for whole pictures, parts, mirrored ones and every layout;
 *       the separation keeps its limits; the layouts' sizes and shares add up.
 * Method: seeded points and cameras; lines of sight and similar triangles, worked out here anew; shares against every
 *         pixel. No context. */
#include "view/stereo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace {

constexpr int wide = 640, high = 360;
constexpr stereo_eye eyes_both[] = {STEREO_LEFT, STEREO_RIGHT};

glm::dvec3 clip_of(const projection &p, const glm::dvec3 &world)
{
    const glm::dvec4 clip = p.clip_from_eye * (p.eye_from_world * glm::dvec4(world, 1));
    return glm::dvec3(clip) / clip.w;
}

glm::dvec3 clip_of_mono(const stereo_seen &s, const glm::dvec3 &mono)
{
    const glm::dvec4 clip = s.seen.clip_from_eye * (s.eye_from_mono * glm::dvec4(mono, 1));
    return glm::dvec3(clip) / clip.w;
}

/* A camera somewhere, looking at something. */
struct camera {
    snapshot s;
    projection mono;
    double across, up; /* half the view's width and height at a depth of 1 */
};

class stereo_geometry : public testing::Test {
  protected:
    std::mt19937 random{11};

    double between(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); }

    camera any_camera()
    {
        camera c;
        c.s.camera_distance = between(50, 500);
        c.s.field_of_view = between(0.2, 1.5);
        c.s.eyes.plane_mm = c.s.camera_distance * between(0.35, 2.5);
        const glm::dvec4 turn = glm::normalize(
            glm::dvec4(between(-1, 1), between(-1, 1), between(-1, 1), between(0.1, 1)));
        c.s.scene_turn = {turn.x, turn.y, turn.z, turn.w};
        c.s.scene_shift = {between(-20, 20), between(-20, 20), between(-20, 20)};
        c.mono = projection_make(c.s, wide, high, {{{0, 0, -c.s.camera_distance}, 0.5 * c.s.camera_distance}});
        c.up = std::tan(0.5 * c.s.field_of_view);
        c.across = c.up * wide / high;
        return c;
    }
    /* In mono's eye space; a corner of the view is as likely as its inside. */
    glm::dvec3 any_point(const camera &c, double depth)
    {
        const auto edge = [&] { return between(0, 1) < 0.3 ? (between(0, 1) < 0.5 ? -1.0 : 1.0) : between(-1, 1); };
        return {edge() * c.across * depth, edge() * c.up * depth, -depth};
    }
};

TEST_F(stereo_geometry, a_point_on_the_plane_is_on_the_same_pixel_in_both_eyes)
{
    for (int round = 0; round < 2000; round++) {
        const camera c = any_camera();
        const double separation = between(0.1, 20);
        const glm::dvec3 at = any_point(c, c.s.eyes.plane_mm);
        const glm::dvec4 mono = c.mono.clip_from_eye * glm::dvec4(at, 1);
        for (stereo_eye eye : eyes_both) {
            const stereo_seen s = stereo_see(c.mono, c.s.eyes.plane_mm, separation, eye);
            ASSERT_NEAR(clip_of_mono(s, at).x, mono.x / mono.w, 1e-12);
            ASSERT_NEAR(clip_of_mono(s, at).y, mono.y / mono.w, 1e-12);
        }
    }
}

TEST_F(stereo_geometry, no_point_is_higher_in_one_eye_and_depth_is_the_same)
{
    for (int round = 0; round < 5000; round++) {
        const camera c = any_camera();
        const double separation = between(0, 20);
        const stereo_seen l = stereo_see(c.mono, c.s.eyes.plane_mm, separation, STEREO_LEFT);
        const stereo_seen r = stereo_see(c.mono, c.s.eyes.plane_mm, separation, STEREO_RIGHT);
        const glm::dvec3 at = any_point(c, between(c.mono.near_mm, c.mono.far_mm));
        const glm::dvec3 world(glm::inverse(c.mono.eye_from_world) * glm::dvec4(at, 1));
        ASSERT_EQ(clip_of_mono(l, at).y, clip_of_mono(r, at).y) << "to the last bit";
        ASSERT_NEAR(clip_of(l.seen, world).y, clip_of(c.mono, world).y, 1e-9);
        ASSERT_NEAR(clip_of(r.seen, world).y, clip_of(c.mono, world).y, 1e-9);
        ASSERT_NEAR(clip_of(l.seen, world).z, clip_of(c.mono, world).z, 1e-9);
        ASSERT_NEAR(clip_of(r.seen, world).z, clip_of(c.mono, world).z, 1e-9);
        ASSERT_EQ(l.seen.near_mm, c.mono.near_mm);
        ASSERT_EQ(r.seen.far_mm, c.mono.far_mm);
    }
}

/* The line of sight from an eye at x to the point meets the plane at u; that, in half widths of the plane, is where the
   point is seen. */
double sight(const camera &c, double x, const glm::dvec3 &at)
{
    const double f = c.s.eyes.plane_mm, u = x + (at.x - x) * f / -at.z;
    return u / (c.across * f);
}

TEST_F(stereo_geometry, each_eye_sees_a_point_where_its_line_of_sight_meets_the_plane)
{
    for (int round = 0; round < 5000; round++) {
        const camera c = any_camera();
        const double separation = between(0.5, 20);
        const glm::dvec3 at = any_point(c, between(c.mono.near_mm, c.mono.far_mm));
        const stereo_seen l = stereo_see(c.mono, c.s.eyes.plane_mm, separation, STEREO_LEFT);
        const stereo_seen r = stereo_see(c.mono, c.s.eyes.plane_mm, separation, STEREO_RIGHT);
        ASSERT_NEAR(clip_of_mono(l, at).x, sight(c, -separation / 2, at), 1e-9);
        ASSERT_NEAR(clip_of_mono(r, at).x, sight(c, separation / 2, at), 1e-9);
    }
}

TEST_F(stereo_geometry, near_is_crossed_and_far_is_not_mirrored_or_turned_as_well)
{
    for (int round = 0; round < 2000; round++) {
        camera c = any_camera();
        if (round % 2 == 1) /* as a mirrored picture is made: left for right, at the very end */
            for (int column = 0; column < 4; column++)
                c.mono.clip_from_eye[column][0] = -c.mono.clip_from_eye[column][0];
        const stereo_seen l = stereo_see(c.mono, c.s.eyes.plane_mm, 5, STEREO_LEFT);
        const stereo_seen r = stereo_see(c.mono, c.s.eyes.plane_mm, 5, STEREO_RIGHT);
        const glm::dvec3 before = any_point(c, c.s.eyes.plane_mm * between(0.2, 0.95));
        const glm::dvec3 behind = any_point(c, c.s.eyes.plane_mm * between(1.05, 5));
        const glm::dvec3 on = any_point(c, c.s.eyes.plane_mm);
        ASSERT_GT(clip_of_mono(l, before).x, clip_of_mono(r, before).x + 1e-6) << "round " << round;
        ASSERT_LT(clip_of_mono(l, behind).x, clip_of_mono(r, behind).x - 1e-6) << "round " << round;
        ASSERT_NEAR(clip_of_mono(l, on).x, clip_of_mono(r, on).x, 1e-12);
        const glm::dvec3 endless = 1e9 * glm::dvec3(0.1, 0.1, -1);
        const glm::dvec4 mono = c.mono.clip_from_eye * glm::dvec4(endless, 1);
        ASSERT_NEAR(clip_of_mono(l, endless).x, mono.x / mono.w + l.far_shift, 1e-7);
        ASSERT_NEAR(clip_of_mono(r, endless).x, mono.x / mono.w + r.far_shift, 1e-7);
    }
}

TEST_F(stereo_geometry, the_eyes_stand_left_and_right_of_mono_and_a_lamp_stays_where_it_is)
{
    const camera c = any_camera();
    const glm::dvec3 lamp(3, 40, -20);
    std::array<glm::dvec3, 2> seen_lamp, seen_eye;
    for (stereo_eye eye : eyes_both) {
        const stereo_seen s = stereo_see(c.mono, c.s.eyes.plane_mm, 6, eye);
        seen_lamp[eye] = glm::dvec3(s.eye_from_mono * glm::dvec4(lamp, 1));
        seen_eye[eye] = glm::dvec3(glm::inverse(s.eye_from_mono) * glm::dvec4(0, 0, 0, 1));
        const glm::dvec4 world(1, 2, 3, 1);
        const glm::dvec4 by_mono = s.eye_from_mono * (c.mono.eye_from_world * world);
        EXPECT_LT(glm::length(s.seen.eye_from_world * world - by_mono), 1e-12);
    }
    EXPECT_LT(glm::length(seen_eye[STEREO_LEFT] - glm::dvec3(-3, 0, 0)), 1e-12);
    EXPECT_LT(glm::length(seen_eye[STEREO_RIGHT] - glm::dvec3(3, 0, 0)), 1e-12);
    EXPECT_LT(glm::length(seen_lamp[STEREO_LEFT] - glm::dvec3(6, 40, -20)), 1e-12);
    EXPECT_LT(glm::length(seen_lamp[STEREO_RIGHT] - glm::dvec3(0, 40, -20)), 1e-12);
}

TEST_F(stereo_geometry, without_separation_both_eyes_are_mono)
{
    for (int round = 0; round < 100; round++) {
        const camera c = any_camera();
        for (stereo_eye eye : eyes_both) {
            const stereo_seen s = stereo_see(c.mono, c.s.eyes.plane_mm, 0, eye);
            ASSERT_TRUE(s.seen.clip_from_eye == c.mono.clip_from_eye);
            ASSERT_TRUE(s.seen.eye_from_world == c.mono.eye_from_world);
            ASSERT_TRUE(s.eye_from_mono == glm::dmat4(1));
            ASSERT_EQ(s.far_shift, 0);
        }
    }
}

/* Pixels from the top left of an eye's picture of size. */
glm::dvec2 pixel_of(const glm::dvec3 &clip, int width, int height)
{
    return {(clip.x + 1) / 2 * width, (1 - clip.y) / 2 * height};
}

TEST_F(stereo_geometry, a_part_shows_what_the_whole_shows_there)
{
    for (int round = 0; round < 1000; round++) {
        const camera c = any_camera();
        const int x = static_cast<int>(between(0, 500)), y = static_cast<int>(between(0, 300));
        const int w = 1 + static_cast<int>(between(0, 130)), h = 1 + static_cast<int>(between(0, 50));
        const projection some_mono = projection_of_part(c.mono, wide, high, {x, y, w, h});
        const glm::dvec3 at = any_point(c, between(c.mono.near_mm, c.mono.far_mm));
        for (stereo_eye eye : eyes_both) {
            const stereo_seen all = stereo_see(c.mono, c.s.eyes.plane_mm, 4, eye);
            const stereo_seen some = stereo_see(some_mono, c.s.eyes.plane_mm, 4, eye);
            const glm::dvec2 in_all = pixel_of(clip_of_mono(all, at), wide, high);
            const glm::dvec2 in_some = pixel_of(clip_of_mono(some, at), w, h);
            ASSERT_NEAR(in_some.x + x, in_all.x, 1e-6);
            ASSERT_NEAR(in_some.y + y, in_all.y, 1e-6);
            ASSERT_NEAR(some.far_shift * w, all.far_shift * wide, 1e-9) << "the same in pixels";
        }
    }
}

/* --- the separation --- */

TEST_F(stereo_geometry, separation_is_what_was_asked_for_until_parallax_is_at_its_limit)
{
    int limited = 0, free = 0;
    for (int round = 0; round < 2000; round++) {
        camera c = any_camera();
        c.s.eyes.separation = between(0, 0.2);
        const double plane = c.s.eyes.plane_mm;
        const double nearest = plane * between(0.1, 1.5), farthest = nearest + plane * between(0, 3);
        const double got = stereo_separation_mm(c.s.eyes, c.mono, nearest, farthest);
        ASSERT_LE(got, c.s.eyes.separation * plane * (1 + 1e-12));
        const stereo_seen l = stereo_see(c.mono, plane, got, STEREO_LEFT);
        const stereo_seen r = stereo_see(c.mono, plane, got, STEREO_RIGHT);
        double most = 0; /* of the picture's width, which is 2 in clip space */
        for (double depth : {nearest, farthest})
            most = std::max(most, std::abs(clip_of_mono(l, {0, 0, -depth}).x - clip_of_mono(r, {0, 0, -depth}).x) / 2);
        ASSERT_LE(most, STEREO_PARALLAX_MAX * (1 + 1e-9));
        if (got < c.s.eyes.separation * plane * (1 - 1e-12)) {
            limited++;
            ASSERT_NEAR(most, STEREO_PARALLAX_MAX, 1e-9) << "no more is taken away than must be";
        } else {
            free++;
        }
    }
    EXPECT_GT(limited, 200);
    EXPECT_GT(free, 200);
}

TEST(stereo, the_rule_of_thumb_is_just_comfortable)
{
    /* A view as wide as the plane is far: clip_from_eye's first element is 2. */
    projection whole{};
    whole.clip_from_eye[0][0] = 2;
    snapshot_eyes eyes;
    eyes.separation = 1.0 / 30;
    eyes.plane_mm = 300;
    EXPECT_NEAR(stereo_separation_mm(eyes, whole, 150, 300), 10, 1e-12) << "nothing nearer than half the plane";
    EXPECT_NEAR(stereo_separation_mm(eyes, whole, 100, 300), 5, 1e-12) << "1/100 - 1/300 is twice 1/150 - 1/300";
    EXPECT_NEAR(stereo_separation_mm(eyes, whole, 300, std::numeric_limits<double>::infinity()), 10, 1e-12);
    EXPECT_NEAR(stereo_separation_mm(eyes, whole, 300, 300), 10, 1e-12) << "flat: no parallax at all";
}

/* --- layouts --- */

constexpr snapshot_layout layouts_all[] = {
    SNAPSHOT_LAYOUT_MONO,   SNAPSHOT_LAYOUT_SIDE_HALF, SNAPSHOT_LAYOUT_SIDE_FULL, SNAPSHOT_LAYOUT_TOP_HALF,
    SNAPSHOT_LAYOUT_TOP_FULL, SNAPSHOT_LAYOUT_ROWS,    SNAPSHOT_LAYOUT_COLUMNS,   SNAPSHOT_LAYOUT_CHECKER,
    SNAPSHOT_LAYOUT_ANAGLYPH, SNAPSHOT_LAYOUT_PACKED};
static_assert(sizeof layouts_all / sizeof *layouts_all == SNAPSHOT_LAYOUTS);

void expect_size(const stereo_size &got, int width, int height, const char *what)
{
    EXPECT_EQ(got.width, width) << what;
    EXPECT_EQ(got.height, height) << what;
}

TEST(stereo, sizes_of_every_layout)
{
    struct row {
        snapshot_layout layout;
        int width, height, gap;             /* finished */
        stereo_size eye, shape;
    };
    const row rows[] = {
        {SNAPSHOT_LAYOUT_MONO, 1920, 1080, 0, {1920, 1080}, {1920, 1080}},
        {SNAPSHOT_LAYOUT_SIDE_HALF, 1920, 1080, 0, {960, 1080}, {1920, 1080}},
        {SNAPSHOT_LAYOUT_SIDE_FULL, 3840, 1080, 0, {1920, 1080}, {1920, 1080}},
        {SNAPSHOT_LAYOUT_TOP_HALF, 1920, 1080, 0, {1920, 540}, {1920, 1080}},
        {SNAPSHOT_LAYOUT_TOP_FULL, 1920, 2160, 0, {1920, 1080}, {1920, 1080}},
        {SNAPSHOT_LAYOUT_ROWS, 1920, 1080, 0, {1920, 1080}, {1920, 1080}},
        {SNAPSHOT_LAYOUT_COLUMNS, 1920, 1080, 0, {1920, 1080}, {1920, 1080}},
        {SNAPSHOT_LAYOUT_CHECKER, 1920, 1080, 0, {1920, 1080}, {1920, 1080}},
        {SNAPSHOT_LAYOUT_ANAGLYPH, 1920, 1080, 0, {1920, 1080}, {1920, 1080}},
        {SNAPSHOT_LAYOUT_PACKED, 1920, 2205, 45, {1920, 1080}, {1920, 1080}},
        {SNAPSHOT_LAYOUT_PACKED, 1280, 1470, 30, {1280, 720}, {1280, 720}},
    };
    for (const row &r : rows) {
        const std::string what = "layout " + std::to_string(r.layout);
        const stereo_screen whole = {r.layout, false, r.width, r.height, r.gap};
        EXPECT_EQ(stereo_trouble({}, whole), "");
        expect_size(stereo_eye_size(whole), r.eye.width, r.eye.height, what.c_str());
        expect_size(stereo_shape(whole), r.shape.width, r.shape.height, what.c_str());
        expect_size(stereo_finished(r.layout, r.shape.width, r.shape.height, r.gap), r.width, r.height, what.c_str());
    }
    EXPECT_EQ(stereo_gap_usual(2205), 45);
    EXPECT_EQ(stereo_gap_usual(1470), 30);
    for (int height = 2; height < 3000; height++) {
        const stereo_screen any = {SNAPSHOT_LAYOUT_PACKED, false, 8, height, stereo_gap_usual(height)};
        EXPECT_EQ(stereo_trouble({}, any), "") << height;
    }
}

/* A square on the plane is square on the screen: a half layout's picture is stretched back before it is seen. */
TEST(stereo, a_square_is_square_in_every_layout)
{
    for (snapshot_layout layout : layouts_all) {
        const stereo_screen whole = {layout, false, 640, 360, layout == SNAPSHOT_LAYOUT_PACKED ? 10 : 0};
        const stereo_size size = stereo_eye_size(whole), shape = stereo_shape(whole);
        snapshot s;
        const projection mono = projection_make(s, shape.width, shape.height, {});
        const stereo_seen seen = stereo_see(mono, 150, 7, STEREO_RIGHT);
        const glm::dvec2 low = pixel_of(clip_of_mono(seen, {-9, 8, -150}), size.width, size.height);
        const glm::dvec2 hi = pixel_of(clip_of_mono(seen, {1, -2, -150}), size.width, size.height);
        const double across = layout == SNAPSHOT_LAYOUT_SIDE_HALF ? 2 : 1;
        const double down = layout == SNAPSHOT_LAYOUT_TOP_HALF ? 2 : 1;
        EXPECT_NEAR((hi.x - low.x) * across, (hi.y - low.y) * down, 1e-9) << "layout " << layout;
    }
}

bool holds(const stereo_share &s, int x, int y)
{
    return x >= s.x && x < s.x + s.of_eye.width && y >= s.y && y < s.y + s.of_eye.height;
}

/* How often each pixel of the eye's picture shows, when the whole is made of parts; -1 where a part shows another than
   the whole does. */
std::vector<int> shown_by_parts(const stereo_screen &whole, stereo_eye eye)
{
    const stereo_size size = stereo_eye_size(whole);
    const stereo_share all = stereo_share_of(whole, eye, {0, 0, whole.width, whole.height});
    std::vector<int> shown(static_cast<size_t>(size.width * size.height), 0);
    for (int y = 0; y < whole.height; y++) {
        for (int x = 0; x < whole.width; x++) {
            const projection_part part = {x - x % 11, y - y % 7, std::min(11, whole.width - (x - x % 11)),
                                          std::min(7, whole.height - (y - y % 7))};
            const stereo_share s = stereo_share_of(whole, eye, part);
            EXPECT_EQ(holds(s, x - part.x, y - part.y), holds(all, x, y)) << x << ", " << y;
            if (!holds(s, x - part.x, y - part.y))
                continue;
            const int column = s.of_eye.x + x - part.x - s.x, row = s.of_eye.y + y - part.y - s.y;
            int &count = shown.at(static_cast<size_t>(row * size.width + column));
            count = column == x - all.x && row == y - all.y ? count + 1 : -1;
        }
    }
    return shown;
}

TEST(stereo, parts_share_out_each_eye_once_and_whole)
{
    for (snapshot_layout layout : layouts_all) {
        for (bool swapped : {false, true}) {
            const stereo_screen whole = {layout, swapped, 37, 29, layout == SNAPSHOT_LAYOUT_PACKED ? 5 : 0};
            for (stereo_eye eye : eyes_both) {
                const std::vector<int> shown = shown_by_parts(whole, eye);
                const int once = layout == SNAPSHOT_LAYOUT_MONO && eye == STEREO_RIGHT ? 0 : 1;
                EXPECT_EQ(std::count(shown.begin(), shown.end(), once), static_cast<ptrdiff_t>(shown.size()))
                    << "layout " << layout << ", eye " << eye;
            }
        }
    }
}

TEST(stereo, swapped_gives_each_eye_the_others_place)
{
    for (snapshot_layout layout : layouts_all) {
        if (layout == SNAPSHOT_LAYOUT_MONO)
            continue;
        const stereo_screen whole = {layout, false, 40, 33, layout == SNAPSHOT_LAYOUT_PACKED ? 3 : 0};
        stereo_screen other = whole;
        other.swapped = true;
        const projection_part all = {0, 0, 40, 33};
        const stereo_share left = stereo_share_of(whole, STEREO_LEFT, all);
        const stereo_share right = stereo_share_of(whole, STEREO_RIGHT, all);
        const stereo_share other_left = stereo_share_of(other, STEREO_LEFT, all);
        EXPECT_EQ(left.x, 0);
        EXPECT_EQ(left.y, 0) << "the left eye comes first";
        EXPECT_EQ(other_left.x, right.x);
        EXPECT_EQ(other_left.y, right.y);
        EXPECT_EQ(stereo_share_of(other, STEREO_RIGHT, all).x, 0);
        EXPECT_EQ(stereo_share_of(other, STEREO_RIGHT, all).y, 0);
    }
}

TEST(stereo, says_what_cannot_be_drawn)
{
    const auto says = [](const snapshot_eyes &eyes, const stereo_screen &whole, const char *words) {
        const std::string trouble = stereo_trouble(eyes, whole);
        EXPECT_NE(trouble.find(words), std::string::npos) << trouble;
    };
    const stereo_screen good = {SNAPSHOT_LAYOUT_ROWS, false, 8, 8, 0};
    snapshot_eyes eyes;
    for (double wrong : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        eyes = {};
        eyes.plane_mm = wrong;
        says(eyes, good, "plane_mm");
    }
    for (double wrong : {-0.01, std::nan(""), std::numeric_limits<double>::infinity()}) {
        eyes = {};
        eyes.separation = wrong;
        says(eyes, good, "separation");
    }
    says({}, {static_cast<snapshot_layout>(SNAPSHOT_LAYOUTS), false, 8, 8, 0}, "layout");
    says({}, {SNAPSHOT_LAYOUT_SIDE_HALF, false, 1, 8, 0}, "no room");
    says({}, {SNAPSHOT_LAYOUT_TOP_FULL, false, 8, 1, 0}, "no room");
    says({}, {SNAPSHOT_LAYOUT_PACKED, false, 8, 10, 9}, "no room");
    says({}, {SNAPSHOT_LAYOUT_PACKED, false, 8, 10, 3}, "even");
    says({}, {SNAPSHOT_LAYOUT_PACKED, false, 8, 10, -2}, "gap of -2");
    says({}, {SNAPSHOT_LAYOUT_ANAGLYPH, false, 0, 8, 0}, "no room");
}

} // namespace
