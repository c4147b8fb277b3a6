/* SPDX-License-Identifier: Apache-2.0 */
#include "station/opening.h"

#include "station/errand.h"

#include <algorithm>

struct opening {
    sculpture *piece = nullptr;
    byte_store port{}; /* the caller's; while it reads, history speaks to it through the functions below */
    std::function<void(double)> told;
    double expected = 1, got = 0;
    status outcome = STATUS_OK;
    history_finding finding{};
    errand *reading = nullptr;
};

namespace {

opening *of(void *self) { return static_cast<opening *>(self); }

status port_read(void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    opening *o = of(self);
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

double field_bytes(const byte_store &port)
{
    uint64_t bytes = 0;
    bool exists = false;
    const status s = port.size(port.self, HISTORY_FIELD_NAME, &bytes, &exists);
    return s == STATUS_OK && exists && bytes > 0 ? static_cast<double>(bytes) : 1;
}

} // namespace

opening *opening_begin(sculpture *piece, const byte_store &port, uint32_t ring, double step_mm)
{
    auto *o = new opening;
    o->piece = piece;
    o->port = port;
    o->expected = field_bytes(port);
    o->reading = errand_begin([o, ring, step_mm](const std::function<void(double)> &told) {
        const byte_store metered = {o,         port_read,   port_write, port_size, port_truncate,
                                    port_sync, port_rename, port_remove};
        o->told = told;
        o->outcome = sculpture_open(o->piece, &metered, CAPACITY_BRICKS, ring, step_mm, &o->finding);
        if (o->outcome == STATUS_OK)
            o->piece->history.store = o->port; /* the opening will be gone */
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
