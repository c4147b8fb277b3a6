/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a path is cut evenly by distance and time, and no time is lost. */
#include "station/stroke.h"

#include <gtest/gtest.h>

namespace {

constexpr double STEP_S = 0.004;
const stroke_rule RULE{2, 10, 0.04, 256};

double seconds_of(const std::vector<stroke_dab> &dabs)
{
    double sum = 0;
    for (const stroke_dab &d : dabs)
        sum += d.seconds;
    return sum;
}

std::vector<stroke_dab> sweep(double mm_per_step, int steps)
{
    std::vector<stroke_dab> dabs;
    motion_pose now;
    stroke s = stroke_begin(now);
    for (int n = 0; n < steps; n++) {
        now.place[0] += mm_per_step;
        stroke_step(&s, now, STEP_S, RULE, &dabs);
    }
    stroke_end(&s, now, RULE, &dabs);
    return dabs;
}

} // namespace

TEST(stroke, at_rest_it_dabs_by_time)
{
    std::vector<stroke_dab> dabs = sweep(0, 101);
    EXPECT_EQ(dabs.size(), 1u + 10u); /* at once, then every 40 ms */
    EXPECT_NEAR(seconds_of(dabs), 101 * STEP_S, 1e-12);
}

TEST(stroke, slow_or_fast_it_dabs_by_distance)
{
    for (double mm : {0.3, 1.0, 2.5, 17.0}) {
        std::vector<stroke_dab> dabs = sweep(mm, 200);
        EXPECT_NEAR(seconds_of(dabs), 200 * STEP_S, 1e-12) << mm;
        for (size_t n = 1; n < dabs.size(); n++) {
            double apart = dabs[n].pose.place[0] - dabs[n - 1].pose.place[0];
            EXPECT_GT(apart, 0) << mm;
            EXPECT_LE(apart, RULE.spacing_mm + mm) << mm;
            if (mm >= RULE.spacing_mm) {
                EXPECT_LE(apart, RULE.spacing_mm + 1e-9) << mm;
            }
        }
        EXPECT_NEAR(dabs.back().pose.place[0], mm * 200, 1e-9);
    }
}

TEST(stroke, a_leap_is_bounded)
{
    EXPECT_LE(sweep(1e5, 1).size(), static_cast<size_t>(RULE.most));
}

TEST(stroke, turning_in_place_counts_as_moving)
{
    std::vector<stroke_dab> dabs;
    motion_pose now;
    stroke s = stroke_begin(now);
    stroke_step(&s, now, STEP_S, RULE, &dabs);
    now.turn = motion_about({0, 0, 1}, 0.5); /* 5 mm of arc at the reach of 10 mm */
    stroke_step(&s, now, STEP_S, RULE, &dabs);
    EXPECT_EQ(dabs.size(), 1u + 3u);
}

TEST(stroke, a_jump_draws_no_line)
{
    std::vector<stroke_dab> dabs;
    motion_pose now;
    stroke s = stroke_begin(now);
    stroke_step(&s, now, STEP_S, RULE, &dabs);
    now.place[0] = 100;
    stroke_jump(&s, now);
    stroke_step(&s, now, STEP_S, RULE, &dabs);
    EXPECT_EQ(dabs.size(), 1u);
    stroke_end(&s, now, RULE, &dabs);
    EXPECT_EQ(dabs.size(), 2u);
    EXPECT_EQ(dabs.back().pose.place[0], 100);
}
