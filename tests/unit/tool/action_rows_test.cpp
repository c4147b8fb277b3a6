/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: whatever the lanes, a brick becomes, bit for bit, what the definition makes of it: the actions of action.h
 *       corner by corner, then the closing of the brick; and its masks and counts are the true ones.
 * Method: random clay (holes, full corners, ties at iso, specks), frames, shapes and amounts. The definition is applied
 *         to a brick of a real clay and closed there; the rows work on a copy of its page. */
#include "tool/action_rows.h"

#include "clay/apron.h"
#include "tool/ellipsoid.h"
#include "tool/freeform.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace {

enum form_kind { WYVILL, BOX, FREEFORM, FORMS };

const char *const form_names[FORMS] = {"Wyvill", "box", "freeform"};

std::vector<lanes> lanes_here()
{
    std::vector<lanes> here;
    for (lanes l : {LANES_PLAIN, LANES_AVX2, LANES_AVX512})
        if (lanes_are_here(l))
            here.push_back(l);
    return here;
}

struct forms {
    ellipsoid wyvill = {}, boxed = {};
    freeform free = {};

    explicit forms(seeded &chance)
    {
        clay piece;
        EXPECT_EQ(ellipsoid_init(&wyvill, ELLIPSOID_WYVILL, 1), STATUS_OK);
        EXPECT_EQ(ellipsoid_init(&boxed, ELLIPSOID_BOX, 0.3), STATUS_OK);
        EXPECT_EQ(clay_init(&piece, 100), STATUS_OK);
        EXPECT_EQ(plain_clay_ball(&piece, chance, {3, -9, 40}, 4, 2), STATUS_OK);
        EXPECT_EQ(freeform_init(&free, &piece), STATUS_OK);
        clay_finish(&piece);
    }
    ~forms() { freeform_finish(&free); }
    forms(const forms &) = delete;
    forms &operator=(const forms &) = delete;
    shape of(form_kind f) const
    {
        return f == FREEFORM ? freeform_shape(&free) : ellipsoid_shape(f == WYVILL ? &wyvill : &boxed);
    }
};

float choose_potential(seeded &chance)
{
    static const float special[] = {0, 3, 1.5f, std::nextafter(1.5f, 0.0f), std::nextafter(3.0f, 0.0f),
                                    1e-40f, 1e-6f, 0.002f, 0.0021f};
    const int64_t n = seeded_int(chance, 0, 13);
    return n < 9 ? special[n] : static_cast<float>(seeded_real(chance, 0, 3));
}

/* The brick and all that is round it. At times all empty, all full, or nothing but noise. */
void fill(clay *c, seeded &chance, key middle)
{
    const brick_mask none = {{0}};
    const int64_t kind = seeded_int(chance, 0, 9);
    for (int n = 0; n < BRICK_NEIGHBOURS; n++) {
        uint32_t id;
        if (seeded_chance(chance, 0.25))
            continue;
        ASSERT_EQ(clay_brick_open(c, key_add(middle, n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1), &id), STATUS_OK);
        brick_page *p = clay_brick(c, id)->page;
        const double density = kind == 2 ? 0.05 : 0.8;
        for (int at = 0; at < BRICK_CORNERS; at++) {
            const bool is_clay = kind != 0 && seeded_chance(chance, density);
            p->potential[at] = kind == 1 ? 3 : is_clay ? choose_potential(chance) : 0;
            p->rgba[at] = static_cast<uint32_t>(seeded_bits(chance));
        }
        ASSERT_EQ(clay_brick_close(c, id, &none), STATUS_OK);
    }
    clay_prune(c);
}

frame choose_frame(seeded &chance, form_kind form, key brick_at)
{
    frame f;
    double r[3][3];
    seeded_rotation(chance, r);
    const key first = key_of_brick(brick_at);
    const int32_t from[3] = {first.i, first.j, first.k};
    const bool upright = seeded_chance(chance, 0.2), grid = seeded_chance(chance, 0.2);
    for (int a = 0; a < 3; a++) {
        const double lo = form == FREEFORM ? 0.2 : 0.7, hi = form == FREEFORM ? 3 : 30;
        const double length = std::exp(seeded_real(chance, std::log(lo), std::log(hi)));
        f.origin[a] = from[a] + (grid ? std::floor(seeded_real(chance, -2, 10)) : seeded_real(chance, -4, 11));
        for (int n = 0; n < 3; n++) /* 1.2: sheared */
            f.axis[a][n] = length * (upright ? a == n : r[a][n]) * (seeded_chance(chance, 0.1) ? 1.2 : 1);
    }
    return f;
}

float choose_amount(seeded &chance)
{
    static const float special[] = {0, 1e-44f, 1e-20f, 1, 3, 1e6f};
    const int64_t n = seeded_int(chance, 0, 11);
    return n < 6 ? special[n] : static_cast<float>(std::exp(seeded_real(chance, std::log(0.001), std::log(5))));
}

deform choose_deform(seeded &chance)
{
    deform d;
    const double m = seeded_real(chance, 0.1, 1.0), r = seeded_real(chance, 0.1, 1.5 - m);
    if (deform_init(&d, 1.5, m, r, seeded_real(chance, 0, 3), seeded_real(chance, 0, 2)) != STATUS_OK)
        return deform_default();
    return d;
}

/* Everything a dab on one brick needs, and what the definition makes of it. */
struct scene {
    clay c = {};
    key at = {0, 0, 0};
    shape form = {};
    deform def = {};
    walk path = {};
    action_setting set = {};
    float apron[1000];
    uint32_t apron_rgba[1000];
    brick_page before = {};
    clay_written was = {};
    brick_mask reached = {}, dirtied = {}, moved = {}, fresh = {};
    uint32_t id = POOL_NONE; /* after the definition: the brick as it became */

    scene() { EXPECT_EQ(clay_init(&c, 60), STATUS_OK); }
    ~scene() { clay_finish(&c); }
    scene(const scene &) = delete;
    scene &operator=(const scene &) = delete;
    const brick_page &after() const { return *clay_brick(&c, id)->page; }
};

key choose_place(seeded &chance)
{
    if (seeded_chance(chance, 0.05))
        return seeded_chance(chance, 0.5) ? key_brick({KEY_MIN + 8, 0, KEY_MAX - 8}) : key{100000, -100000, 77};
    return seeded_key(chance, -3, 3);
}

void set_up(scene &s, seeded &chance, const forms &all, form_kind form, action kind)
{
    s.at = choose_place(chance);
    ASSERT_NO_FATAL_FAILURE(fill(&s.c, chance, s.at));
    s.form = all.of(form);
    s.def = choose_deform(chance);
    const frame f = choose_frame(chance, form, s.at);
    ASSERT_EQ(walk_begin(&s.path, &f, &s.form), STATUS_OK);
    const uint32_t colour = static_cast<uint32_t>(seeded_bits(chance));
    s.set = {kind, colour, choose_amount(chance), &s.def, seeded_bits(chance)};
    uint32_t ids[BRICK_NEIGHBOURS];
    clay_neighbours(&s.c, s.at, ids);
    apron_gather(&s.c, ids, 8, s.apron, s.apron_rgba);
    if (ids[BRICK_SELF] != POOL_NONE) {
        const brick *b = clay_brick(&s.c, ids[BRICK_SELF]);
        s.before = *b->page;
        s.was.inside = b->inside;
        s.was.stored = b->stored;
    }
}

size_t apron_place(int n)
{
    const int di = n >> 6, dj = n >> 3 & 7, dk = n & 7;
    return static_cast<size_t>(((di + 1) * ACTION_APRON_SIDE + dj + 1) * ACTION_APRON_SIDE + dk + 1);
}

void define_row(scene &s, brick_page *page, const float start[3], int row)
{
    float x[8], y[8], z[8], v[8];
    unsigned mask = 0;
    walk_row(&s.path, start, row >> 3, row & 7, x, y, z);
    s.form.evaluate(s.form.self, x, y, z, v, 8);
    for (int n = 0; n < 8; n++) {
        if (v[n] > 0)
            brick_mask_set(&s.reached, row * 8 + n);
        if (!(v[n] > 0) || !action_contributes(&s.set, v[n]))
            continue;
        mask |= 1u << n;
        brick_mask_set(&s.dirtied, row * 8 + n);
    }
    const bool near = action_reads_neighbours(s.set.kind);
    const size_t place = apron_place(row * 8);
    action_row(&s.set, key_add(key_of_brick(s.at), row >> 3, row & 7, 0), mask, v, near ? s.apron + place : nullptr,
               near ? s.apron_rgba + place : nullptr, page->potential + row * 8, page->rgba + row * 8);
}

/* The definition, in the clay. */
void define(scene &s)
{
    float start[3];
    ASSERT_EQ(clay_brick_open(&s.c, s.at, &s.id), STATUS_OK);
    walk_start(&s.path, s.at, start);
    for (int row = 0; row < BRICK_ROWS; row++)
        define_row(s, clay_brick(&s.c, s.id)->page, start, row);
    ASSERT_EQ(clay_brick_close(&s.c, s.id, &s.dirtied), STATUS_OK);
    for (int n = 0; n < BRICK_CORNERS; n++) {
        if (s.after().potential[n] != s.before.potential[n])
            brick_mask_set(&s.moved, n);
        if (s.after().potential[n] > 0 && !(s.before.potential[n] > 0))
            brick_mask_set(&s.fresh, n);
    }
}

void expect_same_mask(const brick_mask &found, const brick_mask &wanted, const char *what)
{
    for (int n = 0; n < BRICK_EDGE; n++)
        ASSERT_EQ(found.slab[n], wanted.slab[n]) << what << ", slab " << n;
}

void expect_same_page(const brick_page &found, const brick_page &wanted, const brick_page &before)
{
    for (int n = 0; n < BRICK_CORNERS; n++) {
        uint32_t a, b;
        std::memcpy(&a, &found.potential[n], sizeof a);
        std::memcpy(&b, &wanted.potential[n], sizeof b);
        ASSERT_EQ(a, b) << "corner " << n << ": " << before.potential[n] << " became " << found.potential[n] << " not "
                        << wanted.potential[n];
        ASSERT_EQ(found.rgba[n], wanted.rgba[n])
            << "corner " << n << ", colour " << before.rgba[n] << ", potential " << wanted.potential[n];
    }
}

void expect_rows(const scene &s, lanes l)
{
    brick_page page = s.before;
    float mean[BRICK_CORNERS];
    const bool near = action_reads_neighbours(s.set.kind);
    action_rows_brick b;
    std::memset(&b, 0xa5, sizeof b); /* what is out must be written */
    b.at = s.at;
    b.page = &page;
    b.mean = s.set.kind == ACTION_SMOOTH ? mean : nullptr;
    b.now.inside = s.was.inside;
    b.now.stored = s.was.stored;
    if (b.mean)
        action_rows_mean(s.apron, mean, l);
    const action_rows_dab d = action_rows_begin(&s.set, &s.form, &s.path);
    const bool any = action_rows(&d, &b, l);
    ASSERT_EQ(any, !brick_mask_is_empty(&s.dirtied));
    ASSERT_NO_FATAL_FAILURE(expect_same_mask(b.now.dirtied, s.dirtied, "dirtied"));
    ASSERT_NO_FATAL_FAILURE(expect_same_mask(b.now.moved, s.moved, "moved"));
    ASSERT_NO_FATAL_FAILURE(expect_same_mask(b.now.inside, clay_brick(&s.c, s.id)->inside, "inside"));
    ASSERT_EQ(b.now.stored, clay_brick(&s.c, s.id)->stored);
    if (near) {
        ASSERT_NO_FATAL_FAILURE(expect_same_mask(b.fresh, s.fresh, "fresh"));
        for (int n = 0; n < BRICK_CORNERS; n++)
            if (brick_mask_has(&b.fresh, n))
                page.rgba[n] = action_colour_round(&s.set, s.apron + apron_place(n), s.apron_rgba + apron_place(n));
    }
    expect_same_page(page, s.after(), s.before);
}

class action_rows_of : public testing::TestWithParam<action> {};

TEST_P(action_rows_of, any_lanes_are_the_definition_to_the_bit)
{
    seeded chance = {static_cast<uint64_t>(GetParam()) + 1};
    const forms all(chance);
    uint64_t dirtied = 0, moved = 0, missed = 0;
    for (int n = 0; n < seeded_steps(150); n++)
        for (form_kind form : {WYVILL, BOX, FREEFORM}) {
            scene s;
            ASSERT_NO_FATAL_FAILURE(set_up(s, chance, all, form, GetParam()));
            ASSERT_NO_FATAL_FAILURE(define(s));
            for (lanes l : lanes_here())
                ASSERT_NO_FATAL_FAILURE(expect_rows(s, l))
                    << action_name(GetParam()) << ", " << form_names[form] << ", " << lanes_name(l) << ", amount "
                    << s.set.amount << ", step " << n;
            dirtied += brick_mask_count(&s.dirtied);
            moved += brick_mask_count(&s.moved);
            missed += BRICK_CORNERS - brick_mask_count(&s.reached);
        }
    EXPECT_GT(dirtied, 10000u) << "the tools went by";
    EXPECT_GT(missed, 10000u) << "the tools covered everything";
    EXPECT_EQ(moved > 1000, GetParam() != ACTION_PAINTER && GetParam() != ACTION_SOFT_PAINTER);
}

INSTANTIATE_TEST_SUITE_P(each, action_rows_of,
                         testing::Values(ACTION_TOOTHPASTE, ACTION_SOFT_ERASER, ACTION_ERASER, ACTION_PAINTER,
                                         ACTION_SOFT_PAINTER, ACTION_SMOOTH, ACTION_STAMP, ACTION_PRINT));

/* --- the mean --- */

float one_two_one(float a, float b, float c) { return ((a + c) + (b + b)) * 0.25f; }

/* Along k, of those along j, of those along i: in this order of additions. */
float plain_mean(const float *at)
{
    float along_k[9], along_j[3];
    for (int n = 0; n < 9; n++) {
        const float *p = at + ((n / 3 - 1) * ACTION_APRON_SIDE + n % 3 - 1) * ACTION_APRON_SIDE;
        along_k[n] = one_two_one(p[-1], p[0], p[1]);
    }
    for (int n = 0; n < 3; n++)
        along_j[n] = one_two_one(along_k[3 * n], along_k[3 * n + 1], along_k[3 * n + 2]);
    return one_two_one(along_j[0], along_j[1], along_j[2]);
}

/* The 27 with their weights, in doubles. */
double exact_mean(const float *at)
{
    double sum = 0;
    for (int n = 0; n < 27; n++) {
        const int i = n / 9 - 1, j = n / 3 % 3 - 1, k = n % 3 - 1;
        sum += (2 - std::abs(i)) * (2 - std::abs(j)) * (2 - std::abs(k)) / 64.0 *
               static_cast<double>(at[(i * ACTION_APRON_SIDE + j) * ACTION_APRON_SIDE + k]);
    }
    return sum;
}

TEST(action_rows_mean, of_any_lanes_is_the_27_added_in_the_stated_order)
{
    seeded chance = {20};
    for (int round = 0; round < 200; round++) {
        std::vector<float> apron(1000); /* no more than that: a look beyond is one for the address sanitizer */
        for (float &f : apron)
            f = round == 0 ? 1.7f : round == 1 ? 0 : choose_potential(chance);
        for (lanes l : lanes_here()) {
            std::vector<float> mean(BRICK_CORNERS + 8, -7.0f);
            action_rows_mean(apron.data(), mean.data(), l);
            for (int n = 0; n < BRICK_CORNERS; n++) {
                const float *at = &apron[apron_place(n)], found = mean[static_cast<size_t>(n)];
                ASSERT_EQ(found, plain_mean(at)) << lanes_name(l) << ", corner " << n;
                ASSERT_NEAR(static_cast<double>(found), exact_mean(at), 1e-6);
            }
            for (size_t n = BRICK_CORNERS; n < mean.size(); n++)
                ASSERT_EQ(mean[n], -7.0f) << "wrote beyond";
        }
    }
}

TEST(action_rows_begin, dither_is_that_of_the_corners)
{
    seeded chance = {21};
    const action_setting set = {ACTION_SOFT_PAINTER, 1, 1, nullptr, 0xfedcba9876543210u};
    const action_rows_dab d = action_rows_begin(&set, nullptr, nullptr);
    for (int n = 0; n < 100; n++) {
        const key first = key_of_brick(seeded_key(chance, -1000, 1000));
        const uint32_t base = static_cast<uint32_t>(first.i) * COLOUR_STEP_I +
                              static_cast<uint32_t>(first.j) * COLOUR_STEP_J +
                              static_cast<uint32_t>(first.k) * COLOUR_STEP_K;
        for (int at = 0; at < 64; at++)
            ASSERT_EQ(static_cast<float>((base + d.dither[at]) >> 16) / COLOUR_WHOLE,
                      colour_dither(key_add(first, 0, at >> 3, at & 7), set.dab));
    }
}

} // namespace
