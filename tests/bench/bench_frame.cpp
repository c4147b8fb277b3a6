/* SPDX-License-Identifier: Apache-2.0 */
/* What a frame costs: pieces of a hundred thousand, one million and five million triangles, drawn headless in two sizes,
 * each effect on its own as a ratio to the plain frame of the same run; then the bytes that a dab sends to the device.
 * Effects take turns; each is drawn once, then a plain frame and one with the effect are timed side by side. A row is
 * the median of those ratios, spread the way from their first quartile to their third. The processor waits for the device only at a timed frame's end. The exit
 * code is 1 when something cannot be drawn.
 *
 *   --fast            320 x 180 and 640 x 360, no five millions, fewer rounds
 *   --triangles N     only the piece with about so many
 *   --json FILE       the same numbers for programs */
#include "bench_clock.h"
#include "bench_machine.h"
#include "bench_object.h"
#include "bench_record.h"
#include "field_fill.h"
#include "platform/display/display.h"
#include "view/view.h"

#include <GLES3/gl31.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {

constexpr double SIZE_BUDGET_S = 90; /* of one piece in one size; at least ROUNDS_LEAST are made whatever they take */
constexpr size_t ROUNDS = 9, ROUNDS_LEAST = 3;

struct options {
    bool fast = false;
    double triangles = 0;
    std::string json;
};

[[noreturn]] void refuse(const std::string &what, int code)
{
    std::fprintf(stderr, "bench_frame: %s\n", what.c_str());
    std::exit(code);
}

void demand(bool good, const std::string &what)
{
    if (!good)
        refuse(what, 1);
}

options parse(int argc, char **argv)
{
    options o;
    for (int n = 1; n < argc; n++) {
        const std::string word = argv[n];
        const bool has_value = n + 1 < argc;
        if (word == "--fast")
            o.fast = true;
        else if (word == "--triangles" && has_value && std::atof(argv[n + 1]) > 0)
            o.triangles = std::atof(argv[++n]);
        else if (word == "--json" && has_value)
            o.json = argv[++n];
        else
            refuse(word + " is not an option, or has no value\n"
                          "usage: bench_frame [--fast] [--triangles N] [--json FILE]", 2);
    }
    return o;
}

/* --- pieces --- */

struct piece_closes {
    void operator()(sculpture *s) const
    {
        demand(sculpture_close(s) == STATUS_OK, "sculpture_close");
        delete s;
    }
};
using held_piece = std::unique_ptr<sculpture, piece_closes>;

held_piece opened()
{
    history_finding finding;
    auto s = std::make_unique<sculpture>();
    demand(sculpture_open(s.get(), nullptr, CAPACITY_BRICKS, nullptr, 1.0, &finding) == STATUS_OK, "sculpture_open");
    return held_piece(s.release());
}

void add_ball(sculpture *s, const std::array<double, 3> &at, double radius, uint32_t rgba)
{
    box held = box_empty();
    for (const double way : {-1.0, 1.0})
        held = box_include(held, {static_cast<int32_t>(at[0] + way * (radius + 3)),
                                  static_cast<int32_t>(at[1] + way * (radius + 3)),
                                  static_cast<int32_t>(at[2] + way * (radius + 3))});
    field_fill(&s->clay, held, rgba, [&](double x, double y, double z) {
        const double away = std::sqrt((x - at[0]) * (x - at[0]) + (y - at[1]) * (y - at[1]) + (z - at[2]) * (z - at[2]));
        return POTENTIAL_ISO + 0.7 * (radius - away);
    });
}

/* A trefoil knot of balls, thick and thin by turns, so that it hides and shadows itself. */
void add_knot(sculpture *s, double size)
{
    constexpr int balls = 240;
    for (int n = 0; n < balls; n++) {
        const double t = 2 * M_PI * n / balls, wide = size * (1 + 0.42 * std::cos(3 * t));
        const std::array<double, 3> at = {wide * std::cos(2 * t), wide * std::sin(2 * t), size * 0.55 * std::sin(3 * t)};
        const unsigned shade = 150 + static_cast<unsigned>(n) % 60;
        add_ball(s, at, size * (0.17 + 0.05 * std::sin(17 * t)), colour_pack(shade, 125, 95, 255));
    }
    field_fill_finish(s);
}

/* Of about so many triangles, 100 mm across whatever that takes. A small one tells how large it must be. */
held_piece knot_of(double triangles)
{
    double size = 60;
    held_piece s = opened();
    add_knot(s.get(), size);
    size *= std::sqrt(triangles / static_cast<double>(s->surface.triangles));
    s = opened();
    add_knot(s.get(), size);
    s->step_mm = 50 / (1.65 * size);
    return s;
}

/* --- effects --- */

/* The plain frame: clay under lights, nothing else. */
snapshot plain_of(const sculpture *s)
{
    snapshot p;
    p.step_mm = s->step_mm;
    p.camera_distance = 190;
    p.scene_turn = {std::cos(0.3), std::sin(0.3), 0, 0};
    p.look = SNAPSHOT_LOOK_PLAIN;
    p.effects = {0, false, false, 0, false};
    p.tool_style = SNAPSHOT_TOOL_HIDDEN;
    p.box_shown = p.lights_shown = false;
    p.lights[0] = {true, true, {-120, 160, 160}, {1, 0.95f, 0.88f}, 1};
    p.lights[1] = {true, true, {170, 40, 90}, {0.74f, 0.82f, 1}, 0.45f};
    for (int a = 0; a < 3; a++)
        p.tool_world.axis[a][a] = 12;
    p.tool_world.origin[0] = 30;
    return p;
}

struct effect {
    std::string name;
    std::function<void(snapshot *, int)> change; /* with the frame's number */
    bool without_samples = false;
};

void clay_look(snapshot *s) { s->look = SNAPSHOT_LOOK_CLAY; }

std::vector<effect> effects()
{
    std::vector<effect> list = {
        {"plain", [](snapshot *, int) {}},
        {"one sample a pixel", [](snapshot *, int) {}, true},
        {"mirrored", [](snapshot *s, int) { s->effects.mirrored = true; }},
        {"environment opaque", [](snapshot *s, int) { s->environment = SNAPSHOT_ENVIRONMENT_OPAQUE; }},
        {"environment semi", [](snapshot *s, int) { s->environment = SNAPSHOT_ENVIRONMENT_SEMI; }},
        {"environment clear coat", [](snapshot *s, int) { s->environment = SNAPSHOT_ENVIRONMENT_CLEARCOAT; }},
        {"box and lights", [](snapshot *s, int) { s->box_shown = s->lights_shown = true; }},
        {"tool wire", [](snapshot *s, int) { s->tool_style = SNAPSHOT_TOOL_WIREFRAME; }},
        {"tool transparent", [](snapshot *s, int) { s->tool_style = SNAPSHOT_TOOL_TRANSPARENT; }},
        {"structure stored", [](snapshot *s, int) { s->structure = SNAPSHOT_STRUCTURE_STORED; }},
        {"structure crossing", [](snapshot *s, int) { s->structure = SNAPSHOT_STRUCTURE_CROSSING; }},
        {"silhouette", [](snapshot *s, int) { s->look = SNAPSHOT_LOOK_SILHOUETTE; }},
        {"clay", [](snapshot *s, int) { clay_look(s); }},
        {"clay, occlusion", [](snapshot *s, int) { clay_look(s), s->effects.occlusion = 0.6f; }},
        {"clay, shadows", [](snapshot *s, int) { clay_look(s), s->effects.shadows = true; }},
        {"clay, shadows, lamp moving",
         [](snapshot *s, int frame) {
             clay_look(s);
             s->effects.shadows = true;
             s->lights[0].position[0] += frame % 7 - 3;
         }},
        {"clay, floor", [](snapshot *s, int) { clay_look(s), s->effects.floor = true; }},
        {"clay, blur", [](snapshot *s, int) { clay_look(s), s->effects.blur = 0.5f; }},
        {"clay, all of these", [](snapshot *s, int frame) {
             clay_look(s);
             s->effects = {0.6f, true, true, 0.5f, false};
             s->environment = SNAPSHOT_ENVIRONMENT_CLEARCOAT;
             s->lights[0].position[0] += frame % 7 - 3;
         }},
        {"raking", [](snapshot *s, int) { s->look = SNAPSHOT_LOOK_RAKING, s->effects.shadows = true; }},
    };
    const char *layouts[SNAPSHOT_LAYOUTS] = {"mono", "side half", "side full", "top half", "top full", "rows", "columns",
                                             "checker", "anaglyph", "packed"};
    for (int n = 1; n < SNAPSHOT_LAYOUTS; n++)
        list.push_back({std::string("stereo ") + layouts[n],
                        [n](snapshot *s, int) { s->eyes.layout = static_cast<snapshot_layout>(n); }});
    return list;
}

/* --- frames --- */

struct view_closes {
    void operator()(view *v) const { view_close(v); }
};
using held_view = std::unique_ptr<view, view_closes>;

held_view open_view(int samples)
{
    std::string trouble;
    view_limits limits;
    limits.samples = samples;
    view *v = view_open(&trouble, limits);
    demand(v, trouble);
    return held_view(v);
}

void show(view *v, const sculpture *s)
{
    std::string trouble;
    demand(view_update(v, s, &trouble), trouble);
}

void draw(view *v, const snapshot &s, int width, int height)
{
    std::string trouble;
    demand(view_draw(v, s, width, height, &trouble), trouble);
}

struct row {
    std::vector<double> seconds, ratios;
    view_counts counts{};
};

double frame_s(view *v, const snapshot &s, int width, int height)
{
    glFinish();
    const double start = bench_clock_wall_s();
    draw(v, s, width, height);
    glFinish();
    return bench_clock_wall_s() - start;
}

struct pair_s {
    double plain, effect;
};

/* The plain frame right beside it: a machine that has other things to do is as slow for both. */
pair_s measure_pair(view *several, view *single, const effect &e, const snapshot &plain, int width, int height,
                    int *frame)
{
    view *v = e.without_samples ? single : several;
    snapshot s = plain;
    e.change(&s, ++*frame);
    draw(v, s, width, height);
    const double plain_s = frame_s(several, plain, width, height);
    s = plain;
    e.change(&s, ++*frame);
    return {plain_s, frame_s(v, s, width, height)};
}

void measure_size(view *several, view *single, const sculpture *s, int width, int height, bool fast,
                  bench_record &figures)
{
    const std::vector<effect> list = effects();
    const snapshot plain = plain_of(s);
    std::vector<row> rows(list.size());
    int frame = 0;
    const double start = bench_clock_wall_s();
    for (size_t round = 0; round < (fast ? ROUNDS_LEAST : ROUNDS); round++) {
        if (round >= ROUNDS_LEAST && bench_clock_wall_s() - start > SIZE_BUDGET_S)
            break;
        for (size_t n = 0; n < list.size(); n++) {
            const pair_s p = measure_pair(several, single, list[n], plain, width, height, &frame);
            rows[n].seconds.push_back(p.effect);
            rows[n].ratios.push_back(p.effect / p.plain);
            rows[n].counts = view_count(list[n].without_samples ? single : several);
        }
    }
    std::printf("%d x %d, %.2f million triangles, %zu rounds\n  %-28s %9s %8s %8s   %7s %6s %6s\n", width, height,
                1e-6 * static_cast<double>(s->surface.triangles), rows[0].seconds.size(), "", "ms", "ratio", "spread",
                "samples", "passes", "pages");
    for (size_t n = 0; n < list.size(); n++) {
        const row &r = rows[n];
        const double ms = 1e3 * bench_clock_median(r.seconds), ratio = bench_clock_median(r.ratios);
        const double spread = bench_clock_quantile(r.ratios, 0.75) - bench_clock_quantile(r.ratios, 0.25);
        std::printf("  %-28s %9.2f %8.2f %8.2f   %7d %6u %6u\n", list[n].name.c_str(), ms, ratio, spread,
                    r.counts.samples, r.counts.passes, r.counts.page_draws);
        figures.add("frame", {{"effect", list[n].name}},
                    {{"triangles", static_cast<double>(s->surface.triangles)}, {"width", double(width)},
                     {"height", double(height)}, {"ms", ms}, {"ratio", ratio}, {"spread", spread},
                     {"samples", double(r.counts.samples)}, {"passes", double(r.counts.passes)},
                     {"page_draws", double(r.counts.page_draws)}});
    }
    std::printf("\n");
    std::fflush(stdout);
}

void measure_piece(double triangles, const options &o, bench_record &figures)
{
    const held_piece s = knot_of(triangles);
    held_view several = open_view(4), single = open_view(0);
    const double start = bench_clock_wall_s();
    show(several.get(), s.get());
    glFinish();
    std::printf("%.2f million triangles in %u patches, %.1f million corners: first upload %.0f ms, %.1f MB\n",
                1e-6 * static_cast<double>(s->surface.triangles), view_count(several.get()).patches,
                1e-6 * static_cast<double>(s->clay.corners), 1e3 * (bench_clock_wall_s() - start),
                1e-6 * static_cast<double>(view_count(several.get()).uploaded_bytes));
    show(single.get(), s.get());
    const int widths[2] = {o.fast ? 320 : 960, o.fast ? 640 : 1920};
    for (const int width : widths)
        measure_size(several.get(), single.get(), s.get(), width, width * 9 / 16, o.fast, figures);
}

/* --- dabs --- */

/* Toothpaste along a ball of 60 steps; every dab is shown in a frame of its own. */
void measure_dabs(double radius, bool fast, bench_record &figures)
{
    held_piece s = opened();
    add_ball(s.get(), {0, 0, 0}, 60, colour_pack(180, 120, 90, 255));
    field_fill_finish(s.get());
    held_view v = open_view(4);
    show(v.get(), s.get());
    ellipsoid ball;
    demand(ellipsoid_init(&ball, ELLIPSOID_WYVILL, 1) == STATUS_OK, "ellipsoid_init");
    const snapshot plain = plain_of(s.get());
    draw(v.get(), plain, 240, 135);
    std::vector<double> bytes, patches, update_s;
    sculpture_stroke_begin(s.get());
    for (const bench_object_dab &d : bench_object_spiral(s->clay, radius, 0.3, fast ? 40 : 120)) {
        const tool t = {ellipsoid_shape(&ball), d.kind, d.rgba, deform_default()};
        const sculpture_dab placed = {d.dab.at, d.dab.amount, 1.0};
        demand(sculpture_apply(s.get(), &t, &placed, nullptr) == STATUS_OK, "sculpture_apply");
        const view_counts before = view_count(v.get());
        const double start = bench_clock_wall_s();
        show(v.get(), s.get());
        update_s.push_back(bench_clock_wall_s() - start);
        draw(v.get(), plain, 240, 135);
        const view_counts after = view_count(v.get());
        bytes.push_back(static_cast<double>(after.uploaded_bytes - before.uploaded_bytes));
        patches.push_back(static_cast<double>(after.uploaded_patches - before.uploaded_patches));
    }
    demand(sculpture_stroke_end(s.get()) == STATUS_OK, "sculpture_stroke_end");
    const double kb = 1e-3 * bench_clock_median(bytes), most = 1e-3 * bench_clock_quantile(bytes, 1);
    std::printf("  R = %-4.0f %10.1f %10.1f %10.0f %12.0f\n", radius, kb, most, bench_clock_median(patches),
                1e6 * bench_clock_median(update_s));
    figures.add("upload", {}, {{"radius", radius}, {"kilobytes", kb}, {"kilobytes_most", most},
                               {"patches", bench_clock_median(patches)}, {"us", 1e6 * bench_clock_median(update_s)}});
}

std::string gl_text(GLenum what)
{
    const auto *text = reinterpret_cast<const char *>(glGetString(what));
    return text ? text : "unknown";
}

} // namespace

int main(int argc, char **argv)
{
    const options o = parse(argc, argv);
    display_trouble missing;
    display *screen = display_open(DISPLAY_HEADLESS, &missing);
    demand(screen && display_make_current(screen, &missing), missing.text);
    bench_record figures;
    std::printf("%sdevice    %s, %s\n\n", bench_machine_text().c_str(), gl_text(GL_RENDERER).c_str(),
                gl_text(GL_VERSION).c_str());
    figures.add("machine", {{"processor", bench_machine_processor()}, {"device", gl_text(GL_RENDERER)}}, {});
    for (const double triangles : {1e5, 1e6, 5e6}) {
        const bool wanted = o.triangles > 0 ? std::abs(std::log10(o.triangles / triangles)) < 0.35
                                            : !(o.fast && triangles > 1e6);
        if (wanted)
            measure_piece(triangles, o, figures);
    }
    std::printf("bytes to the device, a dab of toothpaste a frame\n  %-8s %10s %10s %10s %12s\n", "", "kB", "most kB",
                "patches", "update us");
    for (const double radius : {4.0, 8.0, 16.0, 32.0})
        measure_dabs(radius, o.fast, figures);
    display_close(screen);
    if (!o.json.empty() && !figures.write(o.json))
        refuse(o.json + " cannot be written", 2);
    return 0;
}
