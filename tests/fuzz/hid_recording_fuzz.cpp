/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal    No text makes the recording reader or its player read outside the text, overflow, leak, or hand out a
 *         recording that breaks its header's promises.
 * Method  The input is the text, as an exact-size heap copy that is gone before the recording is looked at.
 */
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "platform/device_event.h"
#include "platform/spacemouse/hid_recording.h"

namespace {

void require(bool truth)
{
    if (!truth) {
        std::abort();
    }
}

/* Touches every byte, so that a dangling or short one traps. */
uint32_t sum_of(const uint8_t *bytes, size_t size)
{
    uint32_t sum = 0;
    for (size_t i = 0; i < size; i++) {
        sum += bytes[i];
    }
    return sum;
}

void check_recording(const hid_recording &r, size_t text_size)
{
    volatile uint32_t sum = 0;
    require(r.device_count >= 1 && r.device_count <= HID_RECORDING_DEVICES_MAX);
    size_t kept = 0;
    for (size_t i = 0; i < r.device_count; i++) {
        const hid_recording_device &device = r.devices[i];
        require(device.descriptor_size <= HID_RECORDING_BYTES_MAX && device.descriptor_line >= 1);
        sum = sum + sum_of(device.descriptor, device.descriptor_size);
        kept += device.descriptor_size + std::strlen(device.name);
        for (size_t j = 0; j < i; j++) {
            require(r.devices[j].index != device.index);
        }
    }
    int64_t last_us = 0;
    for (size_t i = 0; i < r.event_count; i++) {
        const hid_recording_event &event = r.events[i];
        require(event.device < r.device_count && event.time_us >= last_us);
        last_us = event.time_us;
        sum = sum + sum_of(event.bytes, event.size);
        kept += event.size;
    }
    require(kept <= text_size);
}

void check_decoded(const hid_recording &r, const hid_recording_decoded &d)
{
    int64_t last_us = 0;
    for (size_t i = 0; i < d.event_count; i++) {
        const device_event &event = d.events[i];
        require(event.time_us >= last_us && event.device < r.device_count && !d.skipped[event.device]);
        last_us = event.time_us;
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = static_cast<char *>(std::malloc(size));
    if (size > 0) {
        std::memcpy(text, data, size);
    }
    hid_recording recording;
    hid_recording_error error;
    bool good = hid_recording_init(&recording, text, size, &error);
    std::free(text);
    if (!good) {
        require(error.expected[0] != '\0' && error.line <= size + 1);
        require(recording.events == nullptr && recording.pool == nullptr && recording.device_count == 0);
        return 0;
    }
    check_recording(recording, size);
    hid_recording_decoded decoded;
    if (hid_recording_decode(&recording, &decoded, &error)) {
        check_decoded(recording, decoded);
    } else {
        require(error.line >= 1 && error.offset <= HID_RECORDING_BYTES_MAX && decoded.events == nullptr);
    }
    hid_recording_decoded_finish(&decoded);
    hid_recording_finish(&recording);
    return 0;
}
