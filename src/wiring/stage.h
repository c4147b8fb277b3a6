/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    View and display joined: a sculpture as the station shows it, taken as a PNG file.
 * Is not:  The drawing (view) or the place it is drawn in (platform/display).
 * Owner:   stage_close.
 * Errors:  a sentence; without a display the rest of the program goes on and says that there are no pictures.
 * Cost:    the first picture opens the display and compiles the shaders.
 */
#ifndef GLAISE_WIRING_STAGE_H
#define GLAISE_WIRING_STAGE_H

#include "station/snapshot.h"

#include <string>

struct stage;

stage *stage_open(std::string *text_out);
void stage_close(stage *s); /* NULL is fine */
[[nodiscard]] bool stage_picture(stage *s, const sculpture *piece, const snapshot &shown, int width, int height,
                                 const std::string &path, std::string *text_out);

#endif
