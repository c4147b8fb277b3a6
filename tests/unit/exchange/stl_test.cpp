/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   a binary STL holds exactly the mesh's facets, in millimetres, closed by equal bits.
 * Method: hand-made pieces are written, read back by a reader of the test's own, and measured.
 */
#include "bucket.h"
#include "handmade.h"
#include "readback.h"

#include "exchange/stl.h"

#include <cmath>
#include <gtest/gtest.h>

namespace {

std::string written(handmade &piece, double step_mm)
{
    const mesh m = piece.as_mesh();
    bucket b;
    EXPECT_EQ(stl_write({&m, step_mm, "name"}, bucket_put, &b), STATUS_OK);
    return b.bytes;
}

void expect_faithful(handmade &piece, double step_mm)
{
    const std::string bytes = written(piece, step_mm);
    EXPECT_EQ(bytes.size(), 84 + 50 * piece.triangles.size());
    const soup s = readback_stl(bytes);
    ASSERT_EQ(s.triangles.size(), piece.triangles.size());
    for (size_t n = 0; n < s.at.size(); n++) {
        double steps[3];
        mesh_position(&piece.vertices[piece.triangles[n / 3][n % 3]], steps);
        for (size_t c = 0; c < 3; c++)
            ASSERT_EQ(s.at[n][c], static_cast<double>(static_cast<float>(steps[c] * step_mm))) << "corner " << n;
    }
    const soup welded = soup_weld(s);
    EXPECT_EQ(welded.at.size(), piece.vertices.size());
    EXPECT_TRUE(soup_is_closed(welded));
    const double volume = piece.volume * step_mm * step_mm * step_mm;
    EXPECT_GT(volume, 0);
    EXPECT_NEAR(soup_volume(welded), volume, 1e-5 * volume);
}

TEST(stl, ball_is_faithful)
{
    handmade ball = handmade_ball({-3.3, 5.7, 20.1}, 11.3, 3);
    expect_faithful(ball, 0.37);
}

TEST(stl, torus_is_faithful)
{
    handmade torus = handmade_torus({4.4, -9.1, 0.3}, 14, 4.5, 40, 20);
    expect_faithful(torus, 2.5);
}

TEST(stl, normals_are_those_of_the_corners)
{
    handmade torus = handmade_torus({0.2, 0.1, -0.4}, 14, 4.5, 24, 12);
    const soup s = readback_stl(written(torus, 0.5));
    for (size_t t = 0; t < s.triangles.size(); t++) {
        const auto &a = s.at[3 * t], &b = s.at[3 * t + 1], &c = s.at[3 * t + 2];
        std::array<double, 3> n{};
        for (size_t x = 0; x < 3; x++) {
            const size_t y = (x + 1) % 3, z = (x + 2) % 3;
            n[x] = (b[y] - a[y]) * (c[z] - a[z]) - (b[z] - a[z]) * (c[y] - a[y]);
        }
        const double length = std::hypot(n[0], n[1], n[2]);
        for (size_t x = 0; x < 3; x++)
            ASSERT_NEAR(s.normal[t][x], n[x] / length, 1e-7) << "facet " << t;
    }
}

TEST(stl, header_is_eighty_bytes_and_not_ascii)
{
    handmade tetrahedron = handmade_tetrahedron(8);
    const std::string bytes = written(tetrahedron, 1);
    EXPECT_NE(bytes.substr(0, 5), "solid");
    EXPECT_EQ(bytes.substr(0, 6), "glaise");
    EXPECT_EQ(bytes[79], '\0');
    EXPECT_EQ(bytes.substr(80, 4), std::string("\4\0\0\0", 4));
}

/* Where a float can no longer tell the corners apart the facets stay, with a normal that says "work it out". */
TEST(stl, facets_without_area_are_kept)
{
    handmade tetrahedron = handmade_tetrahedron(4);
    for (mesh_vertex &v : tetrahedron.vertices)
        v.brick.i = v.brick.j = v.brick.k = 1 << 27;
    const soup s = readback_stl(written(tetrahedron, 1));
    ASSERT_EQ(s.triangles.size(), 4u);
    for (size_t t = 0; t < 4; t++) {
        EXPECT_EQ(s.at[3 * t], s.at[3 * t + 1]);
        EXPECT_EQ(s.normal[t], (std::array<double, 3>{0, 0, 0}));
    }
}

} // namespace
