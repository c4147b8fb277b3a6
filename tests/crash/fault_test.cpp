/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   whatever single call of the medium fails, whenever it fills up: nothing that was made is gone from memory,
 *         and once the medium is good again it is kept as a whole.
 * Method: one life of strokes, undo, redo and checkpoints, run again and again: each time the next call fails, before
 *         it did its work or after; or there is room for so many bytes and no more. Then the fault is lifted, what is
 *         left is kept, the power goes, and what comes up is compared.
 */
#include "tests/crash/crash_life.h"

#include <cstdio>

namespace {

enum { STEPS = 30, CALLS_MOST = 4000, CORNERS = 120 };

/* Makes the disk fail, in the n-th of its ways. */
using fault = void (*)(sim_disk &, uint64_t n);

void live_on(piece &p, seeded &chance)
{
    for (int n = 0; n < STEPS; n++) {
        const uint64_t digest = p.digest();
        const double die = seeded_real(chance, 0, 1);
        status s = STATUS_OK;
        if (die < 0.6 && history_room(&p.h) == STATUS_OK) {
            ASSERT_EQ(p.stretch(piece_stroke_random(chance, CORNERS, 5), true), STATUS_OK);
            (void)!p.keep();
        } else if (die < 0.8) {
            s = p.undo();
        } else if (die < 0.9) {
            s = p.redo();
        } else {
            (void)!p.field();
        }
        ASSERT_NE(s, STATUS_CORRUPT) << p.h.trouble.text;
        ASSERT_EQ(p.digest(), p.h.digest);
        if (s == STATUS_HISTORY_ENDS) {
            ASSERT_EQ(p.digest(), digest);
        }
    }
}

void live_with(fault happens, uint64_t n, uint64_t *calls_out)
{
    SCOPED_TRACE("fault " + std::to_string(n));
    const piece_ring limits = {3, RING_FILE_BYTES_MIN, 6 * RING_FILE_BYTES_MIN};
    seeded chance{crash_life_seed()};
    sim_disk disk(n);
    uint64_t digest, sequence;
    {
        piece p(disk.port(), limits);
        ASSERT_EQ(p.opened, STATUS_OK);
        happens(disk, n);
        ASSERT_NO_FATAL_FAILURE(live_on(p, chance));
        *calls_out = disk.calls;
        disk.fail_at = 0;
        disk.most_bytes = UINT64_MAX;
        ASSERT_EQ(p.keep(), STATUS_OK) << p.h.trouble.text;
        ASSERT_EQ(p.h.kept, p.h.sequence);
        ASSERT_EQ(p.h.medium, HISTORY_MEDIUM_GOOD);
        ASSERT_EQ(history_room(&p.h), STATUS_OK);
        digest = p.digest();
        sequence = p.h.sequence;
        ASSERT_EQ(disk.misuse, "");
    }
    const std::unique_ptr<sim_disk> left = disk.after_cut(n);
    piece again(left->port(), limits);
    crash_life_counted.recoveries++;
    ASSERT_EQ(again.opened, STATUS_OK) << again.finding.text;
    ASSERT_STREQ(again.finding.text, "");
    ASSERT_EQ(again.digest(), digest);
    ASSERT_EQ(again.h.sequence, sequence);
}

TEST(fault, every_call_fails_once)
{
    uint64_t calls = CALLS_MOST, faults = 0;
    for (uint64_t n = 2; n < calls && n < CALLS_MOST; n++, faults += 2) {
        uint64_t after;
        ASSERT_NO_FATAL_FAILURE(live_with([](sim_disk &d, uint64_t at) { d.fail_at = at; }, n, &calls));
        ASSERT_NO_FATAL_FAILURE(live_with(
            [](sim_disk &d, uint64_t at) {
                d.fail_at = at;
                d.fail_having_done = true;
            },
            n, &after));
    }
    EXPECT_GT(faults, 200u);
    std::printf("%llu faults\n", static_cast<unsigned long long>(faults));
}

TEST(fault, full_at_every_size)
{
    enum { SIZES = 300, STEP_BYTES = 1500 };
    for (uint64_t n = 1; n <= SIZES; n++) {
        uint64_t calls;
        ASSERT_NO_FATAL_FAILURE(
            live_with([](sim_disk &d, uint64_t at) { d.most_bytes = at * STEP_BYTES; }, n, &calls));
    }
}

/* Strokes, with all that can wait done between them, on a disk that has room for so many bytes more than it holds; the
   power goes while it is full, the next start finds it so and goes on; then there is room again. */
void fill_up(uint64_t n)
{
    enum { BEFORE = 6, WHILE_FULL = 14, STEP_BYTES = 3000, SLICES_MOST = 500 };
    SCOPED_TRACE("room for " + std::to_string(n * STEP_BYTES));
    const piece_ring limits = {40, RING_FILE_BYTES_MIN, 1000 * uint64_t{RING_FILE_BYTES_MIN}};
    seeded chance{n + 1};
    auto disk = std::make_unique<sim_disk>(n);
    const auto rest = [](piece &p) {
        int slices = 0;
        for (bool more = true; more && slices < SLICES_MOST; slices++) {
            (void)!history_keep(&p.h);
            if (p.h.wants_field && !p.h.writer && p.h.medium == HISTORY_MEDIUM_GOOD)
                (void)!history_field_begin(&p.h, &p.c);
            more = history_work(&p.h) || (p.h.wants_field && p.h.medium == HISTORY_MEDIUM_GOOD);
        }
        ASSERT_LT(slices, SLICES_MOST) << "it never ends";
    };
    uint64_t kept = 0;
    for (const bool full : {false, true, true, false}) {
        piece p(disk->port(), limits);
        crash_life_counted.recoveries++;
        ASSERT_EQ(p.opened, STATUS_OK);
        ASSERT_STREQ(p.finding.text, "");
        ASSERT_GE(p.h.sequence, kept) << "what was kept is gone";
        if (full && disk->most_bytes == UINT64_MAX)
            disk->most_bytes = disk->held() + n * STEP_BYTES;
        disk->most_bytes = full ? disk->most_bytes : UINT64_MAX;
        int made = 0;
        for (int step = 0; step < (full ? WHILE_FULL : BEFORE); step++) {
            if (history_room(&p.h) == STATUS_OK) {
                ASSERT_EQ(p.stretch(piece_stroke_random(chance, CORNERS, 5), true), STATUS_OK);
                made++;
            }
            const uint64_t digest = p.digest();
            ASSERT_NO_FATAL_FAILURE(rest(p));
            ASSERT_EQ(p.digest(), digest);
        }
        ASSERT_EQ(disk->misuse, "");
        ASSERT_EQ(p.h.kept, p.h.sequence) << "what fills it is our own undo, and there is a reserve";
        ASSERT_EQ(made, full ? WHILE_FULL : BEFORE);
        kept = p.h.kept;
        auto left = disk->after_cut(n);
        left->most_bytes = disk->most_bytes;
        disk = std::move(left);
    }
}

TEST(fault, full_at_every_level_and_over_two_starts)
{
    for (uint64_t n = 0; n < 120; n++)
        ASSERT_NO_FATAL_FAILURE(fill_up(n));
}

} // namespace
