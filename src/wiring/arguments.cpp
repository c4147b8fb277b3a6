/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/arguments.h"

#include "exchange/exchange.h"
#include "station/command.h"
#include "station/shelf.h"
#include "station/station.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace {

std::string commands_text()
{
    std::string out =
        "A tape is plain text: \"glaise tape 1\", then lines such as \"@1500 place 0 10 0\" (at 1500 ms) or\n"
        "\"+40 apply down\" (40 ms later). \"step MM\" before the first sets the lattice. Commands:\n";
    for (const command_form &form : command_forms()) {
        std::string usage = command_usage(form);
        out +=
            "  " + usage + std::string(usage.size() < 38 ? 38 - usage.size() : 1, ' ') + std::string(form.does) + "\n";
        for (const command_argument &a : form.arguments)
            if (a.kind == COMMAND_WORD && a.words.size() > 2) {
                out += std::string(42, ' ') + a.name + ":";
                for (std::string_view w : a.words)
                    out += " " + std::string(w);
                out += "\n";
            }
    }
    out += "\nExit status: 0 done; 1 the world failed (disk, display, a refused stroke); 2 what was given is wrong.";
    return out;
}

/* A range lets "nan" through: every comparison with it is false. */
CLI::Validator a_number()
{
    auto check = [](std::string &text) {
        return text.find_first_of("nN") == std::string::npos ? "" : "expected a number, not " + text;
    };
    return CLI::Validator(check, "");
}

/* Without it an unknown task would only be told that a task is required. */
bool task_is_known(const CLI::App &app, const std::string &word)
{
    for (const CLI::App *task : app.get_subcommands([](const CLI::App *) { return true; }))
        if (task->get_name() == word)
            return true;
    return word.starts_with("-");
}

std::vector<std::string> vectors_here()
{
    std::vector<std::string> names = {"best"};
    for (const lanes l : {LANES_PLAIN, LANES_AVX2, LANES_AVX512})
        if (lanes_are_here(l))
            names.emplace_back(lanes_name(l));
    return names;
}

CLI::Validator a_piece() { return CLI::Range(1, SHELF_PIECES_MAX); }

void picture_options(CLI::App *app, arguments *a)
{
    app->add_option("--width", a->pixels.width, "width of pictures")->check(CLI::Range(1, LARGE_PICTURE_SIDE_MAX));
    app->add_option("--height", a->pixels.height, "height of pictures")->check(CLI::Range(1, LARGE_PICTURE_SIDE_MAX));
    app->add_option("--supersample", a->pixels.supersample,
                    "draws pictures so many times as wide and high, and takes the mean of the light")
        ->check(CLI::Range(1, LARGE_PICTURE_SUPERSAMPLE_MAX));
}

/* How a piece is shown that nobody works on. */
void showing_options(CLI::App *app, arguments *a)
{
    app->add_option("--settings", a->settings,
                    "a tape with light, look and view, instead of the station's own. Of it what concerns the picture is "
                    "done. The view's direction is kept and the piece fits the picture, unless a \"centre\" in it says "
                    "what is looked at: then its distance is kept as well. The tool is not shown, the workspace and the "
                    "lights only where it says so");
    picture_options(app, a);
}

void picture_task_options(CLI::App *app, arguments *a)
{
    app->add_option("SCULPTURE", a->input, "a .glaise file, or a store's \"field\"")->required();
    app->add_option("FILE.png", a->picture, "the picture")->required();
    app->add_option("--turntable", a->turntable,
                    "instead of one picture so many, FILE-000.png, FILE-001.png ..., of one turn about the vertical "
                    "through the piece's middle")
        ->check(CLI::Range(1, +COMMAND_FRAMES_MAX));
    showing_options(app, a);
}

void timelapse_options(CLI::App *app, arguments *a)
{
    app->add_option("STORE", a->input, "folder that a sculpture is kept in; it is not changed")->required();
    app->add_option("FOLDER", a->pictures, "for the pictures frame-000.png, frame-001.png ...; made when absent")
        ->required();
    app->add_option("--every", a->every, "a picture after every so many strokes, and of the end")
        ->check(CLI::Range(1, +HISTORY_STROKES_MAX));
    showing_options(app, a);
}

void replay_options(CLI::App *app, arguments *a)
{
    app->add_option("TAPE", a->input, "the tape to replay")->required();
    app->add_option("--settings", a->settings, "a tape of settings, done before it at time 0");
    CLI::Option *store =
        app->add_option("--store", a->store, "folder that keeps the sculpture and its undo-files; made when absent");
    CLI::Option *shelf =
        app->add_option("--shelf", a->shelf, "folder of a shelf, a piece of which is to be worked on")->excludes(store);
    CLI::Option *piece = app->add_option("--piece", a->piece, "number of that piece")->check(a_piece())->needs(shelf);
    shelf->needs(piece);
    app->add_option("--png", a->picture, "writes a picture of the end");
    app->add_option("--pictures", a->pictures, "folder for the pictures the tape asks for");
    app->add_option("--export", a->exports, "writes the end as a file: " + exchange_endings())
        ->take_all()
        ->allow_extra_args(false);
    app->add_option("--stats", a->statistics, "writes counts, times and digests of every dab as JSON");
    app->add_option("--record", a->record, "writes everything that was done as a tape");
    app->add_option("--step", a->step_mm, "step of the lattice in mm, instead of the tape's")
        ->check(CLI::Range(SCULPTURE_STEP_MM_MIN, SCULPTURE_STEP_MM_MAX))
        ->check(a_number());
    picture_options(app, a);
    app->add_option("--ring", a->ring, "strokes that can be undone")->check(CLI::Range(1, +HISTORY_STROKES_MAX));
    app->add_option("--budget", a->budget_mb, "MiB that undo-files may take together")->check(CLI::Range(8, 1 << 20));
    app->add_flag("--kept", a->kept, "says \"kept RECORD STROKE DIGEST\" as soon as that state is on the medium");
    app->add_option("--vectors", a->vectors, "instructions to compute with; the outcome is the same with all")
        ->check(CLI::IsMember(vectors_here()));
    app->add_option("--hands", a->hands, "threads that work on the clay; 0: as the machine has them")
        ->check(CLI::Range(0, ARGUMENTS_HANDS_MAX));
}

void shelf_act(CLI::App *shelf, arguments *a, arguments_act act, const char *word, const char *does)
{
    CLI::App *app = shelf->add_subcommand(word, does);
    app->callback([a, act] { a->act = act; });
    if (act != ARGUMENTS_SHELF_NEW && act != ARGUMENTS_SHELF_MAKE_ROOM)
        app->add_option("N", a->piece, "number of the piece")->required()->check(a_piece());
    if (act == ARGUMENTS_SHELF_NEW || act == ARGUMENTS_SHELF_RENAME)
        app->add_option("NAME", a->name, "its name, up to 100 bytes")->required();
    if (act == ARGUMENTS_SHELF_MAKE_ROOM)
        app->add_option("MIB", a->room_mib, "to be free on the medium")->required()->check(CLI::Range(1, 1 << 30));
}

void shelf_acts(CLI::App *app, arguments *a)
{
    app->add_option("FOLDER", a->shelf, "the shelf")->required();
    app->require_subcommand(0, 1);
    shelf_act(app, a, ARGUMENTS_SHELF_NEW, "new", "makes a piece, and the shelf where there is none");
    shelf_act(app, a, ARGUMENTS_SHELF_RENAME, "rename", "gives a piece another name");
    shelf_act(app, a, ARGUMENTS_SHELF_DUPLICATE, "duplicate", "makes a piece that is a copy of another");
    shelf_act(app, a, ARGUMENTS_SHELF_SET_ASIDE, "set-aside", "takes a piece from the shelf, but keeps it");
    shelf_act(app, a, ARGUMENTS_SHELF_BRING_BACK, "bring-back", "puts what was set aside or discarded on the shelf");
    shelf_act(app, a, ARGUMENTS_SHELF_DISCARD, "discard", "gives up what was set aside, when room is needed");
    shelf_act(app, a, ARGUMENTS_SHELF_MAKE_ROOM, "make-room",
              "removes what was discarded, oldest first, until enough is free");
}

} // namespace

std::optional<arguments> arguments_parse(int count, char **words, int *exit_out)
{
    arguments a;
    CLI::App app("glaise: clay under a pedal, the software of a sculpting station", "glaise");
    app.set_version_flag("--version", "glaise " GLAISE_VERSION);
    app.footer(commands_text());
    app.require_subcommand(1);
    CLI::App *run =
        app.add_subcommand("run", "starts the station; with no display, replays the demonstration into out/");
    run->add_option("OUT", a.pictures, "folder for what the demonstration makes")->default_str("out");
    CLI::App *replay = app.add_subcommand("replay", "replays a tape");
    replay_options(replay, &a);
    CLI::App *exporting = app.add_subcommand("export", "writes a sculpture file in another format");
    exporting->add_option("SCULPTURE", a.input, "a .glaise file, or a store's \"field\"")->required();
    exporting->add_option("FILE", a.exports, "file to write: " + exchange_endings())->required()->expected(1);
    CLI::App *picturing = app.add_subcommand("picture", "takes a picture of a sculpture file, or pictures of one turn");
    picture_task_options(picturing, &a);
    CLI::App *lapse = app.add_subcommand(
        "timelapse", "goes back to the oldest stroke that a store keeps, and takes a picture after each from there on");
    timelapse_options(lapse, &a);
    CLI::App *info = app.add_subcommand("info", "says what a sculpture file holds");
    info->add_option("FILE", a.input, "a .glaise file, or a store's \"field\"")->required();
    CLI::App *check = app.add_subcommand("check", "looks through a store, changes nothing");
    check->add_option("STORE", a.input, "folder that a sculpture is kept in")->required();
    check->add_flag("--repair", a.repair, "writes what can be had of it as a new store, STORE.repaired");
    CLI::App *shelf = app.add_subcommand("shelf", "lists the pieces of a shelf, or does something with one");
    shelf_acts(shelf, &a);
    if (count > 1 && !task_is_known(app, words[1])) {
        std::cerr << "glaise: " << words[1] << ": expected run, replay, export, picture, timelapse, info, check or shelf "
                     "(glaise --help)\n";
        *exit_out = ARGUMENTS_EXIT_WRONG;
        return std::nullopt;
    }
    try {
        app.parse(count, words);
    } catch (const CLI::ParseError &e) {
        *exit_out = app.exit(e) == 0 ? 0 : ARGUMENTS_EXIT_WRONG;
        return std::nullopt;
    }
    const std::string trouble = large_picture_trouble(a.pixels);
    if (!trouble.empty()) {
        std::cerr << "glaise: " << trouble << "\n";
        *exit_out = ARGUMENTS_EXIT_WRONG;
        return std::nullopt;
    }
    a.task = run->parsed()         ? ARGUMENTS_RUN
             : replay->parsed()    ? ARGUMENTS_REPLAY
             : exporting->parsed() ? ARGUMENTS_EXPORT
             : picturing->parsed() ? ARGUMENTS_PICTURE
             : lapse->parsed()     ? ARGUMENTS_TIMELAPSE
             : info->parsed()      ? ARGUMENTS_INFO
             : shelf->parsed()     ? ARGUMENTS_SHELF
                                   : ARGUMENTS_CHECK;
    if (a.task == ARGUMENTS_RUN && a.pictures.empty())
        a.pictures = "out";
    return a;
}
