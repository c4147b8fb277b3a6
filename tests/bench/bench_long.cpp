/* SPDX-License-Identifier: Apache-2.0 */
#include "bench_long.h"

#include "bench_clock.h"
#include "exchange/exchange.h"
#include "sculpture/still.h"
#include "station/errand.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace {

constexpr double FRAME_S = 1.0 / 60;
constexpr size_t STROKE_DABS = 100;

void demand(status s, const char *what) { bench_rig_demand(s == STATUS_OK, std::string(what) + ": " + status_text(s)); }

struct piece_closes {
    void operator()(sculpture *s) const
    {
        demand(sculpture_close(s), "sculpture_close");
        delete s;
    }
};
using held_piece = std::unique_ptr<sculpture, piece_closes>;

held_piece opened()
{
    history_finding finding;
    auto s = std::make_unique<sculpture>();
    demand(sculpture_open(s.get(), nullptr, CAPACITY_BRICKS, nullptr, 1.0, &finding), "sculpture_open");
    return held_piece(s.release());
}

status file_put(void *self, const void *bytes, size_t n)
{
    return std::fwrite(bytes, 1, n, static_cast<FILE *>(self)) == n ? STATUS_OK : STATUS_IO;
}

status file_get(void *self, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    FILE *f = static_cast<FILE *>(self);
    if (std::fseek(f, static_cast<long>(offset), SEEK_SET) != 0)
        return STATUS_IO;
    *got_out = std::fread(bytes, 1, n, f);
    return std::ferror(f) ? STATUS_IO : STATUS_OK;
}

/* A path in the folder for such things, and the file gone afterwards. */
struct scratch_file {
    std::string path;
    explicit scratch_file(const std::string &ending)
        : path((std::filesystem::temp_directory_path() / ("glaise-bench-long" + ending)).string())
    {
    }
    ~scratch_file() { std::filesystem::remove(path); }
};

std::string write_out(still &moment, const std::string &path)
{
    FILE *f = std::fopen(path.c_str(), "wb");
    if (!f)
        return path + " cannot be written";
    const exchange_outcome outcome = exchange_write(moment, path, file_put, f);
    const bool good = std::fclose(f) == 0;
    return outcome.state == STATUS_OK && !good ? path + " cannot be written" : outcome.text;
}

std::string read_in(sculpture &piece, const std::string &path)
{
    FILE *f = std::fopen(path.c_str(), "rb");
    if (!f)
        return path + " cannot be read";
    const exchange_outcome outcome = exchange_read(piece, file_get, f);
    std::fclose(f);
    return outcome.text;
}

/* Somebody who sculpts on and on. */
struct sculptor {
    sculpture *piece;
    ellipsoid ball = {};
    std::vector<bench_object_dab> dabs;
    size_t next = 0;

    sculptor(sculpture *of, const clay &pristine) : piece(of), dabs(bench_object_spiral(pristine, 16, 0.1, 2000))
    {
        demand(ellipsoid_init(&ball, ELLIPSOID_WYVILL, 1), "ellipsoid");
    }
    /* Clay is put on and taken away again, so that the piece stays what it is. */
    double dab_s()
    {
        const bench_object_dab &d = dabs[next % dabs.size()];
        const bool adds = next++ / dabs.size() % 2 == 0;
        const tool t = {ellipsoid_shape(&ball), adds ? ACTION_TOOTHPASTE : ACTION_SOFT_ERASER, d.rgba,
                        deform_default()};
        const sculpture_dab placed = {d.dab.at, d.dab.amount, 1.0};
        if (next % STROKE_DABS == 1) {
            if (piece->in_stroke)
                demand(sculpture_stroke_end(piece), "sculpture_stroke_end");
            sculpture_stroke_begin(piece);
        }
        const double start = bench_clock_wall_s();
        demand(sculpture_apply(piece, &t, &placed, nullptr), "sculpture_apply");
        return bench_clock_wall_s() - start;
    }
};

struct row {
    std::string what;
    double work_s = 0, begin_s = 0, end_s = 0, megabytes = 0;
    std::vector<double> dabs_s;
};

void print(const row &r, const std::string &object, bench_record &figures)
{
    const double median = bench_clock_median(r.dabs_s), longest = *std::max_element(r.dabs_s.begin(), r.dabs_s.end());
    const double p99 = bench_clock_quantile(r.dabs_s, 0.99);
    std::printf("%-14s %8.2f %8.1f %8.2f %8.2f   %8zu %8.0f %8.0f %8.0f\n", r.what.c_str(), r.work_s, r.megabytes,
                1e3 * r.begin_s, 1e3 * r.end_s, r.dabs_s.size(), 1e6 * median, 1e6 * p99, 1e6 * longest);
    std::fflush(stdout);
    figures.add("long", {{"object", object}, {"work", r.what}},
               {{"work_s", r.work_s}, {"megabytes", r.megabytes}, {"begin_ms", 1e3 * r.begin_s},
                {"end_ms", 1e3 * r.end_s}, {"dab_us", 1e6 * median}, {"p99_us", 1e6 * p99},
                {"longest_us", 1e6 * longest}});
}

void sculpt_until_done(sculptor &by, errand *e, row *r)
{
    const double start = bench_clock_wall_s();
    while (!errand_is_done(e))
        r->dabs_s.push_back(by.dab_s());
    r->work_s = bench_clock_wall_s() - start;
    const std::string text = errand_end(e);
    bench_rig_demand(text.empty(), text);
}

row while_written(sculptor &by, const std::string &what, const std::string &path)
{
    row r;
    r.what = what;
    still moment;
    double start = bench_clock_wall_s();
    demand(still_begin(&moment, by.piece), "still_begin");
    r.begin_s = bench_clock_wall_s() - start;
    sculpt_until_done(by, errand_begin([&](const auto &) { return write_out(moment, path); }), &r);
    start = bench_clock_wall_s();
    still_end(&moment);
    r.end_s = bench_clock_wall_s() - start;
    r.megabytes = 1e-6 * static_cast<double>(std::filesystem::file_size(path));
    return r;
}

row while_read(sculptor &by, const std::string &path)
{
    row r;
    r.what = "open .glaise";
    held_piece other = opened();
    r.megabytes = 1e-6 * static_cast<double>(std::filesystem::file_size(path));
    sculpt_until_done(by, errand_begin([&](const auto &) { return read_in(*other, path); }), &r);
    return r;
}

} // namespace

void bench_long_measure(bench_scene &s, bool quick, bench_record &figures)
{
    held_piece piece = opened();
    demand(clay_copy(&piece->clay, &s.pristine), "clay_copy");
    demand(surface_rebuild(&piece->surface, &piece->clay, nullptr), "surface_rebuild");
    sculptor by(piece.get(), s.pristine);
    std::printf("long work on %s beside toothpaste and eraser at R = 16, two threads in all; a frame is %.0f us\n"
                "%-14s %8s %8s %8s %8s   %8s %8s %8s %8s\n",
                s.name.c_str(), 1e6 * FRAME_S, "work", "seconds", "MB", "freeze", "thaw ms", "dabs", "median", "p99",
                "longest");
    row alone;
    alone.what = "none";
    for (int n = 0; n < (quick ? 500 : 4000); n++)
        alone.dabs_s.push_back(by.dab_s());
    print(alone, s.name, figures);
    const scratch_file native(".glaise"), skin(".ply");
    print(while_written(by, "save .glaise", native.path), s.name, figures);
    print(while_written(by, "export .ply", skin.path), s.name, figures);
    print(while_read(by, native.path), s.name, figures);
    std::printf("\n");
}
