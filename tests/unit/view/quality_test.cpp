/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a box that cannot hold its frame rate gives up one thing at a time, in the stated order, and takes it back when
 *       there is room; one that can and cannot by turns does not flicker.
 * Method: frames of given lengths; each level's rules against those before it. */
#include "view/quality.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <string>

namespace {

constexpr int64_t ms = 1000000;

int changes_after(quality *q, int frames, int64_t took_ns)
{
    int changes = 0;
    for (int n = 0; n < frames; n++)
        changes += quality_frame(q, took_ns);
    return changes;
}

TEST(quality, each_level_asks_for_less_than_the_one_before)
{
    std::set<std::string> texts;
    for (int level = 1; level < QUALITY_LEVELS; level++) {
        const quality_rules a = quality_rules_of(level - 1), b = quality_rules_of(level);
        EXPECT_LE(b.blur, a.blur);
        EXPECT_LE(b.shadow_taps, a.shadow_taps);
        EXPECT_LE(b.hollow_taps, a.hollow_taps);
        EXPECT_LE(b.samples, a.samples);
        EXPECT_LE(b.scale, a.scale);
        EXPECT_TRUE(b.blur < a.blur || b.shadow_taps < a.shadow_taps || b.hollow_taps < a.hollow_taps ||
                    b.samples < a.samples || b.scale < a.scale)
            << "level " << level << " gives nothing up";
        texts.insert(quality_text(level));
    }
    EXPECT_EQ(texts.size(), size_t{QUALITY_LEVELS - 1}) << "each says what it does without";
    EXPECT_STREQ(quality_text(0), "");
    const quality_rules least = quality_rules_of(QUALITY_LEVELS - 1);
    EXPECT_EQ(least.shadow_taps, 0);
    EXPECT_GT(least.scale, 0);
}

TEST(quality, late_frames_lower_it_to_the_last_level_and_no_further)
{
    quality q;
    EXPECT_EQ(changes_after(&q, QUALITY_LATE - 1, 20 * ms), 0) << "a hiccup is none";
    EXPECT_EQ(changes_after(&q, 1, 20 * ms), 1);
    EXPECT_EQ(q.level, 1);
    EXPECT_EQ(changes_after(&q, 1000, 20 * ms), QUALITY_LEVELS - 2);
    EXPECT_EQ(q.level, QUALITY_LEVELS - 1);
}

TEST(quality, some_late_frames_among_good_ones_change_nothing)
{
    quality q;
    for (int n = 0; n < 3000; n++)
        EXPECT_FALSE(quality_frame(&q, n % 2 ? 20 * ms : 12 * ms));
    EXPECT_EQ(q.level, 0);
}

TEST(quality, it_rises_when_there_is_room_for_long)
{
    quality q;
    changes_after(&q, 2 * QUALITY_LATE, 20 * ms);
    ASSERT_EQ(q.level, 2);
    EXPECT_EQ(changes_after(&q, 3000, 14 * ms), 0) << "in time, but with no room";
    EXPECT_EQ(changes_after(&q, QUALITY_CALM - 1, 5 * ms), 0);
    EXPECT_EQ(changes_after(&q, 1, 5 * ms), 1);
    EXPECT_EQ(q.level, 1);
    changes_after(&q, QUALITY_CALM + 1, 5 * ms);
    EXPECT_EQ(q.level, 0);
    EXPECT_EQ(changes_after(&q, 1000, 5 * ms), 0);
}

/* What fits at one level and not at the one above is tried again ever more seldom. */
TEST(quality, it_does_not_go_up_and_down_without_end)
{
    quality q;
    int changes = 0;
    for (int n = 0; n < 60 * 600; n++) /* ten minutes */
        changes += quality_frame(&q, q.level == 0 ? 20 * ms : 5 * ms);
    EXPECT_GT(changes, 2) << "it does try again";
    EXPECT_LT(changes, 30);
}

} // namespace
