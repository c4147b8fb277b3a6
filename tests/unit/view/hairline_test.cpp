/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: lines lie where they should, as wide as asked, smooth with one sample a pixel; what is behind the eye of one does
 *       not come back to the screen; kept lines are moved by their matrix.
 * Method: a framebuffer without multisampling; sums of light across a line are its width. */
#include "bare_frame.h"
#include "view/hairline.h"

namespace {

class view_hairline : public bare_frame {
  protected:
    void SetUp() override
    {
        bare_frame::SetUp();
        ASSERT_TRUE(hairline_open(&it, {{glm::vec3(0, -1, 0), glm::vec3(0, 1, 0)}}, &trouble)) << trouble;
    }
    void TearDown() override
    {
        hairline_close(&it);
        bare_frame::TearDown();
    }
    void blend()
    {
        begin();
        glEnable(GL_BLEND);
        glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    }
    std::vector<int> draw(const hairline_line &l, const hairline_look &look)
    {
        blend();
        hairline_draw(it, s, project(), {l}, look);
        return end();
    }
    /* Of a row: how much light, in pixels of full light, and its middle. */
    static std::array<double, 2> across(const std::vector<int> &red, int y)
    {
        double sum = 0, moment = 0;
        for (int x = 0; x < width; x++) {
            sum += at(red, x, y) / 255.0;
            moment += (x + 0.5) * at(red, x, y) / 255.0;
        }
        return {sum, sum > 0 ? moment / sum : 0};
    }
    double pixels_per_mm() const { return projection_pixels_per_mm(s, height, s.camera_distance); }

    const glm::vec4 white{10, 10, 10, 1}; /* over the roll-off of bright light */
    hairline it;
};

TEST_F(view_hairline, is_where_it_should_be_and_as_wide)
{
    for (const float pixels : {1.0f, 1.5f, 3.0f}) {
        for (const double x : {3.0, 3.05, 3.1}) {
            const float eye_x = static_cast<float>(x);
            const std::vector<int> red = draw({{eye_x, -5, -100}, {eye_x, 5, -100}, white}, {pixels * 1080 / height});
            const std::array<double, 2> row = across(red, height / 2);
            EXPECT_NEAR(row[0], pixels, 0.06) << x;
            EXPECT_NEAR(row[1], width / 2.0 + x * pixels_per_mm(), 0.06) << pixels;
        }
    }
}

TEST_F(view_hairline, is_smooth_where_it_slants)
{
    const std::vector<int> red = draw({{-10, -6, -100}, {10, 7, -100}, white}, {});
    int shades = 0, bright = 0;
    for (const int value : red) {
        shades += value > 20 && value < 235;
        bright += value > 0;
    }
    EXPECT_GT(shades, bright / 2) << "most of a line's pixels lie partly on it";
}

TEST_F(view_hairline, that_goes_behind_the_eye_ends_at_the_edge)
{
    /* from straight ahead out to the right and past the eye */
    for (const float end_z : {40.0f, 0.0f}) { /* at 0 it has no place on the screen at all */
        const std::vector<int> red = draw({{0, 0, -100}, {60, 0, end_z}, white}, {3 * 1080.0f / height});
        for (int x = 0; x < width; x++)
            EXPECT_EQ(at(red, x, height / 2) > 100, x >= width / 2) << x << " " << end_z;
    }
    for (const int value : draw({{-5, 0, 1}, {5, 1, 40}, white}, {}))
        ASSERT_EQ(value, 0) << "all of it behind the eye";
}

TEST_F(view_hairline, kept_lines_follow_their_matrix_and_fade_where_they_turn_away)
{
    const projection p = project();
    glm::dmat4 eye_from_lines(1);
    eye_from_lines[1] = glm::dvec4(0, 8, 0, 0);
    eye_from_lines[3] = glm::dvec4(-6, 0, -100, 1);
    blend();
    hairline_draw_kept(it, s, p, eye_from_lines, white, {2 * 1080.0f / height});
    const std::vector<int> red = end();
    const double half = 8 * pixels_per_mm();
    EXPECT_NEAR(across(red, height / 2)[1], width / 2.0 - 6 * pixels_per_mm(), 0.1);
    EXPECT_GT(across(red, static_cast<int>(height / 2.0 + half - 2))[0], 1.5);
    EXPECT_EQ(across(red, static_cast<int>(height / 2.0 + half + 2))[0], 0);
    eye_from_lines = glm::dmat4(glm::dmat3(0, 0, 1, 0, 1e-3, -8, 1, 0, 0)); /* the line now goes straight away */
    eye_from_lines[1] = glm::dvec4(4, 0, -8, 0);
    eye_from_lines[2] = glm::dvec4(0, 1, 0, 0);
    eye_from_lines[0] = glm::dvec4(1, 0, 0, 0);
    eye_from_lines[3] = glm::dvec4(0, 0, -100, 1);
    blend();
    hairline_draw_kept(it, s, p, eye_from_lines, white, {2 * 1080.0f / height, 0.25f});
    const std::vector<int> faded = end();
    const int reach = static_cast<int>(3 * pixels_per_mm());
    EXPECT_GT(at(faded, width / 2 - reach, height / 2), 180) << "its near end looks at the viewer";
    EXPECT_LT(at(faded, width / 2 + reach, height / 2), 90) << "its far end away";
}

TEST_F(view_hairline, draws_a_part_of_a_picture_as_wide_as_the_whole)
{
    const projection whole = projection_make(s, 2 * width, 2 * height, {});
    const projection part = projection_of_part(whole, 2 * width, 2 * height, {width / 2, height / 2, width, height});
    EXPECT_NEAR(hairline_picture_height(s, part), 2 * height, 1e-6);
    EXPECT_NEAR(hairline_picture_height(s, project()), height, 1e-6);
}

} // namespace
