/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: history on real files keeps what it keeps in memory: the last 200 of 500 strokes, exactly, across restarts, and
 *       damage done to the files from outside is met the same way.
 * Method: a folder under the test's temporary folder; the storage is closed and opened between two sessions; one file
 *         is cut with the system's own call. */
#include "tests/unit/history/storage_store.h"

#include "tests/unit/history/piece.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace {

struct session {
    storage s;
    std::unique_ptr<piece> p;

    explicit session(const std::string &folder)
    {
        EXPECT_EQ(storage_open(&s, folder.c_str()), 0);
        p = std::make_unique<piece>(storage_store_port(&s));
    }
    ~session()
    {
        p.reset();
        storage_close(&s);
    }
    session(const session &) = delete;
    session &operator=(const session &) = delete;
};

struct folder {
    std::string path = testing::TempDir() + "glaise_history_" + std::to_string(getpid());
    folder() { std::filesystem::remove_all(path); }
    ~folder() { std::filesystem::remove_all(path); }
};

TEST(real_files, ring_of_200_keeps_the_last_200_of_500)
{
    const folder f;
    std::vector<uint64_t> digests;
    {
        session now(f.path);
        ASSERT_EQ(now.p->opened, STATUS_OK);
        digests.push_back(now.p->digest());
        for (int n = 1; n <= 500; n++) {
            ASSERT_EQ(now.p->stroke(piece_stroke_numbered(n)), STATUS_OK);
            digests.push_back(now.p->digest());
        }
    }
    session now(f.path);
    ASSERT_EQ(now.p->opened, STATUS_OK);
    EXPECT_STREQ(now.p->finding.text, "");
    ASSERT_EQ(now.p->digest(), digests[500]);
    for (size_t n = 500; n > 300; n--) {
        ASSERT_EQ(now.p->undo(), STATUS_OK);
        ASSERT_EQ(now.p->digest(), digests[n - 1]);
    }
    while (history_can_undo(&now.p->h)) /* what was forgotten may be there again */
        ASSERT_EQ(now.p->undo(), STATUS_OK);
    EXPECT_EQ(now.p->digest(), digests[now.p->h.tree.cursor]);
    if (now.p->h.tree.cursor != 300) {
        ASSERT_EQ(now.p->go(HISTORY_TO, 300), STATUS_OK);
    }
    for (size_t n = 301; n <= 500; n++) {
        ASSERT_EQ(now.p->redo(), STATUS_OK);
        ASSERT_EQ(now.p->digest(), digests[n]);
    }
    EXPECT_EQ(now.p->redo(), STATUS_HISTORY_ENDS);
}

TEST(real_files, file_cut_from_outside_ends_there_and_nothing_is_thrown_away)
{
    const folder f;
    uint64_t after_one = 0;
    std::string second, third;
    {
        session now(f.path);
        for (int n = 1; n <= 3; n++) {
            ASSERT_EQ(now.p->stroke(piece_stroke_numbered(n)), STATUS_OK);
            after_one = n == 1 ? now.p->digest() : after_one;
        }
        second = f.path + "/" + ring_name_of(ring_next_file(&now.p->h.ring, 2, 0)).text;
        third = f.path + "/" + ring_name_of(ring_next_file(&now.p->h.ring, 3, 0)).text;
    }
    std::filesystem::resize_file(second, 100);
    session now(f.path);
    ASSERT_EQ(now.p->opened, STATUS_OK);
    EXPECT_EQ(now.p->digest(), after_one);
    EXPECT_NE(now.p->finding.text[0], '\0');
    EXPECT_TRUE(std::filesystem::exists(third + ".set-aside")) << "stroke 3 was kept, and cannot be reached";
    EXPECT_FALSE(std::filesystem::exists(third));
    ASSERT_EQ(now.p->stroke(piece_stroke_numbered(4)), STATUS_OK);
}

TEST(real_files, two_sessions_do_not_share_a_folder)
{
    const folder f;
    session now(f.path);
    storage other;
    EXPECT_EQ(storage_open(&other, f.path.c_str()), -EWOULDBLOCK);
    ASSERT_EQ(now.p->stroke(piece_stroke_numbered(1)), STATUS_OK);
}

} // namespace
