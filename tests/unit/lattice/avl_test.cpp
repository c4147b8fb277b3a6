/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the tree finds what was put in, refuses what it should, and its validator sees every kind of damage.
 * Method: the four rotations and the three removals by hand; damage done to the nodes on purpose. Long random runs
 *         against std::map are in tests/property/avl_test.cpp. */
#include "lattice/avl.h"

#include <gtest/gtest.h>

#include <vector>

namespace {

class avl_tree : public testing::Test {
protected:
    void SetUp() override { ASSERT_EQ(avl_init(&t, 100), STATUS_OK); }
    void TearDown() override { avl_finish(&t); }

    void insert(const std::vector<int> &all)
    {
        for (int i : all)
            ASSERT_EQ(avl_insert(&t, {i, -i, 0}, static_cast<uint32_t>(i + 1000)), STATUS_OK);
    }
    avl_node *node(int i)
    {
        for (uint32_t id = 0; id < t.nodes.fresh; id++) {
            avl_node *n = static_cast<avl_node *>(pool_at(&t.nodes, id));
            if (n->at.i == i && n->height > 0)
                return n;
        }
        return nullptr;
    }
    int root() { return static_cast<avl_node *>(pool_at(&t.nodes, t.root))->at.i; }
    void expect_walk(const std::vector<int> &wanted)
    {
        avl_walk w;
        key k;
        uint32_t value;
        std::vector<int> seen;
        for (bool more = avl_first(&w, &t, &k, &value); more; more = avl_next(&w, &k, &value)) {
            EXPECT_EQ(k.j, -k.i);
            EXPECT_EQ(value, static_cast<uint32_t>(k.i + 1000));
            seen.push_back(k.i);
        }
        EXPECT_FALSE(avl_next(&w, &k, &value)) << "the end stays the end";
        EXPECT_EQ(seen, wanted);
    }
    avl t;
};

TEST_F(avl_tree, empty_holds_nothing)
{
    EXPECT_EQ(avl_count(&t), 0u);
    EXPECT_EQ(avl_height(&t), 0);
    EXPECT_EQ(avl_find(&t, {0, 0, 0}), POOL_NONE);
    EXPECT_EQ(avl_remove(&t, {0, 0, 0}), POOL_NONE);
    EXPECT_TRUE(avl_is_valid(&t));
    expect_walk({});
}

TEST_F(avl_tree, three_in_every_order_stand_balanced)
{
    const std::vector<std::vector<int>> orders = {{1, 2, 3}, {3, 2, 1}, {1, 3, 2}, {3, 1, 2}, {2, 1, 3}, {2, 3, 1}};
    for (const std::vector<int> &order : orders) {
        avl_clear(&t);
        insert(order);
        EXPECT_EQ(root(), 2);
        EXPECT_EQ(avl_height(&t), 2);
        EXPECT_TRUE(avl_is_valid(&t));
        expect_walk({1, 2, 3});
    }
}

TEST_F(avl_tree, ascending_gives_the_lowest_height)
{
    for (int n = 1; n <= 63; n++) {
        insert({n});
        int perfect = 0;
        while ((1 << perfect) - 1 < n)
            perfect++;
        ASSERT_EQ(avl_height(&t), perfect) << n;
        ASSERT_TRUE(avl_is_valid(&t));
    }
}

TEST_F(avl_tree, removes_leaf_one_child_two_children_and_root)
{
    insert({8, 4, 12, 2, 6, 10, 14, 1, 5});
    EXPECT_EQ(avl_remove(&t, {1, -1, 0}), 1001u);  /* leaf */
    EXPECT_EQ(avl_remove(&t, {6, -6, 0}), 1006u);  /* one child */
    EXPECT_EQ(avl_remove(&t, {12, -12, 0}), 1012u); /* two */
    EXPECT_EQ(avl_remove(&t, {8, -8, 0}), 1008u);  /* the root */
    EXPECT_TRUE(avl_is_valid(&t));
    EXPECT_EQ(avl_remove(&t, {8, -8, 0}), POOL_NONE);
    EXPECT_EQ(avl_find(&t, {8, -8, 0}), POOL_NONE);
    EXPECT_EQ(avl_find(&t, {10, -10, 0}), 1010u);
    expect_walk({2, 4, 5, 10, 14});
}

TEST_F(avl_tree, a_removal_can_shorten_every_level)
{
    /* The sparsest tree of height 5 (a Fibonacci tree): taking from its thin side rotates twice. */
    insert({8, 5, 11, 3, 7, 10, 12, 2, 4, 6, 9, 1});
    ASSERT_EQ(avl_height(&t), 5);
    ASSERT_TRUE(avl_is_valid(&t));
    EXPECT_EQ(avl_remove(&t, {12, -12, 0}), 1012u);
    EXPECT_TRUE(avl_is_valid(&t));
    EXPECT_EQ(avl_height(&t), 4);
    expect_walk({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
}

TEST_F(avl_tree, full_is_refused_and_nothing_changes)
{
    for (int n = 0; n < 100; n++)
        insert({n});
    EXPECT_EQ(avl_insert(&t, {100, -100, 0}, 1), STATUS_POOL_FULL);
    EXPECT_EQ(avl_count(&t), 100u);
    EXPECT_EQ(avl_find(&t, {100, -100, 0}), POOL_NONE);
    EXPECT_TRUE(avl_is_valid(&t));
    EXPECT_EQ(avl_remove(&t, {50, -50, 0}), 1050u);
    EXPECT_EQ(avl_insert(&t, {100, -100, 0}, 1100), STATUS_OK);
    EXPECT_TRUE(avl_is_valid(&t));
}

TEST_F(avl_tree, clear_empties)
{
    insert({1, 2, 3});
    avl_clear(&t);
    EXPECT_EQ(avl_count(&t), 0u);
    EXPECT_EQ(avl_find(&t, {1, -1, 0}), POOL_NONE);
    insert({5});
    expect_walk({5});
}

TEST_F(avl_tree, seek_begins_at_the_first_key_that_is_not_smaller)
{
    avl_walk w;
    key k;
    uint32_t value;
    EXPECT_FALSE(avl_seek(&w, &t, {0, 0, 0}, &k, &value)) << "nothing in it";
    insert({8, 4, 12, 2, 6, 10, 14, 16, 18, 20, 22});
    for (int from = 1; from <= 24; from++)
        for (int dj = -1; dj <= 1; dj++) { /* just before that key, that key itself, just after it */
            std::vector<int> wanted, seen;
            for (int at = 2; at <= 22; at += 2)
                if (at > from || (at == from && dj <= 0))
                    wanted.push_back(at);
            const key begin = {from, -from + dj, 0};
            for (bool more = avl_seek(&w, &t, begin, &k, &value); more; more = avl_next(&w, &k, &value)) {
                ASSERT_EQ(value, static_cast<uint32_t>(k.i + 1000));
                seen.push_back(k.i);
            }
            ASSERT_EQ(seen, wanted) << from << ' ' << dj;
            ASSERT_FALSE(avl_next(&w, &k, &value)) << "the end stays the end";
        }
}

TEST_F(avl_tree, seek_orders_by_i_then_j_then_k)
{
    const std::vector<key> all = {{-1, 5, 5}, {0, -3, 9}, {0, 0, -2}, {0, 0, 0}, {0, 0, 7}, {0, 1, -8}, {2, -9, -9}};
    for (size_t n = 0; n < all.size(); n++)
        ASSERT_EQ(avl_insert(&t, all[n], static_cast<uint32_t>(n)), STATUS_OK);
    for (int i = -2; i <= 3; i++)
        for (int j = -10; j <= 6; j++)
            for (int k = -10; k <= 10; k++) {
                size_t wanted = 0;
                while (wanted < all.size() && key_compare(all[wanted], {i, j, k}) < 0)
                    wanted++;
                avl_walk w;
                key at = {77, 77, 77};
                uint32_t value = 77;
                ASSERT_EQ(avl_seek(&w, &t, {i, j, k}, &at, &value), wanted < all.size());
                if (wanted < all.size()) {
                    ASSERT_EQ(value, wanted) << i << ' ' << j << ' ' << k;
                    ASSERT_TRUE(key_equal(at, all[wanted]));
                }
            }
}

TEST_F(avl_tree, duplicate_is_a_tree_of_its_own)
{
    insert({5, 3, 8, 1, 4, 7, 9});
    avl copy;
    ASSERT_EQ(avl_copy(&copy, &t), STATUS_OK);
    EXPECT_EQ(avl_count(&copy), 7u);
    EXPECT_NE(avl_remove(&copy, {5, -5, 0}), POOL_NONE);
    EXPECT_EQ(avl_find(&copy, {5, -5, 0}), POOL_NONE);
    EXPECT_NE(avl_find(&t, {5, -5, 0}), POOL_NONE);
    EXPECT_TRUE(avl_is_valid(&copy));
    EXPECT_TRUE(avl_is_valid(&t));
    avl_finish(&copy);
}

TEST_F(avl_tree, validator_sees_disorder)
{
    insert({1, 2, 3});
    node(1)->at.i = 4;
    EXPECT_FALSE(avl_is_valid(&t));
}

TEST_F(avl_tree, validator_sees_a_wrong_height)
{
    insert({1, 2, 3, 4});
    node(4)->height = 2;
    EXPECT_FALSE(avl_is_valid(&t));
}

TEST_F(avl_tree, validator_sees_a_lean)
{
    insert({2, 1, 3, 4});
    /* Cut 1 away and hang it, in order and with right heights, so that only the balance is wrong. */
    avl_node *two = node(2);
    const uint32_t one = two->child[0];
    two->child[0] = POOL_NONE;
    static_cast<avl_node *>(pool_at(&t.nodes, one))->at = {9, -9, 0};
    avl_node *four = node(4);
    four->child[1] = one;
    four->height = 2;
    node(3)->height = 3;
    two->height = 4;
    EXPECT_FALSE(avl_is_valid(&t));
}

TEST_F(avl_tree, validator_sees_a_lost_node)
{
    insert({1, 2, 3});
    node(2)->child[0] = POOL_NONE;
    EXPECT_FALSE(avl_is_valid(&t));
}

TEST_F(avl_tree, doubled_keys_and_no_value_are_our_bugs)
{
    insert({1});
    EXPECT_DEATH(EXPECT_EQ(avl_insert(&t, {1, -1, 0}, 7), STATUS_OK), "");
    EXPECT_DEATH(EXPECT_EQ(avl_insert(&t, {2, -2, 0}, POOL_NONE), STATUS_OK), "");
}

} // namespace
