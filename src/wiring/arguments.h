/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The command line: what was asked for, checked; and the text of --help.
 * Is not:  The doing of it (program.h).
 * Errors:  a wrong word or value: message on standard error and exit status 2.
 */
#ifndef GLAISE_WIRING_ARGUMENTS_H
#define GLAISE_WIRING_ARGUMENTS_H

#include "wiring/large_picture.h"

#include <optional>
#include <string>
#include <vector>

constexpr int ARGUMENTS_EXIT_TROUBLE = 1; /* the world failed: disk, device, a refused stroke */
constexpr int ARGUMENTS_EXIT_WRONG = 2;   /* what was given is wrong: words, files, settings */

constexpr int ARGUMENTS_HANDS_MAX = 16;

enum arguments_task {
    ARGUMENTS_RUN,
    ARGUMENTS_REPLAY,
    ARGUMENTS_EXPORT,
    ARGUMENTS_PICTURE,
    ARGUMENTS_TIMELAPSE,
    ARGUMENTS_INFO,
    ARGUMENTS_CHECK,
    ARGUMENTS_SHELF,
};

/* What is to be done with a shelf. */
enum arguments_act {
    ARGUMENTS_SHELF_LIST,
    ARGUMENTS_SHELF_NEW,
    ARGUMENTS_SHELF_RENAME,
    ARGUMENTS_SHELF_DUPLICATE,
    ARGUMENTS_SHELF_SET_ASIDE,
    ARGUMENTS_SHELF_BRING_BACK,
    ARGUMENTS_SHELF_DISCARD,
    ARGUMENTS_SHELF_MAKE_ROOM,
};

struct arguments {
    arguments_task task = ARGUMENTS_RUN;
    std::string input;                /* tape, sculpture file, or store */
    std::string settings;             /* settings tape, may be empty */
    std::string store;                /* folder of the sculpture and its undo-files, may be empty */
    std::string shelf;                /* folder of a shelf, may be empty */
    int piece = 0;                    /* number of a piece on it; 0: none */
    arguments_act act = ARGUMENTS_SHELF_LIST;
    std::string name;                 /* of a piece, to be given */
    int room_mib = 0;                 /* to be free on the medium */
    std::string thumbnail;            /* small PNG of the end for a shelf (shelf_task_replay); may be empty */
    std::string picture;              /* PNG of the end, may be empty */
    std::string pictures;             /* folder for the pictures of a tape or a time-lapse, may be empty */
    int turntable = 0;                /* pictures of one turn; 0: one picture */
    int every = 1;                    /* a picture of the time-lapse after so many strokes */
    std::vector<std::string> exports; /* files, format by their ending */
    std::string statistics;           /* JSON, may be empty */
    std::string record;               /* tape of everything done, may be empty */
    double step_mm = 0;               /* 0: the tape's own */
    large_picture_size pixels;        /* of pictures */
    int ring = 200;                   /* strokes that can be undone */
    int budget_mb = 1024;             /* of all undo-files */
    bool repair = false;              /* write what can be had of a store as a new one */
    bool kept = false;                /* say on standard output what is acknowledged */
    std::string vectors = "best";     /* of lanes_name, or "best": what the row kernels use */
    int hands = 0;                    /* threads that work on the clay; 0: as many as the machine has, up to four */
};

/* On nothing, *exit_out is what the program ends with (0 after --help and --version). */
std::optional<arguments> arguments_parse(int count, char **words, int *exit_out);

#endif
