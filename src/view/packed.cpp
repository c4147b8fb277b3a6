/* SPDX-License-Identifier: Apache-2.0 */
#include "view/packed.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <compare>
#include <cstddef>

namespace {

constexpr float place_per_step = 4096;

int16_t packed_signed(float x) { return static_cast<int16_t>(std::lround(std::clamp(x, -1.0f, 1.0f) * 32767.0f)); }

void pack_normal(const float n[3], int16_t out[2])
{
    const float sum = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
    if (!(sum > 0)) {
        out[0] = out[1] = 0;
        return;
    }
    float x = n[0] / sum, y = n[1] / sum;
    if (n[2] < 0) {
        const float folded = (1 - std::abs(y)) * (x >= 0 ? 1.0f : -1.0f);
        y = (1 - std::abs(x)) * (y >= 0 ? 1.0f : -1.0f);
        x = folded;
    }
    out[0] = packed_signed(x);
    out[1] = packed_signed(y);
}

void pack_vertices(packed *to, const patch &p, int first)
{
    to->vertices.resize(p.vertex_count);
    for (uint32_t n = 0; n < p.vertex_count; n++) {
        const patch_vertex &from = p.vertices[n];
        packed_vertex &v = to->vertices[n];
        for (int c = 0; c < 3; c++)
            v.place[c] = static_cast<uint16_t>(
                std::lround(std::clamp(from.position[c], 0.0f, float{BRICK_EDGE}) * place_per_step));
        v.unit = static_cast<uint16_t>(first);
        pack_normal(from.normal, v.normal);
        v.rgba = from.rgba;
    }
}

void pack_triangles(packed *to, const patch &p, int units, size_t base)
{
    to->triangles.assign(static_cast<size_t>(units) * 3 * PACKED_UNIT_TRIANGLES, static_cast<uint16_t>(base));
    for (size_t t = 0; t < p.triangle_count; t++)
        for (size_t c = 0; c < 3; c++)
            to->triangles[3 * t + c] = static_cast<uint16_t>(base + p.triangles[t][c]);
}

/* Where a vertex lies on the whole lattice: the same number in every patch that has it, so that of a side's two
   directions all patches choose the same one to draw. */
struct edge_name {
    int64_t i, j, k;
    int axis;
    auto operator<=>(const edge_name &) const = default;
};

edge_name name_of(const patch &p, uint16_t vertex)
{
    const uint32_t edge = p.vertices[vertex].edge;
    const int64_t corner = edge / 3;
    return {p.at.i * int64_t{BRICK_EDGE} + corner / (PATCH_SIDE * PATCH_SIDE),
            p.at.j * int64_t{BRICK_EDGE} + corner / PATCH_SIDE % PATCH_SIDE,
            p.at.k * int64_t{BRICK_EDGE} + corner % PATCH_SIDE, static_cast<int>(edge % 3)};
}

/* A closed surface has each side once in either direction; the rising one is drawn. */
void pack_lines(packed *to, const patch &p, int units, size_t base)
{
    to->lines.clear();
    for (size_t t = 0; t < p.triangle_count; t++) {
        for (size_t c = 0; c < 3; c++) {
            const uint16_t from = p.triangles[t][c], into = p.triangles[t][(c + 1) % 3];
            if (name_of(p, from) < name_of(p, into)) {
                to->lines.push_back(static_cast<uint16_t>(base + from));
                to->lines.push_back(static_cast<uint16_t>(base + into));
            }
        }
    }
    assert(to->lines.size() <= static_cast<size_t>(units) * 2 * PACKED_UNIT_LINES);
    to->lines.resize(static_cast<size_t>(units) * 2 * PACKED_UNIT_LINES, static_cast<uint16_t>(base));
}

/* Rising sides, as pack_lines counts them: between one and two a triangle. */
size_t line_count(const patch &p)
{
    size_t count = 0;
    for (size_t t = 0; t < p.triangle_count; t++)
        for (size_t c = 0; c < 3; c++)
            count += name_of(p, p.triangles[t][c]) < name_of(p, p.triangles[t][(c + 1) % 3]);
    return count;
}

size_t parts(size_t n, size_t each) { return (n + each - 1) / each; }

} // namespace

int packed_units(const patch &p, bool with_lines)
{
    size_t units =
        std::max(parts(p.vertex_count, PACKED_UNIT_VERTICES), parts(p.triangle_count, PACKED_UNIT_TRIANGLES));
    if (with_lines)
        units = std::max(units, parts(line_count(p), PACKED_UNIT_LINES));
    return static_cast<int>(units);
}

void packed_make(packed *to, const patch &p, int first, int units, bool with_lines)
{
    const size_t base = static_cast<size_t>(first) * PACKED_UNIT_VERTICES;
    pack_vertices(to, p, first);
    pack_triangles(to, p, units, base);
    to->lines.clear();
    if (with_lines)
        pack_lines(to, p, units, base);
}
