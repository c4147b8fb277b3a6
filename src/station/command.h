/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A command: one thing a person, a device or a tape asks of the station at a time. Its text form is one
 *          line, the same on tapes, in settings and in bug reports.
 * Is not:  Its execution (station.h); a file of commands (tape.h).
 * Shape:   a name and a fixed list of arguments; command_forms() lists every command with its arguments, ranges and
 *          what it does, and is the only such list: parser, writer, checks and the manual all read it.
 * Units:   millimetres, seconds where a rate, degrees, milliseconds in text and microseconds in `time_us`.
 * Errors:  command_parse answers what was expected; nothing outside the stated ranges ever becomes a command.
 */
#ifndef GLAISE_STATION_COMMAND_H
#define GLAISE_STATION_COMMAND_H

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

enum command_kind {
    /* devices, as they report */
    COMMAND_PUCK,
    COMMAND_BUTTON,
    COMMAND_PEDAL,
    COMMAND_MOUSE,
    COMMAND_RECORDING,
    /* who moves what, and what a press means */
    COMMAND_MOVES,
    COMMAND_MEANS_PEDAL,
    COMMAND_MEANS_BUTTON,
    COMMAND_SPEED,
    COMMAND_FILTER,
    /* the stroke */
    COMMAND_APPLY,
    COMMAND_UNDO,
    COMMAND_REDO,
    COMMAND_FORK,
    COMMAND_CLEAR,
    /* the tool */
    COMMAND_TOOL,
    COMMAND_MAKE_TOOL,
    COMMAND_SIZE,
    COMMAND_SCALE,
    COMMAND_BORDER,
    COMMAND_ACTION,
    COMMAND_COLOUR,
    COMMAND_RATE,
    COMMAND_SPACING,
    COMMAND_DEFORM,
    COMMAND_PLACE,
    COMMAND_TURN,
    COMMAND_GLIDE,
    COMMAND_SPIN,
    COMMAND_ORBIT,
    /* the picture */
    COMMAND_VIEW,
    COMMAND_DISTANCE,
    COMMAND_CENTRE,
    COMMAND_LOOK,
    COMMAND_STRUCTURE,
    COMMAND_SCENERY,
    COMMAND_SCENERY_PICTURE,
    COMMAND_ENVIRONMENT,
    COMMAND_ENVIRONMENT_NEXT,
    COMMAND_OCCLUSION,
    COMMAND_SHADOWS,
    COMMAND_FLOOR,
    COMMAND_BLUR,
    COMMAND_MIRROR,
    COMMAND_HOLD,
    COMMAND_STEREO,
    COMMAND_STEREO_EYES,
    COMMAND_STEREO_SWAP,
    COMMAND_LIGHT,
    COMMAND_LIGHT_OFF,
    COMMAND_LIGHT_WITH,
    COMMAND_LIGHTS_SHOWN,
    COMMAND_KEEPING_SHOWN,
    COMMAND_STRIP_SHOWN,
    COMMAND_MATERIAL,
    COMMAND_TOOL_STYLE,
    COMMAND_WORKSPACE,
    COMMAND_WORKSPACE_FIT,
    COMMAND_WORKSPACE_SHOWN,
    COMMAND_PICTURE,
    COMMAND_TURNTABLE,
    COMMAND_EXPORT,
    COMMAND_NAMES_FROM,
    COMMAND_COUNT,
};

enum { COMMAND_NUMBERS = 10, COMMAND_FRAMES_MAX = 9999 };

struct command {
    int64_t time_us = 0;
    command_kind kind = COMMAND_UNDO;
    std::array<double, COMMAND_NUMBERS> number{}; /* arguments in order; words as their place in the form's list */
    std::string name;                             /* the one argument that is a name, if any */
    bool operator==(const command &) const = default;
};

enum command_argument_kind { COMMAND_NUMBER, COMMAND_INTEGER, COMMAND_WORD, COMMAND_RGB, COMMAND_NAME };

struct command_argument {
    const char *name;
    command_argument_kind kind;
    double lo, hi;                           /* numbers and integers, both ends included */
    std::vector<std::string_view> words{};   /* words: the choices */
};

struct command_form {
    command_kind kind;
    std::string_view name;
    std::vector<command_argument> arguments;
    std::string_view does; /* one line for the manual */
};

/* In the order of command_kind. */
std::span<const command_form> command_forms();
/* "size A B C": the form's usage line. */
std::string command_usage(const command_form &form);

/* One command without its time, e.g. "size 6 6 9". On failure nothing, and *expected_out says what was expected. */
std::optional<command> command_parse(std::string_view text, std::string *expected_out);
/* The text that parses back to the same command, without its time. */
std::string command_text(const command &c);

/* The shortest decimal that reads back as v, whatever the locale. */
std::string command_number_text(double v);

#endif
