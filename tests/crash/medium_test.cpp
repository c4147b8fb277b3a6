/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the real program on real media that are full, read-only or failing: it ends by itself, every stroke is kept or
 *       refused with a message, undo reaches less far first, what was acknowledged is there, and when there is room again
 *       sculpting goes on.
 * Method: file systems of a few MiB, mounted where only this process and its children see them: tmpfs; ext4 on a loop
 *         device, whose image lies on a tmpfs that is too small for it, so that writing fails beneath a sync. What
 *         `glaise check` finds is compared with what --kept said and with the end that --stats tells. Without the right
 *         to mount the tests are skipped and say so. */
#include "tests/crash/real_life.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sched.h>
#include <sstream>
#include <sys/mount.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;

constexpr uint64_t MIB = 1 << 20;

/* Every stroke in another place and colour; one in ten is taken back and made again. */
std::string tape_text(int strokes, int first)
{
    std::ostringstream tape;
    tape << "glaise tape 1\n@0 size 9 9 9\n+0 rate 30\n";
    for (int n = first; n < first + strokes; n++) {
        char colour[16];
        std::snprintf(colour, sizeof colour, "#%06x", 0x102030 + n * 0x0301);
        const int x = n * 37 % 61 - 30, y = n * 53 % 59 - 29, z = n * 29 % 47 - 23;
        tape << "+30 colour " << colour << "\n+0 place " << x << ' ' << y << ' ' << z << "\n+0 apply down\n+0 glide "
             << x + 14 << ' ' << y << ' ' << z << " 300\n+300 apply up\n";
        if (n % 10 == 9)
            tape << "+10 undo\n+10 redo\n";
    }
    return tape.str();
}

uint64_t times_in(const std::string &text, const std::string &what)
{
    uint64_t n = 0;
    for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        n++;
    return n;
}

/* A namespace of mounts of this process's own: as root, or as root of a namespace of users. */
std::string alone()
{
    static const std::string why = [] {
        const uid_t user = getuid();
        if (unshare(user == 0 ? CLONE_NEWNS : CLONE_NEWNS | CLONE_NEWUSER) != 0)
            return std::string("unshare: ") + std::strerror(errno);
        if (user != 0) {
            real_life_put("/proc/self/setgroups", "deny");
            real_life_put("/proc/self/uid_map", "0 " + std::to_string(user) + " 1\n");
        }
        if (mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0)
            return std::string("mount: ") + std::strerror(errno);
        return std::string();
    }();
    return why;
}

/* What one run came to. */
struct outcome {
    int exit = 0;
    std::string err, end_digest;
    uint64_t refused = 0;
    real_life_kept kept; /* the last that was acknowledged */
};

/* What lies on the medium. */
struct found {
    int exit = 0;
    uint64_t record = 0, stroke = 0, strokes = 0;
    std::string digest, text;
};

class medium : public testing::Test, public real_life {
protected:
    void SetUp() override
    {
        const std::string why = alone();
        if (!why.empty())
            GTEST_SKIP() << "this process may not mount anything (" << why << ")";
        std::string name = (fs::temp_directory_path() / "glaise-medium-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        base = name;
        program = GLAISE_PROGRAM;
        fs::create_directory(base / "m");
        fs::create_directory(base / "beneath");
        store = base / "m" / "store";
    }
    void TearDown() override
    {
        if (base.empty())
            return;
        umount2((base / "m").c_str(), MNT_DETACH);
        umount2((base / "beneath").c_str(), MNT_DETACH);
        fs::remove_all(base);
    }
    bool tmpfs(const char *folder, uint64_t bytes, bool again = false)
    {
        const std::string size = "size=" + std::to_string(bytes);
        return mount("tmpfs", (base / folder).c_str(), "tmpfs", again ? MS_REMOUNT : 0, size.c_str()) == 0;
    }
    /* An empty string, or why there is no ext4. */
    std::string ext4(uint64_t bytes, bool make)
    {
        const std::string image = (base / "beneath" / "image").string(), to = (base / "m").string();
        if (make) {
            if (getuid() != 0)
                return "a loop device is root's";
            real_life_put(image, "");
            fs::resize_file(image, bytes);
            if (std::system(("mkfs.ext4 -q -F -O ^metadata_csum -J size=1 -E lazy_itable_init=0,nodiscard " + image +
                             " >/dev/null 2>&1").c_str()) != 0)
                return "mkfs.ext4 did not do it";
        }
        return std::system(("mount -o loop,errors=remount-ro " + image + " " + to + " >/dev/null 2>&1").c_str()) == 0
                   ? ""
                   : "no loop device could be mounted";
    }
    outcome sculpt(int strokes, int first = 0)
    {
        real_life_put(base / "tape", tape_text(strokes, first));
        outcome o;
        o.exit = run({"replay", (base / "tape").string(), "--store", store.string(), "--kept", "--ring", "200",
                      "--hands", "1", "--stats", (base / "stats").string()},
                     "out");
        o.err = said("out.err");
        o.refused = times_in(o.err, "no stroke can begin: the storage is full");
        const std::string stats = said("stats"), key = "\"field_digest\": \"";
        const size_t at = stats.find(key);
        o.end_digest = at == std::string::npos ? "" : stats.substr(at + key.size(), 16);
        o.kept = real_life_last_kept(said("out"));
        return o;
    }
    found look()
    {
        found f;
        f.exit = run({"check", store.string()}, "check");
        f.text = said("check") + said("check.err");
        f.digest = real_life_value(f.text, "digest");
        if (f.digest.empty())
            return f;
        f.record = std::stoull(real_life_value(f.text, "record"));
        f.stroke = std::stoull(real_life_value(f.text, "stroke"));
        f.strokes = std::stoull(real_life_value(f.text, "history"));
        return f;
    }
    uint64_t room() const { return fs::space(base / "m").available; }

    /* What every run on a medium that fills up must come to; answers what lies there. */
    void all_is_kept_or_refused(const outcome &o, int strokes, found *found_out)
    {
        ASSERT_TRUE(o.exit == 0 || o.exit == 1) << o.exit << o.err;
        const found f = look();
        ASSERT_EQ(f.exit, 0) << f.text;
        if (o.kept.record > 0) {
            EXPECT_GE(f.record, o.kept.record) << "what was acknowledged is gone";
        }
        if (o.exit == 0) { /* then nothing was left in memory */
            EXPECT_EQ(f.digest, o.end_digest) << f.text << o.err;
            EXPECT_EQ(o.kept.digest, o.end_digest);
            EXPECT_EQ(f.stroke + o.refused, static_cast<uint64_t>(strokes)) << o.err;
        } else {
            EXPECT_NE(o.err.find("full"), std::string::npos) << o.err;
            EXPECT_EQ(f.digest, o.kept.digest) << f.text << o.err;
        }
        *found_out = f;
    }
    void fills_up(int strokes)
    {
        found f;
        const outcome o = sculpt(strokes);
        ASSERT_NO_FATAL_FAILURE(all_is_kept_or_refused(o, strokes, &f));
        EXPECT_EQ(o.exit, 0) << o.err;
        EXPECT_EQ(o.refused, 0u) << "most of it is our own undo" << o.err;
        EXPECT_LT(f.strokes, f.stroke) << "undo reaches less far";
        EXPECT_GE(f.strokes, 3u) << f.text;
        std::printf("%d strokes: %llu made, %llu to undo, %llu refused, %llu KiB left\n", strokes,
                    static_cast<unsigned long long>(f.stroke), static_cast<unsigned long long>(f.strokes),
                    static_cast<unsigned long long>(o.refused), static_cast<unsigned long long>(room() >> 10));
    }

    fs::path store;
};

TEST_F(medium, full_of_our_own_undo_goes_on)
{
    ASSERT_TRUE(tmpfs("m", 24 * MIB)) << std::strerror(errno);
    fills_up(80);
}

TEST_F(medium, full_of_our_own_undo_goes_on_ext4)
{
    const std::string why = ext4(40 * MIB, true);
    if (!why.empty())
        GTEST_SKIP() << why;
    fills_up(80);
}

TEST_F(medium, every_size_keeps_or_refuses)
{
    for (uint64_t halves = 1; halves <= 24; halves += 3) {
        SCOPED_TRACE(halves);
        ASSERT_TRUE(tmpfs("m", halves * MIB / 2 + 100000)) << std::strerror(errno);
        found f;
        const outcome o = sculpt(25);
        if (fs::exists(store)) {
            all_is_kept_or_refused(o, 25, &f);
        }
        ASSERT_EQ(umount2((base / "m").c_str(), 0), 0);
    }
}

TEST_F(medium, full_of_other_things_refuses_and_goes_on_when_they_are_gone)
{
    ASSERT_TRUE(tmpfs("m", 24 * MIB)) << std::strerror(errno);
    real_life_put(base / "m" / "ballast", std::string(24 * MIB - 200000, 'x'));
    found f;
    const outcome o = sculpt(20);
    ASSERT_NO_FATAL_FAILURE(all_is_kept_or_refused(o, 20, &f));
    EXPECT_TRUE(o.exit == 1 || o.kept.digest == o.end_digest) << "all could be kept, or it says that it could not";
    EXPECT_GT(o.refused, 5u) << o.err;
    EXPECT_GE(f.stroke, 1u);
    fs::remove(base / "m" / "ballast");
    found after;
    const outcome more = sculpt(20, 20);
    ASSERT_NO_FATAL_FAILURE(all_is_kept_or_refused(more, 20 + static_cast<int>(f.stroke), &after));
    EXPECT_EQ(more.exit, 0) << more.err;
    EXPECT_EQ(more.refused, 0u) << more.err;
    EXPECT_GE(after.stroke, f.stroke + 20);
}

TEST_F(medium, read_only_from_the_beginning_keeps_all_in_memory)
{
    ASSERT_TRUE(tmpfs("m", 24 * MIB)) << std::strerror(errno);
    ASSERT_EQ(sculpt(5).exit, 0);
    const found before = look();
    ASSERT_EQ(before.exit, 0) << before.text;
    ASSERT_EQ(mount("tmpfs", (base / "m").c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr), 0);
    const outcome o = sculpt(5, 5);
    EXPECT_EQ(o.exit, 1);
    EXPECT_NE(o.err.find("what was made last is only in memory"), std::string::npos) << o.err;
    EXPECT_NE(o.end_digest, before.digest) << "the strokes were made";
    EXPECT_EQ(o.end_digest.size(), 16u);
    EXPECT_EQ(o.kept.record, 0u) << "nothing is acknowledged";
    const found after = look();
    EXPECT_EQ(after.exit, 0) << after.text;
    EXPECT_EQ(after.digest, before.digest);
    EXPECT_EQ(after.record, before.record);
}

/* Beneath ext4 there is less than it believes: writes fail when they are synced, and it ends up read-only. */
TEST_F(medium, failing_beneath_a_sync_acknowledges_nothing_that_is_not_there)
{
    ASSERT_TRUE(tmpfs("beneath", 14 * MIB)) << std::strerror(errno);
    const std::string why = ext4(64 * MIB, true);
    if (!why.empty())
        GTEST_SKIP() << why;
    const outcome o = sculpt(30);
    EXPECT_EQ(o.exit, 1) << o.err;
    EXPECT_NE(o.err.find("what was made last is only in memory"), std::string::npos) << o.err;
    EXPECT_GT(o.kept.record, 0u);
    const found warm = look(); /* through what the machine holds of it */
    ASSERT_NE(warm.digest, "") << warm.text;
    EXPECT_GE(warm.record, o.kept.record) << warm.text;
    ASSERT_EQ(umount2((base / "m").c_str(), 0), 0) << std::strerror(errno);
    ASSERT_TRUE(tmpfs("beneath", 100 * MIB, true));
    ASSERT_EQ(ext4(0, false), "");
    const found cold = look();
    EXPECT_GE(cold.record, o.kept.record) << "acknowledged, and not there" << cold.text;
    EXPECT_EQ(cold.record, warm.record) << "the machine showed what the medium does not have";
    EXPECT_EQ(cold.digest, warm.digest);
    std::printf("acknowledged %llu, on the medium %llu\n", static_cast<unsigned long long>(o.kept.record),
                static_cast<unsigned long long>(cold.record));
    EXPECT_EQ(sculpt(5, 30).exit, 0) << "and it goes on";
}

} // namespace
