/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    View and display joined: a sculpture as the station shows it, taken as a PNG file of any size; and scenery
 *          that a person brings, from a PNG file.
 * Is not:  The drawing (view) or the place it is drawn in (platform/display); how a large picture is cut
 *          (large_picture.h); many pictures in a row (sequence.h).
 * Owner:   stage_close.
 * Errors:  a sentence that begins with the path, but for stage_open; without a display the rest of the program goes on
 *          and says that there are no pictures. A picture that fails leaves no file, and what was there stays. A
 *          scenery that fails leaves the one before it.
 * Cost:    the first picture opens the display and compiles the shaders. A picture is drawn and written by the band: it
 *          takes the same memory whatever its size. Not for the frame path.
 */
#ifndef GLAISE_WIRING_STAGE_H
#define GLAISE_WIRING_STAGE_H

#include "station/snapshot.h"
#include "wiring/large_picture.h"

#include <functional>
#include <string>

struct stage;

stage *stage_open(std::string *text_out);
void stage_close(stage *s); /* NULL is fine */
/* Everything on the device anew, as after its driver was reset, which stage_picture sees to by itself: the pictures
   after it are as those before. */
[[nodiscard]] bool stage_renew(stage *s, std::string *text_out);
/* told, where given, hears how far it is, 0..1. */
[[nodiscard]] bool stage_picture(stage *s, const sculpture *piece, const snapshot &shown,
                                 const large_picture_size &size, const std::string &path, std::string *text_out,
                                 const std::function<void(double)> &told = {});
/* What SNAPSHOT_SCENERY_OWN shows from here on. */
[[nodiscard]] bool stage_scenery(stage *s, const std::string &path, std::string *text_out);

#endif
