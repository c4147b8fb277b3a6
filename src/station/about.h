/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The small text that says of a piece what the clay does not: its name, whether it is on the shelf, set aside
 *          or discarded. Text in, values out, and back.
 * Is not:  The file it lies in, or the shelf (shelf.h).
 * Shape:   exactly four lines, each ended by a line feed:
 *              glaise piece 1
 *              name The cat
 *              state on                    or aside, or discarded
 *              turn 12
 *          The turn is the shelf's count of changes of state when this one came about: no clock is needed to know
 *          which piece was discarded first. A text that is read is, written again, the same bytes.
 * Units:   bytes. A name is 1 to ABOUT_NAME_BYTES_MAX bytes of UTF-8 with something to see in it and no control
 *          characters.
 * Owner:   values.
 * Errors:  about_parse: nothing, and the line with what was expected there. A newer version is refused like the rest.
 */
#ifndef GLAISE_STATION_ABOUT_H
#define GLAISE_STATION_ABOUT_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

constexpr size_t ABOUT_NAME_BYTES_MAX = 100;
constexpr size_t ABOUT_BYTES_MAX = 256;           /* of the whole text: more is none */
constexpr uint64_t ABOUT_TURN_MAX = 999999999999; /* of a turn: more than a life holds */

enum about_state { ABOUT_ON, ABOUT_ASIDE, ABOUT_DISCARDED };

struct about {
    std::string name;
    about_state state = ABOUT_ON;
    uint64_t turn = 0;
    bool operator==(const about &) const = default;
};

struct about_trouble {
    int line = 0; /* 1 the first */
    std::string expected;
};

std::optional<about> about_parse(std::string_view text, about_trouble *trouble_out);
std::string about_text(const about &a);

/* Why this cannot be a name: a sentence, empty when it can. */
std::string about_name_trouble(std::string_view name);
std::string_view about_state_word(about_state s);
/* The name of a copy: as much of the name as fits, and what says that it is one. */
std::string about_copy_name(std::string_view name);

#endif
