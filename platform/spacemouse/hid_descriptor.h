/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:   Reads a HID report descriptor and says which bits of which input report are axes, buttons and battery.
 *         So a SpaceMouse nobody has listed works: the device describes itself.
 * Is not: A decoder of reports over time (spacemouse_report.h). Output and feature reports are stepped over, as is
 *         every input outside a Multi-axis Controller collection: a mouse on the same interface stays a mouse.
 * Shape:  A fixed table of fields in descriptor order. A field is `count` elements of `size_bits` each, one after
 *         another from `bit`; bit 0 is the lowest bit of the first byte after the report id.
 *             role           elements                 first
 *             AXIS           1 signed or unsigned     which axis, device_event_axis
 *             BUTTON_BITS    one per button           number of the first button; the others follow
 *             BUTTON_CODES   codes now held down      the usage that the code logical_min stands for; usage u is
 *                                                     button u - 1, usage 0 is none
 *             BATTERY        1                        0
 *         Report ids 0x1c and 0x1d, with 16-bit elements on the button page or a vendor page, are codes whatever
 *         else the descriptor calls them: there, newer devices list held buttons (0x1d: long presses).
 * Units:  Bits, and the device's logical counts.
 * Owner:  A value without pointers; copy it. `expected` in an error is a constant string.
 * Errors: Any bytes are safe. A malformed descriptor is refused whole: the table is left empty (not multi-axis) and
 *         the error holds the offset of the offending item and what was expected there.
 * Cost:   One pass; some 4 KiB of stack.
 * Source: USB Device Class Definition for HID 1.11, section 6.2.2; HID Usage Tables, pages 1, 6 and 9.
 *         We differ: elements beyond the last usage are padding, not repetitions of it, since two bits cannot be
 *         one button. Logical Maximum is unsigned where Logical Minimum is not negative, as devices in the field
 *         write it. A usage without a page takes the page in force at its main item. Of a delimited set of
 *         usages the first counts. A button array whose usages have gaps is left out.
 */
#ifndef GLAISE_SPACEMOUSE_HID_DESCRIPTOR_H
#define GLAISE_SPACEMOUSE_HID_DESCRIPTOR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    HID_DESCRIPTOR_FIELDS_MAX = 64,         /* a SpaceMouse Pro needs fewer than 20 */
    HID_DESCRIPTOR_USAGES_MAX = 256,        /* usages or usage ranges before one main item */
    HID_DESCRIPTOR_COLLECTIONS_MAX = 32,    /* nested */
    HID_DESCRIPTOR_PUSHES_MAX = 8,          /* nested */
    HID_DESCRIPTOR_REPORT_BITS_MAX = 32768, /* 4 KiB; known SpaceMice stay under 64 bytes */
    HID_DESCRIPTOR_CODES_REPORT_ID = 0x1c,
    HID_DESCRIPTOR_LONG_CODES_REPORT_ID = 0x1d
};

typedef enum hid_descriptor_role {
    HID_DESCRIPTOR_AXIS,
    HID_DESCRIPTOR_BUTTON_BITS,
    HID_DESCRIPTOR_BUTTON_CODES,
    HID_DESCRIPTOR_BATTERY
} hid_descriptor_role;

typedef struct hid_descriptor_field {
    hid_descriptor_role role;
    uint8_t report_id;   /* 0 where the device has no report ids */
    uint8_t size_bits;   /* 1 to 32 */
    bool relative;       /* as declared; older SpaceMice declare displacements relative */
    uint16_t first;
    uint16_t count;
    uint32_t bit;
    int32_t logical_min; /* negative: elements are two's complement */
    int32_t logical_max; /* axes and battery: above logical_min and 0 */
} hid_descriptor_field;

typedef struct hid_descriptor {
    bool multi_axis;            /* a top-level application collection is Multi-axis Controller, 01/08 */
    bool report_ids;            /* every report begins with its id */
    uint32_t input_ids[8];      /* bit set over report ids: has an input report; {1} where there are no ids */
    uint32_t input_bytes_max;   /* longest declared input report, its id included */
    uint32_t field_count;
    hid_descriptor_field fields[HID_DESCRIPTOR_FIELDS_MAX];
} hid_descriptor;

typedef struct hid_descriptor_error {
    size_t offset;
    const char *expected;
} hid_descriptor_error;

/* True: `descriptor` holds the table. False: `error` says why. */
__attribute__((warn_unused_result)) bool hid_descriptor_parse(const uint8_t *bytes, size_t size,
                                                              hid_descriptor *descriptor,
                                                              hid_descriptor_error *error);

bool hid_descriptor_has_input(const hid_descriptor *descriptor, uint8_t report_id);

/* Element `index` of `field` out of a report's bytes after its id. False: the bytes end before the element does. */
__attribute__((warn_unused_result)) bool hid_descriptor_element(const hid_descriptor_field *field, uint32_t index,
                                                                const uint8_t *payload, size_t size,
                                                                int64_t *value);

#ifdef __cplusplus
}
#endif

#endif
