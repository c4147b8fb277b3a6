/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Compares what a peer saw of a file with the piece that was written.
 * Is not:  The peers (admesh_test, assimp_test, coin_test).
 * Shape:   a peer tells of corners: three a triangle, in the file's order; normals and colours per corner where it has
 *          them.
 * Errors:  disagreement is a failure of the running test.
 */
#ifndef GLAISE_PEERS_PEER_JUDGE_H
#define GLAISE_PEERS_PEER_JUDGE_H

#include "clay_piece.h"

#include <array>
#include <vector>

struct peer_judge_corners {
    std::vector<std::array<double, 3>> at;     /* mm */
    std::vector<std::array<double, 3>> normal; /* empty: the format has none per vertex */
    std::vector<std::array<double, 4>> colour; /* 0..1; empty: the format has none */
    bool has_alpha = false;
};

/* Count, closedness, volume, and every corner's place, normal, colour. Prints what the peer found. */
void peer_judge(const char *peer, const clay_piece &piece, const peer_judge_corners &seen);
/* Joined at equal places, is every edge used once each way? */
bool peer_judge_closed(const peer_judge_corners &seen);

#endif
