/* SPDX-License-Identifier: Apache-2.0 */
#include "bench_rig.h"

#include "clay/capacity.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

void demand(status s, const char *what) { bench_rig_demand(s == STATUS_OK, std::string(what) + ": " + status_text(s)); }

std::string text_of(key k)
{
    char text[64];
    std::snprintf(text, sizeof text, "(%d, %d, %d)", k.i, k.j, k.k);
    return text;
}

/* A vertex of a patch, as an edge of the lattice. */
key edge_corner(const patch &p, const patch_vertex &v, int *axis_out)
{
    const int32_t slot = static_cast<int32_t>(v.edge / 3);
    *axis_out = static_cast<int>(v.edge % 3);
    return key_add(key_of_brick(p.at), slot / (PATCH_SIDE * PATCH_SIDE), slot / PATCH_SIDE % PATCH_SIDE,
                   slot % PATCH_SIDE);
}

bool is_near(const float a[3], const double b[3], double within)
{
    for (int n = 0; n < 3; n++)
        if (!(std::fabs(static_cast<double>(a[n]) - b[n]) <= within))
            return false;
    return true;
}

} // namespace

void bench_rig_demand(bool good, const std::string &what)
{
    if (good)
        return;
    std::fprintf(stderr, "bench: %s\n", what.c_str());
    std::exit(1);
}

bench_rig::bench_rig(uint32_t bricks, uint32_t corners)
{
    demand(clay_init(&field_clay, bricks), "clay");
    demand(surface_init(&skin, 2 * bricks), "surface");
    demand(tool_scratch_init(&scratch, CAPACITY_DAB_BRICKS), "scratch");
    demand(ellipsoid_init(&ball, ELLIPSOID_WYVILL, 1), "ellipsoid");
    demand(per_corner_init(&paper, corners), "reference");
    reference_corners = corners;
}

bench_rig::~bench_rig()
{
    per_corner_finish(&paper);
    tool_scratch_finish(&scratch);
    surface_finish(&skin);
    clay_finish(&field_clay);
}

tool bench_rig::tool_of(const bench_object_dab &d) const
{
    return {ellipsoid_shape(&ball), d.kind, d.rgba, deform_default()};
}

double bench_rig::clay_bytes() const
{
    return static_cast<double>(pool_bytes(&field_clay.bricks) + pool_bytes(&field_clay.pages.of) +
                               pool_bytes(&field_clay.tree.nodes));
}

double bench_rig::surface_bytes() const
{
    double bytes = static_cast<double>(pool_bytes(&skin.patches) + pool_bytes(&skin.tree.nodes));
    for (uint32_t slot = 0; slot < surface_slots(&skin); slot++)
        if (const patch *p = surface_patch(&skin, slot))
            bytes += static_cast<double>(p->vertex_room * sizeof *p->vertices +
                                         p->triangle_room * sizeof *p->triangles);
    return bytes;
}

std::vector<lanes> bench_rig::choices()
{
    std::vector<lanes> here;
    for (const lanes l : {LANES_AVX2, LANES_AVX512, LANES_PLAIN})
        if (lanes_are_here(l))
            here.push_back(l);
    return here;
}

void bench_rig::use_rows(lanes choice) { field_clay.rows = choice; }

void bench_rig::field(const bench_object_dab &d, tool_counts *counts_out)
{
    const tool t = tool_of(d);
    tool_dab dab = d.dab;
    dab.number = dabs_ours++;
    demand(tool_apply(&t, &dab, &field_clay, &scratch, counts_out), "tool_apply");
}

void bench_rig::surface_of_field(surface_counts *counts_out)
{
    demand(surface_update(&skin, &field_clay, counts_out), "surface_update");
    dirt_clear(&field_clay.dirty);
}

void bench_rig::apply(const bench_object_dab &d)
{
    field(d, nullptr);
    surface_of_field(nullptr);
}

bench_rig_counts bench_rig::ours(const bench_object_dab &d)
{
    bench_rig_counts counts;
    surface_counts s;
    field(d, &counts.tool);
    surface_of_field(&s);
    counts.treated = s.treated;
    counts.skin = s;
    return counts;
}

bench_rig_counts bench_rig::reference(const bench_object_dab &d)
{
    bench_rig_counts counts;
    tool_dab dab = d.dab;
    dab.number = dabs_reference++;
    demand(per_corner_apply(&paper, d.kind, d.rgba, &dab, &counts.tool), "per_corner_apply");
    demand(per_corner_update(&paper, &counts.treated), "per_corner_update");
    return counts;
}

void bench_rig::load_reference()
{
    per_corner_finish(&paper);
    demand(per_corner_init(&paper, reference_corners), "reference");
    avl_walk w;
    key at;
    uint32_t id;
    for (bool more = avl_first(&w, &field_clay.tree, &at, &id); more; more = avl_next(&w, &at, &id)) {
        const brick_page *page = clay_brick(&field_clay, id)->page;
        for (int n = 0; n < BRICK_CORNERS; n++)
            if (page->potential[n] > POTENTIAL_MIN)
                demand(per_corner_write(&paper, key_add(key_of_brick(at), n >> 6, n >> 3 & 7, n & 7),
                                        page->potential[n], page->rgba[n]),
                       "per_corner_write");
    }
    uint64_t treated;
    demand(per_corner_update(&paper, &treated), "per_corner_update");
    dabs_reference = dabs_ours;
}

/* --- comparing --- */

std::string bench_rig::difference_in_corners() const
{
    if (avl_count(&paper.corners) != field_clay.corners)
        return std::to_string(field_clay.corners) + " corners, reference " + std::to_string(avl_count(&paper.corners));
    avl_walk w;
    key at;
    uint32_t id;
    for (bool more = avl_first(&w, &field_clay.tree, &at, &id); more; more = avl_next(&w, &at, &id)) {
        const brick_page *page = clay_brick(&field_clay, id)->page;
        for (int n = 0; n < BRICK_CORNERS; n++) {
            if (!(page->potential[n] > POTENTIAL_MIN))
                continue;
            const key corner = key_add(key_of_brick(at), n >> 6, n >> 3 & 7, n & 7);
            const per_corner_corner *c = per_corner_find(&paper, corner);
            if (!c || std::memcmp(&c->potential, &page->potential[n], sizeof c->potential) != 0 ||
                c->rgba != page->rgba[n])
                return "corner " + text_of(corner) + " differs";
        }
    }
    return "";
}

std::string bench_rig::difference_in_patch(const patch &p, bool normals) const
{
    for (uint32_t n = 0; n < p.vertex_count; n++) {
        const patch_vertex &v = p.vertices[n];
        int axis;
        const key from = edge_corner(p, v, &axis);
        const per_corner_edge *e = per_corner_find_edge(&paper, from, axis);
        const double place[3] = {8.0 * p.at.i + static_cast<double>(v.position[0]),
                                 8.0 * p.at.j + static_cast<double>(v.position[1]),
                                 8.0 * p.at.k + static_cast<double>(v.position[2])};
        const double normal[3] = {v.normal[0], v.normal[1], v.normal[2]};
        if (!e || !is_near(e->position, place, 1e-4) || e->rgba != v.rgba ||
            (normals && !is_near(e->normal, normal, 1e-3)))
            return "the vertex from " + text_of(from) + " along axis " + std::to_string(axis) + " differs";
    }
    return "";
}

uint64_t bench_rig::vertices() const
{
    uint64_t sum = 0;
    for (uint32_t slot = 0; slot < surface_slots(&skin); slot++) {
        const patch *p = surface_patch(&skin, slot);
        for (uint32_t n = 0; p && n < p->vertex_count; n++) {
            const uint32_t corner = p->vertices[n].edge / 3;
            /* An edge whose smaller corner lies in the next brick is in that one's patch as well. */
            sum += corner / (PATCH_SIDE * PATCH_SIDE) < 8 && corner / PATCH_SIDE % PATCH_SIDE < 8 &&
                   corner % PATCH_SIDE < 8;
        }
    }
    return sum;
}

std::string bench_rig::difference(bool normals) const
{
    std::string found = difference_in_corners();
    if (!found.empty())
        return found;
    if (!per_corner_is_valid(&paper))
        return "the reference is not what it should be";
    avl_walk w;
    key at;
    uint32_t id;
    uint64_t triangles = 0;
    for (bool more = avl_first(&w, &paper.crossing, &at, &id); more; more = avl_next(&w, &at, &id))
        triangles += skin.cases.triangles[per_corner_find_cube(&paper, at)->index];
    const uint64_t mine[] = {skin.crossing, skin.triangles, vertices()};
    const uint64_t theirs[] = {avl_count(&paper.crossing), triangles, avl_count(&paper.edges)};
    const char *const names[] = {"crossing cubes", "triangles", "vertices"};
    for (int n = 0; n < 3; n++)
        if (mine[n] != theirs[n])
            return std::to_string(mine[n]) + " " + names[n] + ", reference " + std::to_string(theirs[n]);
    for (uint32_t slot = 0; slot < surface_slots(&skin); slot++) {
        const patch *p = surface_patch(&skin, slot);
        found = p ? difference_in_patch(*p, normals) : "";
        if (!found.empty())
            return found;
    }
    return "";
}
