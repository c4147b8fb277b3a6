/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Going from one piece of the shelf to another while sculpting goes on: the next is opened in an errand, then
 *          they change places, then the old one is closed in an errand.
 * Is not:  Which pieces there are (shelf.h); what else knows of the open piece: station, view.
 * Shape:   begin --- is_ready, part: once a frame, the old one is sculpted on ---> end: the new one is on the table
 *
 *          An errand first waits for the closing before it. So at most two pieces are in memory, and a piece that is
 *          still being closed can be asked for again.
 * Owner:   the caller owns the table, and keeps it at its place while a piece is on it. Before _end or _put_away the
 *          station is closed, the view knows nothing of the piece any more, and no still of it is out.
 * Errors:  _end answers a sentence, empty when it is done; else the table is as it was. What went wrong with closing is
 *          told later (_trouble_take).
 * Cost:    no call but switching_close, and _end before it is ready, waits for the medium. The history thread is
 *          begun by _end, some 50 us.
 */
#ifndef GLAISE_STATION_SWITCHING_H
#define GLAISE_STATION_SWITCHING_H

#include "station/history_thread.h"
#include "station/shelf_port.h"

#include <memory>

/* What lies on the table: an open piece, and what belongs to it. */
struct switching_piece {
    int number = 0;                   /* 0: none */
    std::unique_ptr<sculpture> piece;
    history_thread *keeping = nullptr; /* NULL where the system gave no thread: history is in place */
    byte_store store{};
    history_finding finding{};
};

struct switching_wishes {
    history_settings settings = HISTORY_SETTINGS_DEFAULT;
    double step_mm = SCULPTURE_STEP_MM_DEFAULT;         /* of a piece that has no clay yet */
    std::function<void(const keeper_facts &)> kept;     /* history_thread.h */
};

struct switching;

switching *switching_open(shelf_port port, switching_wishes wishes);
/* Waits for what is under way; the table must be empty. */
void switching_close(switching *s);

/* Nothing is being opened. The piece is on the shelf, and not on the table. */
void switching_begin(switching *s, int number);
bool switching_is_under_way(const switching *s);
bool switching_is_ready(const switching *s);
double switching_part(const switching *s); /* 0..1 */
/* Waits where it is not ready. Crew and vectors of the clay are then set by whoever has them. */
[[nodiscard]] std::string switching_end(switching *s, switching_piece *table);
/* Empties the table. */
void switching_put_away(switching *s, switching_piece *table);
/* What closing had to say, once it is done; "" when nothing. */
std::string switching_trouble_take(switching *s);

#endif
