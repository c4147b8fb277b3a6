/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: over any sequence of inserts and removes the tree holds what a sorted map holds, in the same order, and is
 *       never higher than Adelson-Velsky and Landis allow.
 * Method: thousands of seeded steps that first grow, then churn, then shrink; orders that are hard on trees; every
 *         answer compared with std::map, the height with its bound after every step, all invariants at intervals. */
#include "lattice/avl.h"

#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

namespace {

using tuple_key = std::tuple<int32_t, int32_t, int32_t>;
using reference = std::map<tuple_key, uint32_t>;

tuple_key tuple_of(key k) { return {k.i, k.j, k.k}; }

double height_max(uint32_t n) { return 1.4405 * std::log2(n + 2.0) - 0.328 + 1e-3; }

void expect_same(const avl &t, const reference &r)
{
    ASSERT_TRUE(avl_is_valid(&t));
    ASSERT_EQ(avl_count(&t), r.size());
    avl_walk w;
    key k;
    uint32_t value;
    auto at = r.begin();
    for (bool more = avl_first(&w, &t, &k, &value); more; more = avl_next(&w, &k, &value), ++at) {
        ASSERT_NE(at, r.end());
        ASSERT_EQ(at->first, tuple_of(k));
        ASSERT_EQ(at->second, value);
    }
    ASSERT_EQ(at, r.end());
}

void step(avl &t, reference &r, key k, bool insert, uint32_t value)
{
    const auto at = r.find(tuple_of(k));
    ASSERT_EQ(avl_find(&t, k), at == r.end() ? POOL_NONE : at->second);
    if (insert && at == r.end()) {
        ASSERT_EQ(avl_insert(&t, k, value), STATUS_OK);
        r[tuple_of(k)] = value;
    } else if (!insert) {
        ASSERT_EQ(avl_remove(&t, k), at == r.end() ? POOL_NONE : at->second);
        if (at != r.end())
            r.erase(at);
    }
    ASSERT_LE(avl_height(&t), height_max(avl_count(&t)));
}

void run(uint64_t seed, int reach, int steps)
{
    seeded chance = {seed};
    avl t;
    reference r;
    ASSERT_EQ(avl_init(&t, 1u << 20), STATUS_OK);
    for (double inserts : {0.9, 0.5, 0.1})
        for (int n = 0; n < steps; n++) {
            step(t, r, seeded_key(chance, -reach, reach), seeded_chance(chance, inserts), static_cast<uint32_t>(n));
            if (n % 500 == 0)
                expect_same(t, r);
            if (testing::Test::HasFatalFailure())
                break;
        }
    expect_same(t, r);
    while (!r.empty() && !testing::Test::HasFatalFailure()) {
        const auto [i, j, k] = r.begin()->first;
        step(t, r, {i, j, k}, false, 0);
    }
    EXPECT_EQ(avl_height(&t), 0);
    avl_finish(&t);
}

TEST(avl_property, is_a_sorted_map_dense_keys)
{
    for (uint64_t seed = 1; seed <= 5; seed++)
        run(seed, 3, seeded_steps(4000)); /* 343 keys: meets every removal case again and again */
}

TEST(avl_property, is_a_sorted_map_sparse_keys)
{
    for (uint64_t seed = 11; seed <= 13; seed++)
        run(seed, 30, seeded_steps(8000));
}

/* Orders in which a tree that forgot to rotate grows into a list. */
TEST(avl_property, hard_orders_stay_low)
{
    const int total = 20000;
    for (int order = 0; order < 4; order++) {
        avl t;
        ASSERT_EQ(avl_init(&t, total), STATUS_OK);
        for (int n = 0; n < total; n++) {
            const int zigzag = n % 2 ? n : 2 * total - n;
            const int outwards = n % 2 ? total + 1 + n / 2 : total - n / 2;
            const int i = order == 0 ? n : order == 1 ? -n : order == 2 ? zigzag : outwards;
            ASSERT_EQ(avl_insert(&t, {0, i, 0}, 1), STATUS_OK);
            ASSERT_LE(avl_height(&t), height_max(avl_count(&t)));
        }
        ASSERT_TRUE(avl_is_valid(&t));
        avl_finish(&t);
    }
}

} // namespace
