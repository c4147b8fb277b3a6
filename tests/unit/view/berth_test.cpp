/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: what is taken is nobody else's, lies as low as it can, and joins up again when it is given back; a page is only
 *       called full when it is as full as the header promises.
 * Method: seeded takes and gives beside a plain row of bools, which finds the place by looking at every unit. */
#include "view/berth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace {

struct range {
    int first, units;
};

/* Lowest place of `units` free ones, by brute force. */
int place(const std::vector<bool> &taken, int units)
{
    for (int n = 0, run = 0; n < BERTH_UNITS; n++) {
        run = taken[static_cast<size_t>(n)] ? 0 : run + 1;
        if (run == units)
            return n + 1 - units;
    }
    return BERTH_NONE;
}

void mark(std::vector<bool> *taken, range r, bool to)
{
    for (int n = r.first; n < r.first + r.units; n++) {
        ASSERT_NE((*taken)[static_cast<size_t>(n)], to) << "unit " << n;
        (*taken)[static_cast<size_t>(n)] = to;
    }
}

void compare(const berth &b, const std::vector<bool> &taken)
{
    int top = BERTH_UNITS;
    while (top > 0 && !taken[static_cast<size_t>(top - 1)])
        top--;
    ASSERT_EQ(b.top, top);
    ASSERT_EQ(b.count, std::count(taken.begin(), taken.end(), true));
}

TEST(berth, takes_and_gives_of_any_order_leave_no_trace)
{
    for (unsigned seed = 1; seed <= 20; seed++) {
        std::mt19937 random(seed);
        const int longest = seed % 2 ? 61 : 200;
        berth b;
        std::vector<bool> taken(BERTH_UNITS, false);
        std::vector<range> held;
        int full = 0;
        for (int step = 0; step < 3000; step++) {
            /* waves: mostly taking, then mostly giving */
            const bool giving = random() % 8 < (step / 500 % 2 ? 6u : 2u);
            if (giving && !held.empty()) {
                std::swap(held[random() % held.size()], held.back());
                berth_give(&b, held.back().first, held.back().units);
                mark(&taken, held.back(), false);
                held.pop_back();
            } else {
                const int units = 1 + static_cast<int>(random() % static_cast<unsigned>(longest));
                const int first = berth_take(&b, units);
                ASSERT_EQ(first, place(taken, units)) << "seed " << seed << " step " << step;
                if (first == BERTH_NONE) {
                    full++;
                    ASSERT_GE(b.count, BERTH_UNITS / units) << "what the header says of a full page";
                    continue;
                }
                held.push_back({first, units});
                mark(&taken, held.back(), true);
            }
            compare(b, taken);
        }
        EXPECT_GT(full, 0) << "the page was never full";
        for (const range &r : held)
            berth_give(&b, r.first, r.units);
        EXPECT_EQ(b.count, 0);
        EXPECT_EQ(b.top, 0);
        EXPECT_EQ(berth_take(&b, BERTH_UNITS), 0) << "whole again";
    }
}

TEST(berth, a_place_asked_for_is_taken_only_when_all_of_it_is_free)
{
    berth b;
    ASSERT_TRUE(berth_take_at(&b, 60, 10)) << "over the end of a word";
    EXPECT_EQ(b.top, 70);
    EXPECT_FALSE(berth_take_at(&b, 69, 5));
    EXPECT_FALSE(berth_take_at(&b, 55, 6));
    EXPECT_EQ(b.count, 10) << "a refusal takes nothing";
    EXPECT_TRUE(berth_take_at(&b, 55, 5));
    EXPECT_TRUE(berth_take_at(&b, 2040, 8));
    EXPECT_EQ(berth_take(&b, 56), 70) << "55 are free below";
    EXPECT_EQ(berth_take(&b, 55), 0);
    EXPECT_EQ(b.top, 2048);
}

TEST(berth_death, giving_what_is_not_taken_is_our_bug)
{
    berth b;
    ASSERT_EQ(berth_take(&b, 4), 0);
    EXPECT_DEATH(berth_give(&b, 2, 4), "");
}

} // namespace
