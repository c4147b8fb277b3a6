/* SPDX-License-Identifier: Apache-2.0 */
#include "platform/spacemouse/spacemouse_report.h"

#include <assert.h>

/* What one report says, before it is compared with the state. */
struct reading {
    bool wanted; /* the descriptor has fields of ours in this report */
    bool axes, bits, codes, long_codes, battery;
    spacemouse_report_buttons down_bits, down_codes, down_long;
    uint8_t battery_percent;
};

struct sink {
    device_event *events;
    size_t count;
    int64_t time_us;
    uint32_t device;
};

static int16_t to_int16(int64_t value)
{
    return value > INT16_MAX ? INT16_MAX : value < INT16_MIN ? INT16_MIN : (int16_t)value;
}

static void buttons_set(spacemouse_report_buttons *buttons, int64_t number, bool down)
{
    if (number < 0 || number >= SPACEMOUSE_REPORT_BUTTONS_MAX) {
        return;
    }
    uint32_t mask = 1u << (number % 32);
    if (down) {
        buttons->words[number / 32] |= mask;
    } else {
        buttons->words[number / 32] &= ~mask;
    }
}

static void read_axis(spacemouse_report *state, const hid_descriptor_field *field, const uint8_t *payload,
                      size_t size, struct reading *reading)
{
    int64_t value;
    if (hid_descriptor_element(field, 0, payload, size, &value)) {
        state->axes[field->first] = to_int16(value);
        state->axis_max[field->first] = to_int16(field->logical_max);
        reading->axes = true;
    }
}

static void read_bits(const hid_descriptor_field *field, const uint8_t *payload, size_t size,
                      struct reading *reading)
{
    int64_t value;
    for (uint32_t i = 0; i < field->count && hid_descriptor_element(field, i, payload, size, &value); i++) {
        buttons_set(&reading->down_bits, (int64_t)field->first + i, value != 0);
        reading->bits = true;
    }
}

static void read_codes(const hid_descriptor_field *field, const uint8_t *payload, size_t size,
                       struct reading *reading)
{
    bool is_long = field->report_id == HID_DESCRIPTOR_LONG_CODES_REPORT_ID;
    int64_t code;
    for (uint32_t i = 0; i < field->count && hid_descriptor_element(field, i, payload, size, &code); i++) {
        if (code >= field->logical_min && code <= field->logical_max) {
            int64_t usage = field->first + (code - field->logical_min);
            buttons_set(is_long ? &reading->down_long : &reading->down_codes, usage - 1, true);
        }
        *(is_long ? &reading->long_codes : &reading->codes) = true;
    }
}

static void read_battery(const hid_descriptor_field *field, const uint8_t *payload, size_t size,
                         struct reading *reading)
{
    int64_t value;
    if (hid_descriptor_element(field, 0, payload, size, &value)) {
        int64_t min = field->logical_min, max = field->logical_max;
        value = value < min ? min : value > max ? max : value;
        reading->battery_percent = (uint8_t)((value - min) * 100 / (max - min));
        reading->battery = true;
    }
}

static void read_fields(spacemouse_report *state, uint8_t report_id, const uint8_t *payload, size_t size,
                        struct reading *reading)
{
    for (uint32_t i = 0; i < state->descriptor.field_count; i++) {
        const hid_descriptor_field *field = &state->descriptor.fields[i];
        if (field->report_id != report_id) {
            continue;
        }
        reading->wanted = true;
        switch (field->role) {
        case HID_DESCRIPTOR_AXIS:
            read_axis(state, field, payload, size, reading);
            break;
        case HID_DESCRIPTOR_BUTTON_BITS:
            read_bits(field, payload, size, reading);
            break;
        case HID_DESCRIPTOR_BUTTON_CODES:
            read_codes(field, payload, size, reading);
            break;
        case HID_DESCRIPTOR_BATTERY:
            read_battery(field, payload, size, reading);
            break;
        }
    }
}

static device_event *sink_add(struct sink *sink, device_event_kind kind)
{
    device_event *event = &sink->events[sink->count++];
    *event = (device_event){0};
    event->time_us = sink->time_us;
    event->device = sink->device;
    event->kind = kind;
    return event;
}

static void put_axes(const spacemouse_report *state, struct sink *sink)
{
    device_event *event = sink_add(sink, DEVICE_EVENT_AXES);
    for (int i = 0; i < DEVICE_EVENT_AXIS_COUNT; i++) {
        event->axes[i] = state->axes[i];
        event->axis_max[i] = state->axis_max[i];
    }
}

static void put_buttons(spacemouse_report_buttons *now, const spacemouse_report_buttons *next, bool long_press,
                        struct sink *sink)
{
    for (uint32_t number = 0; number < SPACEMOUSE_REPORT_BUTTONS_MAX; number++) {
        uint32_t mask = 1u << (number % 32);
        if (((now->words[number / 32] ^ next->words[number / 32]) & mask) != 0) {
            device_event *event = sink_add(sink, DEVICE_EVENT_BUTTON);
            event->number = (uint16_t)number;
            event->down = (next->words[number / 32] & mask) != 0;
            event->long_press = long_press;
        }
    }
    *now = *next;
}

void spacemouse_report_init(spacemouse_report *state, uint32_t device, const hid_descriptor *descriptor)
{
    *state = (spacemouse_report){0};
    state->device = device;
    state->descriptor = *descriptor;
    for (uint32_t i = 0; i < descriptor->field_count; i++) {
        const hid_descriptor_field *field = &descriptor->fields[i];
        if (field->role == HID_DESCRIPTOR_AXIS && state->axis_max[field->first] == 0) {
            state->axis_max[field->first] = to_int16(field->logical_max);
        }
    }
}

size_t spacemouse_report_decode(spacemouse_report *state, int64_t time_us, const uint8_t *bytes, size_t size,
                                device_event *events, size_t events_max)
{
    assert(events_max >= SPACEMOUSE_REPORT_EVENTS_MAX);
    uint8_t report_id = 0;
    if (state->descriptor.report_ids) {
        if (size == 0) {
            state->reports_short++;
            return 0;
        }
        report_id = bytes[0];
        bytes++;
        size--;
    }
    if (!hid_descriptor_has_input(&state->descriptor, report_id)) {
        state->reports_unknown++;
        return 0;
    }
    /* Bits that the report does not reach stay as they are; codes say all that is down. */
    struct reading reading = {.down_bits = state->down};
    read_fields(state, report_id, bytes, size, &reading);

    struct sink sink = {events, 0, time_us, state->device};
    if (reading.axes) {
        put_axes(state, &sink);
    }
    if (reading.battery) {
        sink_add(&sink, DEVICE_EVENT_BATTERY)->battery_percent = reading.battery_percent;
    }
    if (reading.codes) {
        state->codes_seen = true;
        put_buttons(&state->down, &reading.down_codes, false, &sink);
    } else if (!state->codes_seen) {
        put_buttons(&state->down, &reading.down_bits, false, &sink);
    }
    if (reading.long_codes) {
        put_buttons(&state->down_long, &reading.down_long, true, &sink);
    }
    bool anything = reading.axes || reading.battery || reading.codes || reading.long_codes || reading.bits;
    if (reading.wanted && !anything) {
        state->reports_short++;
    }
    return sink.count;
}
