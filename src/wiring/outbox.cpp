/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/outbox.h"

#include "wiring/store.h"

#include <algorithm>

namespace {

std::string write(still &moment, const std::string &path, const std::function<void(double)> &told)
{
    std::string text;
    exchange_outcome outcome;
    auto through = [&](checkpoint_sink sink, void *self) {
        outcome = exchange_write(moment, path, sink, self, told);
        return outcome.state;
    };
    if (store_export(path, through, &text))
        return "";
    const bool world = outcome.state == STATUS_IO || outcome.state == STATUS_NO_SPACE;
    return outcome.text.empty() || world ? text : path + ": " + outcome.text;
}

void end(outbox_entry *e)
{
    if (e->writing) {
        e->file.trouble = errand_end(e->writing);
        still_end(e->moment.get());
    }
    e->writing = nullptr;
    e->moment.reset();
}

} // namespace

void outbox_send(outbox *o, sculpture *piece, const std::string &path)
{
    const auto is_written = [](const outbox_entry &e) { return e.writing != nullptr; };
    if (std::count_if(o->sent.begin(), o->sent.end(), is_written) >= ptrdiff_t{CAPACITY_FROZEN})
        end(&*std::find_if(o->sent.begin(), o->sent.end(), is_written));
    outbox_entry e;
    e.file.path = path;
    e.moment = std::make_unique<still>();
    const status s = still_begin(e.moment.get(), piece);
    if (s == STATUS_OK) {
        e.writing =
            errand_begin([moment = e.moment.get(), path](const auto &told) { return write(*moment, path, told); });
    } else {
        e.file.trouble = path + ": " + status_text(s);
        e.moment.reset();
    }
    o->sent.push_back(std::move(e));
}

bool outbox_is_done(const outbox *o)
{
    return o->sent.empty() || !o->sent.front().writing || errand_is_done(o->sent.front().writing);
}

double outbox_part(const outbox *o)
{
    return o->sent.empty() || !o->sent.front().writing ? 1 : errand_part(o->sent.front().writing);
}

std::optional<outbox_file> outbox_take(outbox *o)
{
    if (o->sent.empty() || !outbox_is_done(o))
        return std::nullopt;
    end(&o->sent.front());
    outbox_file file = std::move(o->sent.front().file);
    o->sent.pop_front();
    return file;
}
