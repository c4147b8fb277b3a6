/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/playlist.h"

#include "platform/spacemouse/hid_recording.h"
#include "station/motion.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace {

/* A tape or recording is small; what is larger was not meant. */
constexpr uintmax_t FILE_BYTES_MAX = 256u << 20;

bool tape_load(const std::string &path, tape *out, std::string *text_out)
{
    std::string bytes;
    tape_trouble trouble;
    if (!playlist_file(path, &bytes, text_out))
        return false;
    std::optional<tape> t = tape_parse(bytes, &trouble);
    if (!t) {
        *text_out = path + ":" + std::to_string(trouble.line) + ": expected " + trouble.expected;
        return false;
    }
    *out = std::move(*t);
    return true;
}

/* What one device event is as a command; false when it is none (battery). */
bool command_of(const device_event &e, int device, int64_t start_us, command *out)
{
    *out = {};
    out->time_us = start_us + e.time_us;
    out->number[0] = device;
    if (e.kind == DEVICE_EVENT_AXES || e.kind == DEVICE_EVENT_GONE) {
        out->kind = COMMAND_PUCK;
        for (int a = 0; a < DEVICE_EVENT_AXIS_COUNT; a++) {
            int full = e.axis_max[a] > 0 ? e.axis_max[a] : MOTION_COUNTS_FULL;
            int counts = e.axes[a] * MOTION_COUNTS_FULL / full;
            out->number[static_cast<size_t>(1 + a)] = std::clamp(counts, INT16_MIN + 0, INT16_MAX + 0);
        }
        return true;
    }
    out->kind = e.kind == DEVICE_EVENT_PEDAL ? COMMAND_PEDAL : COMMAND_BUTTON;
    bool pedal = e.kind == DEVICE_EVENT_PEDAL;
    out->number[pedal ? 0 : 1] = e.number;
    out->number[pedal ? 1 : 2] = e.down;
    return (pedal && e.number < 8) || (e.kind == DEVICE_EVENT_BUTTON && e.number < 256 && !e.long_press);
}

bool recordings_expand(const tape &t, const std::string &folder, std::vector<command> *out, std::string *text_out)
{
    for (const command &c : t.commands) {
        if (c.kind != COMMAND_RECORDING) {
            out->push_back(c);
            continue;
        }
        std::string path = (std::filesystem::path(folder) / c.name).string(), bytes;
        if (!playlist_file(path, &bytes, text_out))
            return false;
        if (!playlist_decode(bytes, static_cast<int>(c.number[0]), c.time_us, out, text_out)) {
            *text_out = path + ":" + *text_out;
            return false;
        }
    }
    return true;
}

} // namespace

bool playlist_file(const std::string &path, std::string *bytes_out, std::string *text_out)
{
    std::error_code error;
    uintmax_t size = std::filesystem::file_size(path, error);
    if (error) {
        *text_out = path + ": " + error.message();
        return false;
    }
    if (size > FILE_BYTES_MAX) {
        *text_out = path + ": expected at most 256 MiB";
        return false;
    }
    std::ifstream file(path, std::ios::binary);
    bytes_out->resize(size);
    if (!file || !file.read(bytes_out->data(), static_cast<std::streamsize>(size))) {
        *text_out = path + ": " + std::strerror(errno);
        return false;
    }
    return true;
}

bool playlist_decode(const std::string &recording, int device, int64_t start_us, std::vector<command> *out,
                     std::string *text_out)
{
    hid_recording parsed;
    hid_recording_decoded decoded;
    hid_recording_error error;
    if (!hid_recording_init(&parsed, recording.data(), recording.size(), &error)) {
        *text_out = std::to_string(error.line) + ": expected " + error.expected;
        return false;
    }
    bool good = hid_recording_decode(&parsed, &decoded, &error);
    if (good) {
        std::array<int, HID_RECORDING_DEVICES_MAX> puck{};
        int next = device;
        for (size_t n = 0; n < parsed.device_count; n++)
            puck[n] = decoded.skipped[n] ? -1 : next++;
        for (size_t n = 0; n < decoded.event_count; n++) {
            command c;
            int at = puck[decoded.events[n].device];
            if (at >= 0 && at < 8 && command_of(decoded.events[n], at, start_us, &c))
                out->push_back(c);
        }
        hid_recording_decoded_finish(&decoded);
    } else {
        *text_out = std::to_string(error.line) + ": expected " + error.expected;
        if (error.offset)
            *text_out += " at byte " + std::to_string(error.offset) + " of the descriptor";
    }
    hid_recording_finish(&parsed);
    return good;
}

bool playlist_load(const std::string &settings_path, const std::string &tape_path, playlist *out, std::string *text_out)
{
    tape settings, t;
    if (!settings_path.empty() && !tape_load(settings_path, &settings, text_out))
        return false;
    if (!tape_path.empty() && !tape_load(tape_path, &t, text_out))
        return false;
    playlist made;
    made.step_mm = t.step_mm;
    for (command c : settings.commands) {
        c.time_us = 0; /* settings are how things stand at the start */
        made.commands.push_back(std::move(c));
    }
    made.tape_path = tape_path;
    made.settings_path = settings_path;
    std::string folder = std::filesystem::path(tape_path).parent_path().string();
    if (!recordings_expand(t, folder, &made.commands, text_out))
        return false;
    std::stable_sort(made.commands.begin(), made.commands.end(),
                     [](const command &a, const command &b) { return a.time_us < b.time_us; });
    made.end_us = tape_end_us({made.step_mm, made.commands});
    if (made.end_us > TAPE_TIME_MAX_US) {
        *text_out = tape_path + ": expected to end within 24 hours";
        return false;
    }
    *out = std::move(made);
    return true;
}

std::string playlist_beside(const playlist &list, const std::string &name)
{
    std::error_code error;
    const std::filesystem::path beside_tape = std::filesystem::path(list.tape_path).replace_filename(name);
    const std::filesystem::path beside_settings = std::filesystem::path(list.settings_path).replace_filename(name);
    const bool settings_have_it = !list.settings_path.empty() && std::filesystem::exists(beside_settings, error);
    const bool tape_has_it = !list.tape_path.empty() && std::filesystem::exists(beside_tape, error);
    const bool settings = list.tape_path.empty() || (settings_have_it && !tape_has_it);
    return (settings ? beside_settings : beside_tape).string();
}
