/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a headless display gives an OpenGL ES 3.1 context that draws without a window, can be opened again after it was
 *       closed, and says in words what was missing when it cannot be had.
 * Method: a colour is cleared into a framebuffer object and read back; the failing machine is a child process whose EGL
 *         is told of no driver. */
#include "platform/display/display.h"

#include <GLES3/gl31.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

/* Clears a framebuffer object to the colour and reads one pixel of it. */
uint32_t cleared_pixel(float r, float g, float b)
{
    GLuint renderbuffer = 0, framebuffer = 0;
    glGenRenderbuffers(1, &renderbuffer);
    glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 16, 16);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, renderbuffer);
    glClearColor(r, g, b, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    uint8_t rgba[4] = {0, 0, 0, 0};
    glReadPixels(7, 7, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteRenderbuffers(1, &renderbuffer);
    return rgba[0] | uint32_t{rgba[1]} << 8 | uint32_t{rgba[2]} << 16 | uint32_t{rgba[3]} << 24;
}

TEST(display, draws_without_a_window)
{
    display_trouble trouble;
    display *d = display_open(DISPLAY_HEADLESS, &trouble);
    ASSERT_NE(d, nullptr) << trouble.text;
    EXPECT_STREQ(trouble.text, "");
    EXPECT_TRUE(std::string(display_description(d)).starts_with("EGL ")) << display_description(d);
    EXPECT_EQ(glGetString(GL_VERSION), nullptr) << "opened is not yet current";
    ASSERT_TRUE(display_make_current(d, &trouble)) << trouble.text;
    GLint major = 0, minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    EXPECT_GE(major * 10 + minor, 31);
    EXPECT_TRUE(std::string(reinterpret_cast<const char *>(glGetString(GL_VERSION))).starts_with("OpenGL ES "));
    EXPECT_EQ(cleared_pixel(1, 0, 1), 0xffff00ffu);
    EXPECT_EQ(cleared_pixel(0, 1, 0), 0xff00ff00u);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    display_close(d);
    EXPECT_EQ(glGetString(GL_VERSION), nullptr) << "closing ends the current context too";
}

/* Where the driver can say that it was reset, it was asked to. */
TEST(display, is_told_when_the_driver_was_reset)
{
    constexpr GLenum strategy = 0x8256 /* GL_RESET_NOTIFICATION_STRATEGY */;
    constexpr GLint lose_context = 0x8252 /* GL_LOSE_CONTEXT_ON_RESET */;
    display_trouble trouble;
    display *d = display_open(DISPLAY_HEADLESS, &trouble);
    ASSERT_NE(d, nullptr) << trouble.text;
    EXPECT_FALSE(display_is_lost(d)) << "not current yet";
    ASSERT_TRUE(display_make_current(d, &trouble)) << trouble.text;
    EXPECT_FALSE(display_is_lost(d));
    GLint asked = lose_context;
    glGetIntegerv(strategy, &asked);
    if (glGetError() == GL_NO_ERROR) {
        EXPECT_EQ(asked, lose_context);
    }
    display_close(d);
}

TEST(display, opens_again_after_closing)
{
    for (int round = 0; round < 3; round++) {
        display_trouble trouble;
        display *d = display_open(DISPLAY_HEADLESS, &trouble);
        ASSERT_NE(d, nullptr) << trouble.text;
        ASSERT_TRUE(display_make_current(d, &trouble)) << trouble.text;
        EXPECT_EQ(cleared_pixel(1, 1, 0), 0xff00ffffu);
        display_close(d);
    }
    display_close(nullptr);
}

TEST(display, refuses_a_kind_it_was_not_built_with)
{
    display_trouble trouble;
    EXPECT_EQ(display_open(static_cast<display_kind>(77), &trouble), nullptr);
    EXPECT_NE(std::strstr(trouble.text, "77"), nullptr) << trouble.text;
}

[[noreturn]] void open_without_drivers()
{
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere/no-driver.json", 1);
    display_trouble trouble;
    display *d = display_open(DISPLAY_HEADLESS, &trouble);
    std::fprintf(stderr, "%s\n", trouble.text);
    std::exit(d ? 0 : 3);
}

TEST(display_death, names_every_way_it_tried)
{
    testing::FLAGS_gtest_death_test_style = "threadsafe"; /* a fresh process: EGL reads its drivers once */
    EXPECT_EXIT(open_without_drivers(), testing::ExitedWithCode(3),
                "headless display; surfaceless: .*; device: .*; default: .*");
}

} // namespace
