/* SPDX-License-Identifier: Apache-2.0 */
#include "station/menu_tree.h"

#include "exchange/exchange.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

using sight = menu_now_sight;
using icons = std::vector<snapshot_menu_icon>;
using texts = std::vector<std::string>;

constexpr double TURNTABLE_FRAMES = 72; /* three seconds of film; five degrees each */
constexpr double FIT_DISTANCE = 3.6; /* of half the diagonal: 1 / sin of half the field of view, and some air */

/* White to candle light, and the two that show form by contrast. */
constexpr std::array<uint32_t, MENU_NOW_SWATCHES> LIGHT_SWATCHES = {0xffffff, 0xfff2e0, 0xffdcae, 0xffb46e,
                                                                    0xbcd2ff, 0x7fb0ff, 0xff8c78};

menu_tree_entry leads(const char *label, snapshot_menu_icon icon, menu_tree_ring to, int argument = 0)
{
    menu_tree_entry e;
    e.kind = MENU_TREE_LEADS;
    e.label = label;
    e.icon = icon;
    e.ring = to;
    e.argument = argument;
    return e;
}

menu_tree_entry does(const char *label, snapshot_menu_icon icon, texts lines, bool closes = false)
{
    menu_tree_entry e;
    e.label = label;
    e.icon = icon;
    e.lines = std::move(lines);
    e.closes = closes;
    return e;
}

menu_tree_entry turns(const sight &s, const char *label, snapshot_menu_icon icon, const menu_tree_value &v)
{
    menu_tree_entry e;
    e.kind = MENU_TREE_VALUE;
    e.label = label;
    e.icon = icon;
    e.turned = v;
    e.value = menu_tree_text(v, menu_now(s, v.kind, v.index));
    return e;
}

menu_tree_entry of_kind(menu_tree_entry_kind kind, const char *label, snapshot_menu_icon icon, int argument = 0)
{
    menu_tree_entry e;
    e.kind = kind;
    e.label = label;
    e.icon = icon;
    e.argument = argument;
    return e;
}

/* What a command would be with one word changed. */
menu_tree_entry choice(const sight &s, command_kind kind, size_t argument, int word, snapshot_menu_icon icon,
                       int index = 0)
{
    command c = menu_now(s, kind, index);
    menu_tree_entry e;
    e.chosen = static_cast<int>(c.number[argument]) == word;
    c.number[argument] = word;
    e.label = menu_tree_word(kind, argument, word);
    e.icon = icon;
    e.lines = {command_text(c)};
    return e;
}

std::vector<menu_tree_entry> choices(const sight &s, command_kind kind, size_t argument, const icons &with,
                                     bool closes = false, int index = 0)
{
    std::vector<menu_tree_entry> all;
    const size_t words = command_forms()[kind].arguments[argument].words.size();
    for (size_t w = 0; w < words; w++) {
        all.push_back(choice(s, kind, argument, static_cast<int>(w),
                             w < with.size() ? with[w] : SNAPSHOT_MENU_ICON_NONE, index));
        all.back().closes = closes;
    }
    return all;
}

menu_tree_entry toggles(const sight &s, const char *label, command_kind kind)
{
    command c = menu_now(s, kind);
    const bool on = c.number[0] == 1;
    c.number[0] = on ? 0 : 1;
    menu_tree_entry e = does(label, on ? SNAPSHOT_MENU_ICON_ON : SNAPSHOT_MENU_ICON_OFF, {command_text(c)});
    e.value = on ? "on" : "off";
    e.chosen = on;
    return e;
}

std::string line(std::string text, std::initializer_list<double> numbers)
{
    for (const double n : numbers)
        text += " " + command_number_text(n);
    return text;
}

menu_tree_entry swatch(uint32_t rgb, const command &setter, size_t argument)
{
    command c = setter;
    c.number[argument] = rgb;
    menu_tree_entry e = does("", SNAPSHOT_MENU_ICON_SWATCH, {command_text(c)}, true);
    e.swatch = rgb;
    e.chosen = setter.number[argument] == rgb;
    return e;
}

/* --- the tool --- */

bool is_freeform(const sight &s) { return s.tool->shape == HAND_FREEFORM && s.tool->has_freeform; }

menu_tree_value size_value(const sight &s, size_t first, size_t last)
{
    if (is_freeform(s))
        return {COMMAND_SCALE, 0, first, last, MENU_TREE_TIMES, 0.05, 20, 100, "%"};
    return {COMMAND_SIZE, 0, first, last, MENU_TREE_TIMES, 0.2, 500, 1, "mm"};
}

menu_tree_page tool_page(const sight &s)
{
    return {"tool",
            {turns(s, "size", SNAPSHOT_MENU_ICON_SIZE, size_value(s, 0, 2)),
             leads("shape", SNAPSHOT_MENU_ICON_BALL, MENU_TREE_SHAPE),
             leads("stretch", SNAPSHOT_MENU_ICON_STRETCH, MENU_TREE_STRETCH),
             turns(s, "strength", SNAPSHOT_MENU_ICON_RATE,
                   {COMMAND_RATE, 0, 0, 0, MENU_TREE_TIMES, 0.05, 500, 1, "a second"}),
             leads("place", SNAPSHOT_MENU_ICON_AIM, MENU_TREE_PLACE),
             turns(s, "spacing", SNAPSHOT_MENU_ICON_SPACING,
                   {COMMAND_SPACING, 0, 0, 0, MENU_TREE_TIMES, 0.02, 1, 100, "%"}),
             turns(s, "edge", SNAPSHOT_MENU_ICON_EDGE,
                   {COMMAND_BORDER, 0, 0, 0, MENU_TREE_TIMES, 0.01, 1, 100, "%"}),
             leads("bulge", SNAPSHOT_MENU_ICON_BULGE, MENU_TREE_BULGE)}};
}

menu_tree_page shape_page(const sight &s)
{
    menu_tree_page p{"shape", choices(s, COMMAND_TOOL, 0, {SNAPSHOT_MENU_ICON_BALL, SNAPSHOT_MENU_ICON_CUBE,
                                                          SNAPSHOT_MENU_ICON_STAR}, true)};
    p.entries[0].label = "round";
    p.entries[1].label = "firm";
    p.entries[2].label = "made";
    p.entries[2].value = s.tool->has_freeform ? "" : "none yet";
    p.entries.push_back(
        does("of the clay", SNAPSHOT_MENU_ICON_ADD,
             s.has_piece ? texts{"make-tool", "tool freeform"} : texts{"make-tool"}, true));
    return p;
}

menu_tree_page stretch_page(const sight &s)
{
    const command now = menu_now(s, is_freeform(s) ? COMMAND_SCALE : COMMAND_SIZE);
    command even = now; /* as much clay as before, about */
    even.number[0] = even.number[1] = even.number[2] = (now.number[0] + now.number[1] + now.number[2]) / 3;
    return {"stretch",
            {turns(s, "height", SNAPSHOT_MENU_ICON_STRETCH, size_value(s, 1, 1)),
             turns(s, "width", SNAPSHOT_MENU_ICON_STRETCH, size_value(s, 0, 0)),
             does("even", SNAPSHOT_MENU_ICON_BALL, {command_text(even)}),
             turns(s, "depth", SNAPSHOT_MENU_ICON_STRETCH, size_value(s, 2, 2))}};
}

menu_tree_page bulge_page(const sight &s)
{
    const auto part = [&](const char *label, size_t n, double least, double most) {
        return turns(s, label, SNAPSHOT_MENU_ICON_BULGE, {COMMAND_DEFORM, 0, n, n, MENU_TREE_EVEN, least, most, 1, ""});
    };
    /* m and r share what s leaves of the potential: 1.5. */
    const auto &now = s.tool->def;
    return {"bulge",
            {part("height", 3, 0, 3), part("width", 2, 0.01, 1.49 - now.m), part("steepness", 4, 0, 20),
             part("top", 1, 0.01, 1.49 - now.r)}};
}

menu_tree_page place_page(const sight &s)
{
    const auto &c = s.shown->centre, &at = s.tool->pose.place;
    return {"place",
            {does("bring it here", SNAPSHOT_MENU_ICON_TAKE, {line("place", {c[0], c[1], c[2]})}, true),
             does("look at it", SNAPSHOT_MENU_ICON_EYE, {line("centre", {at[0], at[1], at[2]})}, true),
             does("upright", SNAPSHOT_MENU_ICON_STRETCH, {"turn 0 1 0 0"}, true),
             leads("drawn as", SNAPSHOT_MENU_ICON_BALL, MENU_TREE_STYLE)}};
}

menu_tree_page colour_page(const sight &s, int light)
{
    const bool tool = light == MENU_TREE_OF_TOOL;
    const command now = menu_now(s, tool ? COMMAND_COLOUR : COMMAND_LIGHT, tool ? 0 : light);
    menu_tree_page p{"colour", {of_kind(MENU_TREE_MIXES, "mix", SNAPSHOT_MENU_ICON_PAINT, light)}};
    p.entries[0].closes = tool;
    for (const uint32_t rgb : tool ? s.swatches : LIGHT_SWATCHES) {
        p.entries.push_back(swatch(rgb, now, tool ? 0 : 4));
        p.entries.back().closes = tool;
    }
    return p;
}

/* --- the picture --- */

std::vector<std::string> fit_lines(const sight &s)
{
    const motion_vector lo = s.has_piece ? s.lo : s.shown->base.box_lo, hi = s.has_piece ? s.hi : s.shown->base.box_hi;
    const motion_vector middle = {(lo[0] + hi[0]) / 2, (lo[1] + hi[1]) / 2, (lo[2] + hi[2]) / 2};
    const double half = motion_length(motion_sum(hi, lo, -1)) / 2;
    return {line("centre", {middle[0], middle[1], middle[2]}), line("distance", {std::max(0.1, half * FIT_DISTANCE)})};
}

menu_tree_page view_page(const sight &s)
{
    const double mm = s.shown->base.camera_distance;
    const auto from = [mm](const char *label, double x, double y, double degrees) {
        return does(label, SNAPSHOT_MENU_ICON_CUBE, {line("view", {x, y, 0, degrees, mm})});
    };
    return {"view",
            {from("top", 1, 0, 90), from("back", 0, 1, 180), from("right", 0, 1, -90),
             turns(s, "nearer", SNAPSHOT_MENU_ICON_NEARER,
                   {COMMAND_DISTANCE, 0, 0, 0, MENU_TREE_TIMES, 1, 1e5, 1, "mm away"}),
             from("below", 1, 0, -90), from("front", 0, 1, 0), from("left", 0, 1, 90),
             does("all of it", SNAPSHOT_MENU_ICON_BOX, fit_lines(s))}};
}

menu_tree_page lights_page(const sight &s)
{
    menu_tree_page p{"light", {}};
    for (int n = 0; n < SNAPSHOT_LIGHTS; n++) {
        p.entries.push_back(leads("", SNAPSHOT_MENU_ICON_SUN, MENU_TREE_LIGHT, n));
        p.entries.back().label = "light " + std::to_string(n + 1);
        p.entries.back().chosen = s.shown->base.lights[static_cast<size_t>(n)].lit;
        p.entries.back().value = p.entries.back().chosen ? "on" : "off";
    }
    p.entries.push_back(leads("scenery", SNAPSHOT_MENU_ICON_PICTURE, MENU_TREE_SCENERY));
    p.entries.push_back(leads("glaze", SNAPSHOT_MENU_ICON_LOOK, MENU_TREE_GLAZE));
    p.entries.push_back(leads("shine", SNAPSHOT_MENU_ICON_BALL, MENU_TREE_SHINE));
    p.entries.push_back(toggles(s, "lamps", COMMAND_LIGHTS_SHOWN));
    return p;
}

menu_tree_page light_page(const sight &s, int n)
{
    const snapshot_light &l = s.shown->base.lights[static_cast<size_t>(n)];
    menu_tree_entry on = does("lit", l.lit ? SNAPSHOT_MENU_ICON_ON : SNAPSHOT_MENU_ICON_OFF,
                              {command_text(menu_now(s, l.lit ? COMMAND_LIGHT_OFF : COMMAND_LIGHT, n))});
    on.value = l.lit ? "on" : "off";
    on.chosen = l.lit;
    menu_tree_entry with = choice(s, COMMAND_LIGHT_WITH, 1, l.with_viewer ? 0 : 1, SNAPSHOT_MENU_ICON_EYE, n);
    with.label = "goes with";
    with.value = l.with_viewer ? "the viewer" : "the piece";
    menu_tree_entry colour = leads("colour", SNAPSHOT_MENU_ICON_SWATCH, MENU_TREE_COLOUR, n);
    colour.swatch = menu_now_rgb(l.colour);
    return {"light " + std::to_string(n + 1),
            {on, colour,
             turns(s, "strength", SNAPSHOT_MENU_ICON_SUN,
                   {COMMAND_LIGHT, n, 5, 5, MENU_TREE_TIMES, 0.02, 20, 100, "%"}),
             with, of_kind(MENU_TREE_CARRIES, "move", SNAPSHOT_MENU_ICON_MOVE, n)}};
}

menu_tree_page glaze_page(const sight &s)
{
    menu_tree_page p{"glaze", choices(s, COMMAND_ENVIRONMENT, 0, {SNAPSHOT_MENU_ICON_OFF, SNAPSHOT_MENU_ICON_BALL,
                                                                 SNAPSHOT_MENU_ICON_LOOK, SNAPSHOT_MENU_ICON_LOOK})};
    p.entries[1].label = "metal";
    p.entries[2].label = "slip";
    p.entries[3].label = "clear coat";
    p.entries.push_back(turns(s, "strength", SNAPSHOT_MENU_ICON_RATE,
                              {COMMAND_ENVIRONMENT, 0, 1, 1, MENU_TREE_EVEN, 0, 1, 100, "%"}));
    return p;
}

menu_tree_page shine_page(const sight &s)
{
    const auto part = [&](const char *label, size_t n) {
        return turns(s, label, SNAPSHOT_MENU_ICON_BALL, {COMMAND_MATERIAL, 0, n, n, MENU_TREE_EVEN, 0, 1, 100, "%"});
    };
    return {"shine",
            {part("gloss", 0),
             turns(s, "polish", SNAPSHOT_MENU_ICON_BALL, {COMMAND_MATERIAL, 0, 1, 1, MENU_TREE_TIMES, 1, 1000, 1, ""}),
             part("light all round", 2)}};
}

menu_tree_page look_page(const sight &s)
{
    const auto part = [&](const char *label, command_kind kind) {
        return turns(s, label, SNAPSHOT_MENU_ICON_LOOK, {kind, 0, 0, 0, MENU_TREE_EVEN, 0, 1, 100, "%"});
    };
    return {"look",
            {leads("seen as", SNAPSHOT_MENU_ICON_LOOK, MENU_TREE_LOOKS), toggles(s, "shadows", COMMAND_SHADOWS),
             part("hollows", COMMAND_OCCLUSION), toggles(s, "turntable", COMMAND_FLOOR),
             leads("stereo", SNAPSHOT_MENU_ICON_STEREO, MENU_TREE_STEREO), toggles(s, "mirror", COMMAND_MIRROR),
             part("blur", COMMAND_BLUR), leads("inside", SNAPSHOT_MENU_ICON_CUBE, MENU_TREE_STRUCTURE)}};
}

menu_tree_page stereo_page(const sight &s)
{
    const auto eyes = [&](const char *label, size_t n, double least, double most) {
        return turns(s, label, SNAPSHOT_MENU_ICON_STEREO,
                     {COMMAND_STEREO_EYES, 0, n, n, MENU_TREE_EVEN, least, most, 100, "%"});
    };
    const snapshot_menu_icon icon = SNAPSHOT_MENU_ICON_STEREO;
    menu_tree_entry flat = choice(s, COMMAND_STEREO, 0, SNAPSHOT_LAYOUT_MONO, SNAPSHOT_MENU_ICON_OFF);
    flat.label = "flat";
    return {"stereo",
            {flat, leads("side by side", icon, MENU_TREE_STEREO_SIDE), leads("one above", icon, MENU_TREE_STEREO_TOP),
             leads("woven", icon, MENU_TREE_STEREO_WOVEN),
             choice(s, COMMAND_STEREO, 0, SNAPSHOT_LAYOUT_ANAGLYPH, icon), eyes("apart", 0, 0, 0.2),
             eyes("depth", 1, 0.25, 4), toggles(s, "swapped", COMMAND_STEREO_SWAP)}};
}

menu_tree_page layouts_page(const sight &s, const char *title, const std::vector<snapshot_layout> &layouts)
{
    menu_tree_page p{title, {}};
    for (const snapshot_layout l : layouts)
        p.entries.push_back(choice(s, COMMAND_STEREO, 0, l, SNAPSHOT_MENU_ICON_STEREO));
    return p;
}

/* --- the piece --- */

std::string numbered(const char *what, const sight &s, const std::string &ending)
{
    char number[16];
    std::snprintf(number, sizeof number, "-%03d.", s.name);
    return what + std::string(number) + ending;
}

menu_tree_page piece_page(const sight &s)
{
    menu_tree_entry picture = does("picture", SNAPSHOT_MENU_ICON_PICTURE, {"picture " + numbered("picture", s, "png")});
    picture.value = numbered("picture", s, "png");
    std::string turned = numbered("round", s, "");
    turned.pop_back(); /* each picture's own number and ending come behind it */
    return {"piece",
            {does("redo", SNAPSHOT_MENU_ICON_REDO, {"redo"}),
             does("other branch", SNAPSHOT_MENU_ICON_FORK, {"fork"}), picture,
             leads("as a file", SNAPSHOT_MENU_ICON_EXPORT, MENU_TREE_EXPORT),
             leads("clear all", SNAPSHOT_MENU_ICON_CLEAR, MENU_TREE_CLEAR),
             leads("workspace", SNAPSHOT_MENU_ICON_BOX, MENU_TREE_WORKSPACE),
             does("undo", SNAPSHOT_MENU_ICON_UNDO, {"undo"}),
             does("once round", SNAPSHOT_MENU_ICON_PICTURE, {line("turntable " + turned, {TURNTABLE_FRAMES})})}};
}

menu_tree_page clear_page()
{
    return {"clear all",
            {of_kind(MENU_TREE_BACK, "keep it", SNAPSHOT_MENU_ICON_PIECE),
             does("take all clay away", SNAPSHOT_MENU_ICON_CLEAR, {"clear"}, true)}};
}

menu_tree_page export_page(const sight &s)
{
    menu_tree_page p{"as a file", {}};
    const std::string endings = exchange_endings();
    for (size_t from = 0; from < endings.size();) {
        const size_t to = std::min(endings.find(' ', from), endings.size());
        std::string ending = endings.substr(from, to - from);
        from = to + 1;
        ending.erase(0, ending.find_first_not_of("."));
        const std::string name = numbered("piece", s, ending);
        p.entries.push_back(does(ending.c_str(), SNAPSHOT_MENU_ICON_EXPORT, {"export " + name}));
        p.entries.back().value = name;
    }
    return p;
}

menu_tree_page workspace_page(const sight &s)
{
    return {"workspace",
            {does("round the piece", SNAPSHOT_MENU_ICON_BOX, {"workspace-fit"}),
             turns(s, "size", SNAPSHOT_MENU_ICON_SIZE, {COMMAND_WORKSPACE, 0, 0, 5, MENU_TREE_BOX, 1, 1e4, 1, "mm"}),
             toggles(s, "box", COMMAND_WORKSPACE_SHOWN)}};
}

/* --- the station --- */

menu_tree_page station_page()
{
    return {"station",
            {leads("feel", SNAPSHOT_MENU_ICON_PUCK, MENU_TREE_FEEL),
             leads("what moves what", SNAPSHOT_MENU_ICON_MOVE, MENU_TREE_MOVES),
             leads("screen", SNAPSHOT_MENU_ICON_PICTURE, MENU_TREE_SCREEN),
             of_kind(MENU_TREE_LEARNS, "a pedal, a button", SNAPSHOT_MENU_ICON_PEDAL)}};
}

menu_tree_page moves_page(const sight &s)
{
    menu_tree_page p{"what moves what", {}};
    const size_t devices = command_forms()[COMMAND_MOVES].arguments[0].words.size();
    for (size_t d = 0; d < devices; d++) {
        p.entries.push_back(leads("", SNAPSHOT_MENU_ICON_PUCK, MENU_TREE_MOVED, static_cast<int>(d)));
        p.entries.back().label = d == 0 ? "mouse" : "puck " + std::to_string(d);
        p.entries.back().value = menu_tree_word(COMMAND_MOVES, 1, s.devices->moves[d]);
    }
    return p;
}

menu_tree_page moved_page(const sight &s, int device)
{
    return {device == 0 ? "mouse" : "puck " + std::to_string(device),
            choices(s, COMMAND_MOVES, 1, icons(7, SNAPSHOT_MENU_ICON_MOVE), false, device)};
}

/* Too many for one ring: the eighth sector of the first leads to the rest. */
menu_tree_page means_page(const sight &s, int press, bool more)
{
    const bool button = press >= MENU_TREE_BUTTON;
    const int index = button ? press - MENU_TREE_BUTTON : press;
    const command_kind kind = button ? COMMAND_MEANS_BUTTON : COMMAND_MEANS_PEDAL;
    menu_tree_page p{(button ? "button " : "pedal ") + std::to_string(index + 1), {}};
    /* What a hand wants most comes first. */
    const std::vector<int> first = {CONTROLS_MEANS_APPLY,  CONTROLS_MEANS_UNDO, CONTROLS_MEANS_REDO,
                                    CONTROLS_MEANS_CLUTCH, CONTROLS_MEANS_MENU, CONTROLS_MEANS_NEXT_ACTION,
                                    CONTROLS_MEANS_NOTHING};
    const auto words = static_cast<int>(command_forms()[kind].arguments[1].words.size());
    for (int w = 0; w < words; w++)
        if (more && std::find(first.begin(), first.end(), w) == first.end())
            p.entries.push_back(choice(s, kind, 1, w, SNAPSHOT_MENU_ICON_NONE, index));
    if (!more) {
        for (const int w : first)
            p.entries.push_back(choice(s, kind, 1, w, SNAPSHOT_MENU_ICON_NONE, index));
        p.entries.push_back(leads("more", SNAPSHOT_MENU_ICON_NONE, MENU_TREE_MEANS_MORE, press));
    }
    return p;
}

menu_tree_page feel_page(const sight &s)
{
    return {"feel",
            {turns(s, "moving", SNAPSHOT_MENU_ICON_MOVE,
                   {COMMAND_SPEED, 0, 0, 0, MENU_TREE_TIMES, 5, 1000, 1, "mm a second"}),
             turns(s, "turning", SNAPSHOT_MENU_ICON_REDO,
                   {COMMAND_SPEED, 0, 1, 1, MENU_TREE_TIMES, 5, 720, 1, "\xc2\xb0 a second"}),
             turns(s, "dead zone", SNAPSHOT_MENU_ICON_AIM, {COMMAND_FILTER, 0, 0, 0, MENU_TREE_EVEN, 0, 0.5, 100, "%"}),
             turns(s, "gentleness", SNAPSHOT_MENU_ICON_PUCK,
                   {COMMAND_FILTER, 0, 1, 1, MENU_TREE_EVEN, 0, 1, 100, "%"})}};
}

menu_tree_page screen_page(const sight &s)
{
    return {"screen",
            {toggles(s, "this strip", COMMAND_STRIP_SHOWN), toggles(s, "kept or not", COMMAND_KEEPING_SHOWN)}};
}

menu_tree_page root_page(const sight &s)
{
    menu_tree_page p{"menu",
                     {leads("tool", SNAPSHOT_MENU_ICON_BALL, MENU_TREE_TOOL),
                      leads("action", SNAPSHOT_MENU_ICON_ADD, MENU_TREE_ACTION),
                      leads("colour", SNAPSHOT_MENU_ICON_SWATCH, MENU_TREE_COLOUR, MENU_TREE_OF_TOOL),
                      leads("view", SNAPSHOT_MENU_ICON_EYE, MENU_TREE_VIEW),
                      leads("light", SNAPSHOT_MENU_ICON_SUN, MENU_TREE_LIGHTS),
                      leads("look", SNAPSHOT_MENU_ICON_LOOK, MENU_TREE_LOOK),
                      leads("piece", SNAPSHOT_MENU_ICON_PIECE, MENU_TREE_PIECE),
                      leads("station", SNAPSHOT_MENU_ICON_PUCK, MENU_TREE_STATION)}};
    p.entries[1].value = menu_tree_word(COMMAND_ACTION, 0, s.tool->kind);
    p.entries[2].swatch = static_cast<uint32_t>(menu_now(s, COMMAND_COLOUR).number[0]);
    return p;
}

menu_tree_page picture_page(menu_tree_ring which, const sight &s)
{
    const snapshot_menu_icon look = SNAPSHOT_MENU_ICON_LOOK, cube = SNAPSHOT_MENU_ICON_CUBE;
    switch (which) {
    case MENU_TREE_SCENERY: return {"scenery", choices(s, COMMAND_SCENERY, 0, icons(8, SNAPSHOT_MENU_ICON_PICTURE))};
    case MENU_TREE_GLAZE: return glaze_page(s);
    case MENU_TREE_SHINE: return shine_page(s);
    case MENU_TREE_LOOK: return look_page(s);
    case MENU_TREE_LOOKS: return {"seen as", choices(s, COMMAND_LOOK, 0, icons(8, look))};
    case MENU_TREE_STRUCTURE: return {"inside", choices(s, COMMAND_STRUCTURE, 0, icons(8, cube))};
    case MENU_TREE_STEREO_SIDE:
        return layouts_page(s, "side by side", {SNAPSHOT_LAYOUT_SIDE_HALF, SNAPSHOT_LAYOUT_SIDE_FULL});
    case MENU_TREE_STEREO_TOP:
        return layouts_page(s, "one above",
                            {SNAPSHOT_LAYOUT_TOP_HALF, SNAPSHOT_LAYOUT_TOP_FULL, SNAPSHOT_LAYOUT_PACKED});
    case MENU_TREE_STEREO_WOVEN:
        return layouts_page(s, "woven", {SNAPSHOT_LAYOUT_ROWS, SNAPSHOT_LAYOUT_COLUMNS, SNAPSHOT_LAYOUT_CHECKER});
    default: return stereo_page(s);
    }
}

} // namespace

menu_tree_page menu_tree_make(menu_tree_ring which, int argument, const menu_now_sight &s)
{
    const icons acts = {SNAPSHOT_MENU_ICON_ADD,   SNAPSHOT_MENU_ICON_TAKE,   SNAPSHOT_MENU_ICON_CLEAR,
                        SNAPSHOT_MENU_ICON_PAINT, SNAPSHOT_MENU_ICON_PAINT,  SNAPSHOT_MENU_ICON_SMOOTH,
                        SNAPSHOT_MENU_ICON_STAMP, SNAPSHOT_MENU_ICON_STAMP};
    switch (which) {
    case MENU_TREE_ROOT: return root_page(s);
    case MENU_TREE_TOOL: return tool_page(s);
    case MENU_TREE_SHAPE: return shape_page(s);
    case MENU_TREE_STRETCH: return stretch_page(s);
    case MENU_TREE_BULGE: return bulge_page(s);
    case MENU_TREE_PLACE: return place_page(s);
    case MENU_TREE_STYLE: return {"drawn as", choices(s, COMMAND_TOOL_STYLE, 0, icons(8, SNAPSHOT_MENU_ICON_BALL))};
    case MENU_TREE_ACTION: return {"action", choices(s, COMMAND_ACTION, 0, acts, true)};
    case MENU_TREE_COLOUR: return colour_page(s, argument);
    case MENU_TREE_VIEW: return view_page(s);
    case MENU_TREE_LIGHTS: return lights_page(s);
    case MENU_TREE_LIGHT: return light_page(s, argument);
    case MENU_TREE_PIECE: return piece_page(s);
    case MENU_TREE_CLEAR: return clear_page();
    case MENU_TREE_EXPORT: return export_page(s);
    case MENU_TREE_WORKSPACE: return workspace_page(s);
    case MENU_TREE_STATION: return station_page();
    case MENU_TREE_MOVES: return moves_page(s);
    case MENU_TREE_MOVED: return moved_page(s, argument);
    case MENU_TREE_MEANS: return means_page(s, argument, false);
    case MENU_TREE_MEANS_MORE: return means_page(s, argument, true);
    case MENU_TREE_FEEL: return feel_page(s);
    case MENU_TREE_SCREEN: return screen_page(s);
    default: return picture_page(which, s);
    }
}

double menu_tree_number(const menu_tree_value &v, const command &now)
{
    const auto &n = now.number;
    if (v.law == MENU_TREE_BOX)
        return std::max({n[3] - n[0], n[4] - n[1], n[5] - n[2]});
    return *std::max_element(&n[v.first], &n[v.last] + 1);
}

std::string menu_tree_text(const menu_tree_value &v, const command &now)
{
    const double shown = menu_tree_number(v, now) * v.shown_times;
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", shown < 1 ? 2 : shown < 100 ? 1 : 0, shown);
    std::string out(text);
    std::replace(out.begin(), out.end(), ',', '.'); /* whatever the locale */
    return *v.unit ? out + " " + v.unit : out;
}

std::string menu_tree_word(command_kind kind, size_t argument, double number)
{
    std::string word(command_forms()[kind].arguments[argument].words[static_cast<size_t>(number)]);
    std::replace(word.begin(), word.end(), '-', ' ');
    if (kind == COMMAND_MOVES && word.starts_with("light"))
        word = "light " + std::to_string(std::stoi(word.substr(5)) + 1);
    return word;
}
