/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The log of everything that was written to a virtual disk, and what a power cut at any of its entries may
 *          leave on that disk.
 * Is not:  The virtual machine that writes it (guest_run.h); a judge of what is left (power_cut_test.cpp).
 * Shape:   the log is QEMU's blklogwrites, which is the kernel's dm-log-writes, little-endian, in sectors of 512 bytes:
 *            sector 0     mark, version (1), number of entries: uint64; sector bytes: uint32. Renewed at a flush, so
 *                         that there may be more entries than it says
 *            each entry   a sector: first sector, sectors, flags (1 flush, 2 past the cache, 4 discard), 0: uint64;
 *                         then its data, but for a discard
 *          QEMU logs a write or flush when it has ended. What follows in its data was on its way to the medium only
 *          after a flush that the same entry tells.
 *
 *          A cut right after an entry: what was written before the last flush is there, and so is what went past the
 *          cache; each later write is kept, dropped or torn: of a torn one each sector of 512 bytes is there or not.
 *          How much is kept is another chance at every cut. The first WRITE_LOG_WHOLE_BYTES of the disk arrive together
 *          or not at all: ext4's super block has one checksum over two sectors, which no program above it can mend.
 * Errors:  a sentence; a log that breaks off in the middle of an entry ends before it.
 * Cost:    the log and two disks in memory.
 */
#ifndef GLAISE_VM_WRITE_LOG_H
#define GLAISE_VM_WRITE_LOG_H

#include "tests/property/seeded.h"

#include <string>
#include <vector>

enum { WRITE_LOG_SECTOR_BYTES = 512, WRITE_LOG_WHOLE_BYTES = 4096 };

using write_log_bytes = std::vector<uint8_t>;

struct write_log_entry {
    uint64_t offset, bytes; /* of the disk */
    bool flush, past_cache, discard;
    size_t data; /* where in write_log::all */
};

struct write_log {
    write_log_bytes all;
    std::vector<write_log_entry> entries;
    uint64_t flushes = 0;

    const uint8_t *data_of(const write_log_entry &e) const { return all.data() + e.data; }
};

/* "" or what is wrong. */
std::string write_log_read(const std::string &path, write_log *log_out);
std::string write_log_parse(write_log_bytes all, write_log *log_out);

/* What became of the writes since the last flush. */
struct write_log_fates {
    uint64_t kept = 0, dropped = 0, torn = 0;
};

/* A disk that loses power at one entry after the other, each time as if for the first time. What was written behind its
   end is left out. */
struct write_log_disk {
    const write_log *log;
    write_log_bytes durable; /* at first: as it was before the log began */
    size_t done = 0;         /* entries that are in it */

    /* Cuts come in ascending order. */
    write_log_bytes after_cut(size_t entry, seeded &chance, write_log_fates *fates_out);
    /* All that was written is there. */
    write_log_bytes whole() const;
};

#endif
