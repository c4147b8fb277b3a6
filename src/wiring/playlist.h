/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A tape made ready for the station: read from its file, the recordings it names decoded and put in their
 *          places, the settings tape before it.
 * Is not:  The tape's grammar (station/tape.h) or the reports' (platform/spacemouse).
 * Shape:   commands in order of time; of equal times the tape's own order, then the recordings'. Files that a tape names
 *          lie beside it.
 * Owner:   a value.
 * Errors:  `text` names file, line, and what was expected; nothing is half taken.
 */
#ifndef GLAISE_WIRING_PLAYLIST_H
#define GLAISE_WIRING_PLAYLIST_H

#include "station/tape.h"

struct playlist {
    double step_mm = 1;
    std::vector<command> commands;
    int64_t end_us = 0; /* when the last of it has ended */
    std::string tape_path, settings_path; /* as they were given */
};

/* settings_path may be empty; tape_path too: then there are the settings alone. */
[[nodiscard]] bool playlist_load(const std::string &settings_path, const std::string &tape_path, playlist *out,
                                 std::string *text_out);
/* The file of that name beside the tape; where there is none, beside the settings. */
std::string playlist_beside(const playlist &list, const std::string &name);
/* The commands that a hid-recorder file amounts to: its first six-axis device becomes puck `device`, the next one
   after it. */
[[nodiscard]] bool playlist_decode(const std::string &recording, int device, int64_t start_us,
                                   std::vector<command> *out, std::string *text_out);
/* A whole file; text_out says why not. */
[[nodiscard]] bool playlist_file(const std::string &path, std::string *bytes_out, std::string *text_out);

#endif
