/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: an export is there whole or not at all, and what stood under its name stays until then.
 * Method: a folder of its own, listed after every outcome; writes and syncs that fail on demand; a real full disk: a
 *         file system of 64 KiB in memory where this program may mount one, and the process's limit of file size. */
#include "platform/storage/storage_export.h"

#include "tests/unit/storage/failing_system.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

namespace {

namespace fs = std::filesystem;

class storage_export_on_disk : public testing::Test {
protected:
    std::string folder = testing::TempDir() + "glaise_export_" + std::to_string(getpid());
    std::string path = folder + "/piece.ply";
    storage_export e;

    void SetUp() override
    {
        failing_system_reset();
        fs::remove_all(folder);
        fs::create_directory(folder);
    }
    void TearDown() override
    {
        failing_system_reset();
        fs::remove_all(folder);
    }
    std::set<std::string> listed() const
    {
        std::set<std::string> names;
        for (const fs::directory_entry &entry : fs::directory_iterator(folder))
            names.insert(entry.path().filename());
        return names;
    }
    std::string on_disk() const
    {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void put_old() const { std::ofstream(path) << "old"; }
    const std::set<std::string> only = {"piece.ply"};
};

TEST_F(storage_export_on_disk, appears_whole_at_the_end)
{
    ASSERT_EQ(storage_export_begin(&e, path.c_str()), 0);
    ASSERT_EQ(storage_export_write(&e, "ply\n", 4), 0);
    ASSERT_EQ(storage_export_write(&e, "more", 4), 0);
    EXPECT_FALSE(fs::exists(path));
    failing_system_reset();
    ASSERT_EQ(storage_export_end(&e), 0);
    EXPECT_EQ(failing_system.file_syncs, 1);
    EXPECT_EQ(failing_system.folder_syncs, 1);
    EXPECT_EQ(on_disk(), "ply\nmore");
    EXPECT_EQ(listed(), only);
    storage_export_abandon(&e);
    EXPECT_EQ(listed(), only);
}

TEST_F(storage_export_on_disk, replaces_in_one_instant)
{
    put_old();
    ASSERT_EQ(storage_export_begin(&e, path.c_str()), 0);
    ASSERT_EQ(storage_export_write(&e, "new", 3), 0);
    EXPECT_EQ(on_disk(), "old");
    ASSERT_EQ(storage_export_end(&e), 0);
    EXPECT_EQ(on_disk(), "new");
    EXPECT_EQ(listed(), only);
}

TEST_F(storage_export_on_disk, abandoned_leaves_nothing)
{
    put_old();
    ASSERT_EQ(storage_export_begin(&e, path.c_str()), 0);
    ASSERT_EQ(storage_export_write(&e, "new", 3), 0);
    storage_export_abandon(&e);
    EXPECT_EQ(on_disk(), "old");
    EXPECT_EQ(listed(), only);
    EXPECT_EQ(storage_export_write(&e, "new", 3), -ECANCELED);
    EXPECT_EQ(storage_export_end(&e), -ECANCELED);
    EXPECT_EQ(on_disk(), "old");
}

TEST_F(storage_export_on_disk, short_and_interrupted_writes_do_not_show)
{
    std::string text;
    for (int n = 0; n < 1000; n++)
        text += std::to_string(n * 7);
    failing_system.at_most = 3;
    failing_system.interrupt_every = 4;
    ASSERT_EQ(storage_export_begin(&e, path.c_str()), 0);
    ASSERT_EQ(storage_export_write(&e, text.data(), text.size()), 0);
    ASSERT_EQ(storage_export_end(&e), 0);
    failing_system_reset();
    EXPECT_EQ(on_disk(), text);
}

TEST_F(storage_export_on_disk, first_error_is_kept_and_nothing_else_happens)
{
    put_old();
    ASSERT_EQ(storage_export_begin(&e, path.c_str()), 0);
    failing_system.write_error = ENOSPC;
    failing_system.write_bytes_left = 2;
    EXPECT_EQ(storage_export_write(&e, "new", 3), -ENOSPC);
    EXPECT_EQ(listed(), only);
    failing_system_reset();
    EXPECT_EQ(storage_export_write(&e, "new", 3), -ENOSPC);
    EXPECT_EQ(storage_export_end(&e), -ENOSPC);
    EXPECT_EQ(on_disk(), "old");
    EXPECT_EQ(listed(), only);
}

TEST_F(storage_export_on_disk, medium_that_finds_out_late_leaves_nothing)
{
    put_old();
    ASSERT_EQ(storage_export_begin(&e, path.c_str()), 0);
    ASSERT_EQ(storage_export_write(&e, "new", 3), 0);
    failing_system.sync_error = ENOSPC;
    EXPECT_EQ(storage_export_end(&e), -ENOSPC);
    EXPECT_EQ(on_disk(), "old");
    EXPECT_EQ(listed(), only);
}

TEST_F(storage_export_on_disk, paths_that_are_no_file_are_refused)
{
    for (const std::string &bad : {folder + "/", folder + "/.", folder + "/..", std::string(""), folder + "/none/x",
                                   folder + "/" + std::string(256, 'n'), folder + "/" + std::string(250, 'n')}) {
        EXPECT_LT(storage_export_begin(&e, bad.c_str()), 0) << bad;
        EXPECT_LT(storage_export_end(&e), 0);
        storage_export_abandon(&e);
    }
    EXPECT_TRUE(listed().empty());
    fs::create_directory(path);
    ASSERT_EQ(storage_export_begin(&e, path.c_str()), 0);
    EXPECT_EQ(storage_export_end(&e), -EISDIR);
    EXPECT_EQ(listed(), only);
    EXPECT_TRUE(fs::is_directory(path));
}

TEST_F(storage_export_on_disk, path_without_a_folder_is_here)
{
    const fs::path before = fs::current_path();
    fs::current_path(folder);
    EXPECT_EQ(storage_export_begin(&e, "piece.ply"), 0);
    EXPECT_EQ(storage_export_write(&e, "x", 1), 0);
    EXPECT_EQ(storage_export_end(&e), 0);
    fs::current_path(before);
    EXPECT_EQ(on_disk(), "x");
}

TEST_F(storage_export_on_disk, two_at_a_time_do_not_meet)
{
    storage_export other;
    ASSERT_EQ(storage_export_begin(&e, path.c_str()), 0);
    ASSERT_EQ(storage_export_begin(&other, path.c_str()), 0);
    ASSERT_EQ(storage_export_write(&e, "one", 3), 0);
    ASSERT_EQ(storage_export_write(&other, "other", 5), 0);
    ASSERT_EQ(storage_export_end(&e), 0);
    EXPECT_EQ(on_disk(), "one");
    ASSERT_EQ(storage_export_end(&other), 0);
    EXPECT_EQ(on_disk(), "other");
    EXPECT_EQ(listed(), only);
}

/* --- a disk that is really full --- */

/* Writes until it fails. */
int fill(storage_export *e)
{
    const std::vector<char> block(4096, 'x');
    int result = 0;
    for (int n = 0; result == 0 && n < 1000; n++)
        result = storage_export_write(e, block.data(), block.size());
    return result;
}

TEST_F(storage_export_on_disk, full_disk_leaves_no_half_file)
{
    const std::string disk = folder + "/disk", on_it = disk + "/piece.ply";
    fs::create_directory(disk);
    if (mount("glaise", disk.c_str(), "tmpfs", 0, "size=64k") != 0)
        GTEST_SKIP() << "may not mount here; the limit of file size stands in for it";
    std::ofstream(on_it) << "old";
    EXPECT_EQ(storage_export_begin(&e, on_it.c_str()), 0);
    EXPECT_EQ(fill(&e), -ENOSPC);
    EXPECT_EQ(storage_export_end(&e), -ENOSPC);
    std::ifstream in(on_it, std::ios::binary);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "old");
    in.close();
    EXPECT_EQ(std::distance(fs::directory_iterator(disk), {}), 1);
    ASSERT_EQ(umount(disk.c_str()), 0);
}

TEST_F(storage_export_on_disk, limit_of_file_size_leaves_no_half_file)
{
    put_old();
    rlimit before, small;
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    small = before;
    small.rlim_cur = 65536;
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    EXPECT_EQ(storage_export_begin(&e, path.c_str()), 0);
    EXPECT_EQ(fill(&e), -EFBIG);
    EXPECT_EQ(storage_export_end(&e), -EFBIG);
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old_handler);
    EXPECT_EQ(on_disk(), "old");
    EXPECT_EQ(listed(), only);
}

} // namespace
