/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: each action does to one corner what its line in the manual says, to the bit where that is promised.
 * Method: action_row on made-up rows and aprons. The same actions through whole dabs, against a reference of their own,
 *         are in tests/property/tool_test.cpp. */
#include "tool/action.h"

#include "clay/apron.h"
#include "clay/colour.h"
#include "clay/potential.h"

#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace {

const action all_actions[ACTION_COUNT] = {ACTION_TOOTHPASTE,   ACTION_SOFT_ERASER, ACTION_ERASER, ACTION_PAINTER,
                                          ACTION_SOFT_PAINTER, ACTION_SMOOTH,      ACTION_STAMP,  ACTION_PRINT};

/* A row with everything round it; the row lies in the middle of the apron. */
struct scene {
    std::vector<float> apron = std::vector<float>(1000, 0.0f);
    std::vector<uint32_t> apron_rgba = std::vector<uint32_t>(1000, COLOUR_NONE);
    float v_tool[8] = {};
    float potential[8] = {};
    uint32_t rgba[8] = {};
    deform def = deform_default();
    static constexpr size_t place = (5 * 10 + 5) * 10 + 1;
    key first = {40, -16, 8};

    void take_row()
    {
        for (size_t n = 0; n < 8; n++) {
            potential[n] = apron[place + n];
            rgba[n] = apron_rgba[place + n];
        }
    }
    void act(action kind, float amount, uint32_t colour, unsigned mask = 255)
    {
        const action_setting s = {kind, colour, amount, &def, 3};
        const bool near = action_reads_neighbours(kind);
        action_row(&s, first, mask, v_tool, near ? &apron[place] : nullptr, near ? &apron_rgba[place] : nullptr,
                   potential, rgba);
    }
};

scene noisy(seeded &chance, double density)
{
    scene s;
    for (size_t n = 0; n < 1000; n++)
        if (seeded_chance(chance, density)) {
            s.apron[n] = static_cast<float>(seeded_real(chance, 0.001, 3));
            s.apron_rgba[n] = static_cast<uint32_t>(seeded_bits(chance));
        }
    for (float &v : s.v_tool)
        v = static_cast<float>(seeded_real(chance, 0.001, 3));
    s.take_row();
    return s;
}

TEST(action_name, is_one_for_each)
{
    std::set<std::string> names;
    for (action a : all_actions)
        EXPECT_TRUE(names.insert(action_name(a)).second);
    EXPECT_STREQ(action_name(ACTION_TOOTHPASTE), "toothpaste");
    EXPECT_STREQ(action_name(ACTION_SOFT_ERASER), "soft-eraser");
    EXPECT_STREQ(action_name(ACTION_PRINT), "print");
}

TEST(action_row, keeps_off_corners_that_are_not_masked)
{
    seeded chance = {1};
    for (action a : all_actions)
        for (int round = 0; round < 200; round++) {
            scene s = noisy(chance, 0.7);
            const scene before = s;
            const unsigned mask = static_cast<unsigned>(seeded_bits(chance)) & 255u;
            s.act(a, 0.5f, 0x11223344u, mask);
            for (int n = 0; n < 8; n++) {
                if (!(mask >> n & 1)) {
                    ASSERT_EQ(s.potential[n], before.potential[n]);
                    ASSERT_EQ(s.rgba[n], before.rgba[n]);
                }
            }
        }
}

TEST(action_row, uses_only_the_neighbours_it_says_it_reads)
{
    seeded chance = {2};
    for (action a : all_actions) {
        bool differs = false;
        for (int round = 0; round < 100; round++) {
            scene s = noisy(chance, 0.7), other = s;
            for (size_t n = 0; n < 1000; n++)
                if (n < s.place || n >= s.place + 8)
                    other.apron[n] = 3 - other.apron[n];
            s.act(a, 0.7f, 5);
            other.act(a, 0.7f, 5);
            for (int n = 0; n < 8; n++)
                differs = differs || s.potential[n] != other.potential[n] || s.rgba[n] != other.rgba[n];
        }
        EXPECT_EQ(differs, action_reads_neighbours(a)) << action_name(a);
    }
}

TEST(action_makes_clay, is_true_of_those_that_do)
{
    seeded chance = {3};
    for (action a : all_actions) {
        bool made = false;
        for (int round = 0; round < 100; round++) {
            scene s = noisy(chance, 0.5);
            std::fill(s.potential, s.potential + 8, 0.0f);
            std::fill(&s.apron[s.place], &s.apron[s.place] + 8, 0.0f);
            s.act(a, 0.7f, 5);
            for (float v : s.potential)
                made = made || v > POTENTIAL_MIN;
        }
        EXPECT_EQ(made, action_makes_clay(a)) << action_name(a);
    }
}

TEST(action_contributes, is_what_dirties)
{
    deform def = deform_default();
    for (action a : all_actions) {
        action_setting s = {a, 5, 1, &def, 0};
        EXPECT_TRUE(action_contributes(&s, 1.0f)) << action_name(a);
        for (float none : {0.0f, -1.0f, std::nanf("")})
            EXPECT_FALSE(action_contributes(&s, none)) << action_name(a);
        s.amount = 0;
        EXPECT_EQ(action_contributes(&s, 1.0f), a == ACTION_ERASER || a == ACTION_PAINTER) << action_name(a);
    }
    for (action a : {ACTION_STAMP, ACTION_PRINT}) {
        action_setting s = {a, 5, 1, &def, 0};
        EXPECT_FALSE(action_contributes(&s, POTENTIAL_ISO)) << "nothing happens on the tool's surface";
        EXPECT_FALSE(action_contributes(&s, 0.1f)) << "nor beyond s + m + r";
        EXPECT_TRUE(action_contributes(&s, 1.4f));
    }
}

TEST(action_toothpaste, adds_and_mixes_by_contribution)
{
    seeded chance = {4};
    for (int round = 0; round < 500; round++) {
        scene s = noisy(chance, 0.7);
        const scene before = s;
        const float amount = static_cast<float>(seeded_real(chance, 0.01, 5));
        s.act(ACTION_TOOTHPASTE, amount, 0xA0B0C0D0u);
        for (int n = 0; n < 8; n++) {
            const float f = before.potential[n], d = std::min(amount / 3 * s.v_tool[n], 3 - f);
            ASSERT_EQ(s.potential[n], f + d);
            const float t = colour_dither(key_add(s.first, 0, 0, n), 3);
            ASSERT_EQ(s.rgba[n], f > 0 ? colour_mix(before.rgba[n], 0xA0B0C0D0u, d / (f + d), t) : 0xA0B0C0D0u);
        }
    }
}

TEST(action_erasers, take_away)
{
    seeded chance = {5};
    scene soft = noisy(chance, 1), hard = soft;
    const scene before = soft;
    soft.act(ACTION_SOFT_ERASER, 0.25f, 0);
    hard.act(ACTION_ERASER, 0.25f, 0);
    for (int n = 0; n < 8; n++) {
        EXPECT_EQ(soft.potential[n], before.potential[n] - 0.25f * (before.v_tool[n] / 3));
        EXPECT_EQ(soft.rgba[n], before.rgba[n]);
        EXPECT_EQ(hard.potential[n], POTENTIAL_MIN);
    }
}

TEST(action_painters, leave_the_potential_alone)
{
    seeded chance = {6};
    for (int round = 0; round < 500; round++) {
        scene hard = noisy(chance, 0.7), soft = hard;
        const scene before = hard;
        hard.act(ACTION_PAINTER, 0.001f, 0x01020304u);
        soft.act(ACTION_SOFT_PAINTER, 0.5f, 0x01020304u);
        for (int n = 0; n < 8; n++) {
            ASSERT_EQ(hard.potential[n], before.potential[n]);
            ASSERT_EQ(hard.rgba[n], 0x01020304u);
            ASSERT_EQ(soft.potential[n], before.potential[n]);
            const float f = before.potential[n], d = 0.5f * (before.v_tool[n] / 3);
            const float t = colour_dither(key_add(soft.first, 0, 0, n), 3);
            ASSERT_EQ(soft.rgba[n], f > 0 ? colour_mix(before.rgba[n], 0x01020304u, d / (f + d), t) : before.rgba[n]);
        }
    }
}

TEST(action_smooth, conserves_constants_to_the_bit)
{
    seeded chance = {7};
    for (int round = 0; round < 5000; round++) {
        scene s = noisy(chance, 0);
        const float c = static_cast<float>(seeded_real(chance, 0.01, 3));
        std::fill(s.apron.begin(), s.apron.end(), c);
        s.take_row();
        s.act(ACTION_SMOOTH, static_cast<float>(seeded_real(chance, 0, 2)), 5);
        for (float v : s.potential)
            ASSERT_EQ(v, c);
    }
}

double low_pass(const scene &s, int n)
{
    double sum = 0;
    for (int i = -1; i <= 1; i++)
        for (int j = -1; j <= 1; j++)
            for (int k = -1; k <= 1; k++)
                sum += (2 - std::abs(i)) * (2 - std::abs(j)) * (2 - std::abs(k)) / 64.0 *
                       s.apron[s.place + static_cast<size_t>(n + k + 10 * j + 100 * i)];
    return sum;
}

TEST(action_smooth, goes_its_part_of_the_way_to_the_binomial_mean_and_never_past_the_neighbours)
{
    seeded chance = {8};
    for (int round = 0; round < 3000; round++) {
        scene s = noisy(chance, seeded_real(chance, 0, 1));
        const scene before = s;
        const double amount = seeded_real(chance, 0, 1.5), part = std::min(amount, 1.0);
        s.act(ACTION_SMOOTH, static_cast<float>(amount), 5);
        for (int n = 0; n < 8; n++) {
            float lo = 3, hi = 0;
            for (int step : {-111, -110, -109, -101, -100, -99, -91, -90, -89, -11, -10, -9, -1, 0,
                             1,    9,    10,   11,   89,   90,  91,  99,  100, 101, 109, 110, 111}) {
                const float near = before.apron[static_cast<size_t>(static_cast<int>(s.place) + n + step)];
                lo = std::min(lo, near);
                hi = std::max(hi, near);
            }
            const double f = before.potential[n], w = s.v_tool[n] / 3.0;
            const double to = f + part * w * (low_pass(before, n) - f);
            ASSERT_LE(s.potential[n], hi + 3e-7f);
            if (to <= POTENTIAL_FAINT + 1e-6 && s.potential[n] == 0)
                continue; /* too faint to be left */
            ASSERT_GT(s.potential[n], POTENTIAL_FAINT);
            ASSERT_NEAR(s.potential[n], to, 1e-6);
            ASSERT_GE(s.potential[n], lo - 3e-7f);
        }
    }
}

/* The sharpest ripple there is vanishes in one go and does not turn over. */
TEST(action_smooth, removes_the_checkerboard_without_ringing)
{
    scene s;
    for (size_t n = 0; n < 1000; n++)
        s.apron[n] = (n + n / 10 + n / 100) % 2 ? 2.0f : 1.0f;
    std::fill(s.v_tool, s.v_tool + 8, POTENTIAL_MAX);
    for (float amount : {0.25f, 1.0f, 50.0f}) {
        s.take_row();
        const float before = s.potential[0];
        s.act(ACTION_SMOOTH, amount, 5);
        const float part = std::min(amount, 1.0f);
        EXPECT_FLOAT_EQ(s.potential[0] - 1.5f, (before - 1.5f) * (1 - part));
    }
}

TEST(action_stamp, is_still_where_the_tools_surface_is)
{
    seeded chance = {9};
    for (action a : {ACTION_STAMP, ACTION_PRINT}) {
        scene s = noisy(chance, 1);
        std::fill(s.v_tool, s.v_tool + 8, POTENTIAL_ISO);
        const scene before = s;
        for (int n = 0; n < 1000; n++)
            s.act(a, 1, 5);
        for (int n = 0; n < 8; n++)
            EXPECT_EQ(s.potential[n], before.potential[n]) << action_name(a);
    }
}

TEST(action_stamp, adds_and_print_multiplies)
{
    seeded chance = {10};
    for (int round = 0; round < 500; round++) {
        scene stamp = noisy(chance, 0.7), print = stamp;
        const scene before = stamp;
        const double amount = seeded_real(chance, 0, 2), part = std::min(amount, 1.0);
        stamp.act(ACTION_STAMP, static_cast<float>(amount), 5);
        print.act(ACTION_PRINT, static_cast<float>(amount), 5);
        for (int n = 0; n < 8; n++) {
            const double f = before.potential[n], def = deform_at(&stamp.def, POTENTIAL_MAX - before.v_tool[n]);
            ASSERT_NEAR(stamp.potential[n], f + part * def, 1e-6);
            ASSERT_NEAR(print.potential[n], f + part * def * f, 1e-6);
            ASSERT_TRUE(f > 0 || print.potential[n] == 0) << "a print makes nothing out of nothing";
        }
    }
}

TEST(action_print, empties_at_the_centre_exactly)
{
    seeded chance = {11};
    scene s = noisy(chance, 1);
    std::fill(s.v_tool, s.v_tool + 8, POTENTIAL_MAX);
    s.act(ACTION_PRINT, 1, 5);
    for (float v : s.potential)
        EXPECT_EQ(v, 0);
}

TEST(action_smooth, and_stamp_give_new_clay_the_colour_of_the_clay_round_it)
{
    seeded chance = {12};
    int made = 0, bare = 0;
    for (int round = 0; round < 4000; round++) {
        scene s = noisy(chance, round % 2 ? 0.05 : 0);
        const scene before = s;
        s.act(round % 4 < 2 ? ACTION_SMOOTH : ACTION_STAMP, 1, 0x05060708u);
        for (int n = 0; n < 8; n++) {
            if (before.potential[n] > 0 || !(s.potential[n] > 0))
                continue;
            double weight = 0, channel[4] = {};
            for (int p = 0; p < 27; p++) {
                const int i = p / 9 - 1, j = p / 3 % 3 - 1, k = p % 3 - 1;
                const size_t at = static_cast<size_t>(static_cast<int>(s.place) + n + k + 10 * j + 100 * i);
                const double w = before.apron[at] * (2 - std::abs(i)) * (2 - std::abs(j)) * (2 - std::abs(k));
                weight += w;
                for (int c = 0; c < 4; c++)
                    channel[c] += w * colour_channel(before.apron_rgba[at], c);
            }
            for (int c = 0; c < 4 && weight > 0; c++)
                ASSERT_NEAR(colour_channel(s.rgba[n], c), channel[c] / weight, 0.501);
            if (!(weight > 0)) {
                ASSERT_EQ(s.rgba[n], 0x05060708u) << "no clay near: the tool's colour";
                bare++;
            }
            made++;
        }
    }
    EXPECT_GT(made - bare, 100);
    EXPECT_GT(bare, 100);
}

} // namespace
