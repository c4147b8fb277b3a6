/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/arguments.h"

#include "exchange/exchange.h"
#include "station/command.h"
#include "station/station.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace {

constexpr int PICTURE_SIDE_MAX_PIXELS = 8192;

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

void replay_options(CLI::App *app, arguments *a)
{
    app->add_option("TAPE", a->input, "the tape to replay")->required();
    app->add_option("--settings", a->settings, "a tape of settings, done before it at time 0");
    app->add_option("--store", a->store, "folder that keeps the sculpture and its undo-files; made when absent");
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
    app->add_option("--width", a->width, "width of pictures")->check(CLI::Range(1, PICTURE_SIDE_MAX_PIXELS));
    app->add_option("--height", a->height, "height of pictures")->check(CLI::Range(1, PICTURE_SIDE_MAX_PIXELS));
    app->add_option("--ring", a->ring, "undo-files kept in the store")->check(CLI::Range(1, +HISTORY_RING_MAX));
    app->add_option("--vectors", a->vectors, "instructions to compute with; the outcome is the same with all")
        ->check(CLI::IsMember(vectors_here()));
    app->add_option("--hands", a->hands, "threads that work on the clay; 0: as the machine has them")
        ->check(CLI::Range(0, ARGUMENTS_HANDS_MAX));
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
    CLI::App *info = app.add_subcommand("info", "says what a sculpture file holds");
    info->add_option("FILE", a.input, "a .glaise file, or a store's \"field\"")->required();
    if (count > 1 && !task_is_known(app, words[1])) {
        std::cerr << "glaise: " << words[1] << ": expected run, replay, export or info (glaise --help)\n";
        *exit_out = ARGUMENTS_EXIT_WRONG;
        return std::nullopt;
    }
    try {
        app.parse(count, words);
    } catch (const CLI::ParseError &e) {
        *exit_out = app.exit(e) == 0 ? 0 : ARGUMENTS_EXIT_WRONG;
        return std::nullopt;
    }
    a.task = run->parsed()         ? ARGUMENTS_RUN
             : replay->parsed()    ? ARGUMENTS_REPLAY
             : exporting->parsed() ? ARGUMENTS_EXPORT
                                   : ARGUMENTS_INFO;
    if (a.task == ARGUMENTS_RUN && a.pictures.empty())
        a.pictures = "out";
    return a;
}
