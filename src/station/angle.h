/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Sine and cosine that give the same bits on every machine and library: the one place between tape and field
 *          that needs them.
 * Is not:  As fast as the C library's (some tens of nanoseconds), nor meant for drawing.
 * Units:   radians.
 * Errors:  None for |angle| <= ANGLE_MAX (asserted); absolute error below 1e-15 (near zero crossings of far angles
 *          1e-12).
 * Source:  ours: Taylor polynomials on [-pi/4, pi/4] after removing quarter turns; only + - * / and floor.
 */
#ifndef GLAISE_STATION_ANGLE_H
#define GLAISE_STATION_ANGLE_H

constexpr double ANGLE_PI = 3.14159265358979323846;
constexpr double ANGLE_MAX = 1e6;

struct angle_pair {
    double sine, cosine;
};

angle_pair angle_sincos(double radians);

#endif
