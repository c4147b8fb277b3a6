/* SPDX-License-Identifier: Apache-2.0 */
#include "vdb_region.h"

#include "clay/potential.h"

#include <algorithm>
#include <bit>
#include <cstring>

using openvdb::Coord;

namespace {

using leaf_node = vdb_region_tree::LeafNodeType;
using reader = openvdb::tree::ValueAccessor<const vdb_region_tree>;

Coord first_of(key leaf) { return Coord(leaf.i * 8, leaf.j * 8, leaf.k * 8); }

/* Bit k of row (i, j): that corner is inside. Rows 0..8, corners 0..8. */
void inside_rows(reader &field, key leaf, uint16_t rows_out[9][9])
{
    std::memset(rows_out, 0, 9 * sizeof rows_out[0]);
    for (int n = 0; n < 8; n++) {
        const int d[3] = {n >> 2, n >> 1 & 1, n & 1};
        const leaf_node *from = field.probeConstLeaf(first_of(key_add(leaf, d[0], d[1], d[2])));
        if (!from)
            continue;
        const float *p = from->buffer().data();
        for (int i = 0; i < (d[0] ? 1 : 8); i++) {
            const uint64_t slab = vdb_dab_at_least(p + i * 64, POTENTIAL_ISO);
            for (int j = 0; j < (d[1] ? 1 : 8); j++) {
                const unsigned bits = static_cast<unsigned>(slab >> (8 * j) & 255);
                uint16_t &row = rows_out[i + 8 * d[0]][j + 8 * d[1]];
                row = static_cast<uint16_t>(row | (d[2] ? (bits & 1) << 8 : bits));
            }
        }
    }
}

bool crossing_rows(const uint16_t rows[9][9], uint8_t crossing_out[8][8])
{
    unsigned found = 0;
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < 8; j++) {
            unsigned any = rows[i][j] | rows[i][j + 1] | rows[i + 1][j] | rows[i + 1][j + 1];
            unsigned all = rows[i][j] & rows[i][j + 1] & rows[i + 1][j] & rows[i + 1][j + 1];
            any |= any >> 1;
            all &= all >> 1;
            crossing_out[i][j] = static_cast<uint8_t>(any & ~all);
            found |= crossing_out[i][j];
        }
    return found != 0;
}

} // namespace

vdb_region::mark &vdb_region::at(key leaf)
{
    return marks[static_cast<size_t>(((leaf.i - range.min.i) * side[1] + leaf.j - range.min.j) * side[2] + leaf.k -
                                     range.min.k)];
}

void vdb_region::begin(box all)
{
    /* One ring for what the change reaches, one more so that nobody looks beyond. */
    range = {key_add(all.min, -2, -2, -2), key_add(all.max, 2, 2, 2)};
    side[0] = range.max.i - range.min.i + 1;
    side[1] = range.max.j - range.min.j + 1;
    side[2] = range.max.k - range.min.k + 1;
    marks.assign(static_cast<size_t>(side[0]) * static_cast<size_t>(side[1]) * static_cast<size_t>(side[2]), mark{});
    corners.reset();
    leaves.clear();
}

void vdb_region::add(key leaf, const vdb_dab_change &c)
{
    if (c.corners == 0)
        return;
    mark &m = at(leaf);
    std::memcpy(m.slab, c.slab, sizeof m.slab);
    m.changed = true;
    int lo[3] = {8, 0, 0}, hi[3] = {-1, 0, 0};
    uint64_t flat = 0;
    for (int i = 0; i < 8; i++) {
        flat |= c.slab[i];
        if (c.slab[i]) {
            lo[0] = std::min(lo[0], i);
            hi[0] = i;
        }
    }
    unsigned column = 0;
    for (int j = 0; j < 8; j++)
        column |= static_cast<unsigned>(flat >> (8 * j) & 255);
    lo[1] = std::countr_zero(flat) / 8;
    hi[1] = 7 - std::countl_zero(flat) / 8;
    lo[2] = std::countr_zero(column);
    hi[2] = 31 - std::countl_zero(column);
    const Coord first = first_of(leaf);
    corners.expand(openvdb::CoordBBox(first.offsetBy(lo[0], lo[1], lo[2]), first.offsetBy(hi[0], hi[1], hi[2])));
    /* Cubes from two below a changed corner to one beyond it can see it. */
    for (int i = lo[0] < 2 ? -1 : 0; i <= (hi[0] > 6 ? 1 : 0); i++)
        for (int j = lo[1] < 2 ? -1 : 0; j <= (hi[1] > 6 ? 1 : 0); j++)
            for (int k = lo[2] < 2 ? -1 : 0; k <= (hi[2] > 6 ? 1 : 0); k++)
                at(key_add(leaf, i, j, k)).candidate = true;
}

/* Bit k + 1 of row (i + 1, j + 1): that corner changed. From one below the leaf to two beyond. */
void vdb_region::changed_rows(key leaf, uint16_t rows_out[11][11])
{
    std::memset(rows_out, 0, 11 * sizeof rows_out[0]);
    for (int n = 0; n < 27; n++) {
        const int d[3] = {n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1};
        const mark &m = at(key_add(leaf, d[0], d[1], d[2]));
        if (!m.changed)
            continue;
        for (int i = d[0] < 0 ? 7 : 0; i < (d[0] > 0 ? 2 : 8); i++)
            for (int j = d[1] < 0 ? 7 : 0; j < (d[1] > 0 ? 2 : 8); j++) {
                const unsigned bits = static_cast<unsigned>(m.slab[i] >> (8 * j) & 255);
                const unsigned placed = d[2] < 0 ? bits >> 7 : d[2] > 0 ? (bits & 3) << 9 : bits << 1;
                uint16_t &row = rows_out[i + 8 * d[0] + 1][j + 8 * d[1] + 1];
                row = static_cast<uint16_t>(row | placed);
            }
    }
}

bool vdb_region::is_stale(key leaf, const uint8_t crossing[8][8])
{
    uint16_t changed[11][11];
    unsigned star[9][9];
    changed_rows(leaf, changed);
    for (int i = 0; i < 9; i++)
        for (int j = 0; j < 9; j++) {
            const unsigned c = changed[i + 1][j + 1];
            star[i][j] = (c | c << 1 | c >> 1 | changed[i][j + 1] | changed[i + 2][j + 1] | changed[i + 1][j] |
                          changed[i + 1][j + 2]) >>
                         1;
        }
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < 8; j++) {
            unsigned cubes = star[i][j] | star[i][j + 1] | star[i + 1][j] | star[i + 1][j + 1];
            cubes |= cubes >> 1;
            if (cubes & crossing[i][j])
                return true;
        }
    return false;
}

void vdb_region::end(const vdb_region_tree &field)
{
    reader read(field);
    key leaf;
    for (leaf.i = range.min.i + 1; leaf.i < range.max.i; leaf.i++)
        for (leaf.j = range.min.j + 1; leaf.j < range.max.j; leaf.j++)
            for (leaf.k = range.min.k + 1; leaf.k < range.max.k; leaf.k++) {
                uint16_t rows[9][9];
                uint8_t crossing[8][8];
                if (!at(leaf).candidate)
                    continue;
                inside_rows(read, leaf, rows);
                if (crossing_rows(rows, crossing) && is_stale(leaf, crossing))
                    leaves.push_back(first_of(leaf));
            }
}
