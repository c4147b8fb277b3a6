/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a press keeps its meaning until it comes up; one that a menu took is nobody else's. Method: edges by hand. */
#include "station/controls.h"

#include <gtest/gtest.h>

namespace {

TEST(controls, a_press_comes_up_as_what_it_went_down_as)
{
    controls_press p;
    p.means = CONTROLS_MEANS_CLUTCH;
    EXPECT_EQ(controls_edge(&p, true, false), CONTROLS_MEANS_CLUTCH);
    p.means = CONTROLS_MEANS_APPLY;
    EXPECT_EQ(controls_edge(&p, false, false), CONTROLS_MEANS_CLUTCH);
    EXPECT_EQ(controls_edge(&p, true, false), CONTROLS_MEANS_APPLY);
}

TEST(controls, a_press_that_was_taken_comes_up_as_nothing)
{
    controls_press p;
    p.means = CONTROLS_MEANS_APPLY;
    EXPECT_EQ(controls_edge(&p, true, true), CONTROLS_MEANS_APPLY);
    EXPECT_EQ(controls_edge(&p, false, false), CONTROLS_MEANS_NOTHING);
    EXPECT_EQ(controls_edge(&p, true, false), CONTROLS_MEANS_APPLY);
    EXPECT_EQ(controls_edge(&p, false, false), CONTROLS_MEANS_APPLY);
}

TEST(controls, an_up_without_a_down_is_heard)
{
    controls_press p;
    p.means = CONTROLS_MEANS_APPLY;
    EXPECT_EQ(controls_edge(&p, false, false), CONTROLS_MEANS_APPLY);
}

TEST(controls, the_clutch_exchanges_tool_and_scene_and_leaves_lights)
{
    controls d = controls_at_first();
    d.moves[3] = CONTROLS_LIGHT0;
    EXPECT_EQ(controls_moved(d, 0), CONTROLS_TOOL);
    EXPECT_EQ(controls_moved(d, 1), CONTROLS_SCENE);
    d.clutch = true;
    EXPECT_EQ(controls_moved(d, 0), CONTROLS_SCENE);
    EXPECT_EQ(controls_moved(d, 1), CONTROLS_TOOL);
    EXPECT_EQ(controls_moved(d, 2), CONTROLS_LIGHT0);
}

} // namespace
