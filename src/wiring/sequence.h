/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Pictures in a row: how their files are numbered, and the pictures of one turn on a turntable.
 * Is not:  One picture (stage.h); where the eye stands (station/camera.h); the life of a piece (timelapse.h).
 * Shape:   FILE-000.png, FILE-001.png ...: three digits or as many as the last number needs, so that names sort as they
 *          were taken. Of FRAMES pictures of a turn, number n has the piece turned by n / FRAMES of it: the first follows
 *          the last without a jump.
 * Errors:  a sentence that begins with a path. The pictures before it are there, whole.
 */
#ifndef GLAISE_WIRING_SEQUENCE_H
#define GLAISE_WIRING_SEQUENCE_H

#include "station/camera.h"
#include "wiring/stage.h"

/* path: with ".png" or without. count: of them all. */
std::string sequence_path(const std::string &path, int n, int count);

/* Turns the piece about the vertical through its middle; through the point looked at where there is no piece. `written`
   hears each file. Shows how far it is. */
[[nodiscard]] bool sequence_turntable(stage *s, const sculpture *piece, const snapshot &shown,
                                      const large_picture_size &size, const std::string &path, int frames,
                                      const std::function<void(const std::string &)> &written,
                                      std::string *text_out);

#endif
