/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a freeform tool shows the line where its surface meets what is drawn already, on its near side and its far side,
 *       and nothing of the kind where there is no stencil buffer or nothing is met; the stencil is zero afterwards.
 * Method: the scene is a wall: depth cleared to a plane's. A ball through it meets it in a circle. */
#include "bare_frame.h"
#include "field_fill.h"
#include "view/marker.h"

#include <algorithm>

namespace {

class view_meeting : public bare_frame {
  protected:
    static constexpr double radius = 10;

    void SetUp() override
    {
        bare_frame::SetUp();
        ASSERT_TRUE(marker_open(&it, &trouble)) << trouble;
        form.fill({{-14, -14, -14}, {14, 14, 14}}, 0xffffffff, [](double x, double y, double z) {
            return POTENTIAL_ISO + 0.7 * (radius - std::sqrt(x * x + y * y + z * z));
        });
        form.finish();
        upload_init(&patches, true);
        ASSERT_TRUE(upload_update(&patches, &form.it->surface, UPLOAD_ALL, &trouble)) << trouble;
        s.tool_surface = &form.it->surface;
        s.tool_style = SNAPSHOT_TOOL_TRANSPARENT;
        s.box_shown = false;
    }

    void TearDown() override
    {
        upload_finish(&patches);
        marker_close(&it);
        bare_frame::TearDown();
    }

    /* A wall facing the viewer where world z is 0, and the ball's middle this far before it. */
    std::vector<int> draw(double before)
    {
        s.tool_world = frame{};
        for (int a = 0; a < 3; a++)
            s.tool_world.axis[a][a] = 1;
        s.tool_world.origin[2] = before;
        const projection p = project();
        const glm::dvec4 wall = p.clip_from_eye * glm::dvec4(0, 0, -s.camera_distance, 1);
        glClearDepthf(static_cast<float>(0.5 + 0.5 * wall.z / wall.w));
        begin();
        marker_draw_tool(it, s, p, &patches);
        return end();
    }

    /* How many degrees of a circle about the middle are brighter than all beside them, within and without. */
    int marked(const std::vector<int> &red, double of_radius) const
    {
        const double pixels = of_radius * projection_pixels_per_mm(s, height, s.camera_distance);
        const auto seen = [&](double away, int degree) {
            const double a = degree * M_PI / 180;
            return at(red, static_cast<int>(width / 2.0 + away * std::cos(a)),
                      static_cast<int>(height / 2.0 + away * std::sin(a)));
        };
        int count = 0;
        for (int degree = 0; degree < 360; degree++) {
            int most = 0;
            for (const double d : {-1.0, 0.0, 1.0})
                most = std::max(most, seen(pixels + d, degree));
            count += most > seen(pixels - 5, degree) + 60 && most > seen(pixels + 5, degree) + 60;
        }
        return count;
    }

    marker it;
    upload patches;
    field_fill_piece form{2000};
};

TEST_F(view_meeting, is_where_the_surfaces_cross)
{
    for (const double before : {4.0, -4.0}) /* the near half is cut, the far half is cut */
        EXPECT_GT(marked(draw(before), std::sqrt(radius * radius - before * before)), 350) << before;
    EXPECT_EQ(glIsEnabled(GL_STENCIL_TEST), GL_FALSE);
    EXPECT_EQ(glIsEnabled(GL_POLYGON_OFFSET_FILL), GL_FALSE);
}

TEST_F(view_meeting, is_not_where_nothing_is_met)
{
    for (const double before : {14.0, -14.0}) {
        const std::vector<int> red = draw(before);
        for (double r = 2; r < 9; r++)
            EXPECT_LT(marked(red, r), 60) << before << " " << r;
    }
}

TEST_F(view_meeting, is_left_out_without_a_stencil)
{
    const std::vector<int> with = draw(4);
    glBindRenderbuffer(GL_RENDERBUFFER, buffers[1]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, 0);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
    ASSERT_EQ(glCheckFramebufferStatus(GL_FRAMEBUFFER), GLenum{GL_FRAMEBUFFER_COMPLETE});
    const std::vector<int> without = draw(4);
    EXPECT_LT(marked(without, std::sqrt(radius * radius - 16)), 20);
    EXPECT_GT(at(without, width / 2, height / 2), 20) << "the tool itself is there";
}

TEST_F(view_meeting, leaves_the_stencil_zero)
{
    const std::vector<int> first = draw(4), red = first;
    /* what is drawn where the stencil is not zero must not be seen */
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_NOTEQUAL, 0, 0xff);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    marker plain;
    ASSERT_TRUE(marker_open(&plain, &trouble)) << trouble;
    s.tool_surface = nullptr;
    s.lights_shown = true;
    s.lights[0].lit = true;
    s.lights[0].position = {0, 0, 20};
    s.camera_distance = 100;
    projection p = project();
    s.camera_distance = 3000; /* a light as large as the ball */
    marker_draw_lights(plain, s, p);
    glDisable(GL_STENCIL_TEST);
    marker_close(&plain);
    EXPECT_EQ(end(), first);
}

} // namespace
