/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the master test. Whatever is done to the clay, the surface brought up to date equals the surface made from
 *       nothing, bit for bit; it stays closed; its counts are the true ones; a viewer that follows generations misses
 *       nothing and uploads nothing twice.
 * Method: seeded random edits, straight through the clay's bricks: balls added, taken away and erased, noise, ties at
 *         iso, colours, at brick borders, at negative keys and at both ends of the lattice. After each one update
 *         against one rebuild, and counts against sets counted one by one. GLAISE_LONG in the environment: twenty times
 *         the steps. */
#include "surface/mesh.h"
#include "tests/property/mesh_oracle.h"
#include "tests/unit/surface/sample_clay.h"

#include <cstdlib>
#include <functional>
#include <random>

namespace {

constexpr int steps_short = 500, long_factor = 20, steps_between_meshes = 20, steps_between_judgements = 70;

/* The standard's generator is the same everywhere, its distributions are not. */
struct dice {
    std::mt19937 engine;
    int32_t below(int32_t n) { return static_cast<int32_t>(engine() % static_cast<uint32_t>(n)); }
    double unit() { return static_cast<uint32_t>(engine()) / 4294967296.0; }
};

struct seen_patch {
    uint64_t generation;
    std::vector<patch_vertex> vertices;
    std::vector<uint16_t> triangles;
    brick_mask crossing;
};
using seen_patches = std::map<key, seen_patch, mesh_oracle_less>;

seen_patches look_at(const surface *s)
{
    seen_patches all;
    for (uint32_t slot = 0; slot < surface_slots(s); slot++)
        if (const patch *p = surface_patch(s, slot)) {
            const auto *corners = reinterpret_cast<const uint16_t *>(p->triangles);
            all[p->at] = {p->generation,
                          {p->vertices, p->vertices + p->vertex_count},
                          {corners, corners + 3 * size_t{p->triangle_count}},
                          p->crossing};
        }
    return all;
}

bool same_content(const seen_patch &a, const seen_patch &b)
{
    return a.triangles == b.triangles && a.vertices.size() == b.vertices.size() &&
           std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof a.vertices[0]) == 0;
}

/* One edit at a place; answers the corners it dirtied. */
std::vector<key> edit_somewhere(clay *c, dice *d, key place)
{
    static const float tied[] = {0, 1, std::nextafter(1.5f, 0.0f), 1.5f, 1.5f, std::nextafter(1.5f, 2.0f),
                                 2, 3, 1e-30f};
    const int di = d->below(9) - 4, dj = d->below(9) - 4, dk = d->below(9) - 4;
    const key centre = key_add(place, di, dj, dk);
    const double x = d->unit() - 0.5, y = d->unit() - 0.5, z = d->unit() - 0.5;
    const int kind = d->below(9), sparse = 1 + d->below(5);
    const int reach = kind == 7 ? 0 : 1 + d->below(d->below(8) ? 5 : 10);
    const float flat = tied[d->below(9)];
    const uint32_t colour = static_cast<uint32_t>(d->engine());
    return sample_clay_edit(c, sample_clay_box(centre, reach), [&](key at, float &v, uint32_t &rgba) {
        const double far = sample_clay_distance(at, centre, x, y, z) / (reach + 0.5), fall = 1 - far * far;
        if (fall <= 0 && kind != 7)
            return false;
        const float weight = static_cast<float>(fall > 0 ? fall * fall : 0);
        switch (kind) {
        case 0:
        case 1: /* material added */
            v += 2 * weight;
            rgba = colour;
            return true;
        case 2: /* softly taken away */
            v -= weight;
            return true;
        case 3: /* erased */
            v = 0;
            return true;
        case 4: /* one value, often a tie */
            v = flat;
            rgba = colour;
            return true;
        case 5: /* noise on some corners */
            if (d->below(sparse))
                return false;
            v = tied[d->below(9)];
            rgba = static_cast<uint32_t>(d->engine());
            return true;
        case 6: /* colour only */
            rgba = colour;
            return v > 0;
        case 7: /* a single corner */
            v = flat;
            rgba = colour;
            return true;
        default: /* dirtied, not changed */
            return true;
        }
    });
}

using corner_test = std::function<bool(key)>;

/* Do any of the patch's vertices lie on an edge with such a corner? */
bool has_vertex_at(const seen_patch &p, key at, const corner_test &is_one)
{
    for (const patch_vertex &v : p.vertices) {
        const int32_t slot = static_cast<int32_t>(v.edge / 3), axis = static_cast<int32_t>(v.edge % 3);
        const key low = key_add(key_of_brick(at), slot / 81, slot / 9 % 9, slot % 9);
        if (is_one(low) || is_one(key_add(low, axis == 0, axis == 1, axis == 2)))
            return true;
    }
    return false;
}

/* Patches with such a vertex, before or after, that are still there. */
uint32_t patches_at(const seen_patches &before, const seen_patches &after, const corner_test &is_one)
{
    uint32_t count = 0;
    for (const auto &[at, now] : after) {
        const auto old = before.find(at);
        count += has_vertex_at(now, at, is_one) || (old != before.end() && has_vertex_at(old->second, at, is_one));
    }
    return count;
}

/* Those with an aged vertex are remade; beside them at most those whose edges end in bricks that are not stored. */
void expect_remade(uint32_t remade, const std::vector<key> &dirtied, const clay *c, const seen_patches &before,
                   const seen_patches &after)
{
    std::set<key, mesh_oracle_less> aged;
    for (const key &corner : mesh_oracle_with_six(dirtied))
        aged.insert(corner);
    ASSERT_GE(remade, patches_at(before, after, [&](key corner) { return aged.count(corner) != 0; }));
    ASSERT_LE(remade, patches_at(before, after, [&](key corner) {
                  return aged.count(corner) != 0 || clay_find(c, key_brick(corner)) == POOL_NONE;
              }));
}

void expect_generations(const seen_patches &before, const seen_patches &after, uint64_t latest)
{
    std::set<uint64_t> fresh;
    for (const auto &[at, p] : after) {
        const auto old = before.find(at);
        if (old != before.end() && same_content(old->second, p)) {
            ASSERT_EQ(p.generation, old->second.generation);
        } else {
            ASSERT_GT(p.generation, latest);
            ASSERT_TRUE(fresh.insert(p.generation).second);
        }
    }
}

void expect_closed(const surface *s)
{
    mesh m;
    ASSERT_EQ(mesh_init(&m, s), STATUS_OK);
    const bool closed = mesh_is_closed(&m);
    const double volume = mesh_volume(&m);
    const uint32_t triangles = m.triangle_count;
    mesh_finish(&m);
    ASSERT_TRUE(closed);
    ASSERT_EQ(volume > 0, triangles > 0);
}

void one_step(sample_clay *s, surface *again, dice *d, key place, int step)
{
    const seen_patches before = look_at(&s->skin);
    const uint64_t latest = s->skin.generation;
    std::vector<key> dirtied = edit_somewhere(&s->field, d, place);
    while (d->below(4) == 0) { /* several edits before one look */
        const auto more = edit_somewhere(&s->field, d, place);
        dirtied.insert(dirtied.end(), more.begin(), more.end());
    }
    const surface_counts n = sample_clay_update(s);
    ASSERT_EQ(surface_rebuild(again, &s->field, nullptr), STATUS_OK);
    ASSERT_TRUE(sample_clay_same(&s->skin, again));
    ASSERT_TRUE(avl_is_valid(&s->skin.tree));
    ASSERT_EQ(n.treated, mesh_oracle_cubes(dirtied).size());
    const seen_patches after = look_at(&s->skin);
    ASSERT_EQ(after.size(), s->skin.patches.count);
    ASSERT_NO_FATAL_FAILURE(expect_remade(n.patches, dirtied, &s->field, before, after));
    expect_generations(before, after, latest);
    if (step % steps_between_meshes == 0)
        expect_closed(&s->skin);
    if (step % steps_between_judgements == 0) {
        ASSERT_EQ(mesh_oracle_judge(&s->field, &s->skin), "");
    }
}

class surface_walk : public testing::TestWithParam<uint32_t> {};

TEST_P(surface_walk, an_updated_surface_is_the_surface_from_nothing)
{
    dice d{std::mt19937(GetParam())};
    sample_clay s;
    surface again{};
    ASSERT_EQ(surface_init(&again, s.skin.patches.limit), STATUS_OK);
    const key places[] = {{0, 0, 0}, {8, -16, 4}, {-77, 3, -800}, {KEY_MAX - 3, KEY_MIN + 3, 20}, {-1, 12, 1000000}};
    const int steps = steps_short * (std::getenv("GLAISE_LONG") ? long_factor : 1);
    for (int step = 0; step < steps && !testing::Test::HasFatalFailure(); step++) {
        SCOPED_TRACE("step " + std::to_string(step));
        one_step(&s, &again, &d, places[d.below(5)], step);
    }
    surface_finish(&again);
}

INSTANTIATE_TEST_SUITE_P(seeds, surface_walk, testing::Values(1u, 2u, 3u, 4u, 5u));

/* Running out in the middle of an update, the clay put back, brought up to date: as if nothing had been tried. */
TEST(surface_limit, a_refused_update_can_be_taken_back)
{
    dice d{std::mt19937(99)};
    sample_clay s(4096, 40);
    surface again{};
    ASSERT_EQ(surface_init(&again, 8192), STATUS_OK);
    int refused = 0, accepted = 0;
    const int steps = steps_short * (std::getenv("GLAISE_LONG") ? long_factor : 1);
    for (int step = 0; step < steps; step++) {
        SCOPED_TRACE("step " + std::to_string(step));
        const uint64_t digest = surface_digest(&s.skin);
        clay_change_begin(&s.field);
        for (int n = d.below(5); n >= 0; n--) {
            const int32_t i = d.below(3) * 12, k = d.below(2) * -20;
            edit_somewhere(&s.field, &d, {i, 0, k});
        }
        const status r = surface_update(&s.skin, &s.field, nullptr);
        if (r == STATUS_OK) {
            clay_change_end(&s.field);
            accepted++;
        } else {
            ASSERT_EQ(r, STATUS_POOL_FULL);
            clay_change_revert(&s.field);
            ASSERT_EQ(surface_update(&s.skin, &s.field, nullptr), STATUS_OK);
            ASSERT_EQ(surface_digest(&s.skin), digest);
            refused++;
        }
        dirt_clear(&s.field.dirty);
        ASSERT_EQ(surface_rebuild(&again, &s.field, nullptr), STATUS_OK);
        ASSERT_TRUE(sample_clay_same(&s.skin, &again));
    }
    EXPECT_GT(refused, steps / 50);
    EXPECT_GT(accepted, steps / 50);
    surface_finish(&again);
}

} // namespace
