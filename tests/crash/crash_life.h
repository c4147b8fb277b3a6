/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A sculpture's life of chance on a simulated disk, through several starts of the program, with a book of all
 *          that was put and kept; and what must hold wherever that life is cut.
 * Is not:  The disk (sim_disk.h); the tests, which say what kind of life.
 * Shape:   the book holds, for every whole record of the present timeline, sequence -> where the clay stood, digest.
 *          A cut takes from its end what was not kept. `kept` is the last sequence that was acknowledged.
 *
 *          A probe takes the disk as a cut would leave it at this instant, opens it (cutting again meanwhile, now and
 *          then), compares with the book, works on, and throws it away; the life goes on untouched.
 */
#ifndef GLAISE_CRASH_CRASH_LIFE_H
#define GLAISE_CRASH_CRASH_LIFE_H

#include "tests/crash/sim_disk.h"
#include "tests/unit/history/piece.h"

#include "clay/freeze.h"

#include <set>

struct crash_life_state {
    uint64_t cursor, digest;
    bool move;
};

struct crash_life_book {
    std::map<uint64_t, crash_life_state> states; /* of this timeline, by sequence; 0 is there */
    std::multimap<uint64_t, crash_life_state> lost; /* of earlier ones, likewise: they were not kept */
    std::set<uint64_t> ever;                     /* digests of all states, of all timelines */
    uint64_t kept = 0;

    crash_life_book() { put(0, {0, 0, true}); }
    void put(uint64_t sequence, const crash_life_state &s);
    /* What is behind this sequence never was. */
    void cut(uint64_t sequence);
    /* A medium that failed may have what it said it had not. Until more is kept, such a state comes back. */
    void revive(uint64_t sequence, uint64_t digest);
    /* The last whole record that is not behind this one. */
    uint64_t whole(uint64_t sequence) const;
    /* Of the clay after a stroke, as far as it had come by then. */
    uint64_t digest_of(uint64_t cursor, uint64_t until) const;
};

/* What the run of all tests came to. */
struct crash_life_count {
    uint64_t points = 0, recoveries = 0, lives = 0, cuts = 0, kills = 0, losses = 0, losses_told = 0, faults = 0;
};
extern crash_life_count crash_life_counted;

struct crash_life_kind {
    int starts = 4, steps = 25;
    int corners = 60;           /* of a usual stretch */
    double keep_rate = 0.7;     /* after a step */
    double large = 0.1;         /* chance of a stretch that takes several undo-files */
    int large_corners = 6000;
    uint32_t strokes_most = 8;  /* the ring's settings: 1 to so many strokes */
    uint32_t bricks = PIECE_BRICKS;
    int dense_bricks = 0; /* that the clay begins with, so that a checkpoint takes several slices */
    double fault_rate = 0;
    double kill_rate = 0.4; /* of ends without a cut in mid-call: the program dies, the machine does not */
    bool fills_up = false;
    double lie_rate = 0;
    double probe_rate = 1; /* of instants that are tried */
};

/* Lives one life. What is not as it should be is a test failure, told with the seed. */
void crash_life_run(uint64_t seed, const crash_life_kind &kind);

/* 1, or what GLAISE_CRASHES says. */
uint64_t crash_life_factor();
/* What GLAISE_CRASH_SEED says, or always the same. */
uint64_t crash_life_seed();

#endif
