/* SPDX-License-Identifier: Apache-2.0 */
#include "tests/crash/sim_disk.h"

#include <algorithm>
#include <cstring>

namespace {

enum : uint64_t { SECTOR_BYTES = 512, BLOCK_BYTES = 4096 };

sim_disk &disk_of(void *self) { return *static_cast<sim_disk *>(self); }

void complain(sim_disk &d, const std::string &what)
{
    if (d.misuse.empty())
        d.misuse = what;
}

void check_name(sim_disk &d, const std::string &name)
{
    if (name.empty() || name.size() > BYTE_STORE_NAME_MAX || name == "." || name == ".." ||
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789._-") != std::string::npos)
        complain(d, "bad name " + name);
}

/* --- what becomes of an operation --- */

void carry_out(sim_disk_bytes &to, const sim_disk_op &op)
{
    if (op.cuts) {
        to.resize(op.offset);
        return;
    }
    if (to.size() < op.offset + op.bytes.size())
        to.resize(op.offset + op.bytes.size());
    std::copy(op.bytes.begin(), op.bytes.end(), to.begin() + static_cast<ptrdiff_t>(op.offset));
}

/* Does something with every sector, or block, that the write covers in part or whole. */
template <typename work_type> void each_unit(const sim_disk_op &op, uint64_t unit, work_type work)
{
    for (uint64_t at = op.offset / unit * unit; at < op.offset + op.bytes.size(); at += unit)
        work(at);
}

void lengthen_perhaps(sim_disk_bytes &to, const sim_disk_op &op, seeded &chance)
{
    if (to.size() < op.offset + op.bytes.size() && seeded_chance(chance, 0.5))
        to.resize(op.offset + op.bytes.size());
}

void tear(sim_disk_bytes &to, const sim_disk_op &op, seeded &chance)
{
    lengthen_perhaps(to, op, chance);
    const double p = seeded_chance(chance, 0.3) ? 0.95 : seeded_real(chance, 0, 1);
    each_unit(op, SECTOR_BYTES, [&](uint64_t at) {
        const uint64_t from = std::max(at, op.offset);
        const uint64_t end = std::min(at + SECTOR_BYTES, op.offset + op.bytes.size());
        if (!seeded_chance(chance, p))
            return;
        if (to.size() < end)
            to.resize(end);
        std::copy_n(op.bytes.begin() + static_cast<ptrdiff_t>(from - op.offset), end - from,
                    to.begin() + static_cast<ptrdiff_t>(from));
    });
}

void garble(sim_disk_bytes &to, const sim_disk_op &op, const sim_disk_bytes &elsewhere, seeded &chance)
{
    tear(to, op, chance);
    const uint64_t unit = seeded_chance(chance, 0.5) ? SECTOR_BYTES : BLOCK_BYTES;
    const double p = seeded_real(chance, 0, 1);
    each_unit(op, unit, [&](uint64_t at) {
        if (!seeded_chance(chance, p))
            return;
        const uint64_t end = std::min<uint64_t>(at + unit, to.size());
        const bool moved = seeded_chance(chance, 0.5) && elsewhere.size() >= unit;
        const uint64_t from = moved ? static_cast<uint64_t>(seeded_int(
                                          chance, 0, static_cast<int64_t>(elsewhere.size() / unit) - 1)) * unit
                                    : 0;
        for (uint64_t n = at; n < end; n++)
            to[n] = moved ? elsewhere[from + n - at] : static_cast<uint8_t>(seeded_bits(chance));
    });
}

/* What a cut does on the whole: some of its kinds are rare when every operation has a fate of its own. */
enum class mood { all_kept, all_dropped, in_order, kept_or_dropped, anything, garbled };

struct cut {
    mood m;
    uint64_t until; /* in_order: what came before this operation is kept, it is torn, the rest is dropped */
};

enum class fate { kept, dropped, torn, garbled };

fate fate_of(const cut &c, const sim_disk_op &op, seeded &chance)
{
    switch (c.m) {
    case mood::all_kept: return fate::kept;
    case mood::all_dropped: return fate::dropped;
    case mood::in_order: return op.number < c.until ? fate::kept : op.number == c.until ? fate::torn : fate::dropped;
    case mood::kept_or_dropped: return seeded_chance(chance, 0.5) ? fate::kept : fate::dropped;
    case mood::garbled: return fate::garbled;
    case mood::anything: break;
    }
    return static_cast<fate>(seeded_int(chance, 0, 3));
}

sim_disk_bytes resolve(const sim_disk_file &f, const cut &c, seeded &chance)
{
    sim_disk_bytes left = f.durable;
    for (const sim_disk_op &op : f.pending) {
        const fate what = fate_of(c, op, chance);
        if (what == fate::kept || (op.cuts && what != fate::dropped))
            carry_out(left, op);
        else if (what == fate::dropped && !op.cuts)
            lengthen_perhaps(left, op, chance);
        else if (what == fate::torn)
            tear(left, op, chance);
        else if (what == fate::garbled)
            garble(left, op, f.now, chance);
    }
    return left;
}

/* --- calls --- */

enum class outcome { does, fails, fails_half_done, fails_having_done };

/* Counts a call; STATUS_IO once the world has ended. */
bool over(sim_disk &d)
{
    d.calls++;
    return d.ended;
}

bool ends_now(sim_disk &d)
{
    if (d.ends_at != 0 && d.calls >= d.ends_at)
        d.ended = true;
    return d.ended;
}

outcome outcome_of(sim_disk &d, double rate)
{
    if (d.calls == d.fail_at)
        return d.fail_having_done ? outcome::fails_having_done : outcome::fails;
    if (rate > 0 && seeded_chance(d.chance, rate))
        return static_cast<outcome>(seeded_int(d.chance, 1, 3));
    return outcome::does;
}

void tell(const sim_disk &d)
{
    if (d.watch)
        d.watch();
}

sim_disk_file *find(const sim_disk &d, const std::string &name)
{
    const auto at = d.names.find(name);
    return at == d.names.end() ? nullptr : at->second.get();
}

sim_disk_file &find_or_make(sim_disk &d, const std::string &name)
{
    std::shared_ptr<sim_disk_file> &f = d.names[name];
    if (!f)
        f = std::make_shared<sim_disk_file>();
    return *f;
}

status disk_read(void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got)
{
    sim_disk &d = disk_of(self);
    *got = 0;
    if (over(d) || ends_now(d) || outcome_of(d, d.read_fault_rate) != outcome::does)
        return STATUS_IO;
    const sim_disk_file *f = find(d, name);
    if (!f || offset >= f->now.size())
        return STATUS_OK;
    *got = std::min<size_t>(n, f->now.size() - static_cast<size_t>(offset));
    std::memcpy(bytes, f->now.data() + offset, *got);
    return STATUS_OK;
}

status disk_size(void *self, const char *name, uint64_t *bytes, bool *exists)
{
    sim_disk &d = disk_of(self);
    *bytes = 0;
    *exists = false;
    if (over(d) || ends_now(d) || outcome_of(d, d.read_fault_rate) != outcome::does)
        return STATUS_IO;
    const sim_disk_file *f = find(d, name);
    *exists = f != nullptr;
    *bytes = f ? f->now.size() : 0;
    return STATUS_OK;
}

status disk_list(void *self, void (*take)(void *into, const char *name), void *into)
{
    sim_disk &d = disk_of(self);
    if (over(d) || ends_now(d) || outcome_of(d, d.read_fault_rate) != outcome::does)
        return STATUS_IO;
    for (const auto &[name, f] : d.names)
        take(into, name.c_str());
    return STATUS_OK;
}

void change(sim_disk &d, const char *name, sim_disk_op op)
{
    sim_disk_file &f = find_or_make(d, name);
    if (f.spoilt)
        complain(d, std::string("wrote to ") + name + ", whose sync had failed");
    op.number = ++d.operations;
    carry_out(f.now, op);
    f.pending.push_back(std::move(op));
}

/* Half done: some of it, from its beginning. */
status change_call(sim_disk &d, const char *name, sim_disk_op op)
{
    check_name(d, name);
    if (over(d))
        return STATUS_IO;
    tell(d);
    const bool last = ends_now(d);
    const outcome what = last ? outcome::fails_half_done : outcome_of(d, d.fault_rate);
    const sim_disk_file *f = find(d, name);
    const uint64_t size = f ? f->now.size() : 0, end = op.offset + op.bytes.size();
    const uint64_t held = d.held();
    const bool full = end > size && held + (end - size) > d.most_bytes;
    if (full || (what == outcome::fails_half_done && !op.cuts)) {
        const uint64_t room = full && held < d.most_bytes ? d.most_bytes - held : 0;
        uint64_t most = full ? (op.offset < size ? size - op.offset : 0) + room : op.bytes.size();
        most = std::min<uint64_t>(most, op.bytes.size());
        op.bytes.resize(static_cast<size_t>(seeded_int(d.chance, 0, static_cast<int64_t>(most))));
    }
    if (what != outcome::fails && !(full && op.bytes.empty()))
        change(d, name, std::move(op));
    if (!last)
        tell(d);
    return full && !last ? STATUS_NO_SPACE : what == outcome::does ? STATUS_OK : STATUS_IO;
}

status disk_write(void *self, const char *name, uint64_t offset, const void *bytes, size_t n)
{
    const uint8_t *b = static_cast<const uint8_t *>(bytes);
    return change_call(disk_of(self), name, {0, false, offset, sim_disk_bytes(b, b + n)});
}

status disk_truncate(void *self, const char *name, uint64_t bytes)
{
    return change_call(disk_of(self), name, {0, true, bytes, {}});
}

/* Contract: a removal is durable with the next sync or rename. */
void settle_removals(sim_disk &d)
{
    for (auto at = d.durable_names.begin(); at != d.durable_names.end();)
        at = d.names.count(at->first) ? std::next(at) : d.durable_names.erase(at);
}

void sync_now(sim_disk &d, const std::string &name, sim_disk_file &f)
{
    for (const sim_disk_op &op : f.pending)
        carry_out(f.durable, op);
    f.pending.clear();
    d.durable_names[name] = d.names[name];
    settle_removals(d);
}

void sync_fails(sim_disk &d, const std::string &name, sim_disk_file &f)
{
    for (const sim_disk_op &op : f.pending)
        if (seeded_chance(d.chance, 0.5))
            carry_out(f.durable, op);
    f.pending.clear();
    f.spoilt = true;
    if (seeded_chance(d.chance, 0.5))
        f.now = f.durable;
    if (seeded_chance(d.chance, 0.5))
        d.durable_names[name] = d.names[name];
}

status disk_sync(void *self, const char *name)
{
    sim_disk &d = disk_of(self);
    check_name(d, name);
    if (over(d))
        return STATUS_IO;
    tell(d);
    if (ends_now(d))
        return STATUS_IO;
    sim_disk_file *f = find(d, name);
    if (!f) {
        complain(d, std::string("synced ") + name + ", which is not there");
        return STATUS_IO;
    }
    if (f->spoilt)
        complain(d, std::string("synced ") + name + " again after it had failed");
    const outcome what = outcome_of(d, d.fault_rate);
    if (what == outcome::does && d.lie_rate > 0 && seeded_chance(d.chance, d.lie_rate))
        return STATUS_OK;
    if (what == outcome::does || what == outcome::fails_having_done)
        sync_now(d, name, *f);
    else
        sync_fails(d, name, *f);
    f->spoilt = f->spoilt || what != outcome::does;
    tell(d);
    return what == outcome::does ? STATUS_OK : STATUS_IO;
}

status disk_rename(void *self, const char *from, const char *to)
{
    sim_disk &d = disk_of(self);
    check_name(d, from);
    check_name(d, to);
    if (over(d))
        return STATUS_IO;
    tell(d);
    const bool last = ends_now(d);
    const outcome what = last ? (seeded_chance(d.chance, 0.5) ? outcome::does : outcome::fails)
                              : outcome_of(d, d.fault_rate);
    if (!find(d, from)) {
        complain(d, std::string("renamed ") + from + ", which is not there");
        return STATUS_IO;
    }
    if (what == outcome::does || what == outcome::fails_having_done) {
        std::shared_ptr<sim_disk_file> f = d.names[from];
        d.names.erase(from);
        d.durable_names.erase(from);
        d.names[to] = f;
        d.durable_names[to] = f;
        settle_removals(d);
    }
    if (!last)
        tell(d);
    return what == outcome::does && !last ? STATUS_OK : STATUS_IO;
}

status disk_remove(void *self, const char *name)
{
    sim_disk &d = disk_of(self);
    check_name(d, name);
    if (over(d))
        return STATUS_IO;
    tell(d);
    const bool last = ends_now(d);
    const outcome what = last ? outcome::fails_having_done : outcome_of(d, d.fault_rate);
    if (what == outcome::does || what == outcome::fails_having_done)
        d.names.erase(name);
    if (!last)
        tell(d);
    return what == outcome::does ? STATUS_OK : STATUS_IO;
}

void put_file(sim_disk &into, const std::string &name, sim_disk_bytes bytes)
{
    auto f = std::make_shared<sim_disk_file>();
    f->now = bytes;
    f->durable = std::move(bytes);
    into.names[name] = f;
    into.durable_names[name] = f;
}

} // namespace

byte_store sim_disk::port()
{
    return {this, disk_read, disk_write, disk_size, disk_truncate, disk_sync, disk_rename, disk_remove, disk_list};
}

std::unique_ptr<sim_disk> sim_disk::after_cut(uint64_t seed) const
{
    auto after = std::make_unique<sim_disk>(seed);
    seeded &by = after->chance;
    cut c = {static_cast<mood>(seeded_int(by, 0, 5)), 0};
    uint64_t first = UINT64_MAX;
    for (const auto &[name, f] : names)
        for (const sim_disk_op &op : f->pending)
            first = std::min(first, op.number);
    if (first != UINT64_MAX)
        c.until = static_cast<uint64_t>(
            seeded_int(by, static_cast<int64_t>(first), static_cast<int64_t>(operations) + 1));
    for (const auto &[name, f] : names) {
        const auto old = durable_names.find(name);
        const bool settled = old != durable_names.end() && old->second == f;
        const bool here = settled || (c.m == mood::all_kept ? true : seeded_chance(by, 0.5));
        if (here)
            put_file(*after, name, resolve(*f, c, by));
        else if (old != durable_names.end())
            put_file(*after, name, resolve(*old->second, c, by));
    }
    for (const auto &[name, f] : durable_names) /* removed, and back again */
        if (!names.count(name) && seeded_chance(by, 0.5))
            put_file(*after, name, resolve(*f, c, by));
    return after;
}

void sim_disk::new_process()
{
    for (const auto &[name, f] : names) {
        f->spoilt = false;
        f->now = f->durable;
        for (const sim_disk_op &op : f->pending)
            carry_out(f->now, op);
    }
}

uint64_t sim_disk::held() const
{
    uint64_t all = 0;
    for (const auto &[name, f] : names)
        all += f->now.size();
    return all;
}
