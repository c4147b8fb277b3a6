/* SPDX-License-Identifier: Apache-2.0 */
#include "station/switching.h"

#include "station/errand.h"
#include "station/opening.h"
#include "station/shelf.h"

#include <cassert>
#include <utility>

struct switching {
    shelf_port port;
    switching_wishes wishes;
    errand *opening = nullptr;
    errand *closing = nullptr; /* of what was put away last */
    switching_piece next;      /* the opening's until it is ended, like `closed` */
    std::string closed;        /* what closing had to say */
};

namespace {

std::string piece_open(const shelf_port &port, const switching_wishes &wishes, switching_piece *p,
                       const std::function<void(double)> &told)
{
    const std::string folder = shelf_folder(p->number);
    std::string text = port.open(folder, &p->store);
    if (!text.empty())
        return text;
    auto piece = std::make_unique<sculpture>();
    const status s = opening_here(piece.get(), p->store, wishes.settings, wishes.step_mm, told, &p->finding);
    if (s == STATUS_OK) {
        p->piece = std::move(piece);
        return "";
    }
    port.close(p->store);
    text = folder + ": " + status_text(s);
    return p->finding.text[0] ? text + " (" + p->finding.text + ")" : text;
}

std::string piece_close(const shelf_port &port, switching_piece *p)
{
    history_thread_close(p->keeping);
    const status s = sculpture_close(p->piece.get());
    port.close(p->store);
    p->piece.reset();
    return s == STATUS_OK ? "" : shelf_folder(p->number) + ": " + status_text(s);
}

void hear(std::string *all, const std::string &text) { *all += all->empty() || text.empty() ? text : "; " + text; }

/* The closing before, if any, whose answer goes to `closed`. */
void closing_end(errand *before, std::string *closed)
{
    if (before)
        hear(closed, errand_end(before));
}

} // namespace

switching *switching_open(shelf_port port, switching_wishes wishes)
{
    auto *s = new switching;
    s->port = std::move(port);
    s->wishes = std::move(wishes);
    return s;
}

void switching_close(switching *s)
{
    switching_piece unwanted;
    if (s->opening && switching_end(s, &unwanted).empty())
        switching_put_away(s, &unwanted);
    closing_end(s->closing, &s->closed);
    delete s;
}

void switching_begin(switching *s, int number)
{
    assert(!s->opening);
    s->next.number = number;
    s->opening = errand_begin([s, before = std::exchange(s->closing, nullptr)](const auto &told) {
        closing_end(before, &s->closed);
        return piece_open(s->port, s->wishes, &s->next, told);
    });
}

bool switching_is_under_way(const switching *s) { return s->opening != nullptr; }
bool switching_is_ready(const switching *s) { return s->opening && errand_is_done(s->opening); }
double switching_part(const switching *s) { return s->opening ? errand_part(s->opening) : 1; }

std::string switching_end(switching *s, switching_piece *table)
{
    std::string text = errand_end(std::exchange(s->opening, nullptr));
    switching_piece next = std::exchange(s->next, {});
    if (!text.empty())
        return text;
    if (table->piece)
        switching_put_away(s, table);
    *table = std::move(next);
    /* Not in the errand: a thread begun there would inherit its low priority. */
    table->keeping = history_thread_open(table->piece.get(), s->wishes.kept);
    return "";
}

void switching_put_away(switching *s, switching_piece *table)
{
    auto old = std::make_shared<switching_piece>(std::exchange(*table, {}));
    old->piece->clay.crew = nullptr; /* works for who sculpts, not for an errand */
    s->closing = errand_begin([s, old, before = std::exchange(s->closing, nullptr)](const auto &) {
        std::string text = before ? errand_end(before) : "";
        hear(&text, piece_close(s->port, old.get()));
        return text;
    });
}

std::string switching_trouble_take(switching *s)
{
    if (s->opening)
        return "";
    if (s->closing && errand_is_done(s->closing))
        closing_end(std::exchange(s->closing, nullptr), &s->closed);
    return std::exchange(s->closed, "");
}
