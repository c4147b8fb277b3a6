/* SPDX-License-Identifier: Apache-2.0 */
#include "view/overlay_icon.h"

#include <algorithm>
#include <initializer_list>

namespace {

/* One icon's square: -1..1 to the right and down. */
struct square {
    ImDrawList *list;
    ImVec2 at;
    float half, thick;
    ImU32 colour;

    ImVec2 to(float x, float y) const { return ImVec2(at.x + x * half, at.y + y * half); }
    void line(std::initializer_list<std::pair<float, float>> points, bool closed = false) const
    {
        for (const auto &[x, y] : points)
            list->PathLineTo(to(x, y));
        list->PathStroke(colour, closed ? ImDrawFlags_Closed : 0, thick);
    }
    void fill(std::initializer_list<std::pair<float, float>> points) const
    {
        for (const auto &[x, y] : points)
            list->PathLineTo(to(x, y));
        list->PathFillConvex(colour);
    }
    void circle(float x, float y, float r) const { list->AddCircle(to(x, y), r * half, colour, 0, thick); }
    void dot(float x, float y, float r) const { list->AddCircleFilled(to(x, y), r * half, colour); }
    void arc(float x, float y, float r, float from, float to_angle) const /* radians, clockwise from the right */
    {
        list->PathArcTo(to(x, y), r * half, from, to_angle);
        list->PathStroke(colour, 0, thick);
    }
    void oval(float rx, float ry) const
    {
        constexpr int parts = 28;
        for (int n = 0; n < parts; n++) {
            const ImVec2 on = overlay_pen_round(ImVec2(0, 0), 1, n * 6.2831853 / parts);
            list->PathLineTo(to(rx * on.x, ry * on.y));
        }
        list->PathStroke(colour, ImDrawFlags_Closed, thick);
    }
};

constexpr float turn = 6.2831853f;

void box_draw(const square &q)
{
    q.line({{-0.8f, -0.4f}, {0, -0.8f}, {0.8f, -0.4f}, {0, 0}}, true);
    q.line({{-0.8f, -0.4f}, {-0.8f, 0.5f}, {0, 0.9f}, {0.8f, 0.5f}, {0.8f, -0.4f}});
    q.line({{0, 0}, {0, 0.9f}});
}

void arrow_draw(const square &q, float way)
{
    q.arc(0, 0.15f, 0.65f, way > 0 ? -0.5f * turn : 0.1f * turn - turn * 0.6f, way > 0 ? 0.1f * turn - turn * 0.1f : 0);
    q.fill({{way * 0.65f - 0.32f, 0.1f}, {way * 0.65f + 0.32f, 0.1f}, {way * 0.65f, 0.55f}});
}

void rays_draw(const square &q, float inner, float outer, int count)
{
    for (int n = 0; n < count; n++) {
        const ImVec2 on = overlay_pen_round(ImVec2(0, 0), 1, n * 6.2831853 / count);
        q.line({{on.x * inner, on.y * inner}, {on.x * outer, on.y * outer}});
    }
}

void star_draw(const square &q)
{
    for (int n = 0; n < 10; n++) {
        const ImVec2 on = overlay_pen_round(ImVec2(0, 0), n % 2 == 0 ? 0.95 : 0.45, n * 0.62831853);
        q.list->PathLineTo(q.to(on.x, on.y));
    }
    q.list->PathStroke(q.colour, ImDrawFlags_Closed, q.thick);
}

void move_draw(const square &q)
{
    for (const auto &[x, y] : {std::pair{0.0f, -1.0f}, {0.0f, 1.0f}, {-1.0f, 0.0f}, {1.0f, 0.0f}}) {
        q.line({{0, 0}, {x * 0.6f, y * 0.6f}});
        q.list->AddTriangleFilled(q.to(x, y), q.to(x * 0.55f - y * 0.28f, y * 0.55f + x * 0.28f),
                                  q.to(x * 0.55f + y * 0.28f, y * 0.55f - x * 0.28f), q.colour);
    }
}

void look_draw(const square &q)
{
    q.circle(0, 0, 0.85f);
    q.list->PathArcTo(q.at, 0.85f * q.half, -0.25f * turn, 0.25f * turn);
    q.list->PathFillConvex(q.colour);
}

void puck_draw(const square &q)
{
    q.line({{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.6f, 0.1f}, {-0.6f, 0.1f}}, true);
    q.line({{-0.95f, 0.8f}, {-0.7f, 0.25f}, {0.7f, 0.25f}, {0.95f, 0.8f}}, true);
}

void tool_icon(const square &q, snapshot_menu_icon icon)
{
    switch (icon) {
    case SNAPSHOT_MENU_ICON_BALL:
        q.circle(0, 0, 0.85f);
        q.oval(0.85f, 0.3f);
        q.oval(0.3f, 0.85f);
        break;
    case SNAPSHOT_MENU_ICON_CUBE: box_draw(q); break;
    case SNAPSHOT_MENU_ICON_STAR: star_draw(q); break;
    case SNAPSHOT_MENU_ICON_SIZE:
        q.circle(0, 0, 0.9f);
        q.circle(0, 0, 0.55f);
        q.circle(0, 0, 0.22f);
        break;
    case SNAPSHOT_MENU_ICON_STRETCH:
        q.oval(0.4f, 0.65f);
        q.fill({{-0.2f, -0.75f}, {0, -1}, {0.2f, -0.75f}});
        q.fill({{-0.2f, 0.75f}, {0, 1}, {0.2f, 0.75f}});
        break;
    case SNAPSHOT_MENU_ICON_RATE:
        for (int n = 0; n < 4; n++)
            q.line({{-0.75f + 0.5f * static_cast<float>(n), 0.8f},
                    {-0.75f + 0.5f * static_cast<float>(n), 0.45f - 0.4f * static_cast<float>(n)}});
        break;
    case SNAPSHOT_MENU_ICON_SPACING:
        for (const float x : {-0.75f, -0.25f, 0.25f, 0.75f})
            q.circle(x, -x * 0.4f, 0.3f);
        break;
    case SNAPSHOT_MENU_ICON_EDGE: q.line({{-0.9f, 0.7f}, {-0.3f, 0.7f}, {0.2f, -0.6f}, {0.9f, -0.6f}}); break;
    case SNAPSHOT_MENU_ICON_BULGE:
        q.line({{-1, 0.1f}, {-0.7f, 0}, {-0.5f, -0.35f}, {-0.3f, 0.2f}, {0, 0.6f}, {0.3f, 0.2f}, {0.5f, -0.35f},
                {0.7f, 0}, {1, 0.1f}});
        break;
    case SNAPSHOT_MENU_ICON_ADD:
        q.line({{-0.8f, 0}, {0.8f, 0}});
        q.line({{0, -0.8f}, {0, 0.8f}});
        break;
    case SNAPSHOT_MENU_ICON_TAKE: q.line({{-0.8f, 0}, {0.8f, 0}}); break;
    case SNAPSHOT_MENU_ICON_PAINT:
        q.line({{0.85f, -0.85f}, {0.1f, -0.1f}});
        q.fill({{0.2f, -0.25f}, {0.3f, 0.1f}, {-0.2f, 0.6f}, {-0.8f, 0.8f}, {-0.45f, 0.2f}});
        break;
    case SNAPSHOT_MENU_ICON_SMOOTH:
        q.arc(-0.45f, 0, 0.45f, 0.5f * turn, turn);
        q.arc(0.45f, 0, 0.45f, 0, 0.5f * turn);
        break;
    default: /* SNAPSHOT_MENU_ICON_STAMP */
        q.line({{0, -0.9f}, {0, -0.1f}});
        q.line({{-0.6f, -0.1f}, {0.6f, -0.1f}, {0.6f, 0.3f}, {-0.6f, 0.3f}}, true);
        q.line({{-0.95f, 0.75f}, {0.95f, 0.75f}});
        break;
    }
}

void picture_icon(const square &q, snapshot_menu_icon icon)
{
    switch (icon) {
    case SNAPSHOT_MENU_ICON_EYE:
        q.line({{-1, 0}, {-0.5f, -0.45f}, {0, -0.6f}, {0.5f, -0.45f}, {1, 0}, {0.5f, 0.45f}, {0, 0.6f}, {-0.5f, 0.45f}},
               true);
        q.dot(0, 0, 0.28f);
        break;
    case SNAPSHOT_MENU_ICON_NEARER:
        q.circle(-0.2f, -0.2f, 0.6f);
        q.line({{0.25f, 0.25f}, {0.9f, 0.9f}});
        break;
    case SNAPSHOT_MENU_ICON_AIM:
        q.circle(0, 0, 0.55f);
        q.dot(0, 0, 0.14f);
        rays_draw(q, 0.55f, 1, 4);
        break;
    case SNAPSHOT_MENU_ICON_SUN:
        q.circle(0, 0, 0.4f);
        rays_draw(q, 0.62f, 0.98f, 8);
        break;
    case SNAPSHOT_MENU_ICON_MOVE: move_draw(q); break;
    case SNAPSHOT_MENU_ICON_LOOK: look_draw(q); break;
    case SNAPSHOT_MENU_ICON_PICTURE:
        q.line({{-0.95f, -0.7f}, {0.95f, -0.7f}, {0.95f, 0.7f}, {-0.95f, 0.7f}}, true);
        q.line({{-0.95f, 0.5f}, {-0.35f, -0.15f}, {0.1f, 0.3f}, {0.4f, 0}, {0.95f, 0.55f}});
        break;
    case SNAPSHOT_MENU_ICON_STEREO:
        q.line({{-1, -0.35f}, {1, -0.35f}});
        q.circle(-0.5f, 0.1f, 0.42f);
        q.circle(0.5f, 0.1f, 0.42f);
        break;
    case SNAPSHOT_MENU_ICON_ON: q.dot(0, 0, 0.55f); break;
    default: q.circle(0, 0, 0.55f); break; /* SNAPSHOT_MENU_ICON_OFF */
    }
}

void piece_icon(const square &q, snapshot_menu_icon icon)
{
    switch (icon) {
    case SNAPSHOT_MENU_ICON_PIECE: /* a pot */
        q.line({{-0.5f, -0.9f}, {0.5f, -0.9f}, {0.32f, -0.6f}, {0.66f, -0.25f}, {0.8f, 0.1f}, {0.74f, 0.5f},
                {0.45f, 0.9f}, {-0.45f, 0.9f}, {-0.74f, 0.5f}, {-0.8f, 0.1f}, {-0.66f, -0.25f}, {-0.32f, -0.6f}},
               true);
        break;
    case SNAPSHOT_MENU_ICON_UNDO: arrow_draw(q, -1); break;
    case SNAPSHOT_MENU_ICON_REDO: arrow_draw(q, 1); break;
    case SNAPSHOT_MENU_ICON_FORK:
        q.line({{0, 0.9f}, {0, 0.1f}, {-0.6f, -0.6f}});
        q.line({{0, 0.1f}, {0.6f, -0.6f}});
        q.dot(-0.6f, -0.7f, 0.2f);
        q.dot(0.6f, -0.7f, 0.2f);
        break;
    case SNAPSHOT_MENU_ICON_CLEAR:
        q.line({{-0.7f, -0.7f}, {0.7f, 0.7f}});
        q.line({{0.7f, -0.7f}, {-0.7f, 0.7f}});
        break;
    case SNAPSHOT_MENU_ICON_EXPORT:
        q.line({{-0.8f, 0}, {-0.8f, 0.85f}, {0.8f, 0.85f}, {0.8f, 0}});
        q.line({{0, 0.4f}, {0, -0.5f}});
        q.fill({{-0.35f, -0.45f}, {0, -0.95f}, {0.35f, -0.45f}});
        break;
    case SNAPSHOT_MENU_ICON_BOX: box_draw(q); break;
    case SNAPSHOT_MENU_ICON_PUCK: puck_draw(q); break;
    default: break;
    }
}

} // namespace

void overlay_icon_draw(const overlay_pen &p, snapshot_menu_icon icon, ImVec2 at, float size, ImU32 colour,
                       ImU32 swatch)
{
    const square q = {p.list, at, size / 2, std::max(1.0f, size / 14), colour};
    if (icon == SNAPSHOT_MENU_ICON_PEDAL) {
        overlay_icon_pedal(p, at, size, colour, false);
    } else if (icon == SNAPSHOT_MENU_ICON_SWATCH) {
        p.list->AddCircleFilled(at, size * 0.46f, swatch);
        p.list->AddCircle(at, size * 0.46f, colour, 0, q.thick);
    } else if (icon >= SNAPSHOT_MENU_ICON_BALL && icon <= SNAPSHOT_MENU_ICON_STAMP) {
        tool_icon(q, icon);
    } else {
        piece_icon(q, icon);
        const bool of_piece = (icon >= SNAPSHOT_MENU_ICON_UNDO && icon <= SNAPSHOT_MENU_ICON_CLEAR) ||
                              icon == SNAPSHOT_MENU_ICON_PIECE || icon == SNAPSHOT_MENU_ICON_EXPORT ||
                              icon == SNAPSHOT_MENU_ICON_BOX || icon == SNAPSHOT_MENU_ICON_PUCK;
        if (!of_piece && icon != SNAPSHOT_MENU_ICON_NONE)
            picture_icon(q, icon);
    }
}

void overlay_icon_pedal(const overlay_pen &p, ImVec2 at, float size, ImU32 colour, bool down)
{
    const square q = {p.list, at, size / 2, std::max(1.0f, size / 12), colour};
    const float lift = down ? 0.3f : -0.35f; /* of the toe's end */
    q.line({{-0.95f, 0.75f}, {0.95f, 0.75f}});
    q.fill({{-0.85f, 0.5f}, {-0.85f, 0.25f}, {0.9f, lift - 0.12f}, {0.9f, lift + 0.16f}});
}
