/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:   The port through which every input device speaks: one stamped event at a time, in the device's own counts.
 *         SpaceMouse drivers, pedal drivers and recordings make them; wiring carries them to the station.
 * Is not: A decoder (spacemouse/spacemouse_report.h), a dead zone, a speed, a mapping to commands (station), a queue.
 * Shape:  A plain 48-byte value. The members that do not belong to its kind are zero.
 *             kind      members                meaning
 *             AXES      axes, axis_max         where the puck stands now, all six, not what changed
 *             BUTTON    number, down, long_press
 *             PEDAL     number, down
 *             BATTERY   battery_percent
 *             GONE      -                      unplugged: its axes are zero and its buttons up from here on
 * Units:  time_us: microseconds of the stamping clock, never backwards within one source. axes: raw counts, untouched,
 *         right-handed HID frame X right, Y toward the user, Z down, then the turns Rx, Ry, Rz about them.
 *         axis_max: the count the device calls full deflection, 0 where it has no such axis. The range is not a
 *         hard limit: devices overshoot it, so whoever divides also clamps. Buttons and pedals count from 0.
 * Owner:  A value; copy it.
 */
#ifndef GLAISE_PLATFORM_DEVICE_EVENT_H
#define GLAISE_PLATFORM_DEVICE_EVENT_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DEVICE_EVENT_AXIS_COUNT = 6 };

typedef enum device_event_axis {
    DEVICE_EVENT_X,
    DEVICE_EVENT_Y,
    DEVICE_EVENT_Z,
    DEVICE_EVENT_RX,
    DEVICE_EVENT_RY,
    DEVICE_EVENT_RZ
} device_event_axis;

typedef enum device_event_kind {
    DEVICE_EVENT_AXES,
    DEVICE_EVENT_BUTTON,
    DEVICE_EVENT_PEDAL,
    DEVICE_EVENT_BATTERY,
    DEVICE_EVENT_GONE
} device_event_kind;

typedef struct device_event {
    int64_t time_us;
    uint32_t device; /* which device: a small number its driver gave it */
    device_event_kind kind;
    int16_t axes[DEVICE_EVENT_AXIS_COUNT];
    int16_t axis_max[DEVICE_EVENT_AXIS_COUNT];
    uint16_t number;
    bool down;
    bool long_press; /* the device itself calls this press a long one and reports it beside the short one */
    uint8_t battery_percent;
} device_event;

#ifdef __cplusplus
}
#endif

#endif
