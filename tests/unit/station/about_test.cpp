/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: what is said of a piece comes back as it was written; any other text is refused with the line that is wrong.
 * Method: values written and read; every prefix of a good text, and every text with one byte changed, is either refused
 *         or the same bytes when written again; names at each border of what UTF-8 and the terminal allow. */
#include "station/about.h"

#include <gtest/gtest.h>

namespace {

const std::string GOOD = "glaise piece 1\nname The cat\nstate aside\nturn 12\n";

std::string refusal(const std::string &text)
{
    about_trouble trouble;
    return about_parse(text, &trouble) ? "" : std::to_string(trouble.line) + ": " + trouble.expected;
}

TEST(about, comes_back_as_it_was_written)
{
    about_trouble trouble;
    for (const about_state state : {ABOUT_ON, ABOUT_ASIDE, ABOUT_DISCARDED})
        for (const uint64_t turn : {uint64_t{0}, uint64_t{7}, ABOUT_TURN_MAX}) {
            const about a = {" Die Vase, \xc3\xbc" "brig \xf0\x9f\x8f\xba ", state, turn};
            EXPECT_EQ(about_parse(about_text(a), &trouble), a);
        }
    EXPECT_EQ(about_parse(GOOD, &trouble), (about{"The cat", ABOUT_ASIDE, 12}));
    EXPECT_EQ(about_text({"The cat", ABOUT_ASIDE, 12}), GOOD);
    EXPECT_LE(about_text({std::string(ABOUT_NAME_BYTES_MAX, 'n'), ABOUT_DISCARDED, ABOUT_TURN_MAX}).size(),
              ABOUT_BYTES_MAX);
}

TEST(about, says_which_line_is_wrong)
{
    EXPECT_EQ(refusal("").substr(0, 2), "1:");
    EXPECT_EQ(refusal("glaise piece 2\nname a\nstate on\nturn 1\n").substr(0, 2), "1:");
    EXPECT_EQ(refusal("glaise piece 1\r\nname a\nstate on\nturn 1\n").substr(0, 2), "1:");
    EXPECT_EQ(refusal("glaise piece 1\nname \nstate on\nturn 1\n").substr(0, 2), "2:");
    EXPECT_EQ(refusal("glaise piece 1\nname a\tb\nstate on\nturn 1\n").substr(0, 2), "2:");
    EXPECT_EQ(refusal("glaise piece 1\nname a\nstate gone\nturn 1\n").substr(0, 2), "3:");
    EXPECT_EQ(refusal("glaise piece 1\nname a\nstate on\nturn 01\n").substr(0, 2), "4:");
    EXPECT_EQ(refusal("glaise piece 1\nname a\nstate on\nturn -1\n").substr(0, 2), "4:");
    EXPECT_EQ(refusal("glaise piece 1\nname a\nstate on\nturn 1000000000000\n").substr(0, 2), "4:");
    EXPECT_EQ(refusal("glaise piece 1\nname a\nstate on\nturn 99999999999999999999\n").substr(0, 2), "4:");
    EXPECT_EQ(refusal(GOOD + "\n").substr(0, 2), "5:");
}

TEST(about, cut_or_changed_is_refused_or_says_what_it_says)
{
    about_trouble trouble;
    for (size_t n = 0; n < GOOD.size(); n++)
        EXPECT_NE(refusal(GOOD.substr(0, n)), "") << n;
    for (size_t n = 0; n < GOOD.size(); n++)
        for (int byte = 0; byte < 256; byte++) {
            std::string text = GOOD;
            text[n] = static_cast<char>(byte);
            const auto a = about_parse(text, &trouble);
            if (a)
                EXPECT_EQ(about_text(*a), text);
            else
                EXPECT_TRUE(trouble.line >= 1 && trouble.line <= 5 && !trouble.expected.empty());
        }
}

TEST(about, name_is_text_that_can_be_seen)
{
    for (const std::string &good :
         {std::string("a"), std::string(100, 'x'), std::string("\xc2\xa0"), std::string("\xdf\xbf"),
          std::string("\xe0\xa0\x80"), std::string("\xed\x9f\xbf"), std::string("\xee\x80\x80"),
          std::string("\xf0\x90\x80\x80"), std::string("\xf4\x8f\xbf\xbf")})
        EXPECT_EQ(about_name_trouble(good), "") << good;
    for (const std::string &bad :
         {std::string(""), std::string(101, 'x'), std::string("   "), std::string("\0", 1), std::string("a\nb"),
          std::string("\x1b[2J"), std::string("\x7f"), std::string("\xc2\x80"), std::string("\xc2\x9b"),
          std::string("\xe2\x80\xa8"), std::string("\x80"), std::string("\xc3"), std::string("\xc0\x80"),
          std::string("\xc1\xbf"), std::string("\xe0\x9f\xbf"), std::string("\xed\xa0\x80"),
          std::string("\xed\xbf\xbf"), std::string("\xf0\x8f\xbf\xbf"), std::string("\xf4\x90\x80\x80"),
          std::string("\xf8\x88\x80\x80\x80"), std::string("\xff"), std::string("\xe2\x82"),
          std::string("\xe2\x28\xa1")})
        EXPECT_NE(about_name_trouble(bad), "") << testing::PrintToString(bad);
    EXPECT_NE(about_name_trouble("ab\x01").find("byte 3"), std::string::npos);
}

TEST(about, name_of_a_copy_is_a_name)
{
    EXPECT_EQ(about_copy_name("The cat"), "The cat (copy)");
    for (size_t n = 1; n <= ABOUT_NAME_BYTES_MAX; n++) {
        std::string name(n % 4, 'x'); /* so that a character lies across the border */
        while (name.size() + 4 <= ABOUT_NAME_BYTES_MAX)
            name += "\xf0\x9f\x8f\xba";
        EXPECT_EQ(about_name_trouble(about_copy_name(name)), "") << n;
    }
    EXPECT_EQ(about_copy_name(std::string(100, 'x')).size(), ABOUT_NAME_BYTES_MAX);
}

} // namespace
