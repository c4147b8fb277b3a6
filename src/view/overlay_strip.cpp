/* SPDX-License-Identifier: Apache-2.0 */
#include "view/overlay_strip.h"

#include "view/overlay_icon.h"

#include <algorithm>
#include <array>

namespace {

constexpr float STRIP_LINES = 1.75f; /* of a line: how high the strip is */

enum item_kind { ITEM_DOT, ITEM_PUCK, ITEM_PEDAL, ITEM_SWATCH, ITEM_WORDS };
enum item_side { ITEM_LEFT, ITEM_MIDDLE, ITEM_RIGHT };

struct item {
    item_kind kind;
    item_side side;
    int rank; /* the highest is left out first */
    std::string text;
    ImU32 colour;
    bool down = false;
};

ImU32 keeping_colour(snapshot_keeping k)
{
    return k == SNAPSHOT_KEEPING_ALL     ? OVERLAY_PEN_GOOD
           : k == SNAPSHOT_KEEPING_FAILS ? OVERLAY_PEN_BAD
                                         : OVERLAY_PEN_WAITS;
}

std::vector<item> items_of(const snapshot &s)
{
    const snapshot_menu_strip &t = s.strip;
    std::vector<item> all;
    if (!t.keeping.empty())
        all.push_back({ITEM_DOT, ITEM_LEFT, 0, t.keeping, keeping_colour(s.keeping)});
    all.push_back({ITEM_PUCK, ITEM_LEFT, 3, t.mode, OVERLAY_PEN_QUIET});
    for (size_t n = 0; n < t.pedals.size(); n++)
        all.push_back({ITEM_PEDAL, ITEM_MIDDLE, 1, t.pedals[n],
                       t.pedals_down[n] || s.menu.kind != SNAPSHOT_MENU_CLOSED ? OVERLAY_PEN_CHOSEN : OVERLAY_PEN_QUIET,
                       t.pedals_down[n]});
    all.push_back({ITEM_SWATCH, ITEM_RIGHT, 2, t.action, overlay_pen_rgb(t.rgb)});
    all.push_back({ITEM_WORDS, ITEM_RIGHT, 4, t.size, OVERLAY_PEN_TEXT});
    all.push_back({ITEM_WORDS, ITEM_RIGHT, 5, t.rate, OVERLAY_PEN_QUIET});
    all.push_back({ITEM_WORDS, ITEM_RIGHT, 6, t.undo, OVERLAY_PEN_QUIET});
    return all;
}

float icon_of(const item &i, float size) { return i.kind == ITEM_WORDS ? 0 : i.kind == ITEM_DOT ? size * 0.6f : size; }

float width_of(const overlay_pen &p, const item &i, float size)
{
    const float icon = icon_of(i, size);
    return icon + (icon > 0 ? 0.35f * size : 0) + overlay_pen_width(p, false, size, i.text);
}

float gap_of(float size) { return size * 0.95f; }

/* Each with a gap after it. */
float width_of(const overlay_pen &p, const std::vector<item> &items, float size, item_side side)
{
    float width = 0;
    for (const item &i : items)
        if (i.side == side)
            width += width_of(p, i, size) + gap_of(size);
    return width;
}

float width_of(const overlay_pen &p, const std::vector<item> &items, float size)
{
    return width_of(p, items, size, ITEM_LEFT) + width_of(p, items, size, ITEM_MIDDLE) +
           width_of(p, items, size, ITEM_RIGHT) + gap_of(size);
}

void item_draw(const overlay_pen &p, const item &i, float size, float x, float y)
{
    const float icon = icon_of(i, size);
    const ImVec2 at(x + icon / 2, y);
    switch (i.kind) {
    case ITEM_DOT: p.list->AddCircleFilled(at, icon / 2, i.colour); break;
    case ITEM_PUCK: overlay_icon_draw(p, SNAPSHOT_MENU_ICON_PUCK, at, icon, i.colour, 0); break;
    case ITEM_PEDAL: overlay_icon_pedal(p, at, icon, i.colour, i.down); break;
    case ITEM_SWATCH: overlay_icon_draw(p, SNAPSHOT_MENU_ICON_SWATCH, at, icon, OVERLAY_PEN_QUIET, i.colour); break;
    case ITEM_WORDS: break;
    }
    const ImU32 ink = i.kind == ITEM_WORDS || i.kind == ITEM_PEDAL ? i.colour
                      : i.kind == ITEM_DOT && i.colour == OVERLAY_PEN_BAD ? OVERLAY_PEN_BAD
                                                                          : OVERLAY_PEN_TEXT;
    overlay_pen_text(p, i.kind == ITEM_DOT && i.colour == OVERLAY_PEN_BAD, size,
                     x + icon + (icon > 0 ? 0.35f * size : 0), y, 0, i.kind == ITEM_PEDAL ? OVERLAY_PEN_TEXT : ink,
                     i.text);
}

/* Leaves out what has no room, then shrinks. */
float fitted(const overlay_pen &p, std::vector<item> *items)
{
    for (int rank = 6; rank > 1 && width_of(p, *items, p.size) > p.width; rank--)
        std::erase_if(*items, [rank](const item &i) { return i.rank == rank; });
    const float width = width_of(p, *items, p.size);
    return width > p.width ? p.size * p.width / width : p.size;
}

void bar_draw(const overlay_pen &p, const snapshot &s)
{
    std::vector<item> items = items_of(s);
    const float size = fitted(p, &items), gap = gap_of(size);
    const float high = overlay_strip_height(p, s), y = p.height - high / 2;
    p.list->AddRectFilled(ImVec2(0, p.height - high), ImVec2(p.width, p.height), OVERLAY_PEN_GROUND);
    p.list->AddLine(ImVec2(0, p.height - high), ImVec2(p.width, p.height - high), OVERLAY_PEN_LINE,
                    std::max(1.0f, p.size / 20));
    const float left = width_of(p, items, size, ITEM_LEFT), middle = width_of(p, items, size, ITEM_MIDDLE),
                right = width_of(p, items, size, ITEM_RIGHT);
    /* In the picture's middle, unless what stands at the sides is in the way. */
    const float most = std::max(left + gap, p.width - right - middle);
    const float between = std::clamp((p.width - middle) / 2, std::min(left + gap, most), most);
    std::array<float, 3> x = {gap, between, p.width - right};
    for (const item &i : items) {
        item_draw(p, i, size, x[i.side], y);
        x[i.side] += width_of(p, i, size) + gap;
    }
}

void toast_draw(const overlay_pen &p, const std::string &text, float bottom)
{
    const float most = p.width * 0.8f;
    const float wide = std::min(most, overlay_pen_width(p, false, p.size, text)) + 2 * p.size;
    const size_t lines = overlay_pen_broken(p, false, p.size, most, text).size();
    const float high = (static_cast<float>(lines) + 0.9f) * p.size, y = p.height - bottom - p.size - high / 2;
    p.list->AddRectFilled(ImVec2((p.width - wide) / 2, y - high / 2), ImVec2((p.width + wide) / 2, y + high / 2),
                          OVERLAY_PEN_GROUND, p.size * 0.5f);
    p.list->AddRect(ImVec2((p.width - wide) / 2, y - high / 2), ImVec2((p.width + wide) / 2, y + high / 2),
                    OVERLAY_PEN_WAITS, p.size * 0.5f, 0, std::max(1.0f, p.size / 14));
    overlay_pen_lines(p, false, p.size, p.width / 2, y, most, OVERLAY_PEN_TEXT, text);
}

void hint_draw(const overlay_pen &p, const std::vector<std::array<std::string, 2>> &rows)
{
    float size = p.size, first = 0, second = 0;
    for (const auto &row : rows) {
        first = std::max(first, overlay_pen_width(p, true, size, row[0]));
        second = std::max(second, overlay_pen_width(p, false, size, row[1]));
    }
    const float wide = first + second + 3 * size, scale = std::min(1.0f, (p.width - 2 * size) / wide);
    size *= scale;
    const float high = (static_cast<float>(rows.size()) * 1.45f + 0.7f) * size, x = p.size, y = p.size;
    p.list->AddRectFilled(ImVec2(x, y), ImVec2(x + wide * scale, y + high), OVERLAY_PEN_GROUND, size * 0.5f);
    for (size_t n = 0; n < rows.size(); n++) {
        const float at = y + (static_cast<float>(n) * 1.45f + 1.05f) * size;
        overlay_pen_text(p, true, size, x + size, at, 0, OVERLAY_PEN_CHOSEN, rows[n][0]);
        overlay_pen_text(p, false, size, x + first * scale + 2 * size, at, 0, OVERLAY_PEN_TEXT, rows[n][1]);
    }
}

void dot_draw(const overlay_pen &p, const snapshot &s)
{
    const item i = {ITEM_DOT, ITEM_RIGHT, 0, s.strip.keeping, keeping_colour(s.keeping)};
    const float high = p.size * 1.5f, wide = width_of(p, i, p.size) + 1.2f * p.size;
    p.list->AddRectFilled(ImVec2(p.width - wide, p.height - high), ImVec2(p.width, p.height), OVERLAY_PEN_GROUND,
                          p.size * 0.5f, ImDrawFlags_RoundCornersTopLeft);
    item_draw(p, i, p.size, p.width - wide + 0.6f * p.size, p.height - high / 2);
}

} // namespace

bool overlay_strip_is_shown(const snapshot &s) { return s.strip.shown || s.menu.kind != SNAPSHOT_MENU_CLOSED; }

float overlay_strip_height(const overlay_pen &p, const snapshot &s)
{
    return overlay_strip_is_shown(s) ? STRIP_LINES * p.size : 0;
}

void overlay_strip_draw(const overlay_pen &p, const snapshot &s)
{
    if (overlay_strip_is_shown(s))
        bar_draw(p, s);
    else if (s.keeping_shown)
        dot_draw(p, s);
    if (s.strip.shown && !s.strip.hint.empty())
        hint_draw(p, s.strip.hint);
    if (overlay_strip_is_shown(s) && !s.strip.toast.empty())
        toast_draw(p, s.strip.toast, overlay_strip_height(p, s));
}
