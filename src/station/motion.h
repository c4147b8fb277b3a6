/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    How things move: poses, turning and shifting them, the puck's filter from counts to speed, and glides that
 *          carry a pose along a line or round an axis. Pure arithmetic with + - * / sqrt.
 * Is not:  Who moves what (station.h); the decoding of reports (platform/spacemouse).
 * Shape:   quaternions are w, x, y, z, unit. The HID frame (x right, y towards the user, z down) becomes the view's (x
 *          right, y up, z towards the viewer) by one matrix: (x, -z, y), for shifts and turns alike; object sense: the
 *          thing moved follows the hand.
 * Units:   millimetres, radians, seconds.
 * Source:  000 section 2 (Spacemouse moves scene, tool or light).
 */
#ifndef GLAISE_STATION_MOTION_H
#define GLAISE_STATION_MOTION_H

#include <array>
#include <cstdint>

using motion_vector = std::array<double, 3>;
using motion_quaternion = std::array<double, 4>;

struct motion_pose {
    motion_vector place{};
    motion_quaternion turn{1, 0, 0, 0};
};

/* About an axis of any length (not zero). */
motion_quaternion motion_about(const motion_vector &axis, double radians);
motion_quaternion motion_product(const motion_quaternion &a, const motion_quaternion &b); /* b first, then a */
motion_vector motion_rotate(const motion_quaternion &q, const motion_vector &v);
motion_vector motion_rotate_back(const motion_quaternion &q, const motion_vector &v);
motion_vector motion_sum(const motion_vector &a, const motion_vector &b, double b_times = 1);
double motion_length(const motion_vector &v);
/* q after turning by a small rotation vector, normalised: one step of integration. */
motion_quaternion motion_turned(const motion_quaternion &q, const motion_vector &radians);
/* Part of the way from a to b; turns by the shorter way, normalised. */
motion_pose motion_between(const motion_pose &a, const motion_pose &b, double part);
/* Length of the chord the farthest point at `radius` draws between two turns. */
double motion_turn_distance(const motion_quaternion &a, const motion_quaternion &b, double radius);

struct motion_filter {
    double dead_zone = 0.04; /* part of full deflection */
    double curve = 0.5;      /* 0 linear .. 1 cubic */
};

constexpr int MOTION_COUNTS_FULL = 350; /* a puck's logical maximum */

/* Counts to speeds in -1..1, in the view's frame: shift then turn. The dead zone is radial over each triple and soft
   (it starts again from zero); beyond full deflection is full deflection. */
struct motion_speed {
    motion_vector shift{}, turn{};
};
motion_speed motion_filtered(const motion_filter &f, const std::array<int16_t, 6> &counts_hid);

#endif
