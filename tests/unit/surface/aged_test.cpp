/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a corner has aged when it was dirtied or one of its six neighbours moved, across brick borders and whatever
 *       came and went; every brick whose patch can tell is listed.
 * Method: by hand at a brick's middle and border; then sparse clay, written, painted and removed at random, mostly at
 *         borders, against the same sets gathered corner by corner. */
#include "surface/aged.h"

#include "tests/property/mesh_oracle.h"
#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace {

using key_set = std::set<key, mesh_oracle_less>;

class aged_round : public testing::Test {
protected:
    void SetUp() override
    {
        ASSERT_EQ(clay_init(&c, 100), STATUS_OK);
        ASSERT_EQ(aged_init(&a, 500), STATUS_OK);
    }
    void TearDown() override
    {
        aged_finish(&a);
        clay_finish(&c);
    }
    void write(key at, float potential)
    {
        ASSERT_EQ(clay_write(&c, at, potential, 9), STATUS_OK);
        dirtied.insert(at);
        moved.insert(at);
    }
    /* Dirties a stored brick's corner that does not move. */
    void paint(key at)
    {
        const uint32_t id = clay_find(&c, key_brick(at));
        ASSERT_NE(id, POOL_NONE);
        clay_written now = {};
        now.inside = clay_brick(&c, id)->inside;
        now.stored = clay_brick(&c, id)->stored;
        brick_mask_set(&now.dirtied, key_slot(at));
        clay_brick_settle(&c, id, &now);
        dirtied.insert(at);
    }
    void forget()
    {
        dirt_clear(&c.dirty);
        dirtied.clear();
        moved.clear();
    }
    key_set wanted() const
    {
        const std::vector<key> round = mesh_oracle_with_six({moved.begin(), moved.end()});
        key_set all = dirtied;
        all.insert(round.begin(), round.end());
        return all;
    }
    bool is_listed(key brick_at) const
    {
        const uint32_t id = clay_find(&c, brick_at);
        return id != POOL_NONE ? aged_of(&a, id) != nullptr : avl_find(&a.absent, brick_at) != POOL_NONE;
    }
    /* Asks for the corners of every stored brick; only those listed have any. */
    void find_corners()
    {
        avl_walk w;
        key at;
        uint32_t id;
        for (bool more = avl_first(&w, &c.tree, &at, &id); more; more = avl_next(&w, &at, &id))
            aged_want(&a, id);
        for (uint32_t n = 0; n < aged_count(&a); n++)
            aged_corners(&a, &c, n);
    }
    void expect_corners()
    {
        const key_set all = wanted();
        find_corners();
        avl_walk w;
        key at;
        uint32_t id;
        for (bool more = avl_first(&w, &c.tree, &at, &id); more; more = avl_next(&w, &at, &id)) {
            const aged_brick *e = aged_of(&a, id);
            for (int n = 0; n < BRICK_CORNERS && e; n++) {
                const key corner = key_add(key_of_brick(at), n >> 6, n >> 3 & 7, n & 7);
                ASSERT_EQ(brick_mask_has(&e->corners, n), all.count(corner) == 1)
                    << corner.i << ' ' << corner.j << ' ' << corner.k;
            }
        }
    }
    void expect_entries()
    {
        key_set seen;
        for (uint32_t n = 0; n < aged_count(&a); n++) {
            const aged_brick *e = aged_at(&a, n);
            ASSERT_TRUE(seen.insert(e->at).second) << "listed twice";
            ASSERT_EQ(e->brick_id, clay_find(&c, e->at));
            ASSERT_TRUE(e->brick_id != POOL_NONE || brick_mask_count(&e->corners) == BRICK_CORNERS);
        }
    }

    clay c = {};
    aged a = {};
    key_set dirtied, moved;
};

/* The bricks whose patches reach this corner: theirs are corners 0..8 along each axis. */
std::vector<key> seers(key corner)
{
    std::vector<key> all;
    for (int n = 0; n < 8; n++)
        if ((!(n & 4) || (corner.i & 7) == 0) && (!(n & 2) || (corner.j & 7) == 0) && (!(n & 1) || (corner.k & 7) == 0))
            all.push_back(key_add(key_brick(corner), -(n >> 2), -(n >> 1 & 1), -(n & 1)));
    return all;
}

bool is_inside(const clay *c, key at) { return clay_read(c, at, nullptr) >= POTENTIAL_ISO; }

/* --- by hand --- */

TEST_F(aged_round, without_dirt_lists_nothing)
{
    write({3, 3, 3}, 2);
    forget();
    ASSERT_EQ(aged_mark(&a, &c, false), STATUS_OK);
    EXPECT_EQ(aged_count(&a), 0u);
    EXPECT_EQ(aged_of(&a, clay_find(&c, {0, 0, 0})), nullptr);
}

TEST_F(aged_round, a_corner_that_moved_ages_itself_and_its_six)
{
    write({3, 4, 5}, 1);
    ASSERT_EQ(aged_mark(&a, &c, false), STATUS_OK);
    const uint32_t id = clay_find(&c, {0, 0, 0});
    find_corners();
    ASSERT_NE(aged_of(&a, id), nullptr);
    EXPECT_EQ(brick_mask_count(&aged_of(&a, id)->corners), 7u);
    expect_corners();
}

TEST_F(aged_round, a_painted_corner_ages_itself)
{
    write({3, 4, 5}, 1);
    forget();
    paint({3, 4, 5});
    ASSERT_EQ(aged_mark(&a, &c, false), STATUS_OK);
    const uint32_t id = clay_find(&c, {0, 0, 0});
    find_corners();
    ASSERT_NE(aged_of(&a, id), nullptr);
    EXPECT_EQ(brick_mask_count(&aged_of(&a, id)->corners), 1u);
    expect_corners();
}

/* Six bricks round one, each with the corner that lies against the middle one's. */
TEST_F(aged_round, corners_age_across_each_face)
{
    for (int axis = 0; axis < 3; axis++)
        for (int by : {-1, 1}) {
            clay_clear(&c);
            forget();
            const key from = mesh_oracle_step({3, 3, 3}, axis, by > 0 ? 4 : -3), to = mesh_oracle_step(from, axis, by);
            ASSERT_FALSE(key_equal(key_brick(from), key_brick(to)));
            write(from, 1);
            write(to, 1);
            forget();
            write(from, 2);
            ASSERT_EQ(aged_mark(&a, &c, false), STATUS_OK);
            const uint32_t id = clay_find(&c, key_brick(to));
            find_corners();
            ASSERT_NE(aged_of(&a, id), nullptr);
            EXPECT_EQ(brick_mask_count(&aged_of(&a, id)->corners), 1u);
            ASSERT_NO_FATAL_FAILURE(expect_corners());
        }
}

TEST_F(aged_round, a_brick_that_went_ages_those_beside_it)
{
    write({8, 3, 3}, 2);
    write({7, 3, 3}, 2);
    forget();
    write({7, 3, 3}, 0);
    ASSERT_EQ(clay_find(&c, {0, 0, 0}), POOL_NONE);
    ASSERT_EQ(aged_mark(&a, &c, false), STATUS_OK);
    EXPECT_TRUE(is_listed({0, 0, 0})) << "its patch may have to go";
    EXPECT_TRUE(is_listed({1, 0, 0}));
    expect_corners();
    expect_entries();
}

/* The brick in the middle is not stored, yet has a patch: between its corner 7,3,0 and the clay above. That corner's
   gradient is another when 7,3,-1 moves. */
TEST_F(aged_round, a_patch_of_no_brick_is_listed_when_a_corner_under_it_moves)
{
    for (int n = 0; n < 6; n++) {
        const int up = n / 2, under = (up + 1 + n % 2) % 3;
        clay_clear(&c);
        forget();
        const key base = {3, 3, 3}, edge = mesh_oracle_step(mesh_oracle_step(base, up, 4), under, -3);
        write(mesh_oracle_step(edge, up, 1), 3);
        write(mesh_oracle_step(edge, under, -1), 0.5f);
        ASSERT_EQ(clay_find(&c, {0, 0, 0}), POOL_NONE);
        forget();
        write(mesh_oracle_step(edge, under, -1), 1.2f);
        ASSERT_EQ(aged_mark(&a, &c, true), STATUS_OK);
        EXPECT_TRUE(is_listed({0, 0, 0})) << "clay above along axis " << up << ", moved below along axis " << under;
    }
}

TEST_F(aged_round, beyond_the_limit_is_refused)
{
    aged few = {};
    ASSERT_EQ(aged_init(&few, 2), STATUS_OK);
    for (int n = 0; n < 3; n++)
        write({8 * n + 3, 3, 3}, 1);
    EXPECT_EQ(aged_mark(&few, &c, false), STATUS_POOL_FULL);
    clay_clear(&c);
    write({3, 3, 3}, 1);
    EXPECT_EQ(aged_mark(&few, &c, false), STATUS_OK) << "a refusal spoils nothing";
    EXPECT_EQ(aged_count(&few), 1u);
    aged_finish(&few);
}

TEST(aged, zeroed_can_be_finished)
{
    aged a = {};
    aged_finish(&a);
    EXPECT_EQ(a.link, nullptr);
}

/* --- at random --- */

/* Three bricks an axis, mostly their borders. */
int32_t choose_coordinate(seeded &chance)
{
    static const int32_t borders[] = {-8, -7, -2, -1, 0, 1, 6, 7, 8, 9, 15};
    return seeded_chance(chance, 0.7) ? borders[seeded_int(chance, 0, 10)]
                                      : static_cast<int32_t>(seeded_int(chance, -8, 15));
}

class aged_at_random : public aged_round, public testing::WithParamInterface<uint64_t> {
protected:
    key choose_corner()
    {
        const int32_t i = choose_coordinate(chance), j = choose_coordinate(chance), k = choose_coordinate(chance);
        return {i, j, k};
    }
    void clear_brick(key brick_at)
    {
        for (int n = 0; n < BRICK_CORNERS; n++) {
            const key corner = key_add(key_of_brick(brick_at), n >> 6, n >> 3 & 7, n & 7);
            if (clay_read(&c, corner, nullptr) > POTENTIAL_MIN)
                write(corner, 0);
        }
    }
    void edit()
    {
        const key at = choose_corner();
        const int64_t kind = seeded_int(chance, 0, 9);
        if (kind == 0)
            clear_brick(key_brick(at));
        else if (kind <= 3 && clay_find(&c, key_brick(at)) != POOL_NONE)
            paint(at);
        else
            write(at, kind <= 5 ? 0.0f : kind <= 7 ? 2.0f : static_cast<float>(seeded_real(chance, 0, 3)));
    }
    /* What was before, some edits, and what they aged. */
    void next_round()
    {
        forget();
        if (was.bricks.limit > 0)
            clay_finish(&was);
        ASSERT_EQ(clay_init(&was, 100), STATUS_OK);
        ASSERT_EQ(clay_copy(&was, &c), STATUS_OK);
        for (int64_t n = seeded_int(chance, 1, 6); n > 0; n--)
            edit();
        ASSERT_EQ(aged_mark(&a, &c, true), STATUS_OK);
    }
    void TearDown() override
    {
        clay_finish(&was);
        aged_round::TearDown();
    }
    clay was = {};
    seeded chance = {GetParam()};
};

TEST_P(aged_at_random, corners_are_those_dirtied_and_those_beside_one_that_moved)
{
    uint64_t gone = 0;
    for (int n = 0; n < seeded_steps(400); n++) {
        ASSERT_NO_FATAL_FAILURE(next_round());
        ASSERT_NO_FATAL_FAILURE(expect_corners()) << n;
        ASSERT_NO_FATAL_FAILURE(expect_entries()) << n;
        for (uint32_t e = 0; e < dirt_count(&c.dirty); e++)
            gone += dirt_at(&c.dirty, e)->brick_id == POOL_NONE;
    }
    EXPECT_GT(gone, 50u) << "no brick went";
}

TEST_P(aged_at_random, stored_bricks_that_see_an_aged_corner_are_listed)
{
    for (int n = 0; n < seeded_steps(400); n++) {
        ASSERT_NO_FATAL_FAILURE(next_round());
        for (const key &corner : wanted())
            for (const key &brick_at : seers(corner))
                ASSERT_TRUE(clay_find(&c, brick_at) == POOL_NONE || is_listed(brick_at))
                    << n << ": brick " << brick_at.i << ' ' << brick_at.j << ' ' << brick_at.k;
    }
}

/* Of the bricks that are not stored those count whose patch has, or had, a vertex at an aged corner. */
TEST_P(aged_at_random, patches_of_no_brick_are_listed_where_their_vertices_age)
{
    uint64_t patches = 0;
    for (int n = 0; n < seeded_steps(400); n++) {
        ASSERT_NO_FATAL_FAILURE(next_round());
        for (const key &corner : wanted())
            for (int side = 0; side < 6; side++) {
                const key other = mesh_oracle_step(corner, side / 2, side % 2 ? 1 : -1);
                if (is_inside(&c, corner) == is_inside(&c, other) && is_inside(&was, corner) == is_inside(&was, other))
                    continue;
                const std::vector<key> others = seers(other);
                const key_set there(others.begin(), others.end());
                for (const key &brick_at : seers(corner)) {
                    if (there.count(brick_at) == 0 || clay_find(&c, brick_at) != POOL_NONE)
                        continue;
                    patches++;
                    ASSERT_TRUE(is_listed(brick_at))
                        << n << ": brick " << brick_at.i << ' ' << brick_at.j << ' ' << brick_at.k << " by corner "
                        << corner.i << ' ' << corner.j << ' ' << corner.k;
                }
            }
    }
    EXPECT_GT(patches, 100u);
}

INSTANTIATE_TEST_SUITE_P(seeds, aged_at_random, testing::Values(1u, 2u, 3u));

} // namespace
