/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The two pieces every peer is shown: made of clay corner by corner, polygonized by surface/, written by
 *          exchange to a file of the test's own.
 * Is not:  A mesh with known answers (tests/unit/exchange/handmade.h); the answers here are the engine's own, and
 *          the peers have to agree with them.
 * Shape:   a blob (one bumpy ball) and a torus, both across brick borders and on both sides of zero, coloured by place,
 *          opacity included.
 * Units:   clay_piece_step_mm a lattice step.
 * Owner:   the struct owns its mesh.
 */
#ifndef GLAISE_PEERS_CLAY_PIECE_H
#define GLAISE_PEERS_CLAY_PIECE_H

#include "exchange/exchange.h"

#include <string>

constexpr double clay_piece_step_mm = 0.37;

struct clay_piece {
    std::string name;
    mesh surface = {};

    explicit clay_piece(const std::string &kind); /* "blob" or "torus" */
    clay_piece(const clay_piece &) = delete;
    clay_piece &operator=(const clay_piece &) = delete;
    ~clay_piece();

    double volume_mm3() const;
};

/* A file in the tests' temporary folder, gone again with the struct. `left_out`: triangles missing at the end, for
   tests of the judges. */
struct clay_piece_file {
    std::string path;

    clay_piece_file(const clay_piece &piece, const std::string &ending, uint32_t left_out = 0);
    clay_piece_file(const clay_piece_file &) = delete;
    clay_piece_file &operator=(const clay_piece_file &) = delete;
    ~clay_piece_file();
};

#endif
