/* SPDX-License-Identifier: Apache-2.0 */
#include "station/crew_of_threads.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <system_error>
#include <thread>
#include <vector>

struct crew_of_threads {
    crew port{};
    std::vector<std::thread> threads;
    crew_job job = nullptr;
    void *on = nullptr;
    bool is_over = false;
    std::atomic<uint32_t> call{0}; /* number of the job: what is above was written before it moved on */
    std::atomic<uint32_t> busy{0}; /* shares of it that are not done */
    std::unique_ptr<std::atomic<uint32_t>[]> begun; /* by hand: the last job whose share somebody took */
};

namespace {

constexpr int LOOKS_A_CLOCK = 32;

/* Leaves the core to whoever shares it, for some dozen cycles. */
void pause_briefly()
{
#if defined(__x86_64__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield");
#endif
}

/* Until the number is another one: looks for a while, then sleeps. */
uint32_t await_change(const std::atomic<uint32_t> &number, uint32_t from)
{
    using clock = std::chrono::steady_clock;
    const clock::time_point end = clock::now() + std::chrono::microseconds(CREW_OF_THREADS_LOOK_US);
    for (;;) {
        for (int look = 0; look < LOOKS_A_CLOCK; look++) {
            const uint32_t now = number.load(std::memory_order_acquire);
            if (now != from)
                return now;
            pause_briefly();
        }
        if (clock::now() > end)
            number.wait(from, std::memory_order_acquire);
    }
}

/* Takes a share of job number `call`, unless somebody has. */
bool take(crew_of_threads *c, uint32_t hand, uint32_t call)
{
    uint32_t before = call - 1;
    return c->begun[hand].compare_exchange_strong(before, call, std::memory_order_acq_rel);
}

void hand_live(crew_of_threads *c, uint32_t hand)
{
    for (uint32_t call = 0;;) {
        call = await_change(c->call, call);
        if (!take(c, hand, call))
            continue; /* too late: the caller did it, and may be gone */
        if (c->is_over)
            return;
        c->job(c->on, hand, c->port.hands);
        if (c->busy.fetch_sub(1, std::memory_order_acq_rel) == 1)
            c->busy.notify_one();
    }
}

uint32_t call_out(crew_of_threads *c)
{
    const uint32_t call = c->call.fetch_add(1, std::memory_order_release) + 1;
    c->call.notify_all();
    return call;
}

void run(void *self, crew_job job, void *on)
{
    auto *c = static_cast<crew_of_threads *>(self);
    c->job = job;
    c->on = on;
    c->busy.store(c->port.hands - 1, std::memory_order_relaxed);
    const uint32_t call = call_out(c);
    job(on, 0, c->port.hands);
    for (uint32_t hand = 1; hand < c->port.hands; hand++)
        if (take(c, hand, call)) { /* still asleep, or its core is taken away */
            job(on, hand, c->port.hands);
            c->busy.fetch_sub(1, std::memory_order_acq_rel);
        }
    for (uint32_t busy = c->busy.load(std::memory_order_acquire); busy != 0;)
        busy = await_change(c->busy, busy);
}

} // namespace

crew_of_threads *crew_of_threads_open(uint32_t hands)
{
    if (hands < 1)
        return nullptr;
    auto c = std::make_unique<crew_of_threads>();
    c->port = {c.get(), run, hands};
    c->begun = std::make_unique<std::atomic<uint32_t>[]>(hands);
    try {
        for (uint32_t hand = 1; hand < hands; hand++)
            c->threads.emplace_back(hand_live, c.get(), hand);
    } catch (const std::system_error &) {
        crew_of_threads_close(c.release());
        return nullptr;
    }
    return c.release();
}

void crew_of_threads_close(crew_of_threads *c)
{
    if (!c)
        return;
    c->is_over = true;
    call_out(c);
    for (std::thread &t : c->threads)
        t.join();
    delete c;
}

const crew *crew_of_threads_port(const crew_of_threads *c) { return &c->port; }
