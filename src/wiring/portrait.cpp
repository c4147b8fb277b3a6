/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/portrait.h"

#include "station/camera.h"
#include "station/showing.h"

#include <algorithm>
#include <filesystem>

namespace {

bool concerns_picture(command_kind kind)
{
    return kind >= COMMAND_VIEW && kind != COMMAND_PICTURE && kind != COMMAND_TURNTABLE && kind != COMMAND_EXPORT;
}

bool is_said(const playlist &settings, command_kind kind)
{
    return std::any_of(settings.commands.begin(), settings.commands.end(),
                       [kind](const command &c) { return c.kind == kind; });
}

/* To where the light falls as it did before the eye moved. */
void lights_follow(snapshot *s, double distance_before)
{
    for (snapshot_light &light : s->lights)
        if (light.with_viewer)
            for (double &mm : light.position)
                mm *= s->camera_distance / distance_before;
}

} // namespace

bool portrait_load(portrait *p, const std::string &settings_path, const std::string &config, std::string *text_out)
{
    const std::string path =
        settings_path.empty() ? (std::filesystem::path(config) / "station.tape").string() : settings_path;
    if (!playlist_load(path, "", &p->settings, text_out))
        return false;
    for (const command &c : p->settings.commands)
        if (c.kind == COMMAND_SCENERY_PICTURE)
            p->scenery = playlist_beside(p->settings, c.name);
    return true;
}

snapshot portrait_of(const portrait &p, const sculpture *piece, double aspect, bool turning)
{
    showing shown;
    shown.base.step_mm = piece->step_mm;
    shown.base.box_shown = shown.base.lights_shown = false;
    for (const command &c : p.settings.commands)
        if (concerns_picture(c.kind))
            showing_do(&shown, c);
    shown.base.tool_style = SNAPSHOT_TOOL_HIDDEN;
    shown.base.keeping_shown = false;
    motion_vector lo{}, hi{};
    if (!shown.base.box_shown && sculpture_bounds_mm(piece, lo.data(), hi.data()))
        showing_fit(&shown, lo, hi);
    snapshot s = showing_now(shown);
    if (!is_said(p.settings, COMMAND_CENTRE)) {
        const double distance_before = s.camera_distance;
        const camera_boxes boxes = camera_boxes_of(piece);
        if (turning)
            camera_fit_turning(&s, boxes, aspect);
        else
            camera_fit(&s, boxes, aspect);
        lights_follow(&s, distance_before);
        s.eyes.plane_mm = shown.plane_part * s.camera_distance;
    }
    return s;
}
