/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the table of paper 000 section 6 comes out of tool_apply, all six rows, all twenty-four numbers.
 * Method: the poses under which spheres of one radius a tool reproduce it (facts/math.md 1.5, found by search); treated
 *         cubes counted here by enumeration: a cube is treated when one of its eight corners was dirtied. */
#include "tool/ellipsoid.h"
#include "tool/tool.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace {

struct row {
    const char *name;
    double radius, centre[3], turn[3]; /* turn: rotation vector, radians */
    uint64_t visited, computed, dirtied;
    size_t treated;
};

const row table[] = {
    {"small best", 2.96, {0, 0, 0}, {0, 0, 0}, 216, 125, 93, 184},
    {"small worst", 2.96, {0.6036, 0.3678, 0.0491}, {-2.4302, 0.5819, 0.6214}, 1331, 203, 110, 209},
    {"medium best", 4.95, {0.7401, 0.0320, 0.9664}, {0.0040, -0.0037, -0.0305}, 1452, 887, 501, 751},
    {"medium worst", 4.95, {0.5241, 0.8226, 0.9114}, {-0.9053, 1.8323, 1.0283}, 4352, 975, 508, 771},
    {"large best", 6.21, {0, 0, 0}, {0, 0, 0}, 2744, 2197, 1021, 1424},
    {"large worst", 6.21, {0.1221, 0.6884, 0.1044}, {-0.2548, 0.4656, 0.9051}, 8316, 1919, 1003, 1407},
};

std::ostream &operator<<(std::ostream &out, const row &r) { return out << r.name; }

/* Rodrigues: the columns of the rotation, times the radius, are the tool's axes. */
frame frame_of(const row &r)
{
    frame f;
    const double angle = std::sqrt(r.turn[0] * r.turn[0] + r.turn[1] * r.turn[1] + r.turn[2] * r.turn[2]);
    double u[3] = {1, 0, 0};
    for (int c = 0; c < 3 && angle > 0; c++)
        u[c] = r.turn[c] / angle;
    const double s = std::sin(angle), t = 1 - std::cos(angle);
    const double cross[3][3] = {{0, -u[2], u[1]}, {u[2], 0, -u[0]}, {-u[1], u[0], 0}};
    for (int a = 0; a < 3; a++) {
        f.origin[a] = r.centre[a];
        for (int c = 0; c < 3; c++) {
            const double square = u[c] * u[a] - (c == a);
            f.axis[a][c] = r.radius * ((c == a) + s * cross[c][a] + t * square);
        }
    }
    return f;
}

size_t treated(const clay &c)
{
    std::set<plain_clay_key> cubes;
    for (uint32_t n = 0; n < dirt_count(&c.dirty); n++) {
        const dirt_entry *e = dirt_at(&c.dirty, n);
        for (int slot = 0; slot < BRICK_CORNERS; slot++)
            for (int cube = 0; cube < 8 && brick_mask_has(&e->corners, slot); cube++)
                cubes.insert(plain_clay_tuple(key_add(key_of_brick(e->at), (slot >> 6) - (cube >> 2),
                                                      (slot >> 3 & 7) - (cube >> 1 & 1), (slot & 7) - (cube & 1))));
    }
    return cubes.size();
}

class paper_table : public testing::TestWithParam<row> {};

TEST_P(paper_table, comes_out_exactly)
{
    const row &r = GetParam();
    clay c;
    tool_scratch scratch;
    ellipsoid e;
    ASSERT_EQ(clay_init(&c, 1000), STATUS_OK);
    ASSERT_EQ(tool_scratch_init(&scratch, 1000), STATUS_OK);
    ASSERT_EQ(ellipsoid_init(&e, ELLIPSOID_WYVILL, 0.1), STATUS_OK);
    for (const key &far : {key{0, 0, 0}, key{-1000, 77, 123456}}) { /* counts do not depend on where */
        clay_clear(&c);
        const tool t = {ellipsoid_shape(&e), ACTION_TOOTHPASTE, 0xFF8040C0u, deform_default()};
        tool_dab d = {frame_of(r), 1, 0};
        d.at.origin[0] += far.i;
        d.at.origin[1] += far.j;
        d.at.origin[2] += far.k;
        tool_counts counts;
        ASSERT_EQ(tool_apply(&t, &d, &c, &scratch, &counts), STATUS_OK);
        EXPECT_EQ(counts.visited, r.visited);
        EXPECT_EQ(counts.computed, r.computed);
        EXPECT_EQ(counts.dirtied, r.dirtied);
        EXPECT_EQ(treated(c), r.treated);
        EXPECT_EQ(c.corners, r.dirtied) << "each dirtied corner was given clay";
        EXPECT_EQ(counts.bricks, dirt_count(&c.dirty));
    }
    tool_scratch_finish(&scratch);
    clay_finish(&c);
}

INSTANTIATE_TEST_SUITE_P(section_6, paper_table, testing::ValuesIn(table), [](const auto &which) {
    std::string name = which.param.name;
    name[name.find(' ')] = '_';
    return name;
});

} // namespace
