/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a pool hands out items that never overlap and never move, no more than its limit, and takes them back in any
 *       order.
 * Method: every capacity from 1 to 64 with several sizes of item: a phase that mostly takes, one that mostly gives,
 *         every byte of a taken item filled with a sentinel that is checked before it goes back. Reserving is judged by
 *         pool_bytes: takes after it open no slab. */
#include "lattice/pool.h"

#include "tests/property/seeded.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <map>
#include <vector>

namespace {

struct taken {
    unsigned char *place;
    unsigned char sentinel;
};

struct model {
    pool p;
    size_t bytes;
    std::map<uint32_t, taken> live;
    std::vector<uint32_t> order; /* of live ids, arbitrary */
};

bool is_filled(const taken &t, size_t bytes)
{
    for (size_t n = 0; n < bytes; n++)
        if (t.place[n] != t.sentinel)
            return false;
    return true;
}

void take_one(model &m, seeded &chance)
{
    uint32_t id = 12345;
    const status s = pool_take(&m.p, &id);
    if (m.live.size() == m.p.limit) {
        ASSERT_EQ(s, STATUS_POOL_FULL);
        ASSERT_EQ(id, 12345u) << "a refused take wrote an id";
        return;
    }
    ASSERT_EQ(s, STATUS_OK);
    ASSERT_LT(id, m.p.limit);
    ASSERT_EQ(m.live.count(id), 0u) << "handed out twice";
    taken t = {static_cast<unsigned char *>(pool_at(&m.p, id)), static_cast<unsigned char>(seeded_bits(chance))};
    ASSERT_EQ(reinterpret_cast<uintptr_t>(t.place) % 8, 0u);
    std::memset(t.place, t.sentinel, m.bytes);
    m.live[id] = t;
    m.order.push_back(id);
}

void give_one(model &m, seeded &chance)
{
    if (m.order.empty())
        return;
    const size_t n = static_cast<size_t>(seeded_int(chance, 0, static_cast<int64_t>(m.order.size()) - 1));
    const uint32_t id = m.order[n];
    ASSERT_EQ(pool_at(&m.p, id), m.live[id].place) << "moved";
    ASSERT_TRUE(is_filled(m.live[id], m.bytes)) << "another item wrote into this one";
    pool_give(&m.p, id);
    m.live.erase(id);
    m.order[n] = m.order.back();
    m.order.pop_back();
}

void expect_all_filled(const model &m)
{
    ASSERT_EQ(m.p.count, m.live.size());
    ASSERT_EQ(pool_room(&m.p), m.p.limit - m.live.size());
    for (const auto &[id, t] : m.live)
        ASSERT_TRUE(is_filled(t, m.bytes)) << id;
}

void exercise(uint32_t limit, size_t bytes, uint64_t seed)
{
    seeded chance = {seed};
    model m = {};
    m.bytes = bytes;
    ASSERT_EQ(pool_init(&m.p, bytes, limit), STATUS_OK);
    for (int round = 0; round < 3; round++)
        for (double heavy : {0.8, 0.2}) {
            for (uint32_t n = 0; n < 4 * limit + 8; n++) {
                if (seeded_chance(chance, heavy))
                    take_one(m, chance);
                else
                    give_one(m, chance);
                if (testing::Test::HasFatalFailure())
                    return;
            }
            expect_all_filled(m);
        }
    while (m.live.size() < limit)
        take_one(m, chance);
    take_one(m, chance); /* one beyond */
    expect_all_filled(m);
    while (!m.order.empty())
        give_one(m, chance);
    EXPECT_EQ(m.p.count, 0u);
    pool_finish(&m.p);
}

TEST(pool, of_every_small_capacity_keeps_items_apart)
{
    for (uint32_t limit = 1; limit <= 64; limit++)
        for (size_t bytes : {4u, 5u, 12u, 64u, 100u}) {
            SCOPED_TRACE(testing::Message() << limit << " items of " << bytes);
            exercise(limit, bytes, limit * 1000 + bytes);
            ASSERT_FALSE(HasFatalFailure());
        }
}

TEST(pool, of_many_slabs_keeps_items_apart)
{
    exercise(201, 4096, 7);      /* 64 pages a slab, the last slab short */
    exercise(3, 300 * 1024, 8);  /* an item larger than the slab's target */
    exercise(70001, 4, 9);
}

TEST(pool, limit_is_exact_and_a_refusal_changes_nothing)
{
    pool p;
    ASSERT_EQ(pool_init(&p, 16, 10), STATUS_OK);
    uint32_t id;
    for (uint32_t n = 0; n < 10; n++)
        ASSERT_EQ(pool_take(&p, &id), STATUS_OK);
    for (int n = 0; n < 3; n++)
        EXPECT_EQ(pool_take(&p, &id), STATUS_POOL_FULL);
    EXPECT_EQ(p.count, 10u);
    EXPECT_EQ(pool_room(&p), 0u);
    pool_give(&p, 4);
    ASSERT_EQ(pool_take(&p, &id), STATUS_OK);
    EXPECT_EQ(id, 4u) << "the stack is last in, first out";
    pool_finish(&p);
}

TEST(pool, opens_slabs_only_when_needed_and_keeps_them)
{
    pool p;
    ASSERT_EQ(pool_init(&p, 4096, 1000), STATUS_OK);
    EXPECT_EQ(pool_bytes(&p), 0u);
    uint32_t id;
    ASSERT_EQ(pool_take(&p, &id), STATUS_OK);
    const size_t one = pool_bytes(&p);
    EXPECT_GE(one, 4096u);
    EXPECT_LE(one, 1024u * 1024u);
    pool_clear(&p);
    EXPECT_EQ(pool_bytes(&p), one);
    EXPECT_EQ(p.count, 0u);
    ASSERT_EQ(pool_take(&p, &id), STATUS_OK);
    EXPECT_EQ(id, 0u) << "cleared: lowest id first";
    EXPECT_EQ(pool_bytes(&p), one);
    pool_finish(&p);
}

/* Reserves, takes that many, and sees that no take had to ask for memory. */
void expect_reserved(pool &p, uint32_t more)
{
    ASSERT_EQ(pool_reserve(&p, more), STATUS_OK);
    const size_t held = pool_bytes(&p);
    for (uint32_t n = 0; n < more; n++) {
        uint32_t id;
        ASSERT_EQ(pool_take(&p, &id), STATUS_OK);
        ASSERT_EQ(pool_bytes(&p), held) << "take " << n << " of " << more << " opened a slab";
    }
}

TEST(pool, what_is_reserved_is_taken_without_asking_the_machine)
{
    for (uint32_t before : {0u, 1u, 63u, 64u, 65u, 130u})
        for (uint32_t more : {0u, 1u, 62u, 63u, 64u, 65u, 128u, 200u, 300u}) {
            SCOPED_TRACE(testing::Message() << before << " taken, " << more << " more");
            pool p;
            uint32_t id;
            ASSERT_EQ(pool_init(&p, 4096, 1000), STATUS_OK); /* 64 a slab */
            for (uint32_t n = 0; n < before; n++)
                ASSERT_EQ(pool_take(&p, &id), STATUS_OK);
            expect_reserved(p, more);
            pool_finish(&p);
        }
}

TEST(pool, reserving_counts_what_was_given_back)
{
    seeded chance = {5};
    pool p;
    ASSERT_EQ(pool_init(&p, 4096, 500), STATUS_OK);
    std::vector<uint32_t> live(200);
    for (uint32_t &id : live)
        ASSERT_EQ(pool_take(&p, &id), STATUS_OK);
    const size_t held = pool_bytes(&p);
    for (int n = 0; n < 50; n++) {
        const size_t which = static_cast<size_t>(seeded_int(chance, 0, static_cast<int64_t>(live.size()) - 1));
        pool_give(&p, live[which]);
        live[which] = live.back();
        live.pop_back();
    }
    ASSERT_EQ(pool_reserve(&p, 50), STATUS_OK);
    EXPECT_EQ(pool_bytes(&p), held) << "fifty lie ready";
    expect_reserved(p, 130); /* those, and more than the slab begun has */
    EXPECT_GT(pool_bytes(&p), held);
    pool_finish(&p);
}

TEST(pool, reserving_takes_nothing_and_asks_for_no_more_than_it_was_told)
{
    pool p;
    ASSERT_EQ(pool_init(&p, 4096, 1000), STATUS_OK);
    ASSERT_EQ(pool_reserve(&p, 0), STATUS_OK);
    EXPECT_EQ(pool_bytes(&p), 0u);
    ASSERT_EQ(pool_reserve(&p, 1), STATUS_OK);
    const size_t one = pool_bytes(&p);
    EXPECT_GT(one, 0u);
    ASSERT_EQ(pool_reserve(&p, 1), STATUS_OK);
    EXPECT_EQ(pool_bytes(&p), one);
    EXPECT_EQ(p.count, 0u);
    EXPECT_EQ(pool_room(&p), 1000u);
    pool_clear(&p);
    expect_reserved(p, 64);
    EXPECT_EQ(pool_bytes(&p), one) << "what was open before the clearing still is";
    pool_finish(&p);
}

TEST(pool, cannot_reserve_beyond_the_limit)
{
    pool p;
    ASSERT_EQ(pool_init(&p, 4096, 100), STATUS_OK);
    EXPECT_EQ(pool_reserve(&p, 101), STATUS_POOL_FULL);
    EXPECT_EQ(pool_reserve(&p, UINT32_MAX), STATUS_POOL_FULL);
    EXPECT_EQ(pool_bytes(&p), 0u) << "a refusal changes nothing";
    expect_reserved(p, 60);
    EXPECT_EQ(pool_reserve(&p, 41), STATUS_POOL_FULL);
    expect_reserved(p, 40);
    EXPECT_EQ(pool_reserve(&p, 1), STATUS_POOL_FULL);
    EXPECT_EQ(pool_reserve(&p, 0), STATUS_OK);
    pool_finish(&p);
}

TEST(pool, slabs_are_aligned_for_vectors)
{
    pool p;
    ASSERT_EQ(pool_init(&p, 4096, 200), STATUS_OK);
    for (int n = 0; n < 200; n++) {
        uint32_t id;
        ASSERT_EQ(pool_take(&p, &id), STATUS_OK);
        EXPECT_EQ(reinterpret_cast<uintptr_t>(pool_at(&p, id)) % 64, 0u);
    }
    pool_finish(&p);
}

TEST(pool, zeroed_can_be_finished)
{
    pool p = {};
    pool_finish(&p);
    EXPECT_EQ(p.slabs, nullptr);
}

TEST(pool, duplicate_goes_on_where_the_first_one_stood)
{
    for (const uint32_t taken : {0u, 1u, 3u, 64u, 200u}) {
        pool p, copy;
        ASSERT_EQ(pool_init(&p, 4096, 200), STATUS_OK);
        for (uint32_t n = 0; n < taken; n++) {
            uint32_t id;
            ASSERT_EQ(pool_take(&p, &id), STATUS_OK);
            std::memset(pool_at(&p, id), static_cast<int>(id + 1), 4096);
        }
        for (uint32_t id = 1; id < taken; id += 2)
            pool_give(&p, id);
        ASSERT_EQ(pool_copy(&copy, &p), STATUS_OK);
        EXPECT_EQ(copy.count, p.count);
        for (uint32_t id = 0; id < taken; id += 2) {
            EXPECT_NE(pool_at(&copy, id), pool_at(&p, id));
            EXPECT_EQ(std::memcmp(pool_at(&copy, id), pool_at(&p, id), 4096), 0) << id;
        }
        while (pool_room(&p) > 0) {
            uint32_t a, b;
            ASSERT_EQ(pool_take(&p, &a), STATUS_OK);
            ASSERT_EQ(pool_take(&copy, &b), STATUS_OK);
            ASSERT_EQ(a, b);
        }
        pool_finish(&copy);
        pool_finish(&p);
    }
}

TEST(pool_death, foreign_ids_are_our_bug)
{
    pool p;
    ASSERT_EQ(pool_init(&p, 16, 10), STATUS_OK);
    uint32_t id;
    ASSERT_EQ(pool_take(&p, &id), STATUS_OK);
    EXPECT_DEATH(pool_give(&p, 5), "");
    EXPECT_DEATH((void)pool_at(&p, POOL_NONE), "");
    pool_give(&p, id);
    EXPECT_DEATH(pool_give(&p, id), "");
    pool_finish(&p);
}

/* Notes on items stay with their ids as the pool grows, and new ids have none. */
TEST(pool_shadow, follows_the_pool_and_begins_at_zero)
{
    pool p;
    ASSERT_EQ(pool_init(&p, 64, 5000), STATUS_OK);
    void *notes = nullptr;
    uint32_t room = 0, id = 0;
    ASSERT_EQ(pool_shadow(&p, &notes, &room, sizeof(uint64_t)), STATUS_OK);
    EXPECT_EQ(room, 0u) << "nothing was taken yet";
    for (uint32_t n = 0; n < 5000; n++) {
        ASSERT_EQ(pool_take(&p, &id), STATUS_OK);
        ASSERT_EQ(pool_shadow(&p, &notes, &room, sizeof(uint64_t)), STATUS_OK);
        ASSERT_GT(room, id);
        uint64_t *mine = static_cast<uint64_t *>(notes);
        ASSERT_EQ(mine[id], 0u);
        mine[id] = uint64_t{n} + 1;
    }
    for (uint32_t n = 0; n < 5000; n++)
        ASSERT_EQ(static_cast<uint64_t *>(notes)[n], uint64_t{n} + 1);
    std::free(notes);
    pool_finish(&p);
}

} // namespace
