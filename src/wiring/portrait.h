/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    How a piece is shown that nobody works on: as a tape of settings says, without tool and bead, and so that all
 *          of it is seen.
 * Is not:  How it is shown on the station (station/showing.h); the taking of the picture (stage.h).
 * Shape:   of the settings what concerns the picture is done, in their order; the rest is for hands. Then, unless they
 *          say with a `centre` what is looked at, the eye goes back or forth in its direction until the piece fits the
 *          picture (station/camera.h), and what lights are with the viewer go with it. Workspace and lights are drawn
 *          only where the settings say so. Where they do not show a workspace, it is put round the piece: the turntable
 *          lies at its bottom.
 * Owner:   values.
 * Errors:  a sentence that names file, line, and what was expected.
 */
#ifndef GLAISE_WIRING_PORTRAIT_H
#define GLAISE_WIRING_PORTRAIT_H

#include "station/snapshot.h"
#include "wiring/playlist.h"

struct portrait {
    playlist settings;
    std::string scenery; /* file of the picture that they bring; empty: none */
};

/* settings_path empty: the station's own, in the folder `config`. */
[[nodiscard]] bool portrait_load(portrait *p, const std::string &settings_path, const std::string &config,
                                 std::string *text_out);
/* aspect: the picture's width over its height. turning: it is to fit at every angle of the turntable. */
snapshot portrait_of(const portrait &p, const sculpture *piece, double aspect, bool turning);

#endif
