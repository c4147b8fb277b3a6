/* SPDX-License-Identifier: Apache-2.0 */
#include "tests/vm/write_log.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

namespace {

constexpr uint64_t MARK = 0x6a736677736872u;
constexpr uint64_t FLUSH = 1, PAST_CACHE = 2, DISCARD = 4;

uint64_t number_at(const write_log_bytes &all, size_t at, size_t bytes)
{
    uint64_t n = 0;
    for (size_t b = 0; b < bytes; b++)
        n |= static_cast<uint64_t>(all[at + b]) << (8 * b);
    return n;
}

struct placed {
    const write_log *log;
    write_log_bytes *disk;
};

/* The bytes from..to of an entry, counted from its beginning. */
void put(const placed &p, const write_log_entry &e, uint64_t from, uint64_t to)
{
    const uint64_t end = std::min(e.offset + to, static_cast<uint64_t>(p.disk->size()));
    if (e.offset + from >= end)
        return;
    uint8_t *at = p.disk->data() + e.offset + from;
    if (e.discard)
        std::memset(at, 0, end - e.offset - from);
    else
        std::memcpy(at, p.log->data_of(e) + from, end - e.offset - from);
}

void put_torn(const placed &p, const write_log_entry &e, seeded &chance)
{
    uint64_t from = 0;
    while (from < e.bytes) {
        const uint64_t piece = e.offset + from < WRITE_LOG_WHOLE_BYTES ? WRITE_LOG_WHOLE_BYTES - e.offset - from
                                                                        : +WRITE_LOG_SECTOR_BYTES;
        const uint64_t to = std::min(from + piece, e.bytes);
        if (seeded_chance(chance, 0.5))
            put(p, e, from, to);
        from = to;
    }
}

} // namespace

std::string write_log_parse(write_log_bytes all, write_log *log_out)
{
    write_log log;
    log.all = std::move(all);
    constexpr size_t sector = WRITE_LOG_SECTOR_BYTES;
    if (log.all.size() < sector)
        return "the log is empty";
    if (number_at(log.all, 0, 8) != MARK || number_at(log.all, 8, 8) != 1 || number_at(log.all, 24, 4) != sector)
        return "no log of writes in sectors of 512 bytes, or nothing was ever flushed";
    const uint64_t told = number_at(log.all, 16, 8);
    for (size_t at = sector; at + sector <= log.all.size();) {
        const uint64_t first = number_at(log.all, at, 8), sectors = number_at(log.all, at + 8, 8);
        const uint64_t flags = number_at(log.all, at + 16, 8);
        const bool discard = flags & DISCARD;
        const size_t data = at + sector, left = log.all.size() - data;
        if ((first == 0 && sectors == 0 && flags == 0) || (!discard && sectors > left / sector))
            break;
        log.entries.push_back({first * sector, sectors * sector, (flags & FLUSH) != 0, (flags & PAST_CACHE) != 0,
                               discard, data});
        log.flushes += flags & FLUSH;
        at = data + (discard ? 0 : sectors * sector);
    }
    if (log.entries.size() < told)
        return "the log has " + std::to_string(log.entries.size()) + " entries, not " + std::to_string(told);
    *log_out = std::move(log);
    return "";
}

std::string write_log_read(const std::string &path, write_log *log_out)
{
    std::ifstream file(path, std::ios::binary);
    if (!file)
        return path + ": cannot be read";
    write_log_bytes all{std::istreambuf_iterator<char>(file), {}};
    const std::string trouble = write_log_parse(std::move(all), log_out);
    return trouble.empty() ? "" : path + ": " + trouble;
}

write_log_bytes write_log_disk::after_cut(size_t entry, seeded &chance, write_log_fates *fates_out)
{
    const std::vector<write_log_entry> &all = log->entries;
    size_t flushed = done;
    for (size_t n = done; n <= entry; n++)
        if (all[n].flush)
            flushed = n;
    for (; done < flushed; done++)
        put({log, &durable}, all[done], 0, all[done].bytes);
    write_log_bytes left = durable;
    *fates_out = {};
    const double keep = seeded_real(chance, 0, 1);
    for (size_t n = done; n <= entry; n++) {
        const placed to = {log, &left};
        if (all[n].past_cache) {
            put(to, all[n], 0, all[n].bytes);
        } else if (all[n].bytes == 0 || all[n].offset >= left.size()) {
            continue;
        } else if (seeded_chance(chance, 1.0 / 3)) {
            put_torn(to, all[n], chance);
            fates_out->torn++;
        } else if (seeded_chance(chance, keep)) {
            put(to, all[n], 0, all[n].bytes);
            fates_out->kept++;
        } else {
            fates_out->dropped++;
        }
    }
    return left;
}

write_log_bytes write_log_disk::whole() const
{
    write_log_bytes disk = durable;
    for (size_t n = done; n < log->entries.size(); n++)
        put({log, &disk}, log->entries[n], 0, log->entries[n].bytes);
    return disk;
}
