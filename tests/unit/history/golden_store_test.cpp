/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a sculpture that any version of the formats wrote is read by every later program; this one's are those of the
 *       newest.
 * Method: each folder in tests/golden/store holds the files of a small store, all of the same life, each up to its last
 *         byte that is not zero; sizes.txt has the sizes to lengthen them to, and the digest after every stroke as they
 *         were when the files were made. Folder 1: record version 1, checkpoint version 2; folder 2: record 2,
 *         checkpoint 3, whose bytes are not compared: another zstd may pack them otherwise.
 *         To make the newest again, on purpose only: GLAISE_GOLDEN_STORE_NEW names an empty folder to write to. */
#include "tests/unit/history/memory_store.h"
#include "tests/unit/history/piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

namespace {

const std::string folder = std::string(SOURCE_ROOT) + "/tests/golden/store/";
constexpr const char *newest = "2";

std::vector<uint8_t> read(const std::string &path)
{
    std::ifstream in(path, std::ios::binary);
    EXPECT_TRUE(in.good()) << path;
    return {std::istreambuf_iterator<char>(in), {}};
}

struct golden {
    memory_store m;
    std::map<uint64_t, uint64_t> digests; /* after a stroke */
};

void load(golden *g, const std::string &version)
{
    std::ifstream in(folder + version + "/sizes.txt");
    ASSERT_TRUE(in.good());
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string what, name;
        words >> what;
        if (what == "file") {
            size_t size = 0;
            words >> name >> size;
            std::vector<uint8_t> &f = g->m.files[name] = read(folder + version + "/" + name);
            ASSERT_LE(f.size(), size) << name;
            f.resize(size);
        } else if (what == "stroke") {
            uint64_t stroke = 0, digest = 0;
            words >> stroke >> std::hex >> digest;
            g->digests[stroke] = digest;
        }
    }
    ASSERT_EQ(g->m.files.size(), 6u);
    ASSERT_EQ(g->digests.size(), 6u);
}

/*   0 -- 1 -- 2 (field) -- 3          cursor 4, tip 5
           \__ 4 (three stretches) -- 5                    */
std::map<uint64_t, uint64_t> make(memory_store &m)
{
    std::map<uint64_t, uint64_t> digests = {{0, 0}};
    piece p(m.port());
    const auto stroke = [&](int number, bool ends) {
        EXPECT_EQ(p.stretch(piece_stroke_numbered(number, 40), ends), STATUS_OK);
        EXPECT_EQ(history_keep(&p.h), STATUS_OK);
        digests[p.h.tree.cursor] = p.digest();
    };
    stroke(1, true);
    stroke(2, true);
    EXPECT_EQ(history_field_begin(&p.h, &p.c), STATUS_OK);
    while (p.h.writer)
        (void)history_work(&p.h);
    stroke(3, true);
    EXPECT_EQ(p.go(HISTORY_TO, 1), STATUS_OK);
    for (int n = 10; n < 13; n++)
        stroke(n, n == 12);
    stroke(5, true);
    EXPECT_EQ(p.undo(), STATUS_OK);
    return digests;
}

class golden_store : public testing::TestWithParam<const char *> {};

TEST_P(golden_store, is_read_as_it_was_written)
{
    golden g;
    load(&g, GetParam());
    piece p(g.m.port());
    ASSERT_EQ(p.opened, STATUS_OK);
    EXPECT_STREQ(p.finding.text, "");
    EXPECT_EQ(p.h.tree.cursor, 4u);
    EXPECT_EQ(p.h.tree.tip, 5u);
    EXPECT_EQ(p.h.step_mm, 0.5);
    EXPECT_EQ(p.h.dab, 7u);
    const std::map<uint64_t, uint64_t> parents = {{1, 0}, {2, 1}, {3, 2}, {4, 1}, {5, 4}};
    ASSERT_EQ(p.h.tree.count, parents.size());
    for (const auto &[stroke, parent] : parents)
        EXPECT_EQ(tree_find(&p.h.tree, stroke)->parent, parent);
    EXPECT_EQ(p.digest(), g.digests[4]);
    for (const uint64_t to : {3, 5, 0, 2, 1, 4}) {
        ASSERT_EQ(p.go(HISTORY_TO, to), STATUS_OK);
        EXPECT_EQ(p.digest(), g.digests[to]) << to;
    }
    EXPECT_EQ(g.m.misuse, "");
}

INSTANTIATE_TEST_SUITE_P(versions, golden_store, testing::Values("1", newest));

/* The version and the header bytes that stand in the first sixteen bytes of all files of this room. */
std::string form_of(const std::vector<uint8_t> &file) { return {file.begin(), file.begin() + 16}; }

TEST(golden_store_newest, has_the_forms_and_digests_that_are_written)
{
    golden g;
    memory_store m;
    load(&g, newest);
    EXPECT_EQ(make(m), g.digests);
    for (const auto &[name, bytes] : g.m.files) {
        ASSERT_EQ(m.files.count(name), 1u) << name;
        EXPECT_EQ(form_of(m.files[name]), form_of(bytes)) << name << ": make the newest golden store anew";
    }
    EXPECT_EQ(m.files.size(), g.m.files.size());
}

TEST(golden_store_newest, is_made_anew_on_purpose_only)
{
    const char *to = std::getenv("GLAISE_GOLDEN_STORE_NEW");
    if (!to)
        GTEST_SKIP() << "nobody asked";
    memory_store m;
    const std::map<uint64_t, uint64_t> digests = make(m);
    std::ofstream sizes(std::string(to) + "/sizes.txt");
    for (const auto &[name, bytes] : m.files) {
        const auto end = std::find_if(bytes.rbegin(), bytes.rend(), [](uint8_t b) { return b != 0; }).base();
        std::ofstream out(std::string(to) + "/" + name, std::ios::binary);
        out.write(reinterpret_cast<const char *>(bytes.data()), end - bytes.begin());
        sizes << "file " << name << " " << bytes.size() << "\n";
    }
    for (const auto &[stroke, digest] : digests)
        sizes << "stroke " << stroke << " " << std::hex << digest << std::dec << "\n";
    EXPECT_TRUE(sizes.good());
}

} // namespace
