/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: an errand is done once, off the caller's thread, says how far it is, and its answer comes back; a piece can be
 *       sculpted on while one writes out what it was.
 * Method: errands that wait for the test, so that nothing is timed; then stills of a piece written out while strokes go
 *         on, compared with what was written before. A thread sanitizer says the rest. */
#include "station/errand.h"

#include "exchange/exchange.h"
#include "sculpture/still.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace {

TEST(errand, runs_elsewhere_and_answers)
{
    std::thread::id there;
    errand *e = errand_begin([&there](const std::function<void(double)> &) {
        there = std::this_thread::get_id();
        return std::string("the disk is full");
    });
    EXPECT_EQ(errand_end(e), "the disk is full");
    EXPECT_NE(there, std::this_thread::get_id());
}

TEST(errand, tells_how_far_it_is)
{
    std::atomic<int> step{0};
    errand *e = errand_begin([&step](const std::function<void(double)> &told) {
        told(0.25);
        step = 1;
        step.notify_all();
        step.wait(1);
        return std::string();
    });
    step.wait(0);
    EXPECT_EQ(errand_part(e), 0.25);
    EXPECT_FALSE(errand_is_done(e));
    step = 2;
    step.notify_all();
    while (!errand_is_done(e))
        std::this_thread::yield();
    EXPECT_EQ(errand_part(e), 1);
    EXPECT_EQ(errand_end(e), "");
}

struct closer {
    void operator()(sculpture *s) const
    {
        EXPECT_EQ(sculpture_close(s), STATUS_OK);
        delete s;
    }
};

class written_while_sculpted : public testing::TestWithParam<const char *> {
protected:
    void SetUp() override
    {
        history_finding finding;
        piece.reset(new sculpture());
        ASSERT_EQ(sculpture_open(piece.get(), nullptr, 4000, nullptr, 0.5, &finding), STATUS_OK);
        ASSERT_EQ(ellipsoid_init(&ball, ELLIPSOID_WYVILL, 1), STATUS_OK);
        for (int n = 0; n < 20; n++)
            dab(n, ACTION_TOOTHPASTE);
    }
    void dab(int n, action kind)
    {
        const tool t = {ellipsoid_shape(&ball), kind, colour_pack(200, 100, 50, 255), deform_default()};
        sculpture_dab d = {{{n % 7 * 3.0, n % 5 * 3.0, n % 3 * 3.0}, {{7, 0, 0}, {0, 6, 0}, {0, 0, 5}}}, 2, 1};
        sculpture_stroke_begin(piece.get());
        EXPECT_EQ(sculpture_apply(piece.get(), &t, &d, nullptr), STATUS_OK);
        EXPECT_EQ(sculpture_stroke_end(piece.get()), STATUS_OK);
    }
    static status put(void *self, const void *bytes, size_t n)
    {
        static_cast<std::string *>(self)->append(static_cast<const char *>(bytes), n);
        return STATUS_OK;
    }
    std::string write(still *moment)
    {
        std::string bytes;
        EXPECT_EQ(exchange_write(*moment, std::string("owl") + GetParam(), put, &bytes).state, STATUS_OK);
        return bytes;
    }
    std::unique_ptr<sculpture, closer> piece;
    ellipsoid ball;
};

TEST_P(written_while_sculpted, is_what_it_was)
{
    for (int round = 0; round < 3; round++) {
        still before, moment;
        std::string during;
        double last = 0;
        ASSERT_EQ(still_begin(&before, piece.get()), STATUS_OK);
        const std::string wanted = write(&before);
        still_end(&before);
        ASSERT_EQ(still_begin(&moment, piece.get()), STATUS_OK);
        errand *e = errand_begin([&](const std::function<void(double)> &told) {
            const auto heard = [&](double part) {
                EXPECT_GE(part, last);
                last = part;
                told(part);
            };
            return exchange_write(moment, std::string("owl") + GetParam(), put, &during, heard).text;
        });
        for (int n = 0; n < 30 || !errand_is_done(e); n++)
            dab(n, static_cast<action>(n % ACTION_COUNT));
        EXPECT_EQ(errand_end(e), "");
        still_end(&moment);
        EXPECT_EQ(during, wanted);
        EXPECT_GT(last, 0.5) << "about as many bytes as were foreseen";
        EXPECT_TRUE(clay_is_valid(&piece->clay));
        for (int n = 0; n < 20; n++)
            dab(n, ACTION_TOOTHPASTE);
    }
}

INSTANTIATE_TEST_SUITE_P(formats, written_while_sculpted, testing::Values(".glaise", ".stl", ".ply", ".obj", ".iv"));

} // namespace
