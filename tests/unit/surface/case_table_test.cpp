/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the 256 cases form closed surfaces whatever cubes meet: vertices exactly on the cut edges, contours that depend
 *       on a face alone, no triangle side shared inside a face, the outside on the counter-clockwise side.
 * Method: every case is taken apart into directed triangle sides; what must hold is said from the corners' signs. */
#include "surface/case_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace {

using side = std::pair<int, int>; /* directed, from edge to edge */

struct cube_edge {
    int from, to, axis;
};

cube_edge edge_of(int e)
{
    cube_edge r{0, 0, e / 4};
    case_table_edge(e, &r.from, &r.to);
    return r;
}

int coordinate(int corner, int axis) { return corner >> axis & 1; }

bool lies_on(int e, int axis, int at)
{
    const cube_edge c = edge_of(e);
    return c.axis != axis && coordinate(c.from, axis) == at;
}

bool share_a_face(int e, int f)
{
    for (int axis = 0; axis < 3; axis++)
        for (int at = 0; at < 2; at++)
            if (lies_on(e, axis, at) && lies_on(f, axis, at))
                return true;
    return false;
}

const case_table &cases()
{
    static const case_table t = [] {
        case_table made;
        case_table_init(&made);
        return made;
    }();
    return t;
}

std::multiset<side> sides(int index)
{
    std::multiset<side> all;
    for (int n = 0; n < cases().triangles[index]; n++)
        for (int c = 0; c < 3; c++)
            all.insert({cases().edge[index][3 * n + c], cases().edge[index][3 * n + (c + 1) % 3]});
    return all;
}

/* Sides without their reverse in the same cube: the contours. */
std::set<side> contours(int index)
{
    std::set<side> open;
    const auto all = sides(index);
    for (const side &s : all)
        if (!all.count({s.second, s.first}))
            open.insert(s);
    return open;
}

TEST(case_table, edges_run_along_their_axis_and_are_all_different)
{
    std::set<side> seen;
    for (int e = 0; e < CASE_TABLE_EDGES; e++) {
        const cube_edge c = edge_of(e);
        EXPECT_EQ(c.to, c.from + (1 << c.axis));
        EXPECT_EQ(coordinate(c.from, c.axis), 0);
        seen.insert({c.from, c.to});
    }
    EXPECT_EQ(seen.size(), 12u);
}

TEST(case_table, vertices_lie_on_the_cut_edges_and_nowhere_else)
{
    for (int index = 0; index < 256; index++) {
        std::set<int> used, cut;
        for (int n = 0; n < 3 * cases().triangles[index]; n++)
            used.insert(cases().edge[index][n]);
        for (int e = 0; e < CASE_TABLE_EDGES; e++)
            if ((index >> edge_of(e).from & 1) != (index >> edge_of(e).to & 1))
                cut.insert(e);
        EXPECT_EQ(used, cut) << index;
    }
}

TEST(case_table, sides_are_contours_on_a_face_or_diagonals_off_every_face)
{
    for (int index = 0; index < 256; index++) {
        const auto all = sides(index);
        std::map<int, int> starts, ends;
        for (const side &s : all) {
            EXPECT_EQ(all.count(s), 1u) << index;
            const bool inner = all.count({s.second, s.first}) == 1;
            EXPECT_EQ(share_a_face(s.first, s.second), !inner) << index << ": " << s.first << "-" << s.second;
        }
        for (const side &s : contours(index)) {
            starts[s.first]++;
            ends[s.second]++;
        }
        for (int e = 0; e < CASE_TABLE_EDGES; e++) {
            const int cut = (index >> edge_of(e).from ^ index >> edge_of(e).to) & 1;
            EXPECT_EQ(starts[e], cut);
            EXPECT_EQ(ends[e], cut);
        }
    }
}

TEST(case_table, inside_corners_are_never_joined_across_a_face)
{
    int ambiguous = 0;
    for (int index = 0; index < 256; index++)
        for (const side &s : contours(index)) {
            /* On an ambiguous face each contour turns round one corner, shared by its two edges. */
            const cube_edge a = edge_of(s.first), b = edge_of(s.second);
            for (const int corner : {a.from, a.to}) {
                if (corner != b.from && corner != b.to)
                    continue;
                const int far_a = a.from ^ a.to ^ corner, far_b = b.from ^ b.to ^ corner;
                const int opposite = far_a ^ far_b ^ corner;
                const bool in = index >> corner & 1, opposite_in = index >> opposite & 1;
                if (in != opposite_in)
                    continue; /* one corner against three, nothing to choose */
                ambiguous++;
                EXPECT_TRUE(in) << index;
            }
        }
    /* 6 faces, 2 diagonals, 16 ways to set the other four corners, two contours each. */
    EXPECT_EQ(ambiguous, 6 * 2 * 16 * 2);
}

/* The contours on one face, edges named by their place across the face, so that two cubes can be compared. */
std::set<side> on_face(int index, int axis, int at)
{
    const auto place = [axis](int e) {
        const cube_edge c = edge_of(e);
        return (c.from & ~(1 << axis)) * 16 + (c.to & ~(1 << axis));
    };
    std::set<side> found;
    for (const side &s : contours(index))
        if (lies_on(s.first, axis, at) && lies_on(s.second, axis, at))
            found.insert({place(s.first), place(s.second)});
    return found;
}

TEST(case_table, cubes_that_share_a_face_draw_the_same_contours_the_other_way)
{
    int compared = 0;
    for (int axis = 0; axis < 3; axis++) {
        std::array<std::set<side>, 256> high, low;
        for (int index = 0; index < 256; index++) {
            high[index] = on_face(index, axis, 1);
            low[index] = on_face(index, axis, 0);
        }
        for (int a = 0; a < 256; a++)
            for (int b = 0; b < 256; b++) {
                bool fit = true;
                for (int corner = 0; corner < 8; corner++)
                    if (coordinate(corner, axis) == 1)
                        fit = fit && (a >> corner & 1) == (b >> (corner & ~(1 << axis)) & 1);
                if (!fit)
                    continue;
                std::set<side> reversed;
                for (const side &s : low[b])
                    reversed.insert({s.second, s.first});
                EXPECT_EQ(high[a], reversed) << a << " beside " << b << " along " << axis;
                compared++;
            }
    }
    EXPECT_EQ(compared, 3 * 256 * 16);
}

TEST(case_table, has_the_totals_of_the_never_joined_rule)
{
    std::map<int, int> loops;
    int total = 0, most = 0;
    for (int index = 0; index < 256; index++) {
        total += cases().triangles[index];
        most = std::max(most, int{cases().triangles[index]});
        std::map<int, int> next;
        for (const side &s : contours(index))
            next[s.first] = s.second;
        while (!next.empty()) {
            int length = 0;
            for (auto at = next.begin(); at != next.end(); length++) {
                const int to = at->second;
                next.erase(at);
                at = next.find(to);
            }
            loops[length]++;
        }
    }
    EXPECT_EQ(total, 820);
    EXPECT_EQ(most, CASE_TABLE_TRIANGLES_MAX);
    const std::map<int, int> expected{{3, 144}, {4, 66}, {5, 72}, {6, 52}, {7, 24}};
    EXPECT_EQ(loops, expected);
}

TEST(case_table, the_outside_sees_triangles_counter_clockwise)
{
    const auto middle = [](int e, int axis) {
        return 0.5 * (coordinate(edge_of(e).from, axis) + coordinate(edge_of(e).to, axis));
    };
    for (int corner = 0; corner < 8; corner++)
        for (const bool inside : {true, false}) {
            const int index = inside ? 1 << corner : 255 ^ 1 << corner;
            ASSERT_EQ(cases().triangles[index], 1);
            const uint8_t *e = cases().edge[index];
            double normal[3], towards_corner = 0;
            for (int n = 0; n < 3; n++) {
                const int u = (n + 1) % 3, v = (n + 2) % 3;
                normal[n] = (middle(e[1], u) - middle(e[0], u)) * (middle(e[2], v) - middle(e[0], v)) -
                            (middle(e[1], v) - middle(e[0], v)) * (middle(e[2], u) - middle(e[0], u));
                towards_corner += normal[n] * (coordinate(corner, n) - middle(e[0], n));
            }
            EXPECT_EQ(towards_corner < 0, inside) << index;
            EXPECT_NE(towards_corner, 0);
        }
}

} // namespace
