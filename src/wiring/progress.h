/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    How far a long job is, on standard error: a bar on a terminal, plain lines otherwise.
 * Is not:  A log (platform/service).
 * Cost:    drawn at most every 50 ms on a terminal, at every tenth part otherwise.
 */
#ifndef GLAISE_WIRING_PROGRESS_H
#define GLAISE_WIRING_PROGRESS_H

#include <cstdint>
#include <string>

struct progress {
    std::string what;
    bool terminal = false;
    int64_t drawn_ns = 0;
    int tenth = -1;
};

progress progress_begin(std::string what);
/* part in 0..1; note: a few words behind the bar. */
void progress_show(progress *p, double part, const std::string &note, int64_t now_ns);
void progress_end(progress *p, const std::string &note);

#endif
