/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the lamp sees all of the ball that throws shadows, and no more than it must; where it stands in it or next to
 *       it, it is moved out along its own direction.
 * Method: points of the ball through the matrices. */
#include "view/shadow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

const projection_ball ball{{10, -5, -200}, 30};

glm::dvec3 on_map(const shadow_sight &s, const glm::dvec3 &eye)
{
    const glm::dvec4 clip = s.lamp_from_eye * glm::dvec4(eye, 1);
    EXPECT_GT(clip.w, 0);
    return glm::dvec3(clip) / clip.w;
}

projection plain()
{
    projection p;
    p.eye_from_world = glm::dmat4(1);
    p.clip_from_eye = glm::dmat4(1);
    p.near_mm = 100;
    p.far_mm = 300;
    return p;
}

glm::dvec3 unit(std::mt19937 *random)
{
    std::normal_distribution<double> n;
    return glm::normalize(glm::dvec3(n(*random), n(*random), n(*random)));
}

TEST(shadow, the_whole_ball_is_on_the_map_and_fills_it)
{
    std::mt19937 random(5);
    for (const glm::dvec3 lamp : {glm::dvec3(-120, 160, 160), glm::dvec3(10, 100, -200), glm::dvec3(10, -5, -120),
                                  glm::dvec3(0, 0, 1e5)}) {
        const shadow_sight s = shadow_look(plain(), ball, lamp);
        double widest = 0;
        for (int n = 0; n < 2000; n++) {
            const glm::dvec3 at = on_map(s, ball.middle_eye + ball.radius * unit(&random));
            ASSERT_LE(std::abs(at.x), 1);
            ASSERT_LE(std::abs(at.y), 1);
            ASSERT_LE(std::abs(at.z), 1 + 1e-9);
            widest = std::max(widest, std::hypot(at.x, at.y));
        }
        EXPECT_GT(widest, 0.9) << "its pixels are not wasted";
        const glm::dvec3 middle = on_map(s, ball.middle_eye);
        EXPECT_NEAR(middle.x, 0, 1e-6);
        EXPECT_NEAR(middle.y, 0, 1e-6);
    }
}

TEST(shadow, what_is_between_the_lamp_and_a_point_lies_before_it_at_the_same_place)
{
    const glm::dvec3 lamp(-120, 160, 160);
    const shadow_sight s = shadow_look(plain(), ball, lamp);
    const glm::dvec3 near = ball.middle_eye + 20.0 * glm::normalize(lamp - ball.middle_eye) + glm::dvec3(3, 0, 2);
    const glm::dvec3 far = lamp + 1.1 * (near - lamp);
    const glm::dvec3 a = on_map(s, near), b = on_map(s, far);
    EXPECT_NEAR(a.x, b.x, 1e-9);
    EXPECT_NEAR(a.y, b.y, 1e-9);
    EXPECT_LT(a.z, b.z);
}

TEST(shadow, a_lamp_in_the_piece_is_moved_out_in_its_own_direction)
{
    const shadow_sight inside = shadow_look(plain(), ball, ball.middle_eye + glm::dvec3(0, 5, 0));
    const shadow_sight outside =
        shadow_look(plain(), ball, ball.middle_eye + glm::dvec3(0, SHADOW_NEAREST * ball.radius, 0));
    EXPECT_EQ(inside.lamp_from_eye, outside.lamp_from_eye);
    const shadow_sight middle = shadow_look(plain(), ball, ball.middle_eye);
    EXPECT_TRUE(std::isfinite(on_map(middle, ball.middle_eye + glm::dvec3(1, 2, 3)).z));
}

/* A texel's width: two points so far apart at 1 mm from the lamp are one texel apart on the map. */
TEST(shadow, a_texel_is_as_wide_as_it_says)
{
    const shadow_sight s = shadow_look(plain(), ball, {10, 145, -200});
    const double deep = 150;
    const glm::dvec3 a = on_map(s, ball.middle_eye),
                     b = on_map(s, ball.middle_eye + glm::dvec3(s.texel_mm * deep * 100, 0, 0));
    EXPECT_NEAR(std::hypot(a.x - b.x, a.y - b.y) / 2 * double{SHADOW_SIDE}, 100, 1e-6);
}

} // namespace
