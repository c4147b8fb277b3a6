/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the pictures that the tapes take look as they looked when they were last renewed and looked at.
 * Method: the program takes them at the kept ones' size. A pixel fails when a channel is off by more than
 *         CHANNEL_TOLERANCE; a picture fails when more than FAILING_SHARE_MAX of its pixels do: drivers differ along
 *         edges and in highlights, by a line of pixels or a few levels, never by an area. Where no display opens, no
 *         picture can be taken: the test says so and is skipped. */
#include "golden_picture.h"
#include "golden_tape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace {

constexpr int CHANNEL_TOLERANCE = 20; /* of 255 */
constexpr double FAILING_SHARE_MAX = 0.01;

class golden_pictures : public testing::TestWithParam<golden_tape> {
};

void look_at(const std::string &folder, const std::string &name, const golden_picture &expected)
{
    golden_picture actual;
    std::string text;
    ASSERT_TRUE(golden_picture_read(folder + "/" + name + ".png", &actual, &text)) << text;
    const golden_picture_difference d = golden_picture_compare(expected, actual, CHANNEL_TOLERANCE);
    const double share = static_cast<double>(d.failing) / static_cast<double>(d.pixels);
    if (share > FAILING_SHARE_MAX) {
        const std::string shown = folder + "/" + name + "-difference.png";
        ADD_FAILURE() << name << ".png: " << 100 * share << " % of the pixels are off by more than " << CHANNEL_TOLERANCE
                      << " (at most " << 100 * FAILING_SHARE_MAX << " % may be), the worst by " << d.largest
                      << "\nexpected   " SOURCE_ROOT "/tests/golden/" << name << ".png\nactual     " << folder << "/" << name
                      << ".png\ndifference " << shown;
        EXPECT_TRUE(golden_picture_write(shown, d.shown, &text)) << text;
    }
}

TEST_P(golden_pictures, look_as_they_did)
{
    ASSERT_FALSE(GetParam().pictures.empty());
    std::vector<golden_picture> expected(GetParam().pictures.size());
    std::string text;
    for (size_t n = 0; n < expected.size(); n++)
        ASSERT_TRUE(golden_picture_read(SOURCE_ROOT "/tests/golden/" + GetParam().pictures[n] + ".png", &expected[n], &text))
            << text;
    const std::string folder = golden_tape_folder("pictures-" + GetParam().name);
    const golden_tape_outcome outcome = golden_tape_replay(
        GetParam(), folder,
        {"--pictures", folder, "--width", std::to_string(expected[0].width), "--height", std::to_string(expected[0].height)});
    if (outcome.said.find("no pictures: ") != std::string::npos) {
        std::fprintf(stderr, "NOT CHECKED: no display opens here, so no picture was compared with tests/golden/*.png\n");
        GTEST_SKIP() << "NOT CHECKED, no display opens here:\n" << outcome.said;
    }
    ASSERT_EQ(outcome.exit, 0) << outcome.said;
    for (size_t n = 0; n < expected.size(); n++)
        look_at(folder, GetParam().pictures[n], expected[n]);
    if (!HasFailure())
        std::filesystem::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(tapes, golden_pictures, testing::ValuesIn(golden_tape_list()),
                         [](const auto &with) {
                             std::string name = with.param.name;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

golden_picture grey(uint32_t width, uint32_t height)
{
    return {width, height, std::vector<uint8_t>(size_t{3} * width * height, 100)};
}

TEST(golden_picture, comparison_counts_pixels_beyond_the_tolerance)
{
    const golden_picture expected = grey(4, 3);
    golden_picture actual = expected;
    EXPECT_EQ(golden_picture_compare(expected, actual, 0).failing, 0u);
    actual.rgb[5] = 110;  /* pixel 1, blue */
    actual.rgb[12] = 89;  /* pixel 4, red and green */
    actual.rgb[13] = 0;
    const golden_picture_difference loose = golden_picture_compare(expected, actual, 10);
    EXPECT_EQ(loose.pixels, 12u);
    EXPECT_EQ(loose.failing, 1u);
    EXPECT_EQ(loose.largest, 100);
    EXPECT_EQ(loose.shown.rgb[5], 40);
    EXPECT_EQ(loose.shown.rgb[14], 255);
    EXPECT_EQ(golden_picture_compare(expected, actual, 9).failing, 2u);
    EXPECT_EQ(golden_picture_compare(expected, grey(3, 4), 255).failing, 12u);
}

TEST(golden_picture, files_come_back_as_they_were_and_bad_ones_are_refused)
{
    const std::string folder = golden_tape_folder("picture-files");
    golden_picture made = grey(5, 2), back;
    made.rgb[7] = 3;
    std::string text;
    ASSERT_TRUE(golden_picture_write(folder + "/a.png", made, &text)) << text;
    ASSERT_TRUE(golden_picture_read(folder + "/a.png", &back, &text)) << text;
    EXPECT_EQ(back.rgb, made.rgb);
    EXPECT_EQ(back.width, 5u);
    std::filesystem::resize_file(folder + "/a.png", std::filesystem::file_size(folder + "/a.png") - 20);
    EXPECT_FALSE(golden_picture_read(folder + "/a.png", &back, &text));
    EXPECT_NE(text.find("a.png"), std::string::npos);
    EXPECT_TRUE(back.rgb.empty());
    EXPECT_FALSE(golden_picture_read(folder + "/none.png", &back, &text));
    std::filesystem::remove_all(folder);
}

} // namespace
