/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: all that the station can do is reached by puck and pedals; nothing in the menu is more than a ring can show.
 * Method: the whole tree is walked, with an ellipsoid and with a made tool in the hand; every command of every sector is
 *         parsed, every number turned to both its ends. What is not reached must be on the list below, with its reason. */
#include "station/menu.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>

namespace {

const std::map<command_kind, const char *> exempt = {
    {COMMAND_PUCK, "a device's report"},
    {COMMAND_BUTTON, "a device's report"},
    {COMMAND_PEDAL, "a device's report"},
    {COMMAND_MOUSE, "a device's report"},
    {COMMAND_RECORDING, "devices' reports, for tapes"},
    {COMMAND_APPLY, "a pedal's and a button's meaning"},
    {COMMAND_HOLD, "for as long as it is held: a pedal's and a button's meaning"},
    {COMMAND_ENVIRONMENT_NEXT, "a pedal's and a button's meaning; the ring has each by name"},
    {COMMAND_GLIDE, "a pose in time, for tapes: the puck does it by hand"},
    {COMMAND_SPIN, "a pose in time, for tapes: the puck does it by hand"},
    {COMMAND_ORBIT, "a pose in time, for tapes: the puck does it by hand"},
    {COMMAND_SCENERY_PICTURE, "names a file that somebody brought; the ring has what was brought last"},
    {COMMAND_NAMES_FROM, "set by whoever knows which names are taken"},
};

/* Arguments whose words need not all be reached one by one. */
bool is_subject(const std::string &argument) { return argument == "DEVICE" || argument == "EDGE"; }

struct walker {
    hand tool;
    showing shown;
    controls devices = controls_at_first();
    menu_now_sight sight{&tool, &shown, &devices};
    std::set<command_kind> kinds;
    std::map<command_kind, std::map<size_t, std::set<int>>> words;
    std::map<command_kind, std::set<size_t>> turned;
    std::set<std::pair<int, int>> seen;

    walker()
    {
        for (size_t n = 0; n < sight.swatches.size(); n++)
            sight.swatches[n] = static_cast<uint32_t>(n);
    }
    void note(const command &c)
    {
        kinds.insert(c.kind);
        const command_form &form = command_forms()[c.kind];
        for (size_t a = 0; a < form.arguments.size(); a++)
            if (form.arguments[a].kind == COMMAND_WORD)
                words[c.kind][a].insert(static_cast<int>(c.number[a]));
    }
    void entry(const menu_tree_entry &e)
    {
        for (const std::string &line : e.lines) {
            std::string expected;
            const std::optional<command> c = command_parse(line, &expected);
            ASSERT_TRUE(c) << e.label << ": " << line << ": " << expected;
            note(*c);
        }
        if (e.kind == MENU_TREE_MIXES)
            kinds.insert(e.argument == MENU_TREE_OF_TOOL ? COMMAND_COLOUR : COMMAND_LIGHT);
        if (e.kind == MENU_TREE_VALUE) {
            const menu_tree_value &v = e.turned;
            note(menu_now(sight, v.kind, v.index));
            for (size_t n = v.first; n <= v.last; n++) {
                turned[v.kind].insert(n);
                const command_argument &a = command_forms()[v.kind].arguments[n];
                if (v.law != MENU_TREE_BOX) {
                    EXPECT_GE(v.least, a.lo) << e.label;
                    EXPECT_LE(v.most, a.hi) << e.label;
                }
                EXPECT_LT(v.least, v.most) << e.label;
            }
        }
        if (e.kind == MENU_TREE_LEADS)
            walk(e.ring, e.argument);
        if (e.kind == MENU_TREE_LEARNS) /* any press may follow */
            for (const int press : {0, 7, MENU_TREE_BUTTON + 0, MENU_TREE_BUTTON + 31})
                walk(MENU_TREE_MEANS, press);
    }
    void walk(menu_tree_ring ring, int argument)
    {
        if (!seen.insert({ring, argument}).second)
            return;
        const menu_tree_page page = menu_tree_make(ring, argument, sight);
        EXPECT_FALSE(page.title.empty());
        EXPECT_GE(page.entries.size(), 2u) << page.title;
        EXPECT_LE(page.entries.size(), static_cast<size_t>(SNAPSHOT_MENU_SECTORS)) << page.title;
        for (const menu_tree_entry &e : page.entries) {
            EXPECT_FALSE(e.label.empty() && e.icon != SNAPSHOT_MENU_ICON_SWATCH) << page.title;
            entry(e);
        }
    }
};

/* Toggles, lights that are on or off, tools: each state offers the other. */
walker walked()
{
    walker all;
    for (const bool other : {false, true}) {
        snapshot &s = all.shown.base;
        s.effects = {0.5f, other, other, 0, other};
        s.eyes.swapped = s.lights_shown = s.keeping_shown = s.strip.shown = s.box_shown = other;
        for (snapshot_light &l : s.lights)
            l.lit = l.with_viewer = other;
        all.tool.shape = other ? HAND_FREEFORM : HAND_ELLIPSOID;
        all.tool.has_freeform = other; /* none is looked into */
        all.sight.has_piece = other;
        all.seen.clear();
        all.walk(MENU_TREE_ROOT, 0);
        EXPECT_EQ(all.seen.empty(), false);
    }
    all.tool.has_freeform = false;
    return all;
}

TEST(menu_tree, every_command_is_reached_or_has_a_reason)
{
    const walker all = walked();
    for (const command_form &form : command_forms()) {
        const bool reached = all.kinds.count(form.kind) != 0;
        EXPECT_NE(reached, exempt.count(form.kind) != 0)
            << form.name << (reached ? " is reached: take it off the list" : " is not reached");
    }
}

TEST(menu_tree, every_word_is_reached)
{
    const walker all = walked();
    for (const command_form &form : command_forms()) {
        if (exempt.count(form.kind) != 0)
            continue;
        for (size_t a = 0; a < form.arguments.size(); a++)
            for (size_t w = 0; w < form.arguments[a].words.size(); w++)
                EXPECT_TRUE(all.words.at(form.kind).at(a).count(static_cast<int>(w)) != 0 ||
                            is_subject(form.arguments[a].name))
                    << form.name << " " << form.arguments[a].words[w];
    }
    /* Each device by name. */
    EXPECT_EQ(all.words.at(COMMAND_MOVES).at(0).size(), command_forms()[COMMAND_MOVES].arguments[0].words.size());
}

TEST(menu_tree, every_number_that_is_no_place_is_turned)
{
    const walker all = walked();
    const std::map<command_kind, size_t> numbers = {
        {COMMAND_SPEED, 2}, {COMMAND_FILTER, 2}, {COMMAND_SIZE, 3},        {COMMAND_SCALE, 3},       {COMMAND_BORDER, 1},
        {COMMAND_RATE, 1},  {COMMAND_SPACING, 1}, {COMMAND_DEFORM, 4},     {COMMAND_DISTANCE, 1},    {COMMAND_ENVIRONMENT, 1},
        {COMMAND_BLUR, 1},  {COMMAND_OCCLUSION, 1}, {COMMAND_STEREO_EYES, 2}, {COMMAND_LIGHT, 1}, {COMMAND_MATERIAL, 3},
        {COMMAND_WORKSPACE, 6}};
    for (const auto &[kind, count] : numbers)
        EXPECT_EQ(all.turned.count(kind) ? all.turned.at(kind).size() : 0, count) << command_forms()[kind].name;
}

TEST(menu_tree, every_ring_is_reached)
{
    const walker all = walked();
    std::set<int> rings;
    for (const auto &[which, argument] : all.seen)
        rings.insert(which);
    EXPECT_EQ(rings.size(), static_cast<size_t>(MENU_TREE_RINGS));
}

TEST(menu_tree, what_is_now_is_said_as_the_command_that_sets_it_so)
{
    walker w;
    for (const char *line : {"look raking", "structure crossing", "scenery night", "environment semi 0.25",
                             "occlusion 0.125", "shadows off", "floor off", "blur 0.5", "mirror on", "stereo rows",
                             "stereo-eyes 0.0625 2", "stereo-swap on", "lights-shown off", "keeping-shown on",
                             "strip-shown on", "material 0.5 20 0.25", "tool-style hidden", "workspace -1 -2 -3 4 5 6",
                             "workspace-shown off", "distance 321", "centre 1 2 3"}) {
        const command c = menu_now_line(line);
        showing_do(&w.shown, c);
        EXPECT_EQ(command_text(menu_now(w.sight, c.kind)), line);
    }
    for (const char *line : {"light 2 1 2 3 #123456 0.5 viewer", "light-with 2 viewer"}) {
        const command c = menu_now_line(line);
        showing_do(&w.shown, c);
        EXPECT_EQ(command_text(menu_now(w.sight, c.kind, 2)), line);
    }
    for (const char *line : {"speed 12 34", "filter 0.1 0.75"}) {
        const command c = menu_now_line(line);
        controls_do(&w.devices, c);
        EXPECT_EQ(command_text(menu_now(w.sight, c.kind)), line);
    }
    for (const char *line : {"moves puck1 light2", "means-pedal 1 bare", "means-button 1 menu"}) {
        const command c = menu_now_line(line);
        controls_do(&w.devices, c);
        EXPECT_EQ(command_text(menu_now(w.sight, c.kind, c.kind == COMMAND_MOVES ? 2 : 1)), line);
    }
}

} // namespace
