/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: vertices and triangles are what the headers promise: on every cut edge one vertex, its position, normal and
 *       colour by the stated formulas, triangles by the case table.
 * Method: mesh_oracle judges each of them out of single corner reads in doubles, on noise, on ties and on hand-made
 *         edges. */
#include "surface/polygonizer.h"

#include "tests/property/mesh_oracle.h"
#include "tests/unit/surface/sample_clay.h"

#include <limits>
#include <memory>
#include <random>

namespace {

const patch_vertex *vertex_at(const surface *s, key brick_at, int di, int dj, int dk, int axis)
{
    const patch *p = surface_find(s, brick_at);
    for (uint32_t v = 0; p && v < p->vertex_count; v++)
        if (p->vertices[v].edge == static_cast<uint32_t>(((di * 9 + dj) * 9 + dk) * 3 + axis))
            return &p->vertices[v];
    return nullptr;
}

TEST(polygonizer, noise_and_ties_are_drawn_as_the_formulas_say)
{
    std::mt19937 random(11);
    const float tied[] = {0, 0, 0.5f, 1, std::nextafter(1.5f, 0.0f), 1.5f, std::nextafter(1.5f, 2.0f), 2, 3};
    for (int round = 0; round < 12; round++) {
        sample_clay s;
        const int32_t base = (round % 3 - 1) * 8;
        sample_clay_edit(&s.field, {{base - 5, base - 3, base - 6}, {base + 5, base + 9, base + 4}},
                         [&](key, float &potential, uint32_t &rgba) {
                             potential = round % 2 ? tied[random() % 9] : static_cast<float>(random() % 3001) / 1000;
                             rgba = static_cast<uint32_t>(random());
                             return true;
                         });
        sample_clay_update(&s);
        ASSERT_GT(s.skin.triangles, 500u);
        EXPECT_EQ(mesh_oracle_judge(&s.field, &s.skin), "") << "round " << round;
    }
}

TEST(polygonizer, full_and_checkered_bricks_fit_their_arrays)
{
    sample_clay s;
    sample_clay_edit(&s.field, {{0, 0, 0}, {23, 23, 23}}, [](key c, float &potential, uint32_t &) {
        potential = (c.i + c.j + c.k) % 2 ? 3.0f : 0.0f;
        return true;
    });
    sample_clay_update(&s);
    const patch *p = surface_find(&s.skin, {1, 1, 1});
    ASSERT_NE(p, nullptr);
    EXPECT_EQ(p->vertex_count, uint32_t{PATCH_VERTICES_MAX}); /* every edge is cut */
    EXPECT_EQ(p->triangle_count, 512u * 4u);                  /* four corners cut off each cube */
    EXPECT_EQ(mesh_oracle_judge(&s.field, &s.skin), "");
}

TEST(polygonizer, a_vertex_divides_its_edge_by_the_potentials)
{
    sample_clay s;
    sample_clay_put(&s.field, {2, 2, 2}, 3.0f, colour_pack(0, 0, 0, 0));
    sample_clay_put(&s.field, {3, 2, 2}, 1.0f, colour_pack(100, 200, 40, 255));
    sample_clay_put(&s.field, {2, 2, 3}, 2.0f, colour_pack(100, 200, 40, 255));
    sample_clay_update(&s);
    const patch_vertex *v = vertex_at(&s.skin, {0, 0, 0}, 2, 2, 2, 0);
    ASSERT_NE(v, nullptr); /* 1.5 of the way from 3 to 1: three quarters along the edge */
    EXPECT_FLOAT_EQ(v->position[0], 2.75f);
    EXPECT_EQ(v->rgba, colour_pack(75, 150, 30, 191));
    v = vertex_at(&s.skin, {0, 0, 0}, 1, 2, 2, 0); /* towards an absent corner: half way, without a colour of its own */
    ASSERT_NE(v, nullptr);
    EXPECT_FLOAT_EQ(v->position[0], 1.5f);
    EXPECT_EQ(v->rgba, colour_pack(0, 0, 0, 0));
    EXPECT_EQ(vertex_at(&s.skin, {0, 0, 0}, 2, 2, 2, 2), nullptr); /* both ends inside */
    v = vertex_at(&s.skin, {0, 0, 0}, 2, 2, 3, 2);
    ASSERT_NE(v, nullptr); /* a quarter of the way from 2 to 0 */
    EXPECT_FLOAT_EQ(v->position[2], 3.25f);
}

TEST(polygonizer, a_corner_exactly_at_iso_keeps_its_vertices_apart)
{
    sample_clay s;
    sample_clay_put(&s.field, {4, 4, 4}, 1.5f);
    sample_clay_update(&s);
    const patch *p = surface_find(&s.skin, {0, 0, 0});
    ASSERT_NE(p, nullptr);
    ASSERT_EQ(p->vertex_count, 6u);
    for (uint32_t v = 0; v < 6; v++) {
        float away = 0;
        for (int n = 0; n < 3; n++)
            away += std::fabs(p->vertices[v].position[n] - 4.0f);
        EXPECT_NEAR(away, 1e-3f, 1e-6f);
    }
}

TEST(polygonizer, without_a_gradient_the_normal_is_the_edge_outwards)
{
    /* Two equal corners with one absent between them: every difference at all three is 0 - 0 or 3 - 3. */
    sample_clay s;
    sample_clay_put(&s.field, {4, 4, 4}, 3.0f);
    sample_clay_put(&s.field, {6, 4, 4}, 3.0f);
    sample_clay_update(&s);
    const patch_vertex *v = vertex_at(&s.skin, {0, 0, 0}, 4, 4, 4, 0), *w = vertex_at(&s.skin, {0, 0, 0}, 5, 4, 4, 0);
    ASSERT_TRUE(v && w);
    EXPECT_EQ(v->normal[0], 1.0f);
    EXPECT_EQ(w->normal[0], -1.0f);
    EXPECT_EQ(v->normal[1], 0.0f);
    EXPECT_EQ(w->normal[2], 0.0f);
}

TEST(polygonizer, stored_cubes_are_those_with_a_stored_corner)
{
    std::mt19937 random(3);
    sample_clay s;
    sample_clay_edit(&s.field, {{-4, -4, -4}, {12, 12, 12}}, [&](key, float &potential, uint32_t &) {
        const float some[] = {0, 0, 0, 0, 0, 0, 1, std::numeric_limits<float>::denorm_min()};
        potential = some[random() % 8];
        return true;
    });
    uint64_t sum = 0;
    const auto p = std::make_unique<polygonizer>();
    for (int n = 0; n < 64; n++) {
        const key at = {(n >> 4) - 2, (n >> 2 & 3) - 2, (n & 3) - 2};
        polygonizer_look(p.get(), &s.field, at, clay_find(&s.field, at));
        sum += polygonizer_stored_cubes(p.get());
    }
    EXPECT_EQ(sum, mesh_oracle_cubes(mesh_oracle_stored(&s.field)).size());
}

} // namespace
