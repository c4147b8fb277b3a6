/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the master test through the door. Whatever a person does with any tool, the surface they see is the surface of
 *       the clay they have, vertex for vertex; it is closed and faces outwards; undo is the piece before the stroke,
 *       redo the piece after it, and opening again finds it.
 * Method: seeded strokes of one to five dabs, every action, every shape (tools duplicated from the piece among them);
 *         after each dab the surface against one made from nothing; at intervals the treated cubes and the whole
 *         surface against counting corner by corner (mesh_oracle.h), the mesh, and the store. GLAISE_LONG: twenty
 *         times the strokes. */
#include "sculpture/sculpture.h"

#include "tests/property/mesh_oracle.h"
#include "tests/property/plain_clay.h"
#include "tests/unit/history/memory_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

namespace {

enum { BRICKS = 2500, RING = 12, REACH = 18 };
/* Branches that were left take room in it too. */
constexpr history_settings small_ring = {6 * RING, 1 << 16, 1 << 26, 1 << 24, 4};

struct studio {
    std::unique_ptr<sculpture> s = std::make_unique<sculpture>();
    memory_store disk;
    surface fresh = {};
    freeform form = {};
    bool has_form = false;
    ellipsoid ball = {};
    seeded chance;
    double step_mm = 1;
    bool at_newest = true; /* nothing to redo */
    uint64_t cut_triangles = 0, dabs = 0; /* so that a test of nothing is seen */
};

void studio_open(studio &x)
{
    history_finding finding;
    const byte_store store = x.disk.port();
    ASSERT_EQ(sculpture_open(x.s.get(), &store, BRICKS, &small_ring, x.step_mm, &finding), STATUS_OK) << finding.text;
    ASSERT_STREQ(finding.text, "");
}

void studio_finish(studio &x)
{
    EXPECT_EQ(sculpture_close(x.s.get()), STATUS_OK);
    EXPECT_EQ(x.disk.misuse, "");
    surface_finish(&x.fresh);
    if (x.has_form)
        freeform_finish(&x.form);
}

/* --- what is seen --- */

void expect_same_patch(const patch &a, const patch *b)
{
    ASSERT_NE(b, nullptr);
    ASSERT_EQ(a.vertex_count, b->vertex_count);
    ASSERT_EQ(a.triangle_count, b->triangle_count);
    ASSERT_EQ(std::memcmp(a.vertices, b->vertices, a.vertex_count * sizeof *a.vertices), 0);
    ASSERT_EQ(std::memcmp(a.triangles, b->triangles, a.triangle_count * sizeof *a.triangles), 0);
    ASSERT_EQ(std::memcmp(&a.crossing, &b->crossing, sizeof a.crossing), 0);
}

void expect_seen_is_clay(studio &x)
{
    surface &seen = x.s->surface;
    ASSERT_EQ(surface_rebuild(&x.fresh, &x.s->clay, nullptr), STATUS_OK);
    ASSERT_EQ(seen.patches.count, x.fresh.patches.count);
    for (uint32_t slot = 0; slot < surface_slots(&x.fresh); slot++) {
        const patch *p = surface_patch(&x.fresh, slot);
        if (!p)
            continue;
        ASSERT_NO_FATAL_FAILURE(expect_same_patch(*p, surface_find(&seen, p->at)));
    }
    ASSERT_EQ(seen.triangles, x.fresh.triangles);
    ASSERT_EQ(seen.vertices, x.fresh.vertices);
    ASSERT_EQ(seen.crossing, x.fresh.crossing);
    ASSERT_EQ(surface_digest(&seen), surface_digest(&x.fresh));
    ASSERT_EQ(dirt_count(&x.s->clay.dirty), 0u);
    x.cut_triangles += seen.triangles;
}

void expect_closed(studio &x)
{
    mesh m;
    ASSERT_EQ(mesh_init(&m, &x.s->surface), STATUS_OK);
    EXPECT_EQ(m.triangle_count, x.s->surface.triangles);
    EXPECT_TRUE(mesh_is_closed(&m));
    EXPECT_EQ(mesh_euler(&m) % 2, 0);
    if (m.triangle_count > 0) {
        EXPECT_GT(mesh_volume(&m), 0);
    }
    mesh_finish(&m);
    ASSERT_EQ(mesh_oracle_judge(&x.s->clay, &x.s->surface), "");
    ASSERT_TRUE(clay_is_valid(&x.s->clay));
}

/* --- what is done --- */

tool choose_tool(studio &x)
{
    static const action actions[] = {ACTION_TOOTHPASTE,   ACTION_SOFT_ERASER, ACTION_ERASER, ACTION_PAINTER,
                                     ACTION_SOFT_PAINTER, ACTION_SMOOTH,      ACTION_STAMP,  ACTION_PRINT};
    tool t = {};
    t.kind = actions[seeded_int(x.chance, 0, ACTION_COUNT - 1)];
    if (x.s->clay.corners < 4000 && seeded_chance(x.chance, 0.6))
        t.kind = ACTION_TOOTHPASTE;
    t.rgba = static_cast<uint32_t>(seeded_bits(x.chance));
    const double m = seeded_real(x.chance, 0.2, 0.8), r = seeded_real(x.chance, 0.2, 1.5 - m);
    EXPECT_EQ(deform_init(&t.def, 1.5, m, r, seeded_real(x.chance, 0, 1), seeded_real(x.chance, 0, 2)), STATUS_OK);
    if (x.has_form && seeded_chance(x.chance, 0.3)) {
        t.form = freeform_shape(&x.form);
        return t;
    }
    const ellipsoid_profile profile = seeded_chance(x.chance, 0.5) ? ELLIPSOID_WYVILL : ELLIPSOID_BOX;
    EXPECT_EQ(ellipsoid_init(&x.ball, profile, seeded_real(x.chance, 0.1, 1)), STATUS_OK);
    t.form = ellipsoid_shape(&x.ball);
    return t;
}

sculpture_dab choose_pose(studio &x, const tool &t)
{
    sculpture_dab d = {};
    double r[3][3];
    seeded_rotation(x.chance, r);
    const bool is_form = x.has_form && t.form.self == &x.form;
    for (int a = 0; a < 3; a++) {
        /* In steps: a form scaled to some ten of them, an ellipsoid of one to eight. */
        const double reach = is_form ? seeded_real(x.chance, 2, 6) / x.form.reach[a] : 0;
        const double length = x.step_mm * (is_form ? reach : std::exp(seeded_real(x.chance, 0, std::log(8.0))));
        d.at_world.origin[a] = x.step_mm * seeded_real(x.chance, -REACH, REACH);
        for (int c = 0; c < 3; c++)
            d.at_world.axis[a][c] = length * r[c][a];
    }
    d.rate = seeded_real(x.chance, 0, 8);
    d.seconds = seeded_real(x.chance, 0, 0.5);
    return d;
}

/* In halves, so that what was dirtied can be seen in between. */
void dab_counted(studio &x, const tool &t, const sculpture_dab &d)
{
    tool_counts counts;
    surface_counts seen;
    ASSERT_EQ(sculpture_apply_field(x.s.get(), &t, &d, &counts), STATUS_OK);
    std::vector<key> dirtied;
    for (uint32_t n = 0; n < dirt_count(&x.s->clay.dirty); n++) {
        const dirt_entry *e = dirt_at(&x.s->clay.dirty, n);
        for (int slot = 0; slot < BRICK_CORNERS; slot++)
            if (brick_mask_has(&e->corners, slot))
                dirtied.push_back(key_add(key_of_brick(e->at), slot >> 6, slot >> 3 & 7, slot & 7));
    }
    ASSERT_EQ(counts.dirtied, dirtied.size());
    ASSERT_EQ(sculpture_apply_surface(x.s.get(), &seen), STATUS_OK);
    ASSERT_EQ(seen.treated, mesh_oracle_cubes(dirtied).size());
    ASSERT_NO_FATAL_FAILURE(expect_closed(x));
}

void stroke(studio &x)
{
    const tool t = choose_tool(x);
    sculpture_dab d = choose_pose(x, t);
    sculpture_stroke_begin(x.s.get());
    for (int64_t n = seeded_int(x.chance, 1, 5); n > 0; n--, x.dabs++) {
        for (double &o : d.at_world.origin)
            o += x.step_mm * seeded_real(x.chance, -2, 2);
        SCOPED_TRACE(testing::Message() << action_name(t.kind) << ", dab " << x.s->dab);
        sculpture_counts counts;
        if (x.dabs % 40 == 0) {
            ASSERT_NO_FATAL_FAILURE(dab_counted(x, t, d));
        } else {
            ASSERT_EQ(sculpture_apply(x.s.get(), &t, &d, &counts), STATUS_OK);
            ASSERT_TRUE(counts.tool.visited >= counts.tool.computed && counts.tool.computed >= counts.tool.dirtied);
            ASSERT_GE(counts.surface.treated, counts.tool.dirtied);
            ASSERT_LE(counts.surface.treated, 8 * counts.tool.dirtied);
        }
        ASSERT_NO_FATAL_FAILURE(expect_seen_is_clay(x));
    }
    ASSERT_EQ(sculpture_stroke_end(x.s.get()), STATUS_OK);
}

struct state {
    uint64_t field, mesh;
};

state state_of(studio &x) { return {sculpture_digest(x.s.get()), surface_digest(&x.s->surface)}; }

void expect_state(studio &x, const state &wanted)
{
    ASSERT_EQ(sculpture_digest(x.s.get()), wanted.field);
    ASSERT_EQ(surface_digest(&x.s->surface), wanted.mesh);
    ASSERT_NO_FATAL_FAILURE(expect_seen_is_clay(x));
}

/* The last strokes, back and forth; `past` ends with the piece as it is. A stroke that changed nothing is not kept. */
void back_and_forth(studio &x, const std::vector<state> &past)
{
    const size_t steps = std::min<size_t>({past.size() - 1, RING, static_cast<size_t>(seeded_int(x.chance, 1, 4))});
    const size_t now = past.size() - 1;
    for (size_t n = 1; n <= steps; n++) {
        ASSERT_EQ(sculpture_undo(x.s.get()), STATUS_OK);
        ASSERT_NO_FATAL_FAILURE(expect_state(x, past[now - n]));
    }
    for (size_t n = steps; n-- > 0;) {
        ASSERT_EQ(sculpture_redo(x.s.get()), STATUS_OK);
        ASSERT_NO_FATAL_FAILURE(expect_state(x, past[now - n]));
    }
    if (x.at_newest) {
        ASSERT_EQ(sculpture_redo(x.s.get()), STATUS_HISTORY_ENDS);
    }
}

void sometimes(studio &x, std::vector<state> &past)
{
    if (seeded_chance(x.chance, 0.03)) { /* the piece, or what is left of it, becomes a tool */
        freeform made;
        const status s = sculpture_duplicate(x.s.get(), &made);
        ASSERT_TRUE(s == STATUS_OK || (s == STATUS_BAD_PARAMETER && x.s->clay.corners == 0));
        if (s == STATUS_OK) {
            if (x.has_form)
                freeform_finish(&x.form);
            x.form = made;
            x.has_form = true;
        }
    }
    if (seeded_chance(x.chance, 0.01)) {
        const state before = state_of(x);
        ASSERT_EQ(sculpture_close(x.s.get()), STATUS_OK);
        ASSERT_NO_FATAL_FAILURE(studio_open(x));
        ASSERT_NO_FATAL_FAILURE(expect_state(x, before));
    }
    if (x.s->clay.corners > 25000 || seeded_chance(x.chance, 0.005)) {
        const bool changes = x.s->clay.corners > 0;
        ASSERT_EQ(sculpture_clear(x.s.get()), STATUS_OK);
        ASSERT_EQ(x.s->clay.corners, 0u);
        if (changes)
            past.push_back(state_of(x));
        x.at_newest = x.at_newest || changes;
    }
    if (past.size() > 1 && seeded_chance(x.chance, 0.05)) { /* another future */
        ASSERT_EQ(sculpture_undo(x.s.get()), STATUS_OK);
        past.pop_back();
        x.at_newest = false;
        ASSERT_NO_FATAL_FAILURE(expect_state(x, past.back()));
    }
}

void session(uint64_t seed, double step_mm, int strokes)
{
    studio x;
    x.chance = {seed};
    x.step_mm = step_mm;
    ASSERT_EQ(surface_init(&x.fresh, 2 * BRICKS), STATUS_OK);
    ASSERT_NO_FATAL_FAILURE(studio_open(x));
    std::vector<state> past = {state_of(x)};
    for (int n = 0; n < strokes && !testing::Test::HasFatalFailure(); n++) {
        SCOPED_TRACE(testing::Message() << "stroke " << n);
        ASSERT_NO_FATAL_FAILURE(stroke(x));
        const state after = state_of(x);
        if (after.field != past.back().field) {
            past.push_back(after);
            x.at_newest = true;
        }
        if (past.size() > RING + 1) /* older ones the ring may have let go */
            past.erase(past.begin());
        if (past.size() > 1 && seeded_chance(x.chance, 0.4)) {
            ASSERT_NO_FATAL_FAILURE(back_and_forth(x, past));
        }
        ASSERT_NO_FATAL_FAILURE(sometimes(x, past));
        sculpture_attend(x.s.get());
        if (past.size() > RING + 1)
            past.erase(past.begin());
    }
    EXPECT_GT(x.cut_triangles / x.dabs, 300u) << "hardly any surface was seen";
    ASSERT_NO_FATAL_FAILURE(expect_closed(x));
    studio_finish(x);
}

TEST(stroke_property, the_surface_seen_is_that_of_the_clay)
{
    session(1, 1, seeded_steps(1000));
}

TEST(stroke_property, in_another_step_too)
{
    session(2, 0.37, seeded_steps(1000));
}

} // namespace
