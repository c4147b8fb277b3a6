/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Says what the surface of a piece of clay must be, corner by corner out of clay_read and in doubles, and what
 *          an update must count; the judge of the surface room's tests.
 * Is not:  Fast, nor built from anything in src/surface but the case table.
 * Shape:   everything by key, in ordered containers; no bricks except to say which patch a cube is in.
 */
#ifndef GLAISE_PROPERTY_MESH_ORACLE_H
#define GLAISE_PROPERTY_MESH_ORACLE_H

#include "clay/colour.h"
#include "surface/surface.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

struct mesh_oracle_less {
    bool operator()(const key &a, const key &b) const { return key_compare(a, b) < 0; }
};

inline key mesh_oracle_step(key c, int axis, int by)
{
    return key_add(c, axis == 0 ? by : 0, axis == 1 ? by : 0, axis == 2 ? by : 0);
}

/* Ascending, each once. */
inline std::vector<key> mesh_oracle_sorted(std::vector<key> all)
{
    std::sort(all.begin(), all.end(), mesh_oracle_less{});
    all.erase(std::unique(all.begin(), all.end(), key_equal), all.end());
    return all;
}

/* The cubes that share one of these corners, by smallest corner, ascending. */
inline std::vector<key> mesh_oracle_cubes(const std::vector<key> &corners)
{
    std::vector<key> all;
    for (const key &c : corners)
        for (int n = 0; n < 8; n++)
            all.push_back(key_add(c, -(n & 1), -(n >> 1 & 1), -(n >> 2)));
    return mesh_oracle_sorted(all);
}

/* The corners and their six neighbours, ascending. */
inline std::vector<key> mesh_oracle_with_six(const std::vector<key> &corners)
{
    std::vector<key> all = corners;
    for (const key &c : corners)
        for (int axis = 0; axis < 3; axis++) {
            all.push_back(mesh_oracle_step(c, axis, -1));
            all.push_back(mesh_oracle_step(c, axis, 1));
        }
    return mesh_oracle_sorted(all);
}

/* Bit c = dx + 2 dy + 4 dz. */
inline int mesh_oracle_index(const clay *c, key cube)
{
    int index = 0;
    for (int n = 0; n < 8; n++)
        index |= (clay_read(c, key_add(cube, n & 1, n >> 1 & 1, n >> 2), nullptr) >= POTENTIAL_ISO) << n;
    return index;
}

inline std::vector<key> mesh_oracle_stored(const clay *c)
{
    std::vector<key> all;
    avl_walk w;
    key at;
    uint32_t id;
    for (bool more = avl_first(&w, &c->tree, &at, &id); more; more = avl_next(&w, &at, &id))
        for (int n = 0; n < BRICK_CORNERS; n++)
            if (clay_brick(c, id)->page->potential[n] > POTENTIAL_MIN)
                all.push_back(key_add(key_of_brick(at), n >> 6, n >> 3 & 7, n & 7));
    return all;
}

inline double mesh_oracle_difference(const clay *c, key at, int axis)
{
    const double after = clay_read(c, mesh_oracle_step(at, axis, 1), nullptr);
    return after - clay_read(c, mesh_oracle_step(at, axis, -1), nullptr);
}

/* What is wrong with one vertex, or nothing. */
inline std::string mesh_oracle_vertex(const clay *c, const patch &p, const patch_vertex &v)
{
    const int axis = v.edge % 3, slot = v.edge / 3, d[3] = {slot / 81, slot / 9 % 9, slot % 9};
    const key low = key_add(key_of_brick(p.at), d[0], d[1], d[2]), high = mesh_oracle_step(low, axis, 1);
    uint32_t rgba_low, rgba_high;
    const double f_low = clay_read(c, low, &rgba_low), f_high = clay_read(c, high, &rgba_high);
    const bool upwards = f_low >= 1.5;
    if (upwards == (f_high >= 1.5))
        return "edge is not cut";
    const double f_in = upwards ? f_low : f_high, f_out = upwards ? f_high : f_low, t = (f_in - 1.5) / (f_in - f_out);
    const double kept = std::clamp(t, 1e-3, 1 - 1e-3);
    for (int n = 0; n < 3; n++)
        if (std::fabs(v.position[n] - (d[n] + (n == axis ? (upwards ? kept : 1 - kept) : 0))) > 2e-6)
            return "position";
    const key in = upwards ? low : high, out = upwards ? high : low;
    double g[3], length = 0, off = 0, size = 0;
    for (int n = 0; n < 3; n++) {
        g[n] = (1 - t) * mesh_oracle_difference(c, in, n) + t * mesh_oracle_difference(c, out, n);
        length += g[n] * g[n];
    }
    length = std::sqrt(length);
    for (int n = 0; n < 3; n++) {
        const double expected = length < 1e-6 ? (n == axis ? (upwards ? 1 : -1) : 0) : -g[n] / length;
        off = std::max(off, std::fabs(v.normal[n] - expected));
        size += double(v.normal[n]) * v.normal[n];
    }
    if (std::fabs(size - 1) > 1e-5)
        return "normal's length";
    /* Rounding of the differences, seen through a short gradient; no claim just at the threshold. */
    if (off > 1e-5 + 1e-5 / std::max(length, 1e-6) && std::fabs(length - 1e-6) > 5e-7)
        return "normal";
    for (int n = 0; n < 4; n++) {
        const double a = colour_channel(upwards ? rgba_low : rgba_high, n);
        const double b = colour_channel(upwards ? rgba_high : rgba_low, n);
        const double expected = f_out > 0 ? a + (b - a) * t : a;
        if (std::fabs(colour_channel(v.rgba, n) - expected) > 0.5 + 1e-3)
            return "colour";
    }
    return "";
}

/* What is wrong with one patch, or nothing: its crossing cubes (ascending), vertices, triangles. */
inline std::string mesh_oracle_patch(const clay *c, const case_table &cases, const patch &p,
                                     const std::vector<key> &crossing)
{
    brick_mask mask{};
    std::set<uint32_t> edges;
    std::vector<uint32_t> corners; /* edges of all triangles' corners, in order */
    for (const key &cube : crossing) {
        brick_mask_set(&mask, key_slot(cube));
        const int index = mesh_oracle_index(c, cube);
        for (int n = 0; n < 3 * cases.triangles[index]; n++) {
            int from, to;
            case_table_edge(cases.edge[index][n], &from, &to);
            const int i = (cube.i & 7) + (from & 1), j = (cube.j & 7) + (from >> 1 & 1), k = (cube.k & 7) + (from >> 2);
            corners.push_back(static_cast<uint32_t>(((i * 9 + j) * 9 + k) * 3 + cases.edge[index][n] / 4));
            edges.insert(corners.back());
        }
    }
    if (std::memcmp(&mask, &p.crossing, sizeof mask) != 0)
        return "crossing cubes";
    if (edges.size() != p.vertex_count || corners.size() != 3 * size_t{p.triangle_count})
        return "counts";
    uint32_t v = 0;
    for (const uint32_t e : edges) {
        const patch_vertex &vertex = p.vertices[v++];
        const std::string what = vertex.edge == e ? mesh_oracle_vertex(c, p, vertex) : "order of vertices";
        if (!what.empty())
            return what;
    }
    for (size_t n = 0; n < corners.size(); n++)
        if (p.vertices[p.triangles[n / 3][n % 3]].edge != corners[n])
            return "triangles";
    return "";
}

/* What is wrong with the surface, or nothing. */
inline std::string mesh_oracle_judge(const clay *c, const surface *s)
{
    std::map<key, std::vector<key>, mesh_oracle_less> crossing; /* by brick */
    for (const key &cube : mesh_oracle_cubes(mesh_oracle_stored(c))) {
        const int index = mesh_oracle_index(c, cube);
        if (index != 0 && index != 255)
            crossing[key_brick(cube)].push_back(cube);
    }
    case_table cases;
    case_table_init(&cases);
    std::ostringstream wrong;
    if (crossing.size() != s->patches.count)
        wrong << s->patches.count << " patches, expected " << crossing.size();
    for (const auto &one : crossing) {
        const patch *p = surface_find(s, one.first);
        const std::string what = p ? mesh_oracle_patch(c, cases, *p, one.second) : "missing";
        if (!what.empty()) {
            wrong << what << " in patch " << one.first.i << "," << one.first.j << "," << one.first.k;
            break;
        }
    }
    return wrong.str();
}

#endif
