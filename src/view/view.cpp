/* SPDX-License-Identifier: Apache-2.0 */
#include "view/view.h"

#include "view/backdrop.h"
#include "view/canvas.h"
#include "view/cubes.h"
#include "view/hollow.h"
#include "view/lens.h"
#include "view/lighting.h"
#include "view/marker.h"
#include "view/overlay.h"
#include "view/program.h"
#include "view/shadow.h"
#include "view/sight.h"
#include "view/skin.h"
#include "view/stereo.h"
#include "view/upload.h"
#include "view/wheel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

struct view {
    view_limits limits;
    std::string lacks;
    double pixels_per_mm = 0; /* of the screen; 0: it does not say */
    quality pace;

    upload clay;
    upload tool; /* of snapshot.tool_surface */
    size_t budget_bytes = VIEW_ALL;
    const surface *tool_surface = nullptr;

    const sculpture *piece = nullptr;
    cubes structure; /* in place of the clay, where that is asked for */

    skin clay_skin;
    marker markers;
    overlay *words = nullptr; /* menus and the strip */
    wheel turntable;
    shadow lamp_shadow;
    hollow hollows;
    lens blur;
    stereo both;
    backdrop ground;

    scenery around;
    snapshot_scenery around_is = SNAPSHOT_SCENERIES; /* which scenery that is; none yet */
    scenery_picture own;

    canvas drawn;
    canvas_target sharp, blurred, eye; /* as drawn; through the lens; at the picture's own size */
    std::array<canvas_target, STEREO_EYES> eyes; /* each eye's, when there are two */
    canvas_target whole;                         /* and what was put together of them */
    canvas_target *last = nullptr;
    uint32_t passes = 0, page_draws = 0;
};

namespace {

constexpr double words_nearer = 0.004; /* than the screen: their parallax, of its width */

/* What one eye's picture is drawn by. */
struct setting {
    snapshot s;          /* lights that move with the viewer: in this eye's space */
    int width, height;   /* of the whole, pixels */
    stereo_size looks;   /* the whole as it looks when it is shown */
    view_part part;
    quality_rules rules;
    bool hollows, lens;
    projection p;
    lighting light;
    double far_shift = 0;
};

bool context_is_good(std::string *trouble_out)
{
    const auto *version = reinterpret_cast<const char *>(glGetString(GL_VERSION));
    int major = 0, minor = 0;
    if (!version || std::sscanf(version, "OpenGL ES %d.%d", &major, &minor) != 2) {
        *trouble_out = "no OpenGL ES context is current";
        return false;
    }
    if (major > 3 || (major == 3 && minor >= 1))
        return true;
    *trouble_out = std::string("OpenGL ES 3.1 is needed, this is ") + version;
    return false;
}

void lack(view *v, const char *what, const std::string &why)
{
    v->lacks += std::string(v->lacks.empty() ? "" : "; ") + what + ": " + why;
}

/* Each of these the picture can do without. */
void open_effects(view *v, const std::string &skin_trouble)
{
    const auto open = [v, &skin_trouble](bool *wanted, const char *what, auto &&opened) {
        std::string why = *wanted ? skin_trouble : "not wanted here";
        if (*wanted && opened(&why))
            return;
        *wanted = false;
        lack(v, what, why);
    };
    view_limits *l = &v->limits;
    open(&l->clay, "the plain look only", [v](std::string *) { return v->clay_skin.clay.program != 0; });
    if (!l->clay) {
        program_close(v->clay_skin.clay.program);
        v->clay_skin.clay = {};
    }
    open(&l->shadows, "no shadows",
         [v](std::string *why) { return v->clay_skin.depth.program != 0 && shadow_open(&v->lamp_shadow, why); });
    open(&l->hollows, "no darker hollows",
         [v](std::string *why) { return v->clay_skin.relief.program != 0 && hollow_open(&v->hollows, why); });
    open(&l->wheel, "no turntable", [v](std::string *why) { return wheel_open(&v->turntable, why); });
    open(&l->lens, "no depth of field",
         [v](std::string *why) { return v->limits.hollows && lens_open(&v->blur, why); }); /* it needs their depths */
    open(&l->stereo, "no stereo", [v](std::string *why) { return stereo_open(&v->both, why); });
    open(&l->backdrop, "an even ground", [v](std::string *why) { return backdrop_open(&v->ground, why); });
    open(&l->marks, "neither tool nor box nor lights", [v](std::string *why) { return marker_open(&v->markers, why); });
    open(&l->cubes, "no cubes", [v](std::string *why) { return cubes_open(&v->structure, why); });
    open(&l->words, "no menus", [v](std::string *why) { return (v->words = overlay_open(why)) != nullptr; });
}

bool open_all(view *v, std::string *trouble_out)
{
    std::string skin_trouble, text;
    if (!skin_open(&v->clay_skin, &skin_trouble)) {
        *trouble_out = skin_trouble;
        return false;
    }
    if (!scenery_open(&v->around, SNAPSHOT_SCENERY_STUDIO, v->own, trouble_out))
        return false;
    v->around_is = SNAPSHOT_SCENERY_STUDIO;
    upload_init(&v->clay, false);
    upload_init(&v->tool, true);
    open_effects(v, skin_trouble);
    if (v->words && overlay_message_take(v->words, &text))
        lack(v, "plain letters", text);
    glUseProgram(0);
    return true;
}

/* --- light --- */

/* Where there is no memory for another, the one before stays. */
void surround(view *v, snapshot_scenery which)
{
    if (v->around_is == which)
        return;
    v->around_is = which;
    scenery made;
    std::string why;
    if (!scenery_open(&made, which, v->own, &why)) {
        lack(v, "no other scenery", why);
        return;
    }
    scenery_close(&v->around);
    v->around = made;
}

void cast_shadow(view *v, setting *t)
{
    const projection_ball ball = sight_of_bricks(t->s, v->clay.bricks, t->p.eye_from_world);
    if (!t->s.effects.shadows || !(ball.radius > 0) || t->light.lamps.count == 0)
        return;
    t->light.shadow_taps = t->rules.shadow_taps;
    if (t->light.shadow_taps == 0)
        return;
    t->light.sight = shadow_look(t->p, ball, glm::dvec3(t->light.lamps.place[0]));
    if (!shadow_is_stale(v->lamp_shadow, t->light.sight, v->clay.newest))
        return;
    shadow_begin(v->lamp_shadow);
    skin_draw_depth(v->clay_skin, v->clay, t->s, t->light.sight.from_lamp);
    shadow_end(&v->lamp_shadow, t->light.sight, v->clay.counts.waiting ? 0 : v->clay.newest);
    v->passes++;
    v->page_draws += static_cast<uint32_t>(v->clay.pages.size());
}

void find_hollows(view *v, setting *t, bool wheel)
{
    if (!t->hollows)
        return;
    hollow_begin(v->hollows);
    skin_draw_relief(v->clay_skin, v->clay, t->s, t->p);
    if (wheel)
        wheel_draw_relief(v->turntable, t->s, t->p);
    hollow_end(v->hollows, t->p, HOLLOW_REACH * t->s.camera_distance,
               HOLLOW_WIDEST * t->height * t->rules.scale,
               t->rules.hollow_taps ? t->rules.hollow_taps : HOLLOW_TAPS_FEWER, t->light.origin);
    t->light.hollow = v->hollows.smoothed.texture;
    t->light.hollow_strength = t->rules.hollow_taps ? std::clamp(t->s.effects.occlusion, 0.0f, 1.0f) : 0;
    v->passes += 3;
    v->page_draws += static_cast<uint32_t>(v->clay.pages.size());
}

/* --- one picture --- */

bool shows_cubes(const view &v, const snapshot &s)
{
    return v.limits.cubes && s.structure != SNAPSHOT_STRUCTURE_SURFACE;
}

/* Where there is no memory for cubes, the surface is drawn in their place. */
void show_structure(view *v, const snapshot &s)
{
    std::string why;
    if (!shows_cubes(*v, s) || !v->piece) {
        cubes_clear(&v->structure);
    } else if (!cubes_update(&v->structure, v->piece, s.structure, &why)) {
        v->limits.cubes = false;
        lack(v, "no cubes", why);
    }
}

void draw_scene(view *v, setting *t, bool wheel)
{
    canvas_begin(v->drawn);
    const view_part &q = t->part;
    backdrop_draw(v->ground, skin_look(v->clay_skin, t->s.look),
                  {t->width, t->height, static_cast<double>(t->looks.width) / t->looks.height,
                   {q.x, q.y, q.width, q.height}, t->far_shift});
    lighting_bind(t->light);
    if (shows_cubes(*v, t->s))
        cubes_draw(v->structure, t->s, t->p);
    else
        skin_draw(v->clay_skin, v->clay, t->s, t->p, t->light);
    if (wheel)
        wheel_draw(v->turntable, t->s, t->p, t->light);
    lighting_release();
    if (v->limits.marks) {
        marker_draw_box(v->markers, t->s, t->p);
        marker_draw_lights(v->markers, t->s, t->p);
        marker_draw_tool(v->markers, t->s, t->p, t->s.tool_surface ? &v->tool : nullptr);
    }
    glUseProgram(0);
    v->passes++;
    v->page_draws += static_cast<uint32_t>(v->clay.pages.size() + v->tool.pages.size());
}

/* Sides of what is drawn for a picture of this side: fewer pixels where quality says so, more where there is no
   multisampling. */
int drawn_side(const view &v, const setting &t, int side)
{
    const bool lone = t.rules.samples == CANVAS_SAMPLES && canvas_samples_here(v.limits.samples) == 0;
    return std::max(1, static_cast<int>(std::lround(side * t.rules.scale * (lone ? 2 : 1))));
}

/* Buffers of the right size, or none. An effect that there is no memory for is left out from here on. */
bool size_all(view *v, setting *t, std::string *trouble_out)
{
    if (!canvas_fits(t->part.width, t->part.height, trouble_out))
        return false;
    int width = drawn_side(*v, *t, t->part.width), height = drawn_side(*v, *t, t->part.height);
    std::string why;
    if (!canvas_fits(width, height, &why)) {
        width = t->part.width;
        height = t->part.height;
    }
    const int samples = std::min(t->rules.samples, v->limits.samples);
    if (!canvas_size(&v->drawn, width, height, samples, trouble_out) ||
        !canvas_target_size(&v->sharp, width, height, trouble_out))
        return false;
    if (t->hollows && !hollow_size(&v->hollows, width, height, &why)) {
        lack(v, "no darker hollows, no depth of field", why);
        v->limits.hollows = v->limits.lens = t->hollows = t->lens = false;
    }
    if (t->lens && !canvas_target_size(&v->blurred, width, height, &why)) {
        lack(v, "no depth of field", why);
        v->limits.lens = t->lens = false;
    }
    return true;
}

/* One eye's picture, in a target of the picture's size: the last of the three that it went through. */
bool draw_eye(view *v, setting *t, std::string *trouble_out)
{
    const bool wheel = v->limits.wheel && skin_look(v->clay_skin, t->s.look) != SNAPSHOT_LOOK_PLAIN &&
                       wheel_is_seen(t->s, t->p);
    t->light.near_mm = t->p.near_mm;
    t->light.far_mm = t->p.far_mm;
    find_hollows(v, t, wheel);
    draw_scene(v, t, wheel);
    canvas_end(v->drawn, v->sharp);
    v->last = &v->sharp;
    if (t->lens) {
        glBindFramebuffer(GL_FRAMEBUFFER, v->blurred.framebuffer);
        glViewport(0, 0, v->blurred.width, v->blurred.height);
        lens_draw(v->blur, v->sharp.texture, v->hollows.smoothed.texture, t->p, t->s.eyes.plane_mm, t->s.effects.blur,
                  t->looks.height, t->light.origin);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        v->last = &v->blurred;
        v->passes++;
    }
    if (v->last->width != t->part.width || v->last->height != t->part.height) {
        if (!canvas_target_size(&v->eye, t->part.width, t->part.height, trouble_out))
            return false;
        canvas_copy(*v->last, v->eye);
        v->last = &v->eye;
        v->passes++;
    }
    return true;
}

/* Sharp, and the right way round, whatever was done to the picture. */
void draw_words(const view &v, const setting &t, double shift_pixels)
{
    if (!v.words)
        return;
    const canvas_target &into = *v.last;
    const double across = static_cast<double>(t.width) / t.looks.width,
                 down = static_cast<double>(t.height) / t.looks.height;
    glBindFramebuffer(GL_FRAMEBUFFER, into.framebuffer);
    glViewport(0, 0, into.width, into.height);
    overlay_draw(v.words, t.s, into.width, into.height, v.pixels_per_mm,
                 {shift_pixels, across, down, t.part.x, t.part.y, t.width, t.height});
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

/* All but the projection. */
setting setting_of(const view &v, const snapshot &s, stereo_size size, stereo_size looks, const view_part &part)
{
    setting t{s, size.width, size.height, looks, part, quality_rules_of(v.pace.level), false, false, {}, {}};
    const snapshot_look look = skin_look(v.clay_skin, s.look);
    const bool lit = !shows_cubes(v, s) && (look == SNAPSHOT_LOOK_CLAY || look == SNAPSHOT_LOOK_RAKING);
    t.rules.shadow_taps = lit && v.limits.shadows ? t.rules.shadow_taps : 0;
    t.rules.hollow_taps = lit && v.limits.hollows ? t.rules.hollow_taps : 0;
    t.lens = !shows_cubes(v, s) && v.limits.lens && t.rules.blur && s.effects.blur > 0;
    t.hollows = t.lens || (t.rules.hollow_taps > 0 && s.effects.occlusion > 0);
    t.light.origin = glm::vec2(part.x, size.height - part.y - part.height);
    t.light.scenery = &v.around;
    t.light.shadow = &v.lamp_shadow;
    return t;
}

projection project(const view &v, const snapshot &s, stereo_size looks)
{
    const projection p = sight_of(s, v.clay, v.tool, v.structure.shown.within, looks.width, looks.height);
    return s.effects.mirrored ? projection_mirrored(p) : p;
}

bool draw_mono(view *v, const snapshot &s, stereo_size size, const view_part &part, std::string *trouble_out)
{
    setting t = setting_of(*v, s, size, size, part);
    t.p = projection_of_part(project(*v, s, size), size.width, size.height, {part.x, part.y, part.width, part.height});
    t.light.lamps = lighting_lamps_of(s, t.p.eye_from_world);
    cast_shadow(v, &t);
    if (!size_all(v, &t, trouble_out) || !draw_eye(v, &t, trouble_out))
        return false;
    draw_words(*v, t, 0);
    return true;
}

/* How near and far what is looked at reaches. */
void reach_of(const view &v, const snapshot &s, const projection &p, double *nearest_out, double *farthest_out)
{
    const projection_ball ball = sight_of_bricks(s, v.clay.bricks, p.eye_from_world);
    *nearest_out = std::max(p.near_mm, -ball.middle_eye.z - ball.radius);
    *farthest_out = std::min(p.far_mm, -ball.middle_eye.z + ball.radius);
    if (!(ball.radius > 0) || !(*nearest_out < *farthest_out)) {
        *nearest_out = p.near_mm;
        *farthest_out = p.far_mm;
    }
}

void lights_seen_by(const glm::dmat4 &eye_from_mono, snapshot *s)
{
    for (snapshot_light &light : s->lights) {
        const glm::dvec4 at(light.position[0], light.position[1], light.position[2], 1);
        const glm::dvec4 seen = eye_from_mono * at;
        if (light.with_viewer)
            light.position = {seen.x, seen.y, seen.z};
    }
}

bool draw_stereo(view *v, const snapshot &s, const stereo_screen &screen, const view_part &part,
                 std::string *trouble_out)
{
    const stereo_size looks = stereo_shape(screen), size = stereo_eye_size(screen);
    const projection mono = project(*v, s, looks);
    const projection_part piece = {part.x, part.y, part.width, part.height};
    double nearest = 0, farthest = 0;
    reach_of(*v, s, mono, &nearest, &farthest);
    const double apart = stereo_separation_mm(s.eyes, mono, nearest, farthest);
    setting between = setting_of(*v, s, size, looks, part); /* shadows are the same for both */
    between.p = mono;
    between.light.lamps = lighting_lamps_of(s, mono.eye_from_world);
    cast_shadow(v, &between);
    for (stereo_eye eye : {STEREO_LEFT, STEREO_RIGHT}) {
        const projection_part of = stereo_share_of(screen, eye, piece).of_eye;
        if (of.width == 0)
            continue;
        const stereo_seen e =
            stereo_see(projection_of_part(mono, size.width, size.height, of), s.eyes.plane_mm, apart, eye);
        setting t = setting_of(*v, s, size, looks, {of.x, of.y, of.width, of.height});
        lights_seen_by(e.eye_from_mono, &t.s);
        t.p = e.seen;
        t.far_shift = e.far_shift;
        t.light.lamps = lighting_lamps_of(t.s, t.p.eye_from_world);
        t.light.sight = between.light.sight;
        t.light.shadow_taps = between.light.shadow_taps;
        t.light.mono_from_eye = glm::inverse(e.eye_from_mono);
        if (!size_all(v, &t, trouble_out) || !draw_eye(v, &t, trouble_out))
            return false;
        draw_words(*v, t, (eye == STEREO_LEFT ? 0.5 : -0.5) * words_nearer * looks.width);
        std::swap(v->eyes[eye], *v->last);
    }
    if (!canvas_target_size(&v->whole, part.width, part.height, trouble_out))
        return false;
    glBindFramebuffer(GL_FRAMEBUFFER, v->whole.framebuffer);
    glViewport(0, 0, part.width, part.height);
    stereo_compose(v->both, screen, piece, v->eyes[STEREO_LEFT].texture, v->eyes[STEREO_RIGHT].texture);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glUseProgram(0);
    v->last = &v->whole;
    v->passes++;
    return true;
}

} // namespace

view *view_open(std::string *trouble_out, const view_limits &limits)
{
    if (!context_is_good(trouble_out))
        return nullptr;
    auto v = std::make_unique<view>();
    v->limits = limits;
    if (open_all(v.get(), trouble_out))
        return v.release();
    view_close(v.release());
    return nullptr;
}

void view_close(view *v)
{
    if (!v)
        return;
    canvas_close(&v->drawn);
    for (canvas_target *t : {&v->sharp, &v->blurred, &v->eye, &v->eyes[0], &v->eyes[1], &v->whole})
        canvas_target_close(t);
    cubes_close(&v->structure);
    upload_finish(&v->clay);
    upload_finish(&v->tool);
    skin_close(&v->clay_skin);
    marker_close(&v->markers);
    overlay_close(v->words);
    wheel_close(&v->turntable);
    shadow_close(&v->lamp_shadow);
    hollow_close(&v->hollows);
    lens_close(&v->blur);
    stereo_close(&v->both);
    scenery_close(&v->around);
    backdrop_close(&v->ground);
    delete v;
}

const std::string &view_lacks(const view *v) { return v->lacks; }

bool view_scenery(view *v, scenery_picture own, std::string *trouble_out)
{
    if (own.width < 1 || own.height < 1 ||
        own.rgba.size() != static_cast<size_t>(own.width) * static_cast<size_t>(own.height) * 4) {
        *trouble_out = "a picture for the scenery: expected at least one pixel, four bytes each";
        return false;
    }
    v->own = std::move(own);
    if (v->around_is == SNAPSHOT_SCENERY_OWN)
        v->around_is = SNAPSHOT_SCENERIES;
    return true;
}

bool view_update(view *v, const sculpture *s, std::string *trouble_out, size_t budget_bytes)
{
    static_assert(VIEW_ALL == UPLOAD_ALL && VIEW_FRAME_BYTES >= UPLOAD_BUDGET_LEAST_BYTES);
    v->budget_bytes = budget_bytes;
    v->piece = s;
    return upload_update(&v->clay, &s->surface, budget_bytes, trouble_out);
}

void view_forget(view *v)
{
    upload_clear(&v->clay);
    cubes_clear(&v->structure);
    v->piece = nullptr;
    v->lamp_shadow.generation = 0;
}

bool view_frame_took(view *v, int64_t ns) { return quality_frame(&v->pace, ns); }
const char *view_quality(const view *v) { return quality_text(v->pace.level); }

std::string view_size_fitted(int *width, int *height)
{
    const int w = *width, h = *height;
    std::string text;
    *width = std::max(1, *width);
    *height = std::max(1, *height);
    while (!canvas_fits(*width, *height, &text)) {
        *width = std::max(1, *width / 2);
        *height = std::max(1, *height / 2);
    }
    if (*width == w && *height == h)
        return "";
    return "a screen of " + std::to_string(w) + " x " + std::to_string(h) + " pixels is drawn as " +
           std::to_string(*width) + " x " + std::to_string(*height);
}

bool view_draw(view *v, const snapshot &s, int width, int height, std::string *trouble_out)
{
    return view_draw_part(v, s, width, height, {0, 0, width, height}, trouble_out);
}

bool view_draw_part(view *v, const snapshot &s, int width, int height, const view_part &part, std::string *trouble_out)
{
    v->last = nullptr;
    v->passes = v->page_draws = 0;
    *trouble_out = projection_trouble(s);
    if (!trouble_out->empty())
        return false;
    if (!canvas_fits(part.width, part.height, trouble_out))
        return false;
    assert(width > 0 && height > 0);
    if (s.tool_surface != v->tool_surface)
        upload_clear(&v->tool);
    v->tool_surface = s.tool_surface;
    if (s.tool_surface && !upload_update(&v->tool, s.tool_surface, v->budget_bytes, trouble_out))
        return false;
    surround(v, s.scenery);
    show_structure(v, s);
    const stereo_screen screen = {s.eyes.layout, s.eyes.swapped, width, height, stereo_gap_usual(height)};
    const bool two = v->both.program != 0 && s.eyes.layout != SNAPSHOT_LAYOUT_MONO;
    if (two)
        *trouble_out = stereo_trouble(s.eyes, screen);
    if (!trouble_out->empty())
        return false;
    const bool done = two ? draw_stereo(v, s, screen, part, trouble_out)
                          : draw_mono(v, s, {width, height}, part, trouble_out);
    if (!done)
        v->last = nullptr;
    upload_drawn(&v->clay);
    upload_drawn(&v->tool);
    return done;
}

bool view_pixels(view *v, std::vector<uint8_t> *rgba_out, std::string *trouble_out)
{
    return canvas_read(v->last ? *v->last : canvas_target{}, rgba_out, trouble_out);
}

uint32_t view_texture(const view *v) { return v->last ? v->last->texture : 0; }

void view_screen(view *v, double pixels_per_mm) { v->pixels_per_mm = pixels_per_mm; }

view_counts view_count(const view *v)
{
    return {v->clay.counts.bytes,
            v->clay.counts.patches,
            v->clay.counts.held,
            v->clay.counts.waiting + v->tool.counts.waiting,
            v->drawn.samples,
            v->passes,
            v->page_draws};
}
