/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    How far a long job is, on standard error: a bar on a terminal, plain lines otherwise.
 * Is not:  A log (platform/service).
 * Cost:    drawn at most every 50 ms on a terminal, at every tenth part otherwise.
 */
#ifndef GLAISE_WIRING_PROGRESS_H
#define GLAISE_WIRING_PROGRESS_H

#include <cstdint>
#include <functional>
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

/* Looks up every millisecond whether a work that others do is done. Shows how far it is, but only once it has taken
   longer than a moment. */
void progress_await(const char *what, const std::function<bool()> &is_done, const std::function<double()> &part);
/* The same for a work that the caller does: `told` of it hears the parts. Nothing was shown: nothing is at the end. */
struct progress_teller {
    progress bar;
    int64_t begun_ns = 0;
    bool shown = false;
};
progress_teller progress_teller_begin(std::string what);
void progress_teller_show(progress_teller *t, double part);
void progress_teller_end(progress_teller *t);

/* By the clock that these go by. */
int64_t progress_now_ns();

#endif
