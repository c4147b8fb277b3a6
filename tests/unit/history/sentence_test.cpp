/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: pieces and numbers stand in the array as they were added, and never beyond its end.
 * Method: numbers at the ends of their range; arrays too small by every amount, with a sentinel behind them. */
#include "history/sentence.h"

#include <gtest/gtest.h>

#include <string>

namespace {

TEST(sentence, joins_pieces_and_numbers)
{
    char text[80];
    sentence s = sentence_begin(text, sizeof text);
    EXPECT_STREQ(text, "");
    sentence_add(&s, "undo-");
    sentence_add_number(&s, 7, 4);
    sentence_add(&s, " ");
    sentence_add_number(&s, 0, 1);
    sentence_add(&s, " ");
    sentence_add_number(&s, UINT64_MAX, 1);
    sentence_add(&s, " ");
    sentence_add_number(&s, 12345, 4);
    EXPECT_STREQ(text, "undo-0007 0 18446744073709551615 12345");
}

TEST(sentence, cuts_what_does_not_fit)
{
    const std::string whole = "abc1234";
    for (size_t room = 1; room <= whole.size() + 2; room++) {
        char text[16];
        for (char &c : text)
            c = '#';
        sentence s = sentence_begin(text, room);
        sentence_add(&s, "abc");
        sentence_add_number(&s, 1234, 1);
        EXPECT_EQ(text, whole.substr(0, room - 1));
        EXPECT_EQ(text[room], '#');
    }
}

} // namespace
