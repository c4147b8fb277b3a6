/* SPDX-License-Identifier: Apache-2.0 */
#include "station/opening.h"

#include "station/errand.h"
#include "station/rehearsal.h"

#include <algorithm>
#include <memory>

struct opening {
    status outcome = STATUS_OK;
    history_finding finding{};
    errand *reading = nullptr;
};

namespace {

/* The caller's port; while it reads, history speaks to it through the functions below. */
struct metered {
    byte_store port;
    const std::function<void(double)> &told;
    double expected, got = 0;
};

metered *of(void *self) { return static_cast<metered *>(self); }

status port_read(void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    metered *o = of(self);
    const status s = o->port.read(o->port.self, name, offset, bytes, n, got_out);
    o->got += static_cast<double>(*got_out);
    if (o->told)
        o->told(std::min(1.0, o->got / o->expected));
    return s;
}

const byte_store &port_of(void *self) { return of(self)->port; }

status port_write(void *self, const char *name, uint64_t offset, const void *bytes, size_t n)
{
    return port_of(self).write(port_of(self).self, name, offset, bytes, n);
}
status port_size(void *self, const char *name, uint64_t *bytes_out, bool *exists_out)
{
    return port_of(self).size(port_of(self).self, name, bytes_out, exists_out);
}
status port_truncate(void *self, const char *name, uint64_t bytes)
{
    return port_of(self).truncate(port_of(self).self, name, bytes);
}
status port_sync(void *self, const char *name) { return port_of(self).sync(port_of(self).self, name); }
status port_rename(void *self, const char *from, const char *to)
{
    return port_of(self).rename(port_of(self).self, from, to);
}
status port_remove(void *self, const char *name) { return port_of(self).remove(port_of(self).self, name); }
status port_list(void *self, void (*take)(void *into, const char *name), void *into)
{
    return port_of(self).list(port_of(self).self, take, into);
}

double field_bytes(const byte_store &port)
{
    uint64_t bytes = 0;
    bool exists = false;
    const status s = port.size(port.self, HISTORY_FIELD_NAME, &bytes, &exists);
    return s == STATUS_OK && exists && bytes > 0 ? static_cast<double>(bytes) : 1;
}

} // namespace

status opening_here(sculpture *piece, const byte_store &port, const history_settings &settings, double step_mm,
                    const std::function<void(double)> &told, history_finding *finding_out)
{
    history_finding set_aside;
    const auto rehearse = [&](const byte_store &other) {
        auto unseen = std::make_unique<sculpture>();
        history_finding finding;
        const status s = sculpture_open(unseen.get(), &other, CAPACITY_BRICKS, &settings, step_mm, &finding);
        (void)s; /* that it comes to an end is enough */
    };
    rehearsal_begin(port, rehearse, &set_aside);
    metered m = {port, told, field_bytes(port)};
    const byte_store through = {&m,        port_read,   port_write,  port_size, port_truncate,
                                port_sync, port_rename, port_remove, port_list};
    const status outcome = sculpture_open(piece, &through, CAPACITY_BRICKS, &settings, step_mm, finding_out);
    rehearsal_end(port);
    if (set_aside.text[0] != '\0')
        *finding_out = set_aside;
    if (outcome == STATUS_OK)
        piece->history.store = port; /* the meter will be gone */
    return outcome;
}

opening *opening_begin(sculpture *piece, const byte_store &port, const history_settings &settings, double step_mm)
{
    auto *o = new opening;
    o->reading = errand_begin([=](const std::function<void(double)> &told) {
        o->outcome = opening_here(piece, port, settings, step_mm, told, &o->finding);
        return std::string();
    });
    return o;
}

double opening_part(const opening *o) { return errand_part(o->reading); }
bool opening_is_done(const opening *o) { return errand_is_done(o->reading); }

status opening_end(opening *o, history_finding *finding_out)
{
    errand_end(o->reading);
    const status outcome = o->outcome;
    *finding_out = o->finding;
    delete o;
    return outcome;
}
