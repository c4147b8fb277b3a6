/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a mode as the kernel lists it says rightly how the eyes lie in the framebuffer and how large that is; what
 *       cannot be drawn for is refused with its reason, and nothing is changed.
 * Method: the timings of HDMI 1.4 (CTA-861), the flags as numbers of the kernel's interface, not its names. */
#include "platform/display/stereo_mode.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

namespace {

constexpr uint32_t positive_syncs = 0x5; /* PHSYNC | PVSYNC, as such modes have them */

constexpr uint32_t structure(uint32_t number) { return number << 14 | positive_syncs; }

stereo_mode taken(const stereo_mode_timing &timing)
{
    stereo_mode mode{};
    display_trouble trouble;
    std::strcpy(trouble.text, "old");
    EXPECT_TRUE(stereo_mode_of(&timing, &mode, &trouble)) << trouble.text;
    EXPECT_STREQ(trouble.text, "");
    return mode;
}

std::string refused(const stereo_mode_timing &timing)
{
    stereo_mode mode{STEREO_MODE_PACKED, 11, 22, 33};
    display_trouble trouble;
    EXPECT_FALSE(stereo_mode_of(&timing, &mode, &trouble));
    EXPECT_TRUE(mode.layout == STEREO_MODE_PACKED && mode.width == 11 && mode.height == 22 && mode.gap == 33);
    return trouble.text;
}

void expect_mode(const stereo_mode &mode, stereo_mode_layout layout, int width, int height, int gap)
{
    EXPECT_EQ(mode.layout, layout);
    EXPECT_EQ(mode.width, width);
    EXPECT_EQ(mode.height, height);
    EXPECT_EQ(mode.gap, gap);
}

TEST(stereo_mode, frame_packing_is_two_pictures_and_the_pause_between)
{
    expect_mode(taken({structure(1), 1920, 1080, 1125}), STEREO_MODE_PACKED, 1920, 2205, 45);
    expect_mode(taken({structure(1), 1280, 720, 750}), STEREO_MODE_PACKED, 1280, 1470, 30);
}

TEST(stereo_mode, half_layouts_fill_an_ordinary_framebuffer)
{
    expect_mode(taken({structure(7), 1920, 1080, 1125}), STEREO_MODE_TOP_HALF, 1920, 1080, 0);
    expect_mode(taken({structure(8), 1280, 720, 750}), STEREO_MODE_SIDE_HALF, 1280, 720, 0);
}

TEST(stereo_mode, a_mode_without_a_structure_is_for_one_picture)
{
    expect_mode(taken({positive_syncs, 1366, 768, 798}), STEREO_MODE_ONE, 1366, 768, 0);
}

TEST(stereo_mode, what_is_not_progressive_is_refused)
{
    for (uint32_t number : {0u, 1u, 2u, 7u, 8u}) {
        const std::string words = refused({structure(number) | 1u << 4, 1920, 1080, 1125});
        EXPECT_NE(words.find("interlaced"), std::string::npos) << words;
        EXPECT_NE(words.find("1920 x 1080"), std::string::npos) << words;
    }
    EXPECT_NE(refused({structure(1) | 1u << 5, 640, 480, 525}).find("twice"), std::string::npos);
}

TEST(stereo_mode, other_structures_are_refused_each_with_its_reason)
{
    EXPECT_NE(refused({structure(2), 1280, 720, 750}).find("field"), std::string::npos);
    EXPECT_NE(refused({structure(3), 1280, 720, 750}).find("line"), std::string::npos);
    EXPECT_NE(refused({structure(4), 1280, 720, 750}).find("full width"), std::string::npos);
    EXPECT_NE(refused({structure(5), 1280, 720, 750}).find("depth"), std::string::npos);
    EXPECT_NE(refused({structure(6), 1280, 720, 750}).find("depth"), std::string::npos);
    for (uint32_t number = 9; number < 32; number++)
        EXPECT_NE(refused({structure(number), 1280, 720, 750}).find("unknown"), std::string::npos) << number;
}

TEST(stereo_mode, timings_that_make_no_sense_are_refused)
{
    for (const stereo_mode_timing &timing : {stereo_mode_timing{structure(1), 0, 720, 750},
                                             stereo_mode_timing{structure(1), 1280, 0, 750},
                                             stereo_mode_timing{structure(1), 1280, 720, 719},
                                             stereo_mode_timing{structure(8), -1280, 720, 750}})
        EXPECT_NE(refused(timing).find("no sense"), std::string::npos);
}

} // namespace
