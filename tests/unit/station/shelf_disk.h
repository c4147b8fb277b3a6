/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Folders in memory behind the shelf's port, that fail or lose power at a given call, before it, amid it or
 *          having done it.
 * Is not:  A disk that garbles single writes (tests/crash/sim_disk.h).
 * Shape:   every call of the port and of the byte stores it opens is counted from 1. A file has what is read (now) and
 *          what is on the medium (durable, after a sync). after_cut says what is found when the power is back.
 * Owner:   the test; what port() gives refers to the disk. It may be called from several threads.
 */
#ifndef GLAISE_UNIT_STATION_SHELF_DISK_H
#define GLAISE_UNIT_STATION_SHELF_DISK_H

#include "station/shelf_port.h"

#include <map>
#include <memory>
#include <mutex>
#include <set>

struct shelf_disk_file {
    std::string now;
    std::optional<std::string> durable;
};

using shelf_disk_folder = std::map<std::string, shelf_disk_file>;

enum shelf_disk_part { SHELF_DISK_NOTHING, SHELF_DISK_HALF, SHELF_DISK_ALL };

struct shelf_disk_store; /* one that is open */

struct shelf_disk {
    std::map<std::string, shelf_disk_folder> folders, removed; /* removed: a cut may bring it back */
    std::map<std::string, std::unique_ptr<shelf_disk_store>> stores;
    uint64_t calls = 0, strike_at = 0;           /* 0: never */
    shelf_disk_part done = SHELF_DISK_NOTHING;   /* of the call that is struck */
    bool cuts = false;                           /* that call is the last */
    bool dead = false;
    uint64_t capacity = UINT64_MAX;              /* of all files, for `free` */
    /* Called before each call, unlocked. */
    std::function<void(const std::string &folder, const std::string &call)> watch;
    std::mutex guard;

    shelf_disk();
    ~shelf_disk();
    shelf_port port();
    /* Of what was not synced nothing, a half or all is there; what was removed is gone, or not. */
    void after_cut(shelf_disk_part unsynced, bool removed_comes_back);
    void put(const std::string &folder, const std::string &file, const std::string &bytes);
    uint64_t held() const;
};

#endif
