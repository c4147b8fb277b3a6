/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   a picture put together of tiles is the one drawn whole, byte for byte where the drawing of a pixel does not depend
 *         on the part it is drawn in; parts stay within what every device has, memory within the band; several pixels
 *         become one by the mean of their light.
 * Method: a drawing whose every pixel needs its neighbours as far as the margin reaches, and sees nothing beyond its part,
 *         stands for effects on the screen; sums are taken here. The real view is tiled in stage_test.cpp.
 */
#include "wiring/large_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

uint8_t noise(int x, int y, int channel)
{
    const uint32_t v = (static_cast<uint32_t>(x) * 73856093u) ^ (static_cast<uint32_t>(y) * 19349663u) ^
                       (static_cast<uint32_t>(channel) * 83492791u);
    return static_cast<uint8_t>((v * 2654435761u) >> 24);
}

struct drawing {
    std::vector<large_picture_part> parts;
    int fails_at = -1; /* part that cannot be drawn */

    /* A pixel is the highest of the places as far away as the margin that its part has. */
    large_picture_draw port(int reach)
    {
        return [this, reach](int width, int height, const large_picture_part &p, std::vector<uint8_t> *out,
                             std::string *text) {
            parts.push_back(p);
            if (static_cast<int>(parts.size()) == fails_at) {
                *text = "no paint";
                return false;
            }
            EXPECT_TRUE(p.x >= 0 && p.y >= 0 && p.x + p.width <= width && p.y + p.height <= height);
            out->clear();
            for (int y = p.y; y < p.y + p.height; y++)
                for (int x = p.x; x < p.x + p.width; x++)
                    for (int c = 0; c < 4; c++) {
                        const auto seen = [&](int dx, int dy) {
                            const int u = std::clamp(x + dx, p.x, p.x + p.width - 1);
                            const int v = std::clamp(y + dy, p.y, p.y + p.height - 1);
                            return noise(u, v, c);
                        };
                        out->push_back(std::max({seen(-reach, 0), seen(reach, 0), seen(0, -reach), seen(0, reach)}));
                    }
            return true;
        };
    }
};

std::vector<uint8_t> made(large_picture_size size, const large_picture_draw &draw)
{
    large_picture p;
    p.size = size;
    p.draw = draw;
    std::vector<uint8_t> all;
    std::string text;
    for (int y = 0; y < size.height; y++) {
        const uint8_t *row = large_picture_row(&p, y, &text);
        if (!row)
            return {};
        all.insert(all.end(), row, row + 4 * size.width);
        EXPECT_LE(p.band.size(), LARGE_PICTURE_BAND_BYTES);
    }
    return all;
}

/* The same drawn in one piece, whatever its size. */
std::vector<uint8_t> whole(large_picture_size size, int reach)
{
    drawing d;
    std::vector<uint8_t> drawn, out(static_cast<size_t>(4 * size.width * size.height));
    std::string text;
    const int n = size.supersample;
    EXPECT_TRUE(d.port(reach)(size.width * n, size.height * n, {0, 0, size.width * n, size.height * n}, &drawn, &text));
    large_picture_average(drawn.data(), static_cast<size_t>(4 * size.width * n), n, size.width, size.height, out.data(),
                          static_cast<size_t>(4 * size.width));
    return out;
}

double light(double byte)
{
    const double e = byte / 255;
    return e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
}

} // namespace

TEST(large_picture, tiles_make_the_picture_that_is_drawn_whole)
{
    for (const large_picture_size &size : {large_picture_size{2049, 5, 1}, {3, 4100, 1}, {2500, 2100, 1},
                                           {1300, 40, 2}, {700, 701, 3}, {530, 1030, 4}}) {
        drawing d;
        const std::vector<uint8_t> tiled = made(size, d.port(large_picture_margin(size)));
        EXPECT_GT(d.parts.size(), 1u) << size.width;
        EXPECT_TRUE(tiled == whole(size, large_picture_margin(size))) << size.width << " x " << size.height;
        for (const large_picture_part &p : d.parts) {
            EXPECT_LE(p.width, LARGE_PICTURE_PART_PIXELS);
            EXPECT_LE(p.height, LARGE_PICTURE_PART_PIXELS);
        }
    }
}

TEST(large_picture, a_pixel_that_looks_farther_than_the_margin_would_be_seen)
{
    drawing d;
    const large_picture_size size = {2500, 9, 1};
    EXPECT_FALSE(made(size, d.port(LARGE_PICTURE_MARGIN_PIXELS + 1)) == whole(size, LARGE_PICTURE_MARGIN_PIXELS + 1));
}

TEST(large_picture, the_margin_grows_with_the_picture_up_to_its_limit)
{
    EXPECT_EQ(large_picture_margin({9000, 20, 1}), 64);
    EXPECT_EQ(large_picture_margin({100, 2160, 1}), 272);
    EXPECT_EQ(large_picture_margin({100, 540, 4}), 272);
    EXPECT_EQ(large_picture_margin({100, 65536, 1}), 1024);
}

TEST(large_picture, what_a_part_has_room_for_is_drawn_at_once)
{
    drawing d;
    ASSERT_FALSE(made({512, 100, 4}, d.port(1)).empty());
    ASSERT_EQ(d.parts.size(), 1u);
    EXPECT_EQ(d.parts[0].width, 2048);
    EXPECT_EQ(d.parts[0].height, 400);
}

TEST(large_picture, the_largest_stays_within_its_band_and_its_parts)
{
    for (const large_picture_size &size : {large_picture_size{65536, 65536, 1}, {16384, 16384, 1}, {16384, 16384, 4}}) {
        double drawn = 0;
        std::vector<large_picture_part> parts;
        large_picture p;
        p.size = size;
        p.draw = [&](int width, int height, const large_picture_part &part, std::vector<uint8_t> *out, std::string *) {
            EXPECT_EQ(width, size.width * size.supersample);
            EXPECT_EQ(height, size.height * size.supersample);
            EXPECT_LE(std::max(part.width, part.height), LARGE_PICTURE_PART_PIXELS);
            drawn += static_cast<double>(part.width) * part.height;
            parts.push_back(part);
            out->resize(static_cast<size_t>(part.width) * static_cast<size_t>(part.height) * 4);
            return true;
        };
        std::string text;
        ASSERT_NE(large_picture_row(&p, 9000, &text), nullptr); /* somewhere in the middle, margins all round */
        EXPECT_EQ(p.band_y, 9000);
        EXPECT_LE(p.band.capacity(), LARGE_PICTURE_BAND_BYTES);
        const int rows = p.band_rows * size.supersample, margin = large_picture_margin(size);
        EXPECT_GE(rows, size.width == 65536 ? 500 : 1900);
        for (const large_picture_part &part : parts) {
            EXPECT_EQ(part.y, 9000 * size.supersample - margin);
            EXPECT_EQ(part.height, rows + 2 * margin);
        }
        EXPECT_EQ(parts.front().x, 0);
        EXPECT_EQ(parts.back().x + parts.back().width, size.width * size.supersample);
        EXPECT_LT(drawn / (static_cast<double>(rows) * size.width * size.supersample), rows > 1900 ? 4.4 : 10.5);
    }
}

TEST(large_picture, a_checkerboard_becomes_the_mean_of_its_light)
{
    for (const int n : {2, 3, 4}) {
        const int side = 6 * n;
        std::vector<uint8_t> board;
        for (int y = 0; y < side; y++)
            for (int x = 0; x < side; x++) {
                const bool white = (x + y) % 2 == 0;
                const uint8_t p[4] = {static_cast<uint8_t>(white ? 255 : 0), static_cast<uint8_t>(white ? 200 : 40), 77,
                                      static_cast<uint8_t>(white ? 255 : 1)};
                board.insert(board.end(), p, p + 4);
            }
        std::vector<uint8_t> out(6 * 6 * 4);
        large_picture_average(board.data(), static_cast<size_t>(side) * 4, n, 6, 6, out.data(), 6 * 4);
        for (int y = 0; y < 6; y++)
            for (int x = 0; x < 6; x++) {
                /* of an odd square, the colour of its corners is there once more */
                const int whites = n % 2 == 0 ? n * n / 2 : (n * n + ((x + y) % 2 == 0 ? 1 : -1)) / 2;
                const double part = static_cast<double>(whites) / (n * n);
                const uint8_t *p = &out[static_cast<size_t>(y * 6 + x) * 4];
                const std::array<std::array<double, 2>, 3> ends = {{{255, 0}, {200, 40}, {77, 77}}};
                for (size_t c = 0; c < 3; c++) {
                    const double mean = part * light(ends[c][0]) + (1 - part) * light(ends[c][1]);
                    EXPECT_GE(mean, light(p[c] - 0.51)) << n << " " << c; /* the nearest of 256 */
                    EXPECT_LE(mean, light(p[c] + 0.51)) << n << " " << c;
                }
                EXPECT_EQ(p[3], std::lround(part * 255 + (1 - part) * 1));
            }
    }
    /* a half of white's light is 188, not 128 */
    const uint8_t pair[16] = {255, 255, 255, 255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 255};
    uint8_t one[4];
    large_picture_average(pair, 8, 2, 1, 1, one, 4);
    EXPECT_EQ(one[0], 188);
}

TEST(large_picture, even_colours_stay_what_they_are)
{
    for (int v = 0; v < 256; v++) {
        const std::vector<uint8_t> flat(4 * 4 * 4, static_cast<uint8_t>(v));
        for (const int n : {1, 2, 4}) {
            uint8_t out[4];
            large_picture_average(flat.data(), 16, n, 1, 1, out, 4);
            EXPECT_EQ(out[0], v);
            EXPECT_EQ(out[3], v);
        }
    }
}

TEST(large_picture, sizes_that_cannot_be_are_told)
{
    EXPECT_EQ(large_picture_trouble({1, 1, 1}), "");
    EXPECT_EQ(large_picture_trouble({65536, 65536, 1}), "");
    EXPECT_EQ(large_picture_trouble({16384, 16384, 4}), "");
    EXPECT_EQ(large_picture_trouble({0, 5, 1}), "a picture of 0 x 5 pixels: expected sides of 1 to 65536");
    EXPECT_EQ(large_picture_trouble({5, 65537, 1}), "a picture of 5 x 65537 pixels: expected sides of 1 to 65536");
    EXPECT_EQ(large_picture_trouble({16385, 5, 4}),
              "a picture of 16385 x 5 pixels, drawn 4 times as large: expected sides of 1 to 16384");
    EXPECT_NE(large_picture_trouble({5, 5, 0}), "");
    EXPECT_NE(large_picture_trouble({5, 5, 5}), "");
}

TEST(large_picture, a_part_that_cannot_be_drawn_is_told)
{
    drawing d;
    d.fails_at = 3;
    large_picture p;
    p.size = {6000, 10, 1};
    p.draw = d.port(1);
    std::string text;
    EXPECT_EQ(large_picture_row(&p, 0, &text), nullptr);
    EXPECT_EQ(text, "no paint");
    EXPECT_EQ(d.parts.size(), 3u);
}
