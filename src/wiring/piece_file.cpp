/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/piece_file.h"

#include "wiring/arguments.h"
#include "wiring/store.h"

#include <cstdio>

namespace {

int complain(int exit, const std::string &text)
{
    std::fprintf(stderr, "glaise: %s\n", text.c_str());
    return exit;
}

} // namespace

int piece_file_open(sculpture *piece, const std::string &path)
{
    history_finding finding;
    std::string text;
    status s = sculpture_open(piece, nullptr, CAPACITY_BRICKS, nullptr, SCULPTURE_STEP_MM_DEFAULT, &finding);
    if (s != STATUS_OK)
        return complain(ARGUMENTS_EXIT_TROUBLE, status_text(s));
    exchange_outcome outcome;
    auto read = [&](checkpoint_source source, void *self) {
        outcome = exchange_read(*piece, source, self);
        return outcome.state == STATUS_OK;
    };
    if (store_import(path, read, &text))
        return 0;
    s = sculpture_close(piece);
    (void)s; /* nothing is kept of it */
    bool world = outcome.state == STATUS_OK || outcome.state == STATUS_IO;
    return complain(world ? ARGUMENTS_EXIT_TROUBLE : ARGUMENTS_EXIT_WRONG,
                    text.empty() ? path + ": " + outcome.text : text);
}
