/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   an Open Inventor file is just the nodes the header promises, in their order, and holds the welded mesh.
 * Method: hand-made pieces are written, read back by a reader of the test's own that knows those nodes alone.
 */
#include "bucket.h"
#include "handmade.h"
#include "readback.h"

#include "exchange/inventor.h"

#include <gtest/gtest.h>

namespace {

std::string written(handmade &piece, double step_mm, std::string_view name)
{
    const mesh m = piece.as_mesh();
    bucket b;
    EXPECT_EQ(inventor_write({&m, step_mm, name}, bucket_put, &b), STATUS_OK);
    return b.bytes;
}

void expect_faithful(handmade &piece, double step_mm)
{
    const soup s = readback_inventor(written(piece, step_mm, "owl"));
    EXPECT_EQ(s.triangles, piece.triangles);
    ASSERT_EQ(s.at.size(), piece.vertices.size());
    ASSERT_EQ(s.normal.size(), piece.vertices.size());
    ASSERT_EQ(s.rgba.size(), piece.vertices.size());
    for (size_t n = 0; n < s.at.size(); n++) {
        double steps[3];
        mesh_position(&piece.vertices[n], steps);
        for (size_t c = 0; c < 3; c++) {
            ASSERT_EQ(s.at[n][c], static_cast<double>(static_cast<float>(steps[c] * step_mm))) << "vertex " << n;
            ASSERT_EQ(s.normal[n][c], static_cast<double>(piece.vertices[n].normal[c])) << "vertex " << n;
        }
        ASSERT_EQ(s.rgba[n], piece.vertices[n].rgba) << "vertex " << n;
    }
    EXPECT_TRUE(soup_is_closed(s));
    /* SOLID with COUNTERCLOCKWISE: a viewer leaves out what faces inwards, so the sign matters. */
    const double volume = piece.volume * step_mm * step_mm * step_mm;
    EXPECT_GT(volume, 0);
    EXPECT_NEAR(soup_volume(s), volume, 1e-5 * volume);
}

TEST(inventor, ball_is_faithful)
{
    handmade ball = handmade_ball({-3.3, 5.7, 20.1}, 11.3, 3);
    expect_faithful(ball, 0.37);
}

TEST(inventor, torus_is_faithful)
{
    handmade torus = handmade_torus({4.4, -9.1, 0.3}, 14, 4.5, 40, 20);
    expect_faithful(torus, 2.5);
}

TEST(inventor, nodes_stand_in_their_order)
{
    handmade tetrahedron = handmade_tetrahedron(8);
    std::vector<std::string> nodes;
    const soup s = readback_inventor(written(tetrahedron, 1, "an \"owl\" } \\"), &nodes);
    const std::vector<std::string> expected = {"Info",        "ShapeHints",      "Material",
                                               "PackedColor", "MaterialBinding", "Normal",
                                               "NormalBinding", "Coordinate3",   "IndexedFaceSet"};
    EXPECT_EQ(nodes, expected);
    EXPECT_EQ(s.name, "\"glaise, millimetres: an 'owl' } /\"");
}

} // namespace
