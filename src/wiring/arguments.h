/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The command line: what was asked for, checked; and the text of --help.
 * Is not:  The doing of it (program.h).
 * Errors:  a wrong word or value: message on standard error and exit status 2.
 */
#ifndef GLAISE_WIRING_ARGUMENTS_H
#define GLAISE_WIRING_ARGUMENTS_H

#include <optional>
#include <string>
#include <vector>

constexpr int ARGUMENTS_EXIT_TROUBLE = 1; /* the world failed: disk, device, a refused stroke */
constexpr int ARGUMENTS_EXIT_WRONG = 2;   /* what was given is wrong: words, files, settings */

constexpr int ARGUMENTS_HANDS_MAX = 16;

enum arguments_task { ARGUMENTS_RUN, ARGUMENTS_REPLAY, ARGUMENTS_EXPORT, ARGUMENTS_INFO };

struct arguments {
    arguments_task task = ARGUMENTS_RUN;
    std::string input;                /* tape, or sculpture file */
    std::string settings;             /* settings tape, may be empty */
    std::string store;                /* folder of the sculpture and its undo-files, may be empty */
    std::string picture;              /* PNG of the end, may be empty */
    std::string pictures;             /* folder for the pictures that the tape asks for, may be empty */
    std::vector<std::string> exports; /* files, format by their ending */
    std::string statistics;           /* JSON, may be empty */
    std::string record;               /* tape of everything done, may be empty */
    double step_mm = 0;               /* 0: the tape's own */
    int width = 1280, height = 960;   /* of pictures */
    int ring = 200;                   /* undo-files kept */
    std::string vectors = "best";     /* of lanes_name, or "best": what the row kernels use */
    int hands = 0;                    /* threads that work on the clay; 0: as many as the machine has, up to four */
};

/* On nothing, *exit_out is what the program ends with (0 after --help and --version). */
std::optional<arguments> arguments_parse(int count, char **words, int *exit_out);

#endif
