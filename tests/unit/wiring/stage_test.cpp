/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   a picture taken in tiles is the one the view draws whole; what cannot be taken leaves what was there; scenery
 *         is read, or told with file and place.
 * Method: a real view on a headless display; both pictures of a piece whose outline crosses the seams are compared
 *         pixel by pixel. Soft shadows have a grain that begins anew in every part, and a tile's vertices are rounded
 *         anew: single pixels may differ, the means of small blocks by no more than a level. A seam would be seen in
 *         them.
 */
#ifdef GLAISE_VIEW

#include "exchange/picture.h"
#include "exchange/picture_source.h"
#include "platform/display/display.h"
#include "station/camera.h"
#include "station/station.h"
#include "view/view.h"
#include "wiring/scratch_store.h"
#include "wiring/sequence.h"
#include "wiring/store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>

namespace {

namespace fs = std::filesystem;

constexpr int LIT = 90;   /* of 255: brighter than the ground anywhere */
constexpr int BLOCK = 12; /* pixels */

class stage_pictures : public testing::Test {
protected:
    void SetUp() override
    {
        std::string made = testing::TempDir() + "/glaise-stage-XXXXXX";
        ASSERT_NE(mkdtemp(made.data()), nullptr);
        folder = made;
        port = scratch_store_port(&scratch);
        history_finding finding;
        ASSERT_EQ(sculpture_open(piece.get(), &port, 50000, nullptr, 1.0, &finding), STATUS_OK);
        std::string trouble;
        scene = stage_open(&trouble);
        ASSERT_NE(scene, nullptr) << trouble;
        sculpt();
    }
    void TearDown() override
    {
        stage_close(scene);
        EXPECT_EQ(sculpture_close(piece.get()), STATUS_OK);
        fs::remove_all(folder);
    }

    /* A long bar of three colours, askew, right across every seam. */
    void sculpt()
    {
        station *desk = station_open(piece.get(), {});
        int64_t now_us = 0;
        const auto act = [&](const std::string &text, int64_t us) {
            std::string expected;
            std::optional<command> c = command_parse(text, &expected);
            ASSERT_TRUE(c) << text << ": " << expected;
            c->time_us = now_us += us;
            station_do(desk, *c);
        };
        for (const char *text : {"size 6 6 6", "rate 900", "light 0 -120 160 160 #fff2e0 1 viewer", "tool-style hidden",
                                 "view 0 0 1 40 90", "environment clearcoat 0.5"})
            act(text, 0);
        for (int n = -4; n <= 4; n++) {
            act("place " + std::to_string(12 * n) + " " + std::to_string(2 * n) + " 0", 0);
            act(n % 3 == 0 ? "colour #d04020" : n % 3 == 1 ? "colour #2080d0" : "colour #f0f0e0", 0);
            act("apply down", 0);
            act("apply up", 80000);
        }
        shown = station_snapshot(desk);
        station_close(desk);
    }

    std::string at(const std::string &name) const { return (folder / name).string(); }

    static picture_source read(const std::string &path)
    {
        picture_source p;
        std::string text;
        EXPECT_TRUE(store_import(
            path,
            [&p](checkpoint_source source, void *self) {
                return picture_source_read(source, self, &p).state == STATUS_OK;
            },
            &text)) << path << text;
        return p;
    }

    /* The view's own, in one piece, on a display of its own. */
    std::vector<uint8_t> drawn_whole(int width, int height)
    {
        display_trouble trouble;
        std::string text;
        std::vector<uint8_t> rgba;
        display *place = display_open(DISPLAY_HEADLESS, &trouble);
        EXPECT_TRUE(place && display_make_current(place, &trouble)) << trouble.text;
        view *eye = view_open(&text);
        EXPECT_TRUE(eye && view_update(eye, piece.get(), &text) && view_draw(eye, shown, width, height, &text) &&
                    view_pixels(eye, &rgba, &text))
            << text;
        view_close(eye);
        display_close(place);
        return rgba;
    }

    fs::path folder;
    scratch_store scratch;
    byte_store port{};
    std::unique_ptr<sculpture> piece = std::make_unique<sculpture>();
    stage *scene = nullptr;
    snapshot shown;
};

/* What a reset driver took is made anew: context, programs, patches, the scenery that was brought. */
TEST_F(stage_pictures, everything_made_anew_looks_as_before)
{
    std::string text;
    std::vector<uint8_t> panorama;
    for (int y = 0; y < 4; y++)
        for (int x = 0; x < 8; x++)
            for (uint8_t byte : {x < 4 ? 250 : 10, 40, y < 2 ? 200 : 20, 255})
                panorama.push_back(byte);
    const picture p = {8, 4, 4, panorama.data(), 32};
    ASSERT_TRUE(store_export(
        at("panorama.png"), [&p](checkpoint_sink sink, void *self) { return picture_write(p, sink, self); }, &text))
        << text;
    ASSERT_TRUE(stage_scenery(scene, at("panorama.png"), &text)) << text;
    shown.scenery = SNAPSHOT_SCENERY_OWN;
    ASSERT_TRUE(stage_picture(scene, piece.get(), shown, {160, 120, 1}, at("before.png"), &text)) << text;
    ASSERT_TRUE(stage_renew(scene, &text)) << text;
    ASSERT_TRUE(stage_picture(scene, piece.get(), shown, {160, 120, 1}, at("after.png"), &text)) << text;
    EXPECT_TRUE(read(at("before.png")).rgba == read(at("after.png")).rgba);
    shown.scenery = SNAPSHOT_SCENERY_STUDIO;
    ASSERT_TRUE(stage_picture(scene, piece.get(), shown, {160, 120, 1}, at("studio.png"), &text)) << text;
    EXPECT_FALSE(read(at("before.png")).rgba == read(at("studio.png")).rgba) << "the scenery is seen";
}

} // namespace

TEST_F(stage_pictures, tiles_are_the_picture_drawn_whole)
{
    constexpr int width = 2300, height = 2100; /* a seam each way, at 1920 */
    shown.effects.floor = false; /* a few very large triangles: cut at another border, they are interpolated otherwise */
    std::string text;
    ASSERT_TRUE(stage_picture(scene, piece.get(), shown, {width, height, 1}, at("tiled.png"), &text)) << text;
    const picture_source tiled = read(at("tiled.png"));
    stage_close(scene); /* one context at a time is current */
    scene = nullptr;
    const std::vector<uint8_t> whole = drawn_whole(width, height);
    ASSERT_EQ(tiled.rgba.size(), whole.size());
    int lit = 0, blocks_apart = 0;
    double most = 0;
    for (int y = 0; y + BLOCK <= height; y += BLOCK)
        for (int x = 0; x + BLOCK <= width; x += BLOCK) {
            std::array<double, 3> apart{};
            for (int n = 0; n < BLOCK * BLOCK; n++) {
                const int at = 4 * ((y + n / BLOCK) * width + x + n % BLOCK);
                for (size_t c = 0; c < 3; c++)
                    apart[c] += whole[static_cast<size_t>(at) + c] - tiled.rgba[static_cast<size_t>(at) + c];
                lit += whole[static_cast<size_t>(at)] > LIT;
            }
            for (const double sum : apart) {
                most = std::max(most, std::abs(sum) / (BLOCK * BLOCK));
                blocks_apart += std::abs(sum) > BLOCK * BLOCK;
            }
        }
    EXPECT_GT(lit, 300000); /* there is something to see, across both seams */
    EXPECT_EQ(blocks_apart, 0) << "by up to " << most << " levels";
}

TEST_F(stage_pictures, several_pixels_become_one_by_their_light)
{
    std::string text;
    ASSERT_TRUE(stage_picture(scene, piece.get(), shown, {300, 200, 1}, at("drawn.png"), &text)) << text;
    ASSERT_TRUE(stage_picture(scene, piece.get(), shown, {100, 66, 3}, at("fine.png"), &text)) << text;
    ASSERT_TRUE(stage_picture(scene, piece.get(), shown, {300, 198, 1}, at("same.png"), &text)) << text;
    const picture_source fine = read(at("fine.png")), same = read(at("same.png"));
    std::vector<uint8_t> mean(100 * 66 * 4);
    large_picture_average(same.rgba.data(), 300 * 4, 3, 100, 66, mean.data(), 100 * 4);
    EXPECT_TRUE(fine.rgba == mean);
    EXPECT_EQ(fine.width, 100u);
    EXPECT_EQ(read(at("drawn.png")).height, 200u);
}

TEST_F(stage_pictures, told_parts_grow_to_the_whole)
{
    std::string text;
    std::vector<double> parts;
    ASSERT_TRUE(stage_picture(scene, piece.get(), shown, {2100, 2500, 1}, at("a.png"), &text,
                              [&](double part) { parts.push_back(part); })) << text;
    EXPECT_EQ(parts.size(), 4u);
    EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
    EXPECT_GT(parts.front(), 0);
    EXPECT_EQ(parts.back(), 1);
}

TEST_F(stage_pictures, what_cannot_be_taken_leaves_what_was_there)
{
    std::string text;
    std::ofstream(at("old.png")) << "what was there";
    EXPECT_FALSE(stage_picture(scene, piece.get(), shown, {0, 5, 1}, at("old.png"), &text));
    EXPECT_EQ(text, at("old.png") + ": a picture of 0 x 5 pixels: expected sides of 1 to 65536");
    snapshot bad = shown;
    bad.camera_distance = -1;
    EXPECT_FALSE(stage_picture(scene, piece.get(), bad, {50, 50, 1}, at("old.png"), &text));
    EXPECT_EQ(text, at("old.png") + ": snapshot: camera_distance must be more than 0 mm");
    EXPECT_FALSE(stage_picture(scene, piece.get(), shown, {50, 50, 1}, at("no/old.png"), &text));
    EXPECT_EQ(text, at("no/old.png") + ": No such file or directory");
    std::ifstream file(at("old.png"));
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "what was there");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST_F(stage_pictures, one_turn_begins_with_the_piece_as_it_is)
{
    std::string text;
    std::vector<std::string> written;
    ASSERT_TRUE(stage_picture(scene, piece.get(), shown, {90, 60, 1}, at("still.png"), &text)) << text;
    ASSERT_TRUE(sequence_turntable(scene, piece.get(), shown, {90, 60, 1}, at("turn"), 4,
                                   [&](const std::string &file) { written.push_back(file); }, &text)) << text;
    EXPECT_EQ(written, (std::vector<std::string>{at("turn-000.png"), at("turn-001.png"), at("turn-002.png"),
                                                 at("turn-003.png")}));
    const picture_source first = read(written[0]);
    EXPECT_TRUE(first.rgba == read(at("still.png")).rgba);
    const motion_vector axis = camera_middle(camera_boxes_of(piece.get()));
    for (size_t n = 1; n < 4; n++) {
        const snapshot turned = camera_turned(shown, axis, static_cast<double>(n) * 1.5707963267948966);
        ASSERT_TRUE(stage_picture(scene, piece.get(), turned, {90, 60, 1}, at("still.png"), &text)) << text;
        EXPECT_TRUE(read(written[n]).rgba == read(at("still.png")).rgba) << n;
        EXPECT_FALSE(read(written[n]).rgba == first.rgba) << n;
    }
    EXPECT_FALSE(sequence_turntable(scene, piece.get(), shown, {90, 60, 1}, at("no/turn"), 4,
                                    [](const std::string &) { FAIL(); }, &text));
    EXPECT_EQ(text, at("no/turn-000.png") + ": No such file or directory");
}

TEST_F(stage_pictures, scenery_is_read_or_told)
{
    std::string text = "old";
    const std::vector<uint8_t> pixels(8 * 4 * 4, 200);
    const picture p = {8, 4, 4, pixels.data(), 8 * 4};
    ASSERT_TRUE(store_export(
        at("sky.png"), [&p](checkpoint_sink sink, void *self) { return picture_write(p, sink, self); }, &text));
    EXPECT_TRUE(stage_scenery(scene, at("sky.png"), &text)) << text;
    std::ofstream(at("words.png")) << "no picture at all";
    EXPECT_FALSE(stage_scenery(scene, at("words.png"), &text));
    EXPECT_EQ(text, at("words.png") + ": offset 0: expected the eight bytes that a PNG file begins with");
    EXPECT_FALSE(stage_scenery(scene, at("none.png"), &text));
    EXPECT_EQ(text, at("none.png") + ": No such file or directory");
    EXPECT_FALSE(stage_scenery(scene, folder.string(), &text));
    EXPECT_EQ(text, folder.string() + ": expected a plain file");
}

TEST(sequence, names_sort_as_they_were_taken)
{
    EXPECT_EQ(sequence_path("a/owl", 0, 1), "a/owl-000.png");
    EXPECT_EQ(sequence_path("a/owl.png", 7, 1000), "a/owl-007.png");
    EXPECT_EQ(sequence_path("owl.v2", 999, 1001), "owl.v2-0999.png");
    EXPECT_EQ(sequence_path("owl", 9998, 9999), "owl-9998.png");
}

#endif
