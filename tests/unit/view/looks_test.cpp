/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the looks and effects of today do what their names say where they should and nothing elsewhere; what a device
 *       cannot do makes the picture poorer, and never none.
 * Method: balls whose shadows, hollows and mirror images can be told by geometry; each effect on and off. */
#include "view_stage.h"

#include <algorithm>

namespace {

constexpr uint32_t clay_rgba = view_stage_rgba(190, 120, 80);
constexpr double radius = 24;

class view_looks : public view_stage {
  protected:
    static snapshot looked_at(snapshot_look look = SNAPSHOT_LOOK_CLAY)
    {
        snapshot s = plain();
        s.look = look;
        s.effects.floor = false;
        s.camera_distance = 200;
        s.box_lo = {-40, -radius, -40};
        s.box_hi = {40, 40, 40};
        return s;
    }
    void ball(double at_x = 0, double r = radius)
    {
        it_piece.ball({static_cast<int32_t>(at_x), 0, 0}, r, clay_rgba);
        update(it_piece);
    }
    /* Tilted, so that the turntable is seen from above. */
    static void tilt(snapshot *s, double radians)
    {
        s->scene_turn = {std::cos(radians / 2), std::sin(radians / 2), 0, 0};
    }
    view_stage_piece it_piece;
};

TEST_F(view_looks, a_ball_throws_its_shadow_on_another_and_only_there)
{
    ball(-30, 16);
    it_piece.ball({24, 0, 0}, 24, clay_rgba);
    update(it_piece);
    snapshot s = looked_at();
    s.effects.occlusion = 0;
    s.lights = {};
    s.lights[0] = light_at(-400, 0, -200); /* eye space: from the left, at the balls' depth */
    const view_stage_picture with = draw(s);
    s.effects.shadows = false;
    const view_stage_picture without = draw(s);
    /* left is the ball that stands in the light */
    const auto darker = [&](double from, double to) {
        int count = 0;
        for (int y = 0; y < height; y++)
            for (int x = static_cast<int>(width / 2 + from * focal_pixels(s) / 200);
                 x < static_cast<int>(width / 2 + to * focal_pixels(s) / 200); x++)
                count += without.light(x, y) > with.light(x, y) + 0.02;
        return count;
    };
    EXPECT_GT(darker(0, 24), 150) << "the lit side of the other ball";
    EXPECT_EQ(darker(-48, -34), 0) << "nothing stands in the first one's light";
    const double middle = 0.5 * (height - 1);
    const int lit_x = static_cast<int>(width / 2 + 6 * focal_pixels(s) / 200);
    EXPECT_LT(with.light(lit_x, static_cast<int>(middle)), 0.6 * without.light(lit_x, static_cast<int>(middle)));
}

TEST_F(view_looks, clay_does_not_shade_itself_where_nothing_is_in_the_way)
{
    ball();
    snapshot s = looked_at();
    s.effects.occlusion = 0;
    const view_stage_picture with = draw(s);
    s.effects.shadows = false;
    const view_stage_picture without = draw(s);
    EXPECT_LT(with.changed(without, 6), 60) << "a ball alone: acne would speckle thousands of pixels";
}

TEST_F(view_looks, the_crease_between_two_balls_is_darker)
{
    ball(-18, 20);
    it_piece.ball({18, 0, 0}, 20, clay_rgba);
    update(it_piece);
    snapshot s = looked_at();
    s.effects.shadows = false;
    s.effects.occlusion = 1;
    const view_stage_picture with = draw(s);
    s.effects.occlusion = 0;
    const view_stage_picture without = draw(s);
    const auto ratio = [&](double mm) {
        double a = 0, b = 0;
        for (int dx = -2; dx <= 2; dx++) {
            const int x = static_cast<int>(width / 2 + mm * focal_pixels(s) / 200) + dx;
            a += with.light(x, height / 2);
            b += without.light(x, height / 2);
        }
        return a / b;
    };
    EXPECT_LT(ratio(0), 0.8) << "in the crease";
    EXPECT_GT(ratio(-22), 0.9) << "on a ball's open front";
    EXPECT_GT(ratio(22), 0.9);
}

/* On the floor nothing bends: what is darker there is the sky that the ball hides. */
TEST_F(view_looks, the_floor_is_darker_where_the_ball_stands)
{
    ball();
    snapshot s = looked_at();
    s.effects.floor = true;
    s.effects.shadows = false;
    tilt(&s, 0.5);
    s.effects.occlusion = 1;
    const view_stage_picture with = draw(s);
    s.effects.occlusion = 0;
    const view_stage_picture without = draw(s);
    /* Before the ball's foot, `out` mm from where it touches: turned about x by half a radian. */
    const auto ratio = [&](double out) {
        const double y = -radius * std::cos(0.5) - out * std::sin(0.5);
        const double ahead = 200 - (-radius * std::sin(0.5) + out * std::cos(0.5));
        const int row = static_cast<int>(height / 2 - focal_pixels(s) * y / ahead);
        double a = 0, b = 0;
        for (int x = width / 2 - 4; x <= width / 2 + 4; x++) {
            a += with.light(x, row);
            b += without.light(x, row);
        }
        return a / b;
    };
    EXPECT_LT(ratio(20), 0.92);
    EXPECT_GT(ratio(40), ratio(20) + 0.03);
}

TEST_F(view_looks, the_turntable_is_there_from_above_and_not_from_below)
{
    ball();
    snapshot s = looked_at();
    s.effects.floor = true;
    const auto low = [](double, double y) { return y > 0.8 * height; };
    for (double radians : {0.4, -0.4}) {
        tilt(&s, radians);
        s.effects.floor = false;
        const view_stage_picture none = draw(s);
        s.effects.floor = true;
        const view_stage_picture with = draw(s);
        if (radians > 0)
            EXPECT_GT(with.changed(none, low, 2), 1000);
        else
            EXPECT_EQ(with.changed(none, 2), 0) << "the piece's foot is seen";
    }
}

TEST_F(view_looks, the_turntable_takes_the_shadow)
{
    ball();
    snapshot s = looked_at();
    s.effects.floor = true;
    s.effects.occlusion = 0;
    tilt(&s, 0.5);
    s.lights = {};
    s.lights[0] = {true, false, {-300, 300, 0}, {1, 1, 1}, 1}; /* 45 degrees up, left */
    const view_stage_picture with = draw(s);
    s.effects.shadows = false;
    const view_stage_picture without = draw(s);
    /* The shadow's middle: the ball's, along the light to the floor, 24 mm lower. */
    const double c = std::cos(0.5), sn = std::sin(0.5);
    const double x = 24, y = -24 * c, ahead = 200 + 24 * sn;
    const int px = static_cast<int>(width / 2 + focal_pixels(s) * x / ahead);
    const int py = static_cast<int>(height / 2 - focal_pixels(s) * y / ahead);
    EXPECT_LT(with.light(px, py), 0.8 * without.light(px, py));
    const int mirrored = width - 1 - px;
    EXPECT_NEAR(with.light(mirrored, py), without.light(mirrored, py), 0.01) << "no shadow towards the lamp";
}

TEST_F(view_looks, a_silhouette_has_two_tones)
{
    ball();
    const view_stage_picture p = draw(looked_at(SNAPSHOT_LOOK_SILHOUETTE));
    EXPECT_LT(p.light(width / 2, height / 2), 0.05);
    EXPECT_GT(p.light(4, 4), 0.4);
    int between = 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            between += p.light(x, y) > 0.05 && p.light(x, y) < 0.4;
    EXPECT_LT(between, 400) << "the rim's own pixels, no more";
    EXPECT_GT(between, 20) << "and those are smooth";
}

TEST_F(view_looks, raking_light_grazes_from_the_left)
{
    ball();
    snapshot s = looked_at(SNAPSHOT_LOOK_RAKING);
    s.lights = {};
    const view_stage_picture p = draw(s);
    const int part = static_cast<int>(0.6 * ball_pixels(s, radius));
    EXPECT_GT(p.light(width / 2 - part, height / 2), 5 * p.light(width / 2 + part, height / 2));
    EXPECT_NEAR(p.linear(width / 2 - part, height / 2, 0), p.linear(width / 2 - part, height / 2, 2), 0.01)
        << "the clay's colour does not distract";
}

TEST_F(view_looks, raking_light_throws_long_shadows)
{
    ball(-30, 20);
    it_piece.ball({24, -8, -4}, 20, clay_rgba); /* where the lamp's rays lead, a little below and behind */
    update(it_piece);
    snapshot s = looked_at(SNAPSHOT_LOOK_RAKING);
    s.effects.occlusion = 0;
    const view_stage_picture with = draw(s);
    s.effects.shadows = false;
    const view_stage_picture without = draw(s);
    int darker = 0;
    for (int y = 0; y < height; y++)
        for (int x = width / 2; x < width; x++)
            darker += with.light(x, y) < 0.5 * without.light(x, y);
    EXPECT_GT(darker, 150);
}

TEST_F(view_looks, mirrored_is_left_for_right)
{
    ball(-14, 20);
    it_piece.ball({20, 14, 0}, 10, view_stage_rgba(40, 90, 200));
    update(it_piece);
    for (snapshot_look look : {SNAPSHOT_LOOK_PLAIN, SNAPSHOT_LOOK_CLAY}) {
        snapshot s = looked_at(look);
        s.effects.shadows = false; /* their noise is the screen's */
        s.effects.occlusion = 0;
        const view_stage_picture straight = draw(s);
        s.effects.mirrored = true;
        const view_stage_picture turned = draw(s);
        int off = 0, same = 0;
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++)
                for (int c = 0; c < 3; c++) {
                    off += std::abs(turned.byte(width - 1 - x, y, c) - straight.byte(x, y, c)) > 6;
                    same += std::abs(turned.byte(x, y, c) - straight.byte(x, y, c)) <= 6;
                }
        EXPECT_LT(off, 3 * width * height / 200) << "but for edges' samples";
        EXPECT_LT(same, 3 * width * height * 98 / 100) << "the piece is lopsided";
    }
}

TEST_F(view_looks, a_wide_lens_blurs_what_is_far_from_the_work)
{
    ball(-26, 18);
    it_piece.ball({40, 0, -90}, 18, clay_rgba);
    update(it_piece);
    snapshot s = looked_at();
    s.eyes.plane_mm = 200 - 12;
    const view_stage_picture sharp = draw(s);
    s.effects.blur = 1;
    const view_stage_picture blurred = draw(s);
    /* The steepest step along the row through both middles, left and right half. */
    const auto steepest = [&](const view_stage_picture &p, int from, int to) {
        double most = 0;
        for (int x = from + 1; x < to; x++)
            most = std::max(most, std::abs(p.light(x, height / 2) - p.light(x - 1, height / 2)));
        return most;
    };
    EXPECT_LT(steepest(blurred, width / 2 + 20, width), 0.7 * steepest(sharp, width / 2 + 20, width)) << "far away";
    EXPECT_GT(steepest(blurred, 0, width / 2 - 20), 0.6 * steepest(sharp, 0, width / 2 - 20)) << "at the work";
}

TEST_F(view_looks, a_picture_that_is_brought_is_what_metal_shows)
{
    ball();
    snapshot s = looked_at();
    s.effects.occlusion = 0;
    s.environment = SNAPSHOT_ENVIRONMENT_OPAQUE;
    s.scenery = SNAPSHOT_SCENERY_OWN;
    const view_stage_picture studio = draw(s);
    scenery_picture own{64, 32, {}};
    for (int y = 0; y < 32; y++)
        for (int x = 0; x < 64; x++) /* a panorama: red above, green below; the studio's left for right cannot be */
            for (uint8_t byte : {y < 16 ? 180 : 20, y < 16 ? 20 : 180, 20, 255})
                own.rgba.push_back(byte);
    ASSERT_TRUE(view_scenery(it, own, &trouble)) << trouble;
    const view_stage_picture brought = draw(s);
    const int part = static_cast<int>(0.5 * ball_pixels(s, radius));
    EXPECT_GT(brought.linear(width / 2, height / 2 - part, 0), 4 * brought.linear(width / 2, height / 2 - part, 1));
    EXPECT_GT(brought.linear(width / 2, height / 2 + part, 1), 4 * brought.linear(width / 2, height / 2 + part, 0));
    EXPECT_GT(brought.changed(studio, 8), 1000);
    own.rgba.pop_back();
    EXPECT_FALSE(view_scenery(it, own, &trouble));
    EXPECT_NE(trouble.find("scenery"), std::string::npos);
    EXPECT_EQ(draw(s).apart(brought), 0) << "the one before stays";
}

/* Every effect that a device may lack, alone and all together. */
TEST_F(view_looks, a_poorer_device_gives_a_poorer_picture_and_says_so)
{
    ball();
    snapshot s = looked_at();
    s.effects.floor = true;
    s.effects.blur = 0.5f;
    s.box_shown = true;
    tilt(&s, 0.4);
    const view_stage_picture whole = draw(s);
    EXPECT_EQ(view_lacks(it), "");
    std::array<view_limits, 11> poor;
    poor[0].clay = false;
    poor[1].shadows = false;
    poor[2].hollows = false;
    poor[3].wheel = false;
    poor[4].lens = false;
    poor[5].samples = 0;
    poor[6].stereo = false;
    poor[7].backdrop = false;
    poor[8].marks = false;
    poor[9].cubes = false;
    poor[10] = {0, false, false, false, false, false, false, false, false, false, false};
    for (size_t n = 0; n < poor.size(); n++) {
        view *v = view_open(&trouble, poor[n]);
        ASSERT_NE(v, nullptr) << trouble;
        ASSERT_TRUE(view_update(v, it_piece.it.get(), &trouble)) << trouble;
        for (snapshot_look look : {SNAPSHOT_LOOK_CLAY, SNAPSHOT_LOOK_RAKING, SNAPSHOT_LOOK_SILHOUETTE,
                                   SNAPSHOT_LOOK_PLAIN}) {
            s.look = look;
            view_stage_picture p{width, height, {}};
            ASSERT_TRUE(view_draw(v, s, width, height, &trouble)) << trouble;
            ASSERT_TRUE(view_pixels(v, &p.rgba, &trouble)) << trouble;
            EXPECT_GT(std::abs(p.light(width / 2, height / 2) - p.light(3, 3)), 0.03) << "the ball is seen";
            if (look == SNAPSHOT_LOOK_CLAY && n != 5 && n != 6 && n != 9) {
                EXPECT_GT(p.changed(whole, 3), 30) << "limit " << n << " makes no difference";
            }
        }
        EXPECT_EQ(view_lacks(v).empty(), n == 5) << view_lacks(v);
        view_close(v);
    }
}

TEST_F(view_looks, without_multisampling_edges_are_smooth_all_the_same)
{
    ball();
    const snapshot s = looked_at(SNAPSHOT_LOOK_SILHOUETTE);
    view_limits lone;
    lone.samples = 0;
    view *v = view_open(&trouble, lone);
    ASSERT_NE(v, nullptr) << trouble;
    ASSERT_TRUE(view_update(v, it_piece.it.get(), &trouble)) << trouble;
    view_stage_picture p{width, height, {}};
    ASSERT_TRUE(view_draw(v, s, width, height, &trouble)) << trouble;
    ASSERT_TRUE(view_pixels(v, &p.rgba, &trouble)) << trouble;
    EXPECT_EQ(view_count(v).samples, 0);
    view_close(v);
    const view_stage_picture many = draw(s);
    const auto between = [&](const view_stage_picture &q) {
        int count = 0;
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++)
                count += q.light(x, y) > 0.1 && q.light(x, y) < 0.4;
        return count;
    };
    EXPECT_GT(between(p), between(many) / 2);
    EXPECT_GT(between(many), 20);
}

TEST_F(view_looks, every_level_of_quality_gives_a_picture)
{
    ball();
    snapshot s = looked_at();
    s.effects.floor = true;
    s.effects.blur = 0.5f;
    tilt(&s, 0.4);
    view_stage_picture before = draw(s);
    std::string said;
    for (int level = 1; level < QUALITY_LEVELS; level++) {
        int frames = 0;
        while (!view_frame_took(it, 2 * QUALITY_FRAME_NS))
            ASSERT_LT(frames++, 100);
        EXPECT_NE(view_quality(it), said);
        said = view_quality(it);
        const view_stage_picture now = draw(s);
        EXPECT_GT(now.changed(before, 0), 0) << said;
        EXPECT_GT(std::abs(now.light(width / 2, height / 2) - now.light(3, 3)), 0.03) << said;
        before = now;
    }
}

/* Of the same millimetres: on a screen whose pixels are smaller words take more of them. */
TEST_F(view_looks, words_are_as_large_as_the_screens_millimetres_want)
{
    snapshot s = looked_at();
    const view_stage_picture none = draw(s, 1280, 720);
    s.strip.shown = true;
    const auto covered = [&](double pixels_per_mm) {
        view_screen(it, pixels_per_mm);
        return draw(s, 1280, 720).changed(none, 2);
    };
    const int coarse = covered(2.5), fine = covered(5);
    EXPECT_GT(coarse, 1000);
    EXPECT_GT(fine, coarse * 5 / 4) << "not twice: no larger than fits";
}

TEST_F(view_looks, a_screen_of_any_size_has_one_that_fits)
{
    for (std::pair<int, int> asked : {std::pair{0, 0}, {-5, 200}, {15360, 8640}, {100000, 3}}) {
        int w = asked.first, h = asked.second;
        const std::string said = view_size_fitted(&w, &h);
        EXPECT_NE(said.find("screen"), std::string::npos);
        snapshot s = looked_at();
        ball();
        if (int64_t{w} * h < 100000) { /* the largest takes this renderer seconds */
            EXPECT_TRUE(view_draw(it, s, w, h, &trouble)) << trouble;
        }
        EXPECT_GE(w, 1);
        EXPECT_GE(h, 1);
        EXPECT_LE(w, 8192);
    }
    int w = 1920, h = 1080;
    EXPECT_EQ(view_size_fitted(&w, &h), "");
    EXPECT_EQ(w, 1920);
}

TEST_F(view_looks, shadows_are_drawn_anew_only_when_something_moved)
{
    ball();
    snapshot s = looked_at();
    s.lights[0] = {true, false, {-100, 150, 150}, {1, 1, 1}, 1};
    draw(s);
    const uint32_t again = (draw(s), view_count(it).passes);
    tilt(&s, 0.3);
    draw(s);
    EXPECT_EQ(view_count(it).passes, again) << "lamp and piece turn together";
    s.lights[0].position[0] += 5;
    draw(s);
    EXPECT_EQ(view_count(it).passes, again + 1);
    it_piece.ball({20, 0, 0}, 12, clay_rgba);
    update(it_piece);
    draw(s);
    EXPECT_EQ(view_count(it).passes, again + 1);
}

} // namespace
