/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: every outcome has a sentence of its own that a screen can show.
 * Method: all of them are asked, and one that does not exist. */
#include "lattice/status.h"

#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <string>

namespace {

TEST(status_text, is_one_sentence_for_each)
{
    std::set<std::string> texts;
    for (int s = STATUS_OK; s <= STATUS_NEWER; s++) {
        const std::string text = status_text(static_cast<status>(s));
        ASSERT_FALSE(text.empty());
        EXPECT_TRUE(std::islower(static_cast<unsigned char>(text.front()))) << text;
        EXPECT_NE(text.back(), '.') << text;
        EXPECT_NE(text, "unknown status");
        EXPECT_TRUE(texts.insert(text).second) << text << " is said of two outcomes";
    }
}

TEST(status_text, never_fails)
{
    EXPECT_STREQ(status_text(static_cast<status>(STATUS_NEWER + 1)), "unknown status");
}

} // namespace
