/* SPDX-License-Identifier: Apache-2.0 */
/* The composition root: what was asked for goes to the room that does it. */
#include "wiring/arguments.h"
#include "wiring/replay.h"

int main(int count, char **words)
{
    int exit = 0;
    std::optional<arguments> asked = arguments_parse(count, words, &exit);
    if (!asked)
        return exit;
    switch (asked->task) {
    case ARGUMENTS_RUN: return replay_demonstration(*asked, GLAISE_CONFIG);
    case ARGUMENTS_REPLAY: return replay_tape(*asked);
    case ARGUMENTS_EXPORT: return replay_export(*asked);
    case ARGUMENTS_INFO: return replay_info(*asked);
    }
    return ARGUMENTS_EXIT_WRONG;
}
