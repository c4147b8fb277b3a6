/* SPDX-License-Identifier: Apache-2.0 */
#include "handmade.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace {

using point = std::array<double, 3>;

static_assert(sizeof(std::array<uint32_t, 3>) == sizeof(uint32_t[3]));

void add_vertex(handmade &h, const point &p, const point &normal)
{
    mesh_vertex v = {};
    const key at = {static_cast<int32_t>(std::floor(p[0] / 8)), static_cast<int32_t>(std::floor(p[1] / 8)),
                    static_cast<int32_t>(std::floor(p[2] / 8))};
    v.brick = at;
    v.offset[0] = static_cast<float>(p[0] - 8.0 * at.i);
    v.offset[1] = static_cast<float>(p[1] - 8.0 * at.j);
    v.offset[2] = static_cast<float>(p[2] - 8.0 * at.k);
    const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (size_t c = 0; c < 3; c++)
        v.normal[c] = static_cast<float>(normal[c] / length);
    /* Different in every channel and at every vertex, alpha included. */
    const unsigned n = static_cast<unsigned>(h.vertices.size());
    v.rgba = colour_pack((n * 37) & 255, (n * 91 + 5) & 255, 255 - ((n * 53) & 255), 255 - (n & 63));
    h.vertices.push_back(v);
}

/* Positions as stored, so that the answer does not hang on the rounding of offsets. */
double volume_of(handmade &h)
{
    double six = 0;
    for (const auto &t : h.triangles) {
        double p[3][3];
        for (size_t c = 0; c < 3; c++)
            mesh_position(&h.vertices[t[c]], p[c]);
        six += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) + p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
               p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
    }
    return six / 6;
}

} // namespace

mesh handmade::as_mesh()
{
    mesh m = {};
    m.vertices = vertices.data();
    m.triangles = reinterpret_cast<uint32_t(*)[3]>(triangles.data());
    m.vertex_count = static_cast<uint32_t>(vertices.size());
    m.triangle_count = static_cast<uint32_t>(triangles.size());
    return m;
}

handmade handmade_tetrahedron(double side)
{
    handmade h;
    add_vertex(h, {0, 0, 0}, {-1, -1, -1});
    add_vertex(h, {side, 0, 0}, {1, 0, 0});
    add_vertex(h, {0, side, 0}, {0, 1, 0});
    add_vertex(h, {0, 0, side}, {0, 0, 1});
    h.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    h.volume = volume_of(h);
    return h;
}

handmade handmade_ball(const point &middle, double radius, int depth)
{
    std::vector<point> at = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    std::vector<std::array<uint32_t, 3>> faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                  {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int d = 0; d < depth; d++) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        const auto half = [&](uint32_t a, uint32_t b) {
            const auto [place, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(at.size()));
            if (fresh) {
                point p = {at[a][0] + at[b][0], at[a][1] + at[b][1], at[a][2] + at[b][2]};
                const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
                at.push_back({p[0] / length, p[1] / length, p[2] / length});
            }
            return place->second;
        };
        std::vector<std::array<uint32_t, 3>> finer;
        for (const auto &f : faces) {
            const uint32_t a = half(f[0], f[1]), b = half(f[1], f[2]), c = half(f[2], f[0]);
            finer.insert(finer.end(), {{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}});
        }
        faces = finer;
    }
    handmade h;
    for (const point &p : at)
        add_vertex(h, {middle[0] + radius * p[0], middle[1] + radius * p[1], middle[2] + radius * p[2]}, p);
    h.triangles = faces;
    h.volume = volume_of(h);
    return h;
}

handmade handmade_torus(const point &middle, double loop, double tube, int around, int across)
{
    handmade h;
    const double turn = 2 * std::acos(-1.0);
    for (int u = 0; u < around; u++)
        for (int v = 0; v < across; v++) {
            const double a = turn * u / around, b = turn * v / across;
            const point out = {std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)};
            const double x = middle[0] + loop * std::cos(a), y = middle[1] + loop * std::sin(a);
            add_vertex(h, {x + tube * out[0], y + tube * out[1], middle[2] + tube * out[2]}, out);
        }
    for (int u = 0; u < around; u++)
        for (int v = 0; v < across; v++) {
            const auto at = [&](int s, int t) {
                return static_cast<uint32_t>((u + s) % around * across + (v + t) % across);
            };
            h.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
            h.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
        }
    h.volume = volume_of(h);
    return h;
}
