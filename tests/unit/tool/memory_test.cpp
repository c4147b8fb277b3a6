/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: when the machine gives no more memory, at whichever allocation, the dab or copy is refused and the clay is as
 *       it was, valid, and works again once there is memory.
 * Method: in a child process whose address space is limited to what it has plus so many bytes, more each time, until
 *         the work fits. */
#include "clay/capacity.h"
#include "tool/ellipsoid.h"
#include "tool/tool.h"

#include "tests/property/plain_clay.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__)
#define MEMORY_IS_WATCHED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MEMORY_IS_WATCHED 1
#endif
#endif

namespace {

enum outcome { FITTED, REFUSED, BROKEN, UNUSABLE };

void limit_memory(size_t bytes)
{
    unsigned long pages = 0;
    FILE *f = std::fopen("/proc/self/statm", "r");
    if (f == nullptr || std::fscanf(f, "%lu", &pages) != 1)
        _exit(UNUSABLE);
    std::fclose(f);
    const rlimit limit = {pages * static_cast<unsigned long>(sysconf(_SC_PAGESIZE)) + bytes, RLIM_INFINITY};
    if (setrlimit(RLIMIT_AS, &limit) != 0)
        _exit(UNUSABLE);
}

void free_memory()
{
    const rlimit limit = {RLIM_INFINITY, RLIM_INFINITY};
    if (setrlimit(RLIMIT_AS, &limit) != 0)
        _exit(UNUSABLE);
}

struct bench {
    clay c;
    tool_scratch scratch;
    ellipsoid ball;
};

/* Some clay, as a dab finds it: the first slabs of every pool may be open already, or not. Fresh memory is full of
   noise, as it is in a process that has run for long. */
bool prepare(bench &b, bool recording)
{
    seeded chance = {1};
    if (mallopt(M_PERTURB, 0x5A) != 1 || mallopt(M_MMAP_THRESHOLD, 16 << 20) != 1)
        return false;
    const bool made = clay_init(&b.c, CAPACITY_BRICKS) == STATUS_OK &&
                      tool_scratch_init(&b.scratch, CAPACITY_DAB_BRICKS) == STATUS_OK &&
                      ellipsoid_init(&b.ball, ELLIPSOID_WYVILL, 0.1) == STATUS_OK &&
                      plain_clay_ball(&b.c, chance, {0, 0, 0}, 9, 1) == STATUS_OK;
    dirt_clear(&b.c.dirty);
    if (recording)
        clay_change_begin(&b.c);
    return made;
}

outcome dab_with(size_t bytes, action kind, bool recording)
{
    static bench b;
    if (!prepare(b, recording))
        return UNUSABLE;
    const plain_clay before = plain_clay_of(&b.c);
    const uint64_t digest = clay_digest(&b.c);
    const tool t = {ellipsoid_shape(&b.ball), kind, 5, deform_default()};
    const tool_dab d = {{{3, 2, 1}, {{20, 0, 0}, {0, 20, 0}, {0, 0, 20}}}, 1, 0};
    tool_counts counts;
    limit_memory(bytes);
    const status s = tool_apply(&t, &d, &b.c, &b.scratch, &counts);
    free_memory();
    if (s == STATUS_OK)
        return clay_is_valid(&b.c) ? FITTED : BROKEN;
    if (s != STATUS_NO_MEMORY || plain_clay_difference(before, &b.c) != "" || clay_digest(&b.c) != digest ||
        !clay_is_valid(&b.c))
        return BROKEN;
    dirt_clear(&b.c.dirty);
    if (tool_apply(&t, &d, &b.c, &b.scratch, &counts) != STATUS_OK || !clay_is_valid(&b.c))
        return BROKEN;
    if (recording) {
        clay_change_revert(&b.c);
        if (clay_digest(&b.c) != digest)
            return BROKEN;
    }
    return REFUSED;
}

outcome copy_with(size_t bytes)
{
    static bench b;
    static clay copy;
    if (!prepare(b, false) || clay_init(&copy, CAPACITY_BRICKS) != STATUS_OK)
        return UNUSABLE;
    const uint64_t digest = clay_digest(&b.c);
    limit_memory(bytes);
    const status s = clay_copy(&copy, &b.c);
    free_memory();
    if (s == STATUS_OK)
        return clay_digest(&copy) == digest && clay_is_valid(&copy) ? FITTED : BROKEN;
    return s == STATUS_NO_MEMORY && clay_digest(&copy) == 0 && clay_is_valid(&copy) ? REFUSED : BROKEN;
}

template <typename work_type> outcome in_child(work_type work)
{
    const pid_t child = fork();
    if (child == 0)
        _exit(work());
    int how = 0;
    if (child < 0 || waitpid(child, &how, 0) != child || !WIFEXITED(how))
        return BROKEN;
    return static_cast<outcome>(WEXITSTATUS(how));
}

/* More room each time until the work fits; along the way it must have been refused at several places. */
template <typename work_type> void expect_whole_or_nothing(work_type work, int refusals_min)
{
    int refused = 0;
    for (size_t bytes = 0; bytes < (64u << 20); bytes += 64u << 10) {
        const outcome o = in_child([&] { return work(bytes); });
        ASSERT_NE(o, UNUSABLE) << bytes;
        ASSERT_NE(o, BROKEN) << bytes;
        if (o == FITTED) {
            EXPECT_GE(refused, refusals_min);
            return;
        }
        refused++;
    }
    FAIL() << "never fitted";
}

class memory_ends : public testing::Test {
protected:
    void SetUp() override
    {
#ifdef MEMORY_IS_WATCHED
        GTEST_SKIP() << "the address sanitizer needs the address space itself";
#endif
    }
};

TEST_F(memory_ends, in_a_dab)
{
    for (action kind : {ACTION_TOOTHPASTE, ACTION_ERASER, ACTION_STAMP})
        expect_whole_or_nothing([&](size_t bytes) { return dab_with(bytes, kind, false); }, 4);
}

TEST_F(memory_ends, in_a_dab_of_a_stroke)
{
    for (action kind : {ACTION_TOOTHPASTE, ACTION_SMOOTH})
        expect_whole_or_nothing([&](size_t bytes) { return dab_with(bytes, kind, true); }, 4);
}

TEST_F(memory_ends, in_a_copy)
{
    expect_whole_or_nothing(copy_with, 1);
}

} // namespace
