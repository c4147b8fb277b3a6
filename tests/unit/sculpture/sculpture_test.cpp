/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the door keeps its word: millimetres and seconds outside, steps and amounts inside; whatever is refused leaves
 *       clay, surface and history as before; what was ended comes back by undo, redo and opening again.
 * Method: against the rooms behind the door used by hand; a byte store in memory that fails on demand; a clay so small
 *         that its surface does not fit. */
#include "sculpture/still.h"

#include "tests/property/plain_clay.h"
#include "tests/unit/history/memory_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace {

sculpture_dab dab_at(double x, double y, double z, double radius, double rate = 1, double seconds = 1)
{
    return {{{x, y, z}, {{radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}}, rate, seconds};
}

constexpr history_settings small_ring = {20, 1 << 16, 1 << 24, 1 << 24, 4};

class sculpture_door : public testing::Test {
protected:
    void SetUp() override { ASSERT_EQ(ellipsoid_init(&ball, ELLIPSOID_WYVILL, 0.1), STATUS_OK); }
    void TearDown() override
    {
        if (is_open) {
            EXPECT_EQ(sculpture_close(s.get()), STATUS_OK);
        }
        EXPECT_EQ(disk.misuse, "");
    }
    void open(bool with_store, uint32_t bricks = 4000, double step_mm = 1)
    {
        const byte_store store = disk.port();
        ASSERT_EQ(sculpture_open(s.get(), with_store ? &store : nullptr, bricks, &small_ring, step_mm, &finding), STATUS_OK)
            << finding.text;
        is_open = true;
    }
    void close()
    {
        is_open = false;
        ASSERT_EQ(sculpture_close(s.get()), STATUS_OK);
    }
    /* Each action with a colour of its own, so that painting over toothpaste is a change. */
    tool make(action kind)
    {
        return {ellipsoid_shape(&ball), kind, 0xFF336699u + static_cast<uint32_t>(kind) * 0x090A0Bu, deform_default()};
    }
    status apply(action kind, const sculpture_dab &d)
    {
        const tool t = make(kind);
        return sculpture_apply(s.get(), &t, &d, &counts);
    }
    void stroke(action kind, const sculpture_dab &d)
    {
        sculpture_stroke_begin(s.get());
        ASSERT_EQ(apply(kind, d), STATUS_OK);
        ASSERT_EQ(sculpture_stroke_end(s.get()), STATUS_OK);
    }
    /* The surface is that of the clay. */
    void expect_whole()
    {
        surface fresh;
        ASSERT_EQ(surface_init(&fresh, s->surface.patches.limit), STATUS_OK);
        ASSERT_EQ(surface_rebuild(&fresh, &s->clay, nullptr), STATUS_OK);
        EXPECT_EQ(surface_digest(&s->surface), surface_digest(&fresh));
        EXPECT_EQ(s->surface.triangles, fresh.triangles);
        surface_finish(&fresh);
        EXPECT_TRUE(clay_is_valid(&s->clay));
        EXPECT_EQ(dirt_count(&s->clay.dirty), 0u);
    }
    std::unique_ptr<sculpture> s = std::make_unique<sculpture>();
    bool is_open = false;
    memory_store disk;
    history_finding finding;
    ellipsoid ball;
    sculpture_counts counts;
};

TEST_F(sculpture_door, opens_only_with_settings_that_make_sense)
{
    const double none = std::nan(""), infinite = std::numeric_limits<double>::infinity();
    for (double bad : {0.0, -1.0, none, infinite, SCULPTURE_STEP_MM_MIN / 2, SCULPTURE_STEP_MM_MAX * 2})
        EXPECT_EQ(sculpture_open(s.get(), nullptr, 10, nullptr, bad, &finding), STATUS_BAD_PARAMETER);
    EXPECT_EQ(sculpture_open(s.get(), nullptr, 0, nullptr, 1, &finding), STATUS_BAD_PARAMETER);
    EXPECT_EQ(sculpture_open(s.get(), nullptr, CAPACITY_BRICKS + 1, nullptr, 1, &finding), STATUS_BAD_PARAMETER);
    const byte_store store = disk.port();
    for (const uint32_t strokes : {0u, HISTORY_STROKES_MAX + 1u}) {
        const history_settings wrong = {strokes, 1 << 16, 1 << 24, 1 << 24, 4};
        EXPECT_EQ(sculpture_open(s.get(), &store, 10, &wrong, 1, &finding), STATUS_BAD_PARAMETER);
    }
}

TEST_F(sculpture_door, takes_millimetres_and_seconds)
{
    open(false, 4000, 0.5);
    sculpture_stroke_begin(s.get());
    ASSERT_EQ(apply(ACTION_TOOTHPASTE, dab_at(1, 2, -3, 4, 2, 0.25)), STATUS_OK);
    clay direct;
    tool_scratch scratch;
    tool_counts of_direct;
    ASSERT_EQ(clay_init(&direct, 1000), STATUS_OK);
    ASSERT_EQ(tool_scratch_init(&scratch, 1000), STATUS_OK);
    const tool t = make(ACTION_TOOTHPASTE);
    const tool_dab d = {{{2, 4, -6}, {{8, 0, 0}, {0, 8, 0}, {0, 0, 8}}}, 0.5, 0};
    ASSERT_EQ(tool_apply(&t, &d, &direct, &scratch, &of_direct), STATUS_OK);
    EXPECT_EQ(clay_digest(&s->clay), clay_digest(&direct));
    EXPECT_EQ(counts.tool.dirtied, of_direct.dirtied);
    EXPECT_NE(sculpture_digest(s.get()), clay_digest(&direct)) << "the step is part of the piece";
    tool_scratch_finish(&scratch);
    clay_finish(&direct);
}

struct row {
    double radius, centre[3], turn[3];
    uint64_t visited, computed, dirtied, treated;
};

frame frame_of(const row &r)
{
    frame f;
    const double angle = std::sqrt(r.turn[0] * r.turn[0] + r.turn[1] * r.turn[1] + r.turn[2] * r.turn[2]);
    const double scale = angle > 0 ? 1 / angle : 0, c = std::cos(angle), s = std::sin(angle);
    for (int a = 0; a < 3; a++) {
        /* Column a: unit vector e_a turned about the axis u: c e + s (u x e) + (1 - c) (u . e) u. */
        const double u[3] = {r.turn[0] * scale, r.turn[1] * scale, r.turn[2] * scale};
        const double e[3] = {a == 0 ? 1.0 : 0, a == 1 ? 1.0 : 0, a == 2 ? 1.0 : 0};
        f.origin[a] = r.centre[a];
        for (int n = 0; n < 3; n++) {
            const int p = (n + 1) % 3, q = (n + 2) % 3;
            f.axis[a][n] = r.radius * (c * e[n] + s * (u[p] * e[q] - u[q] * e[p]) + (1 - c) * u[a] * u[n]);
        }
    }
    return f;
}

/* Paper 000 section 6, with the poses of facts/math.md 1.5; here with the treated cubes as the surface counts them. */
TEST_F(sculpture_door, counts_the_papers_table)
{
    const row table[] = {
        {2.96, {0, 0, 0}, {0, 0, 0}, 216, 125, 93, 184},
        {2.96, {0.6036, 0.3678, 0.0491}, {-2.4302, 0.5819, 0.6214}, 1331, 203, 110, 209},
        {4.95, {0.7401, 0.0320, 0.9664}, {0.0040, -0.0037, -0.0305}, 1452, 887, 501, 751},
        {4.95, {0.5241, 0.8226, 0.9114}, {-0.9053, 1.8323, 1.0283}, 4352, 975, 508, 771},
        {6.21, {0, 0, 0}, {0, 0, 0}, 2744, 2197, 1021, 1424},
        {6.21, {0.1221, 0.6884, 0.1044}, {-0.2548, 0.4656, 0.9051}, 8316, 1919, 1003, 1407},
    };
    open(false);
    sculpture_stroke_begin(s.get());
    for (const row &r : table)
        for (action kind : {ACTION_TOOTHPASTE, ACTION_SOFT_ERASER, ACTION_ERASER}) {
            ASSERT_EQ(apply(kind, {frame_of(r), 0.75, 1}), STATUS_OK);
            EXPECT_EQ(counts.tool.visited, r.visited);
            EXPECT_EQ(counts.tool.computed, r.computed);
            EXPECT_EQ(counts.tool.dirtied, r.dirtied);
            EXPECT_EQ(counts.surface.treated, r.treated);
        }
}

TEST_F(sculpture_door, undoes_and_redoes_whole_strokes)
{
    open(true);
    std::vector<uint64_t> field = {sculpture_digest(s.get())}, mesh = {surface_digest(&s->surface)};
    const action kinds[] = {ACTION_TOOTHPASTE, ACTION_TOOTHPASTE, ACTION_STAMP, ACTION_PAINTER, ACTION_ERASER};
    for (action kind : kinds) {
        sculpture_stroke_begin(s.get());
        for (int n = 0; n < 3; n++)
            ASSERT_EQ(apply(kind, dab_at(2 * n, 1, static_cast<double>(field.size()), 6, 2)), STATUS_OK);
        ASSERT_EQ(sculpture_stroke_end(s.get()), STATUS_OK);
        field.push_back(sculpture_digest(s.get()));
        mesh.push_back(surface_digest(&s->surface));
    }
    EXPECT_EQ(s->strokes, 5u);
    for (int round = 0; round < 2; round++) {
        for (size_t n = 5; n-- > 0;) {
            ASSERT_EQ(sculpture_undo(s.get()), STATUS_OK);
            EXPECT_EQ(sculpture_digest(s.get()), field[n]);
            EXPECT_EQ(surface_digest(&s->surface), mesh[n]);
            expect_whole();
        }
        EXPECT_EQ(sculpture_undo(s.get()), STATUS_HISTORY_ENDS);
        for (size_t n = 1; n <= 5; n++) {
            ASSERT_EQ(sculpture_redo(s.get()), STATUS_OK);
            EXPECT_EQ(sculpture_digest(s.get()), field[n]);
            EXPECT_EQ(surface_digest(&s->surface), mesh[n]);
        }
        EXPECT_EQ(sculpture_redo(s.get()), STATUS_HISTORY_ENDS);
    }
}

TEST_F(sculpture_door, without_a_store_has_no_undo)
{
    open(false);
    stroke(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 5));
    EXPECT_EQ(sculpture_undo(s.get()), STATUS_HISTORY_ENDS);
    EXPECT_EQ(sculpture_redo(s.get()), STATUS_HISTORY_ENDS);
    EXPECT_GT(s->clay.corners, 0u);
    expect_whole();
}

TEST_F(sculpture_door, refuses_a_dab_and_goes_on_with_the_stroke)
{
    open(true);
    stroke(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 5));
    sculpture_stroke_begin(s.get());
    ASSERT_EQ(apply(ACTION_TOOTHPASTE, dab_at(3, 0, 0, 5)), STATUS_OK);
    const uint64_t digest = sculpture_digest(s.get()), mesh = surface_digest(&s->surface), number = s->dab;
    counts.surface.treated = 99;
    EXPECT_EQ(apply(ACTION_TOOTHPASTE, dab_at(std::nan(""), 0, 0, 5)), STATUS_BAD_POSE);
    EXPECT_EQ(counts.tool.visited + counts.surface.treated, 0u);
    EXPECT_EQ(apply(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 5, -1)), STATUS_BAD_PARAMETER);
    EXPECT_EQ(apply(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 5, 1, std::nan(""))), STATUS_BAD_PARAMETER);
    EXPECT_EQ(apply(ACTION_TOOTHPASTE, dab_at(0, 0, 1e12, 5)), STATUS_OUT_OF_RANGE);
    EXPECT_EQ(apply(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 5000)), STATUS_TOO_LARGE);
    EXPECT_TRUE(s->in_stroke);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    EXPECT_EQ(surface_digest(&s->surface), mesh);
    EXPECT_EQ(s->dab, number) << "a dab that was not is not counted";
    EXPECT_EQ(apply(ACTION_TOOTHPASTE, dab_at(-3, 0, 0, 5)), STATUS_OK);
    EXPECT_EQ(sculpture_stroke_end(s.get()), STATUS_OK);
    expect_whole();
}

/* Two patches are all this surface may have; a ball on a corner of four bricks needs eight. */
TEST_F(sculpture_door, a_surface_without_room_refuses_the_stroke)
{
    open(true, 8);
    s->surface.patches.limit = 2; /* fewer than its clay could need */
    stroke(ACTION_TOOTHPASTE, dab_at(4, 4, 4, 3, 3));
    const uint64_t digest = sculpture_digest(s.get()), mesh = surface_digest(&s->surface);
    sculpture_stroke_begin(s.get());
    ASSERT_EQ(apply(ACTION_PAINTER, dab_at(4, 4, 4, 3)), STATUS_OK);
    EXPECT_EQ(apply(ACTION_TOOTHPASTE, dab_at(7.5, 7.5, 7.5, 6, 3)), STATUS_POOL_FULL);
    EXPECT_FALSE(s->in_stroke) << "the stroke is over";
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    EXPECT_EQ(surface_digest(&s->surface), mesh);
    stroke(ACTION_TOOTHPASTE, dab_at(4, 4, 4, 3.5, 1));
    ASSERT_EQ(sculpture_undo(s.get()), STATUS_OK);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    s->surface.patches.limit = 16; /* the directory of slabs was made for these */
    expect_whole();
}

TEST_F(sculpture_door, a_surface_without_room_refuses_undo_and_redo)
{
    open(true, 8);
    stroke(ACTION_TOOTHPASTE, dab_at(7.5, 7.5, 7.5, 6, 3));
    const uint64_t digest = sculpture_digest(s.get());
    ASSERT_EQ(sculpture_undo(s.get()), STATUS_OK);
    close();
    open(true, 8); /* so that its pool has yet to be used */
    s->surface.patches.limit = 2;
    EXPECT_EQ(sculpture_redo(s.get()), STATUS_POOL_FULL);
    EXPECT_EQ(s->clay.corners, 0u);
    EXPECT_EQ(s->surface.triangles, 0u);
    EXPECT_EQ(dirt_count(&s->clay.dirty), 0u);
    s->surface.patches.limit = 16;
    ASSERT_EQ(sculpture_redo(s.get()), STATUS_OK);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    expect_whole();
}

TEST_F(sculpture_door, a_clay_without_room_refuses_the_dab)
{
    open(true, 8);
    stroke(ACTION_TOOTHPASTE, dab_at(4, 4, 4, 3, 3));
    const uint64_t digest = sculpture_digest(s.get());
    sculpture_stroke_begin(s.get());
    EXPECT_EQ(apply(ACTION_TOOTHPASTE, dab_at(4, 4, 4, 12, 3)), STATUS_POOL_FULL);
    EXPECT_TRUE(s->in_stroke);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    ASSERT_EQ(sculpture_stroke_end(s.get()), STATUS_OK);
    expect_whole();
}

TEST_F(sculpture_door, a_disk_that_fails_costs_nothing_that_was_made)
{
    open(true);
    stroke(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 5));
    ASSERT_EQ(sculpture_facts(s.get()).kept, sculpture_facts(s.get()).put);
    disk.fail_at = disk.calls + 1;
    disk.fail_on = true;
    stroke(ACTION_TOOTHPASTE, dab_at(4, 0, 0, 5));
    const uint64_t digest = sculpture_digest(s.get());
    keeper_facts facts = sculpture_facts(s.get());
    EXPECT_LT(facts.kept, facts.put);
    EXPECT_EQ(facts.medium, HISTORY_MEDIUM_FAILS);
    EXPECT_STRNE(facts.trouble.text, "");
    EXPECT_EQ(sculpture_room(s.get()), STATUS_OK) << "sculpting goes on";
    disk.fail_at = 0;
    disk.fail_on = false;
    stroke(ACTION_PAINTER, dab_at(4, 0, 0, 5));
    facts = sculpture_facts(s.get());
    EXPECT_EQ(facts.kept, facts.put);
    EXPECT_EQ(facts.medium, HISTORY_MEDIUM_GOOD);
    ASSERT_EQ(sculpture_undo(s.get()), STATUS_OK);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    close();
    open(true);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    expect_whole();
}

TEST_F(sculpture_door, an_undo_that_cannot_be_read_leaves_everything)
{
    open(true);
    stroke(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 5));
    const uint64_t first = sculpture_digest(s.get());
    stroke(ACTION_TOOTHPASTE, dab_at(4, 0, 0, 5));
    const uint64_t then = sculpture_digest(s.get()), mesh = surface_digest(&s->surface);
    disk.fail_at = disk.calls + 1;
    EXPECT_EQ(sculpture_undo(s.get()), STATUS_IO);
    disk.fail_at = 0;
    EXPECT_EQ(sculpture_digest(s.get()), then);
    EXPECT_EQ(surface_digest(&s->surface), mesh);
    expect_whole();
    ASSERT_EQ(sculpture_undo(s.get()), STATUS_OK);
    EXPECT_EQ(sculpture_digest(s.get()), first);
}

TEST_F(sculpture_door, a_stroke_in_many_parts_is_one_undo_step)
{
    open(true);
    sculpture_stroke_begin(s.get());
    for (int n = 0; n < 5; n++) {
        ASSERT_EQ(apply(ACTION_TOOTHPASTE, dab_at(3 * n, 0, 0, 5)), STATUS_OK);
        sculpture_part(s.get());
        EXPECT_EQ(sculpture_facts(s.get()).put, static_cast<uint64_t>(n + 1));
        EXPECT_EQ(sculpture_facts(s.get()).kept_digest, clay_digest(&s->clay)) << "to the last dab";
    }
    sculpture_part(s.get());
    EXPECT_EQ(sculpture_facts(s.get()).put, 5u) << "nothing new is no record";
    ASSERT_EQ(sculpture_stroke_end(s.get()), STATUS_OK);
    const uint64_t digest = sculpture_digest(s.get());
    expect_whole();
    ASSERT_EQ(sculpture_undo(s.get()), STATUS_OK);
    EXPECT_EQ(s->clay.corners, 0u);
    ASSERT_EQ(sculpture_redo(s.get()), STATUS_OK);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    expect_whole();
}

TEST_F(sculpture_door, a_refused_surface_costs_the_stroke_what_it_did_since_its_last_part)
{
    open(true, 8);
    sculpture_stroke_begin(s.get());
    ASSERT_EQ(apply(ACTION_TOOTHPASTE, dab_at(4, 4, 4, 3, 3)), STATUS_OK);
    sculpture_part(s.get());
    const uint64_t digest = sculpture_digest(s.get()), mesh = surface_digest(&s->surface);
    ASSERT_EQ(apply(ACTION_PAINTER, dab_at(4, 4, 4, 3)), STATUS_OK);
    s->surface.patches.limit = 2;
    EXPECT_EQ(apply(ACTION_TOOTHPASTE, dab_at(7.5, 7.5, 7.5, 6, 3)), STATUS_POOL_FULL);
    s->surface.patches.limit = 16;
    EXPECT_FALSE(s->in_stroke);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    EXPECT_EQ(surface_digest(&s->surface), mesh);
    expect_whole();
    close();
    open(true, 8);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    ASSERT_EQ(sculpture_undo(s.get()), STATUS_OK);
    EXPECT_EQ(s->clay.corners, 0u);
}

TEST_F(sculpture_door, a_fork_is_gone_to_and_back)
{
    open(true);
    stroke(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 5));
    stroke(ACTION_TOOTHPASTE, dab_at(4, 0, 0, 5));
    const uint64_t older = sculpture_digest(s.get());
    ASSERT_EQ(sculpture_undo(s.get()), STATUS_OK);
    stroke(ACTION_TOOTHPASTE, dab_at(0, 4, 0, 5));
    const uint64_t newer = sculpture_digest(s.get());
    EXPECT_EQ(sculpture_facts(s.get()).branches, 2u);
    for (const uint64_t there : {older, newer, older}) {
        ASSERT_EQ(sculpture_step(s.get(), HISTORY_FORK, 0), STATUS_OK);
        EXPECT_EQ(sculpture_digest(s.get()), there);
        expect_whole();
    }
    ASSERT_EQ(sculpture_step(s.get(), HISTORY_TO, 0), STATUS_OK);
    EXPECT_EQ(s->clay.corners, 0u);
    EXPECT_EQ(sculpture_step(s.get(), HISTORY_TO, 77), STATUS_HISTORY_ENDS);
}

TEST_F(sculpture_door, field_and_surface_can_be_asked_for_apart)
{
    open(false);
    const tool t = make(ACTION_TOOTHPASTE);
    const sculpture_dab d = dab_at(0, 0, 0, 5, 3);
    sculpture_stroke_begin(s.get());
    ASSERT_EQ(sculpture_apply_field(s.get(), &t, &d, &counts.tool), STATUS_OK);
    EXPECT_EQ(s->surface.triangles, 0u);
    EXPECT_GT(dirt_count(&s->clay.dirty), 0u);
    ASSERT_EQ(sculpture_apply_surface(s.get(), &counts.surface), STATUS_OK);
    EXPECT_GT(counts.surface.triangles, 0u);
    expect_whole();
    ASSERT_EQ(sculpture_stroke_end(s.get()), STATUS_OK);
}

TEST_F(sculpture_door, comes_back_when_opened_again)
{
    open(true, 4000, 0.5);
    stroke(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 3, 3));
    const uint64_t first = sculpture_digest(s.get());
    stroke(ACTION_SOFT_PAINTER, dab_at(0, 0, 0, 3));
    const uint64_t second = sculpture_digest(s.get()), mesh = surface_digest(&s->surface), number = s->dab;
    close();
    open(true, 4000, 7); /* the store knows its own step */
    EXPECT_EQ(s->step_mm, 0.5);
    EXPECT_EQ(sculpture_digest(s.get()), second);
    EXPECT_EQ(surface_digest(&s->surface), mesh);
    EXPECT_EQ(s->dab, number) << "dithering goes on where it stood";
    ASSERT_EQ(sculpture_undo(s.get()), STATUS_OK);
    EXPECT_EQ(sculpture_digest(s.get()), first);
    expect_whole();
}

TEST_F(sculpture_door, closing_ends_the_stroke_under_way)
{
    open(true);
    sculpture_stroke_begin(s.get());
    ASSERT_EQ(apply(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 5)), STATUS_OK);
    const uint64_t digest = sculpture_digest(s.get());
    close();
    open(true);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    EXPECT_EQ(sculpture_undo(s.get()), STATUS_OK);
    EXPECT_EQ(s->clay.corners, 0u);
}

TEST_F(sculpture_door, clears_as_one_stroke)
{
    open(true);
    stroke(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 20));
    const uint64_t digest = sculpture_digest(s.get());
    ASSERT_EQ(sculpture_clear(s.get()), STATUS_OK);
    EXPECT_EQ(s->clay.corners, 0u);
    EXPECT_EQ(clay_brick_count(&s->clay), 0u);
    EXPECT_EQ(s->surface.triangles, 0u);
    ASSERT_EQ(sculpture_undo(s.get()), STATUS_OK);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    expect_whole();
}

TEST_F(sculpture_door, duplicates_into_a_tool)
{
    open(false);
    freeform f;
    EXPECT_EQ(sculpture_duplicate(s.get(), &f), STATUS_BAD_PARAMETER) << "nothing to make it of";
    stroke(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 5, 3));
    ASSERT_EQ(sculpture_duplicate(s.get(), &f), STATUS_OK);
    EXPECT_EQ(clay_digest(&f.copy), clay_digest(&s->clay));
    const tool t = {freeform_shape(&f), ACTION_TOOTHPASTE, 5, deform_default()};
    const sculpture_dab d = dab_at(20, 0, 0, 1);
    sculpture_stroke_begin(s.get());
    ASSERT_EQ(sculpture_apply(s.get(), &t, &d, &counts), STATUS_OK);
    EXPECT_GT(counts.tool.dirtied, 0u);
    ASSERT_EQ(sculpture_stroke_end(s.get()), STATUS_OK);
    expect_whole();
    freeform_finish(&f);
}

/* A native file in memory. */
struct paper {
    std::vector<uint8_t> bytes;
};

status put(void *self, const void *bytes, size_t n)
{
    paper *p = static_cast<paper *>(self);
    const uint8_t *b = static_cast<const uint8_t *>(bytes);
    p->bytes.insert(p->bytes.end(), b, b + n);
    return STATUS_OK;
}

status get(void *self, uint64_t offset, void *bytes, size_t n, size_t *got)
{
    const paper *p = static_cast<const paper *>(self);
    *got = offset >= p->bytes.size() ? 0 : std::min(n, p->bytes.size() - static_cast<size_t>(offset));
    std::memcpy(bytes, p->bytes.data() + std::min(static_cast<size_t>(offset), p->bytes.size()), *got);
    return STATUS_OK;
}

status write_out_of(sculpture *s, paper *p)
{
    still moment;
    status outcome = still_begin(&moment, s);
    if (outcome != STATUS_OK)
        return outcome;
    outcome = still_write(&moment, put, p);
    still_end(&moment);
    return outcome;
}

TEST_F(sculpture_door, writes_and_reads_the_whole_field)
{
    open(false, 4000, 0.5);
    stroke(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 5, 3));
    stroke(ACTION_SOFT_PAINTER, dab_at(3, 0, 0, 5));
    const uint64_t digest = sculpture_digest(s.get()), mesh = surface_digest(&s->surface);
    paper p;
    checkpoint_trouble trouble;
    ASSERT_EQ(write_out_of(s.get(), &p), STATUS_OK);
    close();
    open(false, 4000, 2);
    ASSERT_EQ(sculpture_read(s.get(), get, &p, &trouble), STATUS_OK) << "empty, without a history: it takes the step";
    EXPECT_EQ(s->step_mm, 0.5);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    EXPECT_EQ(surface_digest(&s->surface), mesh);
    expect_whole();
}

TEST_F(sculpture_door, reading_replaces_everything_as_one_stroke_or_nothing)
{
    open(false);
    stroke(ACTION_TOOTHPASTE, dab_at(30, 0, 0, 5, 3));
    const uint64_t other = sculpture_digest(s.get());
    paper p;
    checkpoint_trouble trouble;
    ASSERT_EQ(write_out_of(s.get(), &p), STATUS_OK);
    close();
    open(true);
    stroke(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 9, 3));
    const uint64_t digest = sculpture_digest(s.get());
    paper torn = p;
    torn.bytes[torn.bytes.size() / 2] ^= 1;
    EXPECT_EQ(sculpture_read(s.get(), get, &torn, &trouble), STATUS_CORRUPT);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    ASSERT_EQ(sculpture_read(s.get(), get, &p, &trouble), STATUS_OK);
    EXPECT_EQ(sculpture_digest(s.get()), other);
    expect_whole();
    ASSERT_EQ(sculpture_undo(s.get()), STATUS_OK);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    s->step_mm = 2; /* as if it had been made with another step */
    EXPECT_EQ(sculpture_read(s.get(), get, &p, &trouble), STATUS_BAD_PARAMETER);
    s->step_mm = 1;
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    expect_whole();
}

TEST_F(sculpture_door, reading_more_than_fits_changes_nothing)
{
    open(false);
    stroke(ACTION_TOOTHPASTE, dab_at(0, 0, 0, 20, 3));
    paper p;
    checkpoint_trouble trouble;
    ASSERT_EQ(write_out_of(s.get(), &p), STATUS_OK);
    close();
    open(true, 12);
    stroke(ACTION_TOOTHPASTE, dab_at(4, 4, 4, 4, 3));
    const uint64_t digest = sculpture_digest(s.get());
    EXPECT_EQ(sculpture_read(s.get(), get, &p, &trouble), STATUS_POOL_FULL);
    EXPECT_EQ(sculpture_digest(s.get()), digest);
    EXPECT_FALSE(s->in_stroke);
    expect_whole();
}

} // namespace
