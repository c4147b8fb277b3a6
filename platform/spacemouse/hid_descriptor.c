/* SPDX-License-Identifier: Apache-2.0 */
#include "platform/spacemouse/hid_descriptor.h"

#include <assert.h>

#include "platform/device_event.h"

/* HID 1.11, 6.2.2: item types, tags and the pages that matter here. */
enum { LONG_ITEM = 0xfe };
enum { TYPE_MAIN, TYPE_GLOBAL, TYPE_LOCAL };
enum { MAIN_INPUT = 8, MAIN_COLLECTION = 10, MAIN_END_COLLECTION = 12 };
enum {
    GLOBAL_USAGE_PAGE = 0,
    GLOBAL_LOGICAL_MIN = 1,
    GLOBAL_LOGICAL_MAX = 2,
    GLOBAL_REPORT_SIZE = 7,
    GLOBAL_REPORT_ID = 8,
    GLOBAL_REPORT_COUNT = 9,
    GLOBAL_PUSH = 10,
    GLOBAL_POP = 11
};
enum { LOCAL_USAGE = 0, LOCAL_USAGE_MIN = 1, LOCAL_USAGE_MAX = 2, LOCAL_DELIMITER = 10 };
enum { INPUT_CONSTANT = 1, INPUT_VARIABLE = 2, INPUT_RELATIVE = 4 };
enum { COLLECTION_APPLICATION = 1 };
enum { PAGE_DESKTOP = 0x01, PAGE_DEVICE = 0x06, PAGE_BUTTON = 0x09, PAGE_VENDOR = 0xff00 };
enum { DESKTOP_MULTI_AXIS = 0x08, DESKTOP_X = 0x30, DESKTOP_RZ = 0x35, DEVICE_BATTERY = 0x20 };
enum { ELEMENT_BITS_MAX = 32, CODE_BITS = 16 };

struct item {
    uint8_t type, tag, size;
    uint32_t number;
    int32_t signed_number;
};

struct global_state {
    uint32_t page;
    int32_t logical_min;
    int32_t logical_max_signed;
    uint32_t logical_max;
    uint32_t size_bits, count;
    uint8_t report_id;
};

struct usage {
    uint16_t page, id;
    bool has_page;
};

struct usage_range {
    struct usage first;
    uint16_t last_id;
};

struct local_state {
    struct usage_range ranges[HID_DESCRIPTOR_USAGES_MAX];
    uint32_t count;
    struct usage min, max;
    bool has_min, has_max;
    bool delimited, delimited_taken;
};

struct parser {
    hid_descriptor *out;
    hid_descriptor_error *error;
    size_t item_offset;
    struct global_state now;
    struct global_state pushed[HID_DESCRIPTOR_PUSHES_MAX];
    uint32_t push_count;
    struct local_state local;
    uint32_t depth;
    bool inside; /* the top-level collection now open is a Multi-axis Controller */
    bool input_without_id;
    uint32_t report_bits[256];
};

static bool refuse(struct parser *p, const char *expected)
{
    p->error->offset = p->item_offset;
    p->error->expected = expected;
    return false;
}

static struct usage item_usage(const struct item *item)
{
    struct usage u = {0, (uint16_t)item->number, false};
    if (item->size == 4) {
        u.page = (uint16_t)(item->number >> 16);
        u.has_page = true;
    }
    return u;
}

static uint16_t usage_page(const struct parser *p, const struct usage *usage)
{
    return usage->has_page ? usage->page : (uint16_t)p->now.page;
}

static bool range_add(struct parser *p, struct usage first, uint16_t last_id)
{
    struct local_state *local = &p->local;
    if (local->delimited) {
        if (local->delimited_taken) {
            return true;
        }
        local->delimited_taken = true;
    }
    if (local->count == HID_DESCRIPTOR_USAGES_MAX) {
        return refuse(p, "at most 256 usages before a main item");
    }
    local->ranges[local->count].first = first;
    local->ranges[local->count].last_id = last_id;
    local->count++;
    return true;
}

/* Minimum and maximum come in either order. */
static bool range_bound(struct parser *p, const struct item *item)
{
    struct local_state *local = &p->local;
    if (item->tag == LOCAL_USAGE_MIN) {
        local->min = item_usage(item);
        local->has_min = true;
    } else {
        local->max = item_usage(item);
        local->has_max = true;
    }
    if (!local->has_min || !local->has_max) {
        return true;
    }
    local->has_min = local->has_max = false;
    if (local->max.id < local->min.id) {
        return refuse(p, "Usage Maximum not below Usage Minimum");
    }
    if (local->min.has_page && local->max.has_page && local->min.page != local->max.page) {
        return refuse(p, "Usage Minimum and Usage Maximum on one page");
    }
    struct usage first = local->min;
    if (local->max.has_page) {
        first.page = local->max.page;
        first.has_page = true;
    }
    return range_add(p, first, local->max.id);
}

static bool local_item(struct parser *p, const struct item *item)
{
    struct local_state *local = &p->local;
    switch (item->tag) {
    case LOCAL_USAGE: {
        struct usage usage = item_usage(item);
        return range_add(p, usage, usage.id);
    }
    case LOCAL_USAGE_MIN:
    case LOCAL_USAGE_MAX:
        return range_bound(p, item);
    case LOCAL_DELIMITER:
        if (local->delimited == (item->number == 1)) {
            return refuse(p, "Delimiter open and close in turn");
        }
        local->delimited = !local->delimited;
        local->delimited_taken = false;
        return true;
    default:
        return true;
    }
}

static bool global_item(struct parser *p, const struct item *item)
{
    switch (item->tag) {
    case GLOBAL_USAGE_PAGE:
        p->now.page = item->number;
        return item->number <= 0xffff || refuse(p, "Usage Page of at most 0xffff");
    case GLOBAL_LOGICAL_MIN:
        p->now.logical_min = item->signed_number;
        return true;
    case GLOBAL_LOGICAL_MAX:
        p->now.logical_max = item->number;
        p->now.logical_max_signed = item->signed_number;
        return true;
    case GLOBAL_REPORT_SIZE:
        p->now.size_bits = item->number;
        return true;
    case GLOBAL_REPORT_ID:
        if (item->number == 0 || item->number > 255) {
            return refuse(p, "Report ID from 1 to 255");
        }
        if (p->input_without_id) {
            return refuse(p, "Report ID before the first Input, or none at all");
        }
        p->out->report_ids = true;
        p->now.report_id = (uint8_t)item->number;
        return true;
    case GLOBAL_REPORT_COUNT:
        p->now.count = item->number;
        return true;
    case GLOBAL_PUSH:
        if (p->push_count == HID_DESCRIPTOR_PUSHES_MAX) {
            return refuse(p, "at most 8 nested Push");
        }
        p->pushed[p->push_count++] = p->now;
        return true;
    case GLOBAL_POP:
        if (p->push_count == 0) {
            return refuse(p, "Push before Pop");
        }
        p->now = p->pushed[--p->push_count];
        return true;
    default:
        return true;
    }
}

static int32_t logical_max(const struct global_state *now)
{
    if (now->logical_min < 0) {
        return now->logical_max_signed;
    }
    return now->logical_max > INT32_MAX ? INT32_MAX : (int32_t)now->logical_max;
}

/* NULL where the table is full, having refused. */
static hid_descriptor_field *field_add(struct parser *p, hid_descriptor_role role, uint32_t bit, uint32_t flags)
{
    if (p->out->field_count == HID_DESCRIPTOR_FIELDS_MAX) {
        (void)refuse(p, "at most 64 fields of axes, buttons and battery");
        return NULL;
    }
    hid_descriptor_field *field = &p->out->fields[p->out->field_count++];
    *field = (hid_descriptor_field){0};
    field->role = role;
    field->report_id = p->now.report_id;
    field->size_bits = (uint8_t)p->now.size_bits;
    field->relative = (flags & INPUT_RELATIVE) != 0;
    field->bit = bit;
    field->count = 1;
    field->logical_min = p->now.logical_min;
    field->logical_max = logical_max(&p->now);
    return field;
}

static bool value_add(struct parser *p, hid_descriptor_role role, uint32_t first, uint32_t bit, uint32_t flags)
{
    int32_t max = logical_max(&p->now);
    if (max <= 0 || max <= p->now.logical_min) {
        return refuse(p, "Logical Maximum above 0 and Logical Minimum");
    }
    hid_descriptor_field *field = field_add(p, role, bit, flags);
    if (field == NULL) {
        return false;
    }
    field->first = (uint16_t)first;
    return true;
}

static bool button_bit_add(struct parser *p, uint32_t number, uint32_t bit, uint32_t flags)
{
    uint32_t size_bits = p->now.size_bits;
    if (p->out->field_count > 0) {
        hid_descriptor_field *last = &p->out->fields[p->out->field_count - 1];
        if (last->role == HID_DESCRIPTOR_BUTTON_BITS && last->report_id == p->now.report_id &&
            last->size_bits == size_bits && last->bit + last->count * size_bits == bit &&
            last->first + (uint32_t)last->count == number) {
            last->count++;
            return true;
        }
    }
    hid_descriptor_field *field = field_add(p, HID_DESCRIPTOR_BUTTON_BITS, bit, flags);
    if (field == NULL) {
        return false;
    }
    field->first = (uint16_t)number;
    return true;
}

static bool element_add(struct parser *p, uint16_t page, uint16_t id, uint32_t bit, uint32_t flags)
{
    if (page == PAGE_DESKTOP && id >= DESKTOP_X && id <= DESKTOP_RZ) {
        return value_add(p, HID_DESCRIPTOR_AXIS, DEVICE_EVENT_X + (id - (uint32_t)DESKTOP_X), bit, flags);
    }
    if (page == PAGE_DEVICE && id == DEVICE_BATTERY) {
        return value_add(p, HID_DESCRIPTOR_BATTERY, 0, bit, flags);
    }
    if (page == PAGE_BUTTON && id > 0) {
        return button_bit_add(p, id - 1u, bit, flags);
    }
    return true;
}

static bool variables_add(struct parser *p, uint32_t bit, uint32_t flags)
{
    uint32_t index = 0;
    for (uint32_t r = 0; r < p->local.count; r++) {
        const struct usage_range *range = &p->local.ranges[r];
        uint16_t page = usage_page(p, &range->first);
        for (uint32_t id = range->first.id; id <= range->last_id; id++) {
            if (index == p->now.count) {
                return true;
            }
            if (!element_add(p, page, (uint16_t)id, bit + index * p->now.size_bits, flags)) {
                return false;
            }
            index++;
        }
    }
    return true;
}

static bool is_codes_report(const struct parser *p)
{
    uint8_t id = p->now.report_id;
    uint16_t page = p->local.count > 0 ? usage_page(p, &p->local.ranges[0].first) : (uint16_t)p->now.page;
    return (id == HID_DESCRIPTOR_CODES_REPORT_ID || id == HID_DESCRIPTOR_LONG_CODES_REPORT_ID) &&
           p->now.size_bits == CODE_BITS && (page == PAGE_BUTTON || page >= PAGE_VENDOR);
}

/* A code is an index into the usages, which must be one run for `first` to name them all. */
static bool usages_are_one_button_run(const struct parser *p)
{
    for (uint32_t r = 0; r < p->local.count; r++) {
        const struct usage_range *range = &p->local.ranges[r];
        if (usage_page(p, &range->first) != PAGE_BUTTON ||
            (r > 0 && range->first.id != p->local.ranges[r - 1].last_id + 1)) {
            return false;
        }
    }
    return p->local.count > 0;
}

static bool codes_add(struct parser *p, uint32_t bit, uint32_t flags)
{
    bool codes_report = is_codes_report(p);
    int32_t max = logical_max(&p->now);
    if (!codes_report && (!usages_are_one_button_run(p) || max < p->now.logical_min)) {
        return true;
    }
    hid_descriptor_field *field = field_add(p, HID_DESCRIPTOR_BUTTON_CODES, bit, flags);
    if (field == NULL) {
        return false;
    }
    field->count = (uint16_t)p->now.count;
    if (codes_report) {
        field->first = 1;
        field->logical_min = 1;
        field->logical_max = UINT16_MAX;
    } else {
        field->first = p->local.ranges[0].first.id;
    }
    return true;
}

static bool input_item(struct parser *p, uint32_t flags)
{
    uint32_t bit = p->report_bits[p->now.report_id];
    uint64_t bits = (uint64_t)p->now.size_bits * p->now.count;
    if (bits > HID_DESCRIPTOR_REPORT_BITS_MAX - bit) {
        return refuse(p, "an input report of at most 4096 bytes");
    }
    p->report_bits[p->now.report_id] = bit + (uint32_t)bits;
    p->input_without_id |= p->now.report_id == 0;
    if (p->input_without_id && p->out->report_ids) {
        return refuse(p, "Report ID before the first Input, or none at all");
    }
    p->out->input_ids[p->now.report_id / 32] |= 1u << (p->now.report_id % 32);
    uint32_t bytes = (bit + (uint32_t)bits + 7) / 8 + (p->out->report_ids ? 1u : 0u);
    if (bytes > p->out->input_bytes_max) {
        p->out->input_bytes_max = bytes;
    }
    bool ours = p->inside && (flags & INPUT_CONSTANT) == 0 && bits > 0 && p->now.size_bits <= ELEMENT_BITS_MAX;
    if (!ours) {
        return true;
    }
    if ((flags & INPUT_VARIABLE) == 0 || is_codes_report(p)) {
        return codes_add(p, bit, flags);
    }
    return variables_add(p, bit, flags);
}

static bool collection_item(struct parser *p, uint32_t kind)
{
    if (p->depth == HID_DESCRIPTOR_COLLECTIONS_MAX) {
        return refuse(p, "at most 32 nested collections");
    }
    if (p->depth == 0 && kind == COLLECTION_APPLICATION && p->local.count > 0) {
        const struct usage *usage = &p->local.ranges[0].first;
        p->inside = usage_page(p, usage) == PAGE_DESKTOP && usage->id == DESKTOP_MULTI_AXIS;
        p->out->multi_axis |= p->inside;
    }
    p->depth++;
    return true;
}

static bool main_item(struct parser *p, const struct item *item)
{
    bool good = true;
    if (p->local.delimited) {
        return refuse(p, "Delimiter close before a main item");
    }
    switch (item->tag) {
    case MAIN_INPUT:
        good = input_item(p, item->number);
        break;
    case MAIN_COLLECTION:
        good = collection_item(p, item->number);
        break;
    case MAIN_END_COLLECTION:
        if (p->depth == 0) {
            return refuse(p, "Collection before End Collection");
        }
        p->depth--;
        p->inside = p->inside && p->depth > 0;
        break;
    default:
        break;
    }
    p->local.count = 0;
    p->local.has_min = p->local.has_max = false;
    return good;
}

/* Short items only. False: the data bytes are cut off. */
static bool item_take(const uint8_t *bytes, size_t size, size_t *at, struct item *item)
{
    static const uint8_t data_sizes[4] = {0, 1, 2, 4};
    uint8_t head = bytes[*at];
    item->size = data_sizes[head & 3];
    item->type = (head >> 2) & 3;
    item->tag = head >> 4;
    if (size - *at - 1 < item->size) {
        return false;
    }
    const uint8_t *data = bytes + *at + 1;
    uint32_t number = 0;
    for (uint32_t i = 0; i < item->size; i++) {
        number |= (uint32_t)data[i] << (8 * i);
    }
    item->number = number;
    item->signed_number = item->size == 1   ? (int8_t)number
                          : item->size == 2 ? (int16_t)number
                                            : (int32_t)number;
    *at += 1u + item->size;
    return true;
}

static bool items(struct parser *p, const uint8_t *bytes, size_t size)
{
    size_t at = 0;
    while (at < size) {
        p->item_offset = at;
        if (bytes[at] == LONG_ITEM) {
            /* prefix, data size, tag, data */
            if (size - at < 3 || size - at - 3 < bytes[at + 1]) {
                return refuse(p, "the whole of a long item");
            }
            at += 3u + bytes[at + 1];
            continue;
        }
        struct item item;
        if (!item_take(bytes, size, &at, &item)) {
            return refuse(p, "all data bytes of an item");
        }
        bool good = item.type == TYPE_MAIN     ? main_item(p, &item)
                    : item.type == TYPE_GLOBAL ? global_item(p, &item)
                    : item.type == TYPE_LOCAL  ? local_item(p, &item)
                                               : true;
        if (!good) {
            return false;
        }
    }
    p->item_offset = size;
    return p->depth == 0 || refuse(p, "End Collection");
}

bool hid_descriptor_parse(const uint8_t *bytes, size_t size, hid_descriptor *descriptor, hid_descriptor_error *error)
{
    struct parser p = {0};
    p.out = descriptor;
    p.error = error;
    *descriptor = (hid_descriptor){0};
    *error = (hid_descriptor_error){0, ""};
    if (!items(&p, bytes, size)) {
        *descriptor = (hid_descriptor){0};
        return false;
    }
    return true;
}

bool hid_descriptor_has_input(const hid_descriptor *descriptor, uint8_t report_id)
{
    return (descriptor->input_ids[report_id / 32] >> (report_id % 32) & 1u) != 0;
}

bool hid_descriptor_element(const hid_descriptor_field *field, uint32_t index, const uint8_t *payload, size_t size,
                            int64_t *value)
{
    assert(index < field->count && field->size_bits >= 1 && field->size_bits <= ELEMENT_BITS_MAX);
    size_t bit = field->bit + (size_t)index * field->size_bits;
    size_t end = bit + field->size_bits;
    if ((end + 7) / 8 > size) {
        return false;
    }
    uint64_t number = 0;
    for (size_t byte = bit / 8; byte < (end + 7) / 8; byte++) {
        number |= (uint64_t)payload[byte] << (8 * (byte - bit / 8));
    }
    number = number >> (bit % 8) & ((UINT64_C(1) << field->size_bits) - 1);
    *value = (int64_t)number;
    if (field->logical_min < 0 && (number >> (field->size_bits - 1) & 1u) != 0) {
        *value -= INT64_C(1) << field->size_bits;
    }
    return true;
}
