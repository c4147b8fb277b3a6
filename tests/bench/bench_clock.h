/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Time for benchmarks on a machine that has other things to do: a clock, a probe that notices when somebody
 *          else had the machine, and quantiles.
 * Is not:  What is measured (bench_dabs.h, bench_whole.h).
 * Shape:   the probe is a thread on another core that reads the clock without pause; a gap between two readings is time
 *          it did not have. The measured thread's own loss is its wall time less its processor time.
 * Units:   seconds.
 * Owner:   a probe owns its thread and keeps the calling thread on its core for as long as it lives.
 * Errors:  on a machine with one core there is no probe thread; only the own loss is seen then.
 */
#ifndef GLAISE_BENCH_BENCH_CLOCK_H
#define GLAISE_BENCH_BENCH_CLOCK_H

#include <atomic>
#include <thread>
#include <vector>

double bench_clock_wall_s();
double bench_clock_thread_s(); /* processor time of the calling thread */

/* Of an empty list: 0. */
double bench_clock_quantile(std::vector<double> of, double part);
double bench_clock_median(const std::vector<double> &of);

/* More than this lost in a round and the round does not count. */
constexpr double bench_clock_loss_max_s = 1e-3;

class bench_clock_probe {
public:
    /* threads: how many are measured; with more than one there is no core left for the probe's thread. */
    explicit bench_clock_probe(int threads);
    ~bench_clock_probe();
    bench_clock_probe(const bench_clock_probe &) = delete;
    bench_clock_probe &operator=(const bench_clock_probe &) = delete;

    /* A span of measuring; spans of one round add up. */
    void begin();
    void end();
    /* The worst of the round: longest gap within its spans, or time the measured thread lost in them. Starts afresh. */
    double take_loss_s();

private:
    void spin(int core);

    std::atomic<bool> over{false}, watching{false};
    std::atomic<double> longest_gap_s{0};
    double began_wall_s = 0, began_thread_s = 0, lost_s = 0;
    std::thread other;
};

#endif
