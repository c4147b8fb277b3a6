/* SPDX-License-Identifier: Apache-2.0 */
#include "station/showing.h"

#include "station/angle.h"

#include <algorithm>

namespace {

constexpr double FIT_MARGIN = 0.06, FIT_FLATTEST = 0.5; /* of the longest side */

double radians_of(double degrees) { return degrees * (ANGLE_PI / 180); }

std::array<float, 3> rgb_of(double rgb)
{
    auto v = static_cast<uint32_t>(rgb);
    return {static_cast<float>(v >> 16 & 255) / 255, static_cast<float>(v >> 8 & 255) / 255,
            static_cast<float>(v & 255) / 255};
}

motion_vector shift_of(const showing &v) { return motion_rotate(v.base.scene_turn, v.centre); }

/* Into eye space and back. */
motion_vector eye_of_world(const showing &v, const motion_vector &at)
{
    motion_vector eye = motion_sum(motion_rotate(v.base.scene_turn, at), shift_of(v), -1);
    eye[2] -= v.base.camera_distance;
    return eye;
}

motion_vector world_of_eye(const showing &v, motion_vector at)
{
    at[2] += v.base.camera_distance;
    return motion_rotate_back(v.base.scene_turn, motion_sum(at, shift_of(v)));
}

void do_light(showing *v, const command &c)
{
    const auto &n = c.number;
    const auto index = static_cast<size_t>(n[0]);
    if (c.kind == COMMAND_LIGHT)
        v->base.lights[index] = {true, n[6] == 1, {n[1], n[2], n[3]}, rgb_of(n[4]), static_cast<float>(n[5])};
    else if (c.kind == COMMAND_LIGHT_OFF)
        v->base.lights[index].lit = false;
    else
        showing_light_with(v, index, n[1] == 1);
}

void do_stereo(showing *v, const command &c)
{
    const auto &n = c.number;
    switch (c.kind) {
    case COMMAND_STEREO: v->base.eyes.layout = static_cast<snapshot_layout>(static_cast<int>(n[0])); break;
    case COMMAND_STEREO_EYES:
        v->base.eyes.separation = n[0];
        v->plane_part = n[1];
        break;
    default: v->base.eyes.swapped = n[0] == 1; break; /* COMMAND_STEREO_SWAP */
    }
}

void do_effect(showing *v, const command &c)
{
    const auto &n = c.number;
    snapshot_effects &e = v->base.effects;
    switch (c.kind) {
    case COMMAND_OCCLUSION: e.occlusion = static_cast<float>(n[0]); break;
    case COMMAND_SHADOWS: e.shadows = n[0] == 1; break;
    case COMMAND_FLOOR: e.floor = n[0] == 1; break;
    case COMMAND_BLUR: e.blur = static_cast<float>(n[0]); break;
    default: e.mirrored = n[0] == 1; break; /* COMMAND_MIRROR */
    }
}

} // namespace

void showing_do(showing *v, const command &c)
{
    const auto &n = c.number;
    snapshot &s = v->base;
    /* Where the first argument is no index it may be negative, and is not used as one. */
    const auto index = static_cast<int>(n[0]);
    switch (c.kind) {
    case COMMAND_VIEW:
        s.scene_turn = motion_about({n[0], n[1], n[2]}, radians_of(n[3]));
        s.camera_distance = n[4];
        break;
    case COMMAND_DISTANCE: s.camera_distance = n[0]; break;
    case COMMAND_CENTRE: v->centre = {n[0], n[1], n[2]}; break;
    case COMMAND_LOOK: s.look = static_cast<snapshot_look>(index); break;
    case COMMAND_STRUCTURE: s.structure = static_cast<snapshot_structure>(index); break;
    case COMMAND_SCENERY: s.scenery = static_cast<snapshot_scenery>(index); break;
    case COMMAND_SCENERY_PICTURE:
        s.scenery = SNAPSHOT_SCENERY_OWN;
        v->scenery_file = c.name;
        break;
    case COMMAND_ENVIRONMENT:
        s.environment = static_cast<snapshot_environment>(index);
        s.environment_strength = static_cast<float>(n[1]);
        break;
    case COMMAND_ENVIRONMENT_NEXT: showing_environment_next(v); break;
    case COMMAND_OCCLUSION:
    case COMMAND_SHADOWS:
    case COMMAND_FLOOR:
    case COMMAND_BLUR:
    case COMMAND_MIRROR: do_effect(v, c); break;
    case COMMAND_HOLD: showing_hold_set(v, static_cast<showing_hold>(index), n[1] == 1); break;
    case COMMAND_STEREO:
    case COMMAND_STEREO_EYES:
    case COMMAND_STEREO_SWAP: do_stereo(v, c); break;
    case COMMAND_LIGHT:
    case COMMAND_LIGHT_OFF:
    case COMMAND_LIGHT_WITH: do_light(v, c); break;
    case COMMAND_LIGHTS_SHOWN: s.lights_shown = index == 1; break;
    case COMMAND_KEEPING_SHOWN: s.keeping_shown = index == 1; break;
    case COMMAND_STRIP_SHOWN: s.strip.shown = index == 1; break;
    case COMMAND_MATERIAL:
        s.material = {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])};
        break;
    case COMMAND_TOOL_STYLE: s.tool_style = static_cast<snapshot_tool_style>(index); break;
    case COMMAND_WORKSPACE:
        s.box_lo = {n[0], n[1], n[2]};
        s.box_hi = {n[3], n[4], n[5]};
        break;
    case COMMAND_WORKSPACE_SHOWN: s.box_shown = index == 1; break;
    default: break;
    }
}

void showing_hold_set(showing *v, showing_hold what, bool down)
{
    v->held[what] = std::max(0, v->held[what] + (down ? 1 : -1));
}

void showing_environment_next(showing *v)
{
    v->base.environment =
        static_cast<snapshot_environment>((v->base.environment + 1) % (SNAPSHOT_ENVIRONMENT_CLEARCOAT + 1));
}

void showing_fit(showing *v, const motion_vector &lo, const motion_vector &hi)
{
    const motion_vector size = motion_sum(hi, lo, -1);
    const double longest = std::max({size[0], size[1], size[2]});
    for (size_t a = 0; a < 3; a++) {
        const double half = 0.5 * std::max(size[a] + 2 * FIT_MARGIN * longest, FIT_FLATTEST * longest);
        const double middle = 0.5 * (lo[a] + hi[a]);
        v->base.box_lo[a] = middle - half;
        v->base.box_hi[a] = middle + half;
    }
    /* The piece stands on the box's bottom: the turntable lies there. */
    v->base.box_hi[1] += lo[1] - v->base.box_lo[1];
    v->base.box_lo[1] = lo[1];
}

void showing_light_with(showing *v, size_t light, bool viewer)
{
    snapshot_light &l = v->base.lights[light];
    if (l.with_viewer == viewer)
        return;
    l.position = viewer ? eye_of_world(*v, l.position) : world_of_eye(*v, l.position);
    l.with_viewer = viewer;
}

void showing_advance(showing *v, double seconds, const motion_vector &tool_world)
{
    const double camera_mm = v->base.camera_distance;
    double work_mm = camera_mm;
    if (v->base.tool_style != SNAPSHOT_TOOL_HIDDEN)
        work_mm = std::clamp(-eye_of_world(*v, tool_world)[2], SHOWING_PLANE_NEAREST * camera_mm,
                             SHOWING_PLANE_FARTHEST * camera_mm);
    const double part = v->plane_mm > 0 ? std::min(1.0, SHOWING_PLANE_RATE * seconds) : 1;
    v->plane_mm += part * (work_mm - v->plane_mm);
}

snapshot showing_now(const showing &v)
{
    snapshot s = v.base;
    const motion_vector shift = shift_of(v);
    for (size_t a = 0; a < 3; a++)
        s.scene_shift[a] = -shift[a];
    s.eyes.plane_mm = v.plane_part * (v.plane_mm > 0 ? v.plane_mm : s.camera_distance);
    if (v.held[SHOWING_HOLD_PLAIN])
        s.look = SNAPSHOT_LOOK_PLAIN;
    if (v.held[SHOWING_HOLD_RAKING])
        s.look = SNAPSHOT_LOOK_RAKING;
    if (v.held[SHOWING_HOLD_SILHOUETTE])
        s.look = SNAPSHOT_LOOK_SILHOUETTE;
    if (v.held[SHOWING_HOLD_MIRROR])
        s.effects.mirrored = !s.effects.mirrored;
    if (v.held[SHOWING_HOLD_BARE]) {
        s.tool_style = SNAPSHOT_TOOL_HIDDEN;
        s.box_shown = s.lights_shown = s.effects.floor = false;
    }
    return s;
}
