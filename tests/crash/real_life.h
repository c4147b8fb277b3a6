/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The program itself living a life that a tape tells, so that a test can interrupt it: the tape, starting the
 *          program, and reading what it says.
 * Is not:  A life of chance on a simulated disk (crash_life.h); whatever interrupts it (kill_test.cpp,
 *          tests/vm/power_cut_test.cpp).
 * Shape:   `glaise replay --kept` says "kept RECORD STROKE DIGEST" as soon as that is on the medium, `--stats` the
 *          digest after every dab, `glaise check` "record N", "stroke N, tip N", "digest D".
 */
#ifndef GLAISE_CRASH_REAL_LIFE_H
#define GLAISE_CRASH_REAL_LIFE_H

#include "tests/property/seeded.h"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <sys/types.h>
#include <vector>

inline const std::string real_life_nothing = "glaise tape 1\n";

/* Strokes that all change something, each elsewhere and in another colour, and steps through history between them. */
std::string real_life_tape(seeded &chance, int strokes);

/* What a variable of the environment says. */
uint64_t real_life_number(const char *variable, uint64_t usual);
std::string real_life_text(const std::filesystem::path &path);
void real_life_put(const std::filesystem::path &path, const std::string &text);

/* The folder that a program works in; what it says goes to files there. */
struct real_life {
    std::filesystem::path base;
    std::string program;

    /* Standard output to `out`, standard error to `out`.err. */
    pid_t start(const std::vector<std::string> &words, const std::string &out) const;
    /* Its exit status, or -signal. */
    static int end(pid_t child);
    int run(const std::vector<std::string> &words, const std::string &out) const { return end(start(words, out)); }
    std::string said(const std::string &out) const { return real_life_text(base / out); }
    /* The words that play a tape of the folder with the folder's store, on a small ring. */
    std::vector<std::string> replay(const std::string &tape) const;
};

/* The word behind `word` in the line that begins with it; "": there is none. */
std::string real_life_value(const std::string &text, const std::string &word);

/* Stroke -> digests of the clay after each of its dabs; stroke 0: before the first. */
using real_life_states = std::map<uint64_t, std::set<std::string>>;
/* Plays the tape to its end, and one that does nothing. Empty: what was said has the reason, in "whole" and "empty". */
real_life_states real_life_states_of(const real_life &life, const std::string &tape);

struct real_life_kept {
    uint64_t record = 0, stroke = 0;
    std::string digest;
};
/* A whole line "kept ...", with its end; record 0: it is not. */
real_life_kept real_life_kept_line(const std::string &line);
/* The last whole one. */
real_life_kept real_life_last_kept(const std::string &said);

#endif
