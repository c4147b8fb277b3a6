/* SPDX-License-Identifier: Apache-2.0 */
/* The sculptor's workload as tables: dabs of four radii and four actions on an object of one million corners and one of
 * twenty, whole surfaces, memory, history; beside OpenVDB, VTK and the paper's trees where they are here. Engines take
 * turns within a round and their fields are compared: on a difference the exit code is 1. On a busy machine trust the
 * ratios, and those only as far as the last column allows.
 *
 *   --quick          fewer dabs, two objects' worth of minutes become one
 *   --object 1M|20M  only that one
 *   --radius R       only 4, 8, 16 or 32, and no other table
 *   --soak           only: a hundred thousand dabs, memory every ten thousand; exit code 1 when it grows
 *   --threads N      1; with 2 what the second thread brings is measured, and nothing else
 *   --long           only: dabs while the piece is saved, exported, and another one opened
 *   --json FILE      the same numbers for programs */
#include "bench_dabs.h"
#include "bench_hands.h"
#include "bench_long.h"
#include "bench_machine.h"
#include "bench_stroke.h"
#include "bench_whole.h"
#include "vtk_peer.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

namespace {

struct options {
    bool quick = false, soak = false, long_work = false;
    double radius = 0;
    int threads = 1;
    std::string json;
    std::vector<std::string> objects = {"1M", "20M"};
};

[[noreturn]] void refuse(const char *what)
{
    std::fprintf(stderr,
                 "bench_workload: %s\n"
                 "usage: bench_workload [--quick] [--object 1M|20M] [--radius 4|8|16|32] [--soak] [--threads 1|2] [--long] "
                 "[--json FILE]\n",
                 what);
    std::exit(2);
}

options parse(int argc, char **argv)
{
    options o;
    for (int n = 1; n < argc; n++) {
        const std::string word = argv[n];
        const auto value = [&] {
            if (n + 1 >= argc)
                refuse((word + " needs a value").c_str());
            return std::string(argv[++n]);
        };
        if (word == "--quick") {
            o.quick = true;
        } else if (word == "--soak") {
            o.soak = true;
        } else if (word == "--long") {
            o.long_work = true;
        } else if (word == "--object") {
            o.objects = {value()};
            if (o.objects[0] != "1M" && o.objects[0] != "20M")
                refuse("--object knows 1M and 20M");
        } else if (word == "--radius") {
            const std::string r = value();
            if (r != "4" && r != "8" && r != "16" && r != "32")
                refuse("--radius knows 4, 8, 16 and 32");
            o.radius = std::atof(r.c_str());
        } else if (word == "--threads") {
            const std::string t = value();
            if (t != "1" && t != "2")
                refuse("--threads knows 1 and 2");
            o.threads = t == "2" ? 2 : 1;
        } else if (word == "--json") {
            o.json = value();
        } else {
            refuse((word + " is not an option").c_str());
        }
    }
    return o;
}

void print_machine(bench_record &figures)
{
    std::printf("%speers     OpenVDB %s, one thread, compiled with -O3 -march=native -DNDEBUG; VTK %s, one thread\n\n",
                bench_machine_text().c_str(), vdb_peer_version().c_str(), vtk_peer_version().c_str());
    figures.add("machine",
               {{"processor", bench_machine_processor()}, {"compiler", bench_machine_compiler()}, {"flags", BENCH_FLAGS},
                {"openvdb", vdb_peer_version()}, {"vtk", vtk_peer_version()}},
               {});
}

void print_legend()
{
    std::printf(
        "visited, dirtied as in 000 section 6; changed: other bits afterwards, by OpenVDB's count\n"
        "VDB        field as fast as we could write it, surface by VolumeToMesh at adaptivity 0, best of three ways:\n"
        "           masked, lent (leaves borrowed), copied (the region alone; generous)\n"
        "VDB x      OpenVDB's time over ours; trees: the paper's layout, one node per corner, over ours\n"
        "kB/dab     16 bytes a dirtied corner and the remade patches; cache, memory: what memcpy needs for them, us\n"
        "out        rounds thrown away because the machine was busy, of those tried; ~: too few quiet ones, filled up\n"
        "           with the least disturbed\n\n");
}

void run(const options &o, bench_record &figures, bool *flat)
{
    if (o.long_work) {
        for (const std::string &name : o.objects) {
            bench_scene scene(name);
            bench_long_measure(scene, o.quick, figures);
        }
        return;
    }
    if (o.threads > 1) {
        for (const std::string &name : o.objects) {
            bench_scene scene(name);
            bench_hands_measure(scene, o.quick, figures);
        }
        return;
    }
    /* The probe pins this thread; OpenVDB and VTK keep to it. */
    bench_clock_probe probe(o.threads);
    bench_dabs_setting set = {o.quick, o.threads, 1, 1};
    if (!o.soak) {
        const bench_whole_bandwidth b = bench_whole_measure_bandwidth(figures);
        set.cache_bytes_per_s = b.cache;
        set.memory_bytes_per_s = b.memory;
        print_legend();
    }
    for (const std::string &name : o.objects) {
        bench_scene scene(name);
        if (o.soak) {
            *flat = bench_whole_soak(scene, o.quick ? 10000 : 100000, figures) && *flat;
            continue;
        }
        bench_dabs_print_head(scene);
        for (const bench_dabs_row &row : bench_dabs_rows(o.radius))
            bench_dabs_measure(scene, row, set, probe, figures);
        std::printf("\n");
        if (o.radius > 0)
            continue;
        bench_whole_measure(scene, o.quick, probe, figures);
        if (!scene.is_large())
            bench_stroke_measure(scene, o.quick, probe, figures);
    }
}

} // namespace

int main(int argc, char **argv)
{
    options o = parse(argc, argv);
    if (o.soak && o.objects.size() > 1)
        o.objects = {"1M"};
    bench_record figures;
    bool flat = true;
    const double start = bench_clock_wall_s();
    print_machine(figures);
    run(o, figures, &flat);
    std::printf("%.0f s in all\n", bench_clock_wall_s() - start);
    if (!o.json.empty() && !figures.write(o.json)) {
        std::fprintf(stderr, "bench_workload: %s cannot be written\n", o.json.c_str());
        return 2;
    }
    return flat ? 0 : 1;
}
