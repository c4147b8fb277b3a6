/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: what stands on the screen can be read: letters of the promised height, every word inside the picture and none on
 *       another, at every size and layout, with or without millimetres and font; its colours are what was chosen.
 * Method: snapshots made by hand, drawn into an sRGB framebuffer; words are asked for, pixels read. */
#include "view/overlay.h"

#include "platform/display/display.h"
#include "view/overlay_pen.h"
#include "view_stage.h"

#include <GLES3/gl31.h>

#include <algorithm>

namespace {

constexpr double desk_per_mm = 1920 / 597.7; /* a 27-inch screen */

class view_overlay : public testing::Test {
  protected:
    void SetUp() override
    {
        display_trouble missing;
        screen = display_open(DISPLAY_HEADLESS, &missing);
        ASSERT_NE(screen, nullptr) << missing.text;
        ASSERT_TRUE(display_make_current(screen, &missing)) << missing.text;
        it = overlay_open(&trouble);
        ASSERT_NE(it, nullptr) << trouble;
    }
    void TearDown() override
    {
        overlay_close(it);
        glDeleteTextures(1, &texture);
        glDeleteFramebuffers(1, &framebuffer);
        display_close(screen);
    }
    /* On a ground of one grey, given as linear light. */
    view_stage_picture draw(const snapshot &s, int w, int h, double per_mm = 0, const overlay_eye &eye = {}, float grey = 0.2f)
    {
        glDeleteTextures(1, &texture);
        glDeleteFramebuffers(1, &framebuffer);
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, w, h);
        glBindTexture(GL_TEXTURE_2D, 0);
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
        glViewport(0, 0, w, h);
        glClearColor(grey, grey, grey, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        overlay_draw(it, s, w, h, per_mm, eye);
        view_stage_picture p{w, h, {}};
        p.rgba.resize(static_cast<size_t>(w) * static_cast<size_t>(h) * 4);
        std::vector<uint8_t> bottom_up(p.rgba.size());
        glReadPixels(0, 0, w, h, GL_RGBA, GL_UNSIGNED_BYTE, bottom_up.data());
        const size_t row = static_cast<size_t>(w) * 4;
        for (size_t y = 0; y < static_cast<size_t>(h); y++)
            std::copy_n(bottom_up.data() + (static_cast<size_t>(h) - 1 - y) * row, row, p.rgba.data() + y * row);
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        return p;
    }
    void words_are_inside_and_apart(int w, int h, const char *what)
    {
        const std::vector<overlay_word> words = overlay_words(it);
        EXPECT_FALSE(words.empty());
        for (size_t n = 0; n < words.size(); n++) {
            const overlay_word &a = words[n];
            EXPECT_TRUE(a.x0 >= 0 && a.y0 >= 0 && a.x1 <= w && a.y1 <= h)
                << what << " " << w << " x " << h << ": \"" << a.text << "\" at " << a.x0 << " " << a.y0 << " " << a.x1;
            for (size_t m = 0; m < n; m++) {
                const overlay_word &b = words[m];
                const double over_x = std::min(a.x1, b.x1) - std::max(a.x0, b.x0);
                const double over_y = std::min(a.y1, b.y1) - std::max(a.y0, b.y0);
                /* A line is higher than its letters: some pixels of air may be shared. */
                EXPECT_FALSE(over_x > 1 && over_y > 0.3 * (a.y1 - a.y0))
                    << what << " " << w << " x " << h << ": \"" << a.text << "\" lies on \"" << b.text << "\"";
            }
        }
    }

    display *screen = nullptr;
    overlay *it = nullptr;
    GLuint texture = 0, framebuffer = 0;
    std::string trouble;
};

snapshot strip_only()
{
    snapshot s;
    s.strip.shown = true;
    s.strip.keeping = "kept";
    s.strip.mode = "tool";
    s.strip.pedals = {"apply", "undo", "clutch"};
    s.strip.action = "soft painter";
    s.strip.size = "12.5 mm";
    s.strip.rate = "strength 250";
    s.strip.undo = "1234 strokes";
    s.strip.rgb = 0x336699;
    return s;
}

snapshot begun()
{
    snapshot s = strip_only();
    s.strip.toast = "the surface has reached its limit: what was sculpted is kept, and no more can be added to it";
    s.strip.hint = {{"push, lift, tilt, twist the puck", "moves the tool"},
                    {"left pedal", "hold: the tool works the clay"},
                    {"left button", "opens the menu"}};
    return s;
}

snapshot ring(size_t sectors, int pointed)
{
    snapshot s = strip_only();
    s.strip.shown = false;
    s.menu.kind = SNAPSHOT_MENU_RING;
    s.menu.title = "look \xe2\x80\xba stereo \xe2\x80\xba side by side";
    s.menu.how = pointed < 0 ? "push the puck towards what you want, then press" : "";
    s.menu.pointed = pointed;
    const std::vector<std::string> labels = {"take all clay away", "light all round", "what moves what", "soft painter",
                                             "environment next",   "nearer",          "a pedal, a button", "toothpaste"};
    for (size_t n = 0; n < sectors; n++)
        s.menu.sectors.push_back({labels[n], "1234.5 mm a second", SNAPSHOT_MENU_ICON_BALL, 0, n == 1, n % 2 == 0});
    return s;
}

snapshot turned(snapshot_menu_kind kind)
{
    snapshot s = strip_only();
    s.menu.kind = kind;
    s.menu.title = "light 2 \xe2\x80\xba strength";
    s.menu.value = "1234.5 mm a second";
    s.menu.how = kind == SNAPSHOT_MENU_VALUE    ? "push right or twist clockwise for more; gently for fine"
                 : kind == SNAPSHOT_MENU_COLOUR ? "push towards a hue; twist for lighter; lift for stronger"
                 : kind == SNAPSHOT_MENU_CARRY  ? "the puck moves the light"
                                                : "press the pedal or button that you mean";
    s.menu.number = 0.4;
    s.menu.push = 0.7;
    s.menu.hue = 0.6;
    s.menu.saturation = s.menu.lightness = 0.5;
    return s;
}

snapshot bead()
{
    snapshot s = strip_only();
    s.strip.shown = false;
    s.keeping_shown = true;
    return s;
}

std::vector<std::pair<const char *, snapshot>> all_states()
{
    return {{"strip", strip_only()},
            {"begun", begun()},
            {"ring of 8", ring(8, -1)},
            {"ring of 8, pointed", ring(8, 0)},
            {"ring of 4", ring(4, 2)},
            {"ring of 2", ring(2, 1)},
            {"value", turned(SNAPSHOT_MENU_VALUE)},
            {"colour", turned(SNAPSHOT_MENU_COLOUR)},
            {"carry", turned(SNAPSHOT_MENU_CARRY)},
            {"learn", turned(SNAPSHOT_MENU_LEARN)},
            {"bead", bead()}};
}

TEST_F(view_overlay, words_lie_in_the_picture_and_on_nothing_else_at_every_size)
{
    const std::array<std::array<int, 2>, 8> sizes = {
        {{320, 240}, {480, 360}, {640, 480}, {800, 480}, {1280, 1024}, {1920, 1080}, {1080, 1920}, {3840, 2160}}};
    for (const auto &[w, h] : sizes)
        for (const double per_mm : {0.0, desk_per_mm, 12.0})
            for (const auto &[what, s] : all_states()) {
                draw(s, w, h, per_mm);
                words_are_inside_and_apart(w, h, what);
            }
}

TEST_F(view_overlay, letters_can_be_read_standing)
{
    draw(strip_only(), 1920, 1080, desk_per_mm);
    EXPECT_GE(overlay_cap_pixels(it) / desk_per_mm, 0.97 * OVERLAY_PEN_CAP_MM); /* letters stand on whole pixels */
    EXPECT_LE(overlay_cap_pixels(it) / desk_per_mm, 1.15 * OVERLAY_PEN_CAP_MM);
    const double known = overlay_cap_pixels(it);
    draw(strip_only(), 1920, 1080, 0);
    EXPECT_EQ(overlay_cap_pixels(it), known) << "a screen that does not say is taken for 27 inches";
    /* All that was to be shown is shown at this size. */
    EXPECT_EQ(overlay_words(it).size(), 9u);
    for (const overlay_word &w : overlay_words(it))
        EXPECT_GE((w.y1 - w.y0) * OVERLAY_PEN_CAP / desk_per_mm, 0.97 * OVERLAY_PEN_CAP_MM) << w.text;
}

TEST_F(view_overlay, every_word_of_a_ring_can_be_read_standing)
{
    for (const auto &[what, s] : all_states()) {
        draw(s, 1920, 1080, desk_per_mm);
        for (const overlay_word &w : overlay_words(it))
            EXPECT_GE((w.y1 - w.y0) * OVERLAY_PEN_CAP / desk_per_mm, 0.75 * OVERLAY_PEN_CAP_MM) << what << ": " << w.text;
    }
}

TEST_F(view_overlay, what_is_left_out_first_is_what_matters_least)
{
    draw(strip_only(), 320, 240, 12);
    std::vector<std::string> words;
    for (const overlay_word &w : overlay_words(it))
        words.push_back(w.text);
    for (const char *kept : {"kept", "apply", "undo", "clutch"})
        EXPECT_NE(std::find(words.begin(), words.end(), kept), words.end()) << kept;
    EXPECT_EQ(std::find(words.begin(), words.end(), "1234 strokes"), words.end());
}

TEST_F(view_overlay, nothing_is_drawn_where_nothing_is_to_be_shown)
{
    snapshot s = begun();
    s.strip.shown = false;
    const view_stage_picture p = draw(s, 320, 240);
    const int ground = p.byte(0, 0, 0);
    for (size_t n = 0; n < p.rgba.size(); n += 4)
        ASSERT_EQ(p.rgba[n], ground);
    EXPECT_TRUE(overlay_words(it).empty());
    EXPECT_GT(draw(begun(), 320, 240).changed(p), 1000);
}

/* Pixels of exactly this colour, and where. */
struct found {
    int count = 0;
    double x = 0, y = 0;
};
found find(const view_stage_picture &p, unsigned rgb)
{
    found f;
    for (int y = 0; y < p.height; y++)
        for (int x = 0; x < p.width; x++)
            if (std::abs(p.byte(x, y, 0) - static_cast<int>(rgb >> 16 & 255)) <= 1 &&
                std::abs(p.byte(x, y, 1) - static_cast<int>(rgb >> 8 & 255)) <= 1 &&
                std::abs(p.byte(x, y, 2) - static_cast<int>(rgb & 255)) <= 1) {
                f.count++;
                f.x += x + 0.5;
                f.y += y + 0.5;
            }
    f.x /= std::max(f.count, 1);
    f.y /= std::max(f.count, 1);
    return f;
}

TEST_F(view_overlay, a_colour_is_shown_as_it_was_chosen)
{
    for (const unsigned rgb : {0x336699u, 0xc81004u, 0x101820u}) {
        snapshot s = strip_only();
        s.strip.rgb = rgb;
        EXPECT_GT(find(draw(s, 1920, 1080), rgb).count, 200) << std::hex << rgb;
    }
}

TEST_F(view_overlay, light_is_mixed_as_light)
{
    const view_stage_picture p = draw(strip_only(), 640, 480, 0, {}, 1.0f);
    const double part = OVERLAY_PEN_GROUND >> IM_COL32_A_SHIFT & 255;
    for (int c = 0; c < 3; c++) {
        const double ground = view_stage_linear(OVERLAY_PEN_GROUND >> (8 * c) & 255);
        const double mixed = ground * part / 255 + 1 - part / 255;
        EXPECT_NEAR(p.linear(1, 478, c), mixed, 0.006) << c;
    }
    EXPECT_EQ(p.byte(1, 478, 3), 255);
}

TEST_F(view_overlay, an_eye_is_shifted_and_a_half_layout_is_drawn_for_what_the_screen_makes_of_it)
{
    const found whole = find(draw(strip_only(), 1280, 720), 0x336699);
    ASSERT_GT(whole.count, 50);
    overlay_eye eye;
    eye.shift_pixels = 12;
    const found shifted = find(draw(strip_only(), 1280, 720, 0, eye), 0x336699);
    EXPECT_NEAR(shifted.x - whole.x, 12, 0.1);
    EXPECT_NEAR(shifted.y, whole.y, 0.1);
    eye.scale_x = 0.5;
    const found half = find(draw(strip_only(), 640, 720, 0, eye), 0x336699);
    EXPECT_NEAR(half.x, (whole.x + 12) / 2, 0.5);
    EXPECT_NEAR(half.y, whole.y, 0.5);
    EXPECT_NEAR(half.count, whole.count / 2, 0.15 * whole.count);
    eye = {};
    eye.scale_y = 0.5;
    const found low = find(draw(strip_only(), 1280, 360, 0, eye), 0x336699);
    EXPECT_NEAR(low.x, whole.x, 0.5);
    EXPECT_NEAR(low.y, whole.y / 2, 0.5);
}

TEST_F(view_overlay, a_part_of_a_picture_has_its_part_of_the_words)
{
    const snapshot s = ring(8, 3);
    const view_stage_picture whole = draw(s, 640, 480);
    overlay_eye eye;
    eye.x = 200;
    eye.y = 300;
    eye.whole_width = 640;
    eye.whole_height = 480;
    const view_stage_picture part = draw(s, 320, 180, 0, eye);
    int off = 0;
    for (int y = 0; y < 180; y++)
        for (int x = 0; x < 320; x++)
            off += std::abs(part.byte(x, y, 0) - whole.byte(x + 200, y + 300, 0)) > 3;
    EXPECT_LE(off, 10) << "but for rounding along an edge";
}

TEST_F(view_overlay, without_its_font_it_says_so_once_and_draws_on)
{
    std::string text;
    EXPECT_FALSE(overlay_message_take(it, &text)) << text;
    overlay_close(it);
    it = overlay_open(&trouble, "/nowhere");
    ASSERT_NE(it, nullptr) << trouble;
    EXPECT_TRUE(overlay_message_take(it, &text));
    EXPECT_NE(text.find("/nowhere"), std::string::npos);
    EXPECT_FALSE(overlay_message_take(it, &text));
    for (const auto &[what, s] : all_states()) {
        const view_stage_picture p = draw(s, 640, 480);
        words_are_inside_and_apart(640, 480, what);
        EXPECT_GT(p.changed(draw(snapshot{}, 640, 480)), 500) << what;
    }
}

TEST_F(view_overlay, nothing_is_left_bound)
{
    draw(ring(8, 1), 320, 240);
    for (const GLenum what : {GL_CURRENT_PROGRAM, GL_VERTEX_ARRAY_BINDING, GL_ARRAY_BUFFER_BINDING, GL_TEXTURE_BINDING_2D}) {
        GLint bound = -1;
        glGetIntegerv(what, &bound);
        EXPECT_EQ(bound, 0) << what;
    }
    EXPECT_FALSE(glIsEnabled(GL_BLEND));
}

} // namespace
