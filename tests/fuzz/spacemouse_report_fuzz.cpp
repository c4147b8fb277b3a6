/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal    No descriptor and no sequence of reports makes the parser or the decoder read outside its bytes, overflow, or
 *         emit events that contradict each other.
 * Method  Input: two bytes descriptor length (low first), the descriptor, then reports, each behind one length byte.
 *         Parser and decoder get exact-size heap copies. A model of the buttons checks that presses and releases
 *         alternate and that the events stay within their contract.
 */
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "platform/device_event.h"
#include "platform/spacemouse/hid_descriptor.h"
#include "platform/spacemouse/spacemouse_report.h"

namespace {

constexpr uint32_t device = 3;

void require(bool truth)
{
    if (!truth) {
        std::abort();
    }
}

uint8_t *exact_copy(const uint8_t *data, size_t size)
{
    uint8_t *copy = static_cast<uint8_t *>(std::malloc(size));
    if (size > 0) {
        std::memcpy(copy, data, size);
    }
    return copy;
}

struct model {
    bool down[2][SPACEMOUSE_REPORT_BUTTONS_MAX] = {};

    void take(const device_event &event, int64_t time_us)
    {
        require(event.time_us == time_us && event.device == device);
        switch (event.kind) {
        case DEVICE_EVENT_AXES:
            for (int i = 0; i < DEVICE_EVENT_AXIS_COUNT; i++) {
                require(event.axis_max[i] > 0 || event.axes[i] == 0);
            }
            break;
        case DEVICE_EVENT_BUTTON: {
            require(event.number < SPACEMOUSE_REPORT_BUTTONS_MAX);
            bool &was = down[event.long_press][event.number];
            require(was != event.down);
            was = event.down;
            break;
        }
        case DEVICE_EVENT_BATTERY:
            require(event.battery_percent <= 100);
            break;
        default:
            require(false);
        }
    }
};

void check_descriptor(const hid_descriptor &d)
{
    require(d.field_count <= HID_DESCRIPTOR_FIELDS_MAX);
    require(d.multi_axis || d.field_count == 0);
    for (uint32_t i = 0; i < d.field_count; i++) {
        const hid_descriptor_field &f = d.fields[i];
        require(f.size_bits >= 1 && f.size_bits <= 32 && f.count >= 1);
        require(hid_descriptor_has_input(&d, f.report_id) && d.report_ids == (f.report_id != 0));
        uint32_t end = (f.bit + uint32_t{f.count} * f.size_bits + 7) / 8 + (d.report_ids ? 1 : 0);
        require(end <= d.input_bytes_max);
        require(f.role != HID_DESCRIPTOR_AXIS || f.first < DEVICE_EVENT_AXIS_COUNT);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 2) {
        return 0;
    }
    size_t descriptor_size = std::min<size_t>(data[0] | data[1] << 8, size - 2);
    uint8_t *descriptor_bytes = exact_copy(data + 2, descriptor_size);
    hid_descriptor descriptor;
    hid_descriptor_error error;
    bool good = hid_descriptor_parse(descriptor_bytes, descriptor_size, &descriptor, &error);
    std::free(descriptor_bytes);
    check_descriptor(descriptor);
    if (!good) {
        require(error.offset <= descriptor_size && error.expected[0] != '\0');
        return 0;
    }
    static spacemouse_report state;
    spacemouse_report_init(&state, device, &descriptor);
    model buttons;
    std::vector<device_event> events(SPACEMOUSE_REPORT_EVENTS_MAX);
    int64_t time_us = 0;
    for (size_t at = 2 + descriptor_size; at < size;) {
        size_t report_size = std::min<size_t>(data[at], size - at - 1);
        uint8_t *report = exact_copy(data + at + 1, report_size);
        size_t count = spacemouse_report_decode(&state, ++time_us, report, report_size, events.data(), events.size());
        std::free(report);
        require(count <= events.size());
        for (size_t i = 0; i < count; i++) {
            buttons.take(events[i], time_us);
        }
        at += 1 + report_size;
    }
    return 0;
}
