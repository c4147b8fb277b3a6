/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a piece opened elsewhere is the piece that sculpture_open opens, with its history on the caller's own port;
 *       what is wrong with the store is answered as it would be there.
 * Method: a folder in memory, written by one piece, opened by the next; one whose reads fail. */
#include "station/opening.h"

#include "tests/unit/history/memory_store.h"

#include <gtest/gtest.h>

#include <memory>

namespace {

constexpr history_settings few = {10, 1 << 16, 1 << 24, 1 << 24, 4}, none = {0, 1 << 16, 1 << 24, 1 << 24, 4};

class opened_elsewhere : public testing::Test {
protected:
    void SetUp() override
    {
        history_finding finding;
        ASSERT_EQ(ellipsoid_init(&ball, ELLIPSOID_WYVILL, 1), STATUS_OK);
        port = disk.port();
        ASSERT_EQ(sculpture_open(piece.get(), &port, CAPACITY_BRICKS, &few, 0.5, &finding), STATUS_OK);
        for (int n = 0; n < 3; n++)
            stroke(5.0 * n);
        digest = sculpture_digest(piece.get());
        ASSERT_EQ(sculpture_close(piece.get()), STATUS_OK);
    }
    void stroke(double x)
    {
        const tool t = {ellipsoid_shape(&ball), ACTION_TOOTHPASTE, 7, deform_default()};
        const sculpture_dab d = {{{x, 0, 0}, {{7, 0, 0}, {0, 6, 0}, {0, 0, 5}}}, 2, 1};
        sculpture_stroke_begin(piece.get());
        ASSERT_EQ(sculpture_apply(piece.get(), &t, &d, nullptr), STATUS_OK);
        ASSERT_EQ(sculpture_stroke_end(piece.get()), STATUS_OK);
    }
    memory_store disk;
    byte_store port;
    std::unique_ptr<sculpture> piece = std::make_unique<sculpture>();
    ellipsoid ball;
    uint64_t digest = 0;
};

TEST_F(opened_elsewhere, is_the_piece_with_its_history)
{
    history_finding finding;
    opening *o = opening_begin(piece.get(), port, few, 1.0);
    ASSERT_EQ(opening_end(o, &finding), STATUS_OK);
    EXPECT_EQ(piece->step_mm, 0.5);
    EXPECT_EQ(sculpture_digest(piece.get()), digest);
    EXPECT_GT(piece->surface.triangles, 100u);
    EXPECT_EQ(piece->history.store.self, port.self) << "the opening is gone, its port with it";
    stroke(20);
    ASSERT_EQ(sculpture_undo(piece.get()), STATUS_OK);
    EXPECT_EQ(sculpture_digest(piece.get()), digest);
    EXPECT_EQ(sculpture_close(piece.get()), STATUS_OK);
}

TEST_F(opened_elsewhere, is_read_whole_by_the_end)
{
    history_finding finding;
    opening *o = opening_begin(piece.get(), port, few, 1.0);
    while (!opening_is_done(o))
        EXPECT_LE(opening_part(o), 1);
    EXPECT_EQ(opening_part(o), 1);
    ASSERT_EQ(opening_end(o, &finding), STATUS_OK);
    EXPECT_EQ(sculpture_close(piece.get()), STATUS_OK);
}

TEST_F(opened_elsewhere, what_fails_is_answered)
{
    history_finding finding;
    opening *o = opening_begin(piece.get(), port, none, 1.0);
    EXPECT_EQ(opening_end(o, &finding), STATUS_BAD_PARAMETER);
    port.list = [](void *, void (*)(void *, const char *), void *) { return STATUS_IO; };
    o = opening_begin(piece.get(), port, few, 1.0);
    EXPECT_EQ(opening_end(o, &finding), STATUS_IO);
}

} // namespace
