/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A sculpture whose undo-files go nowhere: a dab as a stroke of its own, with all undo costs but the disk.
 * Is not:  Undoable (nothing can be read back); the bare engines (bench_rig.h).
 * Owner:   a piece owns its sculpture; large, not to be copied.
 * Errors:  ends the program as bench_rig_demand does.
 * Source:  000 section 3.3: "each time a tool is applied, we dump all the modified Corners".
 */
#ifndef GLAISE_BENCH_BENCH_PIECE_H
#define GLAISE_BENCH_BENCH_PIECE_H

#include "bench_object.h"
#include "sculpture/sculpture.h"

#include <memory>

class bench_piece {
public:
    explicit bench_piece(uint32_t bricks);
    ~bench_piece();
    bench_piece(const bench_piece &) = delete;
    bench_piece &operator=(const bench_piece &) = delete;

    void stroke(const bench_object_dab &d);
    uint64_t field_digest() const;

private:
    std::unique_ptr<sculpture> whole;
    ellipsoid ball = {};
};

#endif
