/* SPDX-License-Identifier: Apache-2.0 */
#include "station/menu.h"

#include "station/angle.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace {

using sight = menu_now_sight;

/* Potter's colours: terracotta, porcelain, stoneware, slip, celadon, cobalt, straw. */
constexpr std::array<uint32_t, MENU_NOW_SWATCHES> FIRST_SWATCHES = {0xc98a62, 0xeee6d8, 0x9c8f7e, 0x3a322c,
                                                                    0x9fb8a0, 0x35508c, 0xd9b25f};

menu_tree_page page_of(const menu &m, const sight &s)
{
    return menu_tree_make(m.way.back().ring, m.way.back().argument, s);
}

/* The sight with what the menu itself remembers. */
sight completed(const menu &m, sight s)
{
    s.swatches = m.swatches;
    s.name = m.name;
    return s;
}

void waits_for_the_puck(menu *m)
{
    m->armed = false;
    m->puck = {};
}

void ring_begin(menu *m)
{
    m->kind = SNAPSHOT_MENU_RING;
    m->way.back().pointed = -1;
    waits_for_the_puck(m);
}

void swatch_add(menu *m, uint32_t rgb)
{
    auto at = std::find(m->swatches.begin(), m->swatches.end(), rgb);
    if (at == m->swatches.end())
        at--; /* the oldest goes */
    *at = rgb;
    std::rotate(m->swatches.begin(), at, at + 1);
}

uint32_t rgb_now(const menu &m, const sight &s)
{
    const bool tool = m.doing.argument == MENU_TREE_OF_TOOL;
    return static_cast<uint32_t>(tool ? menu_now(s, COMMAND_COLOUR).number[0]
                                      : menu_now(s, COMMAND_LIGHT, m.doing.argument).number[4]);
}

/* --- choosing --- */

/* At least one press must go on opening the menu: no other way leads back. */
bool locks_out(const command &c, const sight &s)
{
    if (c.kind != COMMAND_MEANS_PEDAL && c.kind != COMMAND_MEANS_BUTTON)
        return false;
    const controls_meaning was =
        static_cast<controls_meaning>(static_cast<int>(menu_now(s, c.kind, static_cast<int>(c.number[0])).number[1]));
    return was == CONTROLS_MEANS_MENU && static_cast<int>(c.number[1]) != CONTROLS_MEANS_MENU &&
           controls_count(*s.devices, CONTROLS_MEANS_MENU) == 1;
}

menu_answer entry_do(menu *m, const menu_tree_entry &e, const sight &s)
{
    menu_answer out;
    for (const std::string &text : e.lines) {
        const command c = menu_now_line(text);
        if (locks_out(c, s)) {
            out.said = "nothing else would open the menu: give that to another pedal or button first";
            continue;
        }
        if (c.kind == COMMAND_PICTURE || c.kind == COMMAND_EXPORT || c.kind == COMMAND_TURNTABLE)
            m->name++;
        if (c.kind == COMMAND_COLOUR)
            swatch_add(m, static_cast<uint32_t>(c.number[0]));
        out.commands.push_back(c);
    }
    if (e.closes)
        menu_close(m);
    else
        ring_begin(m);
    return out;
}

menu_answer doing_begin(menu *m, const menu_tree_entry &e, snapshot_menu_kind kind, const sight &s)
{
    menu_answer out;
    m->doing = e;
    m->kind = kind;
    waits_for_the_puck(m);
    if (kind == SNAPSHOT_MENU_VALUE) {
        m->before = menu_now_all(s, e.turned.kind, e.turned.index);
    } else if (e.argument == MENU_TREE_OF_TOOL) {
        m->before = menu_now_all(s, COMMAND_COLOUR);
    } else {
        m->before = menu_now_all(s, COMMAND_LIGHT, e.argument);
        out.commands = {m->before.front()}; /* what is put out is not seen to change */
    }
    if (kind == SNAPSHOT_MENU_COLOUR) {
        m->rgb_before = rgb_now(*m, s);
        m->mixed = menu_colour_of(m->rgb_before);
    }
    return out;
}

menu_answer choose(menu *m, const sight &s)
{
    const int pointed = m->way.back().pointed;
    const menu_tree_page page = page_of(*m, s);
    if (pointed < 0 || pointed >= static_cast<int>(page.entries.size()))
        return {};
    const menu_tree_entry &e = page.entries[static_cast<size_t>(pointed)];
    switch (e.kind) {
    case MENU_TREE_LEADS:
        m->way.push_back({e.ring, e.argument, -1});
        ring_begin(m);
        return {};
    case MENU_TREE_VALUE: return doing_begin(m, e, SNAPSHOT_MENU_VALUE, s);
    case MENU_TREE_MIXES: return doing_begin(m, e, SNAPSHOT_MENU_COLOUR, s);
    case MENU_TREE_CARRIES: return doing_begin(m, e, SNAPSHOT_MENU_CARRY, s);
    case MENU_TREE_LEARNS:
        m->kind = SNAPSHOT_MENU_LEARN;
        m->before.clear();
        return {};
    case MENU_TREE_BACK: return menu_press(m, CONTROLS_MEANS_UNDO, s);
    default: return entry_do(m, e, s);
    }
}

menu_answer keep(menu *m, const sight &s)
{
    if (m->kind == SNAPSHOT_MENU_COLOUR && m->doing.argument == MENU_TREE_OF_TOOL)
        swatch_add(m, rgb_now(*m, s));
    if (m->doing.closes)
        menu_close(m);
    else
        ring_begin(m);
    return {};
}

menu_answer back(menu *m)
{
    menu_answer out;
    if (m->kind != SNAPSHOT_MENU_RING) {
        out.commands = m->before;
        ring_begin(m);
        return out;
    }
    m->way.pop_back();
    if (m->way.empty())
        menu_close(m);
    else
        ring_begin(m);
    return out;
}

/* --- the puck --- */

double reach(double x, double y) { return std::sqrt(x * x + y * y); }

/* In the view's frame: push and tilt to the right; push and tilt away from the person. */
double right_of(const motion_speed &v) { return v.shift[0] - v.turn[2]; }
double away_of(const motion_speed &v) { return -v.shift[2] - v.turn[0]; }
double clockwise_of(const motion_speed &v) { return -v.turn[1]; }
double lift_of(const motion_speed &v) { return v.shift[1]; }

double deflection(const motion_speed &v)
{
    return std::max({reach(right_of(v), away_of(v)), std::fabs(clockwise_of(v)), std::fabs(lift_of(v))});
}

/* The strongest of all pucks, whatever each moves; without the person's own curve, which is for clay. */
motion_speed strongest(const controls &d)
{
    motion_speed most;
    for (const auto &counts : d.puck) {
        const motion_speed v = motion_filtered({0, 0}, counts);
        if (deflection(v) > deflection(most))
            most = v;
    }
    return most;
}

/* From -1..1 to a rate: nothing while it counts as let go, then fine, then coarse. */
double rate_of(double pushed)
{
    const double part = std::clamp((std::fabs(pushed) - MENU_LET_GO) / (1 - MENU_LET_GO), 0.0, 1.0);
    return (pushed < 0 ? -part : part) * (MENU_FINE + (1 - MENU_FINE) * part * part);
}

/* How far two parts of a turn are apart, the shorter way: -0.5..0.5. */
double apart(double from, double to)
{
    const double d = to - from;
    return d - std::floor(d + 0.5);
}

void point(menu *m, size_t sectors)
{
    const double x = right_of(m->puck), y = away_of(m->puck);
    if (sectors == 0 || reach(x, y) < MENU_POINTS)
        return;
    const auto count = static_cast<double>(sectors);
    const double turn = menu_turn_of(x, y);
    int *pointed = &m->way.back().pointed;
    if (*pointed >= 0 && std::fabs(apart(*pointed / count, turn)) <= 0.5 / count + MENU_MARGIN)
        return;
    *pointed = static_cast<int>(std::floor(turn * count + 0.5)) % static_cast<int>(sectors);
}

/* What turns a number: the strongest of right, away and clockwise. */
double pushed(const motion_speed &v)
{
    double most = 0;
    for (const double d : {right_of(v), away_of(v), clockwise_of(v)})
        if (std::fabs(d) > std::fabs(most))
            most = d;
    return std::clamp(most, -1.0, 1.0);
}

void turn_times(const menu_tree_value &v, double factor, command *c)
{
    for (size_t n = v.first; n <= v.last; n++) /* all within their range, and in proportion */
        factor = factor > 1 ? std::min(factor, std::max(1.0, v.most / c->number[n]))
                            : std::max(factor, std::min(1.0, v.least / c->number[n]));
    for (size_t n = v.first; n <= v.last; n++)
        c->number[n] = c->number[n] > 0 ? c->number[n] * factor : v.least;
}

void turn_box(const menu_tree_value &v, double factor, command *c)
{
    auto &n = c->number;
    const double size = menu_tree_number(v, *c);
    factor = std::clamp(factor * size, v.least, v.most) / size;
    for (size_t a = 0; a < 3; a++) {
        const double still = a == 1 ? n[1] : (n[a] + n[a + 3]) / 2; /* it goes on standing where it stood */
        n[a] = still + (n[a] - still) * factor;
        n[a + 3] = still + (n[a + 3] - still) * factor;
    }
}

menu_answer turn_value(menu *m, double seconds, const sight &s)
{
    const menu_tree_value &v = m->doing.turned;
    const double rate = rate_of(pushed(m->puck));
    if (rate == 0)
        return {};
    command c = menu_now(s, v.kind, v.index);
    const double factor = rate > 0 ? 1 + rate * MENU_TIMES_RATE * seconds : 1 / (1 - rate * MENU_TIMES_RATE * seconds);
    if (v.law == MENU_TREE_TIMES)
        turn_times(v, factor, &c);
    else if (v.law == MENU_TREE_BOX)
        turn_box(v, factor, &c);
    else
        for (size_t n = v.first; n <= v.last; n++)
            c.number[n] = std::clamp(c.number[n] + rate * MENU_EVEN_RATE * seconds * (v.most - v.least),
                                     std::min(v.least, c.number[n]), std::max(v.most, c.number[n]));
    return {{c}, ""};
}

/* One thing at a time: what is pushed most. Otherwise a twist would never be only a twist. */
menu_answer mix(menu *m, double seconds, const sight &s)
{
    menu_colour *c = &m->mixed;
    const double x = right_of(m->puck), y = away_of(m->puck), round = clockwise_of(m->puck), lift = lift_of(m->puck);
    const double plane = std::min(1.0, reach(x, y));
    if (plane >= std::fabs(round) && plane >= std::fabs(lift)) {
        if (rate_of(plane) == 0)
            return {};
        const double most = rate_of(plane) * MENU_HUE_RATE * seconds;
        c->hue += std::clamp(apart(c->hue, menu_turn_of(x, y)), -most, most);
        c->hue -= std::floor(c->hue);
        if (c->saturation == 0) /* a hue that is not seen cannot be looked for */
            c->saturation = 0.5;
    } else if (std::fabs(round) >= std::fabs(lift)) {
        c->lightness = std::clamp(c->lightness + rate_of(round) * MENU_SHADE_RATE * seconds, 0.0, 1.0);
    } else {
        c->saturation = std::clamp(c->saturation + rate_of(lift) * MENU_SHADE_RATE * seconds, 0.0, 1.0);
    }
    const bool tool = m->doing.argument == MENU_TREE_OF_TOOL;
    command now = menu_now(s, tool ? COMMAND_COLOUR : COMMAND_LIGHT, tool ? 0 : m->doing.argument);
    now.number[tool ? 0 : 4] = menu_rgb_of(*c);
    return {{now}, ""};
}

/* --- what is shown --- */

const char *how_of(const menu &m)
{
    switch (m.kind) {
    case SNAPSHOT_MENU_VALUE: return "push right or twist clockwise for more; gently for fine";
    case SNAPSHOT_MENU_COLOUR: return "push towards a hue; twist for lighter; lift for stronger";
    case SNAPSHOT_MENU_CARRY: return "the puck moves the light";
    case SNAPSHOT_MENU_LEARN: return "press the pedal or button that you mean";
    default: return m.way.back().pointed < 0 ? "push the puck towards what you want, then press" : "";
    }
}

std::string title_of(const menu &m, const sight &s)
{
    std::string title;
    for (size_t n = m.way.size() > 1 ? 1 : 0; n < m.way.size(); n++) /* "menu" goes without saying */
        title += (title.empty() ? "" : " \xe2\x80\xba ") + menu_tree_make(m.way[n].ring, m.way[n].argument, s).title;
    return title;
}

void doing_show(const menu &m, const sight &s, snapshot_menu *out)
{
    out->title += " \xe2\x80\xba " + m.doing.label;
    if (m.kind == SNAPSHOT_MENU_VALUE) {
        const menu_tree_value &v = m.doing.turned;
        const command now = menu_now(s, v.kind, v.index);
        out->value = menu_tree_text(v, now);
        out->number = menu_tree_number(v, now);
        out->least = v.least;
        out->most = v.most;
        out->times = v.law != MENU_TREE_EVEN;
        out->push = m.armed ? pushed(m.puck) : 0;
    } else if (m.kind == SNAPSHOT_MENU_COLOUR) {
        out->rgb = rgb_now(m, s);
        out->rgb_before = m.rgb_before;
        out->hue = m.mixed.hue;
        out->saturation = m.mixed.saturation;
        out->lightness = m.mixed.lightness;
    }
}

} // namespace

menu::menu() : swatches(FIRST_SWATCHES) {}

bool menu_is_open(const menu &m) { return !m.way.empty(); }

void menu_close(menu *m)
{
    m->way.clear();
    m->kind = SNAPSHOT_MENU_CLOSED;
}

menu_answer menu_press(menu *m, controls_meaning means, const menu_now_sight &seen)
{
    const sight s = completed(*m, seen);
    if (!menu_is_open(*m)) {
        if (means != CONTROLS_MEANS_MENU)
            return {};
        swatch_add(m, static_cast<uint32_t>(menu_now(s, COMMAND_COLOUR).number[0]));
        m->way.push_back({});
        ring_begin(m);
        return {};
    }
    if (means == CONTROLS_MEANS_UNDO)
        return back(m);
    if (means != CONTROLS_MEANS_APPLY && means != CONTROLS_MEANS_MENU)
        return {};
    if (m->kind != SNAPSHOT_MENU_RING)
        return keep(m, s);
    if (means == CONTROLS_MEANS_MENU && m->way.back().pointed < 0) {
        menu_close(m);
        return {};
    }
    return choose(m, s);
}

bool menu_learns(menu *m, const command &c)
{
    if (m->kind != SNAPSHOT_MENU_LEARN)
        return false;
    const int n = c.kind == COMMAND_PEDAL ? static_cast<int>(c.number[0])
                                        : MENU_TREE_BUTTON + static_cast<int>(c.number[1]);
    m->way.push_back({MENU_TREE_MEANS, n, -1});
    ring_begin(m);
    return true;
}

menu_answer menu_advance(menu *m, double seconds, const menu_now_sight &seen)
{
    if (!menu_is_open(*m))
        return {};
    const motion_speed now = strongest(*seen.devices);
    m->armed = m->armed || deflection(now) < MENU_LET_GO;
    if (!m->armed)
        return {};
    m->puck = now;
    switch (m->kind) {
    case SNAPSHOT_MENU_RING: point(m, page_of(*m, completed(*m, seen)).entries.size()); return {};
    case SNAPSHOT_MENU_VALUE: return turn_value(m, seconds, seen);
    case SNAPSHOT_MENU_COLOUR: return mix(m, seconds, seen);
    default: return {};
    }
}

controls_thing menu_carries(const menu &m)
{
    return m.kind == SNAPSHOT_MENU_CARRY && m.armed
               ? static_cast<controls_thing>(CONTROLS_LIGHT0 + m.doing.argument)
               : CONTROLS_NOTHING;
}

snapshot_menu menu_shown(const menu &m, const menu_now_sight &seen)
{
    snapshot_menu out;
    out.kind = m.kind;
    if (!menu_is_open(m))
        return out;
    const sight s = completed(m, seen);
    out.title = title_of(m, s);
    out.how = how_of(m);
    out.pointed = m.way.back().pointed;
    out.puck = {std::clamp(right_of(m.puck), -1.0, 1.0), std::clamp(away_of(m.puck), -1.0, 1.0)};
    if (m.kind != SNAPSHOT_MENU_RING && m.kind != SNAPSHOT_MENU_LEARN) {
        doing_show(m, s, &out);
        return out;
    }
    for (const menu_tree_entry &e : page_of(m, s).entries)
        out.sectors.push_back({e.label, e.value, e.icon, e.swatch, e.chosen, e.kind == MENU_TREE_LEADS});
    return out;
}

double menu_turn_of(double x, double y)
{
    /* Halving: the wanted turn lies where the cross product changes its sign. Clockwise from up, (sin, cos). */
    double low = x < 0 ? 0.5 : 0, high = low + 0.5;
    for (int n = 0; n < 24; n++) {
        const double middle = (low + high) / 2;
        const angle_pair at = angle_sincos(2 * ANGLE_PI * middle);
        (x * at.cosine - y * at.sine > 0 ? low : high) = middle;
    }
    const double turn = (low + high) / 2;
    return turn - std::floor(turn);
}

uint32_t menu_rgb_of(const menu_colour &c)
{
    /* Hue, saturation, lightness: a double cone. */
    const double chroma = (1 - std::fabs(2 * c.lightness - 1)) * c.saturation;
    uint32_t rgb = 0;
    for (const double shift : {0.0, 4.0, 2.0}) {
        const double place = c.hue * 6 + shift, round = place - 6 * std::floor(place / 6);
        const double part = std::clamp(std::fabs(round - 3) - 1, 0.0, 1.0);
        const double level = c.lightness + chroma * (part - 0.5);
        rgb = rgb << 8 | static_cast<uint32_t>(std::clamp(level, 0.0, 1.0) * 255 + 0.5);
    }
    return rgb;
}

menu_colour menu_colour_of(uint32_t rgb)
{
    const double r = (rgb >> 16 & 255) / 255.0, g = (rgb >> 8 & 255) / 255.0, b = (rgb & 255) / 255.0;
    const double most = std::max({r, g, b}), least = std::min({r, g, b}), chroma = most - least;
    menu_colour c;
    c.lightness = (most + least) / 2;
    if (chroma == 0)
        return c;
    c.saturation = chroma / (1 - std::fabs(2 * c.lightness - 1));
    c.hue = most == r ? (g - b) / chroma : most == g ? 2 + (b - r) / chroma : 4 + (r - g) / chroma;
    c.hue /= 6;
    c.hue -= std::floor(c.hue);
    return c;
}
