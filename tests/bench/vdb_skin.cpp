/* SPDX-License-Identifier: Apache-2.0 */
#include "vdb_skin.h"

#include "clay/colour.h"
#include "clay/potential.h"

#include <openvdb/tools/VolumeToMesh.h>

#include <algorithm>
#include <cmath>
#include <cstring>

using openvdb::Coord;

namespace {

/* 64 steps a root entry, one level between root and leaves: a few kilobytes a tree instead of megabytes. */
using small_tree = openvdb::tree::Tree<
    openvdb::tree::RootNode<openvdb::tree::InternalNode<openvdb::tree::LeafNode<float, 3>, 3>>>;
using small_grid = openvdb::Grid<small_tree>;
using small_mask_tree = small_tree::ValueConverter<bool>::Type;
using small_mask_grid = openvdb::Grid<small_mask_tree>;

/* The same with leaves of 16^3, for copies. */
using wide_tree = openvdb::tree::Tree<
    openvdb::tree::RootNode<openvdb::tree::InternalNode<openvdb::tree::LeafNode<float, 4>, 2>>>;
using wide_grid = openvdb::Grid<wide_tree>;
constexpr int wide_side = 16;

bool before(const Coord &a, const Coord &b) { return a < b; }

/* Sorted, each once. */
std::vector<Coord> with_ring(const std::vector<Coord> &leaves)
{
    std::vector<Coord> all;
    all.reserve(leaves.size() * 27);
    for (const Coord &c : leaves)
        for (int n = 0; n < 27; n++)
            all.push_back(c.offsetBy(8 * (n / 9 - 1), 8 * (n / 3 % 3 - 1), 8 * (n % 3 - 1)));
    std::sort(all.begin(), all.end(), before);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

/* The cells whose points a quad of these leaves can use: theirs, and one layer below. */
small_mask_grid::Ptr mask_of(const std::vector<Coord> &leaves)
{
    small_mask_grid::Ptr mask = small_mask_grid::create(false);
    small_mask_grid::Accessor at = mask->getAccessor();
    for (const Coord &c : leaves)
        for (int n = 0; n < 8; n++) {
            const int below[3] = {n >> 2 & 1, n >> 1 & 1, n & 1};
            const Coord from = c.offsetBy(-8 * below[0], -8 * below[1], -8 * below[2]);
            small_mask_tree::LeafNodeType *leaf = at.touchLeaf(from);
            if (n == 0) {
                leaf->setValuesOn();
                continue;
            }
            for (int i = below[0] ? 7 : 0; i < 8; i++)
                for (int j = below[1] ? 7 : 0; j < 8; j++)
                    for (int k = below[2] ? 7 : 0; k < 8; k++)
                        leaf->setValueOn(static_cast<openvdb::Index>(i * 64 + j * 8 + k));
        }
    return mask;
}

int floored(float x) { return static_cast<int>(std::floor(x)); }

/* What the points of one leaf need: potentials from one corner below it to two beyond, colours from its first corner to
   one beyond. */
class surroundings {
public:
    static constexpr int side = 11, corners = side * side * side;

    explicit surroundings(const vdb_skin_field &f)
        : potentials(*static_cast<const vdb_skin_tree *>(f.potential)), colours(*f.rgba)
    {
    }

    void move_to(const Coord &leaf)
    {
        if (known && leaf == origin)
            return;
        known = true;
        origin = leaf;
        for (int n = 0; n < 27; n++) {
            const int d[3] = {n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1};
            const Coord at = leaf.offsetBy(8 * d[0], 8 * d[1], 8 * d[2]);
            const vdb_skin_leaf *p = potentials.probeConstLeaf(at);
            const bool sees_colour = d[0] >= 0 && d[1] >= 0 && d[2] >= 0;
            const vdb_skin_colours::LeafNodeType *c = p && sees_colour ? colours.probeConstLeaf(at) : nullptr;
            fill(d, p ? p->buffer().data() : nullptr, c ? c->buffer().data() : nullptr);
        }
    }

    float potential[corners];
    int32_t rgba[corners];
    Coord origin;

private:
    /* The part of leaf d's buffers that lies in the block; block place = corner + 1. */
    template <int first, int run> void fill_rows(const int d[3], const float *from, const int32_t *from_rgba)
    {
        static const float no_clay[8] = {};
        static const int32_t no_colour[8] = {};
        for (int i = d[0] < 0 ? 7 : 0; i <= (d[0] > 0 ? 1 : 7); i++)
            for (int j = d[1] < 0 ? 7 : 0; j <= (d[1] > 0 ? 1 : 7); j++) {
                const int to = ((i + 8 * d[0] + 1) * side + j + 8 * d[1] + 1) * side + first + 8 * d[2] + 1;
                const int at = i * 64 + j * 8 + first;
                std::memcpy(potential + to, from ? from + at : no_clay, run * sizeof *from);
                std::memcpy(rgba + to, from_rgba ? from_rgba + at : no_colour, run * sizeof *from_rgba);
            }
    }

    void fill(const int d[3], const float *from, const int32_t *from_rgba)
    {
        if (d[2] < 0)
            fill_rows<7, 1>(d, from, from_rgba);
        else if (d[2] == 0)
            fill_rows<0, 8>(d, from, from_rgba);
        else
            fill_rows<0, 2>(d, from, from_rgba);
    }

    openvdb::tree::ValueAccessor<const vdb_skin_tree> potentials;
    openvdb::tree::ValueAccessor<const vdb_skin_colours> colours;
    bool known = false;
};

/* Normal and colour at a point of the cell whose first corner is at `place` of the block; t: where in the cell. */
uint32_t dress_point(const surroundings &s, int place, const float t[3], openvdb::Vec3s *normal_out)
{
    constexpr int step[3] = {surroundings::side * surroundings::side, surroundings::side, 1};
    float g[3] = {0, 0, 0}, channel[4] = {0, 0, 0, 0}, clay_weight = 0;
    for (int n = 0; n < 8; n++) {
        const int corner[3] = {n >> 2, n >> 1 & 1, n & 1};
        float w = 1;
        int at = place;
        for (int a = 0; a < 3; a++) {
            w *= corner[a] ? t[a] : 1 - t[a];
            at += corner[a] ? step[a] : 0;
        }
        for (int a = 0; a < 3; a++)
            g[a] += w * (s.potential[at + step[a]] - s.potential[at - step[a]]);
        const float by = s.potential[at] > POTENTIAL_MIN ? w : 0;
        clay_weight += by;
        for (int c = 0; c < 4; c++)
            channel[c] += by * static_cast<float>(static_cast<uint32_t>(s.rgba[at]) >> (8 * c) & 255);
    }
    const float length = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    const float scale = length > 1e-12f ? -1 / length : 0;
    *normal_out = openvdb::Vec3s(g[0] * scale, g[1] * scale, g[2] * scale);
    uint32_t rgba = 0;
    for (int c = 0; c < 4; c++)
        rgba |= static_cast<uint32_t>(channel[c] / (clay_weight > 0 ? clay_weight : 1) + 0.5f) << (8 * c);
    return rgba;
}

} // namespace

template <class mesher> void vdb_skin::take(const mesher &m, const Coord &offset)
{
    const openvdb::Vec3s by(static_cast<float>(offset.x()), static_cast<float>(offset.y()),
                            static_cast<float>(offset.z()));
    point.resize(m.pointListSize());
    for (size_t n = 0; n < point.size(); n++)
        point[n] = m.pointList()[n] + by;
    size_t quads = 0;
    for (size_t p = 0; p < m.polygonPoolListSize(); p++)
        quads += m.polygonPoolList()[p].numQuads();
    triangle.resize(quads * 6);
    uint32_t *to = triangle.data();
    for (size_t p = 0; p < m.polygonPoolListSize(); p++) {
        const openvdb::tools::PolygonPool &polygons = m.polygonPoolList()[p];
        for (size_t n = 0; n < polygons.numQuads(); n++) {
            const openvdb::Vec4I &q = polygons.quad(n);
            for (const int v : {0, 1, 2, 0, 2, 3})
                *to++ = q[v];
        }
    }
}

/* Quads outside the leaves that were asked for go, then the points nobody uses. */
void vdb_skin::keep_leaves(const vdb_region &r)
{
    std::vector<uint32_t> name(point.size(), UINT32_MAX), kept;
    std::vector<openvdb::Vec3s> used;
    Coord last = Coord::max();
    bool wanted = false;
    kept.reserve(triangle.size());
    used.reserve(point.size());
    for (size_t n = 0; n < triangle.size(); n += 6) {
        /* The edge lies between the four cells: its smaller corner is the largest of their first corners. */
        Coord edge = Coord::min();
        for (const int v : {0, 1, 2, 5}) {
            const openvdb::Vec3s &p = point[triangle[n + static_cast<size_t>(v)]];
            edge.maxComponent(Coord(floored(p[0]), floored(p[1]), floored(p[2])));
        }
        const Coord leaf = edge & ~7;
        if (leaf != last) {
            last = leaf;
            wanted = std::binary_search(r.leaves.begin(), r.leaves.end(), leaf, before);
        }
        if (!wanted)
            continue;
        for (size_t v = 0; v < 6; v++) {
            uint32_t &id = name[triangle[n + v]];
            if (id == UINT32_MAX) {
                id = static_cast<uint32_t>(used.size());
                used.push_back(point[triangle[n + v]]);
            }
            kept.push_back(id);
        }
    }
    point.swap(used);
    triangle.swap(kept);
}

void vdb_skin::borrowed(const vdb_skin_field &f, const vdb_region &r, bool masked)
{
    struct lent {
        vdb_skin_leaf *leaf;
        vdb_skin_leaf::NodeMaskType active;
    };
    small_grid::Ptr grid = small_grid::create(0.0f);
    openvdb::tree::ValueAccessor<vdb_skin_tree> source(*f.potential);
    std::vector<lent> all;
    for (const Coord &c : with_ring(r.leaves))
        if (vdb_skin_leaf *leaf = source.probeLeaf(c)) {
            grid->tree().addLeaf(leaf);
            all.push_back({leaf, leaf->getValueMask()});
            if (!masked && std::binary_search(r.leaves.begin(), r.leaves.end(), c, before))
                leaf->setValuesOn();
            else if (!masked)
                leaf->setValuesOff();
        }
    {
        openvdb::tools::VolumeToMesh mesh(POTENTIAL_ISO, 0, false);
        if (masked)
            mesh.setSurfaceMask(mask_of(r.leaves));
        mesh(*grid);
        take(mesh, Coord(0));
    }
    for (const lent &l : all) {
        grid->tree().stealNode<vdb_skin_leaf>(l.leaf->origin(), 0.0f, false);
        l.leaf->setValueMask(l.active);
    }
    if (!masked)
        keep_leaves(r);
}

namespace {

/* Eight corners of a row into the leaf of the copy that holds them; those from..to of them become active. */
void copy_row(wide_tree::LeafNodeType *to, const Coord &at, const float *from, int first_active, int last_active)
{
    const openvdb::Index offset = wide_tree::LeafNodeType::coordToOffset(at);
    std::memcpy(to->buffer().data() + offset, from, 8 * sizeof *from);
    for (int n = std::max(first_active, 0); n <= std::min(last_active, 7); n++)
        to->setValueOn(offset + static_cast<openvdb::Index>(n));
}

} // namespace

/* The corners that a cell round a changed gradient can see; the new leaves begin there (along k, at a row of eight). */
void vdb_skin::copied(const vdb_skin_field &f, const vdb_region &r)
{
    if (r.leaves.empty()) {
        point.clear();
        triangle.clear();
        return;
    }
    Coord lo = r.corners.min().offsetBy(-3);
    const Coord hi = r.corners.max().offsetBy(3);
    const openvdb::CoordBBox active(r.corners.min().offsetBy(-1), r.corners.max().offsetBy(1));
    lo.z() &= ~7;
    wide_grid::Ptr grid = wide_grid::create(0.0f);
    openvdb::tree::ValueAccessor<const vdb_skin_tree> source(*static_cast<const vdb_skin_tree *>(f.potential));
    wide_grid::Accessor target = grid->getAccessor();
    for (int i = lo.x() & ~7; i <= hi.x(); i += 8)
        for (int j = lo.y() & ~7; j <= hi.y(); j += 8)
            for (int k = lo.z(); k <= hi.z(); k += 8) {
                const vdb_skin_leaf *leaf = source.probeConstLeaf(Coord(i, j, k));
                for (int x = std::max(i, lo.x()); leaf && x <= std::min(i + 7, hi.x()); x++)
                    for (int y = std::max(j, lo.y()); y <= std::min(j + 7, hi.y()); y++) {
                        const Coord to = Coord(x, y, k) - lo;
                        const bool in = x >= active.min().x() && x <= active.max().x() && y >= active.min().y() &&
                                        y <= active.max().y();
                        copy_row(target.touchLeaf(to), to, leaf->buffer().data() + (x & 7) * 64 + (y & 7) * 8,
                                 in ? active.min().z() - k : 8, active.max().z() - k);
                    }
            }
    openvdb::tools::VolumeToMesh mesh(POTENTIAL_ISO, 0, false);
    mesh(*grid);
    take(mesh, lo);
}

void vdb_skin::dress(const vdb_skin_field &f)
{
    surroundings near(f);
    normal.resize(point.size());
    rgba.resize(point.size());
    for (size_t n = 0; n < point.size(); n++) {
        const Coord cell(floored(point[n][0]), floored(point[n][1]), floored(point[n][2]));
        near.move_to(cell & ~7);
        const Coord in = cell - near.origin;
        float t[3];
        for (int a = 0; a < 3; a++)
            t[a] = point[n][a] - static_cast<float>(cell[a]);
        const int place = ((in.x() + 1) * surroundings::side + in.y() + 1) * surroundings::side + in.z() + 1;
        rgba[n] = dress_point(near, place, t, &normal[n]);
    }
}

void vdb_skin::of_region(const vdb_skin_field &f, const vdb_region &r, vdb_peer_way way)
{
    if (way == VDB_PEER_COPIED)
        copied(f, r);
    else
        borrowed(f, r, way == VDB_PEER_MASKED);
    dress(f);
}

void vdb_skin::of_whole(const openvdb::FloatGrid &grid, const vdb_skin_field &f)
{
    openvdb::tools::VolumeToMesh mesh(POTENTIAL_ISO, 0, false);
    mesh(grid);
    take(mesh, Coord(0));
    dress(f);
}
