/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Many sculptures on one station: made, named, set aside, brought back, copied. Nothing is removed without two
 *          deliberate acts, and then only when space is needed.
 * Is not:  An open sculpture, or going from one to the next (switching.h); the folders themselves (shelf_port.h).
 * Shape:   a piece is a folder:
 *              piece-0001/  about           name and state (about.h)
 *                           thumbnail.png   may be absent
 *                           field, undo-... its clay and history (history/history.h)
 *
 *              on --set_aside--> aside --discard--> discarded --make_room--> gone
 *               ^---bring_back-----'                    |
 *               '---------------bring_back--------------'
 *
 *          S1  A piece is made as "making-0001", and is one from the instant at which that folder, complete and on
 *              the medium, is renamed. So there is no half-made piece, whatever was cut.
 *          S2  A piece is removed by renaming it to "removed-0001" first. So there is no half-removed piece.
 *          S3  What is left of S1 and S2 is cleared away with the next opening. Nothing called "piece-" ever is,
 *              whatever its files hold or lack: what cannot be understood is shown with a sentence, and left as it is.
 * Units:   bytes.
 * Owner:   the caller owns the struct; the port outlives it. It belongs to one thread at a time: on the station to
 *          the errand that was sent out with it, while the screen shows a copy of `pieces`.
 * Errors:  a sentence, empty when it is done. After one, `pieces` is what the medium holds, where that can still be
 *          read.
 * Cost:    every call waits for the medium: none belongs on the frame path. A duplicate of a piece that is not open
 *          reads and writes all its files.
 */
#ifndef GLAISE_STATION_SHELF_H
#define GLAISE_STATION_SHELF_H

#include "sculpture/still.h"
#include "station/about.h"
#include "station/shelf_port.h"

constexpr int SHELF_PIECES_MAX = 9999;
constexpr const char *SHELF_ABOUT_NAME = "about";
constexpr const char *SHELF_THUMBNAIL_NAME = "thumbnail.png";
constexpr int SHELF_THUMBNAIL_WIDTH_PIXELS = 256, SHELF_THUMBNAIL_HEIGHT_PIXELS = 192;

struct shelf_piece {
    int number = 0;
    about facts;         /* where they cannot be read: the folder's name, ABOUT_ON */
    std::string trouble; /* why they cannot; empty when all is well. Such a piece can be opened and duplicated */
};

struct shelf {
    shelf_port port;
    std::vector<shelf_piece> pieces; /* by number */
    std::vector<int> taken;          /* numbers of all folders that are there, in order */
    std::string trouble;             /* why something is still to be cleared away; the shelf works all the same */
};

[[nodiscard]] std::string shelf_open(shelf *s, shelf_port port);

/* NULL: there is none. */
const shelf_piece *shelf_find(const shelf *s, int number);
/* "piece-0001" */
std::string shelf_folder(int number);

[[nodiscard]] std::string shelf_new(shelf *s, const std::string &name, int *number_out);
[[nodiscard]] std::string shelf_rename(shelf *s, int number, const std::string &name);
[[nodiscard]] std::string shelf_set_aside(shelf *s, int number);
[[nodiscard]] std::string shelf_bring_back(shelf *s, int number);
/* Only what was set aside. */
[[nodiscard]] std::string shelf_discard(shelf *s, int number);
/* Removes what was discarded, that of longest ago first, until so many bytes are free. */
[[nodiscard]] std::string shelf_make_room(shelf *s, uint64_t bytes);

/* `moment`: of the piece, if it is open: the copy has its clay and no history. NULL: the piece is not open, and the
   copy has its history as well. Makes room first. `told` may be empty; it hears 0..1. */
[[nodiscard]] std::string shelf_duplicate(shelf *s, int number, still *moment,
                                          const std::function<void(double)> &told, int *number_out);

#endif
