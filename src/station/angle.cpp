/* SPDX-License-Identifier: Apache-2.0 */
#include "station/angle.h"

#include <cassert>
#include <cmath>

namespace {

/* pi/2 in two parts, the first with 33 bits: quarter turns up to 2^20 are taken off without rounding. */
constexpr double QUARTER_HIGH = 1.57079632673412561417e+00;
constexpr double QUARTER_LOW = 6.07710050650619224932e-11;

double sine_near(double x)
{
    double x2 = x * x, term = x, sum = 0;
    for (int n = 1; n <= 19; n += 2) {
        sum += term;
        term *= -x2 / ((n + 1) * (n + 2));
    }
    return sum;
}

double cosine_near(double x)
{
    double x2 = x * x, term = 1, sum = 0;
    for (int n = 0; n <= 18; n += 2) {
        sum += term;
        term *= -x2 / ((n + 1) * (n + 2));
    }
    return sum;
}

} // namespace

angle_pair angle_sincos(double radians)
{
    assert(std::fabs(radians) <= ANGLE_MAX);
    double quarters = std::floor(radians / (ANGLE_PI / 2) + 0.5);
    double x = (radians - quarters * QUARTER_HIGH) - quarters * QUARTER_LOW;
    double s = sine_near(x), c = cosine_near(x);
    switch (static_cast<long>(quarters) & 3) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
    }
}
