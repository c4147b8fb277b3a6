/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:   Reads a recording of HID devices in the text format of hid-tools' hid-recorder, and plays it through the
 *         descriptor parser and the report decoder into a list of device events. A user's bug report and our tests
 *         are such files.
 * Is not: A reader of files: the text is already in memory. A recorder. A player in real time: events carry times.
 * Shape:  One entry a line; blanks around a line and empty lines do not matter:
 *             # anything                                   comment
 *             D: 1                                         the lines after this one speak of device 1 (first: 0)
 *             R: 217 05 01 09 08 ...                       descriptor: byte count (decimal), then bytes (hex)
 *             N: SpaceNavigator                            name
 *             P: usb-0000:00:14.0-1/input0                 physical place (read over)
 *             I: 3 046d c626                               bus, vendor, product (hex)
 *             E: 000001.024000 7 01 00 00 ...              report: seconds.microseconds, byte count, bytes
 *         A line of any other single capital letter and colon is counted in lines_unknown and skipped, as newer
 *         recorders add kinds. R comes once for each device and before its first E; N and I at most once.
 * Units:  time_us: microseconds as recorded, usually from the first report on.
 * Owner:  The recording copies what it keeps; the text may go after _init. _finish gives everything back, as
 *         hid_recording_decoded_finish does for a decoded list.
 * Errors: Any bytes are safe; a recording is taken whole or not at all. The error names the line (from 1; 0 where it
 *         is none's fault) and what was expected there; for a malformed descriptor also the offset in its bytes.
 *         Times that go backwards are an error. After an error the object is empty: _finish does no harm.
 * Cost:   One pass. Memory for a text of n bytes: under 8 n + 2 KiB. Decoded: a report makes at most one axes and one
 *         battery event, a bit in it at most one press and later one release.
 * Source: hid-recorder(1), hid-replay(1). We differ: several devices in one file share one clock, and microseconds
 *         always have six digits.
 */
#ifndef GLAISE_SPACEMOUSE_HID_RECORDING_H
#define GLAISE_SPACEMOUSE_HID_RECORDING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "platform/device_event.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    HID_RECORDING_DEVICES_MAX = 16,
    HID_RECORDING_BYTES_MAX = 4096 /* in one descriptor or one report */
};

#define HID_RECORDING_SECONDS_MAX INT64_C(9999999999) /* ten digits: a clock counting from 1970 fits */

typedef struct hid_recording_device {
    uint32_t index; /* as in the D: line */
    const char *name; /* "" where none is given */
    uint16_t bus, vendor, product; /* 0 where none are given */
    const uint8_t *descriptor;
    uint32_t descriptor_size;
    size_t descriptor_line;
} hid_recording_device;

typedef struct hid_recording_event {
    int64_t time_us;
    const uint8_t *bytes;
    uint32_t size;
    uint32_t device; /* place in `devices` */
} hid_recording_event;

typedef struct hid_recording {
    hid_recording_device devices[HID_RECORDING_DEVICES_MAX];
    size_t device_count;
    hid_recording_event *events;
    size_t event_count;
    size_t lines_unknown;
    uint8_t *pool; /* names, descriptors and reports */
} hid_recording;

typedef struct hid_recording_decoded {
    device_event *events; /* in time order; device: place in the recording's `devices` */
    size_t event_count;
    bool skipped[HID_RECORDING_DEVICES_MAX]; /* not a Multi-axis Controller: nothing of it was decoded */
    uint64_t reports_unknown;
    uint64_t reports_short;
} hid_recording_decoded;

typedef struct hid_recording_error {
    size_t line;
    size_t offset; /* in the descriptor on that line, else 0 */
    const char *expected;
} hid_recording_error;

__attribute__((warn_unused_result)) bool hid_recording_init(hid_recording *recording, const char *text, size_t size,
                                                            hid_recording_error *error);
void hid_recording_finish(hid_recording *recording);

__attribute__((warn_unused_result)) bool hid_recording_decode(const hid_recording *recording,
                                                              hid_recording_decoded *decoded,
                                                              hid_recording_error *error);
void hid_recording_decoded_finish(hid_recording_decoded *decoded);

#ifdef __cplusplus
}
#endif

#endif
