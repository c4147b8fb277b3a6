/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal    Recordings in hid-recorder's format are read whole or refused at the right line, and play into device events.
 * Method  Small texts, each next to what must come of it; an exact-size copy of each, so that reading past its end
 *         traps. The shipped recordings are tested in recordings_test.cpp.
 */
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "platform/device_event.h"
#include "platform/spacemouse/hid_recording.h"
#include "tests/unit/spacemouse/spacemouse_bytes.h"

namespace {

std::string length_and_hex(const std::vector<uint8_t> &bytes)
{
    std::string out = std::to_string(bytes.size());
    for (uint8_t byte : bytes) {
        char text[8];
        std::snprintf(text, sizeof text, " %02x", byte);
        out += text;
    }
    return out;
}

const std::string navigator_header = "R: " + length_and_hex(spacemouse_bytes_navigator) + "\n" +
                                     "N: 3Dconnexion SpaceNavigator\nP: usb-1/input0\nI: 3 046d c626\n";
const std::string wireless_header = "R: " + length_and_hex(spacemouse_bytes_wireless) + "\n" +
                                    "N: 3Dconnexion SpaceMouse Wireless\nI: 3 256f c62e\n";
const std::string mouse_header = "R: 21 05 01 09 02 a1 01 85 01 15 81 25 7f 09 30 75 08 95 01 81 06 c0\nN: mouse\n";

class loaded {
public:
    explicit loaded(const std::string &text)
    {
        spacemouse_bytes_exact copy(text.data(), text.size());
        good = hid_recording_init(&recording, reinterpret_cast<const char *>(copy.data), copy.size, &error);
    }
    ~loaded() { hid_recording_finish(&recording); }
    loaded(const loaded &) = delete;
    loaded &operator=(const loaded &) = delete;

    hid_recording recording;
    hid_recording_error error;
    bool good;
};

void expect_refused(const std::string &text, size_t line, const std::string &expected)
{
    loaded l(text);
    ASSERT_FALSE(l.good) << text;
    EXPECT_EQ(l.error.line, line) << text;
    EXPECT_NE(std::string(l.error.expected).find(expected), std::string::npos) << l.error.expected;
    EXPECT_EQ(l.recording.event_count, 0u);
    EXPECT_EQ(l.recording.events, nullptr);
    EXPECT_EQ(l.recording.device_count, 0u);
}

} // namespace

TEST(hid_recording, reads_device_and_events)
{
    loaded l("# a comment: E: 1\n" + navigator_header +
             "E: 000000.000001 7 01 0a 00 ec ff 5e 01\nE: 12.345678 3 03 01 00\n");
    ASSERT_TRUE(l.good) << l.error.line << " " << l.error.expected;
    ASSERT_EQ(l.recording.device_count, 1u);
    const hid_recording_device &device = l.recording.devices[0];
    EXPECT_EQ(device.index, 0u);
    EXPECT_STREQ(device.name, "3Dconnexion SpaceNavigator");
    EXPECT_EQ(device.bus, 3);
    EXPECT_EQ(device.vendor, 0x046d);
    EXPECT_EQ(device.product, 0xc626);
    EXPECT_EQ(device.descriptor_line, 2u);
    EXPECT_EQ(std::vector<uint8_t>(device.descriptor, device.descriptor + device.descriptor_size),
              spacemouse_bytes_navigator);
    ASSERT_EQ(l.recording.event_count, 2u);
    EXPECT_EQ(l.recording.events[0].time_us, 1);
    EXPECT_EQ(l.recording.events[1].time_us, 12345678);
    const hid_recording_event &event = l.recording.events[0];
    EXPECT_EQ(std::vector<uint8_t>(event.bytes, event.bytes + event.size),
              (std::vector<uint8_t>{0x01, 0x0a, 0x00, 0xec, 0xff, 0x5e, 0x01}));
    EXPECT_EQ(l.recording.events[1].size, 3u);
}

TEST(hid_recording, blanks_crlf_capitals_and_a_missing_last_newline_do_not_matter)
{
    loaded l("\r\n\t  \nR: 2 05 01\r\n  N:  two words \r\nI:3 46D C626\nE:\t0.000000\t2  A 0B  \r\nE: 0.000000 0");
    ASSERT_TRUE(l.good) << l.error.line << " " << l.error.expected;
    EXPECT_STREQ(l.recording.devices[0].name, "two words");
    EXPECT_EQ(l.recording.devices[0].vendor, 0x046d);
    ASSERT_EQ(l.recording.event_count, 2u);
    EXPECT_EQ(l.recording.events[0].bytes[0], 0x0a);
    EXPECT_EQ(l.recording.events[0].bytes[1], 0x0b);
    EXPECT_EQ(l.recording.events[1].size, 0u);
}

TEST(hid_recording, name_and_ids_may_be_missing)
{
    loaded l("R: 2 05 01\n");
    ASSERT_TRUE(l.good);
    EXPECT_STREQ(l.recording.devices[0].name, "");
    EXPECT_EQ(l.recording.devices[0].vendor, 0);
    EXPECT_EQ(l.recording.event_count, 0u);
}

TEST(hid_recording, keeps_nothing_of_the_text)
{
    std::string text = "R: 2 05 01\nN: name\nE: 0.000000 1 7f\n";
    hid_recording recording;
    hid_recording_error error;
    ASSERT_TRUE(hid_recording_init(&recording, text.data(), text.size(), &error));
    text.assign(text.size(), '#');
    EXPECT_STREQ(recording.devices[0].name, "name");
    EXPECT_EQ(recording.devices[0].descriptor[0], 0x05);
    EXPECT_EQ(recording.events[0].bytes[0], 0x7f);
    hid_recording_finish(&recording);
    hid_recording_finish(&recording);
}

TEST(hid_recording, several_devices_are_told_apart_by_their_index)
{
    loaded l("D: 4\n" + navigator_header + "D: 2\n" + wireless_header +
             "D: 4\nE: 0.000000 3 03 01 00\nD: 2\nE: 0.000001 3 03 02 00\nE: 0.000002 3 03 00 00\n"
             "D: 4\nE: 0.000003 3 03 00 00\n");
    ASSERT_TRUE(l.good) << l.error.line << " " << l.error.expected;
    ASSERT_EQ(l.recording.device_count, 2u);
    EXPECT_EQ(l.recording.devices[0].index, 4u);
    EXPECT_EQ(l.recording.devices[1].index, 2u);
    EXPECT_STREQ(l.recording.devices[1].name, "3Dconnexion SpaceMouse Wireless");
    ASSERT_EQ(l.recording.event_count, 4u);
    const uint32_t places[] = {0, 1, 1, 0};
    for (int i = 0; i < 4; i++) {
        EXPECT_EQ(l.recording.events[i].device, places[i]);
    }
}

TEST(hid_recording, the_device_limit_is_sixteen)
{
    std::string text;
    for (int i = 0; i < HID_RECORDING_DEVICES_MAX; i++) {
        text += "D: " + std::to_string(i) + "\nR: 0\n";
    }
    EXPECT_TRUE(loaded(text).good);
    expect_refused(text + "D: 9999\nR: 0\n", 34, "16 devices");
    expect_refused("D: 10000\n", 1, "device index");
}

TEST(hid_recording, lines_of_unknown_kinds_are_counted_and_skipped)
{
    loaded l("B: 1 2\nR: 2 05 01\nL: anything at all\n");
    ASSERT_TRUE(l.good);
    EXPECT_EQ(l.recording.lines_unknown, 2u);
}

TEST(hid_recording, a_name_is_kept_as_utf8)
{
    loaded l("R: 0\nN: Souris \xc3\xa9l\xc3\xa9gante\n");
    ASSERT_TRUE(l.good);
    EXPECT_STREQ(l.recording.devices[0].name, "Souris \xc3\xa9l\xc3\xa9gante");
}

TEST(hid_recording, refuses_with_the_line_and_what_was_expected)
{
    expect_refused("", 0, "R:");
    expect_refused("# nothing\n", 1, "R:");
    expect_refused("# one\nrubbish\n", 2, "a line beginning with");
    expect_refused("R 2 05 01\n", 1, "a line beginning with");
    expect_refused("r: 2 05 01\n", 1, "a line beginning with");
    expect_refused("RR: 2 05 01\n", 1, "a line beginning with");
    expect_refused("R: 0\nE\n", 2, "a line beginning with");
    expect_refused("D: x\n", 1, "device index");
    expect_refused("D: 1 2\n", 1, "device index");
    expect_refused("D: -1\n", 1, "device index");
    expect_refused("D:\n", 1, "device index");
}

TEST(hid_recording, refuses_wrong_bytes)
{
    expect_refused("R:\n", 1, "byte count");
    expect_refused("R: x 05\n", 1, "byte count");
    expect_refused("R: 4097 05\n", 1, "byte count");
    expect_refused("R: 99999999999999999999999 05\n", 1, "byte count");
    expect_refused("R: 2 05\n", 1, "has fewer");
    expect_refused("R: 1 05 01\n", 1, "has more");
    expect_refused("R: 2 05 0g\n", 1, "hexadecimal");
    expect_refused("R: 2 05 001\n", 1, "hexadecimal");
    expect_refused("R: 2 0501\n", 1, "hexadecimal");
    expect_refused("R: 1 -1\n", 1, "hexadecimal");
    expect_refused("R: 0\n\n\nE: 0.000000 2 01\n", 4, "has fewer");
}

TEST(hid_recording, refuses_wrong_names_and_ids)
{
    expect_refused("R: 0\nN: a\x01z\n", 2, "control");
    expect_refused(std::string("R: 0\nN: a\0z\n", 12), 2, "control");
    expect_refused("R: 0\nI: 3 046d\n", 2, "bus, vendor, product");
    expect_refused("R: 0\nI: 3 046d c626 1\n", 2, "bus, vendor, product");
    expect_refused("R: 0\nI: 3 1046d c626\n", 2, "bus, vendor, product");
    expect_refused("R: 0\nI: usb 046d c626\n", 2, "bus, vendor, product");
    expect_refused("R: 0\nR: 0\n", 2, "one R:");
    expect_refused("N: a\nN: b\n", 2, "one N:");
    expect_refused("I: 1 2 3\nI: 1 2 3\n", 2, "one I:");
}

TEST(hid_recording, refuses_events_before_or_without_a_descriptor)
{
    expect_refused("E: 0.000000 1 00\nR: 0\n", 1, "before its first E:");
    expect_refused("D: 0\nR: 0\nD: 1\nE: 0.000000 1 00\n", 4, "before its first E:");
    expect_refused("R: 0\nD: 1\n\nN: nobody\nD: 0\nE: 0.000000 0\n", 4, "R: for the device first named here");
}

TEST(hid_recording, refuses_wrong_times)
{
    for (const char *time : {"x", "1", "1.", "1.5", "1.0000000", "1.00000x", ".000000", "-1.000000", "1,000000",
                             "10000000000.000000", "1.00000 0"}) {
        expect_refused("R: 0\nE: " + std::string(time) + " 1 00\n", 2, "six digits");
    }
    EXPECT_TRUE(loaded("R: 0\nE: 9999999999.999999 1 00\n").good);
}

TEST(hid_recording, times_must_not_go_backwards)
{
    EXPECT_TRUE(loaded("R: 0\nE: 1.000000 1 00\nE: 1.000000 1 00\n").good);
    expect_refused("R: 0\nE: 1.000000 1 00\n#\nE: 0.999999 1 00\n", 4, "not before the last");
    /* Nor between devices: one clock. */
    expect_refused("D: 0\nR: 0\nD: 1\nR: 0\nE: 2.000000 0\nD: 0\nE: 1.000000 0\n", 7, "not before the last");
}

TEST(hid_recording, the_longest_report_fits)
{
    std::string text = "R: 0\nE: 0.000000 4096";
    for (int i = 0; i < HID_RECORDING_BYTES_MAX; i++) {
        text += " f";
    }
    loaded l(text);
    ASSERT_TRUE(l.good);
    EXPECT_EQ(l.recording.events[0].size, 4096u);
    EXPECT_EQ(l.recording.events[0].bytes[4095], 0x0f);
}

TEST(hid_recording, many_events_grow_the_list)
{
    std::string text = "R: 0\n";
    for (int i = 0; i < 1000; i++) {
        text += "E: " + std::to_string(i) + ".000000 1 " + (i % 2 == 0 ? "00" : "01") + "\n";
    }
    loaded l(text);
    ASSERT_TRUE(l.good);
    ASSERT_EQ(l.recording.event_count, 1000u);
    for (int i = 0; i < 1000; i++) {
        EXPECT_EQ(l.recording.events[i].time_us, i * INT64_C(1000000));
        EXPECT_EQ(l.recording.events[i].bytes[0], i % 2);
    }
}

TEST(hid_recording_decode, plays_two_devices_and_skips_a_mouse)
{
    loaded l("D: 0\n" + navigator_header + "D: 1\n" + mouse_header + "D: 2\n" + wireless_header +
             "D: 0\nE: 0.000000 7 01 0a 00 ec ff 5e 01\n"
             "D: 1\nE: 0.000010 2 01 05\nE: 0.000010 2 09 05\n"
             "D: 2\nE: 0.000020 13 01 01 00 02 00 03 00 04 00 05 00 06 00\nE: 0.000030 3 17 32 00\n"
             "D: 0\nE: 0.000040 7 02 01 00 00 00 00 00\nE: 0.000050 3 03 02 00\n"
             "E: 0.000060 2 63 00\nE: 0.000070 1 01\n");
    ASSERT_TRUE(l.good) << l.error.line << " " << l.error.expected;
    hid_recording_decoded decoded;
    hid_recording_error error;
    ASSERT_TRUE(hid_recording_decode(&l.recording, &decoded, &error)) << error.expected;
    EXPECT_FALSE(decoded.skipped[0]);
    EXPECT_TRUE(decoded.skipped[1]);
    EXPECT_FALSE(decoded.skipped[2]);
    EXPECT_EQ(decoded.reports_unknown, 1u);
    EXPECT_EQ(decoded.reports_short, 1u);
    ASSERT_EQ(decoded.event_count, 5u);
    const device_event *e = decoded.events;
    const int64_t times[] = {0, 20, 30, 40, 50};
    const uint32_t devices[] = {0, 2, 2, 0, 0};
    const device_event_kind kinds[] = {DEVICE_EVENT_AXES, DEVICE_EVENT_AXES, DEVICE_EVENT_BATTERY, DEVICE_EVENT_AXES,
                                       DEVICE_EVENT_BUTTON};
    for (int i = 0; i < 5; i++) {
        EXPECT_EQ(e[i].time_us, times[i]) << i;
        EXPECT_EQ(e[i].device, devices[i]) << i;
        EXPECT_EQ(e[i].kind, kinds[i]) << i;
    }
    EXPECT_EQ(e[3].axes[DEVICE_EVENT_X], 10); /* not disturbed by the other device's 1 */
    EXPECT_EQ(e[3].axes[DEVICE_EVENT_RX], 1);
    EXPECT_EQ(e[1].axes[DEVICE_EVENT_RX], 4);
    EXPECT_EQ(e[2].battery_percent, 50);
    EXPECT_EQ(e[4].number, 1);
    EXPECT_TRUE(e[4].down);
    hid_recording_decoded_finish(&decoded);
    hid_recording_decoded_finish(&decoded);
}

TEST(hid_recording_decode, a_malformed_descriptor_is_refused_with_its_line_and_offset)
{
    loaded l("D: 0\n" + navigator_header + "D: 1\n# the other\nR: 4 05 01 09 08\nD: 2\nR: 3 05 01 26\n");
    ASSERT_TRUE(l.good);
    hid_recording_decoded decoded;
    hid_recording_error error;
    ASSERT_FALSE(hid_recording_decode(&l.recording, &decoded, &error));
    EXPECT_EQ(error.line, 10u);
    EXPECT_EQ(error.offset, 2u);
    EXPECT_NE(std::string(error.expected).find("data bytes"), std::string::npos);
    EXPECT_EQ(decoded.events, nullptr);
    EXPECT_EQ(decoded.event_count, 0u);
    EXPECT_FALSE(decoded.skipped[1]); /* empty again, though that one was already found not multi-axis */
}

TEST(hid_recording_decode, a_recording_without_events_decodes_to_none)
{
    loaded l(navigator_header);
    hid_recording_decoded decoded;
    hid_recording_error error;
    ASSERT_TRUE(hid_recording_decode(&l.recording, &decoded, &error));
    EXPECT_EQ(decoded.event_count, 0u);
    hid_recording_decoded_finish(&decoded);
}

TEST(hid_recording_decode, one_report_may_change_many_buttons)
{
    /* 200 buttons down at once, then up, many times over: the list grows by more than it doubles. */
    std::string text = "R: 24 05 01 09 08 a1 01 05 09 15 00 25 01 75 01 96 c8 00 19 01 29 c8 81 02 c0\n";
    for (int i = 0; i < 10; i++) {
        text += "E: 0.000000 25";
        for (int byte = 0; byte < 25; byte++) {
            text += i % 2 == 0 ? " ff" : " 00";
        }
        text += "\n";
    }
    loaded l(text);
    ASSERT_TRUE(l.good) << l.error.line << " " << l.error.expected;
    hid_recording_decoded decoded;
    hid_recording_error error;
    ASSERT_TRUE(hid_recording_decode(&l.recording, &decoded, &error)) << error.offset << error.expected;
    ASSERT_EQ(decoded.event_count, 2000u);
    for (int i = 0; i < 2000; i++) {
        EXPECT_EQ(decoded.events[i].number, i % 200);
        EXPECT_EQ(decoded.events[i].down, i / 200 % 2 == 0);
    }
    hid_recording_decoded_finish(&decoded);
}
