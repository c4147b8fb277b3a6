/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/timelapse.h"

#include "station/opening.h"
#include "station/overlay_store.h"
#include "wiring/portrait.h"
#include "wiring/progress.h"
#include "wiring/sequence.h"
#include "wiring/store.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace {

namespace fs = std::filesystem;

constexpr const char *FRAME = "frame";
constexpr uint64_t BUDGET_BYTES = uint64_t{1} << 40; /* in memory: nothing is forgotten to make room for a step */

int complain(int exit, const std::string &text)
{
    std::fprintf(stderr, "glaise: %s\n", text.c_str());
    return exit;
}

/* A piece's past, as it is gone through. */
struct past {
    const arguments *wanted = nullptr;
    store *folder = nullptr;
    overlay_store over;
    std::unique_ptr<sculpture> piece = std::make_unique<sculpture>();
    bool open = false;
    stage *scene = nullptr;
    snapshot shown;
    int strokes = 0; /* from the oldest to where the piece stands */
};

bool lies_within(const fs::path &inner, const fs::path &outer)
{
    std::error_code error;
    const fs::path in = fs::weakly_canonical(inner, error), out = fs::weakly_canonical(outer, error);
    return std::mismatch(out.begin(), out.end(), in.begin(), in.end()).first == out.end();
}

/* Pictures of an earlier, longer time-lapse among them would make a film that never was. */
std::string first_frame_in(const fs::path &folder)
{
    std::error_code error;
    for (const auto &entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(std::string(FRAME) + "-") && name.ends_with(".png"))
            return name;
    }
    return "";
}

/* What can be said before anything is opened. Empty: all is well. */
std::string wrong_with(const arguments &a)
{
    std::error_code error;
    if (!fs::is_directory(a.input, error))
        return a.input + ": expected a store, which is a folder";
    if (lies_within(a.pictures, a.input))
        return a.pictures + ": expected a folder outside the store, which is not to be changed";
    const std::string frame = first_frame_in(a.pictures);
    return frame.empty() ? "" : a.pictures + ": expected a folder without pictures of a time-lapse, not " + frame;
}

int past_open(past *p)
{
    const arguments &a = *p->wanted;
    std::string text;
    p->folder = store_open(a.input, &p->over.under, &text);
    if (!p->folder)
        return complain(ARGUMENTS_EXIT_TROUBLE, text);
    history_settings settings = HISTORY_SETTINGS_DEFAULT;
    settings.strokes = HISTORY_STROKES_MAX;
    settings.budget_bytes = BUDGET_BYTES;
    settings.reserve_files = 0;
    history_finding finding;
    opening *reading =
        opening_begin(p->piece.get(), overlay_store_port(&p->over), settings, SCULPTURE_STEP_MM_DEFAULT);
    progress_await(
        "opening", [reading] { return opening_is_done(reading); }, [reading] { return opening_part(reading); });
    const status s = opening_end(reading, &finding);
    if (finding.text[0])
        complain(0, a.input + ": " + finding.text);
    if (s != STATUS_OK)
        return complain(ARGUMENTS_EXIT_TROUBLE, a.input + ": " + status_text(s));
    p->open = true;
    if (sculpture_facts(p->piece.get()).cursor == 0 && p->piece->clay.corners == 0)
        return complain(ARGUMENTS_EXIT_WRONG, a.input + ": expected a store with strokes in it");
    return 0;
}

void past_close(past *p)
{
    stage_close(p->scene);
    if (p->open) {
        const status s = sculpture_close(p->piece.get());
        (void)s; /* what it writes goes with the overlay */
    }
    store_close(p->folder);
}

int scene_open(past *p, const portrait &how)
{
    const arguments &a = *p->wanted;
    std::string text;
    std::error_code error;
    p->scene = stage_open(&text);
    if (!p->scene)
        return complain(ARGUMENTS_EXIT_TROUBLE, "no pictures: " + text);
    if (fs::create_directories(a.pictures, error); error)
        return complain(ARGUMENTS_EXIT_WRONG, a.pictures + ": " + error.message());
    if (!how.scenery.empty() && !stage_scenery(p->scene, how.scenery, &text))
        return complain(ARGUMENTS_EXIT_TROUBLE, "the scenery stays as it is: " + text);
    return 0;
}

/* To the oldest state that can be reached. */
int go_back(past *p)
{
    progress_teller bar = progress_teller_begin("going back");
    const double strokes = std::max(1u, sculpture_facts(p->piece.get()).strokes);
    status s = sculpture_undo(p->piece.get());
    for (; s == STATUS_OK; s = sculpture_undo(p->piece.get()))
        progress_teller_show(&bar, std::min(1.0, ++p->strokes / strokes));
    progress_teller_end(&bar);
    if (s == STATUS_HISTORY_ENDS)
        return 0;
    return complain(ARGUMENTS_EXIT_TROUBLE, p->wanted->input + ": the pictures begin " + std::to_string(p->strokes) +
                                                " strokes before the end: " + status_text(s));
}

int go_forth(past *p)
{
    const arguments &a = *p->wanted;
    const int frames = 1 + (p->strokes + a.every - 1) / a.every;
    const std::string path = (fs::path(a.pictures) / FRAME).string();
    progress bar = progress_begin("time-lapse");
    std::string text;
    int frame = 0;
    for (int stroke = 0; stroke <= p->strokes; stroke++) {
        const status s = stroke > 0 ? sculpture_redo(p->piece.get()) : STATUS_OK;
        if (s != STATUS_OK)
            return complain(ARGUMENTS_EXIT_TROUBLE, a.input + ": " + status_text(s));
        const std::string note = "stroke " + std::to_string(stroke) + " of " + std::to_string(p->strokes);
        progress_show(&bar, static_cast<double>(stroke) / (p->strokes + 1), note, progress_now_ns());
        if (stroke % a.every != 0 && stroke != p->strokes)
            continue;
        if (!stage_picture(p->scene, p->piece.get(), p->shown, a.pixels, sequence_path(path, frame++, frames), &text))
            return complain(ARGUMENTS_EXIT_TROUBLE, text);
    }
    progress_end(&bar, std::to_string(frames) + " pictures");
    std::printf("wrote     %s to %s\n", sequence_path(path, 0, frames).c_str(),
                sequence_path(path, frames - 1, frames).c_str());
    return 0;
}

} // namespace

int timelapse(const arguments &a, const std::string &config)
{
    portrait how;
    std::string text = wrong_with(a);
    if (!text.empty() || !portrait_load(&how, a.settings, config, &text))
        return complain(ARGUMENTS_EXIT_WRONG, text);
    past p;
    p.wanted = &a;
    int exit = past_open(&p);
    if (exit == 0)
        exit = scene_open(&p, how);
    if (p.scene && exit != ARGUMENTS_EXIT_WRONG) {
        p.shown = portrait_of(how, p.piece.get(), static_cast<double>(a.pixels.width) / a.pixels.height, false);
        const int back = go_back(&p), forth = go_forth(&p);
        exit = std::max({exit, back, forth});
    }
    past_close(&p);
    return exit;
}
