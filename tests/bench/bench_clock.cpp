/* SPDX-License-Identifier: Apache-2.0 */
#include "bench_clock.h"

#include <algorithm>
#include <ctime>
#include <pthread.h>
#include <sched.h>

namespace {

double read_s(clockid_t clock)
{
    timespec t;
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void keep_on(int core)
{
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(static_cast<size_t>(core), &set);
    pthread_setaffinity_np(pthread_self(), sizeof set, &set);
}

std::vector<int> cores()
{
    cpu_set_t set;
    std::vector<int> found;
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        for (int n = 0; n < CPU_SETSIZE; n++)
            if (CPU_ISSET(static_cast<size_t>(n), &set))
                found.push_back(n);
    return found;
}

} // namespace

double bench_clock_wall_s() { return read_s(CLOCK_MONOTONIC); }
double bench_clock_thread_s() { return read_s(CLOCK_THREAD_CPUTIME_ID); }

double bench_clock_quantile(std::vector<double> of, double part)
{
    if (of.empty())
        return 0;
    std::sort(of.begin(), of.end());
    return of[static_cast<size_t>(part * static_cast<double>(of.size() - 1) + 0.5)];
}

double bench_clock_median(const std::vector<double> &of) { return bench_clock_quantile(of, 0.5); }

bench_clock_probe::bench_clock_probe(int threads)
{
    const std::vector<int> all = cores();
    if (all.size() < 2 || threads > 1)
        return;
    keep_on(all.front());
    other = std::thread([this, core = all.back()] { spin(core); });
}

bench_clock_probe::~bench_clock_probe()
{
    over = true;
    if (other.joinable())
        other.join();
}

void bench_clock_probe::spin(int core)
{
    keep_on(core);
    double last = 0;
    while (!over) {
        if (!watching) {
            last = 0;
            const timespec pause = {0, 100000};
            nanosleep(&pause, nullptr);
            continue;
        }
        const double now = bench_clock_wall_s();
        if (last > 0 && now - last > longest_gap_s)
            longest_gap_s = now - last;
        last = now;
    }
}

void bench_clock_probe::begin()
{
    watching = true;
    began_wall_s = bench_clock_wall_s();
    began_thread_s = bench_clock_thread_s();
}

void bench_clock_probe::end()
{
    lost_s += (bench_clock_wall_s() - began_wall_s) - (bench_clock_thread_s() - began_thread_s);
    watching = false;
}

double bench_clock_probe::take_loss_s()
{
    const double loss = std::max(lost_s, longest_gap_s.exchange(0));
    lost_s = 0;
    return loss;
}
