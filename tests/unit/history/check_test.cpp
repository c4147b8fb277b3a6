/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: what a power cut leaves behind is a note; damage is a problem.
 * Method: a store with checkpoints after strokes 4 and 6, bricks of its undo-files turned over. */
#include "history/check.h"

#include "tests/unit/history/recovery_scene.h"

#include <gtest/gtest.h>

namespace {

struct told {
    std::vector<std::string> notes, problems;
    check_facts facts;
};

void take(void *self, check_weight weight, const char *file, uint64_t, const char *)
{
    told *t = static_cast<told *>(self);
    (weight == CHECK_PROBLEM ? t->problems : t->notes).emplace_back(file);
}

told check(memory_store m)
{
    told t;
    const byte_store port = m.port();
    EXPECT_EQ(check_run(&port, take, &t, &t.facts), STATUS_OK);
    EXPECT_EQ(t.facts.problems, t.problems.size());
    return t;
}

using names = std::vector<std::string>;

TEST(check, a_sound_store_has_nothing_to_be_told)
{
    const told t = check(recovery_scene().m);
    EXPECT_EQ(t.notes, names());
    EXPECT_EQ(t.problems, names());
    EXPECT_EQ(t.facts.checkpoints, 2u);
}

TEST(check, one_file_beneath_both_checkpoints_may_have_been_begun_anew)
{
    for (uint64_t stroke = 1; stroke <= 4; stroke++) {
        recovery_scene s;
        s.turn(stroke, RECOVERY_SCENE_IN_BRICKS);
        const told t = check(s.m);
        EXPECT_EQ(t.notes, names{s.files.at(stroke)}) << stroke;
        EXPECT_EQ(t.problems, names()) << stroke;
    }
}

TEST(check, two_of_them_are_damage)
{
    recovery_scene s;
    s.turn(1, RECOVERY_SCENE_IN_BRICKS);
    s.turn(3, RECOVERY_SCENE_IN_BRICKS);
    EXPECT_EQ(check(s.m).problems.size(), 1u);
}

TEST(check, what_a_checkpoint_needs_is_damage)
{
    for (uint64_t stroke = 5; stroke <= 8; stroke++) {
        recovery_scene s;
        s.turn(stroke, RECOVERY_SCENE_IN_BRICKS);
        EXPECT_EQ(check(s.m).problems, names{s.files.at(stroke)}) << stroke;
    }
    recovery_scene without({6});
    without.turn(1, RECOVERY_SCENE_IN_BRICKS);
    EXPECT_EQ(check(without.m).problems, names{without.files.at(1)}) << "there is but one checkpoint";
    recovery_scene spoilt;
    spoilt.turn(1, RECOVERY_SCENE_IN_BRICKS);
    spoilt.m.files.at(HISTORY_FIELD_NAME).back() ^= 1;
    EXPECT_EQ(check(spoilt.m).problems.size(), 2u) << "there is but one sound checkpoint";
}

} // namespace
