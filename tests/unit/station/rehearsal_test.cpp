/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a file that makes opening crash is set aside at the next start, and nothing else ever is.
 * Method: openings that crash, end in other ways, or live, in processes of their own, over a folder in memory; then a
 *         piece in it, one of whose undo-files crashes whoever reads its bricks. */
#include "station/opening.h"
#include "station/rehearsal.h"

#include "tests/unit/history/memory_store.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <memory>
#include <unistd.h>

namespace {

void read_one(const byte_store &port, const char *name)
{
    char byte;
    size_t got;
    const status s = port.read(port.self, name, 0, &byte, 1, &got);
    if (s == STATUS_OK && got == 1 && byte == '!')
        std::abort();
    if (s == STATUS_OK && got == 1 && byte == 'k')
        (void)raise(SIGKILL);
    if (s == STATUS_OK && got == 1 && byte == 'e')
        _exit(3);
}

void read_all(const byte_store &port)
{
    for (const char *name : {"a", "b", "c"})
        read_one(port, name);
}

struct folder {
    memory_store disk;
    byte_store port = disk.port();
    history_finding finding{};

    folder(const char *a, const char *b, const char *c)
    {
        const char *const names[] = {"a", "b", "c"}, *const bytes[] = {a, b, c};
        for (int n = 0; n < 3; n++)
            disk.files[names[n]] = {static_cast<uint8_t>(bytes[n][0])};
    }
    void start_that_did_not_end() { rehearsal_begin(port, read_all, &finding); }
};

TEST(rehearsal, first_start_is_none)
{
    folder f(".", "!", ".");
    const auto before = f.disk.files;
    f.start_that_did_not_end();
    EXPECT_STREQ(f.finding.text, "");
    EXPECT_EQ(f.disk.files.count(REHEARSAL_MARK), 1u);
    rehearsal_end(f.port);
    EXPECT_EQ(f.disk.files, before);
    f.start_that_did_not_end();
    EXPECT_STREQ(f.finding.text, "") << "the last one ended";
}

TEST(rehearsal, what_crashed_the_last_start_is_set_aside)
{
    folder f(".", "!", ".");
    f.start_that_did_not_end();
    f.start_that_did_not_end();
    EXPECT_STREQ(f.finding.text, "b made the last start fail and was set aside: what it held is missing");
    EXPECT_EQ(f.disk.files.count("b"), 0u);
    EXPECT_EQ(f.disk.files.at("b.set-aside"), std::vector<uint8_t>{'!'});
    EXPECT_EQ(f.disk.files.size(), 4u) << "a, c, the mark";
}

TEST(rehearsal, all_that_crash_are)
{
    folder f("!", "e", "!");
    f.start_that_did_not_end();
    f.start_that_did_not_end();
    for (const char *name : {"a", "b", "c"})
        EXPECT_EQ(f.disk.files.count(std::string(name) + ".set-aside"), 1u) << name;
    EXPECT_NE(std::string(f.finding.text).find("a made"), std::string::npos) << "the first is told";
}

TEST(rehearsal, start_that_was_killed_sets_nothing_aside)
{
    for (const char *middle : {".", "k"}) {
        folder f(".", middle, ".");
        f.start_that_did_not_end();
        const auto before = f.disk.files;
        f.start_that_did_not_end();
        EXPECT_STREQ(f.finding.text, "");
        EXPECT_EQ(f.disk.files, before);
    }
}

TEST(rehearsal, changes_nothing_that_it_reads)
{
    folder f(".", ".", ".");
    f.start_that_did_not_end();
    const auto before = f.disk.files;
    rehearsal_begin(
        f.port,
        [](const byte_store &port) {
            if (port.write(port.self, "a", 0, "x", 1) != STATUS_OK || port.remove(port.self, "b") != STATUS_OK ||
                port.rename(port.self, "c", "d") != STATUS_OK || port.sync(port.self, "a") != STATUS_OK)
                std::abort();
            read_one(port, "a");
        },
        &f.finding);
    EXPECT_EQ(f.disk.files, before);
}

TEST(rehearsal, medium_that_takes_no_mark_is_opened_all_the_same)
{
    folder f(".", "!", ".");
    f.disk.fail_at = 1;
    f.disk.fail_on = true;
    f.start_that_did_not_end();
    rehearsal_end(f.port);
    EXPECT_STREQ(f.finding.text, "");
}

/* --- with a piece --- */

const std::string victim = "undo-0001";

/* The memory's port, but whoever reads that file's bricks is gone: its header, as scanning does, may be read. */
byte_store crashing(memory_store *disk)
{
    byte_store port = disk->port();
    port.read = [](void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got) {
        if (name == victim && offset > 0)
            std::abort();
        return memory_store_read(self, name, offset, bytes, n, got);
    };
    return port;
}

TEST(rehearsal, piece_with_a_crashing_stroke_opens_before_it)
{
    memory_store disk;
    byte_store port = disk.port();
    constexpr history_settings few = {10, 1 << 16, 1 << 24, 1 << 24, 0};
    history_finding finding;
    ellipsoid ball;
    std::vector<uint64_t> digests;
    ASSERT_EQ(ellipsoid_init(&ball, ELLIPSOID_WYVILL, 1), STATUS_OK);
    std::map<std::string, std::vector<uint8_t>> as_cut;
    {
        auto piece = std::make_unique<sculpture>();
        ASSERT_EQ(sculpture_open(piece.get(), &port, CAPACITY_BRICKS, &few, 0.5, &finding), STATUS_OK);
        const tool t = {ellipsoid_shape(&ball), ACTION_TOOTHPASTE, 7, deform_default()};
        for (int n = 0; n < 3; n++) {
            digests.push_back(sculpture_digest(piece.get()));
            sculpture_stroke_begin(piece.get());
            const sculpture_dab d = {{{5.0 * n, 0, 0}, {{7, 0, 0}, {0, 6, 0}, {0, 0, 5}}}, 2, 1};
            ASSERT_EQ(sculpture_apply(piece.get(), &t, &d, nullptr), STATUS_OK);
            ASSERT_EQ(sculpture_stroke_end(piece.get()), STATUS_OK);
        }
        as_cut = disk.files; /* no checkpoint yet: opening goes over every stroke */
        ASSERT_EQ(sculpture_close(piece.get()), STATUS_OK);
    }
    disk.files = as_cut;
    disk.spoilt.clear();
    ASSERT_EQ(disk.files.count(victim), 1u);
    disk.files[REHEARSAL_MARK] = {}; /* left by the start that crashed */
    auto piece = std::make_unique<sculpture>();
    ASSERT_EQ(opening_here(piece.get(), crashing(&disk), few, 0.5, {}, &finding), STATUS_OK);
    EXPECT_NE(std::string(finding.text).find(victim + " made the last start fail"), std::string::npos) << finding.text;
    EXPECT_EQ(sculpture_digest(piece.get()), digests[1]) << "as it was before that stroke";
    EXPECT_EQ(disk.files.count(victim + ".set-aside"), 1u);
    EXPECT_EQ(disk.files.count(REHEARSAL_MARK), 0u);
    EXPECT_EQ(sculpture_close(piece.get()), STATUS_OK);
}

} // namespace
