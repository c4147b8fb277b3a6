/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a frame sends no more than its budget; a patch is drawn whole, as it is or as it was; nothing that a frame
 *       under way shows is written, and nothing waits for the device; what waits has its turn; in the end the device
 *       holds what was sent at once.
 * Method: the device's memory is read back and drawn by hand after each frame, and again one and two frames later, as a
 *         device would that lags behind. Each patch drawn is looked up among all states that the patch ever had. */
#include "upload_device.h"
#include "view_stage.h"

#include <random>
#include <set>

namespace {

class upload_frames : public view_stage {
  protected:
    void SetUp() override
    {
        view_stage::SetUp();
        upload_init(&u, false);
        upload_device = {};
    }
    void TearDown() override
    {
        upload_device = {};
        upload_finish(&u);
        view_stage::TearDown();
    }

    /* Bytes sent. */
    uint64_t frame(const surface &s, size_t budget_bytes)
    {
        const uint64_t before = u.counts.bytes;
        EXPECT_TRUE(upload_update(&u, &s, budget_bytes, &trouble)) << trouble;
        return u.counts.bytes - before;
    }
    upload_device_drawing drawn() { return upload_device_draw(upload_device_calls(u)); }

    upload u;
};

/* A random walk of changes to real clay: some patches grow, some go, some come. */
struct walk {
    view_stage_piece piece;
    std::mt19937 random{23};
    std::map<upload_device_brick, std::set<std::vector<upload_device_triangle>>> ever;

    int32_t within(int lo, int hi)
    {
        return static_cast<int32_t>(lo + static_cast<int>(random() % static_cast<unsigned>(hi - lo + 1)));
    }
    void step(int n)
    {
        if (n % 20 == 0)
            piece.ball({within(-12, 12), within(-12, 12), within(-12, 12)}, within(8, 14), random() | 0xFF000000u);
        if (n == 50)
            piece.empty();
        for (int touched = 0; touched < 12; touched++) {
            const key at = {within(-20, 20), within(-20, 20), within(-20, 20)};
            EXPECT_EQ(clay_write(&piece.it->clay, at, within(0, 3), random() | 0xFF000000u), STATUS_OK);
        }
        piece.update();
        for (const auto &[at, triangles] : upload_device_expected(piece.it->surface))
            ever[at].insert(triangles);
    }
};

constexpr size_t small_budget = size_t{40} << 10; /* a table, and a patch or two */

TEST_F(upload_frames, a_small_budget_is_kept_and_ends_as_a_large_one)
{
    walk w;
    upload_device.frames_behind = 1;
    int waited = 0;
    for (int n = 0; n < 80; n++) {
        w.step(n);
        ASSERT_LE(frame(w.piece.it->surface, small_budget), small_budget) << n;
        waited += u.counts.waiting > 0;
        for (const auto &[at, triangles] : drawn())
            ASSERT_TRUE(w.ever[at].contains(triangles)) << "frame " << n << ": no state that this patch ever had";
    }
    EXPECT_GT(waited, 10) << "the budget was no limit";
    for (int n = 0; u.counts.waiting > 0; n++) {
        ASSERT_LT(n, 100) << "it does not come to an end";
        ASSERT_LE(frame(w.piece.it->surface, small_budget), small_budget);
    }
    const upload_device_drawing all = drawn();
    EXPECT_GT(all.size(), 20u);
    EXPECT_EQ(all, upload_device_expected(w.piece.it->surface));
    upload fresh;
    upload_init(&fresh, false);
    ASSERT_TRUE(upload_update(&fresh, &w.piece.it->surface, UPLOAD_ALL, &trouble)) << trouble;
    EXPECT_EQ(fresh.counts.waiting, 0u);
    EXPECT_EQ(all, upload_device_draw(upload_device_calls(fresh)));
    EXPECT_EQ(u.bricks.min.i, fresh.bricks.min.i);
    EXPECT_EQ(u.bricks.max.k, fresh.bricks.max.k);
    upload_finish(&fresh);
}

TEST_F(upload_frames, nothing_waits_for_the_device_and_frames_under_way_keep_what_they_show)
{
    upload_device.frames_behind = 2;
    walk w;
    std::vector<std::vector<upload_device_call>> calls;
    std::vector<upload_device_drawing> drawings;
    for (int n = 0; n < 70; n++) {
        w.step(n);
        frame(w.piece.it->surface, n % 7 == 0 ? UPLOAD_ALL : small_budget);
        calls.push_back(upload_device_calls(u));
        drawings.push_back(drawn());
        for (size_t late = 1; late <= 2 && late < calls.size(); late++)
            ASSERT_EQ(upload_device_draw(calls[calls.size() - 1 - late]), drawings[calls.size() - 1 - late])
                << "frame " << n << " wrote over what was shown " << late << " frames before";
    }
    EXPECT_EQ(upload_device.waits, 0);
    for (const page &p : u.pages)
        EXPECT_LE(p.tables.size(), 4u) << "two under way, the one before, the next";
}

TEST_F(upload_frames, what_is_gone_gives_its_room_back)
{
    upload_device.frames_behind = 2;
    walk w;
    for (int n = 0; n < 10; n++) {
        w.step(n);
        frame(w.piece.it->surface, UPLOAD_ALL);
    }
    ASSERT_GT(u.pages[0].units.count, 20);
    w.piece.empty();
    frame(w.piece.it->surface, UPLOAD_ALL);
    EXPECT_TRUE(drawn().empty());
    EXPECT_GT(u.pages[0].units.count, 20) << "frames under way still show it";
    for (int n = 0; n < 3; n++)
        EXPECT_EQ(frame(w.piece.it->surface, UPLOAD_ALL), 0u);
    EXPECT_EQ(u.pages[0].units.count, 0);
    EXPECT_TRUE(upload_device_calls(u).empty());
}

TEST_F(upload_frames, what_changed_last_goes_first_and_nothing_starves)
{
    const uint32_t count = 400, busy = 40;
    upload_device_surface s(count, 160); /* five units: 3.5 KB */
    const size_t budget = size_t{64} << 10;
    frame(s.it, UPLOAD_ALL);
    for (uint32_t n = 0; n < count; n++)
        s.change(n, 150);
    std::vector<uint64_t> wanted(count);
    for (uint32_t n = busy; n < count; n++)
        wanted[n] = s.at(n)->generation;
    int frames = 0;
    for (bool all = false; !all; frames++) {
        ASSERT_LT(frames, UPLOAD_WAIT_FRAMES + 60) << "some never had their turn";
        for (uint32_t n = 0; n < busy; n++) /* more than fits, in every frame */
            s.change(n, 150);
        ASSERT_LE(frame(s.it, budget), budget);
        const bool last_sent = u.slots[busy - 1].generation == s.at(busy - 1)->generation;
        ASSERT_TRUE(last_sent || frames >= UPLOAD_WAIT_FRAMES) << "the last to change goes first";
        all = true;
        for (uint32_t n = busy; n < count; n++)
            all = all && u.slots[n].generation == wanted[n];
    }
    EXPECT_GT(u.counts.waiting, 0u) << "the budget was no limit";
}

TEST_F(upload_frames, a_budget_that_nothing_fits_sends_one_patch_a_frame)
{
    upload_device_surface s(5, 160);
    for (uint32_t n = 1; n <= 5; n++) {
        EXPECT_GT(frame(s.it, 1), 0u);
        EXPECT_EQ(u.counts.held, n);
        EXPECT_EQ(u.counts.waiting, 5 - n);
    }
    EXPECT_EQ(frame(s.it, 1), 0u);
    EXPECT_EQ(drawn(), upload_device_expected(s.it));
}

TEST_F(upload_frames, only_what_differs_is_sent_where_the_device_is_idle)
{
    upload_device_surface s(30, 160);
    frame(s.it, UPLOAD_ALL);
    const upload_range place = u.slots[9].shown;
    s.change_vertex(9, 70);
    EXPECT_EQ(frame(s.it, UPLOAD_ALL), PACKED_VERTEX_BYTES) << "one unit";
    EXPECT_EQ(u.slots[9].shown.first, place.first) << "its slot is stable";
    s.change(9, 110); /* four units in place of five */
    frame(s.it, UPLOAD_ALL);
    EXPECT_EQ(u.slots[9].shown.first, place.first);
    s.change(9, 170);
    frame(s.it, UPLOAD_ALL);
    EXPECT_NE(u.slots[9].shown.first, place.first) << "outgrown";
    s.change(4, 20);
    frame(s.it, UPLOAD_ALL);
    EXPECT_EQ(u.slots[4].shown.units, 1) << "less than half: it moves";
    EXPECT_EQ(drawn(), upload_device_expected(s.it));
    s.at(5)->at = {5, 7, 7}; /* another brick's patch in the same slot */
    s.change(5, 160);
    frame(s.it, UPLOAD_ALL);
    EXPECT_EQ(drawn(), upload_device_expected(s.it));
}

TEST_F(upload_frames, what_a_range_already_has_is_not_sent_again)
{
    upload_device.frames_behind = 1;
    upload_device_surface s(1, 160);
    frame(s.it, UPLOAD_ALL);
    const upload_range a = u.slots[0].shown;
    s.change_vertex(0, 70);
    EXPECT_GE(frame(s.it, UPLOAD_ALL), 160 * sizeof(packed_vertex)) << "another range: all of it";
    EXPECT_NE(u.slots[0].shown.first, a.first);
    for (int n = 0; n < 6; n++) { /* until both ranges and all tables have been in use */
        s.change_vertex(0, 70);
        frame(s.it, UPLOAD_ALL);
    }
    s.change_vertex(0, 70);
    const uint64_t bytes = frame(s.it, UPLOAD_ALL);
    EXPECT_GE(bytes, PACKED_VERTEX_BYTES) << "the unit that differs";
    EXPECT_LE(bytes, PACKED_VERTEX_BYTES + 2 * PAGE_TEXEL_BYTES);
    EXPECT_EQ(drawn(), upload_device_expected(s.it));
    EXPECT_EQ(u.pages[0].units.count, 10) << "two ranges";
    EXPECT_EQ(frame(s.it, UPLOAD_ALL), 0u);
}

TEST_F(upload_frames, memory_that_the_device_takes_back_is_sent_anew)
{
    upload_device_surface s(50, 100);
    frame(s.it, UPLOAD_ALL);
    s.change(7, 100);
    upload_device.refuses_maps = true;
    EXPECT_FALSE(upload_update(&u, &s.it, UPLOAD_ALL, &trouble));
    EXPECT_NE(trouble.find("memory"), std::string::npos) << trouble;
    EXPECT_EQ(u.counts.held, 0u);
    EXPECT_TRUE(upload_device_calls(u).empty());
    upload_device.refuses_maps = false;
    frame(s.it, UPLOAD_ALL);
    EXPECT_EQ(drawn(), upload_device_expected(s.it));
}

TEST_F(upload_frames, after_clearing_nothing_is_drawn_and_frames_under_way_still_are)
{
    upload_device.frames_behind = 2;
    upload_device_surface s(60, 100), other(30, 50);
    frame(s.it, UPLOAD_ALL);
    const std::vector<upload_device_call> calls = upload_device_calls(u);
    upload_clear(&u);
    EXPECT_TRUE(upload_device_calls(u).empty());
    EXPECT_EQ(u.counts.held, 0u);
    frame(other.it, UPLOAD_ALL);
    EXPECT_EQ(drawn(), upload_device_expected(other.it));
    EXPECT_EQ(upload_device_draw(calls), upload_device_expected(s.it));
}

TEST_F(upload_frames, a_view_says_that_something_waits_and_draws_what_it_has)
{
    view_stage_piece piece;
    piece.ball({0, 0, 0}, 30, view_stage_rgba(180, 120, 90));
    ASSERT_TRUE(view_update(it, piece.it.get(), &trouble, small_budget)) << trouble;
    EXPECT_GT(view_count(it).waiting, 0u);
    const snapshot s = plain();
    const view_stage_picture fresh = draw_fresh(s, piece);
    EXPECT_GT(draw(s).changed(fresh), 0);
    for (int n = 0; view_count(it).waiting > 0; n++) {
        ASSERT_LT(n, 100);
        ASSERT_TRUE(view_update(it, piece.it.get(), &trouble, small_budget)) << trouble;
    }
    EXPECT_LE(draw(s).changed(fresh), 12) << "at edges on edge the order of patches decides";
}

} // namespace
