/* SPDX-License-Identifier: Apache-2.0 */
#include "view/overlay_ring.h"

#include "view/overlay_icon.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr double turn = 6.283185307179586;
constexpr float RING_OUTER = 0.47f, RING_INNER = 0.47f; /* of the room's shorter side; of the outer radius */
constexpr float GAUGE_OUTER = 0.27f;                    /* what is looked past is smaller */
constexpr double GAUGE_OPEN = 0.125;                    /* of a turn each side of the bottom that a gauge leaves open */

struct place {
    ImVec2 middle;
    float outer, inner;
};

place ring_place(const overlay_pen &p, float bottom)
{
    const float room = p.height - bottom, outer = RING_OUTER * std::min(p.width, room);
    return {ImVec2(p.width / 2, room / 2), outer, outer * RING_INNER};
}

/* At the left where there is room beside the piece, else at the bottom. */
place gauge_place(const overlay_pen &p, float bottom)
{
    const float room = p.height - bottom, outer = GAUGE_OUTER * std::min(p.width, room);
    if (p.width > room)
        return {ImVec2(outer * 1.15f, room / 2), outer, outer * 0.78f};
    return {ImVec2(p.width / 2, room - outer * 1.1f), outer, outer * 0.78f};
}

void disc_draw(const overlay_pen &p, const place &at)
{
    p.list->AddCircleFilled(at.middle, at.outer, OVERLAY_PEN_GROUND, 128);
    p.list->AddCircle(at.middle, at.outer, OVERLAY_PEN_LINE, 128, std::max(1.0f, p.size / 14));
}

/* --- a ring --- */

void sector_draw(const overlay_pen &p, const place &at, const snapshot_menu_sector &s, double angle, double width,
                 bool lit)
{
    const float gap = std::max(1.0f, p.size / 10), radius = at.inner + 0.54f * (at.outer - at.inner);
    const double slack = gap / radius;
    if (lit)
        overlay_pen_arc(p, at.middle, at.inner + gap, at.outer - gap, angle - width / 2 + slack,
                        angle + width / 2 - slack, OVERLAY_PEN_LIT);
    const ImVec2 middle = overlay_pen_round(at.middle, radius, angle);
    const ImU32 ink = s.chosen ? OVERLAY_PEN_CHOSEN : OVERLAY_PEN_TEXT;
    const bool has_icon = s.icon != SNAPSHOT_MENU_ICON_NONE, has_words = !s.label.empty();
    const auto chord = 2 * radius * static_cast<float>(std::sin(std::min(width, turn / 3) / 2));
    const float most = std::min(chord - 2.2f * gap, at.outer - at.inner + 2 * p.size);
    const float icon = std::min((has_words ? 2.2f : 3.4f) * p.size, (at.outer - at.inner) * (has_words ? 0.36f : 0.5f));
    const float label = std::max(p.size, std::min(OVERLAY_PEN_LABEL * p.size, (at.outer - at.inner) * 0.17f));
    if (has_icon)
        overlay_icon_draw(p, s.icon, ImVec2(middle.x, middle.y - (has_words ? icon * 0.45f : 0)), icon, ink,
                          overlay_pen_rgb(s.swatch));
    if (has_words)
        overlay_pen_lines(p, lit, label, middle.x, middle.y + (has_icon ? icon * 0.45f + label * 0.4f : 0), most,
                          lit || s.chosen ? ink : OVERLAY_PEN_TEXT, s.label);
    if (s.leads) { /* a notch outwards: there is more behind it */
        const ImVec2 tip = overlay_pen_round(at.middle, at.outer - gap * 1.4f, angle);
        const ImVec2 left = overlay_pen_round(at.middle, at.outer - gap * 1.4f - p.size * 0.28f, angle - 0.028);
        const ImVec2 right = overlay_pen_round(at.middle, at.outer - gap * 1.4f - p.size * 0.28f, angle + 0.028);
        p.list->AddTriangleFilled(tip, right, left, OVERLAY_PEN_QUIET);
    }
    if (s.chosen) {
        const double mark = std::min(width / 2 - slack, 0.16);
        overlay_pen_arc(p, at.middle, at.inner + gap, at.inner + gap + std::max(2.0f, p.size / 6), angle - mark,
                        angle + mark, OVERLAY_PEN_CHOSEN);
    }
}

void middle_draw(const overlay_pen &p, const place &at, const std::string &title, const std::string &large,
                 const std::string &small)
{
    const float most = at.inner * 1.7f, big = p.size * OVERLAY_PEN_LARGE;
    const float title_size = overlay_pen_fit(p, false, p.size, title, at.inner * 1.25f);
    overlay_pen_text(p, false, title_size, at.middle.x, at.middle.y - big * 1.35f, 0.5f, OVERLAY_PEN_QUIET, title);
    overlay_pen_text(p, true, overlay_pen_fit(p, true, big, large, most), at.middle.x, at.middle.y, 0.5f,
                     OVERLAY_PEN_TEXT, large);
    overlay_pen_lines(p, false, p.size, at.middle.x, at.middle.y + big * 1.4f, at.inner * 1.3f, OVERLAY_PEN_QUIET,
                      small);
}

void puck_draw(const overlay_pen &p, const place &at, const snapshot_menu &m)
{
    /* How far out one is, on the way to the ring: pointing is felt before it is done. */
    const double x = m.puck[0], y = m.puck[1], reach = std::min(1.0, std::sqrt(x * x + y * y));
    if (reach < 0.02)
        return;
    const float r = std::max(2.0f, p.size / 5);
    const ImVec2 dot = overlay_pen_round(at.middle, reach * (at.inner - r), std::atan2(x, y));
    p.list->AddCircleFilled(dot, r, OVERLAY_PEN_CHOSEN);
}

void ring_draw(const overlay_pen &p, const snapshot_menu &m, float bottom)
{
    const place at = ring_place(p, bottom);
    disc_draw(p, at);
    p.list->AddCircleFilled(at.middle, at.inner, OVERLAY_PEN_GROUND | IM_COL32_A_MASK, 96); /* words on nothing else */
    p.list->AddCircle(at.middle, at.inner, OVERLAY_PEN_LINE, 96, std::max(1.0f, p.size / 18));
    const auto count = static_cast<int>(m.sectors.size());
    const double width = turn / std::max(count, 1);
    for (int n = 0; n < count; n++) {
        sector_draw(p, at, m.sectors[static_cast<size_t>(n)], n * width, width, n == m.pointed);
        const ImVec2 from = overlay_pen_round(at.middle, at.inner, (n + 0.5) * width);
        const ImVec2 to = overlay_pen_round(at.middle, at.outer, (n + 0.5) * width);
        if (count > 1)
            p.list->AddLine(from, to, OVERLAY_PEN_LINE, std::max(1.0f, p.size / 18));
    }
    puck_draw(p, at, m);
    if (m.pointed < 0 || m.pointed >= count) {
        middle_draw(p, at, "", m.title, m.how);
        return;
    }
    const snapshot_menu_sector &s = m.sectors[static_cast<size_t>(m.pointed)];
    middle_draw(p, at, m.title, s.label, s.value);
    if (s.icon == SNAPSHOT_MENU_ICON_SWATCH && s.label.empty()) {
        p.list->AddCircleFilled(at.middle, at.inner * 0.5f, overlay_pen_rgb(s.swatch), 64);
        p.list->AddCircle(at.middle, at.inner * 0.5f, OVERLAY_PEN_TEXT, 64, std::max(1.0f, p.size / 14));
    }
}

/* --- what is changed live --- */

/* From 0 to 1 along an arc that is open at the bottom. */
double gauge_angle(double part) { return turn * (0.5 + GAUGE_OPEN + part * (1 - 2 * GAUGE_OPEN)); }

void how_draw(const overlay_pen &p, const place &at, const std::string &how)
{
    overlay_pen_lines(p, false, p.size, at.middle.x, at.middle.y + at.inner * 0.5f, at.inner * 1.45f,
                      OVERLAY_PEN_QUIET, how);
}

void title_draw(const overlay_pen &p, const place &at, const std::string &title)
{
    overlay_pen_text(p, false, overlay_pen_fit(p, false, p.size, title, at.inner * 1.35f), at.middle.x,
                     at.middle.y - at.inner * 0.5f, 0.5f, OVERLAY_PEN_QUIET, title);
}

double part_of(const snapshot_menu &m)
{
    const double n = std::clamp(m.number, m.least, m.most);
    return m.times ? std::log(n / m.least) / std::log(m.most / m.least) : (n - m.least) / (m.most - m.least);
}

void value_draw(const overlay_pen &p, const snapshot_menu &m, float bottom)
{
    const place at = gauge_place(p, bottom);
    disc_draw(p, at);
    const float thin = std::max(2.0f, p.size / 5), radius = (at.inner + at.outer) / 2;
    overlay_pen_arc(p, at.middle, radius - thin / 2, radius + thin / 2, gauge_angle(0), gauge_angle(1),
                    OVERLAY_PEN_LINE);
    const double part = part_of(m);
    if (part > 0.002)
        overlay_pen_arc(p, at.middle, at.inner, at.outer - thin, gauge_angle(0), gauge_angle(part), OVERLAY_PEN_LIT);
    const ImVec2 knob = overlay_pen_round(at.middle, radius, gauge_angle(part));
    p.list->AddCircleFilled(knob, thin * 1.6f, OVERLAY_PEN_TEXT);
    if (std::fabs(m.push) > 0.01) /* how hard, and which way */
        overlay_pen_arc(p, at.middle, at.outer + thin * 0.5f, at.outer + thin * 1.3f, std::min(0.0, m.push),
                        std::max(0.0, m.push), OVERLAY_PEN_CHOSEN);
    title_draw(p, at, m.title);
    const float big = p.size * OVERLAY_PEN_LARGE;
    overlay_pen_text(p, true, overlay_pen_fit(p, true, big, m.value, at.inner * 1.7f), at.middle.x, at.middle.y, 0.5f,
                     OVERLAY_PEN_TEXT, m.value);
    how_draw(p, at, m.how);
}

double level(double hue, double saturation, double lightness, double shift)
{
    const double place_of = hue * 6 + shift, round = place_of - 6 * std::floor(place_of / 6);
    const double part = std::clamp(std::fabs(round - 3) - 1, 0.0, 1.0);
    return std::clamp(lightness + (1 - std::fabs(2 * lightness - 1)) * saturation * (part - 0.5), 0.0, 1.0);
}

ImU32 hsl(double h, double s, double l)
{
    const auto byte = [](double v) { return static_cast<unsigned>(v * 255 + 0.5); };
    return IM_COL32(byte(level(h, s, l, 0)), byte(level(h, s, l, 4)), byte(level(h, s, l, 2)), 255);
}

/* A strip from dark to light or grey to pure, with a mark. */
void shades_draw(const overlay_pen &p, const place &at, float y, const snapshot_menu &m, bool lightness)
{
    constexpr int parts = 24;
    const float x0 = at.middle.x - at.inner * 0.5f, width = at.inner, high = std::max(3.0f, p.size * 0.4f);
    for (int n = 0; n < parts; n++) {
        const double v = (n + 0.5) / parts;
        const ImU32 c = lightness ? hsl(m.hue, m.saturation, v) : hsl(m.hue, v, m.lightness);
        p.list->AddRectFilled(ImVec2(x0 + width * static_cast<float>(n) / parts, y),
                              ImVec2(x0 + width * static_cast<float>(n + 1) / parts, y + high), c);
    }
    const float x = x0 + width * static_cast<float>(lightness ? m.lightness : m.saturation);
    p.list->AddTriangleFilled(ImVec2(x, y + high * 0.5f), ImVec2(x + high * 0.6f, y + high * 1.7f),
                              ImVec2(x - high * 0.6f, y + high * 1.7f), OVERLAY_PEN_TEXT);
}

void colour_draw(const overlay_pen &p, const snapshot_menu &m, float bottom)
{
    constexpr int parts = 72;
    const place at = gauge_place(p, bottom);
    disc_draw(p, at);
    const float rim = std::max(1.0f, p.size / 8);
    for (int n = 0; n < parts; n++) /* each a little longer, or the seams show */
        overlay_pen_arc(p, at.middle, at.inner, at.outer - rim, turn * n / parts, turn * (n + 1.15) / parts,
                        hsl((n + 0.5) / parts, std::max(m.saturation, 0.25), std::clamp(m.lightness, 0.25, 0.75)));
    const float thick = std::max(2.0f, p.size / 6);
    p.list->AddCircle(overlay_pen_round(at.middle, (at.inner + at.outer - rim) / 2, turn * m.hue),
                      (at.outer - at.inner) * 0.5f, OVERLAY_PEN_TEXT, 32, thick);
    title_draw(p, at, m.title);
    /* New above, old below: side by side one sees which way it went. */
    const float r = at.inner * 0.34f;
    const ImVec2 middle(at.middle.x, at.middle.y - at.inner * 0.04f);
    p.list->PathArcTo(middle, r, static_cast<float>(turn / 2), static_cast<float>(turn), 32);
    p.list->PathFillConvex(overlay_pen_rgb(m.rgb));
    p.list->PathArcTo(middle, r, 0, static_cast<float>(turn / 2), 32);
    p.list->PathFillConvex(overlay_pen_rgb(m.rgb_before));
    p.list->AddCircle(middle, r, OVERLAY_PEN_TEXT, 48, std::max(1.0f, p.size / 16));
    shades_draw(p, at, at.middle.y + at.inner * 0.37f, m, true);
    shades_draw(p, at, at.middle.y + at.inner * 0.55f, m, false);
    /* No room inside: the line stands under the wheel, or over it where the wheel stands on the bottom. */
    const bool above = p.width <= p.height - bottom;
    const float y = at.middle.y + (above ? -1 : 1) * (at.outer + p.size * 2.1f);
    const float most = std::min(2 * at.outer, p.width);
    p.list->AddRectFilled(ImVec2(at.middle.x - at.outer, y - p.size * 1.6f),
                          ImVec2(at.middle.x + at.outer, y + p.size * 1.6f),
                          OVERLAY_PEN_GROUND, p.size * 0.5f);
    overlay_pen_lines(p, false, p.size, at.middle.x, y, most - p.size, OVERLAY_PEN_QUIET, m.how);
}

void card_draw(const overlay_pen &p, const snapshot_menu &m, float bottom)
{
    const place at = m.kind == SNAPSHOT_MENU_LEARN ? ring_place(p, bottom) : gauge_place(p, bottom);
    const place small = {at.middle, m.kind == SNAPSHOT_MENU_LEARN ? at.inner * 1.2f : at.outer, at.inner};
    disc_draw(p, small);
    overlay_icon_draw(p, m.kind == SNAPSHOT_MENU_LEARN ? SNAPSHOT_MENU_ICON_PEDAL : SNAPSHOT_MENU_ICON_MOVE, at.middle,
                      at.inner * 0.5f, OVERLAY_PEN_CHOSEN, 0);
    title_draw(p, at, m.title);
    how_draw(p, at, m.how);
}

} // namespace

void overlay_ring_draw(const overlay_pen &p, const snapshot_menu &m, float bottom)
{
    switch (m.kind) {
    case SNAPSHOT_MENU_CLOSED: break;
    case SNAPSHOT_MENU_RING: ring_draw(p, m, bottom); break;
    case SNAPSHOT_MENU_VALUE: value_draw(p, m, bottom); break;
    case SNAPSHOT_MENU_COLOUR: colour_draw(p, m, bottom); break;
    default: card_draw(p, m, bottom); break;
    }
}
