/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: going from piece to piece never waits for the medium, never has two of one piece or three in memory, and loses
 *       nothing: while one is opened the other is sculpted on, and while that is closed, the new one is.
 * Method: folders in memory whose calls can be held back: the thread that sculpts passes only if it does not wait for
 *         them. What each piece is in the end is compared with the same strokes on a piece of its own. */
#include "station/switching.h"

#include "station/shelf.h"

#include "tests/unit/station/shelf_disk.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <thread>

namespace {

constexpr history_settings FEW = {10, 1 << 16, 1 << 24, 1 << 24, 4};

/* Calls about one folder wait here. */
struct barrier {
    std::mutex guard;
    std::condition_variable changed;
    std::string folder; /* "": none */
    int waiting = 0;
    void pass(const std::string &at)
    {
        std::unique_lock<std::mutex> lock(guard);
        if (at != folder)
            return;
        waiting++;
        changed.notify_all();
        changed.wait(lock, [&] { return at != folder; });
        waiting--;
    }
    void hold(const std::string &at)
    {
        const std::lock_guard<std::mutex> lock(guard);
        folder = at;
        changed.notify_all();
    }
    void await_one()
    {
        std::unique_lock<std::mutex> lock(guard);
        changed.wait(lock, [&] { return waiting > 0; });
    }
};

void stroke(sculpture *piece, double x)
{
    ellipsoid ball;
    ASSERT_EQ(ellipsoid_init(&ball, ELLIPSOID_WYVILL, 1), STATUS_OK);
    const tool t = {ellipsoid_shape(&ball), ACTION_TOOTHPASTE, 7, deform_default()};
    const sculpture_dab d = {{{x, 0, 0}, {{7, 0, 0}, {0, 6, 0}, {0, 0, 5}}}, 2, 1};
    sculpture_stroke_begin(piece);
    ASSERT_EQ(sculpture_apply(piece, &t, &d, nullptr), STATUS_OK);
    ASSERT_EQ(sculpture_stroke_end(piece), STATUS_OK);
    sculpture_attend(piece);
}

uint64_t digest_of(const std::vector<double> &strokes)
{
    history_finding finding;
    auto piece = std::make_unique<sculpture>();
    EXPECT_EQ(sculpture_open(piece.get(), nullptr, 1000, nullptr, 1, &finding), STATUS_OK);
    for (const double x : strokes)
        stroke(piece.get(), x);
    const uint64_t digest = sculpture_digest(piece.get());
    EXPECT_EQ(sculpture_close(piece.get()), STATUS_OK);
    return digest;
}

class switching_in_memory : public testing::Test {
protected:
    void SetUp() override
    {
        shelf s;
        ASSERT_EQ(shelf_open(&s, disk.port()), "");
        int number = 0;
        for (const char *name : {"one", "two", "three"})
            ASSERT_EQ(shelf_new(&s, name, &number), "");
        disk.watch = [this](const std::string &folder, const std::string &) { gate.pass(folder); };
        switching_wishes wishes;
        wishes.settings = FEW;
        going = switching_open(disk.port(), wishes);
    }
    void TearDown() override
    {
        gate.hold("");
        if (table.piece)
            switching_put_away(going, &table);
        switching_close(going);
        EXPECT_TRUE(disk.stores.empty());
    }
    void go(int number)
    {
        switching_begin(going, number);
        ASSERT_EQ(switching_end(going, &table), "");
        ASSERT_EQ(table.number, number);
    }
    uint64_t digest(int number)
    {
        if (table.number != number)
            go(number);
        return sculpture_digest(table.piece.get());
    }

    shelf_disk disk;
    barrier gate;
    switching *going = nullptr;
    switching_piece table;
};

TEST_F(switching_in_memory, the_old_piece_is_sculpted_while_the_new_one_is_opened)
{
    go(1);
    gate.hold("piece-0002");
    switching_begin(going, 2);
    gate.await_one();
    for (int n = 0; n < 5; n++)
        stroke(table.piece.get(), 4.0 * n);
    EXPECT_TRUE(switching_is_under_way(going));
    EXPECT_FALSE(switching_is_ready(going));
    EXPECT_LT(switching_part(going), 1);
    gate.hold("");
    ASSERT_EQ(switching_end(going, &table), "");
    EXPECT_FALSE(switching_is_under_way(going));
    EXPECT_EQ(table.number, 2);
    EXPECT_EQ(digest(2), digest_of({}));
    EXPECT_EQ(digest(1), digest_of({0, 4, 8, 12, 16}));
}

TEST_F(switching_in_memory, the_new_piece_is_sculpted_while_the_old_one_is_closed)
{
    go(1);
    stroke(table.piece.get(), 3);
    switching_begin(going, 2);
    while (!switching_is_ready(going))
        std::this_thread::yield();
    gate.hold("piece-0001");
    ASSERT_EQ(switching_end(going, &table), "");
    gate.await_one();
    stroke(table.piece.get(), 5);
    EXPECT_EQ(sculpture_undo(table.piece.get()), STATUS_OK);
    EXPECT_EQ(switching_trouble_take(going), "");
    gate.hold("");
    EXPECT_EQ(digest(2), digest_of({}));
    EXPECT_EQ(digest(1), digest_of({3}));
    EXPECT_TRUE(table.piece->history.field.there) << "closing writes a checkpoint";
}

TEST_F(switching_in_memory, a_piece_that_is_still_being_closed_can_be_asked_for)
{
    go(1);
    stroke(table.piece.get(), 3);
    switching_begin(going, 2);
    while (!switching_is_ready(going))
        std::this_thread::yield();
    gate.hold("piece-0001");
    ASSERT_EQ(switching_end(going, &table), "");
    gate.await_one();
    switching_begin(going, 1);
    stroke(table.piece.get(), 5);
    EXPECT_FALSE(switching_is_ready(going));
    gate.hold("");
    ASSERT_EQ(switching_end(going, &table), "");
    EXPECT_EQ(table.number, 1);
    EXPECT_EQ(sculpture_digest(table.piece.get()), digest_of({3}));
    EXPECT_EQ(sculpture_undo(table.piece.get()), STATUS_OK) << "with its history";
    EXPECT_EQ(digest(2), digest_of({5}));
}

TEST_F(switching_in_memory, never_more_than_two_are_open)
{
    go(1);
    stroke(table.piece.get(), 3); /* so that closing has something to write */
    switching_begin(going, 2);
    while (!switching_is_ready(going))
        std::this_thread::yield();
    gate.hold("piece-0001");
    ASSERT_EQ(switching_end(going, &table), "");
    gate.await_one();
    switching_begin(going, 3);
    std::this_thread::sleep_for(std::chrono::milliseconds(20)); /* for what must not happen */
    {
        const std::lock_guard<std::mutex> lock(disk.guard);
        EXPECT_EQ(disk.stores.count("piece-0003"), 0u);
    }
    gate.hold("");
    ASSERT_EQ(switching_end(going, &table), "");
    EXPECT_EQ(table.number, 3);
}

TEST_F(switching_in_memory, what_cannot_be_opened_leaves_the_table_as_it_is)
{
    go(1);
    stroke(table.piece.get(), 3);
    byte_store store;
    const shelf_port port = disk.port();
    ASSERT_EQ(port.open("piece-0002", &store), "");
    switching_begin(going, 2);
    EXPECT_NE(switching_end(going, &table).find("piece-0002"), std::string::npos);
    port.close(store);
    EXPECT_EQ(table.number, 1);
    stroke(table.piece.get(), 5);
    go(2);
    EXPECT_EQ(digest(1), digest_of({3, 5}));
}

TEST_F(switching_in_memory, a_piece_that_does_not_open_is_told_and_its_store_closed)
{
    switching_wishes impossible;
    impossible.settings = {0, 0, 0, 0, 0};
    switching *other = switching_open(disk.port(), impossible);
    switching_begin(other, 3);
    EXPECT_EQ(switching_end(other, &table).find("piece-0003: "), 0u);
    EXPECT_EQ(table.number, 0);
    EXPECT_TRUE(disk.stores.empty());
    switching_close(other);
}

TEST_F(switching_in_memory, what_closing_could_not_do_is_told)
{
    go(1);
    switching_begin(going, 2);
    while (!switching_is_ready(going))
        std::this_thread::yield();
    stroke(table.piece.get(), 3);
    {
        const std::lock_guard<std::mutex> lock(disk.guard);
        disk.dead = true;
    }
    ASSERT_EQ(switching_end(going, &table), "");
    std::string text;
    while (text.empty())
        text = switching_trouble_take(going);
    EXPECT_EQ(text.find("piece-0001: "), 0u) << text;
    EXPECT_EQ(switching_trouble_take(going), "");
    const std::lock_guard<std::mutex> lock(disk.guard); /* the other piece's thread is at work */
    disk.dead = false;
}

TEST_F(switching_in_memory, what_was_opened_and_is_not_wanted_is_closed)
{
    switching_begin(going, 2); /* and TearDown looks that nothing stays open */
}

} // namespace
