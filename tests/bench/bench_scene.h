/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    An object to work on, in every engine that is here: ours, OpenVDB, the paper's trees; and the way back to
 *          what it was before the dabs.
 * Is not:  Timing.
 * Shape:   "1M": 500 seeded dabs; "20M": the same 2.72 times larger.
 * Owner:   a scene owns its engines; large, not to be copied.
 * Errors:  as bench_rig.h.
 */
#ifndef GLAISE_BENCH_BENCH_SCENE_H
#define GLAISE_BENCH_BENCH_SCENE_H

#include "bench_rig.h"
#include "vdb_peer.h"

#include <memory>
#include <string>

class bench_scene {
public:
    explicit bench_scene(const std::string &which); /* "1M" or "20M" */
    ~bench_scene();
    bench_scene(const bench_scene &) = delete;
    bench_scene &operator=(const bench_scene &) = delete;

    void restore();
    bool is_large() const { return name != "1M"; }

    std::string name;
    std::unique_ptr<bench_rig> rig;
    std::unique_ptr<vdb_peer> vdb; /* empty where OpenVDB is not here */
    clay pristine = {};
};

#endif
