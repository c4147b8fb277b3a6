/* SPDX-License-Identifier: Apache-2.0 */
#include "bench_piece.h"

#include "bench_rig.h"

namespace {

/* A store on a medium without delay or memory. */
status read_nothing(void *, const char *, uint64_t, void *, size_t, size_t *got_out)
{
    *got_out = 0;
    return STATUS_OK;
}
status write_away(void *, const char *, uint64_t, const void *, size_t) { return STATUS_OK; }
status size_of_nothing(void *, const char *, uint64_t *bytes_out, bool *exists_out)
{
    *bytes_out = 0;
    *exists_out = false;
    return STATUS_OK;
}
status truncate_nothing(void *, const char *, uint64_t) { return STATUS_OK; }
status name_done(void *, const char *) { return STATUS_OK; }
status list_nothing(void *, void (*)(void *, const char *), void *) { return STATUS_OK; }
status rename_done(void *, const char *, const char *) { return STATUS_OK; }

const byte_store nowhere = {nullptr,  read_nothing, write_away, size_of_nothing, truncate_nothing,
                            name_done, rename_done,  name_done,  list_nothing};

} // namespace

bench_piece::bench_piece(uint32_t bricks) : whole(std::make_unique<sculpture>())
{
    history_finding finding;
    bench_rig_demand(sculpture_open(whole.get(), &nowhere, bricks, nullptr, 1.0, &finding) == STATUS_OK,
                     std::string("sculpture_open: ") + finding.text);
    bench_rig_demand(ellipsoid_init(&ball, ELLIPSOID_WYVILL, 1) == STATUS_OK, "ellipsoid_init");
}

bench_piece::~bench_piece() { bench_rig_demand(sculpture_close(whole.get()) == STATUS_OK, "sculpture_close"); }

void bench_piece::stroke(const bench_object_dab &d)
{
    const tool t = {ellipsoid_shape(&ball), d.kind, d.rgba, {}};
    const sculpture_dab dab = {d.dab.at, d.dab.amount, 1.0};
    sculpture_stroke_begin(whole.get());
    bench_rig_demand(sculpture_apply(whole.get(), &t, &dab, nullptr) == STATUS_OK, "sculpture_apply");
    bench_rig_demand(sculpture_stroke_end(whole.get()) == STATUS_OK, "sculpture_stroke_end");
}

uint64_t bench_piece::field_digest() const { return clay_digest(&whole->clay); }
