/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal    Reports of both axis forms, of bit and code buttons and of batteries become the right device events, and
 *         nothing that a device may send (halves, short, unknown, out of range) becomes a wrong one.
 * Method  Reports as published captures show them, and hand-written ones, against hand-written events. Every report is
 *         an exact-size heap copy.
 */
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "platform/device_event.h"
#include "platform/spacemouse/hid_descriptor.h"
#include "platform/spacemouse/spacemouse_report.h"
#include "tests/unit/spacemouse/spacemouse_bytes.h"

namespace {

using bytes = std::vector<uint8_t>;
using events = std::vector<device_event>;

/* 2 buttons as bits (report 3), 6 codes (0x1c), 6 long codes (0x1d). */
const bytes both_button_forms = {
    0x05, 0x01, 0x09, 0x08, 0xa1, 0x01,
    0x85, 0x03, 0x05, 0x09, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x08, 0x19, 0x01, 0x29, 0x08, 0x81, 0x02,
    0x85, 0x1c, 0x15, 0x00, 0x27, 0xff, 0xff, 0x00, 0x00, 0x75, 0x10, 0x95, 0x06, 0x19, 0x00, 0x2a, 0xff, 0xff, 0x81,
    0x00,
    0x85, 0x1d, 0x19, 0x00, 0x2a, 0xff, 0xff, 0x81, 0x00,
    0xc0};

class one_device {
public:
    explicit one_device(const bytes &descriptor_bytes, uint32_t device = 7)
    {
        spacemouse_bytes_exact copy(descriptor_bytes);
        hid_descriptor descriptor;
        hid_descriptor_error error;
        EXPECT_TRUE(hid_descriptor_parse(copy.data, copy.size, &descriptor, &error)) << error.expected;
        spacemouse_report_init(&state, device, &descriptor);
    }

    events report(const bytes &input)
    {
        spacemouse_bytes_exact copy(input);
        events out(SPACEMOUSE_REPORT_EVENTS_MAX);
        out.resize(spacemouse_report_decode(&state, ++now_us, copy.data, copy.size, out.data(), out.size()));
        for (const device_event &event : out) {
            EXPECT_EQ(event.time_us, now_us);
            EXPECT_EQ(event.device, state.device);
        }
        return out;
    }

    spacemouse_report state;
    int64_t now_us = 1000;
};

void expect_axes(const device_event &event, const std::vector<int> &axes)
{
    EXPECT_EQ(event.kind, DEVICE_EVENT_AXES);
    for (int i = 0; i < DEVICE_EVENT_AXIS_COUNT; i++) {
        EXPECT_EQ(event.axes[i], axes[i]) << i;
        EXPECT_EQ(event.axis_max[i], 350) << i;
    }
}

void expect_button(const device_event &event, int number, bool down, bool long_press = false)
{
    EXPECT_EQ(event.kind, DEVICE_EVENT_BUTTON);
    EXPECT_EQ(event.number, number);
    EXPECT_EQ(event.down, down);
    EXPECT_EQ(event.long_press, long_press);
}

} // namespace

TEST(device_event, stays_small)
{
    EXPECT_EQ(sizeof(device_event), 48u);
}

TEST(spacemouse_report, translation_and_rotation_reports_keep_each_others_half)
{
    one_device s(spacemouse_bytes_navigator);
    events e = s.report({0x01, 0x0a, 0x00, 0xec, 0xff, 0x5e, 0x01});
    ASSERT_EQ(e.size(), 1u);
    expect_axes(e[0], {10, -20, 350, 0, 0, 0});
    e = s.report({0x02, 0x00, 0x00, 0xe2, 0xff, 0x01, 0x00});
    ASSERT_EQ(e.size(), 1u);
    expect_axes(e[0], {10, -20, 350, 0, -30, 1});
    e = s.report({0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00});
    ASSERT_EQ(e.size(), 1u);
    expect_axes(e[0], {0, 0, 0, 0, -30, 1});
}

TEST(spacemouse_report, an_unchanged_position_is_still_reported)
{
    one_device s(spacemouse_bytes_navigator);
    bytes held = {0x01, 0x0a, 0x00, 0x00, 0x00, 0x00, 0x00};
    EXPECT_EQ(s.report(held).size(), 1u);
    EXPECT_EQ(s.report(held).size(), 1u);
}

TEST(spacemouse_report, one_report_of_thirteen_bytes_holds_all_six)
{
    one_device s(spacemouse_bytes_wireless);
    events e = s.report({0x01, 0x01, 0x00, 0xfe, 0xff, 0x03, 0x00, 0xfc, 0xff, 0x05, 0x00, 0xfa, 0xff});
    ASSERT_EQ(e.size(), 1u);
    expect_axes(e[0], {1, -2, 3, -4, 5, -6});
}

TEST(spacemouse_report, counts_beyond_the_declared_range_pass_untouched)
{
    one_device s(spacemouse_bytes_navigator);
    events e = s.report({0x01, 0xff, 0x7f, 0x00, 0x80, 0x90, 0x01});
    ASSERT_EQ(e.size(), 1u);
    expect_axes(e[0], {32767, -32768, 400, 0, 0, 0});
}

TEST(spacemouse_report, wide_axes_and_their_maximum_stop_at_int16)
{
    /* X of 32 bits, -100000..100000; Y absent. */
    one_device s({0x05, 0x01, 0x09, 0x08, 0xa1, 0x01, 0x17, 0x60, 0x79, 0xfe, 0xff, 0x27, 0xa0, 0x86, 0x01, 0x00, 0x09,
               0x30, 0x75, 0x20, 0x95, 0x01, 0x81, 0x02, 0xc0});
    events e = s.report({0xa0, 0x86, 0x01, 0x00});
    ASSERT_EQ(e.size(), 1u);
    EXPECT_EQ(e[0].axes[DEVICE_EVENT_X], 32767);
    EXPECT_EQ(e[0].axis_max[DEVICE_EVENT_X], 32767);
    EXPECT_EQ(e[0].axis_max[DEVICE_EVENT_Y], 0);
    e = s.report({0x60, 0x79, 0xfe, 0xff});
    EXPECT_EQ(e[0].axes[DEVICE_EVENT_X], -32768);
}

TEST(spacemouse_report, axis_max_is_known_before_the_first_report_of_an_axis)
{
    one_device s(spacemouse_bytes_navigator);
    events e = s.report({0x01, 0, 0, 0, 0, 0, 0});
    ASSERT_EQ(e.size(), 1u);
    expect_axes(e[0], {0, 0, 0, 0, 0, 0});
}

TEST(spacemouse_report, an_axis_told_in_two_reports_comes_with_the_range_of_the_last)
{
    /* X in report 1 up to 100, in report 2 up to 50. */
    one_device s({0x05, 0x01, 0x09, 0x08, 0xa1, 0x01, 0x15, 0x9c, 0x25, 0x64, 0x75, 0x08, 0x95, 0x01, 0x85, 0x01, 0x09,
                  0x30, 0x81, 0x02, 0x25, 0x32, 0x85, 0x02, 0x09, 0x30, 0x81, 0x02, 0xc0});
    EXPECT_EQ(s.report({0x02, 0x10})[0].axis_max[DEVICE_EVENT_X], 50);
    EXPECT_EQ(s.report({0x01, 0x20})[0].axis_max[DEVICE_EVENT_X], 100);
    EXPECT_EQ(s.report({0x02, 0x10})[0].axes[DEVICE_EVENT_X], 16);
}

TEST(spacemouse_report, button_bits_make_press_and_release)
{
    one_device s(spacemouse_bytes_navigator);
    events e = s.report({0x03, 0x01, 0x00});
    ASSERT_EQ(e.size(), 1u);
    expect_button(e[0], 0, true);
    EXPECT_TRUE(s.report({0x03, 0x01, 0x00}).empty());
    e = s.report({0x03, 0x03, 0x00});
    ASSERT_EQ(e.size(), 1u);
    expect_button(e[0], 1, true);
    e = s.report({0x03, 0x00, 0x00});
    ASSERT_EQ(e.size(), 2u);
    expect_button(e[0], 0, false);
    expect_button(e[1], 1, false);
}

TEST(spacemouse_report, constant_bits_behind_the_buttons_are_no_buttons)
{
    one_device s(spacemouse_bytes_navigator);
    EXPECT_TRUE(s.report({0x03, 0xfc, 0xff}).empty());
}

TEST(spacemouse_report, button_reports_of_any_length_are_decoded)
{
    one_device s(spacemouse_bytes_navigator);
    EXPECT_EQ(s.report({0x03, 0x01}).size(), 1u);
    EXPECT_EQ(s.report({0x03, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00}).size(), 1u);
}

TEST(spacemouse_report, bits_a_short_report_does_not_reach_stay_as_they_were)
{
    /* 27 bits, as the Pro family has. */
    one_device s({0x05, 0x01, 0x09, 0x08, 0xa1, 0x01, 0x85, 0x03, 0x05, 0x09, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95,
               0x1b, 0x19, 0x01, 0x29, 0x1b, 0x81, 0x02, 0xc0});
    events e = s.report({0x03, 0x00, 0x10, 0x00, 0x04, 0x00, 0x00});
    ASSERT_EQ(e.size(), 2u);
    expect_button(e[0], 12, true);
    expect_button(e[1], 26, true);
    e = s.report({0x03, 0x00, 0x00});
    ASSERT_EQ(e.size(), 1u);
    expect_button(e[0], 12, false);
    e = s.report({0x03, 0x00, 0x00, 0x00, 0x00});
    ASSERT_EQ(e.size(), 1u);
    expect_button(e[0], 26, false);
}

TEST(spacemouse_report, an_axis_that_a_short_report_cuts_keeps_its_value)
{
    one_device s(spacemouse_bytes_wireless);
    (void)s.report({0x01, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 6, 0});
    events e = s.report({0x01, 9, 0, 8, 0, 7});
    ASSERT_EQ(e.size(), 1u);
    expect_axes(e[0], {9, 8, 3, 4, 5, 6});
}

TEST(spacemouse_report, codes_are_compared_with_the_last_ones)
{
    one_device s(both_button_forms);
    events e = s.report({0x1c, 0x01, 0x00, 0x4d, 0x00, 0, 0, 0, 0, 0, 0, 0, 0});
    ASSERT_EQ(e.size(), 2u);
    expect_button(e[0], 0, true);
    expect_button(e[1], 76, true);
    /* Same codes in another order and place: no change. */
    EXPECT_TRUE(s.report({0x1c, 0, 0, 0x4d, 0x00, 0, 0, 0x01, 0x00, 0, 0, 0, 0}).empty());
    e = s.report({0x1c, 0x4d, 0x00, 0x67, 0x00, 0, 0, 0, 0, 0, 0, 0, 0});
    ASSERT_EQ(e.size(), 2u);
    expect_button(e[0], 0, false);
    expect_button(e[1], 102, true);
    e = s.report({0x1c, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    ASSERT_EQ(e.size(), 2u);
    expect_button(e[0], 76, false);
    expect_button(e[1], 102, false);
}

TEST(spacemouse_report, a_press_told_in_bits_and_codes_is_one_press)
{
    one_device s(both_button_forms);
    events e = s.report({0x03, 0x01});
    ASSERT_EQ(e.size(), 1u);
    expect_button(e[0], 0, true);
    EXPECT_TRUE(s.report({0x1c, 0x01, 0x00, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}).empty());
    /* From here on the bits are ignored, whatever they say. */
    EXPECT_TRUE(s.report({0x03, 0x00}).empty());
    EXPECT_TRUE(s.report({0x03, 0x82}).empty());
    e = s.report({0x1c, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    ASSERT_EQ(e.size(), 1u);
    expect_button(e[0], 0, false);
    EXPECT_TRUE(s.report({0x03, 0x01}).empty());
    EXPECT_EQ(s.state.reports_short, 0u);
}

TEST(spacemouse_report, long_presses_live_beside_short_ones)
{
    one_device s(both_button_forms);
    EXPECT_EQ(s.report({0x1c, 0x01, 0x00, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}).size(), 1u);
    events e = s.report({0x1d, 0x01, 0x00, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    ASSERT_EQ(e.size(), 1u);
    expect_button(e[0], 0, true, true);
    e = s.report({0x1c, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    ASSERT_EQ(e.size(), 1u);
    expect_button(e[0], 0, false);
    e = s.report({0x1d, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    ASSERT_EQ(e.size(), 1u);
    expect_button(e[0], 0, false, true);
}

TEST(spacemouse_report, long_presses_alone_do_not_silence_the_bits)
{
    one_device s(both_button_forms);
    (void)s.report({0x1d, 0x01, 0x00, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    events e = s.report({0x03, 0x02});
    ASSERT_EQ(e.size(), 1u);
    expect_button(e[0], 1, true);
}

TEST(spacemouse_report, a_button_array_counts_from_its_logical_minimum)
{
    /* Codes 5..8 stand for buttons 3..6 (usages), so code 5 is button number 2; others are no button. */
    one_device s({0x05, 0x01, 0x09, 0x08, 0xa1, 0x01, 0x05, 0x09, 0x15, 0x05, 0x25, 0x08, 0x19, 0x03, 0x29, 0x06, 0x75,
               0x08, 0x95, 0x02, 0x81, 0x00, 0xc0});
    events e = s.report({0x05, 0x04});
    ASSERT_EQ(e.size(), 1u);
    expect_button(e[0], 2, true);
    e = s.report({0x08, 0x09});
    ASSERT_EQ(e.size(), 2u);
    expect_button(e[0], 2, false);
    expect_button(e[1], 5, true);
}

TEST(spacemouse_report, a_code_that_stands_for_usage_zero_is_no_button)
{
    one_device s({0x05, 0x01, 0x09, 0x08, 0xa1, 0x01, 0x05, 0x09, 0x15, 0x00, 0x25, 0x08, 0x19, 0x00, 0x29, 0x08, 0x75,
                  0x08, 0x95, 0x02, 0x81, 0x00, 0xc0});
    EXPECT_TRUE(s.report({0x00, 0x00}).empty());
    events e = s.report({0x00, 0x01});
    ASSERT_EQ(e.size(), 1u);
    expect_button(e[0], 0, true);
}

TEST(spacemouse_report, codes_beyond_the_table_are_ignored)
{
    one_device s(both_button_forms);
    events e = s.report({0x1c, 0xff, 0xff, 0x01, 0x01, 0x00, 0x01, 0, 0, 0, 0, 0, 0});
    ASSERT_EQ(e.size(), 1u); /* code 0x0100 is the last button, 0x0101 one too many */
    expect_button(e[0], SPACEMOUSE_REPORT_BUTTONS_MAX - 1, true);
}

TEST(spacemouse_report, bits_beyond_the_table_are_ignored)
{
    /* 264 bits, then one code of 8 bits. */
    one_device s({0x05, 0x01, 0x09, 0x08, 0xa1, 0x01, 0x05, 0x09, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x96, 0x08, 0x01,
                  0x19, 0x01, 0x2a, 0x08, 0x01, 0x81, 0x02, 0x25, 0x20, 0x75, 0x08, 0x95, 0x01, 0x19, 0x00, 0x29, 0x20,
                  0x81, 0x00, 0xc0});
    bytes report(34, 0x00);
    report[32] = 0x01; /* button number 256 */
    EXPECT_TRUE(s.report(report).empty());
    report[33] = 0x20;
    events e = s.report(report);
    ASSERT_EQ(e.size(), 1u);
    expect_button(e[0], 31, true);
}

TEST(spacemouse_report, the_battery_is_a_percentage)
{
    one_device s(spacemouse_bytes_wireless);
    events e = s.report({0x17, 0x64, 0x01});
    ASSERT_EQ(e.size(), 1u);
    EXPECT_EQ(e[0].kind, DEVICE_EVENT_BATTERY);
    EXPECT_EQ(e[0].battery_percent, 100);
    EXPECT_EQ(s.report({0x17, 0x25})[0].battery_percent, 37);
    EXPECT_EQ(s.report({0x17, 0xff})[0].battery_percent, 100);
    /* 10..210: scaled. */
    one_device t({0x05, 0x01, 0x09, 0x08, 0xa1, 0x01, 0x15, 0x0a, 0x26, 0xd2, 0x00, 0x05, 0x06, 0x09, 0x20, 0x75, 0x08,
               0x95, 0x01, 0x81, 0x02, 0xc0});
    EXPECT_EQ(t.report({0x6e})[0].battery_percent, 50);
    EXPECT_EQ(t.report({0x00})[0].battery_percent, 0);
}

TEST(spacemouse_report, unknown_and_short_reports_are_counted_and_change_nothing)
{
    one_device s(spacemouse_bytes_navigator);
    (void)s.report({0x01, 1, 0, 2, 0, 3, 0});
    EXPECT_TRUE(s.report({0x10, 1, 2, 3, 4, 5, 6}).empty());
    EXPECT_TRUE(s.report({0x00, 1, 2, 3, 4, 5, 6}).empty());
    EXPECT_TRUE(s.report({0xff}).empty());
    EXPECT_EQ(s.state.reports_unknown, 3u);
    EXPECT_EQ(s.state.reports_short, 0u);
    EXPECT_TRUE(s.report({}).empty());
    EXPECT_TRUE(s.report({0x01}).empty());
    EXPECT_TRUE(s.report({0x01, 0x55}).empty());
    EXPECT_TRUE(s.report({0x03}).empty());
    EXPECT_EQ(s.state.reports_short, 4u);
    EXPECT_EQ(s.state.reports_unknown, 3u);
    events e = s.report({0x02, 0, 0, 0, 0, 0, 0});
    ASSERT_EQ(e.size(), 1u);
    expect_axes(e[0], {1, 2, 3, 0, 0, 0});
}

TEST(spacemouse_report, a_device_without_report_ids_is_read_from_its_first_byte)
{
    one_device s({0x05, 0x01, 0x09, 0x08, 0xa1, 0x01, 0x16, 0xa2, 0xfe, 0x26, 0x5e, 0x01, 0x19, 0x30, 0x29, 0x35, 0x75,
               0x10, 0x95, 0x06, 0x81, 0x02, 0xc0});
    events e = s.report({0x01, 0, 0x02, 0, 0x03, 0, 0x04, 0, 0x05, 0, 0x06, 0});
    ASSERT_EQ(e.size(), 1u);
    expect_axes(e[0], {1, 2, 3, 4, 5, 6});
    EXPECT_TRUE(s.report({}).empty());
    EXPECT_EQ(s.state.reports_short, 1u);
}

TEST(spacemouse_report, axes_come_first_when_a_report_holds_everything)
{
    /* X, then 8 buttons, then a battery, in one report without id. */
    one_device s({0x05, 0x01, 0x09, 0x08, 0xa1, 0x01, 0x15, 0x80, 0x25, 0x7f, 0x75, 0x08, 0x95, 0x01, 0x09, 0x30, 0x81,
               0x02, 0x05, 0x09, 0x75, 0x01, 0x95, 0x08, 0x19, 0x01, 0x29, 0x08, 0x81, 0x02, 0x05, 0x06, 0x15, 0x00,
               0x25, 0x64, 0x75, 0x08, 0x95, 0x01, 0x09, 0x20, 0x81, 0x02, 0xc0});
    events e = s.report({0xf0, 0x81, 0x32});
    ASSERT_EQ(e.size(), 4u);
    EXPECT_EQ(e[0].kind, DEVICE_EVENT_AXES);
    EXPECT_EQ(e[0].axes[DEVICE_EVENT_X], -16);
    EXPECT_EQ(e[1].kind, DEVICE_EVENT_BATTERY);
    EXPECT_EQ(e[1].battery_percent, 50);
    expect_button(e[2], 0, true);
    expect_button(e[3], 7, true);
}

TEST(spacemouse_report, members_that_do_not_belong_to_the_kind_are_zero)
{
    one_device s(spacemouse_bytes_navigator);
    (void)s.report({0x01, 1, 0, 2, 0, 3, 0});
    events e = s.report({0x03, 0x01, 0x00});
    ASSERT_EQ(e.size(), 1u);
    for (int i = 0; i < DEVICE_EVENT_AXIS_COUNT; i++) {
        EXPECT_EQ(e[0].axes[i], 0);
        EXPECT_EQ(e[0].axis_max[i], 0);
    }
    EXPECT_EQ(e[0].battery_percent, 0);
}

TEST(spacemouse_report, a_descriptor_that_is_not_multi_axis_yields_nothing)
{
    one_device s({0x05, 0x01, 0x09, 0x02, 0xa1, 0x01, 0x15, 0x81, 0x25, 0x7f, 0x09, 0x30, 0x75, 0x08, 0x95, 0x01, 0x81,
               0x06, 0xc0});
    EXPECT_TRUE(s.report({0x55}).empty());
    EXPECT_EQ(s.state.reports_unknown, 0u);
    EXPECT_EQ(s.state.reports_short, 0u);
}

TEST(spacemouse_report_death, too_little_room_for_events_is_our_bug)
{
    one_device s(spacemouse_bytes_navigator);
    const uint8_t report[] = {0x03, 0x01, 0x00};
    device_event one;
    size_t count = 0;
    EXPECT_DEATH(count = spacemouse_report_decode(&s.state, 0, report, sizeof report, &one, 1), "EVENTS_MAX");
    EXPECT_EQ(count, 0u);
}
