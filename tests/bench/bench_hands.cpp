/* SPDX-License-Identifier: Apache-2.0 */
#include "bench_hands.h"

#include "bench_clock.h"
#include "station/crew_of_threads.h"

#include <cstdio>

namespace {

constexpr double radii[] = {4, 8, 16, 32}, amounts[] = {0.25, 0.25, 0.1, 0.02};
constexpr size_t rounds_kept = 5, rounds_tried = 15;

struct one_turn {
    std::vector<double> dab_s;
    double lost_s; /* in which the calling thread did not run, waiting for the other left out */
    uint64_t digest;
};

one_turn turn_of(bench_scene &s, const std::vector<bench_object_dab> &dabs, const crew *hands)
{
    s.restore();
    s.rig->number_from(0);
    s.rig->field_clay.crew = hands;
    one_turn t = {{}, 0, 0};
    const double wall_s = bench_clock_wall_s(), own_s = bench_clock_thread_s();
    for (const bench_object_dab &d : dabs) {
        const double start = bench_clock_wall_s();
        s.rig->apply(d);
        t.dab_s.push_back(bench_clock_wall_s() - start);
    }
    t.lost_s = bench_clock_wall_s() - wall_s - (bench_clock_thread_s() - own_s);
    t.digest = clay_digest(&s.rig->field_clay) ^ surface_digest(&s.rig->skin);
    s.rig->field_clay.crew = nullptr;
    return t;
}

} // namespace

void bench_hands_measure(bench_scene &s, bool quick, bench_record &figures)
{
    crew_of_threads *two = crew_of_threads_open(2);
    bench_rig_demand(two != nullptr, "no second thread");
    std::printf("hands on %s, toothpaste, %s; microseconds a dab\n%3s %9s %9s %6s   %s\n", s.name.c_str(),
                lanes_name(s.rig->field_clay.rows), "R", "one", "two", "x", "rounds thrown out, of those tried");
    for (int n = 0; n < 4; n++) {
        const std::vector<bench_object_dab> dabs =
            bench_object_spiral(s.pristine, radii[n], amounts[n], quick ? 40 : radii[n] > 20 ? 60 : 200);
        std::vector<double> one_us, two_us, ratio;
        size_t tried = 0;
        for (; tried < rounds_tried && ratio.size() < rounds_kept; tried++) {
            const one_turn a = turn_of(s, dabs, nullptr), b = turn_of(s, dabs, crew_of_threads_port(two));
            bench_rig_demand(a.digest == b.digest, "two hands leave other bits than one");
            if (a.lost_s > bench_clock_loss_max_s || b.lost_s > bench_clock_loss_max_s)
                continue;
            one_us.push_back(1e6 * bench_clock_median(a.dab_s));
            two_us.push_back(1e6 * bench_clock_median(b.dab_s));
            ratio.push_back(one_us.back() / two_us.back());
        }
        std::printf("%3.0f %9.1f %9.1f %6.2f   %zu/%zu\n", radii[n], bench_clock_median(one_us),
                    bench_clock_median(two_us), bench_clock_median(ratio), tried - ratio.size(), tried);
        figures.add("hands", {{"object", s.name}},
                   {{"radius", radii[n]}, {"one_us", bench_clock_median(one_us)},
                    {"two_us", bench_clock_median(two_us)}, {"ratio", bench_clock_median(ratio)}});
    }
    std::printf("\n");
    crew_of_threads_close(two);
}
