/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: every hand's share of every job is done exactly once and is done when the job returns, whoever does it; a crew
 *       can be sent home at any time.
 * Method: thousands of jobs that count their shares; jobs so short that hands come too late, so long that others wait,
 *         and pauses in which hands fall asleep. Nothing is timed. A thread sanitizer says the rest. */
#include "station/crew_of_threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <set>
#include <thread>
#include <vector>

namespace {

struct crew_closes {
    void operator()(crew_of_threads *c) const { crew_of_threads_close(c); }
};
using crew_owner = std::unique_ptr<crew_of_threads, crew_closes>;

constexpr uint32_t HANDS_MOST = 4;

/* A job's shares, as plain numbers: whoever reads them after the job must see what the hands wrote. */
struct shares {
    uint32_t hands = 0;
    uint32_t done[HANDS_MOST] = {};
    bool strange = false;
    int busy_us[HANDS_MOST] = {}; /* how long each share takes */
};

void work(void *on, uint32_t hand, uint32_t hands)
{
    shares *s = static_cast<shares *>(on);
    if (hands != s->hands || hand >= hands) {
        s->strange = true;
        return;
    }
    if (s->busy_us[hand] > 0)
        std::this_thread::sleep_for(std::chrono::microseconds(s->busy_us[hand]));
    s->done[hand]++;
}

void expect_once(const crew *c, shares &s)
{
    s.hands = c->hands;
    c->run(c->self, work, &s);
    ASSERT_FALSE(s.strange);
    for (uint32_t hand = 0; hand < HANDS_MOST; hand++)
        ASSERT_EQ(s.done[hand], hand < c->hands ? 1u : 0u) << "hand " << hand << " of " << c->hands;
}

TEST(crew_of_threads, without_hands_there_is_none)
{
    EXPECT_EQ(crew_of_threads_open(0), nullptr);
    crew_of_threads_close(nullptr);
}

TEST(crew_of_threads, port_says_how_many_hands_there_are)
{
    for (uint32_t hands = 1; hands <= HANDS_MOST; hands++) {
        const crew_owner c(crew_of_threads_open(hands));
        ASSERT_NE(c, nullptr);
        EXPECT_EQ(crew_of_threads_port(c.get())->hands, hands);
    }
}

TEST(crew_of_threads, does_each_share_once_in_thousands_of_short_jobs)
{
    for (uint32_t hands = 1; hands <= HANDS_MOST; hands++) {
        const crew_owner c(crew_of_threads_open(hands));
        ASSERT_NE(c, nullptr);
        for (int n = 0; n < 4000; n++) {
            shares s;
            ASSERT_NO_FATAL_FAILURE(expect_once(crew_of_threads_port(c.get()), s)) << n;
        }
    }
}

TEST(crew_of_threads, loses_no_share_whoever_is_late)
{
    for (uint32_t hands = 2; hands <= HANDS_MOST; hands++) {
        const crew_owner c(crew_of_threads_open(hands));
        ASSERT_NE(c, nullptr);
        for (int n = 0; n < 120; n++) {
            shares s;
            for (uint32_t hand = 0; hand < hands; hand++)
                s.busy_us[hand] = (n >> hand & 1) * 60 * (n % 7);
            ASSERT_NO_FATAL_FAILURE(expect_once(crew_of_threads_port(c.get()), s)) << n;
        }
    }
}

TEST(crew_of_threads, wakes_hands_that_fell_asleep)
{
    const crew_owner c(crew_of_threads_open(3));
    ASSERT_NE(c, nullptr);
    for (int n = 0; n < 60; n++) {
        std::this_thread::sleep_for(std::chrono::microseconds(n % 3 * 2 * CREW_OF_THREADS_LOOK_US));
        shares s;
        s.busy_us[0] = n % 2 * 500; /* at times long enough for them to begin */
        ASSERT_NO_FATAL_FAILURE(expect_once(crew_of_threads_port(c.get()), s)) << n;
    }
}

/* One job after another on the same numbers: each begins where the last ended. */
TEST(crew_of_threads, a_job_sees_what_the_last_one_wrote)
{
    struct relay {
        uint64_t value[HANDS_MOST] = {1, 2, 3, 4};
        uint64_t next[HANDS_MOST] = {};
    } r, plain;
    const crew_owner c(crew_of_threads_open(HANDS_MOST));
    ASSERT_NE(c, nullptr);
    const crew *port = crew_of_threads_port(c.get());
    const crew_job mix = [](void *on, uint32_t hand, uint32_t hands) {
        relay *of = static_cast<relay *>(on);
        of->next[hand] = of->value[hand] * 3 + of->value[(hand + 1) % hands];
    };
    const crew_job take = [](void *on, uint32_t hand, uint32_t) {
        static_cast<relay *>(on)->value[hand] = static_cast<relay *>(on)->next[hand];
    };
    for (int n = 0; n < 3000; n++) {
        port->run(port->self, mix, &r);
        port->run(port->self, take, &r);
        for (uint32_t hand = 0; hand < HANDS_MOST; hand++)
            mix(&plain, hand, HANDS_MOST);
        for (uint32_t hand = 0; hand < HANDS_MOST; hand++)
            take(&plain, hand, HANDS_MOST);
        for (uint32_t hand = 0; hand < HANDS_MOST; hand++)
            ASSERT_EQ(r.value[hand], plain.value[hand]) << n;
    }
}

/* A share that waits for the others can only end where they are done by somebody else meanwhile. */
TEST(crew_of_threads, shares_are_done_at_the_same_time)
{
    struct meeting {
        std::atomic<uint32_t> there{0};
        std::set<std::thread::id> who[HANDS_MOST];
    } m;
    const crew_owner c(crew_of_threads_open(HANDS_MOST));
    ASSERT_NE(c, nullptr);
    const crew *port = crew_of_threads_port(c.get());
    const crew_job meet = [](void *on, uint32_t hand, uint32_t hands) {
        meeting *of = static_cast<meeting *>(on);
        of->who[hand].insert(std::this_thread::get_id());
        of->there++;
        while (of->there.load() < hands)
            std::this_thread::yield();
    };
    port->run(port->self, meet, &m);
    EXPECT_EQ(m.there.load(), HANDS_MOST);
    EXPECT_EQ(m.who[0].count(std::this_thread::get_id()), 1u) << "hand 0 is the caller's";
}

TEST(crew_of_threads, can_be_closed_at_once)
{
    for (int n = 0; n < 200; n++)
        crew_of_threads_close(crew_of_threads_open(1 + static_cast<uint32_t>(n) % HANDS_MOST));
}

TEST(crew_of_threads, can_be_closed_right_after_a_job)
{
    for (int n = 0; n < 200; n++) {
        const crew_owner c(crew_of_threads_open(2 + static_cast<uint32_t>(n) % 3));
        ASSERT_NE(c, nullptr);
        shares s;
        s.busy_us[0] = n % 4 == 0 ? 200 : 0;
        ASSERT_NO_FATAL_FAILURE(expect_once(crew_of_threads_port(c.get()), s)) << n;
    }
}

TEST(crew_of_threads, can_be_closed_while_hands_sleep)
{
    for (int n = 0; n < 20; n++) {
        const crew_owner c(crew_of_threads_open(3));
        ASSERT_NE(c, nullptr);
        std::this_thread::sleep_for(std::chrono::microseconds(3 * CREW_OF_THREADS_LOOK_US));
    }
}

/* --- crew_run, the door to it --- */

TEST(crew_run, calls_the_crew_only_where_it_is_worth_it)
{
    const crew_owner c(crew_of_threads_open(3));
    ASSERT_NE(c, nullptr);
    const crew *port = crew_of_threads_port(c.get());
    for (const crew *who : {static_cast<const crew *>(nullptr), port})
        for (uint32_t bricks : {0u, uint32_t{CREW_BRICKS_LEAST} - 1, uint32_t{CREW_BRICKS_LEAST}, 5000u}) {
            shares s;
            s.hands = who && bricks >= CREW_BRICKS_LEAST ? 3 : 1;
            crew_run(who, bricks, work, &s);
            EXPECT_FALSE(s.strange) << bricks;
            for (uint32_t hand = 0; hand < s.hands; hand++)
                EXPECT_EQ(s.done[hand], 1u);
        }
}

TEST(crew_hand_of, is_one_of_the_hands_and_the_same_for_a_block_of_eight)
{
    for (uint32_t hands = 1; hands <= 7; hands++) {
        std::vector<uint32_t> bricks(hands);
        for (int i = -9; i < 9; i++)
            for (int j = -9; j < 9; j++)
                for (int k = -9; k < 9; k++) {
                    const uint32_t hand = crew_hand_of({i, j, k}, hands);
                    ASSERT_LT(hand, hands);
                    ASSERT_EQ(hand, crew_hand_of({i & ~1, j & ~1, k & ~1}, hands));
                    bricks[hand]++;
                }
        for (uint32_t n : bricks)
            EXPECT_GT(n, 18u * 18u * 18u / hands / 3) << "a hand with next to nothing to do, of " << hands;
    }
}

} // namespace
