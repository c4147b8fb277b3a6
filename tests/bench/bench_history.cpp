/* SPDX-License-Identifier: Apache-2.0 */
/* What it costs that nothing is lost, on real files in the folder given (or ./bench-history, removed afterwards):
 * microseconds that handing a stroke to the history thread takes from the frame, bytes written against bytes changed,
 * the time from pedal-up to acknowledged against one bare fdatasync of the same bytes, and opening a large piece
 * against reading the same files.
 *
 *   --folder DIR     where to write (it says something about the disk that this lies on)
 *   --object 1M|20M  only that one
 *   --soak TAPE      only: a million dabs from that tape in one process; memory, files, undo depth every fifty
 *   thousand;
 *                    exit code 1 when one of them grows after the first two hundred thousand
 *   --dabs N         of the soak */
#include "bench_clock.h"
#include "bench_object.h"
#include "bench_rig.h"

#include "clay/sieve_rows.h"
#include "sculpture/still.h"
#include "station/history_thread.h"
#include "station/station.h"
#include "wiring/playlist.h"
#include "wiring/store.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

void demand(bool good, const std::string &what) { bench_rig_demand(good, what); }
void demand(status s, const std::string &what) { bench_rig_demand(s == STATUS_OK, what + ": " + status_text(s)); }

struct options {
    std::string folder = "bench-history", tape;
    std::vector<std::string> objects = {"1M", "20M"};
    uint64_t dabs = 1000000;
};

/* --- a store that counts --- */

struct counted {
    byte_store to{};
    uint64_t written = 0, made = 0, checkpoints = 0; /* bytes: of records, of zeros for new undo-files, of the others */
};

byte_store counting(counted *c)
{
    byte_store s = c->to;
    s.self = c;
    static const auto of = [](void *self) -> counted & { return *static_cast<counted *>(self); };
    s.write = [](void *self, const char *name, uint64_t offset, const void *bytes, size_t n) {
        const bool undo_file = std::strncmp(name, "undo-", 5) == 0;
        const bool zeros = undo_file && *static_cast<const char *>(bytes) == 0;
        (zeros ? of(self).made : undo_file ? of(self).written : of(self).checkpoints) += n;
        return of(self).to.write(of(self).to.self, name, offset, bytes, n);
    };
    s.read = [](void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got) {
        return of(self).to.read(of(self).to.self, name, offset, bytes, n, got);
    };
    s.size = [](void *self, const char *name, uint64_t *bytes, bool *exists) {
        return of(self).to.size(of(self).to.self, name, bytes, exists);
    };
    s.truncate = [](void *self, const char *name, uint64_t bytes) {
        return of(self).to.truncate(of(self).to.self, name, bytes);
    };
    s.sync = [](void *self, const char *name) { return of(self).to.sync(of(self).to.self, name); };
    s.rename = [](void *self, const char *from, const char *to) {
        return of(self).to.rename(of(self).to.self, from, to);
    };
    s.remove = [](void *self, const char *name) { return of(self).to.remove(of(self).to.self, name); };
    s.list = [](void *self, void (*take)(void *, const char *), void *into) {
        return of(self).to.list(of(self).to.self, take, into);
    };
    return s;
}

/* A piece on real files. */
class kept_piece {
public:
    explicit kept_piece(const std::string &folder) : piece(std::make_unique<sculpture>())
    {
        std::string text;
        history_finding finding;
        files = store_open(folder, &disk.to, &text);
        demand(files != nullptr, text);
        port = counting(&disk);
        demand(sculpture_open(piece.get(), &port, CAPACITY_BRICKS, nullptr, 1.0, &finding), "opening");
        demand(finding.text[0] == '\0', finding.text);
        demand(ellipsoid_init(&ball, ELLIPSOID_WYVILL, 1), "ellipsoid");
        thread = history_thread_open(piece.get(), nullptr);
        demand(thread != nullptr, "no thread");
    }
    ~kept_piece()
    {
        history_thread_close(thread);
        demand(sculpture_close(piece.get()), "closing");
        store_close(files);
    }
    kept_piece(const kept_piece &) = delete;
    kept_piece &operator=(const kept_piece &) = delete;

    void dab(const bench_object_dab &d)
    {
        const tool t = {ellipsoid_shape(&ball), d.kind, d.rgba, deform_default()};
        const sculpture_dab placed = {d.dab.at, d.dab.amount, 1.0};
        demand(sculpture_apply(piece.get(), &t, &placed, nullptr), "a dab");
    }
    void settle() { piece->keeper.settle(piece->keeper.self); }
    /* Until what was handed is encoded, not written: as a hand's pace would have it. */
    void await_encoded()
    {
        for (uint32_t n = 0; n < piece->jobs.count; n++)
            piece->keeper.await(piece->keeper.self, &piece->jobs.at[(piece->jobs.first + n) % SCULPTURE_JOBS]);
    }

    counted disk;
    byte_store port{};
    store *files = nullptr;
    std::unique_ptr<sculpture> piece;
    ellipsoid ball{};
    history_thread *thread = nullptr;
};

status into_file(void *self, const void *bytes, size_t n)
{
    return std::fwrite(bytes, 1, n, static_cast<FILE *>(self)) == n ? STATUS_OK : STATUS_IO;
}

/* The object as a store's checkpoint, without a history. */
void make_store(const std::string &folder, bool large)
{
    auto piece = std::make_unique<sculpture>();
    history_finding finding;
    demand(sculpture_open(piece.get(), nullptr, CAPACITY_BRICKS, nullptr, 1.0, &finding), "opening");
    {
        bench_rig rig(CAPACITY_BRICKS, 16);
        for (const bench_object_dab &d : bench_object_million(large ? 2.72 : 1)) {
            tool_counts counts;
            rig.field(d, &counts);
            dirt_clear(&rig.field_clay.dirty);
        }
        demand(clay_copy(&piece->clay, &rig.field_clay), "copying");
    }
    still moment;
    fs::create_directories(folder);
    FILE *file = std::fopen((folder + "/" HISTORY_FIELD_NAME).c_str(), "wb");
    demand(file != nullptr, folder);
    demand(still_begin(&moment, piece.get()), "freezing");
    demand(still_write(&moment, into_file, file), "writing");
    still_end(&moment);
    std::fclose(file);
    demand(sculpture_close(piece.get()), "closing");
}

/* --- strokes --- */

uint64_t corners_changed(const clay &was, const clay &is)
{
    static const brick_page empty{};
    uint64_t changed = 0;
    avl_walk w;
    key at;
    uint32_t id;
    brick_mask mask;
    for (bool more = avl_first(&w, &is.tree, &at, &id); more; more = avl_next(&w, &at, &id)) {
        const uint32_t old = clay_find(&was, at);
        const brick_page *before = old == POOL_NONE ? &empty : clay_brick(&was, old)->page;
        changed += sieve_rows_changed(before, clay_brick(&is, id)->page, &mask, is.rows);
    }
    return changed;
}

/* One write and one sync of so many bytes over a file that is there. */
double bare_sync_s(const std::string &path, size_t bytes)
{
    const std::vector<char> data(bytes, 3);
    const int fd = open(path.c_str(), O_RDWR | O_CREAT, 0644);
    demand(fd >= 0, path);
    if (fs::file_size(path) < bytes) {
        demand(pwrite(fd, data.data(), bytes, 0) == static_cast<ssize_t>(bytes), path);
        demand(fsync(fd) == 0, path);
    }
    const double start = bench_clock_wall_s();
    demand(pwrite(fd, data.data(), bytes, 0) == static_cast<ssize_t>(bytes), path);
    demand(fdatasync(fd) == 0, path);
    const double took = bench_clock_wall_s() - start;
    close(fd);
    return took;
}

struct stroke_figures {
    std::vector<double> hand_us, part_us, ack_ms, bare_ms, ack_over_bare, amplification, kilobytes, changed;
};

void one_stroke(kept_piece &k, const std::string &scratch, const bench_object_dab *dabs, int count, stroke_figures *f)
{
    constexpr int dabs_a_part = 2; /* of 40 ms, handed every 60 */
    clay was;
    demand(clay_init(&was, CAPACITY_BRICKS), "clay");
    demand(clay_copy(&was, &k.piece->clay), "copy");
    const uint64_t before = k.disk.written;
    double handing_s = 0;
    int parts = 1;
    sculpture_stroke_begin(k.piece.get());
    for (int n = 0; n < count; n++) {
        k.dab(dabs[n]);
        if (n % dabs_a_part != dabs_a_part - 1 || n + 1 == count)
            continue;
        const double start = bench_clock_wall_s();
        sculpture_part(k.piece.get());
        handing_s += bench_clock_wall_s() - start;
        parts++;
        k.await_encoded();
    }
    k.settle();
    const uint64_t before_end = k.disk.written;
    const double start = bench_clock_wall_s();
    demand(sculpture_stroke_end(k.piece.get()), "stroke");
    const double handed = bench_clock_wall_s();
    k.settle();
    const double acknowledged = bench_clock_wall_s();
    handing_s += handed - start;
    demand(k.piece->has_history && sculpture_facts(k.piece.get()).kept == sculpture_facts(k.piece.get()).put, "kept");
    const uint64_t bytes = k.disk.written - before, changed = corners_changed(was, k.piece->clay);
    const double bare = bare_sync_s(scratch, k.disk.written - before_end);
    sculpture_attend(k.piece.get());
    clay_finish(&was);
    f->hand_us.push_back(1e6 * handing_s / count);
    f->part_us.push_back(1e6 * handing_s / parts);
    f->ack_ms.push_back(1e3 * (acknowledged - start));
    f->bare_ms.push_back(1e3 * bare);
    f->ack_over_bare.push_back((acknowledged - start) / bare);
    f->kilobytes.push_back(1e-3 * static_cast<double>(bytes));
    f->changed.push_back(1e-3 * 8 * static_cast<double>(changed));
    f->amplification.push_back(static_cast<double>(bytes) / (8 * static_cast<double>(changed)));
}

void measure_strokes(kept_piece &k, const std::string &object, const std::string &scratch)
{
    constexpr int count = 50, strokes = 9;
    std::printf("strokes of %d toothpaste dabs on %s, handed every second dab; medians of %d\n"
                "  hand: what handing to the history thread takes from the frame; changed: 8 bytes a changed corner;\n"
                "  ack: from pedal-up to acknowledged; bare: one write and fdatasync of what was written in that time\n"
                "%4s %12s %12s %11s %11s %9s %8s %8s %9s\n",
                count, object.c_str(), strokes, "R", "hand us/dab", "us/part", "written kB", "changed kB", "written x",
                "ack ms", "bare ms", "ack/bare");
    for (const double radius : {4.0, 8.0, 16.0, 32.0}) {
        const std::vector<bench_object_dab> dabs =
            bench_object_spiral(k.piece->clay, radius, 1, count * (strokes + 1));
        stroke_figures f, first;
        one_stroke(k, scratch, dabs.data(), count, &first);
        for (int n = 1; n <= strokes; n++)
            one_stroke(k, scratch, dabs.data() + count * n, count, &f);
        std::printf("%4.0f %12.2f %12.2f %11.1f %11.1f %9.2f %8.2f %8.2f %9.2f\n", radius,
                    bench_clock_median(f.hand_us), bench_clock_median(f.part_us), bench_clock_median(f.kilobytes),
                    bench_clock_median(f.changed), bench_clock_median(f.amplification), bench_clock_median(f.ack_ms),
                    bench_clock_median(f.bare_ms), bench_clock_median(f.ack_over_bare));
        std::fflush(stdout);
    }
}

/* --- opening --- */

double read_all_s(const std::string &folder, uint64_t *bytes_out)
{
    std::vector<char> block(1 << 20);
    *bytes_out = 0;
    const double start = bench_clock_wall_s();
    for (const fs::directory_entry &entry : fs::directory_iterator(folder)) {
        const int fd = open(entry.path().c_str(), O_RDONLY);
        for (ssize_t got; (got = read(fd, block.data(), block.size())) > 0;)
            *bytes_out += static_cast<uint64_t>(got);
        close(fd);
    }
    return bench_clock_wall_s() - start;
}

/* Forgets what the machine has read, where that is allowed. */
bool drop_caches()
{
    sync();
    std::ofstream file("/proc/sys/vm/drop_caches");
    file << 3 << std::flush;
    return file.good();
}

void measure_opening(const std::string &folder)
{
    for (const bool cold : {false, true}) {
        std::vector<double> open_s, cat_s, ratio;
        uint64_t bytes = 0;
        uint32_t strokes = 0;
        bool dropped = true;
        for (int round = 0; round < 3; round++) {
            dropped = dropped && (!cold || drop_caches());
            cat_s.push_back(read_all_s(folder, &bytes));
            dropped = dropped && (!cold || drop_caches());
            auto piece = std::make_unique<sculpture>();
            history_finding finding;
            std::string text;
            byte_store port;
            const double start = bench_clock_wall_s();
            store *files = store_open(folder, &port, &text);
            demand(files != nullptr, text);
            demand(sculpture_open(piece.get(), &port, CAPACITY_BRICKS, nullptr, 1.0, &finding), finding.text);
            open_s.push_back(bench_clock_wall_s() - start);
            ratio.push_back(open_s.back() / cat_s.back());
            strokes = sculpture_facts(piece.get()).strokes;
            demand(sculpture_close(piece.get()), "closing");
            store_close(files);
        }
        std::printf("opening, %s: %.2f s with its surface, %u strokes to undo; reading its %.0f MB: %.2f s; "
                    "ratio %.1f%s\n",
                    cold ? "caches dropped" : "from the page cache", bench_clock_median(open_s), strokes,
                    1e-6 * static_cast<double>(bytes), bench_clock_median(cat_s), bench_clock_median(ratio),
                    dropped ? "" : " (caches could not be dropped)");
    }
}

void measure(const options &o, const std::string &object)
{
    const std::string folder = o.folder + "/" + object;
    fs::remove_all(folder);
    make_store(folder, object != "1M");
    {
        kept_piece k(folder);
        measure_strokes(k, object, o.folder + "/bare");
        const std::vector<bench_object_dab> dabs = bench_object_spiral(k.piece->clay, 8, 1, 200 * 5);
        for (size_t n = 0; n < dabs.size(); n++) { /* a ring that is full */
            if (n % 5 == 0)
                sculpture_stroke_begin(k.piece.get());
            k.dab(dabs[n]);
            if (n % 5 == 4) {
                demand(sculpture_stroke_end(k.piece.get()), "stroke");
                sculpture_attend(k.piece.get());
                k.settle();
            }
        }
        std::printf("in all: %.1f MB of records, %.1f MB of zeros for new undo-files, %.1f MB of checkpoints written\n",
                    1e-6 * static_cast<double>(k.disk.written), 1e-6 * static_cast<double>(k.disk.made),
                    1e-6 * static_cast<double>(k.disk.checkpoints));
    }
    measure_opening(folder);
    std::printf("\n");
    fs::remove_all(folder);
}

/* --- the soak --- */

double resident_mb()
{
    std::ifstream file("/proc/self/statm");
    double all = 0, resident = 0;
    file >> all >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

struct sample {
    double mb;
    size_t files;
    uint32_t strokes;
};

bool soak(const options &o)
{
    constexpr uint64_t every = 50000, warm = 200000;
    playlist list;
    std::string text;
    demand(playlist_load("", o.tape, &list, &text), text);
    fs::remove_all(o.folder);
    fs::create_directories(o.folder);
    std::vector<sample> series;
    {
        kept_piece k(o.folder);
        uint64_t dabs = 0, passes = 0, next = every;
        station_ears ears;
        ears.dab = [&dabs](const station_dab &d) { dabs += d.outcome == STATUS_OK; };
        station *desk = station_open(k.piece.get(), ears);
        command clear;
        clear.kind = COMMAND_CLEAR;
        std::printf("%10s %8s %8s %8s %8s\n", "dabs", "MB", "files", "strokes", "MB disk");
        for (int64_t start_us = 0; dabs < o.dabs; start_us += list.end_us + 1000000, passes++) {
            for (command c : list.commands) {
                c.time_us += start_us;
                station_do(desk, c);
                while (station_picture_take(desk, &text) || station_export_take(desk, &text) ||
                       station_message_take(desk, &text))
                    continue;
                if (dabs < next)
                    continue;
                next += every;
                k.settle();
                uint64_t bytes = 0;
                sample s = {resident_mb(), 0, sculpture_facts(k.piece.get()).strokes};
                for (const fs::directory_entry &entry : fs::directory_iterator(o.folder)) {
                    s.files++;
                    bytes += entry.file_size();
                }
                series.push_back(s);
                std::printf("%10llu %8.1f %8zu %8u %8.0f\n", static_cast<unsigned long long>(dabs), s.mb, s.files,
                            s.strokes, 1e-6 * static_cast<double>(bytes));
                std::fflush(stdout);
            }
            clear.time_us = start_us + list.end_us;
            station_do(desk, clear);
        }
        station_close(desk);
        std::printf("%llu dabs in %llu passes of %s\n", static_cast<unsigned long long>(dabs),
                    static_cast<unsigned long long>(passes), o.tape.c_str());
    }
    fs::remove_all(o.folder);
    bool flat = true;
    const size_t from = warm / every;
    for (size_t n = from; n < series.size(); n++)
        flat = flat && series[n].mb < 1.1 * series[from - 1].mb + 8 &&
               series[n].strokes <= HISTORY_STROKES_DEFAULT + 1 &&
               static_cast<double>(series[n].files) < 1.25 * static_cast<double>(series[from - 1].files);
    std::printf("%s\n", flat ? "flat" : "NOT flat");
    return flat;
}

options parse(int argc, char **argv)
{
    options o;
    for (int n = 1; n < argc; n++) {
        const std::string word = argv[n];
        const bool has_value = n + 1 < argc;
        if (word == "--folder" && has_value)
            o.folder = argv[++n];
        else if (word == "--object" && has_value)
            o.objects = {argv[++n]};
        else if (word == "--soak" && has_value)
            o.tape = argv[++n];
        else if (word == "--dabs" && has_value)
            o.dabs = std::strtoull(argv[++n], nullptr, 10);
        else {
            std::fprintf(stderr,
                         "usage: bench_history [--folder DIR] [--object 1M|20M] [--soak TAPE [--dabs N]]\n");
            std::exit(2);
        }
    }
    return o;
}

} // namespace

int main(int argc, char **argv)
{
    const options o = parse(argc, argv);
    if (!o.tape.empty())
        return soak(o) ? 0 : 1;
    for (const std::string &object : o.objects)
        measure(o, object);
    fs::remove_all(o.folder);
    return 0;
}
