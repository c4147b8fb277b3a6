/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: there are always lanes to work with, and what is chosen for a machine runs on it.
 * Method: every choice asked for; a function of three variants says which of them LANES_PICK took. */
#include "lattice/lanes.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace {

const lanes all_lanes[LANES_COUNT] = {LANES_PLAIN, LANES_AVX2, LANES_AVX512};

TEST(lanes, plain_ones_are_everywhere)
{
    EXPECT_TRUE(lanes_are_here(LANES_PLAIN));
}

TEST(lanes, the_best_are_here_and_none_that_are_here_are_wider)
{
    EXPECT_TRUE(lanes_are_here(lanes_best()));
    for (lanes l : all_lanes)
        EXPECT_TRUE(!lanes_are_here(l) || l <= lanes_best()) << lanes_name(l);
}

TEST(lanes, names_differ)
{
    std::set<std::string> names;
    for (lanes l : all_lanes) {
        EXPECT_FALSE(std::string(lanes_name(l)).empty());
        names.insert(lanes_name(l));
    }
    EXPECT_EQ(names.size(), size_t{LANES_COUNT});
}

std::string variant_plain() { return "plain"; }
[[maybe_unused]] std::string variant_avx2() { return "avx2"; }
[[maybe_unused]] std::string variant_avx512() { return "avx512"; }

TEST(lanes, pick_takes_the_variant_of_that_name)
{
    EXPECT_EQ(LANES_PICK(variant, LANES_PLAIN)(), "plain");
#if defined(__x86_64__)
    EXPECT_EQ(LANES_PICK(variant, LANES_AVX2)(), "avx2");
    EXPECT_EQ(LANES_PICK(variant, LANES_AVX512)(), "avx512");
#else
    EXPECT_EQ(LANES_PICK(variant, LANES_AVX2)(), "plain") << "elsewhere there is nothing else";
    EXPECT_FALSE(lanes_are_here(LANES_AVX2));
    EXPECT_FALSE(lanes_are_here(LANES_AVX512));
#endif
}

} // namespace
