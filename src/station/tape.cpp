/* SPDX-License-Identifier: Apache-2.0 */
#include "station/tape.h"

#include "sculpture/sculpture.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace {

constexpr std::string_view FIRST_LINE = "glaise tape 1";

std::string_view trimmed(std::string_view line)
{
    if (line.starts_with("#"))
        return {};
    size_t comment = line.find(" # ");
    if (comment != std::string_view::npos)
        line = line.substr(0, comment);
    size_t from = line.find_first_not_of(" \t\r"), to = line.find_last_not_of(" \t\r");
    return from == std::string_view::npos ? std::string_view{} : line.substr(from, to - from + 1);
}

/* The number at the front of text, which it is taken off. */
bool number_take(std::string_view *text, double *out)
{
    auto r = std::from_chars(text->data(), text->data() + text->size(), *out);
    if (r.ec != std::errc{} || !std::isfinite(*out))
        return false;
    size_t used = static_cast<size_t>(r.ptr - text->data());
    if (used < text->size() && (*text)[used] != ' ' && (*text)[used] != '\t')
        return false;
    *text = text->substr(used);
    return true;
}

bool time_take(std::string_view *line, int64_t before_us, int64_t *time_us_out, std::string *expected_out)
{
    char how = line->front();
    double ms = 0;
    *expected_out = "a time such as @1500 or +40, in milliseconds, then a command";
    if (how != '@' && how != '+')
        return false;
    *line = line->substr(1);
    if (!number_take(line, &ms) || ms < 0 || ms * 1000 > static_cast<double>(TAPE_TIME_MAX_US))
        return false;
    *time_us_out = static_cast<int64_t>(std::floor(ms * 1000 + 0.5)) + (how == '+' ? before_us : 0);
    if (*time_us_out < before_us)
        *expected_out = "a time at or after the line before it";
    else if (*time_us_out > TAPE_TIME_MAX_US)
        *expected_out = "a time within 24 hours";
    else
        return true;
    return false;
}

bool step_parse(std::string_view line, bool allowed, double *step_out, std::string *expected_out)
{
    line = line.substr(5);
    *expected_out = "step MM once, before any command, from 0.001 to 1000";
    return allowed && number_take(&line, step_out) && line.empty() && *step_out >= SCULPTURE_STEP_MM_MIN &&
           *step_out <= SCULPTURE_STEP_MM_MAX;
}

bool line_parse(std::string_view line, tape *t, bool *step_known, std::string *expected_out)
{
    if (line.starts_with("step ")) {
        bool allowed = !*step_known && t->commands.empty();
        *step_known = true;
        return step_parse(line, allowed, &t->step_mm, expected_out);
    }
    int64_t time_us = 0, before_us = t->commands.empty() ? 0 : t->commands.back().time_us;
    if (!time_take(&line, before_us, &time_us, expected_out))
        return false;
    std::optional<command> c = command_parse(line, expected_out);
    if (!c)
        return false;
    c->time_us = time_us;
    t->commands.push_back(std::move(*c));
    return true;
}

} // namespace

std::optional<tape> tape_parse(std::string_view text, tape_trouble *trouble_out)
{
    tape t;
    bool step_known = false;
    *trouble_out = {};
    while (!text.empty() || trouble_out->line == 0) {
        size_t end = text.find('\n');
        std::string_view raw = text.substr(0, end), line = trimmed(raw);
        text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
        trouble_out->line++;
        if (trouble_out->line == 1) {
            trouble_out->expected = "\"" + std::string(FIRST_LINE) + "\"";
            if (line != FIRST_LINE)
                return std::nullopt;
        } else if (!line.empty() && !line_parse(line, &t, &step_known, &trouble_out->expected)) {
            return std::nullopt;
        }
    }
    return t;
}

std::string tape_text(const tape &t)
{
    std::string out(FIRST_LINE);
    out += "\nstep " + command_number_text(t.step_mm) + "\n";
    for (const command &c : t.commands)
        out += "@" + command_number_text(static_cast<double>(c.time_us) / 1000) + " " + command_text(c) + "\n";
    return out;
}

int64_t tape_end_us(const tape &t)
{
    int64_t end_us = 0;
    for (const command &c : t.commands) {
        double ms = c.kind == COMMAND_GLIDE ? c.number[3] : c.kind == COMMAND_SPIN ? c.number[4] : 0;
        ms = c.kind == COMMAND_ORBIT ? c.number[7] : ms;
        end_us = std::max(end_us, c.time_us + static_cast<int64_t>(std::ceil(ms * 1000)));
    }
    return end_us;
}
