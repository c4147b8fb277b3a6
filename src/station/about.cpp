/* SPDX-License-Identifier: Apache-2.0 */
#include "station/about.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace {

constexpr std::string_view HEADING = "glaise piece 1", COPY = " (copy)";
constexpr std::array<std::string_view, 3> STATES = {"on", "aside", "discarded"};

/* The next character of a UTF-8 text that is not empty, in its shortest form; nothing when that is none. */
std::optional<uint32_t> character_take(std::string_view *rest)
{
    const auto byte = [rest](size_t n) { return static_cast<uint8_t>((*rest)[n]); };
    const uint32_t first = byte(0);
    const size_t length =
        first < 0x80 ? 1 : first < 0xc0 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf8 ? 4 : 0;
    if (length == 0 || rest->size() < length)
        return std::nullopt;
    uint32_t code = length == 1 ? first : first & (0x7fu >> length);
    for (size_t n = 1; n < length; n++) {
        if ((byte(n) & 0xc0) != 0x80)
            return std::nullopt;
        code = code << 6 | (byte(n) & 0x3f);
    }
    constexpr std::array<uint32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
    if (code < least[length] || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff))
        return std::nullopt;
    rest->remove_prefix(length);
    return code;
}

bool is_control(uint32_t code)
{
    const bool ends_a_line = code == 0x2028 || code == 0x2029;
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || ends_a_line;
}

std::optional<about_state> state_of(std::string_view word)
{
    for (size_t n = 0; n < STATES.size(); n++)
        if (STATES[n] == word)
            return static_cast<about_state>(n);
    return std::nullopt;
}

/* Only as it would be written: no sign, no leading zero. */
std::optional<uint64_t> turn_of(std::string_view word)
{
    uint64_t turn = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), turn);
    if (error != std::errc() || turn > ABOUT_TURN_MAX || std::to_string(turn) != word)
        return std::nullopt;
    return turn;
}

/* The rest of the next line behind `key`; nothing when the line is not such. */
std::optional<std::string_view> value_take(std::string_view *text, std::string_view key)
{
    const size_t end = text->find('\n');
    if (end == std::string_view::npos || !text->starts_with(key) || end < key.size())
        return std::nullopt;
    const std::string_view value = text->substr(key.size(), end - key.size());
    text->remove_prefix(end + 1);
    return value;
}

} // namespace

std::optional<about> about_parse(std::string_view text, about_trouble *trouble_out)
{
    const auto refuse = [trouble_out](int line, std::string expected) {
        *trouble_out = {line, std::move(expected)};
        return std::nullopt;
    };
    about a;
    const auto heading = value_take(&text, HEADING);
    if (!heading || !heading->empty())
        return refuse(1, "expected \"" + std::string(HEADING) + "\"");
    const auto name = value_take(&text, "name ");
    if (!name)
        return refuse(2, "expected \"name\" and a name");
    const std::string trouble = about_name_trouble(*name);
    if (!trouble.empty())
        return refuse(2, trouble);
    const auto word = value_take(&text, "state ");
    const auto state = word ? state_of(*word) : std::nullopt;
    if (!state)
        return refuse(3, "expected \"state\" and on, aside or discarded");
    const auto digits = value_take(&text, "turn ");
    const auto turn = digits ? turn_of(*digits) : std::nullopt;
    if (!turn)
        return refuse(4, "expected \"turn\" and a number up to " + std::to_string(ABOUT_TURN_MAX));
    if (!text.empty())
        return refuse(5, "expected nothing more");
    return about{std::string(*name), *state, *turn};
}

std::string about_text(const about &a)
{
    return std::string(HEADING) + "\nname " + a.name + "\nstate " + std::string(about_state_word(a.state)) + "\nturn " +
           std::to_string(a.turn) + "\n";
}

std::string about_name_trouble(std::string_view name)
{
    if (name.empty() || name.size() > ABOUT_NAME_BYTES_MAX)
        return "expected a name of 1 to " + std::to_string(ABOUT_NAME_BYTES_MAX) + " bytes, not " +
               std::to_string(name.size());
    if (name.find_first_not_of(' ') == std::string_view::npos)
        return "expected a name of more than spaces";
    for (std::string_view rest = name; !rest.empty();) {
        const std::string at = "byte " + std::to_string(name.size() - rest.size() + 1) + " of the name: ";
        const auto code = character_take(&rest);
        if (!code)
            return at + "expected UTF-8";
        if (is_control(*code))
            return at + "expected no control character";
    }
    return "";
}

std::string_view about_state_word(about_state s) { return STATES[s]; }

std::string about_copy_name(std::string_view name)
{
    size_t n = std::min(name.size(), ABOUT_NAME_BYTES_MAX - COPY.size());
    while (n < name.size() && n > 0 && (static_cast<uint8_t>(name[n]) & 0xc0) == 0x80)
        n--; /* not amid a character */
    return std::string(name.substr(0, n)) + std::string(COPY);
}
