/* SPDX-License-Identifier: Apache-2.0 */
/* The composition root: what was asked for goes to the room that does it. */
#include "wiring/arguments.h"
#include "wiring/check_store.h"
#include "wiring/picture_task.h"
#include "wiring/replay.h"
#include "wiring/shelf_task.h"
#include "wiring/timelapse.h"

int main(int count, char **words)
{
    int exit = 0;
    std::optional<arguments> asked = arguments_parse(count, words, &exit);
    if (!asked)
        return exit;
    switch (asked->task) {
    case ARGUMENTS_RUN: return replay_demonstration(*asked, GLAISE_CONFIG);
    case ARGUMENTS_REPLAY: return asked->shelf.empty() ? replay_tape(*asked) : shelf_task_replay(*asked);
    case ARGUMENTS_EXPORT: return replay_export(*asked);
    case ARGUMENTS_PICTURE: return picture_task(*asked, GLAISE_CONFIG);
    case ARGUMENTS_TIMELAPSE: return timelapse(*asked, GLAISE_CONFIG);
    case ARGUMENTS_INFO: return replay_info(*asked);
    case ARGUMENTS_CHECK: return check_store(*asked);
    case ARGUMENTS_SHELF: return shelf_task(*asked);
    }
    return ARGUMENTS_EXIT_WRONG;
}
