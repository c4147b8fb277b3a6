/* SPDX-License-Identifier: Apache-2.0 */
#include "platform/spacemouse/hid_recording.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "platform/spacemouse/hid_descriptor.h"
#include "platform/spacemouse/spacemouse_report.h"

enum { MICROSECOND_DIGITS = 6, FIRST_CAPACITY = 64 };
enum { INDEX_MAX = 9999, ID_MAX = 0xffff, BYTE_MAX = 0xff, BYTE_DIGITS_MAX = 2, NO_DIGIT = 99 };
#define US_PER_S INT64_C(1000000)

/* A line, or what is left of it. */
struct span {
    const char *at, *end;
};

/* What the header of a device has said so far, beside the public device. */
struct seen {
    bool name, ids, descriptor;
    size_t line; /* where the device was first named */
};

struct reader {
    hid_recording *out;
    hid_recording_error *error;
    size_t line;
    size_t pool_used;
    size_t event_capacity;
    uint32_t device;      /* place of the device that lines speak of, once `device_open` */
    uint32_t index;       /* what the last D: said */
    bool device_open;
    struct seen seen[HID_RECORDING_DEVICES_MAX];
};

static bool refuse(struct reader *r, const char *expected)
{
    *r->error = (hid_recording_error){r->line, 0, expected};
    return false;
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static void skip_blanks(struct span *s)
{
    while (s->at < s->end && is_blank(*s->at)) {
        s->at++;
    }
}

static void trim(struct span *s)
{
    skip_blanks(s);
    while (s->end > s->at && is_blank(s->end[-1])) {
        s->end--;
    }
}

static int digit_value(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : NO_DIGIT;
}

/* Digits of `base` up to one that is not; at least one; at most `max`. */
static bool take_number(struct span *s, int base, int64_t max, int64_t *number)
{
    const char *begin = s->at;
    *number = 0;
    while (s->at < s->end && digit_value(*s->at) < base) {
        *number = *number * base + digit_value(*s->at);
        if (*number > max) {
            return false;
        }
        s->at++;
    }
    return s->at > begin;
}

/* A number that a blank or the end of the line follows; the blanks are taken too. */
static bool take_word_number(struct span *s, int base, int64_t max, int64_t *number)
{
    if (!take_number(s, base, max, number) || (s->at < s->end && !is_blank(*s->at))) {
        return false;
    }
    skip_blanks(s);
    return true;
}

static ptrdiff_t word_length(const struct span *s)
{
    const char *c = s->at;
    while (c < s->end && !is_blank(*c)) {
        c++;
    }
    return c - s->at;
}

static bool take_time(struct span *s, int64_t *time_us)
{
    int64_t seconds, microseconds;
    if (!take_number(s, 10, HID_RECORDING_SECONDS_MAX, &seconds) || s->at == s->end || *s->at != '.') {
        return false;
    }
    s->at++;
    if (word_length(s) != MICROSECOND_DIGITS || !take_word_number(s, 10, US_PER_S - 1, &microseconds)) {
        return false;
    }
    *time_us = seconds * US_PER_S + microseconds;
    return true;
}

/* Count, then as many bytes, into the pool. Every byte took two characters of text, so the pool cannot overflow. */
static bool take_bytes(struct reader *r, struct span *s, const uint8_t **bytes, uint32_t *size)
{
    int64_t count, value;
    if (!take_word_number(s, 10, HID_RECORDING_BYTES_MAX, &count)) {
        return refuse(r, "a byte count of at most 4096, decimal");
    }
    uint8_t *begin = r->out->pool + r->pool_used;
    for (int64_t i = 0; i < count; i++) {
        if (s->at == s->end) {
            return refuse(r, "as many bytes as the count says (the line has fewer)");
        }
        if (word_length(s) > BYTE_DIGITS_MAX || !take_word_number(s, 16, BYTE_MAX, &value)) {
            return refuse(r, "bytes of two hexadecimal digits, blanks between");
        }
        begin[i] = (uint8_t)value;
    }
    if (s->at < s->end) {
        return refuse(r, "as many bytes as the count says (the line has more)");
    }
    r->pool_used += (size_t)count;
    *bytes = begin;
    *size = (uint32_t)count;
    return true;
}

/* Finds or adds the device that lines now speak of. */
static bool device_select(struct reader *r)
{
    if (r->device_open) {
        return true;
    }
    hid_recording *out = r->out;
    uint32_t place = 0;
    while (place < out->device_count && out->devices[place].index != r->index) {
        place++;
    }
    if (place == HID_RECORDING_DEVICES_MAX) {
        return refuse(r, "at most 16 devices");
    }
    if (place == out->device_count) {
        out->devices[place] = (hid_recording_device){.index = r->index, .name = ""};
        r->seen[place].line = r->line;
        out->device_count++;
    }
    r->device = place;
    r->device_open = true;
    return true;
}

static bool line_device(struct reader *r, struct span s)
{
    int64_t index;
    if (!take_word_number(&s, 10, INDEX_MAX, &index) || s.at < s.end) {
        return refuse(r, "D: and a device index, decimal, at most 9999");
    }
    r->index = (uint32_t)index;
    r->device_open = false;
    return true;
}

static bool line_descriptor(struct reader *r, struct span s)
{
    if (!device_select(r)) {
        return false;
    }
    hid_recording_device *device = &r->out->devices[r->device];
    if (r->seen[r->device].descriptor) {
        return refuse(r, "one R: for a device (D: before that of another)");
    }
    r->seen[r->device].descriptor = true;
    device->descriptor_line = r->line;
    return take_bytes(r, &s, &device->descriptor, &device->descriptor_size);
}

static bool line_name(struct reader *r, struct span s)
{
    if (!device_select(r)) {
        return false;
    }
    if (r->seen[r->device].name) {
        return refuse(r, "one N: for a device (D: before that of another)");
    }
    for (const char *c = s.at; c < s.end; c++) {
        if ((unsigned char)*c < ' ' || *c == 0x7f) {
            return refuse(r, "N: and a name without control characters");
        }
    }
    size_t length = (size_t)(s.end - s.at);
    char *name = (char *)r->out->pool + r->pool_used;
    memcpy(name, s.at, length);
    name[length] = '\0';
    r->pool_used += length + 1;
    r->seen[r->device].name = true;
    r->out->devices[r->device].name = name;
    return true;
}

static bool line_ids(struct reader *r, struct span s)
{
    if (!device_select(r)) {
        return false;
    }
    if (r->seen[r->device].ids) {
        return refuse(r, "one I: for a device (D: before that of another)");
    }
    int64_t bus, vendor, product;
    if (!take_word_number(&s, 16, ID_MAX, &bus) || !take_word_number(&s, 16, ID_MAX, &vendor) ||
        !take_word_number(&s, 16, ID_MAX, &product) || s.at < s.end) {
        return refuse(r, "I: and bus, vendor, product, each at most ffff, hexadecimal");
    }
    hid_recording_device *device = &r->out->devices[r->device];
    device->bus = (uint16_t)bus;
    device->vendor = (uint16_t)vendor;
    device->product = (uint16_t)product;
    r->seen[r->device].ids = true;
    return true;
}

static bool events_reserve(struct reader *r)
{
    if (r->out->event_count < r->event_capacity) {
        return true;
    }
    size_t capacity = r->event_capacity == 0 ? FIRST_CAPACITY : 2 * r->event_capacity;
    hid_recording_event *events = realloc(r->out->events, capacity * sizeof *events);
    if (events == NULL) {
        r->line = 0;
        return refuse(r, "more memory");
    }
    r->out->events = events;
    r->event_capacity = capacity;
    return true;
}

static bool line_event(struct reader *r, struct span s)
{
    hid_recording *out = r->out;
    hid_recording_event event = {0};
    if (!device_select(r)) {
        return false;
    }
    if (!r->seen[r->device].descriptor) {
        return refuse(r, "R: of this device before its first E:");
    }
    if (!take_time(&s, &event.time_us)) {
        return refuse(r, "E: and a time, seconds.microseconds with six digits after the point");
    }
    if (out->event_count > 0 && event.time_us < out->events[out->event_count - 1].time_us) {
        return refuse(r, "a time not before the last one");
    }
    event.device = r->device;
    if (!take_bytes(r, &s, &event.bytes, &event.size) || !events_reserve(r)) {
        return false;
    }
    out->events[out->event_count++] = event;
    return true;
}

static bool line_read(struct reader *r, struct span s)
{
    trim(&s);
    if (s.at == s.end || *s.at == '#') {
        return true;
    }
    char kind = *s.at;
    if (kind < 'A' || kind > 'Z' || s.end - s.at < 2 || s.at[1] != ':') {
        return refuse(r, "a line beginning with #, D:, R:, N:, P:, I: or E:");
    }
    s.at += 2;
    skip_blanks(&s);
    switch (kind) {
    case 'D':
        return line_device(r, s);
    case 'R':
        return line_descriptor(r, s);
    case 'N':
        return line_name(r, s);
    case 'P':
        return true;
    case 'I':
        return line_ids(r, s);
    case 'E':
        return line_event(r, s);
    default:
        r->out->lines_unknown++;
        return true;
    }
}

static bool headers_whole(struct reader *r)
{
    for (uint32_t i = 0; i < r->out->device_count; i++) {
        if (!r->seen[i].descriptor) {
            r->line = r->seen[i].line;
            return refuse(r, "R: for the device first named here");
        }
    }
    return r->out->device_count > 0 || refuse(r, "R: (the recording names no device)");
}

static bool text_read(struct reader *r, const char *text, size_t size)
{
    /* A line keeps fewer bytes than it has characters, newline included. */
    r->out->pool = malloc(size + 1);
    if (r->out->pool == NULL) {
        return refuse(r, "more memory");
    }
    const char *end = text + size;
    for (const char *at = text; at < end;) {
        const char *newline = memchr(at, '\n', (size_t)(end - at));
        struct span line = {at, newline != NULL ? newline : end};
        r->line++;
        if (!line_read(r, line)) {
            return false;
        }
        at = newline != NULL ? newline + 1 : end;
    }
    return headers_whole(r);
}

bool hid_recording_init(hid_recording *recording, const char *text, size_t size, hid_recording_error *error)
{
    struct reader r = {.out = recording, .error = error};
    *recording = (hid_recording){0};
    *error = (hid_recording_error){0, 0, ""};
    if (!text_read(&r, text, size)) {
        hid_recording_finish(recording);
        return false;
    }
    return true;
}

void hid_recording_finish(hid_recording *recording)
{
    free(recording->events);
    free(recording->pool);
    *recording = (hid_recording){0};
}

struct player {
    spacemouse_report states[HID_RECORDING_DEVICES_MAX];
    device_event one_report[SPACEMOUSE_REPORT_EVENTS_MAX];
    size_t capacity;
};

static bool decoded_append(struct player *player, hid_recording_decoded *decoded, size_t count)
{
    if (count > player->capacity - decoded->event_count) {
        size_t capacity = 2 * player->capacity + count;
        device_event *events = realloc(decoded->events, capacity * sizeof *events);
        if (events == NULL) {
            return false;
        }
        decoded->events = events;
        player->capacity = capacity;
    }
    if (count > 0) {
        memcpy(decoded->events + decoded->event_count, player->one_report, count * sizeof *player->one_report);
        decoded->event_count += count;
    }
    return true;
}

static bool player_begin(const hid_recording *recording, struct player *player, hid_recording_decoded *decoded,
                         hid_recording_error *error)
{
    for (uint32_t i = 0; i < recording->device_count; i++) {
        const hid_recording_device *device = &recording->devices[i];
        hid_descriptor descriptor;
        hid_descriptor_error why;
        if (!hid_descriptor_parse(device->descriptor, device->descriptor_size, &descriptor, &why)) {
            *error = (hid_recording_error){device->descriptor_line, why.offset, why.expected};
            return false;
        }
        decoded->skipped[i] = !descriptor.multi_axis;
        spacemouse_report_init(&player->states[i], i, &descriptor);
    }
    return true;
}

static bool play(const hid_recording *recording, struct player *player, hid_recording_decoded *decoded,
                 hid_recording_error *error)
{
    if (!player_begin(recording, player, decoded, error)) {
        return false;
    }
    for (size_t i = 0; i < recording->event_count; i++) {
        const hid_recording_event *event = &recording->events[i];
        if (decoded->skipped[event->device]) {
            continue;
        }
        size_t count = spacemouse_report_decode(&player->states[event->device], event->time_us, event->bytes,
                                                event->size, player->one_report, SPACEMOUSE_REPORT_EVENTS_MAX);
        if (!decoded_append(player, decoded, count)) {
            *error = (hid_recording_error){0, 0, "more memory"};
            return false;
        }
    }
    for (uint32_t i = 0; i < recording->device_count; i++) {
        decoded->reports_unknown += player->states[i].reports_unknown;
        decoded->reports_short += player->states[i].reports_short;
    }
    return true;
}

bool hid_recording_decode(const hid_recording *recording, hid_recording_decoded *decoded, hid_recording_error *error)
{
    *decoded = (hid_recording_decoded){0};
    *error = (hid_recording_error){0, 0, ""};
    struct player *player = calloc(1, sizeof *player);
    if (player == NULL) {
        *error = (hid_recording_error){0, 0, "more memory"};
        return false;
    }
    bool good = play(recording, player, decoded, error);
    free(player);
    if (!good) {
        hid_recording_decoded_finish(decoded);
    }
    return good;
}

void hid_recording_decoded_finish(hid_recording_decoded *decoded)
{
    free(decoded->events);
    *decoded = (hid_recording_decoded){0};
}
