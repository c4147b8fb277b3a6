/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a freeform tool is the clay it was made of, at its middle, and stays so while sculpting goes on.
 * Method: its potential against the reconstruction of the source; then the source is destroyed. */
#include "tool/freeform.h"

#include "clay/reconstruct.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <vector>

namespace {

class freeform_tool : public testing::Test {
protected:
    void SetUp() override
    {
        ASSERT_EQ(clay_init(&source, 100), STATUS_OK);
        seeded noise = {1};
        ASSERT_EQ(plain_clay_ball(&source, noise, {20, -7, 3}, 6, 2), STATUS_OK);
        ASSERT_EQ(clay_write(&source, {31, -7, 3}, 2, 9), STATUS_OK); /* so that it is not symmetric */
        ASSERT_EQ(freeform_init(&f, &source), STATUS_OK);
    }
    void TearDown() override
    {
        freeform_finish(&f);
        clay_finish(&source);
    }
    float at(const float p[3])
    {
        const shape s = freeform_shape(&f);
        float v;
        s.evaluate(s.self, &p[0], &p[1], &p[2], &v, 1);
        return v;
    }
    clay source;
    freeform f;
    seeded chance = {2};
};

TEST_F(freeform_tool, has_its_middle_in_the_box_of_its_corners)
{
    const box b = clay_box(&source);
    EXPECT_EQ(f.middle[0], (b.min.i + b.max.i) / 2.0);
    EXPECT_EQ(f.middle[1], (b.min.j + b.max.j) / 2.0);
    EXPECT_EQ(f.middle[2], (b.min.k + b.max.k) / 2.0);
    const shape s = freeform_shape(&f);
    const double side[3] = {b.max.i - b.min.i + 2.0, b.max.j - b.min.j + 2.0, b.max.k - b.min.k + 2.0};
    for (int a = 0; a < 3; a++) {
        EXPECT_EQ(s.hi[a] - s.lo[a], side[a]) << "the box grown by one step";
        EXPECT_EQ(s.hi[a], -s.lo[a]);
    }
}

TEST_F(freeform_tool, is_the_reconstruction_of_its_source)
{
    reconstruct r = reconstruct_begin(&source);
    const shape s = freeform_shape(&f);
    for (int n = 0; n < 20000; n++) {
        float p[3];
        for (int a = 0; a < 3; a++)
            p[a] = static_cast<float>(seeded_real(chance, s.lo[a] - 2, s.hi[a] + 2));
        const float v = at(p);
        ASSERT_EQ(v, reconstruct_potential(&r, p[0] + f.middle[0], p[1] + f.middle[1], p[2] + f.middle[2], nullptr));
        for (int a = 0; a < 3; a++) {
            if (!(p[a] > s.lo[a] && p[a] < s.hi[a])) {
                ASSERT_EQ(v, 0) << "outside its support";
            }
        }
    }
}

TEST_F(freeform_tool, is_no_link_to_its_source)
{
    std::vector<float> before;
    for (int x = -6; x <= 6; x++) {
        const float p[3] = {static_cast<float>(x) / 2, 0.25f, -0.5f};
        before.push_back(at(p));
    }
    const uint64_t digest = clay_digest(&f.copy);
    clay_clear(&source);
    seeded noise = {3};
    ASSERT_EQ(plain_clay_ball(&source, noise, {20, -7, 3}, 5, 0), STATUS_OK);
    for (int x = -6; x <= 6; x++) {
        const float p[3] = {static_cast<float>(x) / 2, 0.25f, -0.5f};
        EXPECT_EQ(at(p), before[static_cast<size_t>(x + 6)]);
    }
    EXPECT_EQ(clay_digest(&f.copy), digest);
}

TEST(freeform, cannot_be_made_of_nothing)
{
    clay none;
    ASSERT_EQ(clay_init(&none, 10), STATUS_OK);
    freeform f;
    EXPECT_EQ(freeform_init(&f, &none), STATUS_BAD_PARAMETER);
    clay_finish(&none);
}

TEST(freeform, far_out_loses_no_digit)
{
    clay far;
    ASSERT_EQ(clay_init(&far, 10), STATUS_OK);
    ASSERT_EQ(clay_write(&far, {KEY_MAX, KEY_MIN, 0}, 2, 9), STATUS_OK);
    freeform f;
    ASSERT_EQ(freeform_init(&f, &far), STATUS_OK);
    const shape s = freeform_shape(&f);
    const float x[3] = {0, 0.5f, 0.25f}, zero[3] = {0, 0, 0};
    float v[3];
    s.evaluate(s.self, zero, x, zero, v, 3);
    EXPECT_EQ(v[0], 2);
    EXPECT_EQ(v[1], 1);
    EXPECT_EQ(v[2], 1.5f);
    freeform_finish(&f);
    clay_finish(&far);
}

} // namespace
