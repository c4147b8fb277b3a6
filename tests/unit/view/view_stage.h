/* SPDX-License-Identifier: Apache-2.0 */
/* What the view's tests stand on: a headless context, a sculpture made by hand, a picture with pixels one can ask. */
#ifndef GLAISE_TESTS_VIEW_STAGE_H
#define GLAISE_TESTS_VIEW_STAGE_H

#include "platform/display/display.h"
#include "view/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/* The transfer function of IEC 61966-2-1, written once more on purpose. */
inline double view_stage_linear(double encoded_byte)
{
    const double e = encoded_byte / 255;
    return e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4);
}

struct view_stage_picture {
    int width = 0, height = 0;
    std::vector<uint8_t> rgba;

    int byte(int x, int y, int channel) const
    {
        return rgba.at((static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) * 4 +
                       static_cast<size_t>(channel));
    }
    double linear(int x, int y, int channel) const { return view_stage_linear(byte(x, y, channel)); }
    double light(int x, int y) const
    {
        return 0.2126 * linear(x, y, 0) + 0.7152 * linear(x, y, 1) + 0.0722 * linear(x, y, 2);
    }
    /* Largest difference over the channels. */
    int apart(const view_stage_picture &other, int x, int y) const
    {
        int most = 0;
        for (int c = 0; c < 4; c++)
            most = std::max(most, std::abs(byte(x, y, c) - other.byte(x, y, c)));
        return most;
    }
    int apart(const view_stage_picture &other) const
    {
        int most = 0;
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++)
                most = std::max(most, apart(other, x, y));
        return most;
    }
    /* Pixels that differ by more than `steps`, of those where `where` holds. */
    int changed(const view_stage_picture &other, const std::function<bool(double, double)> &where, int steps = 1) const
    {
        int count = 0;
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++)
                count += apart(other, x, y) > steps && where(x + 0.5, y + 0.5);
        return count;
    }
    int changed(const view_stage_picture &other, int steps = 1) const
    {
        return changed(other, [](double, double) { return true; }, steps);
    }
};

/* Clay and its surface, without history. */
struct view_stage_piece {
    std::unique_ptr<sculpture> it;

    view_stage_piece();
    ~view_stage_piece();
    view_stage_piece(const view_stage_piece &) = delete;
    view_stage_piece &operator=(const view_stage_piece &) = delete;

    /* Adds a ball whose surface lies at radius from the middle (lattice steps), and brings the surface up to date. */
    void ball(key middle, double radius, uint32_t rgba);
    void empty();
    void update();
};

class view_stage : public testing::Test {
  protected:
    static constexpr int width = 320, height = 240;

    void SetUp() override;
    void TearDown() override;

    view_stage_picture draw(const snapshot &s, int w = width, int h = height);
    void update(const view_stage_piece &piece);
    /* draw of an empty view of its own */
    view_stage_picture draw_empty(const snapshot &s);
    /* draw of a fresh view that saw only this piece */
    view_stage_picture draw_fresh(const snapshot &s, const view_stage_piece &piece);

    /* Nothing but clay: no tool, box, lights drawn; one lit light above the viewer's left. */
    static snapshot plain();
    /* Only ambient light, no shine: what is seen is colour. */
    static snapshot ambient();
    static snapshot_light light_at(double x, double y, double z);
    /* Half the picture's height over the tangent of half the field of view: pixels per radian at the middle. */
    static double focal_pixels(const snapshot &s, int h = height) { return 0.5 * h / std::tan(0.5 * s.field_of_view); }
    /* Radius in pixels of a ball round the point looked at. */
    static double ball_pixels(const snapshot &s, double radius, int h = height)
    {
        return focal_pixels(s, h) * radius / std::sqrt(s.camera_distance * s.camera_distance - radius * radius);
    }

    display *screen = nullptr;
    view *it = nullptr;
    std::string trouble;
};

constexpr uint32_t view_stage_rgba(unsigned r, unsigned g, unsigned b) { return r | g << 8 | b << 16 | 255u << 24; }

#endif
