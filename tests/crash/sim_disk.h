/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A disk in memory behind the byte_store port that does to history what real ones do: it loses power, and with
 *          it what was not synced; it fails, fills up, and lies.
 * Is not:  tests/unit/history/memory_store.h, which fails but never loses anything.
 * Shape:   a file has what is read (`now`), what is on the medium (`durable`), and the writes and cuts between the two,
 *          in order (`pending`). Names likewise: `names` is what is seen, `durable_names` what is on the medium.
 *
 *              write, truncate -> pending      sync: pending -> durable, and the name; removals too
 *              remove: the name may come back  rename: durable at once
 *
 *          Every call that changes something tells `watch` twice: before it does its work and after, so that a cut can
 *          be tried at every instant of a run without repeating the run.
 *
 *          At a power cut each pending operation is kept, dropped, torn (some sectors of it arrive) or garbled (some
 *          sectors or 4 KiB blocks that it covers hold random bytes, or bytes from elsewhere in the file): no block
 *          outside of it is touched. A file that was never synced is absent, or there with what became of its writes.
 *          After a failed sync each pending write has arrived or is gone for good; reading shows it all the same, or
 *          does not, until the process ends; the next sync succeeds. A sync that lies answers STATUS_OK and leaves all
 *          pending.
 * Owner:   the test; port() holds a pointer to it.
 */
#ifndef GLAISE_CRASH_SIM_DISK_H
#define GLAISE_CRASH_SIM_DISK_H

#include "history/byte_store.h"

#include "tests/property/seeded.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

using sim_disk_bytes = std::vector<uint8_t>;

/* Under a sanitizer everything takes six times as long; the other builds do all of it. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
enum { SIM_DISK_THIN = 7 };
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
enum { SIM_DISK_THIN = 7 };
#else
enum { SIM_DISK_THIN = 1 };
#endif
#else
enum { SIM_DISK_THIN = 1 };
#endif

struct sim_disk_op {
    uint64_t number; /* over all files of the disk */
    bool cuts;       /* a truncate to `offset` */
    uint64_t offset;
    sim_disk_bytes bytes;
};

struct sim_disk_file {
    sim_disk_bytes now, durable;
    std::vector<sim_disk_op> pending;
    bool spoilt = false; /* its sync had failed in this process */
};

using sim_disk_names = std::map<std::string, std::shared_ptr<sim_disk_file>>;

struct sim_disk {
    sim_disk_names names, durable_names;
    seeded chance;
    uint64_t calls = 0; /* all, from 1 */
    uint64_t operations = 0;
    std::function<void()> watch;

    uint64_t ends_at = 0; /* the call in which the power goes; 0: none. Then every call answers STATUS_IO */
    bool ended = false;
    uint64_t fail_at = 0;          /* one call that answers STATUS_IO ... */
    bool fail_having_done = false; /* ... although it did its work */
    double fault_rate = 0;         /* of calls that change something: as above, or half done */
    double read_fault_rate = 0;
    double lie_rate = 0;              /* of syncs */
    uint64_t most_bytes = UINT64_MAX; /* of all files: beyond, STATUS_NO_SPACE */
    std::string misuse;               /* the first rule of byte_store.h that was broken */

    explicit sim_disk(uint64_t seed) : chance{seed} {}
    sim_disk(const sim_disk &) = delete;
    sim_disk &operator=(const sim_disk &) = delete;

    byte_store port();
    /* What is found when the power is back. */
    std::unique_ptr<sim_disk> after_cut(uint64_t seed) const;
    /* The process died and the machine did not: what is pending stays so. What a failed sync lost is not read any more:
       platform/storage drops what the machine holds of such a file (storage.c, lost_drop; medium_test shows it). */
    void new_process();
    uint64_t held() const;
};

#endif
