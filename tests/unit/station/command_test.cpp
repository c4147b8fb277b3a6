/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: every command has a text that parses back to it, and nothing outside its ranges becomes a command. Method: all
   forms are walked; good and bad values are made from their own ranges. */
#include "station/command.h"

#include <gtest/gtest.h>
#include <set>

namespace {

std::string good_value(const command_argument &a, bool high)
{
    switch (a.kind) {
    case COMMAND_NUMBER:
    case COMMAND_INTEGER: return command_number_text(high ? a.hi : a.lo);
    case COMMAND_WORD: return std::string(high ? a.words.back() : a.words.front());
    case COMMAND_RGB: return high ? "#ffffff" : "#00a1b2";
    case COMMAND_NAME: return high ? "a-b_C.png" : "x";
    }
    return {};
}

std::vector<std::string> bad_values(const command_argument &a)
{
    switch (a.kind) {
    case COMMAND_NUMBER: return {command_number_text(a.hi * 1.001 + 1), "nan", "inf", "x", "1,5", "0x10", "1e999"};
    case COMMAND_INTEGER: return {command_number_text(a.hi + 1), command_number_text(a.lo - 1), "0.5", "nan"};
    case COMMAND_WORD: return {"nonsense", "#", "1"};
    case COMMAND_RGB: return {"red", "#12345", "#1234567", "#12345g", "123456"};
    case COMMAND_NAME: return {"../x", "/etc/passwd", "-x", ".x", "a/b"};
    }
    return {};
}

/* A line of good values, argument `at` replaced. Commands that relate their arguments get values that fit together. */
std::string line_of(const command_form &form, bool high, size_t at, const std::string &with)
{
    std::string line(form.name);
    for (size_t n = 0; n < form.arguments.size(); n++) {
        std::string value = good_value(form.arguments[n], high);
        if (form.kind == COMMAND_DEFORM)
            value = std::vector<std::string>{"1.5", "0.4", "0.9", "0.3", "1"}[n];
        if (form.kind == COMMAND_WORKSPACE)
            value = n < 3 ? "-1" : "1";
        if (form.kind == COMMAND_EXPORT)
            value += ".ply";
        line += " " + (n == at ? with : value);
    }
    return line;
}

} // namespace

TEST(command, forms_are_in_order_and_named_once)
{
    std::set<std::string_view> names;
    int kind = 0;
    for (const command_form &form : command_forms()) {
        EXPECT_EQ(form.kind, kind++);
        EXPECT_TRUE(names.insert(form.name).second) << form.name;
        EXPECT_LE(form.arguments.size(), static_cast<size_t>(COMMAND_NUMBERS));
        EXPECT_FALSE(form.does.empty());
    }
    EXPECT_EQ(kind, COMMAND_COUNT);
}

TEST(command, text_and_parse_are_inverse_for_every_form)
{
    for (const command_form &form : command_forms())
        for (bool high : {false, true}) {
            std::string expected, line = line_of(form, high, SIZE_MAX, "");
            std::optional<command> c = command_parse(line, &expected);
            ASSERT_TRUE(c) << line << ": " << expected;
            EXPECT_EQ(command_text(*c), line);
            std::optional<command> again = command_parse(command_text(*c), &expected);
            ASSERT_TRUE(again);
            EXPECT_EQ(*again, *c);
        }
}

TEST(command, every_bad_value_is_refused_and_named)
{
    for (const command_form &form : command_forms())
        for (size_t n = 0; n < form.arguments.size(); n++)
            for (const std::string &bad : bad_values(form.arguments[n])) {
                std::string expected, line = line_of(form, true, n, bad);
                EXPECT_FALSE(command_parse(line, &expected)) << line;
                EXPECT_NE(expected.find(form.arguments[n].name), std::string::npos) << line << ": " << expected;
            }
}

TEST(command, missing_and_surplus_arguments_are_refused)
{
    std::string expected;
    EXPECT_FALSE(command_parse("place 1 2", &expected));
    EXPECT_NE(expected.find("Z"), std::string::npos);
    EXPECT_FALSE(command_parse("place 1 2 3 4", &expected));
    EXPECT_FALSE(command_parse("", &expected));
    EXPECT_FALSE(command_parse("plaice 1 2 3", &expected));
}

TEST(command, what_no_single_argument_says_is_checked_too)
{
    std::string expected;
    EXPECT_FALSE(command_parse("deform 1.5 1 1 0.3 1", &expected)); /* s + m + r > 3 */
    EXPECT_FALSE(command_parse("deform 1.4 0.4 0.9 0.3 1", &expected));
    EXPECT_FALSE(command_parse("turn 0 0 0 90", &expected));
    EXPECT_FALSE(command_parse("orbit 1 2 3 0 0 0 90 100", &expected));
    EXPECT_FALSE(command_parse("workspace 0 0 0 1 0 1", &expected));
    EXPECT_FALSE(command_parse("export owl.3mf", &expected));
    EXPECT_NE(expected.find(".glaise"), std::string::npos) << expected;
}

TEST(command, numbers_are_written_shortest_and_exact)
{
    EXPECT_EQ(command_number_text(0.1), "0.1");
    EXPECT_EQ(command_number_text(-12), "-12");
    EXPECT_EQ(std::stod(command_number_text(0.1 + 0.2)), 0.1 + 0.2);
}
