/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/replay.h"

#include "exchange/exchange.h"
#include "station/crew_of_threads.h"
#include "station/history_thread.h"
#include "station/opening.h"
#include "station/shelf.h"
#include "wiring/outbox.h"
#include "wiring/piece_file.h"
#include "wiring/playlist.h"
#include "wiring/progress.h"
#include "wiring/scratch_store.h"
#include "wiring/sequence.h"
#include "wiring/stage.h"
#include "wiring/statistics.h"
#include "wiring/store.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

namespace {

constexpr unsigned HANDS_USUAL_MAX = 4; /* more share too little of a dab's clay each */
constexpr uint64_t SCRATCH_FILE_BYTES = 65536;
constexpr int64_t FRAME_US = 16667; /* the replay looks up as often as a 60 Hz screen would */

int complain(int exit, const std::string &text)
{
    std::fprintf(stderr, "glaise: %s\n", text.c_str());
    return exit;
}

/* Endings and folders are looked at before anything is done. */
bool outputs_fit(const arguments &a, std::string *text_out)
{
    for (const std::string &file : a.exports)
        if (exchange_format_of(file) == EXCHANGE_UNKNOWN) {
            *text_out = file + ": expected a name that ends in one of " + exchange_endings();
            return false;
        }
    for (const std::string &folder : {a.pictures, a.store}) {
        std::error_code error;
        if (!folder.empty() && (std::filesystem::create_directories(folder, error), error)) {
            *text_out = folder + ": " + error.message();
            return false;
        }
    }
    return true;
}

/* A performance: the piece, the station, and what is wanted of them. */
struct performance {
    const arguments *wanted = nullptr;
    std::unique_ptr<sculpture> piece = std::make_unique<sculpture>();
    bool open = false;
    store *folder = nullptr;
    scratch_store scratch; /* where no folder is wanted */
    crew_of_threads *crew = nullptr;
    history_thread *keeping = nullptr;
    station *desk = nullptr;
    stage *scene = nullptr;
    bool scene_tried = false;
    statistics counts;
    outbox sent;
    std::vector<std::string> written;
    int exit = 0;
};

void trouble(performance *p, const std::string &text)
{
    std::fprintf(stderr, "\nglaise: %s\n", text.c_str());
    p->exit = ARGUMENTS_EXIT_TROUBLE;
}

/* The vectors and threads that were asked for. Without threads the caller works alone. */
void work_as_wanted(performance *p)
{
    clay *c = &p->piece->clay;
    for (const lanes l : {LANES_PLAIN, LANES_AVX2, LANES_AVX512})
        if (p->wanted->vectors == lanes_name(l))
            c->rows = l;
    const unsigned here = std::clamp(std::thread::hardware_concurrency(), 1u, HANDS_USUAL_MAX);
    p->crew = crew_of_threads_open(p->wanted->hands > 0 ? static_cast<uint32_t>(p->wanted->hands) : here);
    c->crew = p->crew ? crew_of_threads_port(p->crew) : nullptr;
}

/* Where nothing is to last, undo-files need not be large. */
history_settings settings_of(const arguments &a)
{
    history_settings s = HISTORY_SETTINGS_DEFAULT;
    s.strokes = static_cast<uint32_t>(a.ring);
    s.budget_bytes = static_cast<uint64_t>(a.budget_mb) << 20;
    if (a.store.empty()) {
        s.file_bytes = SCRATCH_FILE_BYTES;
        s.reserve_files = 0;
    }
    return s;
}

/* History gets a thread of its own, where there is one to be had. */
void keep_beside(performance *p)
{
    std::function<void(const keeper_facts &)> told;
    if (p->wanted->kept)
        told = [step_mm = p->piece->step_mm](const keeper_facts &facts) {
            const uint64_t digest = sculpture_digest_of(step_mm, facts.kept_digest);
            std::printf("kept %llu %llu %016llx\n", static_cast<unsigned long long>(facts.kept),
                        static_cast<unsigned long long>(facts.kept_cursor),
                        static_cast<unsigned long long>(digest));
            std::fflush(stdout);
        };
    p->keeping = history_thread_open(p->piece.get(), std::move(told));
}

bool performance_open(performance *p, double step_mm)
{
    const arguments &a = *p->wanted;
    byte_store port = scratch_store_port(&p->scratch);
    history_finding finding;
    std::string text;
    if (!a.store.empty()) {
        p->folder = store_open(a.store, &port, &text);
        if (!p->folder) {
            trouble(p, text);
            return false;
        }
    }
    opening *reading = opening_begin(p->piece.get(), port, settings_of(a), step_mm);
    progress_await(
        "opening", [reading] { return opening_is_done(reading); }, [reading] { return opening_part(reading); });
    const status s = opening_end(reading, &finding);
    if (finding.text[0])
        std::fprintf(stderr, "glaise: %s: %s\n", a.store.c_str(), finding.text);
    if (s != STATUS_OK) {
        trouble(p, (a.store.empty() ? "" : a.store + ": ") + status_text(s));
        return false;
    }
    p->open = true;
    work_as_wanted(p);
    keep_beside(p);
    p->counts.every_dab = !a.statistics.empty();
    station_ears ears;
    ears.clock_ns = progress_now_ns;
    ears.counts = p->counts.every_dab;
    ears.records = !a.record.empty();
    ears.dab = [p](const station_dab &d) {
        statistics_dab(&p->counts, d, p->piece.get());
        if (d.outcome != STATUS_OK)
            p->exit = ARGUMENTS_EXIT_TROUBLE;
    };
    ears.stroke = [p](status outcome, int64_t history_ns) {
        statistics_stroke(&p->counts, history_ns);
        if (outcome != STATUS_OK && outcome != STATUS_HISTORY_ENDS) /* that history ends is no failure */
            p->exit = ARGUMENTS_EXIT_TROUBLE;
    };
    p->desk = station_open(p->piece.get(), std::move(ears));
    return true;
}

/* Answers a sentence when it is tried first and there is none. */
std::string scene_open(performance *p)
{
    std::string text;
    if (!p->scene && !p->scene_tried) {
        p->scene_tried = true;
        p->scene = stage_open(&text);
    }
    return text;
}

/* Where there are to be pictures: is there a scene to take them of? */
bool scene_is_open(performance *p)
{
    const std::string text = scene_open(p);
    if (!text.empty())
        trouble(p, "no pictures: " + text);
    return p->scene != nullptr;
}

void picture_take(performance *p, const std::string &path)
{
    if (!scene_is_open(p))
        return;
    std::string text;
    progress_teller bar = progress_teller_begin("drawing");
    if (stage_picture(p->scene, p->piece.get(), station_snapshot(p->desk), p->wanted->pixels, path, &text,
                      [&bar](double part) { progress_teller_show(&bar, part); }))
        p->written.push_back(path);
    else
        trouble(p, text);
    progress_teller_end(&bar);
}

void turntable_take(performance *p, const std::string &path, int frames)
{
    std::string text;
    const auto written = [p](const std::string &file) { p->written.push_back(file); };
    if (scene_is_open(p) && !sequence_turntable(p->scene, p->piece.get(), station_snapshot(p->desk),
                                                p->wanted->pixels, path, frames, written, &text))
        trouble(p, text);
}

/* A picture that cannot be read costs the scenery, nothing else. Who wants no pictures needs none. */
void scenery_bring(performance *p, const std::string &path)
{
    const arguments &a = *p->wanted;
    std::string text;
    if (a.pictures.empty() && a.picture.empty() && a.thumbnail.empty())
        return;
    if (scene_is_open(p) && !stage_scenery(p->scene, path, &text))
        trouble(p, "the scenery stays as it is: " + text);
}

/* A piece can do without: nothing has failed then. */
void thumbnail_take(performance *p)
{
    std::string text = scene_open(p);
    const large_picture_size size = {SHELF_THUMBNAIL_WIDTH_PIXELS, SHELF_THUMBNAIL_HEIGHT_PIXELS, 1};
    if (p->scene &&
        stage_picture(p->scene, p->piece.get(), station_snapshot(p->desk), size, p->wanted->thumbnail, &text))
        return;
    if (!text.empty())
        std::fprintf(stderr, "glaise: no thumbnail: %s\n", text.c_str());
}

/* Files that are done; all of them, if waited for. */
void collect(performance *p, bool wait)
{
    while (!p->sent.sent.empty()) {
        if (wait) {
            const std::string what = "writing " + p->sent.sent.front().file.path;
            progress_await(
                what.c_str(), [p] { return outbox_is_done(&p->sent); }, [p] { return outbox_part(&p->sent); });
        }
        const std::optional<outbox_file> file = outbox_take(&p->sent);
        if (!file)
            return;
        if (file->trouble.empty())
            p->written.push_back(file->path);
        else
            trouble(p, file->trouble);
    }
}

/* What the station asks for or says. */
void ask(performance *p, const playlist &list)
{
    std::string text;
    station_turntable turn;
    if (station_scenery_take(p->desk, &text))
        scenery_bring(p, playlist_beside(list, text));
    while (station_export_take(p->desk, &text))
        if (!p->wanted->pictures.empty())
            outbox_send(&p->sent, p->piece.get(), (std::filesystem::path(p->wanted->pictures) / text).string());
    collect(p, false);
    while (station_message_take(p->desk, &text))
        std::fprintf(stderr, "\nglaise: %s\n", text.c_str());
    while (station_picture_take(p->desk, &text))
        if (!p->wanted->pictures.empty())
            picture_take(p, (std::filesystem::path(p->wanted->pictures) / text).string());
    while (station_turntable_take(p->desk, &turn))
        if (!p->wanted->pictures.empty())
            turntable_take(p, (std::filesystem::path(p->wanted->pictures) / turn.name).string(), turn.frames);
}

void perform(performance *p, const playlist &list)
{
    progress bar = progress_begin("sculpting");
    size_t next = 0;
    for (int64_t frame_us = 0;; frame_us += FRAME_US) {
        int64_t until_us = std::min(frame_us, list.end_us);
        for (; next < list.commands.size() && list.commands[next].time_us <= until_us; next++) {
            station_do(p->desk, list.commands[next]);
            ask(p, list);
        }
        station_advance(p->desk, until_us);
        ask(p, list);
        double part = list.end_us ? static_cast<double>(until_us) / static_cast<double>(list.end_us) : 1;
        progress_show(&bar, part,
                      std::to_string(p->counts.dabs) + " dabs, " + std::to_string(p->piece->clay.corners) + " corners",
                      progress_now_ns());
        if (until_us == list.end_us)
            break;
    }
    if (station_is_applying(p->desk)) { /* a stroke that the tape left open ends with it */
        command up;
        up.time_us = list.end_us;
        up.kind = COMMAND_APPLY;
        while (station_is_applying(p->desk))
            station_do(p->desk, up);
        ask(p, list);
    }
    progress_end(&bar,
                 std::to_string(p->counts.dabs) + " dabs, " + std::to_string(p->piece->clay.corners) + " corners");
}

void text_export(performance *p, const std::string &path, const std::string &bytes)
{
    std::string text;
    auto write = [&bytes](checkpoint_sink sink, void *self) { return sink(self, bytes.data(), bytes.size()); };
    if (store_export(path, write, &text))
        p->written.push_back(path);
    else
        trouble(p, text);
}

void pieces_export(performance *p)
{
    for (const std::string &file : p->wanted->exports)
        outbox_send(&p->sent, p->piece.get(), file);
    collect(p, true);
}

void results_write(performance *p)
{
    const arguments &a = *p->wanted;
    if (!a.picture.empty())
        picture_take(p, a.picture);
    if (!a.thumbnail.empty())
        thumbnail_take(p);
    pieces_export(p);
    if (!a.statistics.empty())
        text_export(p, a.statistics, statistics_json(p->counts, p->piece.get()));
    if (!a.record.empty())
        text_export(p, a.record, tape_text({p->piece->step_mm, station_recording(p->desk)}));
}

void performance_close(performance *p)
{
    collect(p, true); /* they hold on to the piece */
    stage_close(p->scene);
    station_close(p->desk);
    history_thread_close(p->keeping);
    if (p->open) {
        status s = sculpture_close(p->piece.get());
        if (s != STATUS_OK)
            trouble(p, p->wanted->store + ": " + status_text(s));
    }
    crew_of_threads_close(p->crew);
    store_close(p->folder);
}

/* A store that an earlier demonstration left is set aside under the next free number. */
bool store_set_aside(const std::string &store, std::string *text_out)
{
    std::error_code error;
    if (!std::filesystem::exists(store, error))
        return true;
    for (int n = 1; n < 10000; n++) {
        std::string aside = store + "." + std::to_string(n);
        if (std::filesystem::exists(aside, error))
            continue;
        std::filesystem::rename(store, aside, error);
        *text_out = error ? store + ": " + error.message() : "";
        std::printf("the earlier store was set aside as %s\n", aside.c_str());
        return !error;
    }
    *text_out = store + ": expected fewer than 10000 earlier ones";
    return false;
}

} // namespace

int replay_tape(const arguments &a)
{
    playlist list;
    std::string text;
    if (!playlist_load(a.settings, a.input, &list, &text) || !outputs_fit(a, &text))
        return complain(ARGUMENTS_EXIT_WRONG, text);
    performance p;
    p.wanted = &a;
    if (performance_open(&p, a.step_mm > 0 ? a.step_mm : list.step_mm)) {
        perform(&p, list);
        results_write(&p);
        std::fputs(statistics_text(p.counts, p.piece.get()).c_str(), stdout);
        for (const std::string &file : p.written)
            std::printf("wrote     %s\n", file.c_str());
        if (!a.store.empty())
            std::printf("store     %s\n", a.store.c_str());
    }
    performance_close(&p);
    return p.exit;
}

int replay_demonstration(const arguments &a, const std::string &config)
{
    std::filesystem::path out(a.pictures);
    arguments b = a;
    std::string text;
    b.settings = (std::filesystem::path(config) / "station.tape").string();
    b.input = (std::filesystem::path(config) / "demonstration.tape").string();
    b.store = (out / "store").string();
    b.statistics = (out / "demonstration.json").string();
    for (const char *ending : {"glaise", "stl", "ply", "obj", "iv"})
        b.exports.push_back((out / "demonstration.").string() + ending);
    if (!store_set_aside(b.store, &text))
        return complain(ARGUMENTS_EXIT_TROUBLE, text);
    std::printf("no display to open: replaying the demonstration into %s\n", a.pictures.c_str());
    return replay_tape(b);
}

int replay_export(const arguments &a)
{
    std::string text;
    if (!outputs_fit(a, &text))
        return complain(ARGUMENTS_EXIT_WRONG, text);
    performance p;
    p.wanted = &a;
    p.exit = piece_file_open(p.piece.get(), a.input);
    if (p.exit != 0)
        return p.exit;
    p.open = true;
    pieces_export(&p);
    performance_close(&p);
    return p.exit;
}

int replay_info(const arguments &a)
{
    std::string text;
    exchange_outcome outcome;
    auto read = [&](checkpoint_source source, void *self) {
        outcome = exchange_info(source, self);
        return outcome.state == STATUS_OK;
    };
    if (store_import(a.input, read, &text)) {
        std::printf("%s\n", outcome.text.c_str());
        return 0;
    }
    bool world = outcome.state == STATUS_OK || outcome.state == STATUS_IO;
    return complain(world ? ARGUMENTS_EXIT_TROUBLE : ARGUMENTS_EXIT_WRONG,
                    text.empty() ? a.input + ": " + outcome.text : text);
}
