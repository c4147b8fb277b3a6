/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a frame inverts to the map back from key space; what cannot be inverted, or is of absurd size, is refused.
 * Method: there and back for random frames with shear and every scale allowed; each bad pose in each place. */
#include "tool/frame.h"

#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

frame unit_frame()
{
    return {{0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

void expect_bad(const frame &f)
{
    double row[3][3] = {{7, 7, 7}, {7, 7, 7}, {7, 7, 7}};
    EXPECT_EQ(frame_invert(&f, row), STATUS_BAD_POSE);
    for (auto &r : row)
        for (double v : r)
            EXPECT_EQ(v, 7) << "a refusal wrote";
}

TEST(frame_invert, leads_back)
{
    seeded chance = {1};
    for (int n = 0; n < 20000; n++) {
        frame f = unit_frame();
        double rotation[3][3], row[3][3];
        seeded_rotation(chance, rotation);
        double length[3];
        for (int a = 0; a < 3; a++) {
            length[a] = std::pow(10.0, seeded_real(chance, -2.9, 5.9));
            f.origin[a] = seeded_real(chance, -1e9, 1e9);
            for (int c = 0; c < 3; c++)
                f.axis[a][c] = rotation[c][a] * length[a];
        }
        const double shear = seeded_real(chance, -0.5, 0.5);
        for (int c = 0; c < 3; c++)
            f.axis[1][c] += shear * rotation[c][0] * length[1];
        ASSERT_EQ(frame_invert(&f, row), STATUS_OK);
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                double back = 0, size = 0;
                for (int c = 0; c < 3; c++) {
                    back += row[a][c] * f.axis[b][c];
                    size += std::fabs(row[a][c] * f.axis[b][c]);
                }
                ASSERT_NEAR(back, a == b, 1e-14 * (1 + 10 * size)) << "axis " << b << " along " << a;
            }
    }
}

TEST(frame_invert, takes_mirrored_frames)
{
    frame f = unit_frame();
    f.axis[2][2] = -2;
    double row[3][3];
    ASSERT_EQ(frame_invert(&f, row), STATUS_OK);
    EXPECT_EQ(row[2][2], -0.5);
}

TEST(frame_invert, refuses_what_is_not_a_number)
{
    for (double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()})
        for (int a = 0; a < 3; a++) {
            frame f = unit_frame();
            f.origin[a] = bad;
            expect_bad(f);
            for (int c = 0; c < 3; c++) {
                f = unit_frame();
                f.axis[a][c] = bad;
                expect_bad(f);
            }
        }
}

TEST(frame_invert, refuses_absurd_lengths)
{
    for (double bad : {0.0, 1e-4, FRAME_AXIS_MIN * 0.999, FRAME_AXIS_MAX * 1.001, 1e200})
        for (int a = 0; a < 3; a++) {
            frame f = unit_frame();
            f.axis[a][a] = bad;
            expect_bad(f);
        }
    double row[3][3];
    for (double good : {FRAME_AXIS_MIN, FRAME_AXIS_MAX}) {
        frame f = unit_frame();
        f.axis[1][1] = good;
        EXPECT_EQ(frame_invert(&f, row), STATUS_OK);
    }
}

TEST(frame_invert, refuses_flat_frames)
{
    for (int a = 0; a < 3; a++) {
        frame f = unit_frame();
        const int b = (a + 1) % 3;
        for (int c = 0; c < 3; c++)
            f.axis[a][c] = 2 * f.axis[b][c];
        expect_bad(f); /* two axes along one line */
        f.axis[a][a] = 0.5 * FRAME_FLAT * 2;
        expect_bad(f);
        f.axis[a][a] = 2 * FRAME_FLAT * 2;
        double row[3][3];
        EXPECT_EQ(frame_invert(&f, row), STATUS_OK) << "just thick enough";
    }
    frame f = {{0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}; /* no two parallel, all in one plane */
    expect_bad(f);
}

} // namespace
