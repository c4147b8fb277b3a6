/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the real program on a real file system loses no stroke that it acknowledged, whenever the power goes. Without
 *       its syncs it does, so the test would see it.
 * Method: a guest (ext4 on a disk whose every write is logged) plays a tape of strokes, undos, redos and forks on a
 *         small ring. Each "kept" is written behind the file system as soon as it is said, so that the log says what
 *         had been promised at each of its entries. The power is cut at seeded entries, three times out of four where
 *         something is not flushed; that is kept, dropped or torn (write_log.h). Of each disk: e2fsck must find it
 *         sound once the file system's own journal is played, `glaise check` the last promise or what came after it,
 *         in a state that an uninterrupted run had; every tenth is opened by the program itself. */
#include "tests/crash/real_life.h"
#include "tests/vm/guest_run.h"
#include "tests/vm/write_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cinttypes>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

constexpr uint64_t MIB = 1 << 20;
constexpr uint64_t FILE_SYSTEM_BYTES = 64 * MIB, DISK_BYTES = 65 * MIB;
constexpr uint64_t SCRATCH_BYTES = 700 * MIB;
constexpr int STROKES = 250;
constexpr int TOLD_MAX = 5; /* failures in full */

/* What was found on a disk. */
struct found {
    std::string file_system; /* what e2fsck said of it; "": it is sound */
    std::string store;       /* what is wrong with the store */
    bool absent = true;
    uint64_t record = 0, stroke = 0, records = 0;
    unsigned checkpoints = 0;
    std::string digest;
};

struct tally {
    uint64_t cuts = 0, with_pending = 0, with_promise = 0, beyond = 0, opened = 0;
    uint64_t damaged = 0, lost = 0, wrong = 0, records_lost_most = 0;
    write_log_fates fates;
    std::set<uint64_t> strokes;
};

class power_cut : public testing::Test, public real_life {
protected:
    void SetUp() override
    {
        std::error_code error;
        const fs::path memory = "/dev/shm";
        const fs::space_info room = fs::space(memory, error);
        const bool fits = !error && room.available > SCRATCH_BYTES;
        std::string name = ((fits ? memory : fs::temp_directory_path()) / "glaise-power-cut-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        base = name;
        program = GLAISE_PROGRAM;
        setenv("PATH", (std::string(std::getenv("PATH")) + ":/usr/sbin:/sbin").c_str(), 1);
        seed = real_life_number("GLAISE_CUT_SEED", 1);
        chance = {seed};
        seeded of_the_tape{1}; /* an earlier run can be cut again by another chance */
        real_life_put(base / "life.tape", real_life_tape(of_the_tape, STROKES));
        states = real_life_states_of(*this, "life.tape");
        ASSERT_EQ(states.size(), STROKES + 1u) << said("whole.err") << said("empty.err");
    }
    void TearDown() override { fs::remove_all(base); }

    int tool(const std::string &name, const std::vector<std::string> &words)
    {
        return real_life{base, name}.run(words, "tool");
    }
    std::string told() const { return said("tool") + said("tool.err"); }

    void make_disk();
    void make_guest(const std::string &name);
    void run_guest(const std::string &name, const std::string &preload);
    void take_log(const fs::path &folder);
    std::vector<size_t> cuts_of(uint64_t count);
    found look(const write_log_bytes &disk);
    void open_again(const found &f);
    std::string judge(const found &f, const real_life_kept &promised, tally *t) const;
    tally cut(const std::string &name, uint64_t count, bool must_hold);
    void report(const std::string &name, const tally &t) const;
    void keep(const write_log_bytes &disk, size_t entry) const;

    uint64_t seed = 0;
    seeded chance{0};
    real_life_states states;
    write_log log;
    write_log_bytes before; /* the disk when the log began */
    std::vector<real_life_kept> promises;  /* at each entry, the last one */
    std::vector<size_t> promised_at;       /* entries */
};

void put_disk(const fs::path &image, const write_log_bytes &disk)
{
    const auto bytes = static_cast<std::streamsize>(disk.size());
    std::ofstream(image, std::ios::binary).write(reinterpret_cast<const char *>(disk.data()), bytes);
}

/* --- the run --- */

void power_cut::make_disk()
{
    const std::string disk = (base / "base.img").string();
    real_life_put(disk, "");
    fs::resize_file(disk, DISK_BYTES);
    ASSERT_EQ(tool("mke2fs", {"-q", "-F", "-t", "ext4", "-b", "4096", "-J", "size=4", "-E",
                              "lazy_itable_init=0,lazy_journal_init=0", disk, "64M"}),
              0)
        << told();
    fs::copy_file(disk, base / "disk.img", fs::copy_options::overwrite_existing);
}

void power_cut::make_guest(const std::string &name)
{
    const std::string sources = VM_SOURCES, script = sources + "/guest";
    ASSERT_EQ(tool(script, {"kernel", VM_FOLDER}), 0) << told();
    ASSERT_EQ(tool(script, {"pack", VM_FOLDER, name, sources + "/power_cut_init",
                            "virtio_pci virtio_blk crc32c_generic? ext4", program + "=/bin/glaise",
                            VM_PROMISE "=/bin/promise", VM_NO_SYNC "=/no_sync.so",
                            (base / "life.tape").string() + "=/life.tape"}),
              0)
        << told();
}

/* A machine that dies before anything was promised is started once more. */
void power_cut::run_guest(const std::string &name, const std::string &preload)
{
    make_guest(name);
    const fs::path folder = VM_FOLDER;
    guest_run g;
    g.kernel = folder / "kernel" / "vmlinuz";
    g.root = folder / (name + ".cpio.gz");
    g.disk = base / "disk.img";
    g.log = base / "write.log";
    g.console = base / "console.txt";
    g.kernel_words = "promise_at=" + std::to_string(FILE_SYSTEM_BYTES) + " preload=" + preload;
    for (int tries = 0; tries < 2 && promised_at.empty(); tries++) {
        make_disk();
        ASSERT_FALSE(HasFatalFailure());
        const std::string trouble = guest_run_to_end(g);
        const std::string console = said("console.txt");
        std::printf("%s%s%s\n", console.substr(0, console.find("sculpting")).c_str(), trouble.empty() ? "" : "guest: ",
                    trouble.c_str());
        if (trouble.empty() || console.find("guest: begun") != std::string::npos)
            take_log(base);
    }
    ASSERT_FALSE(promised_at.empty()) << "nothing was ever promised: " << said("console.txt");
    ASSERT_NE(said("console.txt").find("guest: ended 0"), std::string::npos) << said("console.txt");
}

void power_cut::take_log(const fs::path &folder)
{
    const std::string disk = real_life_text(folder / "base.img");
    ASSERT_EQ(disk.size(), DISK_BYTES);
    before.assign(disk.begin(), disk.begin() + FILE_SYSTEM_BYTES);
    ASSERT_EQ(write_log_read((folder / "write.log").string(), &log), "");
    real_life_kept last;
    promises.clear();
    promised_at.clear();
    for (size_t n = 0; n < log.entries.size(); n++) {
        const write_log_entry &e = log.entries[n];
        if (e.offset == FILE_SYSTEM_BYTES && e.bytes > 0) {
            const char *text = reinterpret_cast<const char *>(log.data_of(e));
            last = real_life_kept_line(std::string(text, strnlen(text, e.bytes)));
            ASSERT_GT(last.record, 0u) << "entry " << n;
            ASSERT_TRUE(states[last.stroke].count(last.digest)) << "what was promised never existed: record "
                                                                << last.record;
            promised_at.push_back(n);
        }
        promises.push_back(last);
    }
}

/* --- the cuts --- */

/* In ascending order. */
std::vector<size_t> power_cut::cuts_of(uint64_t count)
{
    std::vector<size_t> exposed, cuts; /* exposed: something there is not flushed */
    bool pending = false;
    for (size_t n = 0; n < log.entries.size(); n++) {
        const write_log_entry &e = log.entries[n];
        pending = (pending && !e.flush) || (e.bytes > 0 && e.offset < FILE_SYSTEM_BYTES);
        if (pending)
            exposed.push_back(n);
    }
    const auto any_of = [this](size_t n) { return static_cast<size_t>(seeded_bits(chance) % n); };
    for (uint64_t n = 0; n < count; n++)
        cuts.push_back(n % 4 == 0 ? any_of(log.entries.size()) : exposed[any_of(exposed.size())]);
    std::sort(cuts.begin(), cuts.end());
    return cuts;
}

found power_cut::look(const write_log_bytes &disk)
{
    found f;
    const std::string image = (base / "cut.img").string(), store = (base / "store").string();
    put_disk(image, disk);
    const int mended = tool("e2fsck", {"-p", image});
    if (mended > 1)
        f.file_system = "e2fsck -p ended with " + std::to_string(mended) + ": " + told();
    else if (tool("e2fsck", {"-f", "-n", image}) != 0)
        f.file_system = told();
    fs::remove_all(store);
    tool("debugfs", {"-R", "rdump /store " + base.string(), image});
    f.absent = !fs::exists(store);
    if (f.absent)
        return f;
    const int checked = run({"check", store}, "check");
    const std::string said_of_it = said("check");
    const std::string stroke = real_life_value(said_of_it, "stroke"), record = real_life_value(said_of_it, "record");
    if (checked != 0 || stroke.empty() || record.empty())
        f.store = "glaise check ended with " + std::to_string(checked) + ": " + said_of_it + said("check.err");
    if (stroke.empty() || record.empty())
        return f;
    f.record = std::stoull(record);
    f.stroke = std::stoull(stroke);
    f.digest = real_life_value(said_of_it, "digest");
    if (std::sscanf(said_of_it.c_str() + said_of_it.find("read "), "read %*u undo-files with %" SCNu64
                    " records, %u checkpoints", &f.records, &f.checkpoints) != 2)
        f.store = said_of_it;
    return f;
}

/* The program opens it as it is found, and leaves it in order. */
void power_cut::open_again(const found &f)
{
    std::vector<std::string> words = replay("empty.tape");
    words.insert(words.end(), {"--stats", (base / "again.json").string()});
    ASSERT_EQ(run(words, "again"), 0) << said("again.err");
    ASSERT_NE(said("again.json").find(f.digest), std::string::npos) << said("again");
    ASSERT_EQ(run({"check", (base / "store").string()}, "check"), 0) << said("check");
    ASSERT_EQ(real_life_value(said("check"), "digest"), f.digest);
}

/* "" or what is not as it was promised. */
std::string power_cut::judge(const found &f, const real_life_kept &promised, tally *t) const
{
    t->with_promise += promised.record > 0;
    if (!f.file_system.empty()) {
        t->damaged++;
        return "the file system is damaged: " + f.file_system;
    }
    if (f.record < promised.record) {
        t->lost++;
        t->records_lost_most = std::max(t->records_lost_most, promised.record - f.record);
        return "record " + std::to_string(promised.record) + " was promised, found is " + std::to_string(f.record) +
               ". " + f.store;
    }
    if (f.absent)
        return "";
    const auto known = states.find(f.stroke);
    const bool existed = known != states.end() && known->second.count(f.digest) > 0;
    const bool same = f.record > promised.record || promised.record == 0 ||
                      (f.stroke == promised.stroke && f.digest == promised.digest);
    if (!f.store.empty() || !existed || !same) {
        t->wrong++;
        return "stroke " + std::to_string(f.stroke) + ", digest " + f.digest + (existed ? "" : " never existed") +
               (same ? "" : " was not promised with its record") + ". " + f.store;
    }
    t->beyond += f.record > promised.record;
    t->strokes.insert(f.stroke);
    return "";
}

void power_cut::report(const std::string &name, const tally &t) const
{
    const auto n = [](uint64_t number) { return std::to_string(number); };
    const std::string text =
        name + ", seed " + n(seed) + ": " + n(log.entries.size()) + " entries in the log (" +
        n(log.all.size() / MIB) + " MiB), " + n(log.flushes) + " flushes, " + n(promised_at.size()) +
        " promises up to record " + n(promises.back().record) + "\n  " + n(t.cuts) + " power cuts, " +
        n(t.with_promise) + " with something promised; unflushed writes, at " + n(t.with_pending) + " of them: " +
        n(t.fates.kept) + " kept, " + n(t.fates.dropped) + " dropped, " + n(t.fates.torn) +
        " torn\n  file systems damaged: " + n(t.damaged) + "; lost what was promised: " + n(t.lost) + " (at most " +
        n(t.records_lost_most) + " records); otherwise wrong: " + n(t.wrong) +
        "\n  came back beyond the promise: " + n(t.beyond) + "; at " +
        n(t.strokes.size()) + " different strokes; opened and checked again: " + n(t.opened);
    std::puts(text.c_str());
}

tally power_cut::cut(const std::string &name, uint64_t count, bool must_hold)
{
    tally t;
    write_log_disk disk = {&log, before};
    for (const size_t entry : cuts_of(count)) {
        const std::string where = name + ", seed " + std::to_string(seed) + ", cut at entry " + std::to_string(entry);
        write_log_fates fates;
        const write_log_bytes left = disk.after_cut(entry, chance, &fates);
        t.fates.kept += fates.kept;
        t.fates.dropped += fates.dropped;
        t.fates.torn += fates.torn;
        t.with_pending += fates.kept + fates.dropped + fates.torn > 0;
        const found f = look(left);
        const std::string trouble = judge(f, promises[entry], &t);
        if (must_hold && !trouble.empty() && t.damaged + t.lost + t.wrong <= TOLD_MAX) {
            ADD_FAILURE() << where << ": " << trouble;
            keep(left, entry);
        }
        if (must_hold && trouble.empty() && !f.absent && t.cuts % 10 == 0) {
            SCOPED_TRACE(where);
            open_again(f);
            t.opened++;
        }
        t.cuts++;
    }
    report(name, t);
    return t;
}

/* A disk as it was found, and the run, so that GLAISE_CUT_RUN can cut it again. */
void power_cut::keep(const write_log_bytes &disk, size_t entry) const
{
    const fs::path folder = fs::path(VM_FOLDER) / "failed";
    fs::create_directories(folder);
    const fs::path image = folder / ("cut-" + std::to_string(seed) + "-" + std::to_string(entry) + ".img");
    put_disk(image, disk);
    std::printf("  the disk: %s\n", image.c_str());
    for (const char *file : {"base.img", "write.log", "life.tape"})
        if (fs::exists(base / file) && !std::getenv("GLAISE_CUT_RUN"))
            fs::copy_file(base / file, folder / file, fs::copy_options::overwrite_existing);
    std::printf("  to cut it again: GLAISE_CUT_SEED=%" PRIu64 " GLAISE_CUT_RUN=%s\n", seed, folder.c_str());
}

TEST_F(power_cut, loses_nothing_that_was_acknowledged)
{
    if (const char *earlier = std::getenv("GLAISE_CUT_RUN"))
        take_log(earlier);
    else
        run_guest("with_syncs", "");
    ASSERT_FALSE(HasFatalFailure());
    const uint64_t cuts = real_life_number("GLAISE_CUTS", 400);
    const found end = look(write_log_disk{&log, before}.whole());
    EXPECT_EQ(end.file_system + end.store, "");
    EXPECT_EQ(end.checkpoints, 2u) << "a run without checkpoints proves too little";
    EXPECT_GT(end.record, 2 * end.records) << "no undo-file was written anew";
    const tally t = cut("with syncs", cuts, true);
    EXPECT_EQ(t.damaged + t.lost + t.wrong, 0u);
    EXPECT_GT(t.with_promise, cuts / 2);
    EXPECT_GE(t.with_pending, cuts * 3 / 4);
    EXPECT_GT(t.strokes.size(), std::min<uint64_t>(cuts / 8, STROKES / 5)) << "always at the same place proves little";
}

TEST_F(power_cut, control_without_syncs_loses)
{
    run_guest("without_syncs", "/no_sync.so");
    ASSERT_FALSE(HasFatalFailure());
    const uint64_t cuts = std::max<uint64_t>(100, real_life_number("GLAISE_CUTS", 400) / 4);
    const tally t = cut("without syncs", cuts, false);
    EXPECT_GT(t.lost, 0u) << "a test that sees no loss where there must be some";
}

} // namespace
