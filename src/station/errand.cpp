/* SPDX-License-Identifier: Apache-2.0 */
#include "station/errand.h"

#include <atomic>
#include <memory>
#include <system_error>
#include <thread>

#include <sys/resource.h>

struct errand {
    errand_work work;
    std::string answer; /* the work's thread writes it before it is done */
    std::atomic<double> part{0};
    std::atomic<bool> done{false};
    std::thread thread;
};

namespace {

void run(errand *e)
{
    e->answer = e->work([e](double part) { e->part.store(part, std::memory_order_relaxed); });
    e->part.store(1, std::memory_order_relaxed);
    e->done.store(true, std::memory_order_release);
}

void live(errand *e)
{
    /* On Linux this is the calling thread's own. Refused, it only means that the errand gets its share of the cores. */
    (void)setpriority(PRIO_PROCESS, 0, ERRAND_NICENESS);
    run(e);
}

} // namespace

errand *errand_begin(errand_work work)
{
    auto e = std::make_unique<errand>();
    e->work = std::move(work);
    try {
        e->thread = std::thread(live, e.get());
    } catch (const std::system_error &) {
        run(e.get());
    }
    return e.release();
}

double errand_part(const errand *e) { return e->part.load(std::memory_order_relaxed); }
bool errand_is_done(const errand *e) { return e->done.load(std::memory_order_acquire); }

std::string errand_end(errand *e)
{
    if (e->thread.joinable())
        e->thread.join();
    std::string answer = std::move(e->answer);
    delete e;
    return answer;
}
