/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: neither the vectors the machine has nor the hands that share the work change a bit: clay, marks, counts and
 *       surface are the same after every dab.
 * Method: one script of seeded dabs, of all actions and shapes, small and large, in strokes that are recorded, kept or
 *         taken back, and outside strokes; run with the plain vectors by the caller alone, then with all lanes that are
 *         here and with crews of one to three hands. Some crews do their shares one after the other, in any order. */
#include "clay/digest.h"
#include "surface/surface.h"
#include "tool/ellipsoid.h"
#include "tool/freeform.h"
#include "tool/tool.h"

/* Property programs are linked with sculpture and what is below it; of station this one file is wanted. */
#include "station/crew_of_threads.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

namespace {

enum { BRICKS = 6000, DABS = 250 };

/* --- crews --- */

/* Does the hands' shares one after the other, each time in another order. */
struct shuffled_crew {
    seeded chance = {4711};
    crew port = {};
    uint64_t jobs = 0;

    explicit shuffled_crew(uint32_t hands) { port = {this, shuffled_crew::run, hands}; }
    shuffled_crew(const shuffled_crew &) = delete;
    shuffled_crew &operator=(const shuffled_crew &) = delete;
    static void run(void *self, crew_job job, void *on)
    {
        shuffled_crew *c = static_cast<shuffled_crew *>(self);
        std::vector<uint32_t> order(c->port.hands);
        std::iota(order.begin(), order.end(), 0u);
        for (size_t n = order.size(); n > 1; n--)
            std::swap(order[n - 1], order[static_cast<size_t>(seeded_int(c->chance, 0, static_cast<int64_t>(n) - 1))]);
        for (uint32_t hand : order)
            job(on, hand, c->port.hands);
        c->jobs++;
    }
};

/* --- the script --- */

struct step {
    uint64_t clay, surface, marks, generation;
    tool_counts tool;
    surface_counts skin;
    status outcome;
    uint32_t bricks;
};

struct bench {
    clay c = {};
    surface s = {};
    tool_scratch scratch = {};
    ellipsoid ball = {};
    freeform free = {};
    seeded chance;

    bench(uint64_t seed, lanes l, const crew *hands) : chance{seed}
    {
        EXPECT_EQ(clay_init(&c, BRICKS), STATUS_OK);
        EXPECT_EQ(surface_init(&s, 2 * BRICKS), STATUS_OK);
        EXPECT_EQ(tool_scratch_init(&scratch, BRICKS), STATUS_OK);
        EXPECT_EQ(plain_clay_ball(&c, chance, {9, -7, 3}, 5, 2), STATUS_OK);
        EXPECT_EQ(freeform_init(&free, &c), STATUS_OK);
        c.rows = l;
        c.crew = hands;
    }
    ~bench()
    {
        freeform_finish(&free);
        tool_scratch_finish(&scratch);
        surface_finish(&s);
        clay_finish(&c);
    }
    bench(const bench &) = delete;
    bench &operator=(const bench &) = delete;
};

uint64_t digest_marks(const clay *c)
{
    uint64_t sum = 1;
    for (uint32_t n = 0; n < dirt_count(&c->dirty); n++) {
        const dirt_entry *e = dirt_at(&c->dirty, n);
        sum = digest_bytes(&e->at, sizeof e->at, sum);
        sum = digest_bytes(&e->corners, sizeof e->corners, sum);
        sum = digest_bytes(&e->moved, sizeof e->moved, sum);
    }
    return sum;
}

/* Every eighth dab covers more bricks than a crew is called for. */
tool_dab choose_dab(bench &b, int n, bool is_free)
{
    tool_dab d = {};
    double r[3][3];
    seeded_rotation(b.chance, r);
    const bool large = n % 8 == 0;
    for (int a = 0; a < 3; a++) {
        const double reach = large ? seeded_real(b.chance, 22, 30) : seeded_real(b.chance, 2, 12);
        const double length = is_free ? reach / 6 : reach;
        d.at.origin[a] = seeded_real(b.chance, -25, 25);
        for (int c = 0; c < 3; c++)
            d.at.axis[a][c] = length * r[a][c];
    }
    d.amount = std::exp(seeded_real(b.chance, std::log(0.05), std::log(3)));
    d.number = static_cast<uint64_t>(n);
    return d;
}

/* First clay, then everything, each large dab another action. */
action choose_action(bench &b, int n)
{
    if (n < 4)
        return ACTION_TOOTHPASTE;
    if (n % 8 == 0 && n / 8 <= 2 * ACTION_COUNT)
        return static_cast<action>(n / 8 % ACTION_COUNT);
    return seeded_chance(b.chance, 0.4) ? ACTION_TOOTHPASTE
                                        : static_cast<action>(seeded_int(b.chance, 0, ACTION_COUNT - 1));
}

void choose_stroke(bench &b)
{
    if (!b.c.changes.recording) {
        if (seeded_chance(b.chance, 0.15))
            clay_change_begin(&b.c);
    } else if (seeded_chance(b.chance, 0.15)) {
        if (seeded_chance(b.chance, 0.3))
            clay_change_revert(&b.c);
        else
            clay_change_end(&b.c);
    }
}

step one_step(bench &b, int n)
{
    step now = {};
    tool t = {};
    const int64_t form = seeded_int(b.chance, 0, 4);
    choose_stroke(b);
    EXPECT_EQ(ellipsoid_init(&b.ball, form < 3 ? ELLIPSOID_WYVILL : ELLIPSOID_BOX, 0.4), STATUS_OK);
    t.form = form == 4 ? freeform_shape(&b.free) : ellipsoid_shape(&b.ball);
    t.kind = choose_action(b, n);
    t.rgba = static_cast<uint32_t>(seeded_bits(b.chance));
    t.def = deform_default();
    const tool_dab d = choose_dab(b, n, form == 4);
    const bool counting = seeded_chance(b.chance, 0.1);
    now.outcome = tool_apply(&t, &d, &b.c, &b.scratch, counting ? &now.tool : nullptr);
    now.marks = digest_marks(&b.c);
    EXPECT_EQ(surface_update(&b.s, &b.c, counting ? &now.skin : nullptr), STATUS_OK);
    dirt_clear(&b.c.dirty);
    now.clay = clay_digest(&b.c);
    now.surface = surface_digest(&b.s);
    now.generation = b.s.generation;
    now.bricks = clay_brick_count(&b.c);
    return now;
}

using steps = std::vector<step>;

steps run_script(uint64_t seed, lanes l, const crew *hands)
{
    bench b(seed, l, hands);
    steps all;
    for (int n = 0; n < seeded_steps(DABS) && !testing::Test::HasFailure(); n++)
        all.push_back(one_step(b, n));
    EXPECT_TRUE(clay_is_valid(&b.c));
    return all;
}

void expect_same(const steps &found, const steps &wanted)
{
    ASSERT_EQ(found.size(), wanted.size());
    for (size_t n = 0; n < wanted.size(); n++) {
        const step &a = found[n], &b = wanted[n];
        ASSERT_EQ(a.outcome, b.outcome) << "dab " << n;
        ASSERT_EQ(a.marks, b.marks) << "marks after dab " << n;
        ASSERT_EQ(a.clay, b.clay) << "clay after dab " << n;
        ASSERT_EQ(a.surface, b.surface) << "surface after dab " << n;
        ASSERT_EQ(a.generation, b.generation) << "generations after dab " << n;
        ASSERT_TRUE(a.tool.visited == b.tool.visited && a.tool.computed == b.tool.computed &&
                    a.tool.dirtied == b.tool.dirtied && a.tool.bricks == b.tool.bricks)
            << "counts of dab " << n;
        ASSERT_TRUE(a.skin.treated == b.skin.treated && a.skin.patches == b.skin.patches &&
                    a.skin.triangles == b.skin.triangles)
            << "counts of update " << n;
    }
}

/* What all others must equal: run once. */
const steps &alone(uint64_t seed)
{
    static std::map<uint64_t, steps> known;
    const auto found = known.find(seed);
    return found != known.end() ? found->second : known[seed] = run_script(seed, LANES_PLAIN, nullptr);
}

/* --- */

using choice = std::tuple<lanes, uint64_t>; /* lanes, seed */

class same_bits : public testing::TestWithParam<choice> {
protected:
    void SetUp() override
    {
        if (!lanes_are_here(std::get<0>(GetParam())))
            GTEST_SKIP() << "no " << lanes_name(std::get<0>(GetParam())) << " here";
    }
    void expect_with(const crew *hands)
    {
        const auto [l, seed] = GetParam();
        const steps found = run_script(seed, l, hands);
        expect_same(found, alone(seed));
    }
};

TEST_P(same_bits, by_the_caller_alone)
{
    expect_with(nullptr);
}

TEST_P(same_bits, by_hands_in_any_order)
{
    for (uint32_t hands = 1; hands <= 3; hands++) {
        shuffled_crew c(hands);
        ASSERT_NO_FATAL_FAILURE(expect_with(&c.port)) << hands << " hands";
        EXPECT_TRUE(hands == 1 || c.jobs > 40) << "only " << c.jobs << " jobs were large enough";
    }
}

TEST_P(same_bits, by_threads)
{
    for (uint32_t hands = 1; hands <= 3; hands++) {
        crew_of_threads *c = crew_of_threads_open(hands);
        ASSERT_NE(c, nullptr);
        expect_with(crew_of_threads_port(c));
        crew_of_threads_close(c);
        ASSERT_FALSE(HasFatalFailure()) << hands << " hands";
    }
}

std::string choice_name(const testing::TestParamInfo<choice> &info)
{
    static const char *const names[LANES_COUNT] = {"plain", "avx2", "avx512"};
    return std::string(names[std::get<0>(info.param)]) + "_" + std::to_string(std::get<1>(info.param));
}

INSTANTIATE_TEST_SUITE_P(each, same_bits,
                         testing::Combine(testing::Values(LANES_PLAIN, LANES_AVX2, LANES_AVX512),
                                          testing::Values(uint64_t{1}, uint64_t{2})),
                         choice_name);

/* The script is worth running: it builds, and all it does shows. */
TEST(same_bits_script, changes_clay_and_surface_all_the_time)
{
    const steps &all = alone(1);
    size_t clays = 0, surfaces = 0, many = 0;
    for (size_t n = 1; n < all.size(); n++) {
        EXPECT_EQ(all[n].outcome, STATUS_OK) << n;
        clays += all[n].clay != all[n - 1].clay;
        surfaces += all[n].surface != all[n - 1].surface;
        many += all[n].bricks > 2 * CREW_BRICKS_LEAST;
    }
    EXPECT_GT(clays, all.size() / 2);
    EXPECT_GT(surfaces, all.size() / 2);
    EXPECT_GT(many, all.size() / 2);
}

} // namespace
