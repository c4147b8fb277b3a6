/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: what the device gets is the patch: places to 1/8192 of a step, directions to a part in thousands, colours and
 *       triangles exactly; and what a patch needs fits into the units it is said to need.
 * Method: patches of a ball are packed and unpacked again by arithmetic written here once more. */
#include "view_stage.h"

#include "view/packed.h"

#include <cmath>

namespace {

class packed_patches : public testing::Test {
  protected:
    void SetUp() override { piece.ball({3, 5, -2}, 17, view_stage_rgba(200, 100, 50)); }

    template <typename F> void for_each(F f)
    {
        const surface &s = piece.it->surface;
        int count = 0;
        for (uint32_t n = 0; n < surface_slots(&s); n++) {
            if (const patch *p = surface_patch(&s, n)) {
                f(*p);
                count++;
            }
        }
        EXPECT_GT(count, 20);
    }

    view_stage_piece piece;
};

std::array<double, 3> direction(const int16_t n[2])
{
    const double x = n[0] / 32767.0, y = n[1] / 32767.0, z = 1 - std::abs(x) - std::abs(y);
    std::array<double, 3> d = {x, y, z};
    if (z < 0)
        d = {(1 - std::abs(y)) * (x < 0 ? -1 : 1), (1 - std::abs(x)) * (y < 0 ? -1 : 1), z};
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    return {d[0] / length, d[1] / length, d[2] / length};
}

TEST_F(packed_patches, vertices_come_back)
{
    packed made;
    for_each([&](const patch &p) {
        packed_make(&made, p, 77, packed_units(p, false), false);
        ASSERT_EQ(made.vertices.size(), p.vertex_count);
        for (uint32_t n = 0; n < p.vertex_count; n++) {
            const packed_vertex &v = made.vertices[n];
            ASSERT_EQ(v.unit, 77);
            ASSERT_EQ(v.rgba, p.vertices[n].rgba);
            const std::array<double, 3> d = direction(v.normal);
            for (size_t c = 0; c < 3; c++) {
                ASSERT_NEAR(v.place[c] / 4096.0, p.vertices[n].position[c], 1 / 8192.0);
                ASSERT_NEAR(d[c], p.vertices[n].normal[c], 1e-3);
            }
        }
    });
}

TEST_F(packed_patches, indices_name_the_vertices_of_their_range_and_fill_it)
{
    packed made;
    for_each([&](const patch &p) {
        const int units = packed_units(p, true);
        packed_make(&made, p, 100, units, true);
        ASSERT_LE(p.vertex_count, static_cast<uint32_t>(units * PACKED_UNIT_VERTICES));
        ASSERT_EQ(made.triangles.size(), static_cast<size_t>(units) * PACKED_UNIT_TRIANGLES * 3);
        ASSERT_EQ(made.lines.size(), static_cast<size_t>(units) * PACKED_UNIT_LINES * 2);
        for (size_t t = 0; t < made.triangles.size() / 3; t++)
            for (size_t c = 0; c < 3; c++)
                ASSERT_EQ(made.triangles[3 * t + c] - 100 * PACKED_UNIT_VERTICES,
                          t < p.triangle_count ? p.triangles[t][c] : 0);
        packed_make(&made, p, 100, units, false);
        ASSERT_TRUE(made.lines.empty());
    });
}

TEST_F(packed_patches, no_patch_needs_more_than_the_most)
{
    std::vector<patch_vertex> vertices(PATCH_VERTICES_MAX);
    patch p{};
    p.vertices = vertices.data();
    p.vertex_count = PATCH_VERTICES_MAX;
    EXPECT_EQ(packed_units(p, false), static_cast<int>(PACKED_UNITS_MAX));
    /* five triangles a cube, two rising sides each */
    const int cubes = BRICK_EDGE * BRICK_EDGE * BRICK_EDGE;
    EXPECT_LE(5 * cubes, int{PACKED_UNITS_MAX} * int{PACKED_UNIT_TRIANGLES});
    EXPECT_LE(10 * cubes, int{PACKED_UNITS_MAX} * int{PACKED_UNIT_LINES});
}

} // namespace
