/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal    The recordings that stations and demos are tested with say what their comments claim, in the manner of their
 *         devices, so that a failure downstream is not the recording's.
 * Method  Read tests/golden/recordings/ from the source tree, decode, and check the stated facts: pace, halves, rest,
 *         button 0 around most of the motion, a sweep to +x, turns of a circle.
 */
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "platform/device_event.h"
#include "platform/spacemouse/hid_recording.h"
#include "tests/unit/spacemouse/spacemouse_bytes.h"

namespace {

constexpr size_t file_bytes_max = 200000;

class shipped {
public:
    explicit shipped(const std::string &name)
    {
        std::ifstream file(std::string(SOURCE_ROOT) + "/tests/golden/recordings/" + name, std::ios::binary);
        std::ostringstream text;
        text << file.rdbuf();
        size = text.str().size();
        hid_recording_error error;
        good = hid_recording_init(&recording, text.str().data(), size, &error) &&
               hid_recording_decode(&recording, &decoded, &error);
        EXPECT_TRUE(good) << name << ":" << error.line << ": expected " << error.expected;
    }
    ~shipped()
    {
        if (good) {
            hid_recording_decoded_finish(&decoded);
        }
        hid_recording_finish(&recording);
    }
    shipped(const shipped &) = delete;
    shipped &operator=(const shipped &) = delete;

    size_t size = 0;
    hid_recording recording;
    hid_recording_decoded decoded;
    bool good;
};

struct press {
    int64_t down_us = -1, up_us = -1;
};

/* Button 0 must go down once and up once; no other button moves. */
press only_press(const shipped &s)
{
    press p;
    for (size_t i = 0; i < s.decoded.event_count; i++) {
        const device_event &event = s.decoded.events[i];
        if (event.kind != DEVICE_EVENT_BUTTON) {
            continue;
        }
        EXPECT_EQ(event.number, 0);
        int64_t &time = event.down ? p.down_us : p.up_us;
        EXPECT_EQ(time, -1) << "button 0 moves once more";
        time = event.time_us;
    }
    EXPECT_GE(p.down_us, 0);
    EXPECT_GT(p.up_us, p.down_us);
    return p;
}

/* Displacement integrated over the time between axis events, one axis, while the button is held. */
double travel(const shipped &s, press p, int axis)
{
    double sum = 0, last_s = (double)p.down_us * 1e-6, value = 0;
    for (size_t i = 0; i < s.decoded.event_count; i++) {
        const device_event &event = s.decoded.events[i];
        if (event.kind != DEVICE_EVENT_AXES || event.time_us < p.down_us || event.time_us > p.up_us) {
            continue;
        }
        double now_s = (double)event.time_us * 1e-6;
        sum += value * (now_s - last_s);
        last_s = now_s;
        value = event.axes[axis];
    }
    return sum;
}

/* Full turns that the displacement in the x-z plane makes while the button is held and the push is firm. */
double turns(const shipped &s, press p)
{
    double angle = 0, last = 0;
    bool begun = false;
    for (size_t i = 0; i < s.decoded.event_count; i++) {
        const device_event &event = s.decoded.events[i];
        double x = event.axes[DEVICE_EVENT_X], z = event.axes[DEVICE_EVENT_Z];
        if (event.kind != DEVICE_EVENT_AXES || event.time_us < p.down_us || event.time_us > p.up_us ||
            std::hypot(x, z) < 40) {
            continue;
        }
        double now = std::atan2(-z, x);
        angle += begun ? std::remainder(now - last, 2 * M_PI) : 0;
        last = now;
        begun = true;
    }
    return angle / (2 * M_PI);
}

void expect_ends_at_rest(const shipped &s)
{
    const device_event *last = nullptr;
    for (size_t i = 0; i < s.decoded.event_count; i++) {
        if (s.decoded.events[i].kind == DEVICE_EVENT_AXES) {
            last = &s.decoded.events[i];
        }
    }
    ASSERT_NE(last, nullptr);
    for (int axis = 0; axis < DEVICE_EVENT_AXIS_COUNT; axis++) {
        EXPECT_EQ(last->axes[axis], 0);
    }
}

void expect_moderate_and_smooth(const shipped &s)
{
    const device_event *last = nullptr;
    for (size_t i = 0; i < s.decoded.event_count; i++) {
        const device_event &event = s.decoded.events[i];
        if (event.kind != DEVICE_EVENT_AXES) {
            continue;
        }
        for (int axis = 0; axis < DEVICE_EVENT_AXIS_COUNT; axis++) {
            EXPECT_LE(std::abs(event.axes[axis]), event.axis_max[axis]);
            if (last != nullptr) {
                EXPECT_LE(std::abs(event.axes[axis] - last->axes[axis]), 40) << "at " << event.time_us;
            }
        }
        last = &event;
    }
}

} // namespace

TEST(recordings, navigator_is_a_navigator)
{
    shipped s("spacenavigator.hid");
    ASSERT_TRUE(s.good);
    EXPECT_LT(s.size, file_bytes_max);
    ASSERT_EQ(s.recording.device_count, 1u);
    const hid_recording_device &device = s.recording.devices[0];
    EXPECT_EQ(device.vendor, 0x046d);
    EXPECT_EQ(device.product, 0xc626);
    EXPECT_EQ(std::vector<uint8_t>(device.descriptor, device.descriptor + device.descriptor_size),
              spacemouse_bytes_navigator);
    EXPECT_FALSE(s.decoded.skipped[0]);
    EXPECT_EQ(s.decoded.reports_unknown, 0u);
    EXPECT_EQ(s.decoded.reports_short, 0u);
    EXPECT_EQ(s.recording.lines_unknown, 0u);
}

TEST(recordings, navigator_sends_translation_then_rotation_8_ms_later)
{
    shipped s("spacenavigator.hid");
    ASSERT_TRUE(s.good);
    uint8_t last = 2;
    int64_t last_us = 0;
    for (size_t i = 0; i < s.recording.event_count; i++) {
        const hid_recording_event &event = s.recording.events[i];
        if (event.bytes[0] == 3) {
            EXPECT_EQ(event.size, 3u);
            continue;
        }
        EXPECT_EQ(event.size, 7u);
        EXPECT_EQ(event.bytes[0], 3 - last);
        if (event.bytes[0] == 2) {
            EXPECT_NEAR((double)(event.time_us - last_us), 8000.0, 500.0);
        }
        last = event.bytes[0];
        last_us = event.time_us;
    }
    EXPECT_EQ(last, 2);
}

TEST(recordings, navigator_falls_silent_after_three_rounds_of_zeros)
{
    shipped s("spacenavigator.hid");
    ASSERT_TRUE(s.good);
    int zeros = 0, silences = 0;
    int64_t last_us = 0;
    for (size_t i = 0; i < s.recording.event_count; i++) {
        const hid_recording_event &event = s.recording.events[i];
        if (event.bytes[0] == 3) {
            continue;
        }
        if (event.time_us - last_us > 50000) {
            EXPECT_GE(zeros, 6) << "silence before " << event.time_us;
            silences++;
        }
        bool zero = true;
        for (uint32_t byte = 1; byte < event.size; byte++) {
            zero = zero && event.bytes[byte] == 0;
        }
        zeros = zero ? zeros + 1 : 0;
        last_us = event.time_us;
    }
    EXPECT_GE(silences, 2);
    EXPECT_GE(zeros, 6);
}

TEST(recordings, navigator_sweeps_right_and_circles_twice_with_button_0_held)
{
    shipped s("spacenavigator.hid");
    ASSERT_TRUE(s.good);
    press p = only_press(s);
    EXPECT_GT(p.up_us - p.down_us, 6000000);
    EXPECT_GT(travel(s, p, DEVICE_EVENT_X), 350.0);   /* a second at full deflection */
    EXPECT_GT(travel(s, p, DEVICE_EVENT_RY), 300.0);
    EXPECT_NEAR(turns(s, p), 2.0, 0.25);
    expect_ends_at_rest(s);
    expect_moderate_and_smooth(s);
}

TEST(recordings, wireless_is_a_wireless)
{
    shipped s("spacemouse_wireless.hid");
    ASSERT_TRUE(s.good);
    EXPECT_LT(s.size, file_bytes_max);
    ASSERT_EQ(s.recording.device_count, 1u);
    const hid_recording_device &device = s.recording.devices[0];
    EXPECT_EQ(device.vendor, 0x256f);
    EXPECT_EQ(device.product, 0xc62e);
    EXPECT_EQ(std::vector<uint8_t>(device.descriptor, device.descriptor + device.descriptor_size),
              spacemouse_bytes_wireless);
    EXPECT_EQ(s.decoded.reports_unknown, 0u);
    EXPECT_EQ(s.decoded.reports_short, 0u);
    int batteries = 0;
    for (size_t i = 0; i < s.decoded.event_count; i++) {
        const device_event &event = s.decoded.events[i];
        if (event.kind == DEVICE_EVENT_BATTERY) {
            EXPECT_GE(event.battery_percent, 99);
            batteries++;
        }
    }
    EXPECT_GE(batteries, 1);
}

TEST(recordings, wireless_sends_all_axes_every_16_ms_while_pushed)
{
    shipped s("spacemouse_wireless.hid");
    ASSERT_TRUE(s.good);
    const device_event *last = nullptr;
    for (size_t i = 0; i < s.decoded.event_count; i++) {
        const device_event &event = s.decoded.events[i];
        if (event.kind != DEVICE_EVENT_AXES) {
            continue;
        }
        if (last != nullptr) {
            bool rest = true;
            for (int axis = 0; axis < DEVICE_EVENT_AXIS_COUNT; axis++) {
                rest = rest && last->axes[axis] == 0;
            }
            if (!rest) {
                EXPECT_NEAR((double)(event.time_us - last->time_us), 16000.0, 800.0);
            }
        }
        last = &event;
    }
}

TEST(recordings, wireless_winds_a_helix_away_from_the_user_with_button_0_held)
{
    shipped s("spacemouse_wireless.hid");
    ASSERT_TRUE(s.good);
    press p = only_press(s);
    EXPECT_GT(p.up_us - p.down_us, 6000000);
    EXPECT_LT(travel(s, p, DEVICE_EVENT_Y), -200.0);
    EXPECT_NEAR(turns(s, p), 2.8, 0.3);
    expect_ends_at_rest(s);
    expect_moderate_and_smooth(s);
}
