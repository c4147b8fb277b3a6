/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A dab as the definitions have it: every corner of the box transformed by itself, the tool evaluated in
 *          doubles, the action's formula applied to a sorted map. What tool_apply must equal.
 * Is not:  Fast; bit-exact: floats and additions in tool_apply differ from this by so much, and `slack` says how much.
 *          Where that could decide between two outcomes (at the very border of a tool) either is right.
 * Shape:   plain_dab_corner: what one corner becomes, or may become.
 */
#ifndef GLAISE_PROPERTY_PLAIN_DAB_H
#define GLAISE_PROPERTY_PLAIN_DAB_H

#include "tool/ellipsoid.h"
#include "tool/tool.h"

#include "tests/property/plain_clay.h"

#include <algorithm>
#include <cmath>
#include <vector>

enum plain_dab_form { PLAIN_DAB_WYVILL, PLAIN_DAB_BOX, PLAIN_DAB_FREEFORM };

/* A tool's shape, told in the words of its definition. */
struct plain_dab_shape {
    plain_dab_form form;
    double border;                   /* box-shaped */
    key lowest;                      /* freeform: first corner of the dense copy, and its sides */
    int side[3];
    std::vector<float> dense;
    double lo[3], hi[3];
};

inline plain_dab_shape plain_dab_ellipsoid(bool is_box, double border)
{
    plain_dab_shape s = {};
    s.form = is_box ? PLAIN_DAB_BOX : PLAIN_DAB_WYVILL;
    s.border = border;
    for (int a = 0; a < 3; a++) {
        s.lo[a] = -1;
        s.hi[a] = 1;
    }
    return s;
}

inline plain_dab_shape plain_dab_freeform(const plain_clay &source)
{
    plain_dab_shape s = {};
    box b = box_empty();
    for (const auto &[at, corner] : source)
        b = box_include(b, plain_clay_untuple(at));
    s.form = PLAIN_DAB_FREEFORM;
    s.lowest = key_add(b.min, -1, -1, -1);
    const int size[3] = {b.max.i - b.min.i, b.max.j - b.min.j, b.max.k - b.min.k};
    for (int a = 0; a < 3; a++) {
        s.side[a] = size[a] + 3;
        s.hi[a] = size[a] / 2.0 + 1;
        s.lo[a] = -s.hi[a];
    }
    s.dense.assign(static_cast<size_t>(s.side[0] * s.side[1] * s.side[2]), 0.0f);
    for (const auto &[at, corner] : source) {
        const key k = plain_clay_untuple(at);
        const int i = k.i - s.lowest.i, j = k.j - s.lowest.j, l = k.k - s.lowest.k;
        s.dense[static_cast<size_t>((i * s.side[1] + j) * s.side[2] + l)] = corner.potential;
    }
    return s;
}

inline double plain_dab_tri_linear(const plain_dab_shape &s, const double p[3])
{
    /* The middle of the stored box is the tool's origin: corner 0 of the dense copy lies at lo. */
    int whole[3];
    double part[3], sum = 0;
    for (int a = 0; a < 3; a++) {
        const double x = p[a] - s.lo[a];
        if (!(x > 0 && x < s.side[a] - 1))
            return 0;
        whole[a] = static_cast<int>(x);
        part[a] = x - whole[a];
    }
    for (int c = 0; c < 8; c++) {
        const int d[3] = {c & 1, c >> 1 & 1, c >> 2};
        double w = 1;
        for (int a = 0; a < 3; a++)
            w *= d[a] ? part[a] : 1 - part[a];
        sum += w * s.dense[static_cast<size_t>(((whole[0] + d[0]) * s.side[1] + whole[1] + d[1]) * s.side[2] +
                                               whole[2] + d[2])];
    }
    return sum;
}

inline double plain_dab_potential(const plain_dab_shape &s, const double p[3])
{
    if (s.form == PLAIN_DAB_FREEFORM)
        return plain_dab_tri_linear(s, p);
    const double q = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    if (q >= 1)
        return 0;
    if (s.form == PLAIN_DAB_WYVILL)
        return 3 * (1 - 22.0 / 9 * q + 17.0 / 9 * q * q - 4.0 / 9 * q * q * q);
    const double t = std::min(1.0, (1 - std::sqrt(q)) / s.border);
    return 3 * (3 * t * t - 2 * t * t * t);
}

/* How far the potential can move when each coordinate moves by at most `by`. */
inline double plain_dab_slack(const plain_dab_shape &s, const double by[3])
{
    const double move = by[0] + by[1] + by[2];
    switch (s.form) {
    case PLAIN_DAB_WYVILL: return 3 * 1.63 * move + 2e-6;
    case PLAIN_DAB_BOX: return 4.5 * (move + 3e-7) / s.border + 2e-6;
    default: return 3 * move + 4e-6;
    }
}

/* The corrected deformation function (facts: k = -kappa). */
inline double plain_dab_def(const deform &d, double v)
{
    const double s = d.s, m = d.m, r = d.r, n = d.n, kappa = d.kappa;
    if (v <= 0)
        return -1;
    if (v <= s)
        return (s * kappa - 2) * std::pow(v / s, 3) + (3 - s * kappa) * std::pow(v / s, 2) - 1;
    double u = (v - s) / m;
    if (u <= 1)
        return (kappa * m - 2 * n) * u * u * u + (3 * n - 2 * kappa * m) * u * u + kappa * m * u;
    u = (v - s - m) / r;
    return u <= 1 ? n * (2 * u * u * u - 3 * u * u + 1) : 0;
}

inline double plain_dab_def_slope_max(const deform &d)
{
    double most = 0;
    for (int n = 0; n < 3000; n++)
        most = std::max(most, std::fabs(plain_dab_def(d, (n + 1) / 1000.0) - plain_dab_def(d, n / 1000.0)) * 1000);
    return 1.2 * most;
}

/* What one corner becomes when the tool's potential there is v. */
struct plain_dab_corner {
    double potential; /* before clamping and removing */
    double channel[4];
    double slack;        /* of the potential */
    double channel_slack; /* of each channel */
    bool dithered;        /* channels round by the corner's threshold, else to nearest */
};

inline void plain_dab_exact_colour(plain_dab_corner &out, uint32_t rgba)
{
    for (int n = 0; n < 4; n++)
        out.channel[n] = colour_channel(rgba, n);
}

inline void plain_dab_mix(plain_dab_corner &out, uint32_t from, uint32_t to, double weight, double weight_slack)
{
    for (int n = 0; n < 4; n++) {
        const double a = colour_channel(from, n), b = colour_channel(to, n);
        out.channel[n] = a + weight * (b - a);
    }
    out.dithered = true;
    out.channel_slack = 255 * weight_slack + 1e-3;
}

/* Weighted mean over the 27 corners round `at`: of the potential, and of the colours by potential. */
struct plain_dab_round {
    double mean, weight, channel[4];
};

inline plain_dab_round plain_dab_look_round(const plain_clay &p, key at)
{
    plain_dab_round r = {};
    for (int n = 0; n < 27; n++) {
        const int i = n / 9 - 1, j = n / 3 % 3 - 1, k = n % 3 - 1;
        const plain_clay_corner c = plain_clay_read(p, key_add(at, i, j, k));
        const double w = (2 - std::abs(i)) * (2 - std::abs(j)) * (2 - std::abs(k)) / 64.0 * c.potential;
        r.mean += w;
        for (int a = 0; a < 4; a++)
            r.channel[a] += w * colour_channel(c.rgba, a);
    }
    r.weight = r.mean;
    for (double &c : r.channel)
        c = r.weight > 0 ? c / r.weight : 0;
    return r;
}

inline void plain_dab_new_clay(plain_dab_corner &out, const plain_dab_round &round, uint32_t tool_rgba)
{
    if (round.weight > 0)
        std::copy(round.channel, round.channel + 4, out.channel);
    else
        plain_dab_exact_colour(out, tool_rgba);
}

/* before: the whole clay as it was. dv: slack of v. */
inline plain_dab_corner plain_dab_act(const tool &t, double amount, const plain_clay &before, key at, double v,
                                      double dv)
{
    const plain_clay_corner old = plain_clay_read(before, at);
    const double room = t.kind == ACTION_TOOTHPASTE ? 3 - static_cast<double>(old.potential) : 1e9;
    const double f = old.potential, d = std::min(amount * v / 3, room), dd = amount * dv / 3 + 1e-6 * d, part = std::min(amount, 1.0);
    plain_dab_corner out = {f, {}, 1e-6, 1e-3, false};
    plain_dab_exact_colour(out, old.rgba);
    const double mix = f > 0 ? d / (f + d) : 1, mix_slack = f > 0 ? dd / (f + std::max(0.0, d - dd)) + 1e-6 : 0;
    switch (t.kind) {
    case ACTION_TOOTHPASTE:
        out.potential = f + d;
        out.slack = dd + 1e-6;
        plain_dab_mix(out, f > 0 ? old.rgba : t.rgba, t.rgba, mix, mix_slack);
        break;
    case ACTION_SOFT_ERASER:
        out.potential = f - d;
        out.slack = dd + 1e-6;
        break;
    case ACTION_ERASER: out.potential = 0; break;
    case ACTION_PAINTER: plain_dab_exact_colour(out, t.rgba); break;
    case ACTION_SOFT_PAINTER:
        if (f > 0)
            plain_dab_mix(out, old.rgba, t.rgba, mix, mix_slack);
        break;
    case ACTION_SMOOTH: {
        const plain_dab_round round = plain_dab_look_round(before, at);
        out.potential = f + part * v / 3 * (round.mean - f);
        out.slack = part * dv + 3e-6;
        if (out.potential <= static_cast<double>(POTENTIAL_FAINT) - out.slack)
            out.potential = out.slack = 0;
        else if (out.potential <= static_cast<double>(POTENTIAL_FAINT) + out.slack)
            out.slack += out.potential;
        if (!(f > 0))
            plain_dab_new_clay(out, round, t.rgba);
        break;
    }
    case ACTION_STAMP:
    case ACTION_PRINT: {
        const double def = plain_dab_def(t.def, 3 - v), by = t.kind == ACTION_PRINT ? f : 1;
        out.potential = f + part * def * by;
        const double rounding = 4e-6 * (1 + t.def.n) / std::min(t.def.m, t.def.r);
        out.slack = part * by * (plain_dab_def_slope_max(t.def) * dv + rounding) + 2e-6;
        if (!(f > 0))
            plain_dab_new_clay(out, plain_dab_look_round(before, at), t.rgba);
        break;
    }
    }
    return out;
}

/* Is that what the corner became? */
inline bool plain_dab_is(const plain_dab_corner &wanted, plain_clay_corner found, float threshold)
{
    const double clamped = std::clamp(wanted.potential, 0.0, 3.0);
    if (!(std::fabs(found.potential - clamped) <= wanted.slack))
        return false;
    if (!(found.potential > 0))
        return found.rgba == COLOUR_NONE;
    if (wanted.potential <= wanted.slack && found.rgba == COLOUR_NONE)
        return false;
    for (int n = 0; n < 4; n++) {
        const double c = colour_channel(found.rgba, n);
        const double shift = wanted.dithered ? threshold : 0.5;
        const double low = std::floor(wanted.channel[n] - wanted.channel_slack + shift);
        const double high = std::floor(wanted.channel[n] + wanted.channel_slack + shift);
        if (c < low || c > high)
            return false;
    }
    return true;
}

#endif
