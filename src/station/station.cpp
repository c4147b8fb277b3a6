/* SPDX-License-Identifier: Apache-2.0 */
#include "station/station.h"

#include "station/angle.h"
#include "station/hand.h"
#include "station/menu.h"
#include "station/showing.h"
#include "station/strip.h"

#include <algorithm>
#include <deque>
#include <utility>

namespace {

constexpr double CAMERA_AT_REST_MM = 200; /* speeds are meant at this distance and scale with it */
constexpr double MOUSE_RADIANS_A_PIXEL = 0.006, MOUSE_PART_A_PIXEL = 0.001, WHEEL_PART_A_NOTCH = 0.05;
constexpr size_t MESSAGES_MAX = 100;

double radians_of(double degrees) { return degrees * (ANGLE_PI / 180); }

} // namespace

struct station {
    sculpture *piece = nullptr;
    station_ears ears;
    int64_t now_us = 0, next_us = 0; /* commands so far; the next grid point */

    hand tool;
    bool applying = false;
    int applies_held = 0; /* pedals, buttons and commands that hold a stroke open */
    stroke path;
    uint64_t strokes = 0;
    bool refusal_told = false;
    int64_t part_us = 0;      /* when the stroke was last handed to the keeper */
    const char *step = nullptr; /* through history, by name: it waits for what it needs to be read */
    int64_t step_begun_ns = 0;
    std::string trouble_told;

    controls devices = controls_at_first();
    menu rings;
    showing shown;

    std::deque<std::string> pictures, exports, messages;
    std::deque<station_turntable> turntables;
    std::string told; /* the last message */
    int64_t told_us = 0;
    std::vector<command> recording;
};

namespace {

void tell(station *s, std::string text)
{
    s->told = text;
    s->told_us = s->next_us;
    if (s->messages.size() < MESSAGES_MAX)
        s->messages.push_back(std::move(text));
}

/* --- the stroke --- */

int64_t clock_ns(const station *s) { return s->ears.clock_ns ? s->ears.clock_ns() : 0; }

void dab_apply(station *s, const stroke_dab &d)
{
    tool t = hand_tool(&s->tool, s->piece->step_mm);
    sculpture_dab dab = {hand_frame(&s->tool, d.pose), s->tool.rate, d.seconds};
    station_dab report;
    report.time_us = s->next_us;
    report.stroke = s->strokes;
    int64_t start = clock_ns(s);
    report.outcome = sculpture_apply_field(s->piece, &t, &dab, s->ears.counts ? &report.counts.tool : nullptr);
    int64_t between = clock_ns(s);
    if (report.outcome == STATUS_OK)
        report.outcome = sculpture_apply_surface(s->piece, s->ears.counts ? &report.counts.surface : nullptr);
    report.field_ns = between - start;
    report.surface_ns = clock_ns(s) - between;
    if (report.outcome != STATUS_OK && !s->refusal_told) {
        tell(s, std::string("a dab was refused: ") + status_text(report.outcome));
        s->refusal_told = true; /* once a stroke is enough */
    }
    if (s->ears.dab)
        s->ears.dab(report);
}

void dabs_apply(station *s, const std::vector<stroke_dab> &dabs)
{
    for (const stroke_dab &d : dabs)
        if (s->piece->in_stroke) /* the sculpture ends a stroke it had to take back */
            dab_apply(s, d);
}

/* Tells and reports how something went that history has a part in. */
void history_report(station *s, const char *what, status outcome, int64_t begun_ns)
{
    if (outcome != STATUS_OK)
        tell(s, std::string(what) + ": " + status_text(outcome));
    if (s->ears.stroke)
        s->ears.stroke(outcome, clock_ns(s) - begun_ns);
}

void history_act(station *s, status (*act)(sculpture *), const char *what)
{
    const int64_t start = clock_ns(s);
    history_report(s, what, act(s->piece), start);
}

void apply_begin(station *s)
{
    const status room = sculpture_room(s->piece);
    if (room != STATUS_OK) {
        tell(s, std::string("no stroke can begin: ") + status_text(room));
        return;
    }
    s->part_us = s->next_us;
    sculpture_stroke_begin(s->piece);
    s->path = stroke_begin(s->tool.pose);
    s->applying = true;
    s->refusal_told = false;
    s->strokes++;
}

void apply_end(station *s)
{
    std::vector<stroke_dab> dabs;
    stroke_end(&s->path, s->tool.pose, hand_rule(&s->tool), &dabs);
    dabs_apply(s, dabs);
    s->applying = false;
    if (s->piece->in_stroke)
        history_act(s, sculpture_stroke_end, "the stroke was not kept");
    else
        tell(s, "the stroke ended early: the surface has reached its limit");
}

void apply_hold(station *s, bool down)
{
    s->applies_held = std::max(0, s->applies_held + (down ? 1 : -1));
    if (down && !s->applying)
        apply_begin(s);
    else if (!down && s->applying && s->applies_held == 0)
        apply_end(s);
}

/* Undo, redo and the like stand between strokes: one under way ends first. */
void between_strokes(station *s)
{
    if (s->applying)
        apply_end(s);
}

/* Where what the step needs is at hand, it is done at once. */
void step_end_if(station *s, bool ready)
{
    if (!s->step || !ready)
        return;
    const char *what = s->step;
    s->step = nullptr;
    history_report(s, what, sculpture_step_end(s->piece), s->step_begun_ns);
}

void step_begin(station *s, history_way way, const char *what)
{
    between_strokes(s);
    s->step_begun_ns = clock_ns(s);
    s->step = what;
    sculpture_step_begin(s->piece, way, 0);
    step_end_if(s, sculpture_step_is_ready(s->piece));
}

void undo(station *s) { step_begin(s, HISTORY_BACK, "undo"); }
void redo(station *s) { step_begin(s, HISTORY_FORTH, "redo"); }
void go_to_fork(station *s) { step_begin(s, HISTORY_FORK, "fork"); }

/* --- presses --- */

void mean(station *s, controls_meaning m, bool down)
{
    switch (m) {
    case CONTROLS_MEANS_APPLY: apply_hold(s, down); break;
    case CONTROLS_MEANS_CLUTCH: s->devices.clutch = down; break;
    case CONTROLS_MEANS_UNDO:
        if (down)
            undo(s);
        break;
    case CONTROLS_MEANS_REDO:
        if (down)
            redo(s);
        break;
    case CONTROLS_MEANS_FORK:
        if (down)
            go_to_fork(s);
        break;
    case CONTROLS_MEANS_NEXT_ACTION:
        if (down)
            s->tool.kind = static_cast<action>((s->tool.kind + 1) % ACTION_COUNT);
        break;
    case CONTROLS_MEANS_ENVIRONMENT_NEXT:
        if (down)
            showing_environment_next(&s->shown);
        break;
    default:
        if (m >= CONTROLS_MEANS_HOLD)
            showing_hold_set(&s->shown, static_cast<showing_hold>(m - CONTROLS_MEANS_HOLD), down);
        break;
    }
}

/* --- the menu --- */

void do_now(station *s, const command &c);

menu_now_sight menu_sight(const station *s)
{
    menu_now_sight seen{&s->tool, &s->shown, &s->devices};
    return seen;
}

void menu_obey(station *s, const menu_answer &answer)
{
    for (const command &c : answer.commands)
        do_now(s, c);
    if (!answer.said.empty())
        tell(s, answer.said);
}

void do_press(station *s, const command &c)
{
    const bool down = c.number[c.kind == COMMAND_PEDAL ? 1 : 2] == 1;
    controls_press *p = controls_press_of(&s->devices, c);
    if (!p)
        return;
    const bool taken = down && (menu_is_open(s->rings) || p->means == CONTROLS_MEANS_MENU);
    const controls_meaning m = controls_edge(p, down, taken);
    if (!taken) {
        mean(s, m, down);
    } else if (!menu_learns(&s->rings, c)) {
        if (!menu_is_open(s->rings)) /* nobody moves the tool from here on */
            between_strokes(s);
        menu_now_sight seen = menu_sight(s);
        seen.has_piece = sculpture_bounds_mm(s->piece, seen.lo.data(), seen.hi.data());
        menu_obey(s, menu_press(&s->rings, m, seen));
    }
}

/* --- motion --- */

/* Shifts and turns (view frame) what a device moves. */
void thing_move(station *s, controls_thing what, const motion_vector &shift_mm, const motion_vector &turn_radians)
{
    const motion_quaternion scene = s->shown.base.scene_turn;
    motion_vector shift_world = motion_rotate_back(scene, shift_mm);
    if (what == CONTROLS_SCENE) {
        s->shown.centre = motion_sum(s->shown.centre, shift_world, -1);
        s->shown.base.scene_turn = motion_turned(scene, turn_radians);
    } else if (what == CONTROLS_TOOL) {
        s->tool.pose.place = motion_sum(s->tool.pose.place, shift_world);
        s->tool.pose.turn = motion_turned(s->tool.pose.turn, motion_rotate_back(scene, turn_radians));
    } else if (what >= CONTROLS_LIGHT0) {
        snapshot_light &light = s->shown.base.lights[static_cast<size_t>(what - CONTROLS_LIGHT0)];
        light.position = motion_sum(light.position, light.with_viewer ? shift_mm : shift_world);
    }
}

/* An open menu has the pucks for itself, all but the light that one may carry. */
controls_thing puck_moves(const station *s, size_t device)
{
    return menu_is_open(s->rings) ? menu_carries(s->rings) : controls_moved(s->devices, device);
}

void pucks_move(station *s, double seconds)
{
    const double zoom = s->shown.base.camera_distance / CAMERA_AT_REST_MM;
    const double speed_radians = radians_of(s->devices.speed_degrees);
    for (size_t device = 0; device < CONTROLS_PUCKS; device++) {
        controls_thing what = puck_moves(s, device);
        if (what == CONTROLS_NOTHING || s->devices.puck[device] == std::array<int16_t, 6>{})
            continue;
        motion_speed v = motion_filtered(s->devices.filter, s->devices.puck[device]);
        motion_vector shift{}, turn{};
        for (int a = 0; a < 3; a++) {
            shift[a] = v.shift[a] * s->devices.speed_mm * zoom * seconds;
            turn[a] = v.turn[a] * speed_radians * seconds;
        }
        thing_move(s, what, shift, turn);
    }
}

void mouse_move(station *s, double dx, double dy, double wheel)
{
    double mm = s->shown.base.camera_distance;
    const controls_thing what = menu_is_open(s->rings) ? CONTROLS_NOTHING : s->devices.moves[0];
    if (what == CONTROLS_SCENE) /* virtual trackball */
        thing_move(s, what, {0, 0, 0}, {dy * MOUSE_RADIANS_A_PIXEL, dx * MOUSE_RADIANS_A_PIXEL, 0});
    else
        thing_move(s, what,
                   {dx * MOUSE_PART_A_PIXEL * mm, -dy * MOUSE_PART_A_PIXEL * mm, wheel * WHEEL_PART_A_NOTCH * mm},
                   {0, 0, 0});
    if (what == CONTROLS_SCENE)
        s->shown.base.camera_distance = std::clamp(mm * (1 - wheel * WHEEL_PART_A_NOTCH), 0.1, 1e6);
}

void grid_step(station *s)
{
    constexpr double seconds = STATION_STEP_US / 1e6;
    menu_obey(s, menu_advance(&s->rings, seconds, menu_sight(s)));
    pucks_move(s, seconds);
    hand_advance(&s->tool, s->next_us);
    showing_advance(&s->shown, seconds, s->tool.pose.place);
    if (s->applying) {
        std::vector<stroke_dab> dabs;
        stroke_step(&s->path, s->tool.pose, seconds, hand_rule(&s->tool), &dabs);
        dabs_apply(s, dabs);
        if (s->next_us - s->part_us >= STATION_PART_US) {
            sculpture_part(s->piece);
            s->part_us = s->next_us;
        }
    }
}

/* What the keeper has to say, once. */
void attend(station *s)
{
    sculpture_attend(s->piece);
    const std::string trouble = sculpture_facts(s->piece).trouble.text;
    if (trouble != s->trouble_told && !trouble.empty())
        tell(s, trouble);
    s->trouble_told = trouble;
}

/* --- commands, by what they concern --- */

hand_glide glide_of(const station *s, hand_glide_kind kind, int64_t start_us, double ms)
{
    hand_glide g;
    g.kind = kind;
    g.start_us = start_us;
    g.end_us = start_us + static_cast<int64_t>(ms * 1000);
    g.from = s->tool.pose;
    return g;
}

void do_pose(station *s, const command &c)
{
    const auto &n = c.number;
    hand &h = s->tool;
    switch (c.kind) {
    case COMMAND_PLACE:
        h.carry.kind = HAND_GLIDE_NONE;
        h.pose.place = {n[0], n[1], n[2]};
        stroke_jump(&s->path, h.pose);
        break;
    case COMMAND_TURN:
        h.spin.kind = HAND_GLIDE_NONE;
        h.pose.turn = motion_about({n[0], n[1], n[2]}, radians_of(n[3]));
        stroke_jump(&s->path, h.pose);
        break;
    case COMMAND_GLIDE:
        h.carry = glide_of(s, HAND_GLIDE_LINE, c.time_us, n[3]);
        h.carry.to = {n[0], n[1], n[2]};
        break;
    case COMMAND_SPIN:
        h.spin = glide_of(s, HAND_GLIDE_SPIN, c.time_us, n[4]);
        h.spin.axis = {n[0], n[1], n[2]};
        h.spin.radians = radians_of(n[3]);
        break;
    default: /* COMMAND_ORBIT */
        h.carry = glide_of(s, HAND_GLIDE_ORBIT, c.time_us, n[7]);
        h.carry.to = {n[0], n[1], n[2]};
        h.carry.axis = {n[3], n[4], n[5]};
        h.carry.radians = radians_of(n[6]);
        break;
    }
}

void do_tool(station *s, const command &c)
{
    const auto &n = c.number;
    hand &h = s->tool;
    switch (c.kind) {
    case COMMAND_TOOL:
        if (static_cast<int>(n[0]) == HAND_FREEFORM && !h.has_freeform)
            tell(s, "there is no freeform tool yet: make-tool makes one of the clay");
        else
            h.shape = static_cast<hand_shape>(static_cast<int>(n[0]));
        break;
    case COMMAND_MAKE_TOOL: {
        status made = hand_make_tool(&h, s->piece);
        if (made != STATUS_OK)
            tell(s, made == STATUS_BAD_PARAMETER ? "make-tool: there is no clay to make a tool of"
                                                 : std::string("make-tool: ") + status_text(made));
        break;
    }
    case COMMAND_SIZE: h.size_mm = {n[0], n[1], n[2]}; break;
    case COMMAND_SCALE: h.scale = {n[0], n[1], n[2]}; break;
    case COMMAND_BORDER: h.border = n[0]; break;
    case COMMAND_ACTION: h.kind = static_cast<action>(static_cast<int>(n[0])); break;
    case COMMAND_COLOUR: {
        auto rgb = static_cast<uint32_t>(n[0]);
        h.rgba = colour_pack(rgb >> 16 & 255, rgb >> 8 & 255, rgb & 255, 255);
        break;
    }
    case COMMAND_RATE: h.rate = n[0]; break;
    case COMMAND_SPACING: h.spacing = n[0]; break;
    default: { /* COMMAND_DEFORM: its ranges were seen to when it was parsed */
        deform d;
        if (deform_init(&d, n[0], n[1], n[2], n[3], n[4]) == STATUS_OK)
            h.def = d;
        break;
    }
    }
}

/* From the vertices of the surface: what is stored beyond it is no part of the piece. */
void workspace_fit(station *s)
{
    motion_vector lo{}, hi{};
    if (sculpture_bounds_mm(s->piece, lo.data(), hi.data()))
        showing_fit(&s->shown, lo, hi);
    else
        tell(s, "workspace-fit: there is no clay to put it round");
}

void do_picture(station *s, const command &c)
{
    switch (c.kind) {
    case COMMAND_WORKSPACE_FIT: workspace_fit(s); break;
    case COMMAND_PICTURE: s->pictures.push_back(c.name); break;
    case COMMAND_TURNTABLE: s->turntables.push_back({c.name, static_cast<int>(c.number[1])}); break;
    case COMMAND_EXPORT: s->exports.push_back(c.name); break;
    case COMMAND_NAMES_FROM: s->rings.name = static_cast<int>(c.number[0]); break;
    default: showing_do(&s->shown, c); break;
    }
}

void do_device(station *s, const command &c)
{
    switch (c.kind) {
    case COMMAND_BUTTON:
    case COMMAND_PEDAL: do_press(s, c); break;
    case COMMAND_MOUSE: mouse_move(s, c.number[0], c.number[1], c.number[2]); break;
    default: controls_do(&s->devices, c); break; /* a recording: wiring has put its reports in this command's place */
    }
}

void do_now(station *s, const command &c)
{
    switch (c.kind) {
    case COMMAND_APPLY: apply_hold(s, c.number[0] == 1); break;
    case COMMAND_UNDO: undo(s); break;
    case COMMAND_REDO: redo(s); break;
    case COMMAND_FORK: go_to_fork(s); break;
    case COMMAND_CLEAR:
        between_strokes(s);
        history_act(s, sculpture_clear, "clear");
        break;
    case COMMAND_PLACE:
    case COMMAND_TURN:
    case COMMAND_GLIDE:
    case COMMAND_SPIN:
    case COMMAND_ORBIT: do_pose(s, c); break;
    default:
        if (c.kind < COMMAND_APPLY)
            do_device(s, c);
        else if (c.kind < COMMAND_PLACE)
            do_tool(s, c);
        else
            do_picture(s, c);
    }
}

} // namespace

station *station_open(sculpture *piece, station_ears ears)
{
    auto *s = new station;
    s->piece = piece;
    s->ears = std::move(ears);
    s->shown.base.step_mm = piece->step_mm;
    s->shown.base.look = SNAPSHOT_LOOK_CLAY;
    return s;
}

void station_close(station *s)
{
    if (!s)
        return;
    step_end_if(s, true);
    between_strokes(s);
    hand_finish(&s->tool);
    delete s;
}

void station_advance(station *s, int64_t time_us)
{
    step_end_if(s, true);
    for (; s->next_us <= time_us; s->next_us += STATION_STEP_US)
        grid_step(s);
    s->now_us = std::max(s->now_us, time_us);
    attend(s);
}

bool station_is_waiting(station *s)
{
    step_end_if(s, sculpture_step_is_ready(s->piece));
    return s->step != nullptr;
}

void station_do(station *s, const command &c)
{
    assert(c.time_us >= s->now_us);
    station_advance(s, c.time_us);
    if (s->ears.records)
        s->recording.push_back(c);
    do_now(s, c);
}

snapshot station_snapshot(const station *s)
{
    snapshot out = showing_now(s->shown);
    const hand &h = s->tool;
    for (int a = 0; a < 3; a++)
        out.tool_colour[static_cast<size_t>(a)] = static_cast<float>(colour_channel(h.rgba, a)) / 255;
    out.tool_world = hand_frame(&h, h.pose);
    out.tool_working = s->applying;
    const keeper_facts facts = sculpture_facts(s->piece);
    out.keeping = facts.medium != HISTORY_MEDIUM_GOOD              ? SNAPSHOT_KEEPING_FAILS
                  : facts.put != facts.kept || s->piece->in_stroke ? SNAPSHOT_KEEPING_UNDER_WAY
                                                                   : SNAPSHOT_KEEPING_ALL;
    out.menu = menu_shown(s->rings, menu_sight(s));
    const bool shown = out.strip.shown;
    out.strip = strip_now({&s->devices, &h, &s->rings, facts, s->piece->has_history, s->piece->in_stroke,
                           s->strokes > 0, s->told, s->told_us, s->next_us});
    out.strip.shown = shown;
    if (h.shape == HAND_FREEFORM && h.has_freeform) {
        out.tool_surface = &h.made_surface;
        out.tool_middle = {h.made.middle[0], h.made.middle[1], h.made.middle[2]};
    }
    return out;
}

bool station_is_applying(const station *s) { return s->applying; }

static bool front_take(std::deque<std::string> *from, std::string *out)
{
    if (from->empty())
        return false;
    *out = std::move(from->front());
    from->pop_front();
    return true;
}

bool station_picture_take(station *s, std::string *name_out) { return front_take(&s->pictures, name_out); }
bool station_turntable_take(station *s, station_turntable *out)
{
    if (s->turntables.empty())
        return false;
    *out = std::move(s->turntables.front());
    s->turntables.pop_front();
    return true;
}
bool station_export_take(station *s, std::string *name_out) { return front_take(&s->exports, name_out); }
bool station_scenery_take(station *s, std::string *name_out)
{
    *name_out = std::exchange(s->shown.scenery_file, {});
    return !name_out->empty();
}
bool station_message_take(station *s, std::string *text_out) { return front_take(&s->messages, text_out); }
const std::vector<command> &station_recording(const station *s) { return s->recording; }
