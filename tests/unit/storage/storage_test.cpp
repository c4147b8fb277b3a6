/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: storage keeps the promises that history's byte store makes, on real files: nothing is synced twice that may be
 *       lost, short and interrupted calls do not show, names cannot lead out of the folder, no two storages share it.
 * Method: a folder under the test's temporary folder, looked at with the standard library beside the storage; system
 *         calls that fail on demand. */
#include "platform/storage/storage.h"

#include "tests/unit/storage/failing_system.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace {

namespace fs = std::filesystem;

class storage_on_disk : public testing::Test {
protected:
    std::string path = testing::TempDir() + "glaise_storage_" + std::to_string(getpid());
    storage s;

    void SetUp() override
    {
        failing_system_reset();
        fs::remove_all(path);
        ASSERT_EQ(storage_open(&s, path.c_str()), 0);
    }
    void TearDown() override
    {
        failing_system_reset();
        storage_close(&s);
        fs::remove_all(path);
    }
    std::string on_disk(const std::string &name) const
    {
        std::ifstream in(path + "/" + name, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    int put(const char *name, const std::string &text) { return storage_write(&s, name, 0, text.data(), text.size()); }
    std::string got(const char *name, uint64_t offset = 0, size_t n = 100)
    {
        std::vector<char> b(n, '?');
        size_t count = 0;
        EXPECT_EQ(storage_read(&s, name, offset, b.data(), n, &count), 0);
        return {b.data(), count};
    }
};

/* --- the folder --- */

TEST_F(storage_on_disk, folder_is_made_one_level_deep)
{
    EXPECT_TRUE(fs::is_directory(path));
    storage other;
    EXPECT_EQ(storage_open(&other, (path + "/a/b").c_str()), -ENOENT);
    EXPECT_EQ(storage_open(&other, (path + "/a").c_str()), 0);
    storage_close(&other);
    std::ofstream(path + "/file") << "x";
    EXPECT_EQ(storage_open(&other, (path + "/file").c_str()), -ENOTDIR);
}

TEST_F(storage_on_disk, one_at_a_time)
{
    storage other;
    EXPECT_EQ(storage_open(&other, path.c_str()), -EWOULDBLOCK);
    storage_close(&s);
    EXPECT_EQ(storage_open(&other, path.c_str()), 0);
    storage_close(&other);
    ASSERT_EQ(storage_open(&s, path.c_str()), 0);
}

TEST_F(storage_on_disk, new_folder_is_synced_in_its_parent)
{
    failing_system_reset();
    storage other;
    ASSERT_EQ(storage_open(&other, (path + "/a").c_str()), 0);
    storage_close(&other);
    EXPECT_EQ(failing_system.folder_syncs, 2) << "its parent, and itself";
    ASSERT_EQ(storage_open(&other, (path + "/a").c_str()), 0);
    storage_close(&other);
    EXPECT_EQ(failing_system.folder_syncs, 3) << "names that an earlier program left may not be on the medium yet";
}

/* --- names --- */

TEST_F(storage_on_disk, names_cannot_lead_elsewhere)
{
    const std::string longest(63, 'n');
    uint64_t bytes;
    bool exists;
    size_t count;
    char b;
    for (const std::string &bad : {std::string(""), std::string("."), std::string(".."), std::string("a/b"),
                                   std::string("/a"), std::string("A"), std::string("a b"), longest + "n",
                                   std::string("\xc3\xa9")}) {
        EXPECT_EQ(storage_write(&s, bad.c_str(), 0, "x", 1), -EINVAL) << bad;
        EXPECT_EQ(storage_read(&s, bad.c_str(), 0, &b, 1, &count), -EINVAL);
        EXPECT_EQ(storage_size(&s, bad.c_str(), &bytes, &exists), -EINVAL);
        EXPECT_EQ(storage_truncate(&s, bad.c_str(), 0), -EINVAL);
        EXPECT_EQ(storage_sync(&s, bad.c_str()), -EINVAL);
        EXPECT_EQ(storage_rename(&s, bad.c_str(), "good"), -EINVAL);
        EXPECT_EQ(storage_remove(&s, bad.c_str()), -EINVAL);
        ASSERT_EQ(put("good", "x"), 0);
        EXPECT_EQ(storage_rename(&s, "good", bad.c_str()), -EINVAL);
    }
    for (const std::string &good : {longest, std::string("..."), std::string("-"), std::string("undo-0001.set-aside")})
        EXPECT_EQ(put(good.c_str(), "x"), 0) << good;
}

TEST_F(storage_on_disk, only_regular_files_are_touched)
{
    fs::create_directory(path + "/folder");
    std::ofstream(path + "/target") << "mine";
    fs::create_symlink(path + "/target", path + "/link");
    ASSERT_EQ(mkfifo((path + "/pipe").c_str(), 0600), 0);
    for (const char *name : {"folder", "link", "pipe"}) {
        char b;
        size_t count;
        EXPECT_NE(put(name, "x"), 0) << name;
        EXPECT_NE(storage_read(&s, name, 0, &b, 1, &count), 0) << name;
        EXPECT_NE(storage_sync(&s, name), 0) << name;
    }
    EXPECT_EQ(put("pipe", "x"), -EINVAL);
    EXPECT_EQ(on_disk("target"), "mine");
    EXPECT_NE(storage_remove(&s, "folder"), 0);
}

/* --- bytes --- */

TEST_F(storage_on_disk, bytes_are_read_as_written)
{
    ASSERT_EQ(put("a", "hello"), 0);
    EXPECT_EQ(got("a"), "hello");
    EXPECT_EQ(got("a", 2, 2), "ll");
    EXPECT_EQ(got("a", 5), "");
    EXPECT_EQ(got("a", UINT64_MAX), "");
    ASSERT_EQ(storage_write(&s, "a", 7, "!", 1), 0);
    EXPECT_EQ(got("a"), std::string("hello\0\0!", 8));
    ASSERT_EQ(storage_truncate(&s, "a", 2), 0);
    EXPECT_EQ(got("a"), "he");
    ASSERT_EQ(storage_truncate(&s, "a", 4), 0);
    EXPECT_EQ(got("a"), std::string("he\0\0", 4));
    EXPECT_EQ(on_disk("a"), std::string("he\0\0", 4));
    EXPECT_EQ(storage_write(&s, "a", UINT64_MAX, "x", 1), -EFBIG);
    EXPECT_EQ(storage_truncate(&s, "a", UINT64_MAX), -EFBIG);
}

TEST_F(storage_on_disk, absence_is_a_state)
{
    uint64_t bytes = 1;
    bool exists = true;
    EXPECT_EQ(got("none"), "");
    EXPECT_EQ(storage_size(&s, "none", &bytes, &exists), 0);
    EXPECT_FALSE(exists);
    EXPECT_EQ(bytes, 0u);
    EXPECT_EQ(storage_remove(&s, "none"), 0);
    EXPECT_EQ(storage_sync(&s, "none"), -ENOENT);
    EXPECT_EQ(storage_rename(&s, "none", "other"), -ENOENT);
    EXPECT_TRUE(fs::is_empty(path));
    ASSERT_EQ(put("a", "12345"), 0);
    EXPECT_EQ(storage_size(&s, "a", &bytes, &exists), 0);
    EXPECT_TRUE(exists);
    EXPECT_EQ(bytes, 5u);
}

TEST_F(storage_on_disk, short_and_interrupted_calls_do_not_show)
{
    std::string text;
    for (int n = 0; n < 1000; n++)
        text += std::to_string(n * 7);
    failing_system.at_most = 3;
    failing_system.interrupt_every = 4;
    ASSERT_EQ(put("a", text), 0);
    EXPECT_EQ(got("a", 0, 10000), text);
    failing_system_reset();
    EXPECT_EQ(on_disk("a"), text);
}

TEST_F(storage_on_disk, failing_write_is_told)
{
    failing_system.write_error = ENOSPC;
    failing_system.write_bytes_left = 3;
    EXPECT_EQ(put("a", "hello"), -ENOSPC);
    failing_system_reset();
    EXPECT_EQ(storage_remove(&s, "a"), 0);
    EXPECT_EQ(put("a", "again"), 0);
    EXPECT_EQ(on_disk("a"), "again");
}

/* --- keeping --- */

TEST_F(storage_on_disk, sync_reaches_the_folder_when_the_name_is_new)
{
    ASSERT_EQ(put("a", "1"), 0);
    ASSERT_EQ(storage_sync(&s, "a"), 0);
    EXPECT_EQ(failing_system.file_syncs, 1);
    const int folder_syncs = failing_system.folder_syncs;
    EXPECT_GE(folder_syncs, 1);
    ASSERT_EQ(put("a", "2"), 0);
    ASSERT_EQ(storage_sync(&s, "a"), 0);
    EXPECT_EQ(failing_system.file_syncs, 2);
    EXPECT_EQ(failing_system.folder_syncs, folder_syncs) << "the name was on the medium already";
}

TEST_F(storage_on_disk, rename_replaces_and_is_synced)
{
    ASSERT_EQ(put("old", "old"), 0);
    ASSERT_EQ(storage_sync(&s, "old"), 0);
    ASSERT_EQ(put("new", "new"), 0);
    failing_system_reset();
    ASSERT_EQ(storage_rename(&s, "new", "old"), 0);
    EXPECT_EQ(failing_system.file_syncs, 1) << "it had not been synced";
    EXPECT_GE(failing_system.folder_syncs, 1);
    EXPECT_EQ(on_disk("old"), "new");
    EXPECT_FALSE(fs::exists(path + "/new"));
    EXPECT_EQ(got("old"), "new");
    EXPECT_EQ(got("new"), "");
    ASSERT_EQ(put("old", "n3w"), 0);
    EXPECT_EQ(on_disk("old"), "n3w") << "not the file that was replaced";
}

TEST_F(storage_on_disk, file_from_before_is_synced_before_it_is_renamed)
{
    std::ofstream(path + "/a") << "old";
    ASSERT_EQ(put("a", "new"), 0);
    failing_system_reset();
    ASSERT_EQ(storage_rename(&s, "a", "b"), 0);
    EXPECT_EQ(failing_system.file_syncs, 1);
}

TEST_F(storage_on_disk, removed_is_gone_and_its_name_free)
{
    ASSERT_EQ(put("a", "long text"), 0);
    ASSERT_EQ(storage_remove(&s, "a"), 0);
    EXPECT_FALSE(fs::exists(path + "/a"));
    ASSERT_EQ(put("a", "new"), 0);
    EXPECT_EQ(on_disk("a"), "new");
}

TEST_F(storage_on_disk, file_whose_sync_failed_is_written_no_more)
{
    ASSERT_EQ(put("a", "1"), 0);
    failing_system.sync_error = EIO;
    EXPECT_EQ(storage_sync(&s, "a"), -EIO);
    failing_system_reset();
    char b;
    size_t count;
    EXPECT_EQ(storage_sync(&s, "a"), -EIO) << "a second sync would lie";
    EXPECT_EQ(put("a", "2"), -EIO);
    EXPECT_EQ(storage_read(&s, "a", 0, &b, 1, &count), 0);
    EXPECT_EQ(count, 1u) << "what was on the medium before may be read";
    EXPECT_EQ(storage_rename(&s, "a", "b"), 0) << "and kept aside";
    EXPECT_EQ(failing_system.file_syncs, 0);
    EXPECT_EQ(on_disk("b"), "1");
    ASSERT_EQ(put("a", "3"), 0);
    EXPECT_EQ(storage_sync(&s, "a"), 0);
    EXPECT_EQ(on_disk("a"), "3");
}

TEST_F(storage_on_disk, what_the_machine_holds_of_a_failed_sync_is_dropped_at_once)
{
    ASSERT_EQ(put("a", "1"), 0);
    ASSERT_EQ(storage_sync(&s, "a"), 0);
    ASSERT_EQ(put("a", "2"), 0);
    EXPECT_EQ(failing_system.drops, 0) << "what is sound is read from memory";
    failing_system.sync_error = EIO;
    EXPECT_EQ(storage_sync(&s, "a"), -EIO);
    EXPECT_EQ(failing_system.drops, 1);
}

TEST_F(storage_on_disk, writing_that_failed_in_another_process_is_asked_for_when_a_file_is_opened)
{
    ASSERT_EQ(put("a", "1"), 0);
    storage_close(&s);
    ASSERT_EQ(storage_open(&s, path.c_str()), 0);
    failing_system.settle_error = EIO;
    EXPECT_EQ(got("a"), "1") << "as far as the medium has it, it is read";
    EXPECT_EQ(failing_system.drops, 1);
    EXPECT_EQ(got("a"), "1");
    EXPECT_EQ(failing_system.drops, 1) << "once";
    ASSERT_EQ(put("new", "1"), 0);
    EXPECT_EQ(failing_system.drops, 1) << "nobody wrote to it before";
}

TEST_F(storage_on_disk, spoilt_file_can_be_replaced)
{
    ASSERT_EQ(put("a", "1"), 0);
    failing_system.sync_error = EIO;
    EXPECT_EQ(storage_sync(&s, "a"), -EIO);
    failing_system_reset();
    ASSERT_EQ(put("b", "2"), 0);
    ASSERT_EQ(storage_rename(&s, "b", "a"), 0);
    EXPECT_EQ(got("a"), "2");
    EXPECT_EQ(storage_sync(&s, "a"), 0);
}

TEST_F(storage_on_disk, failing_folder_sync_is_told_and_done_again)
{
    ASSERT_EQ(put("a", "1"), 0);
    failing_system.folder_sync_error = EIO;
    EXPECT_EQ(storage_sync(&s, "a"), -EIO);
    EXPECT_EQ(storage_rename(&s, "a", "b"), -EIO);
    failing_system_reset();
    ASSERT_EQ(put("c", "1"), 0);
    EXPECT_EQ(storage_sync(&s, "c"), 0);
    EXPECT_GE(failing_system.folder_syncs, 1);
}

TEST_F(storage_on_disk, many_files_and_few_places)
{
    const int files = 3 * STORAGE_OPEN_MAX;
    failing_system_reset();
    for (int n = 0; n < files; n++)
        ASSERT_EQ(put(("f" + std::to_string(n)).c_str(), std::to_string(n)), 0);
    EXPECT_EQ(failing_system.file_syncs, files - STORAGE_OPEN_MAX) << "what had to make room was synced first";
    for (int n = 0; n < files; n++)
        ASSERT_EQ(got(("f" + std::to_string(n)).c_str()), std::to_string(n));
}

TEST_F(storage_on_disk, spoilt_files_keep_their_places)
{
    for (int n = 0; n < STORAGE_OPEN_MAX; n++) {
        const std::string name = "f" + std::to_string(n);
        ASSERT_EQ(put(name.c_str(), "x"), 0);
        failing_system.sync_error = EIO;
        ASSERT_EQ(storage_sync(&s, name.c_str()), -EIO);
        failing_system_reset();
    }
    EXPECT_EQ(put("one-more", "x"), -EIO);
    ASSERT_EQ(storage_remove(&s, "f3"), 0);
    EXPECT_EQ(put("one-more", "x"), 0);
    EXPECT_EQ(put("f4", "x"), -EIO);
}

TEST_F(storage_on_disk, spoilt_file_does_not_stand_in_the_way_of_others)
{
    ASSERT_EQ(put("a", "x"), 0);
    failing_system.sync_error = EIO;
    ASSERT_EQ(storage_sync(&s, "a"), -EIO);
    failing_system_reset();
    for (int n = 0; n < 2 * STORAGE_OPEN_MAX; n++)
        ASSERT_EQ(put(("f" + std::to_string(n)).c_str(), "x"), 0);
    EXPECT_EQ(put("a", "x"), -EIO) << "still known to be spoilt";
}

} // namespace
