/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/picture_task.h"

#include "wiring/piece_file.h"
#include "wiring/portrait.h"
#include "wiring/progress.h"
#include "wiring/sequence.h"

#include <cstdio>
#include <memory>

namespace {

int complain(int exit, const std::string &text)
{
    std::fprintf(stderr, "glaise: %s\n", text.c_str());
    return exit;
}

void tell_written(const std::string &file) { std::printf("wrote     %s\n", file.c_str()); }

bool one_take(const arguments &a, stage *scene, const sculpture *piece, const snapshot &shown, std::string *text_out)
{
    progress_teller bar = progress_teller_begin("drawing");
    const bool good = stage_picture(scene, piece, shown, a.pixels, a.picture, text_out,
                                    [&bar](double part) { progress_teller_show(&bar, part); });
    progress_teller_end(&bar);
    if (good)
        tell_written(a.picture);
    return good;
}

int take(const arguments &a, const portrait &how, const sculpture *piece)
{
    std::string text;
    int exit = 0;
    stage *scene = stage_open(&text);
    if (!scene)
        return complain(ARGUMENTS_EXIT_TROUBLE, "no pictures: " + text);
    if (!how.scenery.empty() && !stage_scenery(scene, how.scenery, &text))
        exit = complain(ARGUMENTS_EXIT_TROUBLE, "the scenery stays as it is: " + text);
    const double aspect = static_cast<double>(a.pixels.width) / a.pixels.height;
    const snapshot shown = portrait_of(how, piece, aspect, a.turntable > 0);
    const bool good = a.turntable > 0 ? sequence_turntable(scene, piece, shown, a.pixels, a.picture, a.turntable,
                                                           tell_written, &text)
                                      : one_take(a, scene, piece, shown, &text);
    if (!good)
        exit = complain(ARGUMENTS_EXIT_TROUBLE, text);
    stage_close(scene);
    return exit;
}

} // namespace

int picture_task(const arguments &a, const std::string &config)
{
    portrait how;
    std::string text;
    if (!a.picture.ends_with(".png"))
        return complain(ARGUMENTS_EXIT_WRONG, a.picture + ": expected a name that ends in .png");
    if (!portrait_load(&how, a.settings, config, &text))
        return complain(ARGUMENTS_EXIT_WRONG, text);
    const auto piece = std::make_unique<sculpture>();
    int exit = piece_file_open(piece.get(), a.input);
    if (exit != 0)
        return exit;
    exit = take(a, how, piece.get());
    const status s = sculpture_close(piece.get());
    (void)s; /* nothing is kept of it */
    return exit;
}
