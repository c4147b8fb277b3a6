/* SPDX-License-Identifier: Apache-2.0 */
/* The table of paper 000 section 6 again, ours beside the paper's own layout in the same run; then the same over a lump
 * of a million corners; then whatever --benchmark_filter chooses, by Google Benchmark (its options and formats hold).
 * Both engines do the same dabs and are compared before anything is timed: on a difference the exit code is 1.
 * Rates are medians over rounds in which the two take turns: on a busy machine trust the ratio. */
#include "bench_machine.h"
#include "bench_piece.h"
#include "bench_rig.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>

namespace {

constexpr int rounds = 7, sites = 6;
constexpr double ours_round_s = 0.025, reference_round_s = 0.06;
constexpr double table_amount = 0.25;

/* This thread's own time: what other programs do on the machine then costs cache and clock rate, but no turns. */
double now_s()
{
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double quantile(std::vector<double> of, double part)
{
    std::sort(of.begin(), of.end());
    return of[static_cast<size_t>(part * static_cast<double>(of.size() - 1) + 0.5)];
}
double median(const std::vector<double> &of) { return quantile(of, 0.5); }

/* --- the paper's object --- */

struct character {
    bench_rig rig{20000, 200000};
    bench_piece piece{20000};
};

std::unique_ptr<character> make_character()
{
    auto made = std::make_unique<character>();
    for (const bench_object_dab &d : bench_object_character()) {
        made->rig.ours(d);
        made->rig.reference(d);
        made->piece.stroke(d);
    }
    const std::string difference = made->rig.difference(false);
    bench_rig_demand(difference.empty(), "the object: " + difference);
    bench_rig_demand(made->piece.field_digest() == clay_digest(&made->rig.field_clay), "the strokes' object differs");
    return made;
}

void print_character(const bench_rig &rig)
{
    const avl *trees[] = {&rig.paper.corners, &rig.paper.cubes, &rig.paper.edges};
    std::printf("object              here   paper\n"
                "  stored corners  %6llu  %6u\n  vertices        %6llu  %6u\n  triangles       %6llu  %6u\n"
                "  crossing cubes  %6llu       -\n",
                static_cast<unsigned long long>(rig.field_clay.corners), bench_object_paper_corners,
                static_cast<unsigned long long>(rig.vertices()), bench_object_paper_vertices,
                static_cast<unsigned long long>(rig.skin.triangles), bench_object_paper_triangles,
                static_cast<unsigned long long>(rig.skin.crossing));
    std::printf("  bricks          %6u       -  (tree height %d)\n", clay_brick_count(&rig.field_clay),
                avl_height(&rig.field_clay.tree));
    const char *const names[] = {"corners", "cubes", "edges"};
    for (int n = 0; n < 3; n++)
        std::printf("  %-7s tree    %6d  %6d  (height, the reference's)\n", names[n], avl_height(trees[n]),
                    bench_object_paper_heights[n]);
    std::printf("\n");
}

/* Add and erase the same: the object stays what it was, but for roundings. */
std::vector<bench_object_dab> row_dabs(const bench_object_pose &pose, const std::vector<key> &at)
{
    std::vector<bench_object_dab> dabs;
    for (const key site : at)
        for (const action kind : {ACTION_TOOTHPASTE, ACTION_SOFT_ERASER})
            dabs.push_back(bench_object_pose_dab(pose, site, kind, table_amount));
    return dabs;
}

/* Every dab of the row once on both engines, compared after each. Answers the first dab's counts. */
bench_rig_counts row_check(bench_rig &rig, const std::vector<bench_object_dab> &dabs, const char *name)
{
    bench_rig_counts first = {};
    for (size_t n = 0; n < dabs.size(); n++) {
        const bench_rig_counts a = rig.ours(dabs[n]), b = rig.reference(dabs[n]);
        const bool same = a.tool.visited == b.tool.visited && a.tool.computed == b.tool.computed &&
                          a.tool.dirtied == b.tool.dirtied &&
                          (dabs[n].kind != ACTION_TOOTHPASTE || a.treated == b.treated);
        bench_rig_demand(same, std::string(name) + ": the two engines count differently");
        const std::string difference = rig.difference(false);
        bench_rig_demand(difference.empty(), std::string(name) + ": " + difference);
        if (n == 0)
            first = a;
    }
    return first;
}

struct stages {
    double field_s = 0, surface_s = 0;
};

stages ours_staged(bench_rig &rig, const bench_object_dab &d)
{
    const double start = now_s();
    rig.field(d, nullptr);
    const double middle = now_s();
    rig.surface_of_field(nullptr);
    return {middle - start, now_s() - middle};
}

struct row_result {
    std::vector<double> ours_s, field_s, surface_s, stroke_s, reference_s, ratio; /* a dab, by round */
};

/* Seconds of one dab, over as many whole turns through `dabs` as fill the time. */
double mean_seconds(const std::vector<bench_object_dab> &dabs, double fill_s,
                    const std::function<void(const bench_object_dab &)> &act)
{
    size_t done = 0;
    const double start = now_s();
    do {
        for (const bench_object_dab &d : dabs)
            act(d);
        done += dabs.size();
    } while (now_s() - start < fill_s);
    return (now_s() - start) / static_cast<double>(done);
}

row_result row_measure(character &c, const std::vector<bench_object_dab> &dabs)
{
    bench_rig &rig = c.rig;
    row_result r;
    for (int n = 0; n < rounds; n++) {
        stages sum;
        size_t count = 0;
        r.ours_s.push_back(mean_seconds(dabs, ours_round_s, [&](const bench_object_dab &d) { rig.apply(d); }));
        mean_seconds(dabs, ours_round_s, [&](const bench_object_dab &d) {
            const stages one = ours_staged(rig, d);
            sum.field_s += one.field_s;
            sum.surface_s += one.surface_s;
            count++;
        });
        r.field_s.push_back(sum.field_s / static_cast<double>(count));
        r.surface_s.push_back(sum.surface_s / static_cast<double>(count));
        r.stroke_s.push_back(mean_seconds(dabs, ours_round_s, [&](const bench_object_dab &d) { c.piece.stroke(d); }));
        r.reference_s.push_back(
            mean_seconds(dabs, reference_round_s, [&](const bench_object_dab &d) { rig.reference(d); }));
        r.ratio.push_back(r.reference_s.back() / r.ours_s.back());
    }
    return r;
}

void print_row(const bench_object_pose &pose, const bench_rig_counts &c, const row_result &r)
{
    const uint64_t here[] = {c.tool.visited, c.tool.computed, c.tool.dirtied, c.treated};
    const uint64_t paper[] = {pose.visited, pose.computed, pose.dirtied, pose.cubes};
    std::printf("%-12s", pose.name);
    for (int n = 0; n < 4; n++) {
        const std::string pair = std::to_string(here[n]) + "/" + std::to_string(paper[n]);
        std::printf(" %9s%c", pair.c_str(), here[n] == paper[n] ? ' ' : '!');
    }
    std::printf(" %6s %9.0f %6.1f %7.1f %9.0f %9.0f %6.1f\n", pose.frames_per_s, 1 / median(r.ours_s),
                median(r.field_s) * 1e6, median(r.surface_s) * 1e6, 1 / median(r.stroke_s),
                1 / median(r.reference_s), median(r.ratio));
}

void print_paper_table(character &c)
{
    bench_rig &rig = c.rig;
    const std::vector<key> at = bench_object_sites(rig.field_clay, sites);
    std::printf("dabs on that object, toothpaste and soft eraser in turn, at %d places on its surface; medians of %d "
                "rounds\n",
                sites, rounds);
    std::printf("counts   here/paper of a toothpaste dab, ! where they differ\n"
                "ours     field + surface, microseconds of each beside it\n"
                "strokes  the same, every dab a stroke with an undo-file of its own, the disk left out\n"
                "trees    the paper's layout, one node per corner\n"
                "ratio    trees' time / ours\n"
                "paper    frames a second, drawing included, on a 195 MHz R10000\n\n");
    std::printf("%-12s %10s %10s %10s %10s %6s %9s %6s %7s %9s %9s %6s\n", "", "visited", "computed", "dirtied",
                "cubes", "paper", "ours", "field", "surface", "strokes", "trees", "ratio");
    std::printf("%-12s %10s %10s %10s %10s %6s %9s %6s %7s %9s %9s %6s\n", "tool", "", "", "", "", "frm/s", "dabs/s",
                "us", "us", "dabs/s", "dabs/s", "");
    for (const bench_object_pose &pose : bench_object_poses) {
        const std::vector<bench_object_dab> dabs = row_dabs(pose, at);
        const bench_rig_counts counts = row_check(rig, dabs, pose.name);
        print_row(pose, counts, row_measure(c, dabs));
        /* The rounds did not give both engines the same number of dabs: put the reference back on our field. */
        rig.load_reference();
    }
    std::printf("\n");
}

/* --- a million corners --- */

struct million_result {
    std::vector<double> field_s, surface_s, ours_s, reference_s;
    double dirtied = 0;
};

/* The two engines take turns of a block of dabs each, so that neither keeps the caches for itself. */
million_result million_measure(bench_rig &rig, const std::vector<bench_object_dab> &dabs)
{
    constexpr size_t block = 50;
    million_result r;
    for (size_t from = 0; from < dabs.size(); from += block) {
        const size_t to = std::min(from + block, dabs.size());
        for (size_t n = from; n < to; n++) {
            const stages s = ours_staged(rig, dabs[n]);
            r.field_s.push_back(s.field_s);
            r.surface_s.push_back(s.surface_s);
            r.ours_s.push_back(s.field_s + s.surface_s);
        }
        for (size_t n = from; n < to; n++) {
            const double start = now_s();
            const bench_rig_counts c = rig.reference(dabs[n]);
            r.reference_s.push_back(now_s() - start);
            r.dirtied += static_cast<double>(c.tool.dirtied) / static_cast<double>(dabs.size());
        }
    }
    return r;
}

double clay_bytes(const clay &c)
{
    return static_cast<double>(pool_bytes(&c.bricks) + pool_bytes(&c.pages.of) + pool_bytes(&c.tree.nodes));
}

double surface_bytes(const surface &s)
{
    double bytes = static_cast<double>(pool_bytes(&s.patches) + pool_bytes(&s.tree.nodes));
    for (uint32_t slot = 0; slot < surface_slots(&s); slot++)
        if (const patch *p = surface_patch(&s, slot))
            bytes += p->vertex_room * sizeof *p->vertices + p->triangle_room * sizeof *p->triangles;
    return bytes;
}

void print_million()
{
    auto rig = std::make_unique<bench_rig>(100000, 8000000);
    for (const bench_object_dab &d : bench_object_million())
        rig->ours(d);
    const double start = now_s();
    rig->load_reference();
    const double load_s = now_s() - start;
    std::string difference = rig->difference(true);
    bench_rig_demand(difference.empty(), "the lump: " + difference);
    const double corners = static_cast<double>(rig->field_clay.corners);
    std::printf("a lump of %.0f corners, %llu triangles; trees loaded in %.1f s; bytes a corner: ours %.1f and %.1f "
                "for the surface, trees %.0f\n",
                corners, static_cast<unsigned long long>(rig->skin.triangles), load_s,
                clay_bytes(rig->field_clay) / corners, surface_bytes(rig->skin) / corners,
                static_cast<double>(per_corner_bytes(&rig->paper)) / corners);
    std::printf("300 toothpaste dabs along a spiral, semi-axes R x (1.25, 1, 0.8), turning; microseconds a dab\n\n");
    std::printf("%4s %8s %7s %8s %8s %8s %9s %9s %6s\n", "R", "dirtied", "field", "surface", "ours", "p99", "trees",
                "p99", "ratio");
    const double radii[] = {4, 8, 16}, amounts[] = {0.25, 0.25, 0.1};
    for (int n = 0; n < 3; n++) {
        const auto dabs = bench_object_spiral(rig->field_clay, radii[n], amounts[n], 300);
        const million_result r = million_measure(*rig, dabs);
        std::printf("%4.0f %8.0f %7.1f %8.1f %8.1f %8.1f %9.1f %9.1f %6.1f\n", radii[n], r.dirtied,
                    median(r.field_s) * 1e6, median(r.surface_s) * 1e6, median(r.ours_s) * 1e6,
                    quantile(r.ours_s, 0.99) * 1e6, median(r.reference_s) * 1e6, quantile(r.reference_s, 0.99) * 1e6,
                    median(r.reference_s) / median(r.ours_s));
        difference = rig->difference(false);
        bench_rig_demand(difference.empty(), "the lump after the dabs: " + difference);
    }
    std::printf("\n");
    std::fflush(stdout);
}

/* --- for Google Benchmark's own reports --- */

void register_rows(bench_rig &rig)
{
    const std::vector<key> at = bench_object_sites(rig.field_clay, sites);
    for (const bench_object_pose &pose : bench_object_poses) {
        const std::vector<bench_object_dab> dabs = row_dabs(pose, at);
        std::string name = pose.name;
        std::replace(name.begin(), name.end(), ' ', '_');
        benchmark::RegisterBenchmark(("ours/" + name).c_str(), [&rig, dabs](benchmark::State &state) {
            size_t n = 0;
            for (auto _ : state)
                rig.apply(dabs[n++ % dabs.size()]);
            state.SetItemsProcessed(static_cast<int64_t>(state.iterations()));
        });
        benchmark::RegisterBenchmark(("trees/" + name).c_str(), [&rig, dabs](benchmark::State &state) {
            size_t n = 0;
            for (auto _ : state)
                rig.reference(dabs[n++ % dabs.size()]);
            state.SetItemsProcessed(static_cast<int64_t>(state.iterations()));
        });
    }
}

} // namespace

int main(int argc, char **argv)
{
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    std::printf("%s\n", bench_machine_text().c_str());
    auto made = make_character();
    print_character(made->rig);
    print_paper_table(*made);
    print_million();
    register_rows(made->rig);
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
