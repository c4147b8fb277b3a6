/* SPDX-License-Identifier: Apache-2.0 */
#include "station/strip.h"

#include <algorithm>

namespace {

std::string meaning_word(controls_meaning means)
{
    return means == CONTROLS_MEANS_NOTHING ? "\xe2\x80\x93" : menu_tree_word(COMMAND_MEANS_PEDAL, 1, means);
}

/* A menu changes what presses do, and says so where it always stands. */
std::string meaning_in(snapshot_menu_kind kind, controls_meaning means)
{
    const bool chooses = means == CONTROLS_MEANS_APPLY || means == CONTROLS_MEANS_MENU;
    const bool goes_back = means == CONTROLS_MEANS_UNDO;
    switch (kind) {
    case SNAPSHOT_MENU_CLOSED: return meaning_word(means);
    case SNAPSHOT_MENU_RING: return chooses ? "choose" : goes_back ? "back" : "\xe2\x80\x93";
    case SNAPSHOT_MENU_LEARN: return "this one";
    default: return chooses ? "keep" : goes_back ? "as before" : "\xe2\x80\x93";
    }
}

std::string keeping_words(const strip_sight &s)
{
    if (!s.has_history)
        return "";
    switch (s.facts.medium) {
    case HISTORY_MEDIUM_FULL: return "NOT KEPT: disk full";
    case HISTORY_MEDIUM_FAILS: return "NOT KEPT: disk fails";
    default: return s.facts.put != s.facts.kept || s.in_stroke ? "keeping \xe2\x80\xa6" : "kept";
    }
}

std::string mode_words(const strip_sight &s)
{
    if (menu_is_open(*s.open))
        return menu_carries(*s.open) == CONTROLS_NOTHING
                   ? "menu"
                   : menu_tree_word(COMMAND_MOVES, 1, menu_carries(*s.open));
    const controls_thing holds = controls_moved(*s.devices, 0);
    return menu_tree_word(COMMAND_MOVES, 1, holds);
}

std::string size_words(const hand &h)
{
    if (h.shape == HAND_FREEFORM && h.has_freeform)
        return menu_tree_text({COMMAND_SCALE, 0, 0, 2, MENU_TREE_TIMES, 0, 1, 100, "%"},
                              {0, COMMAND_SCALE, {h.scale[0], h.scale[1], h.scale[2]}, ""});
    return menu_tree_text({COMMAND_SIZE, 0, 0, 2, MENU_TREE_TIMES, 0, 1, 1, "mm"},
                          {0, COMMAND_SIZE, {h.size_mm[0], h.size_mm[1], h.size_mm[2]}, ""});
}

/* "middle pedal": where something with this meaning is; "" nowhere. */
std::string press_named(const controls &d, controls_meaning means)
{
    const std::array<const char *, SNAPSHOT_MENU_PEDALS> pedals = {"left pedal", "middle pedal", "right pedal"};
    for (size_t n = 0; n < d.pedal.size(); n++)
        if (d.pedal[n].means == means)
            return n < pedals.size() ? pedals[n] : "pedal " + std::to_string(n + 1);
    for (size_t n = 0; n < d.button.size(); n++)
        if (d.button[n].means == means)
            return n == 0   ? "left button"
                   : n == 1 ? "right button"
                            : "button " + std::to_string(n + 1);
    return "";
}

std::vector<std::array<std::string, 2>> hint_of(const controls &d)
{
    std::vector<std::array<std::string, 2>> all{{"push, lift, tilt, twist the puck", "moves the tool"}};
    const std::array<std::pair<controls_meaning, const char *>, 4> lines = {
        {{CONTROLS_MEANS_APPLY, "hold: the tool works the clay"},
         {CONTROLS_MEANS_UNDO, "takes the last stroke back"},
         {CONTROLS_MEANS_CLUTCH, "hold: the puck turns the piece"},
         {CONTROLS_MEANS_MENU, "opens the menu"}}};
    for (const auto &[means, what] : lines)
        if (const std::string with = press_named(d, means); !with.empty())
            all.push_back({with, what});
    return all;
}

} // namespace

snapshot_menu_strip strip_now(const strip_sight &s)
{
    snapshot_menu_strip out;
    const snapshot_menu_kind kind = s.open->kind;
    out.keeping = keeping_words(s);
    out.mode = mode_words(s);
    for (size_t n = 0; n < out.pedals.size(); n++) {
        out.pedals[n] = meaning_in(kind, s.devices->pedal[n].means);
        out.pedals_down[n] = s.devices->pedal[n].held;
    }
    out.action = menu_tree_word(COMMAND_ACTION, 0, s.tool->kind);
    out.size = size_words(*s.tool);
    out.rate = "strength " + menu_tree_text({COMMAND_RATE, 0, 0, 0, MENU_TREE_TIMES, 0, 1, 1, ""},
                                            {0, COMMAND_RATE, {s.tool->rate}, ""});
    out.undo = s.facts.strokes == 1 ? "1 stroke" : std::to_string(s.facts.strokes) + " strokes";
    for (int n = 0; n < 3; n++)
        out.rgb = out.rgb << 8 | colour_channel(s.tool->rgba, n);
    if (!s.told.empty() && s.now_us - s.told_us < STRIP_TOAST_US)
        out.toast = s.told;
    if (!s.begun && kind == SNAPSHOT_MENU_CLOSED)
        out.hint = hint_of(*s.devices);
    return out;
}
