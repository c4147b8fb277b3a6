/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: folders are told, renamed and removed as storage_shelf.h says: durably where it says so, never while one is
 *       open, never outside of the storage, never through a link.
 * Method: real folders under the test's temporary one, looked at with the standard library beside; system calls that
 *         fail on demand. */
#include "platform/storage/storage_shelf.h"

#include "tests/unit/storage/failing_folders.h"
#include "tests/unit/storage/failing_system.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <set>
#include <sys/stat.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

class storage_shelf_on_disk : public testing::Test {
protected:
    std::string path = testing::TempDir() + "glaise_shelf_" + std::to_string(getpid());
    storage s;

    void SetUp() override
    {
        failing_system_reset();
        failing_folders = {};
        fs::remove_all(path);
        ASSERT_EQ(storage_open(&s, path.c_str()), 0);
        for (const char *name : {"piece-0001", "piece-0002"}) {
            fs::create_directory(path + "/" + name);
            std::ofstream(path + "/" + name + "/about") << "about " << name;
            std::ofstream(path + "/" + name + "/field") << std::string(100000, 'f');
        }
    }
    void TearDown() override
    {
        failing_system_reset();
        failing_folders = {};
        storage_close(&s);
        fs::remove_all(path);
    }
    std::set<std::string> told() const
    {
        std::set<std::string> names;
        const auto take = [](void *into, const char *name) {
            static_cast<std::set<std::string> *>(into)->insert(name);
        };
        EXPECT_EQ(storage_shelf_list(&s, take, &names), 0);
        return names;
    }
    std::string read(const char *folder, const char *file, size_t most = 100)
    {
        std::string bytes(most, '?');
        size_t got = 0;
        bool exists = false;
        const int error = storage_shelf_read(&s, folder, file, bytes.data(), most, &got, &exists);
        return error ? "error " + std::to_string(-error) : exists ? bytes.substr(0, got) : "absent";
    }
    bool is_there(const std::string &name) const { return fs::exists(path + "/" + name); }
    static std::string error(int number) { return "error " + std::to_string(number); }
};

TEST_F(storage_shelf_on_disk, tells_real_folders_alone)
{
    std::ofstream(path + "/file") << "x";
    fs::create_directory_symlink(path + "/piece-0001", path + "/link");
    fs::create_directory(path + "/Upper case");
    EXPECT_EQ(told(), (std::set<std::string>{"piece-0001", "piece-0002"}));
}

TEST_F(storage_shelf_on_disk, reads_plain_files_alone)
{
    EXPECT_EQ(read("piece-0001", "about"), "about piece-0001");
    EXPECT_EQ(read("piece-0001", "about", 5), "about");
    EXPECT_EQ(read("piece-0001", "none"), "absent");
    EXPECT_EQ(read("piece-0009", "about"), error(ENOENT));
    ASSERT_EQ(mkfifo((path + "/piece-0001/pipe").c_str(), 0600), 0);
    fs::create_symlink("about", path + "/piece-0001/link");
    fs::create_directory(path + "/piece-0001/folder");
    for (const char *bad : {"pipe", "link", "folder", "..", "../piece-0002/about", "", "About"})
        EXPECT_EQ(read("piece-0001", bad), error(EINVAL)) << bad;
    EXPECT_EQ(read("..", "about"), error(EINVAL));
}

TEST_F(storage_shelf_on_disk, short_and_interrupted_reads_do_not_show)
{
    failing_system.at_most = 3;
    failing_system.interrupt_every = 2;
    EXPECT_EQ(read("piece-0002", "about"), "about piece-0002");
}

TEST_F(storage_shelf_on_disk, a_rename_is_synced)
{
    failing_system_reset();
    ASSERT_EQ(storage_shelf_rename(&s, "piece-0001", "removed-0001"), 0);
    EXPECT_EQ(failing_system.folder_syncs, 1);
    EXPECT_EQ(told(), (std::set<std::string>{"removed-0001", "piece-0002"}));
    failing_system.folder_sync_error = EIO;
    EXPECT_EQ(storage_shelf_rename(&s, "piece-0002", "removed-0002"), -EIO);
}

TEST_F(storage_shelf_on_disk, a_rename_that_fails_changes_nothing)
{
    failing_folders.rename_error = EROFS;
    EXPECT_EQ(storage_shelf_rename(&s, "piece-0001", "removed-0001"), -EROFS);
    failing_folders = {};
    EXPECT_EQ(storage_shelf_rename(&s, "piece-0001", "piece-0002"), -ENOTEMPTY);
    EXPECT_EQ(storage_shelf_rename(&s, "piece-0009", "piece-0003"), -ENOENT);
    for (const char *bad : {"..", "../out", "a/b", ""}) {
        EXPECT_EQ(storage_shelf_rename(&s, "piece-0001", bad), -EINVAL);
        EXPECT_EQ(storage_shelf_rename(&s, bad, "piece-0003"), -EINVAL);
    }
    EXPECT_EQ(told(), (std::set<std::string>{"piece-0001", "piece-0002"}));
}

TEST_F(storage_shelf_on_disk, what_is_open_is_neither_renamed_nor_removed)
{
    storage inner;
    ASSERT_EQ(storage_open(&inner, (path + "/piece-0001").c_str()), 0);
    EXPECT_EQ(storage_shelf_rename(&s, "piece-0001", "removed-0001"), -EWOULDBLOCK);
    EXPECT_EQ(storage_shelf_remove(&s, "piece-0001"), -EWOULDBLOCK);
    EXPECT_TRUE(is_there("piece-0001/field"));
    storage_close(&inner);
    EXPECT_EQ(storage_shelf_rename(&s, "piece-0001", "removed-0001"), 0);
    EXPECT_EQ(storage_shelf_remove(&s, "removed-0001"), 0);
    EXPECT_FALSE(is_there("removed-0001"));
}

TEST_F(storage_shelf_on_disk, a_removal_that_failed_is_finished_by_the_next)
{
    failing_folders = {0, EIO, 0, 0, 2};
    EXPECT_EQ(storage_shelf_remove(&s, "piece-0001"), -EIO);
    failing_folders = {};
    EXPECT_TRUE(is_there("piece-0001"));
    EXPECT_NE(is_there("piece-0001/field"), is_there("piece-0001/about")) << "one of them is gone";
    EXPECT_EQ(storage_shelf_remove(&s, "piece-0001"), 0);
    EXPECT_FALSE(is_there("piece-0001"));
    EXPECT_EQ(storage_shelf_remove(&s, "piece-0001"), 0) << "absent";
}

TEST_F(storage_shelf_on_disk, a_removal_follows_no_link_and_takes_no_folder)
{
    fs::create_directory_symlink(path + "/piece-0002", path + "/piece-0001/other");
    fs::create_symlink(path + "/piece-0002/about", path + "/piece-0001/stranger");
    fs::create_directory_symlink(path + "/piece-0002", path + "/link");
    EXPECT_NE(storage_shelf_remove(&s, "link"), 0);
    fs::create_directory(path + "/piece-0001/folder");
    EXPECT_EQ(storage_shelf_remove(&s, "piece-0001"), -ENOTEMPTY);
    EXPECT_TRUE(is_there("piece-0001/folder"));
    fs::remove(path + "/piece-0001/folder");
    EXPECT_EQ(storage_shelf_remove(&s, "piece-0001"), 0);
    EXPECT_EQ(read("piece-0002", "about"), "about piece-0002");
    EXPECT_TRUE(is_there("piece-0002/field"));
    EXPECT_EQ(storage_shelf_remove(&s, ".."), -EINVAL);
}

TEST_F(storage_shelf_on_disk, measures)
{
    uint64_t bytes = 0, less = 0;
    ASSERT_EQ(storage_shelf_bytes(&s, "piece-0001", &bytes), 0);
    EXPECT_GE(bytes, 100000u);
    fs::remove(path + "/piece-0001/field");
    ASSERT_EQ(storage_shelf_bytes(&s, "piece-0001", &less), 0);
    EXPECT_LE(less + 100000, bytes);
    EXPECT_EQ(storage_shelf_bytes(&s, "piece-0009", &bytes), -ENOENT);
    ASSERT_EQ(storage_shelf_free(&s, &bytes), 0);
    const double there = static_cast<double>(fs::space(path).available);
    EXPECT_NEAR(static_cast<double>(bytes), there, 0.1 * there) << "others write meanwhile";
    failing_folders.measure_error = EIO;
    EXPECT_EQ(storage_shelf_free(&s, &bytes), -EIO);
    EXPECT_EQ(bytes, 0u);
}

} // namespace
