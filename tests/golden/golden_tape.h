/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:   The tapes that the golden tests replay (tapes.txt), their digests (digests.txt), and the program that replays
 *         them, as a sculptor would start it.
 * Is not: A judgement: the tests make those. Nothing here writes into the repository; that is tests/golden/renew.
 * Owner:  values. A replay's files lie in a folder of the build, one for each test; who asked removes it.
 * Errors: a list that cannot be read is empty, which its test takes for a failure.
 */
#ifndef GLAISE_GOLDEN_GOLDEN_TAPE_H
#define GLAISE_GOLDEN_GOLDEN_TAPE_H

#include <iosfwd>
#include <string>
#include <vector>

struct golden_tape {
    std::string name, path; /* path: from the root of the repository */
    std::string step_mm;
    std::vector<std::string> pictures; /* without their ending */
};

struct golden_tape_digests {
    std::string name, field, mesh; /* 16 hexadecimal digits each */
    bool operator==(const golden_tape_digests &) const = default;
};

struct golden_tape_outcome {
    int exit = -1;
    std::string said; /* on both outputs */
};

std::vector<golden_tape> golden_tape_list();
std::vector<golden_tape_digests> golden_tape_recorded();
/* The digests of the whole, out of the text that `glaise replay --stats` writes. */
golden_tape_digests golden_tape_digests_of(const std::string &name, const std::string &json);

/* An empty folder of this name under the build. */
std::string golden_tape_folder(const std::string &name);
/* glaise replay TAPE with the shipped settings, the listed step and these words; said.txt in folder keeps what it said. */
golden_tape_outcome golden_tape_replay(const golden_tape &tape, const std::string &folder,
                                       const std::vector<std::string> &words);
std::string golden_tape_text(const std::string &path); /* a whole file; empty when there is none */

std::ostream &operator<<(std::ostream &out, const golden_tape &tape); /* for names of tests */

#endif
