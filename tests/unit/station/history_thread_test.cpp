/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: with a thread of its own, history keeps the same strokes, and never makes the sculpture's thread wait for the
 *       medium: a store whose syncs hang holds up acknowledgement and nothing else.
 * Method: a folder in memory whose sync can be held shut by the test; pieces opened again from what it holds. No clock:
 *         what must not wait is done while the gate is shut. */
#include "station/history_thread.h"

#include "tests/unit/history/memory_store.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <memory>
#include <mutex>

namespace {

/* The memory store behind a lock, with a gate before every sync. */
struct gated_store {
    memory_store inner;
    byte_store port = inner.port();
    std::mutex guard;
    std::condition_variable moved;
    bool shut = false;
    int waiting = 0;

    void set(bool is_shut)
    {
        const std::lock_guard<std::mutex> lock(guard);
        shut = is_shut;
        moved.notify_all();
    }
    void await_waiting()
    {
        std::unique_lock<std::mutex> lock(guard);
        moved.wait(lock, [this] { return waiting > 0; });
    }
    static gated_store &of(void *self) { return *static_cast<gated_store *>(self); }
    byte_store store()
    {
        byte_store s = port;
        s.self = this;
        s.read = [](void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got) {
            return of(self).port.read(of(self).port.self, name, offset, bytes, n, got);
        };
        s.write = [](void *self, const char *name, uint64_t offset, const void *bytes, size_t n) {
            return of(self).port.write(of(self).port.self, name, offset, bytes, n);
        };
        s.size = [](void *self, const char *name, uint64_t *bytes, bool *exists) {
            return of(self).port.size(of(self).port.self, name, bytes, exists);
        };
        s.truncate = [](void *self, const char *name, uint64_t bytes) {
            return of(self).port.truncate(of(self).port.self, name, bytes);
        };
        s.rename = [](void *self, const char *from, const char *to) {
            return of(self).port.rename(of(self).port.self, from, to);
        };
        s.remove = [](void *self, const char *name) { return of(self).port.remove(of(self).port.self, name); };
        s.list = [](void *self, void (*take)(void *, const char *), void *into) {
            return of(self).port.list(of(self).port.self, take, into);
        };
        s.sync = [](void *self, const char *name) {
            gated_store &g = of(self);
            {
                std::unique_lock<std::mutex> lock(g.guard);
                g.waiting++;
                g.moved.notify_all();
                g.moved.wait(lock, [&g] { return !g.shut; });
                g.waiting--;
            }
            return g.port.sync(g.port.self, name);
        };
        return s;
    }
};

constexpr history_settings settings = {40, 1 << 16, 1 << 24, 1 << 24, 4};

class beside : public testing::Test {
protected:
    void SetUp() override
    {
        ASSERT_EQ(ellipsoid_init(&ball, ELLIPSOID_WYVILL, 1), STATUS_OK);
        open();
    }
    void TearDown() override
    {
        close();
        EXPECT_EQ(disk.inner.misuse, "");
    }
    void open()
    {
        history_finding finding;
        const byte_store store = disk.store();
        ASSERT_EQ(sculpture_open(piece.get(), &store, 4000, &settings, 1, &finding), STATUS_OK);
        ASSERT_STREQ(finding.text, "");
        thread = history_thread_open(piece.get(), [this](const keeper_facts &f) { told.push_back(f.kept_digest); });
        ASSERT_NE(thread, nullptr);
    }
    void close()
    {
        history_thread_close(thread);
        ASSERT_EQ(sculpture_close(piece.get()), STATUS_OK);
    }
    void dab(double x)
    {
        const tool t = {ellipsoid_shape(&ball), ACTION_TOOTHPASTE, 7, deform_default()};
        const sculpture_dab d = {{{x, 0, 0}, {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}}}, 2, 1};
        ASSERT_EQ(sculpture_apply(piece.get(), &t, &d, nullptr), STATUS_OK);
    }
    void stroke(double x)
    {
        sculpture_stroke_begin(piece.get());
        for (int n = 0; n < 3; n++) {
            dab(x + n);
            sculpture_part(piece.get());
        }
        ASSERT_EQ(sculpture_stroke_end(piece.get()), STATUS_OK);
        sculpture_attend(piece.get());
    }
    void settle() { piece->keeper.settle(piece->keeper.self); }

    gated_store disk;
    std::unique_ptr<sculpture> piece = std::make_unique<sculpture>();
    history_thread *thread = nullptr;
    std::vector<uint64_t> told; /* the thread's, until it has settled */
    ellipsoid ball;
};

TEST_F(beside, strokes_are_kept_and_come_back)
{
    std::vector<uint64_t> states = {sculpture_digest(piece.get())};
    for (int n = 0; n < 30; n++) {
        ASSERT_NO_FATAL_FAILURE(stroke(3 * n));
        states.push_back(sculpture_digest(piece.get()));
    }
    settle();
    EXPECT_EQ(sculpture_facts(piece.get()).kept, sculpture_facts(piece.get()).put);
    ASSERT_FALSE(told.empty());
    EXPECT_EQ(told.back(), clay_digest(&piece->clay));
    close();
    open();
    for (size_t n = states.size() - 1; n-- > 0;) {
        ASSERT_EQ(sculpture_undo(piece.get()), STATUS_OK);
        ASSERT_EQ(sculpture_digest(piece.get()), states[n]);
    }
    EXPECT_EQ(sculpture_undo(piece.get()), STATUS_HISTORY_ENDS);
    for (size_t n = 1; n < states.size(); n++) {
        ASSERT_EQ(sculpture_redo(piece.get()), STATUS_OK);
        ASSERT_EQ(sculpture_digest(piece.get()), states[n]);
    }
}

TEST_F(beside, a_sync_that_hangs_holds_up_no_stroke_and_acknowledges_nothing)
{
    ASSERT_NO_FATAL_FAILURE(stroke(0));
    settle();
    const uint64_t kept = sculpture_facts(piece.get()).kept, kept_digest = sculpture_facts(piece.get()).kept_digest;
    disk.set(true);
    for (int n = 1; n < 40; n++) {
        ASSERT_EQ(sculpture_room(piece.get()), STATUS_OK) << n;
        ASSERT_NO_FATAL_FAILURE(stroke(2 * n));
    }
    disk.await_waiting();
    EXPECT_EQ(sculpture_facts(piece.get()).kept, kept);
    EXPECT_EQ(sculpture_facts(piece.get()).kept_digest, kept_digest);
    disk.set(false);
    settle();
    EXPECT_EQ(sculpture_facts(piece.get()).kept_digest, clay_digest(&piece->clay));
}

TEST_F(beside, when_too_much_waits_no_stroke_begins)
{
    disk.set(true);
    int strokes = 0;
    while (sculpture_room(piece.get()) == STATUS_OK) {
        ASSERT_LT(strokes, 1000);
        ASSERT_NO_FATAL_FAILURE(stroke(strokes++ % 50));
    }
    EXPECT_EQ(sculpture_room(piece.get()), STATUS_BUSY);
    EXPECT_GT(strokes, 20);
    const uint64_t digest = sculpture_digest(piece.get());
    disk.set(false);
    settle();
    EXPECT_EQ(sculpture_room(piece.get()), STATUS_OK);
    close();
    open();
    EXPECT_EQ(sculpture_digest(piece.get()), digest);
}

TEST_F(beside, a_step_is_ready_only_when_it_was_read)
{
    ASSERT_NO_FATAL_FAILURE(stroke(0));
    settle();
    disk.set(true);
    ASSERT_NO_FATAL_FAILURE(stroke(5));
    disk.await_waiting();
    const uint64_t digest = sculpture_digest(piece.get());
    sculpture_step_begin(piece.get(), HISTORY_BACK, 0);
    EXPECT_FALSE(sculpture_step_is_ready(piece.get())) << "the thread hangs in a sync";
    EXPECT_EQ(sculpture_digest(piece.get()), digest);
    disk.set(false);
    ASSERT_EQ(sculpture_step_end(piece.get()), STATUS_OK);
    EXPECT_NE(sculpture_digest(piece.get()), digest);
    ASSERT_EQ(sculpture_redo(piece.get()), STATUS_OK);
    EXPECT_EQ(sculpture_digest(piece.get()), digest);
}

TEST_F(beside, a_checkpoint_is_written_while_strokes_go_on)
{
    uint64_t digest = 0;
    for (int n = 0; n < 60; n++) {
        ASSERT_NO_FATAL_FAILURE(stroke(n % 20));
        digest = sculpture_digest(piece.get());
        if (n % 10 == 9)
            settle();
    }
    settle();
    sculpture_attend(piece.get());
    EXPECT_TRUE(disk.inner.has(HISTORY_FIELD_NAME, CHECKPOINT_HEADER_BYTES));
    close();
    EXPECT_EQ(piece->clay.frozen, 0u);
    open();
    EXPECT_EQ(sculpture_digest(piece.get()), digest);
}

TEST_F(beside, what_the_disk_refuses_is_kept_when_it_takes_it)
{
    disk.set(true);
    ASSERT_NO_FATAL_FAILURE(stroke(0));
    disk.await_waiting();
    disk.inner.fail_on = true; /* the thread hangs: the store is the test's */
    disk.inner.fail_at = 1;
    disk.set(false);
    settle();
    EXPECT_EQ(sculpture_facts(piece.get()).medium, HISTORY_MEDIUM_FAILS);
    EXPECT_LT(sculpture_facts(piece.get()).kept, sculpture_facts(piece.get()).put);
    const uint64_t digest = sculpture_digest(piece.get());
    history_thread_close(thread);
    disk.inner.fail_at = 0;
    disk.inner.fail_on = false;
    thread = history_thread_open(piece.get(), nullptr);
    ASSERT_NO_FATAL_FAILURE(stroke(9));
    settle();
    EXPECT_EQ(sculpture_facts(piece.get()).medium, HISTORY_MEDIUM_GOOD);
    ASSERT_EQ(sculpture_undo(piece.get()), STATUS_OK);
    EXPECT_EQ(sculpture_digest(piece.get()), digest);
}

} // namespace
