/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the cubes shown are those that the paper's trees would hold, each face that borders on another kind of space
 *       once; they stand where they are; too many become bricks.
 * Method: seeded corners across brick and span borders; the set and its faces once more from clay_read, cube by cube.
 *         The picture of a block of corners is compared with its projected outline. */
#include "bare_frame.h"
#include "field_fill.h"
#include "view/cubes.h"

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <tuple>

namespace {

using place = std::tuple<int, int, int>;
using face = std::tuple<int, int, int, int>; /* a cube's and its side */

bool is_stored(const clay &c, int i, int j, int k)
{
    for (int n = 0; n < 8; n++)
        if (clay_read(&c, {i + (n >> 2 & 1), j + (n >> 1 & 1), k + (n & 1)}, nullptr) > 0)
            return true;
    return false;
}

bool is_crossing(const clay &c, int i, int j, int k)
{
    int inside = 0;
    for (int n = 0; n < 8; n++)
        inside += clay_read(&c, {i + (n >> 2 & 1), j + (n >> 1 & 1), k + (n & 1)}, nullptr) >= POTENTIAL_ISO;
    return inside > 0 && inside < 8;
}

std::set<place> cubes_within(const clay &c, bool crossing)
{
    std::set<place> found;
    const box b = clay_box(&c);
    for (int i = b.min.i - 2; i <= b.max.i + 1; i++)
        for (int j = b.min.j - 2; j <= b.max.j + 1; j++)
            for (int k = b.min.k - 2; k <= b.max.k + 1; k++)
                if (crossing ? is_crossing(c, i, j, k) : is_stored(c, i, j, k))
                    found.insert({i, j, k});
    return found;
}

std::set<face> faces_of(const std::set<place> &set)
{
    std::set<face> faces;
    for (const auto &[i, j, k] : set) {
        const std::array<place, 6> others = {{{i - 1, j, k}, {i + 1, j, k}, {i, j - 1, k},
                                              {i, j + 1, k}, {i, j, k - 1}, {i, j, k + 1}}};
        for (int side = 0; side < 6; side++)
            if (set.count(others[static_cast<size_t>(side)]) == 0)
                faces.insert({i, j, k, side});
    }
    return faces;
}

std::set<face> unpacked(const cubes_faces &of)
{
    std::set<face> faces;
    const int times = of.are_bricks ? 1 : BRICK_EDGE;
    for (const cubes_span &span : of.spans) {
        for (size_t n = span.first; n < span.first + span.count; n++) {
            const cubes_face &f = of.faces.at(n);
            EXPECT_TRUE(faces.insert({span.at.i * times + f.place[0], span.at.j * times + f.place[1],
                                      span.at.k * times + f.place[2], f.side}).second) << "twice";
        }
    }
    EXPECT_EQ(faces.size(), of.faces.size()) << "faces in no span";
    return faces;
}

void scatter(field_fill_piece *piece, key about, int reach, int count)
{
    std::mt19937 random(7);
    std::uniform_int_distribution<int> any(-reach, reach);
    std::uniform_real_distribution<float> potential(0.1f, 3.0f);
    for (int n = 0; n < count; n++)
        ASSERT_EQ(clay_write(&piece->it->clay, key_add(about, any(random), any(random), any(random)),
                             potential(random), 0xffffffff), STATUS_OK);
    piece->finish();
}

void expect_right(const field_fill_piece &piece)
{
    for (const snapshot_structure structure : {SNAPSHOT_STRUCTURE_STORED, SNAPSHOT_STRUCTURE_CROSSING}) {
        cubes_faces got;
        cubes_list(piece.it, structure, CUBES_FACES_MAX, &got);
        const std::set<place> set = cubes_within(piece.it->clay, structure == SNAPSHOT_STRUCTURE_CROSSING);
        EXPECT_GT(set.size(), 100u);
        EXPECT_EQ(got.cubes, set.size());
        EXPECT_FALSE(got.are_bricks);
        EXPECT_EQ(unpacked(got), faces_of(set)) << structure;
        for (const auto &[i, j, k] : set)
            ASSERT_TRUE(box_contains(got.within, key_brick({i, j, k})));
    }
}

TEST(view_cubes, are_the_papers_sets_with_their_bare_faces)
{
    field_fill_piece sparse(2000), dense(2000);
    scatter(&sparse, {0, 0, 0}, 14, 60);
    expect_right(sparse);
    scatter(&dense, {3, -5, 7}, 12, 8000);
    expect_right(dense);
    EXPECT_EQ(cubes_within(dense.it->clay, true).size(), dense.it->surface.crossing)
        << "the surface counts the same";
}

TEST(view_cubes, stand_where_they_are_at_the_borders_of_spans)
{
    for (const key about : {key{CUBES_SPAN, 0, -CUBES_SPAN}, key{-40 * CUBES_SPAN, CUBES_SPAN - 3, 5}}) {
        field_fill_piece piece(2000);
        scatter(&piece, about, 9, 300);
        expect_right(piece);
        cubes_faces got;
        cubes_list(piece.it, SNAPSHOT_STRUCTURE_STORED, CUBES_FACES_MAX, &got);
        EXPECT_GE(got.spans.size(), 4u);
    }
}

TEST(view_cubes, are_bricks_where_there_are_too_many)
{
    field_fill_piece piece(2000);
    scatter(&piece, {0, 0, 0}, 20, 400);
    cubes_faces all, few;
    cubes_list(piece.it, SNAPSHOT_STRUCTURE_STORED, CUBES_FACES_MAX, &all);
    cubes_list(piece.it, SNAPSHOT_STRUCTURE_STORED, all.faces.size(), &few);
    EXPECT_FALSE(few.are_bricks);
    cubes_list(piece.it, SNAPSHOT_STRUCTURE_STORED, all.faces.size() - 1, &few);
    ASSERT_TRUE(few.are_bricks);
    std::set<place> bricks;
    for (const auto &[i, j, k] : cubes_within(piece.it->clay, false)) {
        const key at = key_brick({i, j, k});
        bricks.insert({at.i, at.j, at.k});
    }
    EXPECT_EQ(few.bricks, bricks.size());
    EXPECT_EQ(unpacked(few), faces_of(bricks));
}

/* --- on the device --- */

class view_cubes_drawn : public bare_frame {
  protected:
    void SetUp() override
    {
        bare_frame::SetUp();
        ASSERT_TRUE(cubes_open(&it, &trouble)) << trouble;
        s.lights[0].lit = true;
        s.lights[0].position = {-60, 90, 120};
    }

    void TearDown() override
    {
        cubes_close(&it);
        bare_frame::TearDown();
    }

    std::vector<int> draw()
    {
        begin();
        cubes_draw(it, s, project());
        return end();
    }

    /* Left, right, bottom, top ends of what is drawn. */
    static std::array<int, 4> ends(const std::vector<int> &red)
    {
        std::array<int, 4> e = {width, 0, height, 0};
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++)
                if (at(red, x, y) > 0)
                    e = {std::min(e[0], x), std::max(e[1], x + 1), std::min(e[2], y), std::max(e[3], y + 1)};
        return e;
    }

    static void block(field_fill_piece *piece, key lo, key hi)
    {
        for (int i = lo.i; i <= hi.i; i++)
            for (int j = lo.j; j <= hi.j; j++)
                for (int k = lo.k; k <= hi.k; k++)
                    ASSERT_EQ(clay_write(&piece->it->clay, {i, j, k}, 2, 0xffffffff), STATUS_OK);
        piece->finish();
    }

    void expect_outline(const field_fill_piece &piece, const glm::dvec3 &lo, const glm::dvec3 &hi)
    {
        ASSERT_TRUE(cubes_update(&it, piece.it, SNAPSHOT_STRUCTURE_STORED, &trouble)) << trouble;
        const std::array<int, 4> e = ends(draw());
        const double f = 0.5 * height / std::tan(0.5 * s.field_of_view) / (s.camera_distance - hi.z);
        EXPECT_NEAR(e[0], width / 2.0 + f * lo.x, 1.01);
        EXPECT_NEAR(e[1], width / 2.0 + f * hi.x, 1.01);
        EXPECT_NEAR(e[2], height / 2.0 + f * lo.y, 1.01);
        EXPECT_NEAR(e[3], height / 2.0 + f * hi.y, 1.01);
    }

    cubes it;
};

TEST_F(view_cubes_drawn, stand_where_their_corners_are)
{
    field_fill_piece piece(2000);
    block(&piece, {-9, -3, 0}, {6, 10, 4});
    expect_outline(piece, {-10, -4, -1}, {7, 11, 5}); /* a cube more than there are corners, all round */
    s.step_mm = 0.5;
    expect_outline(piece, {-5, -2, -0.5}, {3.5, 5.5, 2.5});
}

TEST_F(view_cubes_drawn, are_closed_and_show_their_outside_from_every_side)
{
    field_fill_piece piece(2000);
    block(&piece, {-8, -8, -8}, {7, 7, 7});
    ASSERT_TRUE(cubes_update(&it, piece.it, SNAPSHOT_STRUCTURE_STORED, &trouble)) << trouble;
    s.lights = {};
    for (int axis = 0; axis < 3; axis++) {
        for (const double way : {-1.0, 1.0}) {
            const double half = std::sqrt(0.5);
            s.scene_turn = {half, 0, 0, 0};
            s.scene_turn[static_cast<size_t>(axis) + 1] = way * half;
            const std::vector<int> red = draw();
            const std::array<int, 4> e = ends(red);
            EXPECT_GT(e[1] - e[0], 60);
            int holes = 0;
            for (int y = e[2] + 1; y < e[3] - 1; y++)
                for (int x = e[0] + 1; x < e[1] - 1; x++)
                    holes += at(red, x, y) == 0;
            EXPECT_EQ(holes, 0) << axis << " " << way;
        }
    }
}

TEST_F(view_cubes_drawn, follow_the_clay_and_rest_where_nothing_changed)
{
    field_fill_piece piece(2000);
    block(&piece, {0, 0, 0}, {7, 7, 7});
    ASSERT_TRUE(cubes_update(&it, piece.it, SNAPSHOT_STRUCTURE_STORED, &trouble)) << trouble;
    const std::vector<int> first = draw();
    const uint64_t before = it.shown.cubes;
    ASSERT_EQ(clay_write(&piece.it->clay, {12, 0, 0}, 0.1f, 0xffffffff), STATUS_OK);
    ASSERT_TRUE(cubes_update(&it, piece.it, SNAPSHOT_STRUCTURE_STORED, &trouble)) << trouble;
    EXPECT_EQ(it.shown.cubes, before + 8) << "no surface moved, but a corner is stored";
    EXPECT_NE(draw(), first);
    ASSERT_TRUE(cubes_update(&it, piece.it, SNAPSHOT_STRUCTURE_CROSSING, &trouble)) << trouble;
    const uint64_t crossing = it.shown.cubes;
    EXPECT_EQ(crossing, piece.it->surface.crossing);
    it.shown.cubes = 1; /* a mark: an update that makes anything anew wipes it out */
    ASSERT_EQ(clay_write(&piece.it->clay, {12, 3, 0}, 0.1f, 0xffffffff), STATUS_OK);
    ASSERT_TRUE(cubes_update(&it, piece.it, SNAPSHOT_STRUCTURE_CROSSING, &trouble)) << trouble;
    EXPECT_EQ(it.shown.cubes, 1u);
    cubes_clear(&it);
    const std::vector<int> cleared = draw();
    EXPECT_EQ(std::count(cleared.begin(), cleared.end(), 0), width * height);
    ASSERT_TRUE(cubes_update(&it, piece.it, SNAPSHOT_STRUCTURE_CROSSING, &trouble)) << trouble;
    EXPECT_EQ(it.shown.cubes, crossing);
}

} // namespace
