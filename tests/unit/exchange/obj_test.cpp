/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   an OBJ holds the welded mesh as text without losing a bit of a position or a normal, nor a colour.
 * Method: hand-made pieces are written, read back by a reader of the test's own, and compared value by value.
 */
#include "bucket.h"
#include "handmade.h"
#include "readback.h"

#include "exchange/obj.h"

#include <gtest/gtest.h>

namespace {

void expect_faithful(handmade &piece, double step_mm)
{
    const mesh m = piece.as_mesh();
    bucket b;
    ASSERT_EQ(obj_write({&m, step_mm, "owl"}, bucket_put, &b), STATUS_OK);
    const soup s = readback_obj(b.bytes);
    EXPECT_EQ(s.name, "owl");
    EXPECT_EQ(s.triangles, piece.triangles);
    ASSERT_EQ(s.at.size(), piece.vertices.size());
    ASSERT_EQ(s.normal.size(), piece.vertices.size());
    for (size_t n = 0; n < s.at.size(); n++) {
        double steps[3];
        mesh_position(&piece.vertices[n], steps);
        for (size_t c = 0; c < 3; c++) {
            ASSERT_EQ(s.at[n][c], static_cast<double>(static_cast<float>(steps[c] * step_mm))) << "vertex " << n;
            ASSERT_EQ(s.normal[n][c], static_cast<double>(piece.vertices[n].normal[c])) << "vertex " << n;
        }
        ASSERT_EQ(s.rgba[n], piece.vertices[n].rgba | 0xff000000u) << "vertex " << n;
    }
    EXPECT_TRUE(soup_is_closed(s));
    const double volume = piece.volume * step_mm * step_mm * step_mm;
    EXPECT_NEAR(soup_volume(s), volume, 1e-5 * volume);
}

TEST(obj, ball_is_faithful)
{
    handmade ball = handmade_ball({-3.3, 5.7, 20.1}, 11.3, 3);
    expect_faithful(ball, 0.37);
}

TEST(obj, torus_is_faithful)
{
    handmade torus = handmade_torus({4.4, -9.1, 0.3}, 14, 4.5, 40, 20);
    expect_faithful(torus, 2.5);
}

} // namespace
