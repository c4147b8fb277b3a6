/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the picture shows the clay where it is, as large as it is, lit from where the lights are, in its own colours;
 *       what cannot be drawn is refused in words.
 * Method: balls of clay whose silhouette, shading and colour are known from geometry, drawn headless. What an expected
 *         pixel is comes from the camera's own arithmetic or from a second picture, never from an earlier output. */
#include "view_stage.h"

#include <GLES3/gl31.h>

#include <algorithm>

namespace {

constexpr uint32_t clay_grey = view_stage_rgba(188, 188, 188);
constexpr double radius = 24;

using view_picture = view_stage;

TEST_F(view_picture, shows_something_and_is_opaque)
{
    view_stage_piece piece;
    piece.ball({0, 0, 0}, radius, clay_grey);
    update(piece);
    const view_stage_picture p = draw(plain());
    double most = 0, least = 1;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            ASSERT_EQ(p.byte(x, y, 3), 255);
            most = std::max(most, p.light(x, y));
            least = std::min(least, p.light(x, y));
        }
    }
    EXPECT_GT(least, 0.001) << "the ground is dark grey, not black";
    EXPECT_LT(least, 0.15);
    EXPECT_GT(most, 0.3);
}

/* Leftmost, rightmost, upper and lower ends of what differs, at pixel borders. */
std::array<double, 4> ends(const view_stage_picture &a, const view_stage_picture &b)
{
    std::array<double, 4> e = {1e9, -1e9, 1e9, -1e9};
    for (int y = 0; y < a.height; y++) {
        for (int x = 0; x < a.width; x++) {
            if (a.apart(b, x, y) < 8)
                continue;
            e = {std::min<double>(e[0], x), std::max<double>(e[1], x + 1), std::min<double>(e[2], y),
                 std::max<double>(e[3], y + 1)};
        }
    }
    return e;
}

TEST_F(view_picture, silhouette_is_the_projected_one)
{
    view_stage_piece piece;
    piece.ball({0, 0, 0}, radius, view_stage_rgba(255, 255, 255));
    update(piece);
    for (double distance : {110.0, 150.0, 400.0}) {
        snapshot s = ambient();
        s.camera_distance = distance;
        const std::array<double, 4> e = ends(draw(s), draw_empty(s));
        const double expected = ball_pixels(s, radius);
        EXPECT_NEAR(width / 2.0 - e[0], expected, 1.5) << distance;
        EXPECT_NEAR(e[1] - width / 2.0, expected, 1.5) << distance;
        EXPECT_NEAR(height / 2.0 - e[2], expected, 1.5) << distance;
        EXPECT_NEAR(e[3] - height / 2.0, expected, 1.5) << distance;
    }
}

TEST_F(view_picture, top_row_comes_first_and_x_goes_right)
{
    view_stage_piece piece;
    piece.ball({20, 16, 0}, 8, view_stage_rgba(255, 255, 255));
    update(piece);
    const snapshot s = ambient();
    const std::array<double, 4> e = ends(draw(s), draw_empty(s));
    const double scale = focal_pixels(s) / s.camera_distance;
    EXPECT_NEAR((e[0] + e[1]) / 2, width / 2.0 + 20 * scale, 2);
    EXPECT_NEAR((e[2] + e[3]) / 2, height / 2.0 - 16 * scale, 2);
}

TEST_F(view_picture, scene_turns_then_shifts)
{
    view_stage_piece piece;
    piece.ball({20, 0, 0}, 8, view_stage_rgba(255, 255, 255));
    update(piece);
    snapshot s = ambient();
    s.scene_turn = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)}; /* a quarter about z: x goes to y */
    s.scene_shift = {-10, 0, 0};
    const std::array<double, 4> e = ends(draw(s), draw_empty(s));
    const double scale = focal_pixels(s) / s.camera_distance;
    EXPECT_NEAR((e[0] + e[1]) / 2, width / 2.0 - 10 * scale, 2);
    EXPECT_NEAR((e[2] + e[3]) / 2, height / 2.0 - 20 * scale, 2);
}

/* Mean light of the ball's half left of (or right of) the middle column. */
double half_light(const view_stage_picture &p, double pixels, bool left)
{
    double sum = 0;
    int count = 0;
    for (int y = 0; y < p.height; y++) {
        for (int x = 0; x < p.width; x++) {
            const double dx = x + 0.5 - p.width / 2.0, dy = y + 0.5 - p.height / 2.0;
            if (std::hypot(dx, dy) > pixels - 3 || (dx < 0) != left)
                continue;
            sum += p.light(x, y);
            count++;
        }
    }
    return sum / count;
}

TEST_F(view_picture, the_side_towards_the_light_is_brighter)
{
    view_stage_piece piece;
    piece.ball({0, 0, 0}, radius, clay_grey);
    update(piece);
    snapshot s = plain();
    const double pixels = ball_pixels(s, radius);
    s.lights[0] = light_at(-200, 0, 60);
    const view_stage_picture left = draw(s);
    EXPECT_GT(half_light(left, pixels, true), 1.5 * half_light(left, pixels, false));
    s.lights[0] = light_at(200, 0, 60);
    const view_stage_picture right = draw(s);
    EXPECT_GT(half_light(right, pixels, false), 1.5 * half_light(right, pixels, true));
    s.lights[1] = light_at(-200, 0, 60);
    const view_stage_picture both = draw(s);
    EXPECT_NEAR(half_light(both, pixels, true), half_light(both, pixels, false), 0.02);
    EXPECT_GT(half_light(both, pixels, true), half_light(right, pixels, true));
}

TEST_F(view_picture, lights_stay_with_the_world_or_with_the_viewer)
{
    view_stage_piece piece;
    piece.ball({0, 0, 0}, radius, clay_grey);
    update(piece);
    snapshot s = plain();
    const double pixels = ball_pixels(s, radius);
    s.lights[0] = light_at(-200, 0, 60);
    s.scene_turn = {0, 0, 0, 1}; /* half a turn about z: the world's left is the viewer's right */
    const view_stage_picture world = draw(s);
    EXPECT_GT(half_light(world, pixels, false), 1.5 * half_light(world, pixels, true));
    s.lights[0].with_viewer = true;
    s.lights[0].position = {-200, 0, 60 - s.camera_distance};
    const view_stage_picture viewer = draw(s);
    EXPECT_GT(half_light(viewer, pixels, true), 1.5 * half_light(viewer, pixels, false));
}

TEST_F(view_picture, brighter_lights_never_clip_flat)
{
    view_stage_piece piece;
    piece.ball({0, 0, 0}, radius, clay_grey);
    update(piece);
    snapshot s = plain();
    s.material.specular = 0;
    s.lights[0] = light_at(0, 0, 1000);
    double before = 0;
    for (float strength : {0.5f, 1.0f, 1.5f, 2.0f, 2.5f}) {
        s.lights[0].strength = strength;
        const double now = draw(s).light(width / 2, height / 2);
        EXPECT_GT(now, before + 0.01) << strength;
        EXPECT_LT(now, 1.0) << strength;
        before = now;
    }
}

/* Reflectances given as sRGB bytes: in unchanged light the picture's linear values stand in their linear proportion. */
TEST_F(view_picture, colours_are_srgb_on_the_way_in_and_out)
{
    EXPECT_NEAR(view_stage_linear(188), 0.5029, 1e-4); /* what everybody's table says */
    const snapshot s = ambient();
    view_stage_piece white;
    white.ball({0, 0, 0}, radius, view_stage_rgba(255, 255, 255));
    const view_stage_picture full = draw_fresh(s, white);
    for (const std::array<unsigned, 3> c : {std::array<unsigned, 3>{188, 128, 64}, {220, 30, 100}}) {
        view_stage_piece coloured;
        coloured.ball({0, 0, 0}, radius, view_stage_rgba(c[0], c[1], c[2]));
        const view_stage_picture p = draw_fresh(s, coloured);
        for (int channel = 0; channel < 3; channel++) {
            const double expected = view_stage_linear(c[static_cast<size_t>(channel)]);
            for (const std::array<int, 2> at : {std::array<int, 2>{0, 0}, {-25, 10}, {15, -30}}) {
                const int x = width / 2 + at[0], y = height / 2 + at[1];
                const double whole = full.linear(x, y, channel);
                ASSERT_LT(whole, 0.5) << "below where highlights are bent";
                /* half a display step of either picture */
                const double slack = view_stage_linear(p.byte(x, y, channel) + 1) - p.linear(x, y, channel) + 0.003;
                EXPECT_NEAR(p.linear(x, y, channel), expected * whole, slack) << channel;
            }
        }
    }
}

TEST_F(view_picture, edges_have_intermediate_values)
{
    view_stage_piece piece;
    piece.ball({0, 0, 0}, radius, view_stage_rgba(255, 255, 255));
    update(piece);
    snapshot s = ambient();
    s.material.ambient = 1;
    const view_stage_picture p = draw(s), ground = draw_empty(s);
    GLint most = 0;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    ASSERT_EQ(view_count(it).samples, std::min(most, 4));
    ASSERT_GE(most, 4) << "OpenGL ES 3 promises four";
    int edges = 0, intermediate = 0;
    for (int y = height / 2 - 30; y <= height / 2 + 30; y++) {
        int x = 0;
        while (x < width / 2 && p.apart(ground, x, y) < 3)
            x++;
        ASSERT_LT(x, width / 2);
        const double part = (p.light(x, y) - ground.light(x, y)) / (p.light(x + 2, y) - ground.light(x, y));
        edges++;
        intermediate += part > 0.1 && part < 0.85;
    }
    EXPECT_GT(intermediate, edges / 3);
    EXPECT_LT(intermediate, edges) << "a quarter of the pixels at an edge are covered whole";
}

TEST_F(view_picture, patches_join_without_pinholes)
{
    view_stage_piece piece;
    piece.ball({3, -5, 2}, 30, view_stage_rgba(255, 255, 255));
    update(piece);
    snapshot s = ambient();
    s.material.ambient = 1;
    for (int turn = 0; turn < 6; turn++) {
        const double a = 0.31 * turn + 0.1;
        s.scene_turn = {std::cos(a), std::sin(a) * 0.6, std::sin(a) * 0.64, std::sin(a) * 0.48};
        const view_stage_picture p = draw(s);
        for (int y = height / 2 - 60; y < height / 2 + 60; y++) {
            for (int x = width / 2 - 60; x < width / 2 + 60; x++) {
                if (std::hypot(x - width / 2, y - height / 2) > 45)
                    continue;
                const double beside = p.light(x - 1, y) + p.light(x + 1, y);
                const double round = (beside + p.light(x, y - 1) + p.light(x, y + 1)) / 4;
                ASSERT_NEAR(p.light(x, y), round, 0.04) << x << ", " << y << " turn " << turn;
            }
        }
    }
}

TEST_F(view_picture, a_piece_far_out_looks_as_one_at_the_origin)
{
    view_stage_piece near_piece, far_piece;
    const key far = {8 * 9000007, -8 * 7654321, 8 * 5000011};
    near_piece.ball({0, 0, 0}, 14, clay_grey);
    far_piece.ball(far, 14, clay_grey);
    snapshot s = plain();
    s.camera_distance = 80;
    const double a = 0.7;
    s.scene_turn = {std::cos(a), 0, std::sin(a), 0};
    update(near_piece);
    const view_stage_picture expected = draw(s);
    /* shift so that the far ball's middle, turned, comes to the origin; its light with it */
    const double c = std::cos(2 * a), sn = std::sin(2 * a), x = far.i, y = far.j, z = far.k;
    s.scene_shift = {-(c * x + sn * z), -y, -(-sn * x + c * z)};
    s.lights[0].position = {s.lights[0].position[0] + x, s.lights[0].position[1] + y, s.lights[0].position[2] + z};
    const view_stage_picture p = draw_fresh(s, far_piece);
    EXPECT_LE(p.changed(expected), 4) << "edge pixels may fall to the other side, no more";
}

TEST_F(view_picture, step_scales_the_piece)
{
    view_stage_piece piece;
    piece.ball({0, 0, 0}, radius, clay_grey);
    update(piece);
    snapshot s = ambient();
    const view_stage_picture before = draw(s);
    s.step_mm = 0.1;
    s.camera_distance /= 10;
    EXPECT_LE(draw(s).changed(before), 4);
}

TEST_F(view_picture, sizes_that_cannot_be_are_refused_in_words)
{
    const snapshot s = plain();
    const std::array<int, 2> sizes[] = {{0, 100}, {100, 0}, {-5, 100}, {1 << 20, 4}, {4, 1 << 20}};
    for (const std::array<int, 2> size : sizes) {
        trouble.clear();
        EXPECT_FALSE(view_draw(it, s, size[0], size[1], &trouble));
        const std::string named = std::to_string(size[0]) + " x " + std::to_string(size[1]);
        EXPECT_NE(trouble.find(named), std::string::npos) << trouble;
        EXPECT_NE(trouble.find("each side must be 1 to "), std::string::npos) << trouble;
        std::vector<uint8_t> pixels;
        trouble.clear();
        EXPECT_FALSE(view_pixels(it, &pixels, &trouble)) << "there is no picture now";
        EXPECT_FALSE(trouble.empty());
    }
    EXPECT_EQ(draw(s, 1, 1).rgba.size(), 4u);
    EXPECT_EQ(draw(s, 33, 7).rgba.size(), 33u * 7 * 4);
}

TEST_F(view_picture, the_size_may_change_between_pictures)
{
    view_stage_piece piece;
    piece.ball({0, 0, 0}, radius, clay_grey);
    update(piece);
    const snapshot s = plain();
    const view_stage_picture first = draw(s);
    const view_stage_picture large = draw(s, 2 * width, 2 * height);
    EXPECT_NEAR(large.light(width, height), first.light(width / 2, height / 2), 0.01);
    EXPECT_EQ(draw(s).apart(first), 0);
}

TEST_F(view_picture, snapshots_that_cannot_be_are_refused_in_words)
{
    struct wrong {
        const char *word;
        std::function<void(snapshot *)> break_it;
    };
    const wrong all[] = {
        {"scene_turn", [](snapshot *s) { s->scene_turn = {0, 0, 0, 0}; }},
        {"scene_turn", [](snapshot *s) { s->scene_turn[2] = NAN; }},
        {"scene_shift", [](snapshot *s) { s->scene_shift[1] = INFINITY; }},
        {"camera_distance", [](snapshot *s) { s->camera_distance = 0; }},
        {"field_of_view", [](snapshot *s) { s->field_of_view = 3.2; }},
        {"step_mm", [](snapshot *s) { s->step_mm = -1; }},
    };
    for (const wrong &w : all) {
        snapshot s = plain();
        draw(s);
        w.break_it(&s);
        EXPECT_FALSE(view_draw(it, s, width, height, &trouble));
        EXPECT_NE(trouble.find(w.word), std::string::npos) << trouble;
        std::vector<uint8_t> pixels;
        EXPECT_FALSE(view_pixels(it, &pixels, &trouble)) << "the picture before is not passed off as this one";
    }
}

TEST(view_without_context, says_so)
{
    std::string trouble;
    EXPECT_EQ(view_open(&trouble), nullptr);
    EXPECT_NE(trouble.find("context"), std::string::npos) << trouble;
    view_close(nullptr);
}

} // namespace
