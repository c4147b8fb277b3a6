/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal    The descriptor parser finds the right bits of the two published SpaceMouse descriptors, follows HID 1.11 in
 *         everything a device may write differently, and refuses malformed bytes at the right offset.
 * Method  Small descriptors written item by item, each next to what the standard says of it. Inputs are exact-size heap
 *         copies. Cutting and flipping sweeps check that no input at all does harm.
 */
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "platform/device_event.h"
#include "platform/spacemouse/hid_descriptor.h"
#include "tests/unit/spacemouse/spacemouse_bytes.h"

namespace {

using bytes = std::vector<uint8_t>;

const bytes open_multi_axis = {0x05, 0x01, 0x09, 0x08, 0xa1, 0x01};
const bytes close_collection = {0xc0};

bytes operator+(bytes a, const bytes &b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

hid_descriptor parsed(const bytes &input)
{
    spacemouse_bytes_exact copy(input);
    hid_descriptor descriptor;
    hid_descriptor_error error;
    EXPECT_TRUE(hid_descriptor_parse(copy.data, copy.size, &descriptor, &error))
        << "offset " << error.offset << ": expected " << error.expected;
    return descriptor;
}

hid_descriptor in_multi_axis(const bytes &items)
{
    return parsed(open_multi_axis + items + close_collection);
}

void expect_refused(const bytes &input, size_t offset, const std::string &expected)
{
    spacemouse_bytes_exact copy(input);
    hid_descriptor descriptor;
    hid_descriptor_error error;
    ASSERT_FALSE(hid_descriptor_parse(copy.data, copy.size, &descriptor, &error));
    EXPECT_EQ(error.offset, offset);
    EXPECT_NE(std::string(error.expected).find(expected), std::string::npos) << error.expected;
    EXPECT_FALSE(descriptor.multi_axis);
    EXPECT_EQ(descriptor.field_count, 0u);
}

void expect_axis(const hid_descriptor_field &field, int axis, uint8_t report_id, uint32_t bit, bool relative)
{
    EXPECT_EQ(field.role, HID_DESCRIPTOR_AXIS);
    EXPECT_EQ(field.first, axis);
    EXPECT_EQ(field.report_id, report_id);
    EXPECT_EQ(field.bit, bit);
    EXPECT_EQ(field.size_bits, 16);
    EXPECT_EQ(field.count, 1);
    EXPECT_EQ(field.relative, relative);
    EXPECT_EQ(field.logical_min, -350);
    EXPECT_EQ(field.logical_max, 350);
}

} // namespace

TEST(hid_descriptor, navigator_has_three_axes_in_each_of_two_reports_and_two_buttons)
{
    ASSERT_EQ(spacemouse_bytes_navigator.size(), 217u);
    hid_descriptor d = parsed(spacemouse_bytes_navigator);
    EXPECT_TRUE(d.multi_axis);
    EXPECT_TRUE(d.report_ids);
    ASSERT_EQ(d.field_count, 7u);
    for (int axis = 0; axis < 6; axis++) {
        expect_axis(d.fields[axis], axis, axis < 3 ? 1 : 2, 16u * (axis % 3), true);
    }
    EXPECT_EQ(d.fields[6].role, HID_DESCRIPTOR_BUTTON_BITS);
    EXPECT_EQ(d.fields[6].report_id, 3);
    EXPECT_EQ(d.fields[6].first, 0);
    EXPECT_EQ(d.fields[6].count, 2);
    EXPECT_EQ(d.fields[6].size_bits, 1);
    EXPECT_EQ(d.input_bytes_max, 7u);
    for (int id = 0; id < 256; id++) {
        EXPECT_EQ(hid_descriptor_has_input(&d, (uint8_t)id), id >= 1 && id <= 3) << id;
    }
}

TEST(hid_descriptor, wireless_has_six_axes_in_one_report_two_buttons_and_a_battery)
{
    ASSERT_EQ(spacemouse_bytes_wireless.size(), 270u);
    hid_descriptor d = parsed(spacemouse_bytes_wireless);
    EXPECT_TRUE(d.multi_axis);
    ASSERT_EQ(d.field_count, 8u);
    for (int axis = 0; axis < 6; axis++) {
        expect_axis(d.fields[axis], axis, 1, 16u * axis, false);
    }
    EXPECT_EQ(d.fields[6].role, HID_DESCRIPTOR_BUTTON_BITS);
    EXPECT_EQ(d.fields[6].count, 2);
    EXPECT_EQ(d.fields[7].role, HID_DESCRIPTOR_BATTERY);
    EXPECT_EQ(d.fields[7].report_id, 0x17);
    EXPECT_EQ(d.fields[7].bit, 0u);
    EXPECT_EQ(d.fields[7].size_bits, 8);
    EXPECT_EQ(d.fields[7].logical_min, 0);
    EXPECT_EQ(d.fields[7].logical_max, 100);
    EXPECT_EQ(d.input_bytes_max, 13u);
    EXPECT_TRUE(hid_descriptor_has_input(&d, 0x17));
    EXPECT_FALSE(hid_descriptor_has_input(&d, 4));
}

TEST(hid_descriptor, a_mouse_is_not_multi_axis_and_leaves_no_fields)
{
    /* Mouse with X, Y and three buttons. */
    hid_descriptor d = parsed({0x05, 0x01, 0x09, 0x02, 0xa1, 0x01, 0x15, 0x81, 0x25, 0x7f, 0x09, 0x30, 0x09,
                               0x31, 0x75, 0x08, 0x95, 0x02, 0x81, 0x06, 0x05, 0x09, 0x19, 0x01, 0x29, 0x03,
                               0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x03, 0x81, 0x02, 0xc0});
    EXPECT_FALSE(d.multi_axis);
    EXPECT_EQ(d.field_count, 0u);
    EXPECT_FALSE(d.report_ids);
    EXPECT_TRUE(hid_descriptor_has_input(&d, 0));
}

TEST(hid_descriptor, inputs_of_a_mouse_beside_the_multi_axis_collection_are_stepped_over)
{
    bytes mouse = {0x05, 0x01, 0x09, 0x02, 0xa1, 0x01, 0x85, 0x09, 0x09, 0x30, 0x75, 0x08,
                   0x95, 0x01, 0x15, 0x81, 0x25, 0x7f, 0x81, 0x06, 0xc0};
    hid_descriptor d = parsed(mouse + spacemouse_bytes_navigator + mouse);
    EXPECT_TRUE(d.multi_axis);
    EXPECT_EQ(d.field_count, 7u);
    EXPECT_TRUE(hid_descriptor_has_input(&d, 9));
}

TEST(hid_descriptor, empty_is_well_formed_and_nothing)
{
    hid_descriptor d = parsed({});
    EXPECT_FALSE(d.multi_axis);
    EXPECT_EQ(d.field_count, 0u);
}

TEST(hid_descriptor, logical_minimum_is_signed_in_its_own_size)
{
    hid_descriptor d = in_multi_axis({0x15, 0x80, 0x25, 0x7f, 0x09, 0x30, 0x75, 0x08, 0x95, 0x01, 0x81, 0x02});
    EXPECT_EQ(d.fields[0].logical_min, -128);
    EXPECT_EQ(d.fields[0].logical_max, 127);
    d = in_multi_axis({0x17, 0xa2, 0xfe, 0xff, 0xff, 0x27, 0x5e, 0x01, 0x00, 0x00, 0x09, 0x30, 0x75, 0x10, 0x95,
                       0x01, 0x81, 0x02});
    EXPECT_EQ(d.fields[0].logical_min, -350);
    EXPECT_EQ(d.fields[0].logical_max, 350);
}

TEST(hid_descriptor, logical_maximum_is_unsigned_where_the_minimum_is_not_negative)
{
    hid_descriptor d = in_multi_axis({0x15, 0x00, 0x25, 0xff, 0x09, 0x30, 0x75, 0x08, 0x95, 0x01, 0x81, 0x02});
    EXPECT_EQ(d.fields[0].logical_min, 0);
    EXPECT_EQ(d.fields[0].logical_max, 255);
    /* The order of the two items does not matter: 0xff is -1 only beside a negative minimum. */
    expect_refused(open_multi_axis + bytes{0x25, 0xff, 0x15, 0x80, 0x09, 0x30, 0x75, 0x08, 0x95, 0x01, 0x81, 0x02},
                   16, "Logical Maximum above 0");
    d = in_multi_axis({0x15, 0x00, 0x27, 0xff, 0xff, 0xff, 0xff, 0x09, 0x30, 0x75, 0x20, 0x95, 0x01, 0x81, 0x02});
    EXPECT_EQ(d.fields[0].logical_max, INT32_MAX);
}

TEST(hid_descriptor, elements_are_sign_extended_only_below_a_negative_minimum)
{
    hid_descriptor_field field = {};
    field.size_bits = 10;
    field.bit = 3;
    field.count = 2;
    field.logical_min = -512;
    /* Bits 3..12 all ones: -1; bits 13..22: 0x1ff = 511. */
    const uint32_t packed = 0x3ffu << 3 | 0x1ffu << 13;
    spacemouse_bytes_exact payload(bytes{(uint8_t)packed, (uint8_t)(packed >> 8), (uint8_t)(packed >> 16)});
    int64_t value = 0;
    ASSERT_TRUE(hid_descriptor_element(&field, 0, payload.data, payload.size, &value));
    EXPECT_EQ(value, -1);
    ASSERT_TRUE(hid_descriptor_element(&field, 1, payload.data, payload.size, &value));
    EXPECT_EQ(value, 511);
    EXPECT_FALSE(hid_descriptor_element(&field, 1, payload.data, 2, &value));
    EXPECT_TRUE(hid_descriptor_element(&field, 0, payload.data, 2, &value));
    field.logical_min = 0;
    ASSERT_TRUE(hid_descriptor_element(&field, 0, payload.data, payload.size, &value));
    EXPECT_EQ(value, 1023);
}

TEST(hid_descriptor, the_widest_element_may_straddle_five_bytes)
{
    hid_descriptor_field field = {};
    field.size_bits = 32;
    field.bit = 7;
    field.count = 1;
    spacemouse_bytes_exact payload(bytes{0x80, 0xff, 0xff, 0xff, 0x7f});
    int64_t value = 0;
    ASSERT_TRUE(hid_descriptor_element(&field, 0, payload.data, payload.size, &value));
    EXPECT_EQ(value, INT64_C(0xffffffff));
    field.logical_min = -1;
    ASSERT_TRUE(hid_descriptor_element(&field, 0, payload.data, payload.size, &value));
    EXPECT_EQ(value, -1);
    EXPECT_FALSE(hid_descriptor_element(&field, 0, payload.data, 4, &value));
}

TEST(hid_descriptor, push_keeps_all_globals_and_pop_brings_them_back)
{
    /* Report 1, 16 bits, -350..350 pushed; report 2, 8 bits, 0..1 beside it; popped: X is of report 1 again. */
    hid_descriptor d = in_multi_axis({0x85, 0x01, 0x16, 0xa2, 0xfe, 0x26, 0x5e, 0x01, 0x75, 0x10, 0x95, 0x01, 0xa4,
                                      0x85, 0x02, 0x05, 0x09, 0x15, 0x00, 0x25, 0x01, 0x75, 0x08, 0x09, 0x01, 0x81,
                                      0x02, 0xb4, 0x09, 0x30, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 2u);
    EXPECT_EQ(d.fields[0].role, HID_DESCRIPTOR_BUTTON_BITS);
    EXPECT_EQ(d.fields[0].report_id, 2);
    EXPECT_EQ(d.fields[0].size_bits, 8);
    expect_axis(d.fields[1], DEVICE_EVENT_X, 1, 0, false);
}

TEST(hid_descriptor, pop_without_push_and_too_many_pushes_are_refused)
{
    expect_refused({0xa4, 0xb4, 0xb4}, 2, "Push before Pop");
    EXPECT_FALSE(parsed(bytes(HID_DESCRIPTOR_PUSHES_MAX, 0xa4)).multi_axis);
    expect_refused(bytes(HID_DESCRIPTOR_PUSHES_MAX + 1, 0xa4), HID_DESCRIPTOR_PUSHES_MAX, "nested Push");
}

TEST(hid_descriptor, a_truncated_item_is_refused_at_its_head)
{
    expect_refused({0x05}, 0, "data bytes");
    expect_refused({0x05, 0x01, 0x26, 0x5e}, 2, "data bytes");
    expect_refused({0x05, 0x01, 0x27, 0x5e, 0x01, 0x00}, 2, "data bytes");
}

TEST(hid_descriptor, long_items_are_skipped_and_truncated_ones_refused)
{
    /* Size 3, tag 0xf0; the data would end the collection if they were read as items. */
    bytes long_item = {0xfe, 0x03, 0xf0, 0xc0, 0xc0, 0xc0};
    hid_descriptor d = in_multi_axis(long_item + bytes{0x15, 0x80, 0x25, 0x7f, 0x09, 0x35, 0x75, 0x08, 0x95, 0x01,
                                                       0x81, 0x02});
    ASSERT_EQ(d.field_count, 1u);
    EXPECT_EQ(d.fields[0].first, DEVICE_EVENT_RZ);
    expect_refused({0x05, 0x01, 0xfe}, 2, "long item");
    expect_refused({0x05, 0x01, 0xfe, 0x00}, 2, "long item");
    expect_refused({0x05, 0x01, 0xfe, 0x02, 0xf0, 0xc0}, 2, "long item");
    EXPECT_FALSE(parsed({0xfe, 0x00, 0xf0}).multi_axis);
}

TEST(hid_descriptor, a_usage_of_four_bytes_brings_its_own_page)
{
    /* Global page is Button; Usage 0001:0031 is Y all the same. */
    hid_descriptor d = in_multi_axis({0x05, 0x09, 0x15, 0x80, 0x25, 0x7f, 0x75, 0x08, 0x95, 0x01, 0x0b, 0x31, 0x00,
                                      0x01, 0x00, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 1u);
    EXPECT_EQ(d.fields[0].role, HID_DESCRIPTOR_AXIS);
    EXPECT_EQ(d.fields[0].first, DEVICE_EVENT_Y);
    /* The same for the top-level collection. */
    EXPECT_TRUE(parsed({0x05, 0x09, 0x0b, 0x08, 0x00, 0x01, 0x00, 0xa1, 0x01, 0xc0}).multi_axis);
    EXPECT_FALSE(parsed({0x05, 0x01, 0x0b, 0x08, 0x00, 0x09, 0x00, 0xa1, 0x01, 0xc0}).multi_axis);
}

TEST(hid_descriptor, a_short_usage_takes_the_page_in_force_at_its_main_item)
{
    hid_descriptor d = in_multi_axis({0x05, 0x09, 0x09, 0x30, 0x05, 0x01, 0x15, 0x80, 0x25, 0x7f, 0x75, 0x08, 0x95,
                                      0x01, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 1u);
    EXPECT_EQ(d.fields[0].role, HID_DESCRIPTOR_AXIS);
}

TEST(hid_descriptor, a_usage_range_works_for_axes_and_in_either_order)
{
    hid_descriptor d = in_multi_axis({0x16, 0xa2, 0xfe, 0x26, 0x5e, 0x01, 0x29, 0x35, 0x19, 0x30, 0x75, 0x10, 0x95,
                                      0x06, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 6u);
    for (int axis = 0; axis < 6; axis++) {
        expect_axis(d.fields[axis], axis, 0, 16u * axis, false);
    }
    expect_refused(open_multi_axis + bytes{0x19, 0x05, 0x29, 0x04}, 8, "Usage Maximum");
    expect_refused({0x1b, 0x01, 0x00, 0x09, 0x00, 0x2b, 0x02, 0x00, 0x01, 0x00}, 5, "on one page");
    expect_refused({0x07, 0x00, 0x00, 0x01, 0x00}, 0, "Usage Page of at most");
}

TEST(hid_descriptor, several_usage_ranges_follow_one_another)
{
    /* X..X, then Ry..Rz. */
    hid_descriptor d = in_multi_axis({0x15, 0x80, 0x25, 0x7f, 0x75, 0x08, 0x95, 0x03, 0x19, 0x30, 0x29, 0x30, 0x19,
                                      0x34, 0x29, 0x35, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 3u);
    EXPECT_EQ(d.fields[0].first, DEVICE_EVENT_X);
    EXPECT_EQ(d.fields[1].first, DEVICE_EVENT_RY);
    EXPECT_EQ(d.fields[2].first, DEVICE_EVENT_RZ);
}

TEST(hid_descriptor, locals_do_not_outlive_their_main_item)
{
    /* X, then an Input without usages: no second X. */
    hid_descriptor d = in_multi_axis({0x15, 0x80, 0x25, 0x7f, 0x75, 0x08, 0x95, 0x01, 0x09, 0x30, 0x81, 0x02, 0x81,
                                      0x02, 0x09, 0x31, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 2u);
    EXPECT_EQ(d.fields[1].first, DEVICE_EVENT_Y);
    EXPECT_EQ(d.fields[1].bit, 16u);
    /* Nor does half a range: the two halves lie on both sides of an Input. */
    EXPECT_EQ(in_multi_axis({0x15, 0x80, 0x25, 0x7f, 0x75, 0x08, 0x95, 0x01, 0x19, 0x30, 0x81, 0x02, 0x29, 0x30, 0x81,
                             0x02}).field_count, 0u);
}

TEST(hid_descriptor, usages_beyond_the_last_element_are_nothing)
{
    hid_descriptor d = in_multi_axis({0x05, 0x09, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x02, 0x19, 0x01, 0x29,
                                      0x20, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 1u);
    EXPECT_EQ(d.fields[0].count, 2);
}

TEST(hid_descriptor, of_a_delimited_set_the_first_usage_counts)
{
    hid_descriptor d = in_multi_axis({0x15, 0x80, 0x25, 0x7f, 0x75, 0x08, 0x95, 0x02, 0xa9, 0x01, 0x09, 0x32, 0x09,
                                      0x33, 0xa9, 0x00, 0x09, 0x34, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 2u);
    EXPECT_EQ(d.fields[0].first, DEVICE_EVENT_Z);
    EXPECT_EQ(d.fields[1].first, DEVICE_EVENT_RY);
    expect_refused({0xa9, 0x01, 0xa9, 0x01}, 2, "Delimiter");
    expect_refused({0xa9, 0x00}, 0, "Delimiter");
    expect_refused({0xa9, 0x01, 0x09, 0x01, 0xa1, 0x01}, 4, "Delimiter");
}

TEST(hid_descriptor, single_usages_with_gaps_become_runs_of_buttons)
{
    /* Pro family: buttons 1, 2, 3 (usages), a hole, 5, 6: bit number + 1 = usage. */
    hid_descriptor d = in_multi_axis({0x85, 0x03, 0x05, 0x09, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x03,
                                      0x09, 0x01, 0x09, 0x02, 0x09, 0x03, 0x81, 0x02, /* three bits */
                                      0x95, 0x01, 0x81, 0x03,                         /* a hole of one */
                                      0x95, 0x02, 0x09, 0x05, 0x09, 0x06, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 2u);
    EXPECT_EQ(d.fields[0].first, 0);
    EXPECT_EQ(d.fields[0].count, 3);
    EXPECT_EQ(d.fields[1].first, 4);
    EXPECT_EQ(d.fields[1].count, 2);
    EXPECT_EQ(d.fields[1].bit, 4u);
}

TEST(hid_descriptor, buttons_in_number_order_but_apart_are_separate_runs)
{
    /* Button 1 of one bit, button 2 behind a hole, button 3 of eight bits, button 4 at the next bit of report 4. */
    hid_descriptor d = in_multi_axis({0x05, 0x09, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x01, 0x85, 0x03,
                                      0x09, 0x01, 0x81, 0x02,             /* bit 0 */
                                      0x09, 0x09, 0x81, 0x03,             /* a constant, whatever it is called */
                                      0x09, 0x02, 0x81, 0x02,             /* bit 2 */
                                      0x75, 0x08, 0x09, 0x03, 0x81, 0x02, /* bits 3 to 10 */
                                      0x85, 0x04, 0x75, 0x0b, 0x81, 0x03, /* bits 0 to 10 of report 4 */
                                      0x75, 0x08, 0x09, 0x04, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 4u);
    const uint32_t bits[] = {0, 2, 3, 11};
    for (int i = 0; i < 4; i++) {
        EXPECT_EQ(d.fields[i].role, HID_DESCRIPTOR_BUTTON_BITS);
        EXPECT_EQ(d.fields[i].first, i);
        EXPECT_EQ(d.fields[i].count, 1);
        EXPECT_EQ(d.fields[i].bit, bits[i]);
        EXPECT_EQ(d.fields[i].report_id, i < 3 ? 3 : 4);
    }
}

TEST(hid_descriptor, buttons_of_different_width_are_separate_runs)
{
    hid_descriptor d = in_multi_axis({0x05, 0x09, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x01, 0x09, 0x01, 0x81,
                                      0x02, 0x75, 0x07, 0x81, 0x03, 0x75, 0x08, 0x09, 0x02, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 2u);
    EXPECT_EQ(d.fields[0].size_bits, 1);
    EXPECT_EQ(d.fields[1].size_bits, 8);
    EXPECT_EQ(d.fields[1].bit, 8u);
}

TEST(hid_descriptor, button_usage_zero_is_no_button)
{
    hid_descriptor d = in_multi_axis({0x05, 0x09, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x03, 0x19, 0x00, 0x29,
                                      0x02, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 1u);
    EXPECT_EQ(d.fields[0].first, 0);
    EXPECT_EQ(d.fields[0].count, 2);
    EXPECT_EQ(d.fields[0].bit, 1u);
}

TEST(hid_descriptor, elements_beyond_the_last_usage_are_padding)
{
    hid_descriptor d = in_multi_axis({0x05, 0x09, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x08, 0x19, 0x01, 0x29,
                                      0x02, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 1u);
    EXPECT_EQ(d.fields[0].count, 2);
}

TEST(hid_descriptor, a_button_array_becomes_codes)
{
    /* Six 8-bit codes 1..31 standing for buttons 1..31. */
    hid_descriptor d = in_multi_axis({0x85, 0x03, 0x05, 0x09, 0x15, 0x01, 0x25, 0x1f, 0x19, 0x01, 0x29, 0x1f, 0x75,
                                      0x08, 0x95, 0x06, 0x81, 0x00});
    ASSERT_EQ(d.field_count, 1u);
    EXPECT_EQ(d.fields[0].role, HID_DESCRIPTOR_BUTTON_CODES);
    EXPECT_EQ(d.fields[0].count, 6);
    EXPECT_EQ(d.fields[0].first, 1);
    EXPECT_EQ(d.fields[0].logical_min, 1);
    EXPECT_EQ(d.fields[0].logical_max, 31);
}

TEST(hid_descriptor, an_array_of_other_things_or_with_gaps_is_left_out)
{
    bytes keyboard = {0x05, 0x07, 0x15, 0x00, 0x25, 0x65, 0x19, 0x00, 0x29, 0x65, 0x75, 0x08, 0x95, 0x06, 0x81, 0x00};
    bytes gaps = {0x05, 0x09, 0x15, 0x01, 0x25, 0x02, 0x09, 0x01, 0x09, 0x03, 0x75, 0x08, 0x95, 0x06, 0x81, 0x00};
    EXPECT_EQ(in_multi_axis(keyboard).field_count, 0u);
    bytes no_codes = {0x05, 0x09, 0x15, 0x03, 0x25, 0x02, 0x19, 0x01, 0x29, 0x02, 0x75, 0x08, 0x95, 0x06, 0x81, 0x00};
    EXPECT_EQ(in_multi_axis(gaps).field_count, 0u);
    EXPECT_EQ(in_multi_axis(no_codes).field_count, 0u);
}

TEST(hid_descriptor, reports_1c_and_1d_of_16_bit_elements_are_codes_however_declared)
{
    for (uint8_t id : {0x1c, 0x1d}) {
        for (uint8_t flags : {0x00, 0x02}) { /* array, variable */
            bytes vendor = {0x85, id,   0x06, 0x00, 0xff, 0x15, 0x00, 0x27, 0xff, 0xff, 0x00,
                            0x00, 0x09, 0x01, 0x75, 0x10, 0x95, 0x06, 0x81, flags};
            hid_descriptor d = in_multi_axis(vendor);
            ASSERT_EQ(d.field_count, 1u);
            EXPECT_EQ(d.fields[0].role, HID_DESCRIPTOR_BUTTON_CODES);
            EXPECT_EQ(d.fields[0].count, 6);
            EXPECT_EQ(d.fields[0].first, 1);
            EXPECT_EQ(d.fields[0].logical_min, 1);
            EXPECT_EQ(d.fields[0].logical_max, 65535);
        }
    }
    /* Elsewhere a vendor array is nothing of ours. */
    EXPECT_EQ(in_multi_axis({0x85, 0x1b, 0x06, 0x00, 0xff, 0x15, 0x00, 0x27, 0xff, 0xff, 0x00, 0x00, 0x09, 0x01,
                             0x75, 0x10, 0x95, 0x06, 0x81, 0x00}).field_count, 0u);
    /* Nor is one of 8-bit elements here, and an axis stays an axis. */
    EXPECT_EQ(in_multi_axis({0x85, 0x1c, 0x06, 0x00, 0xff, 0x15, 0x00, 0x25, 0x7f, 0x09, 0x01, 0x75, 0x08, 0x95, 0x06,
                             0x81, 0x00}).field_count, 0u);
    hid_descriptor d = in_multi_axis({0x85, 0x1c, 0x16, 0xa2, 0xfe, 0x26, 0x5e, 0x01, 0x09, 0x30, 0x75, 0x10, 0x95,
                                      0x01, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 1u);
    expect_axis(d.fields[0], DEVICE_EVENT_X, 0x1c, 0, false);
}

TEST(hid_descriptor, bits_are_counted_per_report_id_through_constants_and_foreign_fields)
{
    /* Report 1: 3 constant bits, 5 vendor bits, X. Report 2 between them. */
    hid_descriptor d = in_multi_axis({0x15, 0x80, 0x25, 0x7f, 0x85, 0x01, 0x75, 0x03, 0x95, 0x01, 0x81, 0x01,
                                      0x85, 0x02, 0x75, 0x08, 0x09, 0x33, 0x81, 0x02,
                                      0x85, 0x01, 0x06, 0x00, 0xff, 0x75, 0x05, 0x09, 0x01, 0x81, 0x02,
                                      0x05, 0x01, 0x75, 0x08, 0x09, 0x30, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 2u);
    EXPECT_EQ(d.fields[0].bit, 0u);
    EXPECT_EQ(d.fields[0].report_id, 2);
    EXPECT_EQ(d.fields[1].bit, 8u);
    EXPECT_EQ(d.fields[1].report_id, 1);
    EXPECT_EQ(d.input_bytes_max, 3u);
}

TEST(hid_descriptor, output_and_feature_items_take_no_input_bits)
{
    hid_descriptor d = in_multi_axis({0x15, 0x80, 0x25, 0x7f, 0x75, 0x08, 0x95, 0x01, 0x09, 0x30, 0x91, 0x02, 0x09,
                                      0x30, 0xb1, 0x02, 0x09, 0x31, 0x81, 0x02});
    ASSERT_EQ(d.field_count, 1u);
    EXPECT_EQ(d.fields[0].first, DEVICE_EVENT_Y);
    EXPECT_EQ(d.fields[0].bit, 0u);
}

TEST(hid_descriptor, report_id_rules)
{
    expect_refused({0x85, 0x00}, 0, "Report ID from 1");
    expect_refused({0x86, 0x00, 0x01}, 0, "Report ID from 1");
    /* An input before the first id would have no id to be told by. */
    expect_refused({0x75, 0x08, 0x95, 0x01, 0x81, 0x02, 0x85, 0x01}, 6, "Report ID before the first Input");
    expect_refused({0x75, 0x08, 0x95, 0x01, 0xa4, 0x85, 0x01, 0xb4, 0x81, 0x02}, 8, "Report ID before the first Input");
}

TEST(hid_descriptor, collections_must_balance)
{
    expect_refused({0x05, 0x01, 0xc0}, 2, "Collection before End Collection");
    expect_refused(open_multi_axis, open_multi_axis.size(), "End Collection");
    bytes deep;
    for (int i = 0; i < HID_DESCRIPTOR_COLLECTIONS_MAX; i++) {
        deep = deep + bytes{0xa1, 0x00};
    }
    EXPECT_FALSE(parsed(deep + bytes(HID_DESCRIPTOR_COLLECTIONS_MAX, 0xc0)).multi_axis);
    expect_refused(deep + bytes{0xa1, 0x00}, 2 * HID_DESCRIPTOR_COLLECTIONS_MAX, "nested collections");
}

TEST(hid_descriptor, only_a_top_level_application_collection_makes_it_multi_axis)
{
    EXPECT_FALSE(parsed({0x05, 0x01, 0x09, 0x08, 0xa1, 0x00, 0xc0}).multi_axis);
    EXPECT_FALSE(parsed({0x05, 0x01, 0x09, 0x02, 0xa1, 0x01, 0x09, 0x08, 0xa1, 0x01, 0xc0, 0xc0}).multi_axis);
    EXPECT_FALSE(parsed({0x05, 0x01, 0xa1, 0x01, 0xc0}).multi_axis);
    EXPECT_FALSE(parsed({0x05, 0x01, 0x09, 0x08, 0xa1, 0x00, 0xc0, 0xa1, 0x01, 0xc0}).multi_axis);
    EXPECT_TRUE(parsed({0x05, 0x01, 0x09, 0x08, 0xa1, 0x01, 0xc0}).multi_axis);
}

TEST(hid_descriptor, the_collection_ends_where_it_ends)
{
    bytes x = {0x15, 0x80, 0x25, 0x7f, 0x75, 0x08, 0x95, 0x01, 0x09, 0x30, 0x81, 0x02};
    EXPECT_EQ(parsed(open_multi_axis + close_collection + x).field_count, 0u);
    EXPECT_EQ(parsed(open_multi_axis + close_collection + bytes{0xa1, 0x00} + x + close_collection).field_count, 0u);
    EXPECT_EQ(in_multi_axis(bytes{0xa1, 0x00, 0xc0} + x).field_count, 1u);
}

TEST(hid_descriptor, monstrous_sizes_and_counts_are_refused)
{
    expect_refused({0x77, 0xff, 0xff, 0xff, 0xff, 0x97, 0xff, 0xff, 0xff, 0xff, 0x81, 0x02}, 10, "4096 bytes");
    /* Exactly at the limit, then one bit more in the same report. */
    bytes full = {0x75, 0x01, 0x96, 0x00, 0x80, 0x81, 0x01};
    EXPECT_EQ(parsed(full).input_bytes_max, 4096u);
    expect_refused(full + bytes{0x95, 0x01, 0x81, 0x01}, 9, "4096 bytes");
}

TEST(hid_descriptor, an_axis_wider_than_32_bits_is_left_out)
{
    EXPECT_EQ(in_multi_axis({0x15, 0x80, 0x25, 0x7f, 0x75, 0x21, 0x95, 0x01, 0x09, 0x30, 0x81, 0x02}).field_count, 0u);
    EXPECT_EQ(in_multi_axis({0x15, 0x80, 0x25, 0x7f, 0x75, 0x20, 0x95, 0x01, 0x09, 0x30, 0x81, 0x02}).field_count, 1u);
}

TEST(hid_descriptor, an_axis_without_a_range_is_refused)
{
    expect_refused(open_multi_axis + bytes{0x75, 0x10, 0x95, 0x01, 0x09, 0x30, 0x81, 0x02}, 12, "Logical Maximum");
    expect_refused(open_multi_axis + bytes{0x15, 0x05, 0x25, 0x05, 0x75, 0x10, 0x95, 0x01, 0x09, 0x30, 0x81, 0x02}, 16,
                   "Logical Maximum");
}

TEST(hid_descriptor, too_many_fields_or_usages_are_refused)
{
    /* Every second usage, so that no two buttons form a run. */
    bytes scattered = {0x05, 0x09, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x41};
    for (int i = 0; i < HID_DESCRIPTOR_FIELDS_MAX; i++) {
        scattered = scattered + bytes{0x09, (uint8_t)(1 + 2 * i)};
    }
    EXPECT_EQ(in_multi_axis(scattered + bytes{0x81, 0x02}).field_count, (uint32_t)HID_DESCRIPTOR_FIELDS_MAX);
    bytes one_more = scattered + bytes{0x09, 0xf0, 0x81, 0x02};
    expect_refused(open_multi_axis + one_more, open_multi_axis.size() + one_more.size() - 2, "at most 64 fields");
    bytes usages;
    for (int i = 0; i <= HID_DESCRIPTOR_USAGES_MAX; i++) {
        usages = usages + bytes{0x09, 0x01};
    }
    expect_refused(usages, 2 * HID_DESCRIPTOR_USAGES_MAX, "usages");
}

TEST(hid_descriptor, reserved_items_and_trailing_zeros_are_ignored)
{
    bytes padded = spacemouse_bytes_navigator + bytes{0x00, 0x00, 0x0c, 0xf4};
    EXPECT_EQ(parsed(padded).field_count, 7u);
}

TEST(hid_descriptor, no_prefix_and_no_changed_byte_of_a_real_descriptor_does_harm)
{
    for (const bytes &whole : {spacemouse_bytes_navigator, spacemouse_bytes_wireless}) {
        hid_descriptor d;
        hid_descriptor_error error;
        for (size_t size = 0; size < whole.size(); size++) {
            spacemouse_bytes_exact cut(whole.data(), size);
            /* Only the whole thing closes its collections. */
            bool good = hid_descriptor_parse(cut.data, cut.size, &d, &error);
            EXPECT_EQ(good, size == 0 || size == 2 || size == 4) << size;
            EXPECT_LE(error.offset, size);
        }
        for (size_t at = 0; at < whole.size(); at++) {
            for (int value = 0; value < 256; value++) {
                spacemouse_bytes_exact changed(whole);
                changed.data[at] = (uint8_t)value;
                if (!hid_descriptor_parse(changed.data, changed.size, &d, &error)) {
                    EXPECT_STRNE(error.expected, "");
                    EXPECT_LE(error.offset, changed.size);
                }
                EXPECT_LE(d.field_count, (uint32_t)HID_DESCRIPTOR_FIELDS_MAX);
            }
        }
    }
}
