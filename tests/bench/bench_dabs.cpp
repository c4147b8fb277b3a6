/* SPDX-License-Identifier: Apache-2.0 */
#include "bench_dabs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

constexpr int rounds_kept = 5, rounds_tried = 15;

/* Times of one engine's dabs in one round. */
struct timing {
    std::vector<double> field_s, surface_s, both_s;
    void add(double from, double middle, double to)
    {
        field_s.push_back(middle - from);
        surface_s.push_back(to - middle);
        both_s.push_back(to - from);
    }
};

struct round_result {
    timing ours, vdb, trees;
    double loss_s = 0;
};

struct sums {
    double dabs = 0, visited = 0, dirtied = 0, changed = 0, treated = 0, patches = 0, triangles = 0;
};

int dabs_a_round(const bench_scene &s, double radius, bool quick)
{
    const int full = radius < 6 ? 250 : radius < 12 ? 200 : radius < 24 ? 100 : 40;
    return std::max(10, full / (s.is_large() ? 2 : 1) / (quick ? 5 : 1));
}

/* The paper's trees are slow: one row, and only the first dabs of each round. */
size_t tree_dabs(const bench_scene &s, const bench_dabs_row &row, bool quick)
{
    const bool asked = !s.is_large() && row.radius > 12 && row.radius < 24 && row.kind == ACTION_TOOTHPASTE &&
                       row.rows == bench_rig::choices()[0];
    return !asked ? 0 : quick ? 5 : 12;
}

const char *way_name(vdb_peer_way w)
{
    return w == VDB_PEER_MASKED ? "masked" : w == VDB_PEER_LENT ? "lent" : "copied";
}

/* One slice of the spiral by every engine. */
class turn {
public:
    turn(bench_scene &scene, bench_clock_probe &of_machine, vdb_peer_way chosen, bool vdb_knows)
        : s(scene), probe(of_machine), way(chosen), with_vdb(vdb_knows)
    {
    }

    round_result take(const std::vector<bench_object_dab> &dabs, size_t from, size_t to, size_t trees)
    {
        round_result r;
        number = s.rig->number();
        ours(dabs, from, to, r.ours);
        if (with_vdb)
            vdb(dabs, from, to, r.vdb);
        if (trees > 0)
            paper(dabs, from, from + trees, r.trees);
        r.loss_s = probe.take_loss_s();
        return r;
    }

private:
    void ours(const std::vector<bench_object_dab> &dabs, size_t from, size_t to, timing &out)
    {
        probe.begin();
        for (size_t n = from; n < to; n++) {
            const double start = bench_clock_wall_s();
            s.rig->field(dabs[n], nullptr);
            const double middle = bench_clock_wall_s();
            s.rig->surface_of_field(nullptr);
            out.add(start, middle, bench_clock_wall_s());
        }
        probe.end();
    }

    void vdb(const std::vector<bench_object_dab> &dabs, size_t from, size_t to, timing &out)
    {
        probe.begin();
        for (size_t n = from; n < to; n++) {
            const double start = bench_clock_wall_s();
            s.vdb->field(dabs[n], number + n - from);
            const double middle = bench_clock_wall_s();
            s.vdb->surface(way);
            out.add(start, middle, bench_clock_wall_s());
        }
        probe.end();
    }

    void paper(const std::vector<bench_object_dab> &dabs, size_t from, size_t to, timing &out)
    {
        probe.begin();
        for (size_t n = from; n < to; n++) {
            const double start = bench_clock_wall_s();
            s.rig->reference(dabs[n]);
            const double end = bench_clock_wall_s();
            out.add(start, end, end);
        }
        probe.end();
    }

    bench_scene &s;
    bench_clock_probe &probe;
    vdb_peer_way way;
    bool with_vdb;
    uint64_t number = 0;
};

/* Some dabs to warm up on, which are counted; OpenVDB's fastest way for this radius comes out. */
vdb_peer_way warm_up(bench_scene &s, const std::vector<bench_object_dab> &dabs, size_t count, bool with_vdb, sums &sum)
{
    std::vector<double> took_s[vdb_peer_ways];
    for (size_t n = 0; n < count; n++) {
        const uint64_t number = s.rig->number();
        const bench_rig_counts c = s.rig->ours(dabs[n]);
        sum.dabs += 1;
        sum.visited += static_cast<double>(c.tool.visited);
        sum.dirtied += static_cast<double>(c.tool.dirtied);
        sum.treated += static_cast<double>(c.treated);
        sum.patches += c.skin.patches;
        sum.triangles += static_cast<double>(c.skin.triangles);
        if (!with_vdb)
            continue;
        s.vdb->field(dabs[n], number);
        sum.changed += static_cast<double>(s.vdb->counts().changed);
        bench_rig_demand(s.vdb->counts().dirtied == c.tool.dirtied, "OpenVDB's dab dirties other corners");
        for (int w = 0; w < vdb_peer_ways; w++) {
            const double start = bench_clock_wall_s();
            s.vdb->surface(static_cast<vdb_peer_way>(w));
            took_s[w].push_back(bench_clock_wall_s() - start);
        }
    }
    int best = 0;
    for (int w = 1; w < vdb_peer_ways; w++)
        if (bench_clock_median(took_s[w]) < bench_clock_median(took_s[best]))
            best = w;
    return static_cast<vdb_peer_way>(best);
}

/* The five least disturbed, as they came. */
void keep_best(std::vector<round_result> &rounds)
{
    std::stable_sort(rounds.begin(), rounds.end(),
                     [](const round_result &a, const round_result &b) { return a.loss_s < b.loss_s; });
    if (rounds.size() > rounds_kept)
        rounds.resize(rounds_kept);
}

/* Median over rounds of what `of` finds in one, in microseconds. */
template <class finder> double over_rounds_us(const std::vector<round_result> &rounds, finder of)
{
    std::vector<double> found;
    for (const round_result &r : rounds)
        found.push_back(1e6 * of(r));
    return bench_clock_median(found);
}

struct figures {
    double field_us, field99_us, surface_us, surface99_us, both_us, both99_us;
};

figures figures_of(const std::vector<round_result> &rounds, timing round_result::*engine)
{
    const auto at = [&](std::vector<double> timing::*part, double q) {
        return over_rounds_us(rounds, [&](const round_result &r) {
            return bench_clock_quantile(r.*engine.*part, q);
        });
    };
    return {at(&timing::field_s, .5),      at(&timing::field_s, .99), at(&timing::surface_s, .5),
            at(&timing::surface_s, .99), at(&timing::both_s, .5),  at(&timing::both_s, .99)};
}

/* The other engine's median over ours, on the same dabs of each round. */
double ratio_of(const std::vector<round_result> &rounds, timing round_result::*other)
{
    std::vector<double> ratios;
    for (const round_result &r : rounds) {
        const std::vector<double> &theirs = (r.*other).both_s;
        if (theirs.empty())
            return 0;
        const std::vector<double> mine(r.ours.both_s.begin(),
                                       r.ours.both_s.begin() + static_cast<std::ptrdiff_t>(theirs.size()));
        ratios.push_back(bench_clock_median(theirs) / bench_clock_median(mine));
    }
    return bench_clock_median(ratios);
}

void print_text(const char *format, double value, bool known)
{
    char text[32] = "-";
    if (known)
        std::snprintf(text, sizeof text, "%.*f", value < 100 ? 1 : 0, value);
    std::printf(format, text);
}

/* What a dab has to move at the least: corners read and written, and the remade patches. */
double bytes_of(const bench_scene &s, const sums &sum)
{
    const double vertices_a_triangle =
        static_cast<double>(s.rig->skin.vertices) / std::max<double>(1, static_cast<double>(s.rig->skin.triangles));
    const double triangle_bytes = sizeof *patch{}.triangles + vertices_a_triangle * sizeof(patch_vertex);
    return (16 * sum.dirtied + triangle_bytes * sum.triangles) / sum.dabs;
}

struct outcome {
    std::vector<round_result> rounds;
    sums sum;
    vdb_peer_way way;
    int tried, out;
    bool filled; /* with disturbed rounds */
};

outcome measure(bench_scene &s, const bench_dabs_row &row, const bench_dabs_setting &set, bench_clock_probe &probe)
{
    const bool with_vdb = s.vdb && row.rows == bench_rig::choices()[0] && row.kind != ACTION_STAMP;
    const size_t warm = row.radius < 24 && !set.quick ? 12 : 5, trees = tree_dabs(s, row, set.quick);
    const size_t each = static_cast<size_t>(dabs_a_round(s, row.radius, set.quick));
    std::vector<bench_object_dab> dabs = bench_object_spiral(s.pristine, row.radius, row.amount,
                                                             static_cast<int>(warm + rounds_tried * each));
    for (bench_object_dab &d : dabs)
        d.kind = row.kind;
    outcome o = {};
    o.way = warm_up(s, dabs, warm, with_vdb, o.sum);
    if (trees > 0)
        s.rig->load_reference();
    turn t(s, probe, o.way, with_vdb);
    probe.take_loss_s();
    while (o.tried < rounds_tried && o.tried - o.out < rounds_kept) {
        const size_t from = warm + static_cast<size_t>(o.tried) * each;
        o.rounds.push_back(t.take(dabs, from, from + each, trees));
        o.out += o.rounds.back().loss_s > bench_clock_loss_max_s;
        o.tried++;
    }
    o.filled = o.tried - o.out < rounds_kept;
    keep_best(o.rounds);
    if (with_vdb) {
        const std::string difference = s.vdb->difference(s.rig->field_clay);
        bench_rig_demand(difference.empty(), "OpenVDB's field after the dabs: " + difference);
    }
    return o;
}

} // namespace

std::vector<bench_dabs_row> bench_dabs_rows(double radius)
{
    static const double radii[] = {4, 8, 16, 32}, amounts[] = {0.25, 0.25, 0.1, 0.02};
    std::vector<bench_dabs_row> rows;
    for (const lanes vectors : bench_rig::choices())
        for (int n = 0; n < 4; n++)
            for (const action kind : {ACTION_TOOTHPASTE, ACTION_SOFT_ERASER, ACTION_STAMP, ACTION_SMOOTH})
                if (!(radius > 0) || std::abs(radius - radii[n]) < 0.5)
                    rows.push_back({radii[n], amounts[n], kind, vectors});
    return rows;
}

void bench_dabs_print_head(const bench_scene &s)
{
    std::printf("dabs on %s: %llu stored corners, %llu triangles; microseconds a dab, median and 99 %%\n",
                s.name.c_str(), static_cast<unsigned long long>(s.rig->field_clay.corners),
                static_cast<unsigned long long>(s.rig->skin.triangles));
    std::printf("%2s %-11s %-8s |%8s %7s %7s %6s |%7s %7s %7s %7s %7s %7s |", "R", "tool", "vectors", "visited",
                "dirtied", "changed", "treat.", "field", "99%", "surface", "99%", "both", "99%");
    std::printf("%7s %7s %7s %7s %-6s|%6s %6s |%7s %6s %6s |%s\n", "VDB fld", "surface", "both", "99%", "way", "VDB x",
                "trees", "kB/dab", "cache", "memory", "out");
}

void bench_dabs_measure(bench_scene &s, const bench_dabs_row &row, const bench_dabs_setting &set,
                        bench_clock_probe &probe, bench_record &record)
{
    s.restore();
    s.rig->use_rows(row.rows);
    const outcome o = measure(s, row, set, probe);
    const figures mine = figures_of(o.rounds, &round_result::ours), vdb = figures_of(o.rounds, &round_result::vdb);
    const double vdb_ratio = ratio_of(o.rounds, &round_result::vdb),
                 trees_ratio = ratio_of(o.rounds, &round_result::trees);
    const double bytes = bytes_of(s, o.sum), dabs = o.sum.dabs;
    const double cache_us = 1e6 * bytes / set.cache_bytes_per_s, memory_us = 1e6 * bytes / set.memory_bytes_per_s;
    const bool has_vdb = vdb_ratio > 0;
    const std::string vectors = lanes_name(row.rows);
    std::printf("%2.0f %-11s %-8s |%8.0f %7.0f ", row.radius, action_name(row.kind), vectors.c_str(),
                o.sum.visited / dabs, o.sum.dirtied / dabs);
    print_text("%7s ", o.sum.changed / dabs, has_vdb);
    std::printf("%6.0f |", o.sum.treated / dabs);
    for (const double us : {mine.field_us, mine.field99_us, mine.surface_us, mine.surface99_us, mine.both_us})
        print_text("%7s ", us, true);
    print_text("%7s |", mine.both99_us, true);
    for (const double us : {vdb.field_us, vdb.surface_us, vdb.both_us, vdb.both99_us})
        print_text("%7s ", us, has_vdb);
    std::printf("%-6s|", has_vdb ? way_name(o.way) : "");
    print_text("%6s ", vdb_ratio, has_vdb);
    print_text("%6s |", trees_ratio, trees_ratio > 0);
    std::printf("%7.1f %6.1f %6.1f |%d/%d%s\n", bytes / 1e3, cache_us, memory_us, o.out, o.tried, o.filled ? " ~" : "");
    std::fflush(stdout);
    record.add("dab",
               {{"object", s.name}, {"tool", action_name(row.kind)}, {"vectors", vectors},
                {"vdb_way", has_vdb ? way_name(o.way) : ""}},
               {{"radius", row.radius}, {"threads", set.threads}, {"visited", o.sum.visited / dabs},
                {"dirtied", o.sum.dirtied / dabs}, {"changed", o.sum.changed / dabs},
                {"treated", o.sum.treated / dabs}, {"patches", o.sum.patches / dabs},
                {"triangles", o.sum.triangles / dabs}, {"field_us", mine.field_us}, {"field99_us", mine.field99_us},
                {"surface_us", mine.surface_us}, {"surface99_us", mine.surface99_us}, {"both_us", mine.both_us},
                {"both99_us", mine.both99_us}, {"vdb_field_us", vdb.field_us}, {"vdb_surface_us", vdb.surface_us},
                {"vdb_both_us", vdb.both_us}, {"vdb_both99_us", vdb.both99_us}, {"vdb_ratio", vdb_ratio},
                {"trees_ratio", trees_ratio}, {"bytes", bytes}, {"cache_bound_us", cache_us},
                {"memory_bound_us", memory_us}, {"rounds_out", o.out}, {"rounds_tried", o.tried}});
}
