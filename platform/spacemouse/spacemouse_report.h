/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:   Turns the input reports of one SpaceMouse into device events. Every driver (libusb, hidapi) and the player of
 *         recordings decode here.
 * Is not: A driver, a reader of descriptors (hid_descriptor.h), a dead zone or speed curve (station). It does not
 *         guess that a silent puck let go: a driver that knows its device's pace does.
 * Shape:  State of one device: its descriptor, where the six axes stand, which buttons are down.
 *         Translation and rotation may come in separate reports: a half that has not come keeps its last value.
 *         Buttons come as bits, as codes now down, or as both for the same press; once a report of codes was seen
 *         the bits are ignored. Either way only changes make events.
 *         One report makes at most one AXES, one BATTERY and one BUTTON per button that changed, in this order,
 *         buttons ascending, long presses after short ones.
 * Units:  Raw counts (device_event.h), never clamped to the logical range, only to int16; battery in percent.
 * Owner:  A value without pointers; nothing to give back.
 * Errors: Any bytes are safe. A report of an id the descriptor does not list is counted in reports_unknown; one that
 *         ends before the first element we want is counted in reports_short; the state stays as it was. A report
 *         that ends early is decoded as far as it goes: axes and bits beyond keep their value, codes beyond are up.
 *         Buttons from SPACEMOUSE_REPORT_BUTTONS_MAX on are ignored.
 * Cost:   One pass over the fields and bits of the report's id; no allocation.
 */
#ifndef GLAISE_SPACEMOUSE_SPACEMOUSE_REPORT_H
#define GLAISE_SPACEMOUSE_SPACEMOUSE_REPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "platform/device_event.h"
#include "platform/spacemouse/hid_descriptor.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    SPACEMOUSE_REPORT_BUTTONS_MAX = 256, /* the highest button known is 175 */
    SPACEMOUSE_REPORT_EVENTS_MAX = 2 * SPACEMOUSE_REPORT_BUTTONS_MAX + 2
};

typedef struct spacemouse_report_buttons {
    uint32_t words[SPACEMOUSE_REPORT_BUTTONS_MAX / 32];
} spacemouse_report_buttons;

typedef struct spacemouse_report {
    hid_descriptor descriptor;
    uint32_t device;
    int16_t axes[DEVICE_EVENT_AXIS_COUNT];
    int16_t axis_max[DEVICE_EVENT_AXIS_COUNT];
    spacemouse_report_buttons down;
    spacemouse_report_buttons down_long;
    bool codes_seen;
    uint64_t reports_unknown;
    uint64_t reports_short;
} spacemouse_report;

/* At rest, all buttons up. A descriptor that is not multi-axis is allowed and yields no events. */
void spacemouse_report_init(spacemouse_report *state, uint32_t device, const hid_descriptor *descriptor);

/* `bytes` as the device sent them, report id first where it has ids. Room for `events_max` events must be at least
 * SPACEMOUSE_REPORT_EVENTS_MAX, so that no release is ever lost. Returns how many were written. */
__attribute__((warn_unused_result)) size_t spacemouse_report_decode(spacemouse_report *state, int64_t time_us,
                                                                    const uint8_t *bytes, size_t size,
                                                                    device_event *events, size_t events_max);

#ifdef __cplusplus
}
#endif

#endif
