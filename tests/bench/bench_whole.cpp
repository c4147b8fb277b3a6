/* SPDX-License-Identifier: Apache-2.0 */
#include "bench_whole.h"

#include "vtk_peer.h"

#include "clay/capacity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>

namespace {

double copied_bytes_per_s(size_t block, int times)
{
    std::vector<char> from(block, 1), to(block, 2);
    double best = 0;
    for (int round = 0; round < 7; round++) {
        const double start = bench_clock_wall_s();
        for (int n = 0; n < times; n++) {
            std::memcpy(to.data(), from.data(), block);
            /* The copy must happen each time. */
            __asm__ volatile("" : : "r"(to.data()), "r"(from.data()) : "memory");
        }
        best = std::max(best, 2.0 * static_cast<double>(block) * times / (bench_clock_wall_s() - start));
    }
    return best;
}

/* Milliseconds of a few calls, the quiet ones where there are any. */
double measure_ms(int rounds, bench_clock_probe &probe, const std::function<void()> &act)
{
    std::vector<double> quiet, all;
    act();
    for (int n = 0; n < 3 * rounds && quiet.size() < static_cast<size_t>(rounds); n++) {
        probe.take_loss_s();
        probe.begin();
        const double start = bench_clock_wall_s();
        act();
        all.push_back(1e3 * (bench_clock_wall_s() - start));
        probe.end();
        if (probe.take_loss_s() <= bench_clock_loss_max_s)
            quiet.push_back(all.back());
    }
    return bench_clock_median(quiet.size() >= 2 ? quiet : all);
}

void print_whole(const bench_scene &s, const char *name, double ms, uint64_t triangles, bench_record &figures)
{
    std::printf("  %-34s %9.2f ms %9.1f M triangles/s %9llu triangles\n", name, ms,
                static_cast<double>(triangles) / ms / 1e3, static_cast<unsigned long long>(triangles));
    std::fflush(stdout);
    figures.add("whole", {{"object", s.name}, {"engine", name}},
               {{"ms", ms}, {"triangles", static_cast<double>(triangles)}});
    const double mine = static_cast<double>(s.rig->skin.triangles), other = static_cast<double>(triangles);
    bench_rig_demand(std::abs(mine - other) <= 0.01 * mine, std::string(name) + " makes another surface");
}

void print_memory(const bench_scene &s, bench_record &figures)
{
    /* Of engines that hold this object and never held more. */
    const double corners = static_cast<double>(s.pristine.corners);
    bench_rig fresh(CAPACITY_BRICKS, 1);
    bench_rig_demand(clay_copy(&fresh.field_clay, &s.pristine) == STATUS_OK, "clay_copy");
    bench_rig_demand(surface_rebuild(&fresh.skin, &fresh.field_clay, nullptr) == STATUS_OK, "surface_rebuild");
    const double field = fresh.clay_bytes() / corners, skin = fresh.surface_bytes() / corners;
    std::printf("  bytes a stored corner: ours %.1f, and %.1f for the surface; %.1f corners a brick", field, skin,
                corners / clay_brick_count(&s.rig->field_clay));
    std::vector<bench_record::number> numbers = {{"field", field}, {"surface", skin}};
    if (s.vdb) {
        numbers.push_back({"vdb", static_cast<double>(s.vdb->bytes()) / corners});
        std::printf("; OpenVDB %.1f", numbers.back().second);
    }
    std::printf("\n");
    figures.add("memory", {{"object", s.name}}, numbers);
}

} // namespace

bench_whole_bandwidth bench_whole_measure_bandwidth(bench_record &figures)
{
    const bench_whole_bandwidth b = {copied_bytes_per_s(size_t{128} << 10, 2000),
                                     copied_bytes_per_s(size_t{256} << 20, 1)};
    std::printf("memcpy moves (read and written) %.0f GB/s in cache (128 KiB), %.1f GB/s from memory (256 MiB)\n\n",
                b.cache / 1e9, b.memory / 1e9);
    figures.add("memcpy", {}, {{"cache_bytes_per_s", b.cache}, {"memory_bytes_per_s", b.memory}});
    return b;
}

void bench_whole_measure(bench_scene &s, bool quick, bench_clock_probe &probe, bench_record &figures)
{
    const int rounds = quick ? 2 : 5;
    s.restore();
    std::printf("whole surface of %s\n", s.name.c_str());
    for (const lanes choice : bench_rig::choices()) {
        s.rig->use_rows(choice);
        const double ms = measure_ms(rounds, probe, [&] {
            bench_rig_demand(surface_rebuild(&s.rig->skin, &s.rig->field_clay, nullptr) == STATUS_OK, "surface_rebuild");
        });
        print_whole(s, (std::string("ours, ") + lanes_name(choice)).c_str(), ms, s.rig->skin.triangles, figures);
    }
    s.rig->use_rows(bench_rig::choices()[0]);
    if (s.vdb) {
        const double ms = measure_ms(rounds, probe, [&] { s.vdb->whole(); });
        print_whole(s, "OpenVDB, normals and colours", ms, s.vdb->counts().triangles, figures);
    } else {
        std::printf("  OpenVDB is not here\n");
    }
    if (const std::unique_ptr<vtk_peer> vtk = vtk_peer_open(s.rig->field_clay)) {
        uint64_t triangles = 0;
        for (const bool colours : {false, true}) {
            const double ms = measure_ms(rounds, probe, [&] { triangles = vtk->whole(colours); });
            print_whole(s, colours ? "VTK FlyingEdges, normals, colours" : "VTK FlyingEdges, normals", ms, triangles,
                        figures);
        }
    } else {
        std::printf("  VTK is not here\n");
    }
    print_memory(s, figures);
    std::printf("\n");
}

bool bench_whole_soak(bench_scene &s, int dabs, bench_record &figures)
{
    static const double radii[] = {4, 6, 9};
    static const action kinds[] = {ACTION_TOOTHPASTE, ACTION_SOFT_ERASER, ACTION_SMOOTH};
    constexpr int places = 2000;
    s.restore();
    std::vector<std::vector<bench_object_dab>> paths;
    for (const double radius : radii)
        paths.push_back(bench_object_spiral(s.pristine, radius, 0.25, places));
    std::printf("soak: %d dabs on %s that add, erase and smooth\n", dabs, s.name.c_str());
    std::printf("%9s %12s %12s %12s %12s\n", "dabs", "field bytes", "surface", "corners", "us a dab");
    double first = 0, worst = 0, start = bench_clock_wall_s();
    for (int n = 0; n < dabs; n++) {
        const int turn = n / 3;
        bench_object_dab d = paths[static_cast<size_t>(turn % 3)][static_cast<size_t>(turn / 3 * 7 % places)];
        d.kind = kinds[n % 3];
        s.rig->apply(d);
        if ((n + 1) % (dabs / 10) != 0)
            continue;
        const double took_us = 1e6 * (bench_clock_wall_s() - start) / (dabs / 10);
        const double field = s.rig->clay_bytes(), skin = s.rig->surface_bytes();
        std::printf("%9d %12.0f %12.0f %12llu %12.1f\n", n + 1, field, skin,
                    static_cast<unsigned long long>(s.rig->field_clay.corners), took_us);
        figures.add("soak", {{"object", s.name}}, {{"dabs", n + 1}, {"field", field}, {"surface", skin}});
        first = first > 0 ? first : field + skin;
        worst = std::max(worst, field + skin);
        start = bench_clock_wall_s();
    }
    const bool flat = worst <= 1.05 * first;
    std::printf("%s\n\n", flat ? "flat" : "NOT FLAT: more than 5 % over the first tenth");
    return flat;
}
