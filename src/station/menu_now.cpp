/* SPDX-License-Identifier: Apache-2.0 */
#include "station/menu_now.h"

#include <algorithm>
#include <cassert>

namespace {

/* Fills the numbers in order. */
template <typename... Numbers> void set(command *c, Numbers... numbers)
{
    size_t n = 0;
    ((c->number[n++] = static_cast<double>(numbers)), ...);
}

void tool_now(const hand &h, command *c)
{
    switch (c->kind) {
    case COMMAND_TOOL: set(c, h.shape); break;
    case COMMAND_SIZE: set(c, h.size_mm[0], h.size_mm[1], h.size_mm[2]); break;
    case COMMAND_SCALE: set(c, h.scale[0], h.scale[1], h.scale[2]); break;
    case COMMAND_BORDER: set(c, h.border); break;
    case COMMAND_ACTION: set(c, h.kind); break;
    case COMMAND_COLOUR:
        set(c, colour_channel(h.rgba, 0) << 16 | colour_channel(h.rgba, 1) << 8 | colour_channel(h.rgba, 2));
        break;
    case COMMAND_RATE: set(c, h.rate); break;
    case COMMAND_SPACING: set(c, h.spacing); break;
    default: set(c, h.def.s, h.def.m, h.def.r, h.def.n, h.def.kappa); break; /* COMMAND_DEFORM */
    }
}

void light_now(const snapshot_light &l, int index, command *c)
{
    const auto &at = l.position;
    if (c->kind == COMMAND_LIGHT)
        set(c, index, at[0], at[1], at[2], menu_now_rgb(l.colour), l.strength, l.with_viewer);
    else if (c->kind == COMMAND_LIGHT_WITH)
        set(c, index, l.with_viewer);
    else
        set(c, index);
}

void picture_now(const showing &v, int index, command *c)
{
    const snapshot &s = v.base;
    switch (c->kind) {
    case COMMAND_DISTANCE: set(c, s.camera_distance); break;
    case COMMAND_CENTRE: set(c, v.centre[0], v.centre[1], v.centre[2]); break;
    case COMMAND_LOOK: set(c, s.look); break;
    case COMMAND_STRUCTURE: set(c, s.structure); break;
    case COMMAND_SCENERY: set(c, s.scenery); break;
    case COMMAND_ENVIRONMENT: set(c, s.environment, s.environment_strength); break;
    case COMMAND_OCCLUSION: set(c, s.effects.occlusion); break;
    case COMMAND_SHADOWS: set(c, s.effects.shadows); break;
    case COMMAND_FLOOR: set(c, s.effects.floor); break;
    case COMMAND_BLUR: set(c, s.effects.blur); break;
    case COMMAND_MIRROR: set(c, s.effects.mirrored); break;
    case COMMAND_STEREO: set(c, s.eyes.layout); break;
    case COMMAND_STEREO_EYES: set(c, s.eyes.separation, v.plane_part); break;
    case COMMAND_STEREO_SWAP: set(c, s.eyes.swapped); break;
    case COMMAND_LIGHT:
    case COMMAND_LIGHT_OFF:
    case COMMAND_LIGHT_WITH: light_now(s.lights[static_cast<size_t>(index)], index, c); break;
    case COMMAND_LIGHTS_SHOWN: set(c, s.lights_shown); break;
    case COMMAND_KEEPING_SHOWN: set(c, s.keeping_shown); break;
    case COMMAND_STRIP_SHOWN: set(c, s.strip.shown); break;
    case COMMAND_MATERIAL: set(c, s.material.specular, s.material.shininess, s.material.ambient); break;
    case COMMAND_TOOL_STYLE: set(c, s.tool_style); break;
    case COMMAND_WORKSPACE:
        set(c, s.box_lo[0], s.box_lo[1], s.box_lo[2], s.box_hi[0], s.box_hi[1], s.box_hi[2]);
        break;
    case COMMAND_WORKSPACE_SHOWN: set(c, s.box_shown); break;
    default: assert(false); break;
    }
}

void device_now(const controls &d, int index, command *c)
{
    const auto n = static_cast<size_t>(index);
    switch (c->kind) {
    case COMMAND_MOVES: set(c, index, d.moves[n]); break;
    case COMMAND_MEANS_PEDAL: set(c, index, d.pedal[n].means); break;
    case COMMAND_MEANS_BUTTON: set(c, index, d.button[n].means); break;
    case COMMAND_SPEED: set(c, d.speed_mm, d.speed_degrees); break;
    default: set(c, d.filter.dead_zone, d.filter.curve); break; /* COMMAND_FILTER */
    }
}

} // namespace

uint32_t menu_now_rgb(const std::array<float, 3> &colour)
{
    uint32_t rgb = 0;
    for (const float c : colour)
        rgb = rgb << 8 | static_cast<uint32_t>(std::clamp(c, 0.0f, 1.0f) * 255 + 0.5f);
    return rgb;
}

command menu_now(const menu_now_sight &sight, command_kind kind, int index)
{
    command c;
    c.kind = kind;
    if (kind < COMMAND_APPLY)
        device_now(*sight.devices, index, &c);
    else if (kind < COMMAND_PLACE)
        tool_now(*sight.tool, &c);
    else
        picture_now(*sight.shown, index, &c);
    return c;
}

std::vector<command> menu_now_all(const menu_now_sight &sight, command_kind kind, int index)
{
    std::vector<command> all{menu_now(sight, kind, index)};
    /* Whatever sets a light also lights it. */
    if (kind == COMMAND_LIGHT && !sight.shown->base.lights[static_cast<size_t>(index)].lit)
        all.push_back(menu_now(sight, COMMAND_LIGHT_OFF, index));
    return all;
}

command menu_now_line(const std::string &text)
{
    std::string expected;
    const std::optional<command> c = command_parse(text, &expected);
    assert(c); /* the menus are ours */
    return *c;
}
