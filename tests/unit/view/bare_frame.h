/* SPDX-License-Identifier: Apache-2.0 */
/* A headless context with a framebuffer of its own, for what is drawn without the whole view. It has one sample a pixel
   and a stencil: what is smooth there is so by itself. */
#ifndef GLAISE_TESTS_BARE_FRAME_H
#define GLAISE_TESTS_BARE_FRAME_H

#include "platform/display/display.h"
#include "view/projection.h"

#include <GLES3/gl31.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

class bare_frame : public testing::Test {
  protected:
    static constexpr int width = 320, height = 240;

    void SetUp() override
    {
        display_trouble missing;
        screen = display_open(DISPLAY_HEADLESS, &missing);
        ASSERT_NE(screen, nullptr) << missing.text;
        ASSERT_TRUE(display_make_current(screen, &missing)) << missing.text;
        glGenFramebuffers(1, &target);
        glGenRenderbuffers(2, buffers);
        glBindFramebuffer(GL_FRAMEBUFFER, target);
        attach(buffers[0], GL_RGBA8, GL_COLOR_ATTACHMENT0);
        attach(buffers[1], GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT);
        ASSERT_EQ(glCheckFramebufferStatus(GL_FRAMEBUFFER), GLenum{GL_FRAMEBUFFER_COMPLETE});
        glViewport(0, 0, width, height);
        s.camera_distance = 100;
        s.field_of_view = 0.5;
    }

    void TearDown() override { display_close(screen); }

    projection project() const
    {
        const glm::dvec3 all(200);
        return projection_make(s, width, height,
                               {projection_ball_of_box(projection_eye_from_world(s), -all, all)});
    }

    static void begin()
    {
        glDisable(GL_BLEND);
        glDisable(GL_CULL_FACE);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LEQUAL);
        glDepthMask(GL_TRUE);
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    }

    /* Red of each pixel, bottom row first. */
    static std::vector<int> end()
    {
        EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
        std::vector<uint8_t> bytes(size_t{width} * height * 4);
        glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
        std::vector<int> red;
        for (size_t n = 0; n < bytes.size(); n += 4)
            red.push_back(bytes[n]);
        return red;
    }

    static int at(const std::vector<int> &red, int x, int y)
    {
        return red.at(static_cast<size_t>(y) * width + static_cast<size_t>(x));
    }

    display *screen = nullptr;
    GLuint target = 0, buffers[2] = {0, 0};
    snapshot s;
    std::string trouble;

  private:
    static void attach(GLuint to, GLenum format, GLenum where)
    {
        glBindRenderbuffer(GL_RENDERBUFFER, to);
        glRenderbufferStorage(GL_RENDERBUFFER, format, width, height);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, where, GL_RENDERBUFFER, to);
    }
};

#endif
