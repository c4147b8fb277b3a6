/* SPDX-License-Identifier: Apache-2.0 */
#include "vdb_peer.h"

#include "bench_rig.h"
#include "clay/colour.h"
#include "vdb_dab.h"
#include "vdb_skin.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <limits>

using openvdb::Coord;

namespace {

using colour_leaf = vdb_skin_colours::LeafNodeType;

Coord first_of(key leaf) { return Coord(leaf.i * 8, leaf.j * 8, leaf.k * 8); }

/* Packed colours live in a grid of Int32, which OpenVDB has compiled already; the bits are ours. */
uint32_t *bits(int32_t *p) { return reinterpret_cast<uint32_t *>(p); }

/* Active voxels are the stored corners. */
template <class leaf> void activate(const float *potential, leaf *to)
{
    openvdb::util::NodeMask<3> mask;
    for (openvdb::Index i = 0; i < 8; i++)
        mask.getWord<uint64_t>(i) = vdb_dab_at_least(potential + i * 64, std::numeric_limits<float>::denorm_min());
    to->setValueMask(mask);
}

/* A leaf of the dab under way. */
struct work {
    key at;
    vdb_skin_leaf *potential; /* null: not stored */
    colour_leaf *rgba;
    vdb_dab_change change;
};

/* What smoothing needs besides: it writes nothing before it has read everything. */
struct page {
    float v_tool[vdb_dab_corners], made[vdb_dab_corners];
    uint32_t made_rgba[vdb_dab_corners];
};

class peer final : public vdb_peer {
public:
    peer() : one_thread(tbb::global_control::max_allowed_parallelism, 1)
    {
        openvdb::initialize();
        loaded = openvdb::FloatGrid::create(0.0f);
        loaded_rgba = vdb_skin_colours::Ptr(new vdb_skin_colours(0));
        restore();
    }

    void load(const clay &from) override;
    void restore() override
    {
        grid = loaded->deepCopy();
        rgba = vdb_skin_colours::Ptr(new vdb_skin_colours(*loaded_rgba));
    }
    void field(const bench_object_dab &d, uint64_t number) override;
    void surface(vdb_peer_way way) override
    {
        skin.of_region({&grid->tree(), rgba.get()}, region, way);
        count_skin();
    }
    void whole() override
    {
        skin.of_whole(*grid, {&grid->tree(), rgba.get()});
        count_skin();
    }
    const vdb_peer_counts &counts() const override { return count; }
    uint64_t corners() const override { return grid->tree().activeVoxelCount(); }
    uint64_t bytes() const override { return grid->tree().memUsage() + rgba->memUsage(); }
    std::string difference(const clay &from) const override;

private:
    using accessor = openvdb::tree::ValueAccessor<vdb_skin_tree>;
    using colour_accessor = openvdb::tree::ValueAccessor<vdb_skin_colours>;

    void count_skin()
    {
        count.leaves = region.leaves.size();
        count.points = skin.points();
        count.triangles = skin.triangles();
    }
    void gather(const vdb_dab &d, accessor &at, colour_accessor &at_rgba);
    void act(const vdb_dab &d, const float *v_tool, work &w, accessor &at, colour_accessor &at_rgba);
    void smooth(const vdb_dab &d, page &p, work &w, accessor &at, colour_accessor &at_rgba);
    void write_smooth(const page &p, work &w, accessor &at, colour_accessor &at_rgba);
    void settle(const vdb_dab &d, accessor &at, colour_accessor &at_rgba);

    tbb::global_control one_thread;
    openvdb::FloatGrid::Ptr loaded, grid;
    vdb_skin_colours::Ptr loaded_rgba, rgba;
    std::vector<work> works;
    std::vector<page> pages; /* as works; only where a dab smooths */
    size_t used = 0;
    vdb_region region;
    vdb_skin skin;
    vdb_peer_counts count;
    vdb_dab_apron apron;
};

void peer::load(const clay &from)
{
    loaded = openvdb::FloatGrid::create(0.0f);
    loaded_rgba = vdb_skin_colours::Ptr(new vdb_skin_colours(0));
    accessor at(loaded->tree());
    colour_accessor at_rgba(*loaded_rgba);
    avl_walk w;
    key brick_at;
    uint32_t id;
    for (bool more = avl_first(&w, &from.tree, &brick_at, &id); more; more = avl_next(&w, &brick_at, &id)) {
        const brick_page *page = clay_brick(&from, id)->page;
        vdb_skin_leaf *p = at.touchLeaf(first_of(brick_at));
        colour_leaf *c = at_rgba.touchLeaf(first_of(brick_at));
        std::memcpy(p->buffer().data(), page->potential, sizeof page->potential);
        std::memcpy(c->buffer().data(), page->rgba, sizeof page->rgba);
        activate(page->potential, p);
        activate(page->potential, c);
    }
    restore();
}

/* Every leaf the tool contributes to; toothpaste and soft eraser act at once, while the contribution is at hand. */
void peer::gather(const vdb_dab &d, accessor &at, colour_accessor &at_rgba)
{
    const bool smooths = d.kind == ACTION_SMOOTH;
    const box leaves = box_of_bricks(d.corners);
    float v_here[vdb_dab_corners];
    used = 0;
    for (int i = leaves.min.i; i <= leaves.max.i; i++)
        for (int j = leaves.min.j; j <= leaves.max.j; j++)
            for (int k = leaves.min.k; k <= leaves.max.k; k++) {
                const key leaf = {i, j, k};
                if (!vdb_dab_touches(d, leaf))
                    continue;
                if (used == works.size())
                    works.resize(2 * used + 64);
                if (smooths && pages.size() < works.size())
                    pages.resize(works.size());
                float *v_tool = smooths ? pages[used].v_tool : v_here;
                const int hit = vdb_dab_evaluate(d, leaf, v_tool);
                if (hit == 0)
                    continue;
                count.dirtied += static_cast<uint64_t>(hit);
                work &w = works[used++];
                w = {leaf, at.probeLeaf(first_of(leaf)), nullptr, {}};
                w.rgba = w.potential ? at_rgba.probeLeaf(first_of(leaf)) : nullptr;
                if (!smooths)
                    act(d, v_tool, w, at, at_rgba);
            }
}

void peer::act(const vdb_dab &d, const float *v_tool, work &w, accessor &at, colour_accessor &at_rgba)
{
    if (!w.potential) {
        if (d.kind != ACTION_TOOTHPASTE)
            return;
        w.potential = at.touchLeaf(first_of(w.at));
        w.rgba = at_rgba.touchLeaf(first_of(w.at));
    }
    w.change = vdb_dab_act(d, w.at, v_tool, w.potential->buffer().data(), bits(w.rgba->buffer().data()));
}

/* Part of leaf `from` that lies in the apron of a leaf; d: where from lies, seen from that leaf. */
template <int first, int run, class value> void to_apron_rows(const int d[3], const value *from, value *apron)
{
    static const value none[8] = {};
    for (int i = d[0] < 0 ? 7 : 0; i <= (d[0] > 0 ? 0 : 7); i++)
        for (int j = d[1] < 0 ? 7 : 0; j <= (d[1] > 0 ? 0 : 7); j++)
            std::memcpy(apron + ((i + 8 * d[0] + 1) * 10 + j + 8 * d[1] + 1) * 10 + first + 8 * d[2] + 1,
                        from ? from + i * 64 + j * 8 + first : none, run * sizeof(value));
}

template <class value> void to_apron(const int d[3], const value *from, value *apron)
{
    if (d[2] < 0)
        to_apron_rows<7, 1>(d, from, apron);
    else if (d[2] == 0)
        to_apron_rows<0, 8>(d, from, apron);
    else
        to_apron_rows<0, 1>(d, from, apron);
}

void peer::smooth(const vdb_dab &d, page &p, work &w, accessor &at, colour_accessor &at_rgba)
{
    bool any = false;
    for (int pass = 0; pass < 2; pass++) {
        for (int n = 0; n < 27; n++) {
            const int to[3] = {n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1};
            const Coord first = first_of(w.at).offsetBy(8 * to[0], 8 * to[1], 8 * to[2]);
            if (pass == 0) {
                const vdb_skin_leaf *leaf = at.probeConstLeaf(first);
                any |= leaf != nullptr;
                to_apron(to, leaf ? leaf->buffer().data() : nullptr, apron.potential);
            } else {
                const colour_leaf *c = at_rgba.probeConstLeaf(first);
                to_apron(to, c ? reinterpret_cast<const uint32_t *>(c->buffer().data()) : nullptr, apron.rgba);
            }
        }
        if (!any)
            return;
        if (w.potential) {
            std::memcpy(p.made, w.potential->buffer().data(), sizeof p.made);
            std::memcpy(p.made_rgba, w.rgba->buffer().data(), sizeof p.made_rgba);
        } else {
            std::memset(p.made, 0, sizeof p.made);
            std::memset(p.made_rgba, 0, sizeof p.made_rgba);
        }
        if (!vdb_dab_smooth(d, p.v_tool, apron, pass == 1, p.made, p.made_rgba, &w.change))
            return;
    }
}

void peer::write_smooth(const page &p, work &w, accessor &at, colour_accessor &at_rgba)
{
    if (w.change.corners == 0)
        return;
    if (!w.potential) {
        w.potential = at.touchLeaf(first_of(w.at));
        w.rgba = at_rgba.touchLeaf(first_of(w.at));
    }
    std::memcpy(w.potential->buffer().data(), p.made, sizeof p.made);
    std::memcpy(w.rgba->buffer().data(), p.made_rgba, sizeof p.made_rgba);
}

/* Active voxels, leaves that became empty, and the region whose surface is to be renewed. */
void peer::settle(const vdb_dab &d, accessor &at, colour_accessor &at_rgba)
{
    region.begin(box_of_bricks(d.corners));
    for (size_t n = 0; n < used; n++) {
        work &w = works[n];
        if (!w.potential)
            continue;
        if (w.change.corners) {
            count.changed += static_cast<uint64_t>(w.change.corners);
            activate(w.potential->buffer().data(), w.potential);
            w.rgba->setValueMask(w.potential->getValueMask());
            region.add(w.at, w.change);
        }
        if (w.potential->isEmpty()) {
            at.addTile(1, first_of(w.at), 0.0f, false);
            at_rgba.addTile(1, first_of(w.at), 0, false);
        }
    }
    region.end(grid->tree());
}

void peer::field(const bench_object_dab &of, uint64_t number)
{
    bench_rig_demand(of.kind == ACTION_TOOTHPASTE || of.kind == ACTION_SOFT_ERASER || of.kind == ACTION_SMOOTH,
                     "OpenVDB was not taught this action");
    count = {};
    const vdb_dab d = vdb_dab_of(of, number);
    accessor at(grid->tree());
    colour_accessor at_rgba(*rgba);
    gather(d, at, at_rgba);
    if (d.kind == ACTION_SMOOTH) {
        for (size_t n = 0; n < used; n++)
            smooth(d, pages[n], works[n], at, at_rgba);
        for (size_t n = 0; n < used; n++)
            write_smooth(pages[n], works[n], at, at_rgba);
    }
    settle(d, at, at_rgba);
}

std::string peer::difference(const clay &from) const
{
    if (corners() != from.corners)
        return std::to_string(corners()) + " corners instead of " + std::to_string(from.corners);
    openvdb::tree::ValueAccessor<const vdb_skin_tree> at(*static_cast<const vdb_skin_tree *>(&grid->tree()));
    openvdb::tree::ValueAccessor<const vdb_skin_colours> at_rgba(*static_cast<const vdb_skin_colours *>(rgba.get()));
    avl_walk w;
    key brick_at;
    uint32_t id;
    for (bool more = avl_first(&w, &from.tree, &brick_at, &id); more; more = avl_next(&w, &brick_at, &id)) {
        const brick_page *page = clay_brick(&from, id)->page;
        const vdb_skin_leaf *p = at.probeConstLeaf(first_of(brick_at));
        const colour_leaf *c = at_rgba.probeConstLeaf(first_of(brick_at));
        if (!p || !c || std::memcmp(p->buffer().data(), page->potential, sizeof page->potential) != 0 ||
            std::memcmp(c->buffer().data(), page->rgba, sizeof page->rgba) != 0)
            return "leaf (" + std::to_string(brick_at.i) + ", " + std::to_string(brick_at.j) + ", " +
                   std::to_string(brick_at.k) + ") differs";
    }
    return "";
}

} // namespace

std::unique_ptr<vdb_peer> vdb_peer_open() { return std::make_unique<peer>(); }
std::string vdb_peer_version() { return OPENVDB_LIBRARY_VERSION_STRING; }
