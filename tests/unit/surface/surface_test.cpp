/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: surface_update does what the clay's dirt asks for and no more: patches come, change, age and go; counts, slots,
 *       generations and totals keep their promises; running out leaves something that can be brought back.
 * Method: small edits with known consequences, judged against surface_rebuild and mesh_oracle. */
#include "surface/surface.h"

#include "clay/freeze.h"
#include "surface/mesh.h"
#include "tests/property/mesh_oracle.h"
#include "tests/property/plain_clay.h"
#include "tests/unit/surface/sample_clay.h"

#include <random>

namespace {

void expect_sound(sample_clay *s)
{
    ASSERT_TRUE(sample_clay_is_current(s));
    EXPECT_EQ(mesh_oracle_judge(&s->field, &s->skin), "");
    mesh m;
    ASSERT_EQ(mesh_init(&m, &s->skin), STATUS_OK);
    EXPECT_TRUE(mesh_is_closed(&m));
    if (m.triangle_count) {
        EXPECT_GT(mesh_volume(&m), 0);
    }
    mesh_finish(&m);
}

/* Normal of the vertex on the edge from `low` along `axis`. */
std::vector<float> normal_at(const sample_clay &s, key low, int axis)
{
    const patch *p = surface_find(&s.skin, key_brick(low));
    const uint32_t edge = ((static_cast<uint32_t>(low.i & 7) * 9 + (low.j & 7)) * 9 + (low.k & 7)) * 3 + axis;
    for (uint32_t v = 0; p && v < p->vertex_count; v++)
        if (p->vertices[v].edge == edge)
            return {p->vertices[v].normal, p->vertices[v].normal + 3};
    return {};
}

TEST(surface, one_dirtied_corner_treats_eight_cubes_whatever_it_changes)
{
    sample_clay s;
    sample_clay_put(&s.field, {5, 5, 5}, 1.0f); /* under iso */
    surface_counts n = sample_clay_update(&s);
    EXPECT_EQ(n.treated, 8u);
    EXPECT_EQ(n.patches, 0u);
    EXPECT_EQ(s.skin.patches.count, 0u);
    sample_clay_put(&s.field, {8, 0, -8}, 2.0f);
    n = sample_clay_update(&s);
    EXPECT_EQ(n.treated, 8u);
    EXPECT_EQ(n.patches, 8u); /* a corner with all three coordinates first in a brick: one cube in each of eight */
    EXPECT_EQ(n.triangles, 8u);
    EXPECT_EQ(s.skin.crossing, 8u);
    sample_clay_put(&s.field, {900, 900, 900}, 0.0f); /* an eraser passing over nothing */
    n = sample_clay_update(&s);
    EXPECT_EQ(n.treated, 8u);
    EXPECT_EQ(n.patches, 0u);
    expect_sound(&s);
}

TEST(surface, overlapping_corners_treat_a_shared_cube_once)
{
    sample_clay s;
    sample_clay_put(&s.field, {7, 7, 7}, 3.0f);
    sample_clay_put(&s.field, {8, 7, 7}, 3.0f);
    EXPECT_EQ(sample_clay_update(&s).treated, 12u); /* two blocks of 2 x 2 x 2 that share a layer */
    sample_clay_edit(&s.field, {{-2, -2, -2}, {9, 9, 9}}, [](key, float &, uint32_t &) { return true; });
    EXPECT_EQ(sample_clay_update(&s).treated, 13u * 13u * 13u);
}

/* Corners within the square root of `squared` of a corner: 000 section 6, small and large tool, best case. */
void expect_paper_sphere(long squared, size_t corners, uint64_t cubes)
{
    for (const key centre : {key{0, 0, 0}, key{-12, 5, 1003}}) {
        sample_clay s;
        const auto dirtied = sample_clay_edit(&s.field, sample_clay_box(centre, 7), [&](key c, float &v, uint32_t &) {
            const double d = sample_clay_distance(c, centre, 0, 0, 0);
            v = 2;
            return std::lround(d * d) <= squared;
        });
        EXPECT_EQ(dirtied.size(), corners);
        EXPECT_EQ(sample_clay_update(&s).treated, cubes);
    }
}

TEST(surface, the_papers_spheres_treat_as_many_cubes_as_its_table_says)
{
    expect_paper_sphere(8, 93, 184);
    expect_paper_sphere(38, 1021, 1424);
}

TEST(surface, a_patch_that_no_longer_crosses_is_given_back)
{
    sample_clay s;
    sample_clay_ball(&s.field, {4, 4, 4}, 0, 0, 0, 9, 0.5);
    sample_clay_update(&s);
    EXPECT_GT(s.skin.patches.count, 8u);
    sample_clay_edit(&s.field, sample_clay_box({4, 4, 4}, 14), [](key, float &v, uint32_t &) {
        v = 0;
        return true;
    });
    EXPECT_EQ(sample_clay_update(&s).patches, 0u);
    EXPECT_EQ(clay_brick_count(&s.field), 0u);
    EXPECT_EQ(s.skin.patches.count, 0u);
    EXPECT_EQ(avl_count(&s.skin.tree), 0u);
    EXPECT_EQ(s.skin.triangles + s.skin.vertices + s.skin.crossing, 0u);
    EXPECT_EQ(surface_digest(&s.skin), 0u);
    for (uint32_t slot = 0; slot < surface_slots(&s.skin); slot++)
        EXPECT_EQ(surface_patch(&s.skin, slot), nullptr);
}

TEST(surface, a_patch_may_lie_where_no_brick_is_stored)
{
    sample_clay s;
    sample_clay_put(&s.field, {8, 8, 8}, 3.0f);
    sample_clay_update(&s);
    EXPECT_EQ(clay_brick_count(&s.field), 1u);
    EXPECT_EQ(s.skin.patches.count, 8u);
    ASSERT_NE(surface_find(&s.skin, {0, 0, 0}), nullptr);
    sample_clay_put(&s.field, {8, 8, 8}, 0.0f); /* its brick goes, and with it all eight */
    sample_clay_update(&s);
    EXPECT_EQ(s.skin.patches.count, 0u);
}

TEST(surface, slots_and_find_agree_and_slots_are_stable)
{
    sample_clay s;
    sample_clay_ball(&s.field, {0, 0, 0}, 0, 0, 0, 12, 0.5);
    sample_clay_update(&s);
    std::map<uint32_t, key> before;
    for (uint32_t slot = 0; slot < surface_slots(&s.skin); slot++)
        if (const patch *p = surface_patch(&s.skin, slot)) {
            EXPECT_EQ(surface_find(&s.skin, p->at), p);
            before[slot] = p->at;
        }
    EXPECT_EQ(before.size(), s.skin.patches.count);
    EXPECT_EQ(surface_find(&s.skin, {100, 0, 0}), nullptr);
    sample_clay_edit(&s.field, sample_clay_box({12, 0, 0}, 5), [](key, float &v, uint32_t &) {
        v = 0;
        return true;
    });
    sample_clay_update(&s);
    for (const auto &[slot, at] : before)
        if (surface_find(&s.skin, at)) {
            EXPECT_EQ(surface_find(&s.skin, at), surface_patch(&s.skin, slot));
        }
    expect_sound(&s);
}

TEST(surface, hard_cuts_leave_a_closed_surface)
{
    sample_clay s;
    sample_clay_edit(&s.field, {{-17, -17, -17}, {16, 16, 16}}, [](key, float &v, uint32_t &rgba) {
        v = 3;
        rgba = 7;
        return true;
    });
    sample_clay_update(&s);
    expect_sound(&s);
    const key cuts[] = {{16, 0, 0}, {-8, -8, -8}, {7, 8, -17}, {0, 0, 0}, {-17, 16, -1}};
    for (const key &at : cuts) {
        sample_clay_edit(&s.field, sample_clay_box(at, 6), [&](key c, float &v, uint32_t &) {
            v = 0;
            return sample_clay_distance(c, at, 0.3, 0.2, -0.1) < 5.7;
        });
        sample_clay_update(&s);
        expect_sound(&s);
    }
}

TEST(surface, the_ends_of_the_lattice_close_too)
{
    for (const int32_t end : {KEY_MIN, KEY_MAX}) {
        sample_clay s;
        const key corner{end, end, end};
        const auto fill = [](float to) {
            return [to](key, float &v, uint32_t &) {
                v = to;
                return true;
            };
        };
        sample_clay_edit(&s.field, sample_clay_box(corner, 11), fill(2.5f));
        sample_clay_update(&s);
        expect_sound(&s);
        sample_clay_edit(&s.field, sample_clay_box(corner, 4), fill(0));
        sample_clay_update(&s);
        expect_sound(&s);
        sample_clay_edit(&s.field, sample_clay_box(corner, 2), fill(1.5f));
        sample_clay_update(&s);
        expect_sound(&s);
    }
}

/* `in` is inside, `out` its outside neighbour along `axis`; a weak corner beside `out` gives the gradient a second
 * direction; the dirtied one lies one step beyond `out`, in no cube of the cut edge. */
void expect_aged(key in, key out, int axis)
{
    sample_clay s;
    const bool upwards = key_compare(in, out) < 0;
    const key low = upwards ? in : out, beyond = mesh_oracle_step(out, axis, upwards ? 1 : -1);
    sample_clay_put(&s.field, in, 3.0f);
    sample_clay_put(&s.field, mesh_oracle_step(out, (axis + 1) % 3, 1), 1.0f);
    sample_clay_update(&s);
    const auto before = normal_at(s, low, axis);
    ASSERT_EQ(before.size(), 3u);
    const uint64_t generation = surface_find(&s.skin, key_brick(low))->generation;
    sample_clay_put(&s.field, beyond, 1.25f); /* under iso: no cube begins or ends to cross */
    const surface_counts n = sample_clay_update(&s);
    EXPECT_EQ(n.treated, 8u);
    EXPECT_NE(normal_at(s, low, axis), before);
    EXPECT_GT(surface_find(&s.skin, key_brick(low))->generation, generation);
    expect_sound(&s);
}

TEST(surface, a_dirtied_corner_ages_the_normals_at_its_six_neighbours)
{
    for (int axis = 0; axis < 3; axis++)
        for (int place = -9; place <= 9; place++) {
            const key a = mesh_oracle_step({2, 3, 4}, axis, place), b = mesh_oracle_step(a, axis, 1);
            expect_aged(a, b, axis);
            expect_aged(b, a, axis);
        }
}

TEST(surface, a_generation_moves_on_with_the_content_and_only_then)
{
    sample_clay s;
    sample_clay_ball(&s.field, {0, 0, 0}, 0, 0, 0, 12, 0.5);
    sample_clay_ball(&s.field, {60, 0, 0}, 0, 0, 0, 12, 0.5);
    sample_clay_update(&s);
    std::map<key, uint64_t, mesh_oracle_less> before;
    for (uint32_t slot = 0; slot < surface_slots(&s.skin); slot++)
        if (const patch *p = surface_patch(&s.skin, slot)) {
            EXPECT_TRUE(p->generation > 0 && p->generation <= s.skin.generation);
            before[p->at] = p->generation;
        }
    std::set<uint64_t> different;
    for (const auto &[at, generation] : before)
        different.insert(generation);
    EXPECT_EQ(different.size(), before.size());

    /* Dirty all, change nothing: every patch is remade and none is new. */
    sample_clay_edit(&s.field, {{-16, -16, -16}, {76, 16, 16}}, [](key, float &, uint32_t &) { return true; });
    EXPECT_EQ(sample_clay_update(&s).patches, before.size());
    for (const auto &[at, generation] : before)
        EXPECT_EQ(surface_find(&s.skin, at)->generation, generation);

    /* A colour is content. */
    sample_clay_edit(&s.field, sample_clay_box({12, 0, 0}, 2), [](key, float &v, uint32_t &rgba) {
        rgba = colour_pack(0, 0, 255, 255);
        return v > 0;
    });
    EXPECT_GT(sample_clay_update(&s).patches, 0u);
    int moved = 0;
    for (const auto &[at, generation] : before) {
        moved += surface_find(&s.skin, at)->generation > generation;
        if (at.i > 3) { /* the other ball */
            EXPECT_EQ(surface_find(&s.skin, at)->generation, generation);
        }
    }
    EXPECT_GT(moved, 0);
    expect_sound(&s);
}

TEST(surface, a_rebuild_counts_the_cubes_with_a_stored_corner_and_renews_generations)
{
    std::mt19937 random(5);
    sample_clay s;
    sample_clay_edit(&s.field, {{-10, -10, -10}, {10, 10, 10}}, [&](key, float &v, uint32_t &) {
        v = random() % 6 ? 0.0f : 2.0f;
        return true;
    });
    sample_clay_update(&s);
    const uint64_t digest = surface_digest(&s.skin), latest = s.skin.generation;
    surface_counts n{};
    ASSERT_EQ(surface_rebuild(&s.skin, &s.field, &n), STATUS_OK);
    EXPECT_EQ(n.treated, mesh_oracle_cubes(mesh_oracle_stored(&s.field)).size());
    EXPECT_EQ(n.patches, s.skin.patches.count);
    EXPECT_EQ(n.triangles, s.skin.triangles);
    EXPECT_EQ(surface_digest(&s.skin), digest);
    for (uint32_t slot = 0; slot < surface_slots(&s.skin); slot++)
        EXPECT_GT(surface_patch(&s.skin, slot)->generation, latest);
    EXPECT_EQ(mesh_oracle_judge(&s.field, &s.skin), "");
}

TEST(surface, the_digest_sees_every_part_and_no_history)
{
    const auto digest_of = [](std::vector<std::pair<key, float>> corners, uint32_t rgba, bool each) {
        sample_clay s;
        for (const auto &[at, v] : corners) {
            sample_clay_put(&s.field, at, v, rgba);
            if (each)
                sample_clay_update(&s);
            surface_digest(&s.skin);
        }
        sample_clay_update(&s);
        return surface_digest(&s.skin);
    };
    const key a{0, 0, 0}, b{40, -9, 3};
    const uint64_t digest = digest_of({{a, 2.0f}, {b, 3.0f}}, 1, false);
    EXPECT_EQ(digest_of({{b, 3.0f}, {a, 2.0f}}, 1, true), digest);
    EXPECT_EQ(digest_of({{b, 3.0f}, {a, 1.0f}, {a, 2.0f}}, 1, true), digest);
    EXPECT_NE(digest_of({{a, 2.0f}, {b, 2.5f}}, 1, false), digest);
    EXPECT_NE(digest_of({{a, 2.0f}, {b, 3.0f}}, 2, false), digest);
    EXPECT_NE(digest_of({{a, 2.0f}, {key_add(b, 8, 0, 0), 3.0f}}, 1, false), digest); /* the same but for the keys */
}

TEST(surface, running_out_of_patches_is_said_and_can_be_brought_back)
{
    sample_clay s(64, 12);
    sample_clay_put(&s.field, {4, 4, 4}, 3.0f);
    sample_clay_put(&s.field, {16, 16, 16}, 3.0f);
    sample_clay_update(&s);
    ASSERT_EQ(s.skin.patches.count, 9u);
    const uint64_t digest = surface_digest(&s.skin);
    /* Eight of nine go; 8 + 2 + 2 would have to come: one too many. */
    clay_change_begin(&s.field);
    sample_clay_put(&s.field, {16, 16, 16}, 0.0f);
    sample_clay_put(&s.field, {64, 64, 64}, 3.0f);
    sample_clay_put(&s.field, {100, 100, 96}, 3.0f);
    sample_clay_put(&s.field, {100, 104, 20}, 3.0f);
    EXPECT_EQ(surface_update(&s.skin, &s.field, nullptr), STATUS_POOL_FULL);
    clay_change_revert(&s.field);
    sample_clay_update(&s);
    EXPECT_EQ(s.skin.patches.count, 9u);
    EXPECT_EQ(surface_digest(&s.skin), digest);
    expect_sound(&s);

    sample_clay t(64, 3);
    sample_clay_put(&t.field, {0, 0, 0}, 3.0f);
    EXPECT_EQ(surface_rebuild(&t.skin, &t.field, nullptr), STATUS_POOL_FULL);
    sample_clay_put(&t.field, {0, 0, 0}, 0.0f);
    EXPECT_EQ(surface_rebuild(&t.skin, &t.field, nullptr), STATUS_OK);
    EXPECT_EQ(t.skin.patches.count, 0u);
}

TEST(surface, patches_that_go_make_room_for_those_that_come)
{
    sample_clay s(64, 8);
    for (int step = 0; step < 6; step++) {
        /* Eight patches each time, at another place, in a pool of eight; new and old marked in either order. */
        const key from{16 * step, 0, 0}, to{16 * (step + 1), 0, 0};
        sample_clay_put(&s.field, step % 2 ? from : to, step % 2 ? 0.0f : 3.0f);
        sample_clay_put(&s.field, step % 2 ? to : from, step % 2 ? 3.0f : 0.0f);
        sample_clay_update(&s);
        EXPECT_EQ(s.skin.patches.count, 8u);
        expect_sound(&s);
    }
}

TEST(surface, a_surface_that_never_was_can_be_finished)
{
    surface s{};
    surface_finish(&s);
    ASSERT_EQ(surface_init(&s, 5), STATUS_OK);
    EXPECT_EQ(surface_slots(&s), 0u);
    EXPECT_EQ(surface_digest(&s), 0u);
    surface_finish(&s);
}

TEST(surface_of_a_frozen_clay, is_the_one_that_was)
{
    clay c;
    freeze f;
    surface was = {}, still = {};
    seeded chance = {1};
    ASSERT_EQ(clay_init(&c, 1000), STATUS_OK);
    ASSERT_EQ(surface_init(&was, 2000), STATUS_OK);
    ASSERT_EQ(surface_init(&still, 2000), STATUS_OK);
    ASSERT_EQ(plain_clay_ball(&c, chance, {0, 0, 0}, 20, 1), STATUS_OK);
    ASSERT_EQ(surface_rebuild(&was, &c, nullptr), STATUS_OK);
    ASSERT_EQ(freeze_begin(&f, &c), STATUS_OK);
    for (const auto &[at, corner] : plain_clay_of(&c))
        ASSERT_EQ(clay_write(&c, plain_clay_untuple(at), 2.5f, 77), STATUS_OK);
    ASSERT_EQ(surface_rebuild(&still, &f.still, nullptr), STATUS_OK);
    EXPECT_EQ(surface_digest(&still), surface_digest(&was));
    EXPECT_GT(was.triangles, 1000u);
    freeze_end(&f);
    surface_finish(&still);
    surface_finish(&was);
    clay_finish(&c);
}

} // namespace
