/* SPDX-License-Identifier: Apache-2.0 */
#include "station/motion.h"

#include "station/angle.h"

#include <cmath>

namespace {

motion_quaternion normalised(motion_quaternion q)
{
    double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double &c : q)
        c /= length;
    return q;
}

motion_vector cross(const motion_vector &a, const motion_vector &b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

motion_vector triple_filtered(const motion_filter &f, double x, double y, double z)
{
    double length = std::sqrt(x * x + y * y + z * z);
    if (!(length > f.dead_zone))
        return {0, 0, 0};
    double clamped = length < 1 ? length : 1;
    double past = (clamped - f.dead_zone) / (1 - f.dead_zone);
    double out = past * (1 - f.curve) + past * past * past * f.curve;
    return {x / length * out, y / length * out, z / length * out};
}

} // namespace

motion_quaternion motion_about(const motion_vector &axis, double radians)
{
    double length = motion_length(axis);
    angle_pair half = angle_sincos(radians / 2);
    return {half.cosine, half.sine * axis[0] / length, half.sine * axis[1] / length, half.sine * axis[2] / length};
}

motion_quaternion motion_product(const motion_quaternion &a, const motion_quaternion &b)
{
    return {
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

motion_vector motion_rotate(const motion_quaternion &q, const motion_vector &v)
{
    motion_vector u{q[1], q[2], q[3]}, t = cross(u, v);
    for (double &c : t)
        c *= 2;
    motion_vector ut = cross(u, t);
    return {v[0] + q[0] * t[0] + ut[0], v[1] + q[0] * t[1] + ut[1], v[2] + q[0] * t[2] + ut[2]};
}

motion_vector motion_rotate_back(const motion_quaternion &q, const motion_vector &v)
{
    return motion_rotate({q[0], -q[1], -q[2], -q[3]}, v);
}

motion_vector motion_sum(const motion_vector &a, const motion_vector &b, double b_times)
{
    return {a[0] + b[0] * b_times, a[1] + b[1] * b_times, a[2] + b[2] * b_times};
}

double motion_length(const motion_vector &v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

motion_quaternion motion_turned(const motion_quaternion &q, const motion_vector &radians)
{
    motion_quaternion half{1, radians[0] / 2, radians[1] / 2, radians[2] / 2};
    return normalised(motion_product(half, q));
}

motion_pose motion_between(const motion_pose &a, const motion_pose &b, double part)
{
    motion_pose out;
    double dot = 0;
    for (int n = 0; n < 4; n++)
        dot += a.turn[n] * b.turn[n];
    double sign = dot < 0 ? -1 : 1;
    for (int n = 0; n < 4; n++)
        out.turn[n] = a.turn[n] * (1 - part) + sign * b.turn[n] * part;
    out.turn = normalised(out.turn);
    for (int n = 0; n < 3; n++)
        out.place[n] = a.place[n] + (b.place[n] - a.place[n]) * part;
    return out;
}

double motion_turn_distance(const motion_quaternion &a, const motion_quaternion &b, double radius)
{
    double same = 0, opposite = 0;
    for (int n = 0; n < 4; n++) {
        same += (a[n] - b[n]) * (a[n] - b[n]);
        opposite += (a[n] + b[n]) * (a[n] + b[n]);
    }
    /* Half angles: the distance of the quaternions is half that of the points they turn. */
    return 2 * radius * std::sqrt(same < opposite ? same : opposite);
}

motion_speed motion_filtered(const motion_filter &f, const std::array<int16_t, 6> &counts_hid)
{
    double v[6];
    for (int n = 0; n < 6; n++)
        v[n] = static_cast<double>(counts_hid[n]) / MOTION_COUNTS_FULL;
    return {triple_filtered(f, v[0], -v[2], v[1]), triple_filtered(f, v[3], -v[5], v[4])};
}
