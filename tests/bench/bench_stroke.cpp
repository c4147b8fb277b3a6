/* SPDX-License-Identifier: Apache-2.0 */
#include "bench_stroke.h"

#include "sculpture/sculpture.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>

namespace {

/* Files in memory: written and renamed as on a disk, at the speed of memory. */
struct memory_files {
    std::map<std::string, std::vector<char>> files;
    uint64_t written = 0;

    static memory_files &of(void *self) { return *static_cast<memory_files *>(self); }
    static status read(void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got_out)
    {
        const std::vector<char> &f = of(self).files[name];
        *got_out = offset < f.size() ? std::min(n, f.size() - static_cast<size_t>(offset)) : 0;
        if (*got_out > 0)
            std::memcpy(bytes, f.data() + offset, *got_out);
        return STATUS_OK;
    }
    static status write(void *self, const char *name, uint64_t offset, const void *bytes, size_t n)
    {
        std::vector<char> &f = of(self).files[name];
        const char *from = static_cast<const char *>(bytes);
        const size_t within = std::min(n, f.size() - std::min(f.size(), static_cast<size_t>(offset)));
        if (f.size() < offset)
            f.resize(offset);
        if (within > 0)
            std::memcpy(f.data() + offset, from, within);
        f.insert(f.end(), from + within, from + n); /* not filled with zeros first */
        of(self).written += n;
        return STATUS_OK;
    }
    static status size(void *self, const char *name, uint64_t *bytes_out, bool *exists_out)
    {
        const auto at = of(self).files.find(name);
        *exists_out = at != of(self).files.end() && !at->second.empty();
        *bytes_out = *exists_out ? at->second.size() : 0;
        return STATUS_OK;
    }
    static status truncate(void *self, const char *name, uint64_t bytes)
    {
        of(self).files[name].resize(bytes);
        return STATUS_OK;
    }
    static status sync(void *, const char *) { return STATUS_OK; }
    static status rename(void *self, const char *from, const char *to)
    {
        of(self).files[to].swap(of(self).files[from]);
        return remove(self, from);
    }
    /* Its memory stays for the next file of that name, as that of a file written over would. */
    static status remove(void *self, const char *name)
    {
        of(self).files[name].clear();
        return STATUS_OK;
    }
    static status list(void *self, void (*take)(void *into, const char *name), void *into)
    {
        for (const auto &[name, bytes] : of(self).files)
            take(into, name.c_str());
        return STATUS_OK;
    }
    byte_store store() { return {this, read, write, size, truncate, sync, rename, remove, list}; }
};

void demand(status s, const char *what) { bench_rig_demand(s == STATUS_OK, std::string(what) + ": " + status_text(s)); }

class recorded {
public:
    explicit recorded(const clay &from) : whole(std::make_unique<sculpture>())
    {
        history_finding finding;
        const byte_store store = disk.store();
        demand(ellipsoid_init(&ball, ELLIPSOID_WYVILL, 1), "ellipsoid");
        demand(sculpture_open(whole.get(), &store, CAPACITY_BRICKS, nullptr, 1.0, &finding), "open");
        demand(clay_copy(&whole->clay, &from), "clay_copy");
        demand(surface_rebuild(&whole->surface, &whole->clay, nullptr), "surface_rebuild");
    }
    ~recorded() { demand(sculpture_close(whole.get()), "close"); }
    recorded(const recorded &) = delete;
    recorded &operator=(const recorded &) = delete;

    void begin() { sculpture_stroke_begin(whole.get()); }
    void dab(const bench_object_dab &d)
    {
        const tool t = {ellipsoid_shape(&ball), d.kind, d.rgba, deform_default()};
        const sculpture_dab placed = {d.dab.at, d.dab.amount, 1.0};
        demand(sculpture_apply(whole.get(), &t, &placed, nullptr), "sculpture_apply");
    }
    /* Answers the bytes that went to the disk. */
    uint64_t end()
    {
        disk.written = 0;
        demand(sculpture_stroke_end(whole.get()), "sculpture_stroke_end");
        return disk.written;
    }

private:
    memory_files disk;
    std::unique_ptr<sculpture> whole;
    ellipsoid ball = {};
};

struct stroke_times {
    std::vector<double> without_s, with_s;
    double end_s = 0, copy_s = 0, bytes = 0;
};

double copy_s(size_t bytes)
{
    std::vector<char> from(bytes, 1), to(bytes, 2);
    const double start = bench_clock_wall_s();
    std::memcpy(to.data(), from.data(), bytes);
    __asm__ volatile("" : : "r"(to.data()) : "memory");
    return bench_clock_wall_s() - start;
}

stroke_times one_stroke(bench_scene &s, recorded &r, const bench_object_dab *dabs, size_t count)
{
    stroke_times t;
    for (size_t n = 0; n < count; n++) {
        const double start = bench_clock_wall_s();
        s.rig->apply(dabs[n]);
        t.without_s.push_back(bench_clock_wall_s() - start);
    }
    r.begin();
    for (size_t n = 0; n < count; n++) {
        const double start = bench_clock_wall_s();
        r.dab(dabs[n]);
        t.with_s.push_back(bench_clock_wall_s() - start);
    }
    const double start = bench_clock_wall_s();
    t.bytes = static_cast<double>(r.end());
    t.end_s = bench_clock_wall_s() - start;
    t.copy_s = copy_s(static_cast<size_t>(t.bytes));
    return t;
}

double sum(const std::vector<double> &of)
{
    double all = 0;
    for (const double v : of)
        all += v;
    return all;
}

void measure_radius(bench_scene &s, double radius, double amount, bool quick, bench_clock_probe &probe,
                    bench_record &figures)
{
    constexpr size_t count = 100;
    const size_t kept = quick ? 2 : 5, tried_most = 3 * kept;
    s.restore();
    recorded r(s.pristine);
    const std::vector<bench_object_dab> dabs =
        bench_object_spiral(s.pristine, radius, amount, static_cast<int>(count * (tried_most + 1)));
    one_stroke(s, r, dabs.data(), count);
    std::vector<double> without_us, with_us, whole_us, end_us, copy_us, kilobytes, ratio, whole_ratio;
    size_t tried = 0, out = 0;
    probe.take_loss_s();
    while (tried < tried_most && without_us.size() < kept) {
        probe.begin();
        const stroke_times t = one_stroke(s, r, dabs.data() + count * ++tried, count);
        probe.end();
        /* Too few rounds left to throw any away. */
        const bool must = tried_most - tried < kept - without_us.size();
        if (probe.take_loss_s() > bench_clock_loss_max_s) {
            out++;
            if (!must)
                continue;
        }
        without_us.push_back(1e6 * bench_clock_median(t.without_s));
        with_us.push_back(1e6 * bench_clock_median(t.with_s));
        ratio.push_back(with_us.back() / without_us.back());
        end_us.push_back(1e6 * t.end_s / count);
        whole_us.push_back(1e6 * (sum(t.with_s) + t.end_s - sum(t.without_s)) / count);
        whole_ratio.push_back((sum(t.with_s) + t.end_s) / sum(t.without_s));
        copy_us.push_back(1e6 * t.copy_s / count);
        kilobytes.push_back(1e-3 * t.bytes / count);
    }
    const double extra = bench_clock_median(whole_us), copy = bench_clock_median(copy_us);
    std::printf("%4.0f %9.1f %9.1f %6.2f %9.1f %7.2f %9.1f %8.1f %9.2f %8.1f   %zu/%zu\n", radius,
                bench_clock_median(without_us), bench_clock_median(with_us), bench_clock_median(ratio),
                bench_clock_median(end_us), bench_clock_median(whole_ratio), extra, bench_clock_median(kilobytes), copy,
                extra / copy, out, tried);
    std::fflush(stdout);
    figures.add("history", {{"object", s.name}},
               {{"radius", radius}, {"without_us", bench_clock_median(without_us)},
                {"with_us", bench_clock_median(with_us)}, {"ratio", bench_clock_median(ratio)},
                {"end_us", bench_clock_median(end_us)}, {"whole_ratio", bench_clock_median(whole_ratio)},
                {"kilobytes", bench_clock_median(kilobytes)}, {"copy_us", copy}, {"over_copy", extra / copy}});
}

} // namespace

void bench_stroke_measure(bench_scene &s, bool quick, bench_clock_probe &probe, bench_record &figures)
{
    std::printf("history on %s: strokes of 100 toothpaste dabs; microseconds and kilobytes a dab\n"
                "  without: nothing recorded; recorded: the same while images are kept; end: comparing, encoding and\n"
                "  writing into memory, shared out; in all: both over without, extra: both less without\n"
                "%4s %9s %9s %6s %9s %7s %9s %8s %9s %8s   %s\n",
                s.name.c_str(), "R", "without", "recorded", "ratio", "end", "in all", "extra", "kB", "memcpy", "x copy",
                "out");
    measure_radius(s, 16, 0.1, quick, probe, figures);
    measure_radius(s, 32, 0.02, quick, probe, figures);
    std::printf("\n");
}
