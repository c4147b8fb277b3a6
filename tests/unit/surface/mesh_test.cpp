/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: welding joins every border exactly, and the measures say what is true of known bodies.
 * Method: balls, rings and single corners whose topology and volume are known; meshes broken by hand, which must be
 *         found open. */
#include "surface/mesh.h"

#include "tests/unit/surface/sample_clay.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace {

constexpr double pi = 3.14159265358979323846;

struct welded {
    mesh m{};
    explicit welded(const surface *s) { EXPECT_EQ(mesh_init(&m, s), STATUS_OK); }
    ~welded() { mesh_finish(&m); }
};

/* The least and most a mesh of a ball of radius r may hold. An edge's crossing is found by linear interpolation of the
 * distance to the centre, which is convex with second derivative at most 1 / (r - 1): over one step it lies up to
 * 1 / (8 (r - 1)) too near, never too far (but for the clearance of 1e-3 at edge ends, and float rounding). A point of
 * a triangle whose corners lie at least `near` out and at most sqrt 3 apart is at least sqrt(near^2 - 1) out. */
std::pair<double, double> ball_volume_bounds(double r)
{
    const double near = r - 1 / (8 * (r - 1)) - 1.1e-3, within = std::sqrt(near * near - 1), beyond = r + 1.1e-3;
    return {4 * pi / 3 * within * within * within, 4 * pi / 3 * beyond * beyond * beyond};
}

TEST(mesh, a_ball_is_closed_has_euler_two_and_its_volume)
{
    for (const double r : {2.5, 7.3, 20.0}) {
        sample_clay s;
        sample_clay_ball(&s.field, {0, 0, 0}, 0.3, -0.4, 0.1, r, 0.5);
        sample_clay_update(&s);
        const welded w(&s.skin);
        EXPECT_TRUE(mesh_is_closed(&w.m));
        EXPECT_EQ(mesh_euler(&w.m), 2);
        const auto [least, most] = ball_volume_bounds(r);
        EXPECT_GT(mesh_volume(&w.m), least);
        EXPECT_LT(mesh_volume(&w.m), most);
    }
}

TEST(mesh, a_balls_normals_point_away_from_its_centre)
{
    /* Central differences of the distance err by at most a sixth of its third derivative (3 / 18^2) an axis, and
       interpolation between two ends by an eighth of its gradient's second derivative (2 / 18^2): together under 0.005
       rad, whose cosine is above 1 - 2e-5. */
    sample_clay s;
    sample_clay_ball(&s.field, {-100, 300, 7}, 0.3, -0.4, 0.1, 20, 0.5);
    sample_clay_update(&s);
    const welded w(&s.skin);
    ASSERT_GT(w.m.vertex_count, 1000u);
    for (uint32_t v = 0; v < w.m.vertex_count; v++) {
        double p[3], dot = 0, length = 0;
        mesh_position(&w.m.vertices[v], p);
        const double out[3] = {p[0] + 100 - 0.3, p[1] - 300 + 0.4, p[2] - 7 - 0.1};
        for (int n = 0; n < 3; n++) {
            dot += out[n] * w.m.vertices[v].normal[n];
            length += out[n] * out[n];
        }
        ASSERT_GT(dot / std::sqrt(length), 1 - 2e-5);
    }
}

TEST(mesh, a_ring_has_euler_zero)
{
    sample_clay s;
    sample_clay_edit(&s.field, sample_clay_box({0, 0, 0}, 24), [](key c, float &potential, uint32_t &rgba) {
        const double round = std::hypot(c.i, c.j) - 14.2, v = 1.5 + 0.5 * (5.1 - std::hypot(round, c.k));
        potential = static_cast<float>(v);
        rgba = 1;
        return v > 0;
    });
    sample_clay_update(&s);
    const welded w(&s.skin);
    EXPECT_TRUE(mesh_is_closed(&w.m));
    EXPECT_EQ(mesh_euler(&w.m), 0);
    /* Pappus, give or take the ring's surface times how far a triangle strays from it: as for the ball, near^2 - 1 with
       near^2 > 5.1^2 - 0.4. */
    const double tube = 5.1, round = 2 * pi * 14.2, stray = tube - std::sqrt(tube * tube - 1.4);
    EXPECT_NEAR(mesh_volume(&w.m), round * pi * tube * tube, round * 2 * pi * tube * stray);
}

TEST(mesh, bodies_and_hollows_add_up)
{
    sample_clay s;
    sample_clay_ball(&s.field, {0, 0, 0}, 0, 0, 0, 5.5, 0.5);
    sample_clay_ball(&s.field, {-40, 0, 17}, 0, 0, 0, 9.5, 0.5);
    sample_clay_edit(&s.field, sample_clay_box({-40, 0, 17}, 3), [](key, float &potential, uint32_t &) {
        potential = 0;
        return true;
    });
    sample_clay_update(&s);
    const welded w(&s.skin);
    EXPECT_TRUE(mesh_is_closed(&w.m));
    EXPECT_EQ(mesh_euler(&w.m), 6); /* two outsides, one hollow */
    /* The hollow is a box of 7 corners an axis whose walls stand half a step (3 against 0) beyond them, edges cut. */
    EXPECT_LT(mesh_volume(&w.m), ball_volume_bounds(5.5).second + ball_volume_bounds(9.5).second - 7 * 7 * 7);
}

TEST(mesh, one_corner_is_an_octahedron_wherever_it_lies)
{
    const int32_t far = KEY_MAX, near = KEY_MIN;
    for (const key at : {key{3, 3, 3}, key{0, 0, 0}, key{7, 7, 7}, key{8, 0, 7}, key{-1, -8, -9}, key{far, far, far},
                         key{near, near, near}, key{near, 0, far}}) {
        sample_clay s;
        sample_clay_put(&s.field, at, 3.0f, colour_pack(1, 2, 3, 4));
        EXPECT_EQ(sample_clay_update(&s).treated, 8u);
        const welded w(&s.skin);
        EXPECT_EQ(w.m.vertex_count, 6u);
        EXPECT_EQ(w.m.triangle_count, 8u);
        EXPECT_TRUE(mesh_is_closed(&w.m));
        EXPECT_EQ(mesh_euler(&w.m), 2);
        EXPECT_DOUBLE_EQ(mesh_volume(&w.m), 4.0 / 3 * 0.5 * 0.5 * 0.5);
        std::set<std::tuple<double, double, double>> places;
        for (uint32_t v = 0; v < w.m.vertex_count; v++) {
            double p[3];
            mesh_position(&w.m.vertices[v], p);
            places.insert({p[0] - at.i, p[1] - at.j, p[2] - at.k});
            EXPECT_EQ(w.m.vertices[v].rgba, colour_pack(1, 2, 3, 4));
        }
        const std::set<std::tuple<double, double, double>> expected{{.5, 0, 0}, {-.5, 0, 0}, {0, .5, 0},
                                                                    {0, -.5, 0}, {0, 0, .5}, {0, 0, -.5}};
        EXPECT_EQ(places, expected);
    }
}

/* Corners of triangles in lattice steps from `base`, turned so that the smallest comes first. */
using triangle_set = std::multiset<std::vector<double>>;

triangle_set triangles_from(const mesh &m, key base)
{
    triangle_set all;
    for (uint32_t t = 0; t < m.triangle_count; t++) {
        std::vector<std::vector<double>> corners;
        for (const uint32_t v : m.triangles[t]) {
            double p[3];
            mesh_position(&m.vertices[v], p);
            corners.push_back({p[0] - base.i, p[1] - base.j, p[2] - base.k});
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        all.insert({corners[0][0], corners[0][1], corners[0][2], corners[1][0], corners[1][1], corners[1][2],
                    corners[2][0], corners[2][1], corners[2][2]});
    }
    return all;
}

TEST(mesh, every_pattern_of_eight_corners_is_the_same_across_bricks_as_inside_one)
{
    for (int pattern = 1; pattern < 256; pattern++) {
        triangle_set inside;
        for (const key base : {key{3, 3, 3}, key{7, 7, 7}, key{-1, -1, -1}, key{-9, 7, 2}, key{7, 4, -65}}) {
            sample_clay s(64, 64);
            int corners = 0;
            for (int c = 0; c < 8; c++)
                if (pattern >> c & 1) {
                    sample_clay_put(&s.field, key_add(base, c & 1, c >> 1 & 1, c >> 2), 3.0f);
                    corners++;
                }
            sample_clay_update(&s);
            const welded w(&s.skin);
            ASSERT_TRUE(mesh_is_closed(&w.m)) << pattern;
            EXPECT_EQ(mesh_euler(&w.m) % 2, 0) << pattern;
            EXPECT_GE(mesh_volume(&w.m), corners / 6.0 - 1e-9) << pattern; /* at least an octahedron a corner */
            const triangle_set here = triangles_from(w.m, base);
            if (inside.empty())
                inside = here;
            EXPECT_EQ(here, inside) << pattern;
        }
    }
}

TEST(mesh, no_surface_is_an_empty_closed_mesh)
{
    sample_clay s;
    const welded w(&s.skin);
    EXPECT_EQ(w.m.vertex_count, 0u);
    EXPECT_TRUE(mesh_is_closed(&w.m));
    EXPECT_EQ(mesh_euler(&w.m), 0);
    EXPECT_EQ(mesh_volume(&w.m), 0);
}

TEST(mesh, holes_flips_and_doubles_are_found)
{
    sample_clay s;
    sample_clay_ball(&s.field, {0, 0, 0}, 0, 0, 0, 4, 0.5);
    sample_clay_update(&s);
    const welded w(&s.skin);
    std::vector<uint32_t> bytes(3 * size_t{w.m.triangle_count + 2});
    mesh broken = w.m;
    broken.triangles = reinterpret_cast<uint32_t(*)[3]>(bytes.data());
    const auto restore = [&] {
        std::copy_n(&w.m.triangles[0][0], 3 * size_t{w.m.triangle_count}, bytes.begin());
        broken.triangle_count = w.m.triangle_count;
    };
    for (uint32_t t = 0; t < w.m.triangle_count; t += 7) {
        restore();
        ASSERT_TRUE(mesh_is_closed(&broken));
        std::swap(broken.triangles[t][0], broken.triangles[t][1]);
        EXPECT_FALSE(mesh_is_closed(&broken)) << "flipped";
        restore();
        std::copy_n(broken.triangles[broken.triangle_count - 1], 3, broken.triangles[t]);
        broken.triangle_count -= t + 1 == w.m.triangle_count ? 0 : 1;
        EXPECT_EQ(mesh_is_closed(&broken), t + 1 == w.m.triangle_count) << "missing";
        restore();
        for (int n = 0; n < 3; n++) { /* one triangle more, from both sides: each edge is used four times */
            broken.triangles[broken.triangle_count][n] = broken.triangles[t][n];
            broken.triangles[broken.triangle_count + 1][n] = broken.triangles[t][2 - n];
        }
        broken.triangle_count += 2;
        EXPECT_FALSE(mesh_is_closed(&broken)) << "doubled";
        restore();
        broken.triangles[t][2] = broken.triangles[t][1];
        EXPECT_FALSE(mesh_is_closed(&broken)) << "degenerate";
    }
}

TEST(mesh, vertices_come_in_key_order_of_their_patches)
{
    sample_clay s;
    sample_clay_ball(&s.field, {-3, 2, 5}, 0, 0, 0, 11, 0.5);
    sample_clay_update(&s);
    const welded w(&s.skin);
    for (uint32_t v = 1; v < w.m.vertex_count; v++)
        ASSERT_LE(key_compare(w.m.vertices[v - 1].brick, w.m.vertices[v].brick), 0);
    uint64_t owned = 0;
    for (uint32_t v = 0; v < w.m.vertex_count; v++)
        for (int n = 0; n < 3; n++)
            owned += w.m.vertices[v].offset[n] < 8.0f;
    EXPECT_EQ(owned, 3 * uint64_t{w.m.vertex_count}); /* the smaller corner lies in the brick */
}

} // namespace
