/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: only patches whose generation changed are sent; what is gone is no longer drawn; after any sequence of changes
 *       the device holds what a fresh upload would.
 * Method: bytes sent are counted while balls of clay are added, touched and removed; pictures of a view that saw every
 *         step are compared with those of a view that saw only the end. Patches made by hand fill pages; what the
 *         device would draw of them is read back. Frames, budgets and fences: upload_frames_test.cpp. */
#include "upload_device.h"
#include "view_stage.h"

#include <algorithm>
#include <random>

namespace {

class view_upload : public view_stage {
  protected:
    /* A corner's potential is raised: the patches round it change. */
    static void touch(view_stage_piece *piece, key at)
    {
        uint32_t rgba;
        const float before = clay_read(&piece->it->clay, at, &rgba);
        ASSERT_EQ(clay_write(&piece->it->clay, at, before * 0.5f + 0.5f, view_stage_rgba(200, 40, 40)), STATUS_OK);
        piece->update();
    }

    static uint32_t patches(const view_stage_piece &piece)
    {
        uint32_t count = 0;
        for (uint32_t n = 0; n < surface_slots(&piece.it->surface); n++)
            count += surface_patch(&piece.it->surface, n) != nullptr;
        return count;
    }
};

TEST_F(view_upload, sends_what_changed_and_nothing_else)
{
    view_stage_piece piece;
    piece.ball({4, 4, 4}, 30, view_stage_rgba(180, 120, 90));
    update(piece);
    const view_counts first = view_count(it);
    EXPECT_EQ(first.patches, patches(piece));
    EXPECT_EQ(first.uploaded_patches, first.patches);
    EXPECT_GE(first.uploaded_bytes, piece.it->surface.vertices * 16 + piece.it->surface.triangles * 6);

    update(piece);
    EXPECT_EQ(view_count(it).uploaded_bytes, first.uploaded_bytes) << "nothing changed";

    const uint64_t before = piece.it->surface.generation;
    touch(&piece, {34, 4, 4});
    uint64_t changed = 0;
    for (uint32_t n = 0; n < surface_slots(&piece.it->surface); n++) {
        const patch *p = surface_patch(&piece.it->surface, n);
        changed += p && p->generation > before;
    }
    ASSERT_GT(changed, 0u);
    ASSERT_LT(changed, 9u);
    update(piece);
    EXPECT_EQ(view_count(it).uploaded_patches, first.uploaded_patches + changed);
    EXPECT_GT(view_count(it).uploaded_bytes, first.uploaded_bytes);
    EXPECT_LT(view_count(it).uploaded_bytes - first.uploaded_bytes, first.uploaded_bytes / 4);
}

TEST_F(view_upload, drawing_sends_nothing)
{
    view_stage_piece piece;
    piece.ball({0, 0, 0}, 12, view_stage_rgba(180, 120, 90));
    update(piece);
    const uint64_t sent = view_count(it).uploaded_bytes;
    draw(plain());
    draw(plain());
    EXPECT_EQ(view_count(it).uploaded_bytes, sent);
}

TEST_F(view_upload, what_is_gone_is_not_drawn)
{
    view_stage_piece piece;
    piece.ball({0, 0, 0}, 12, view_stage_rgba(180, 120, 90));
    update(piece);
    const snapshot s = plain();
    const view_stage_picture ground = draw_empty(s);
    EXPECT_GT(draw(s).changed(ground), 500);
    piece.empty();
    update(piece);
    EXPECT_EQ(view_count(it).patches, 0u);
    EXPECT_EQ(draw(s).apart(ground), 0);
}

TEST_F(view_upload, many_changes_end_as_a_fresh_upload)
{
    view_stage_piece piece;
    std::mt19937 random(7);
    auto within = [&](int lo, int hi) {
        return static_cast<int32_t>(lo + static_cast<int>(random() % static_cast<unsigned>(hi - lo + 1)));
    };
    const snapshot s = plain();
    for (int round = 0; round < 12; round++) {
        if (round == 6)
            piece.empty();
        piece.ball({within(-20, 20), within(-20, 20), within(-20, 20)}, within(4, 9),
                   view_stage_rgba(static_cast<unsigned>(within(60, 250)), 120, 90));
        for (int n = 0; n < 10; n++)
            touch(&piece, {within(-25, 25), within(-25, 25), within(-25, 25)});
        update(piece);
        EXPECT_EQ(view_count(it).patches, patches(piece));
        /* at edges on edge two layers may lie at one depth, and the order of patches decides */
        ASSERT_LE(draw(s).changed(draw_fresh(s, piece)), 12) << round;
    }
}

TEST_F(view_upload, another_sculpture_is_shown_after_forgetting)
{
    view_stage_piece first, second;
    first.ball({0, 0, 0}, 12, view_stage_rgba(180, 120, 90));
    second.ball({0, 0, 0}, 12, view_stage_rgba(40, 80, 220)); /* same slots, same generations */
    const snapshot s = plain();
    update(first);
    draw(s);
    view_forget(it);
    EXPECT_EQ(view_count(it).patches, 0u);
    update(second);
    EXPECT_EQ(draw(s).apart(draw_fresh(s, second)), 0);
}

TEST_F(view_upload, a_surface_whose_generations_fell_back_is_another)
{
    view_stage_piece first, second;
    first.ball({0, 0, 0}, 12, view_stage_rgba(180, 120, 90));
    for (int n = 0; n < 5; n++)
        touch(&first, {12, 0, n});
    second.ball({0, 0, 0}, 12, view_stage_rgba(40, 80, 220));
    ASSERT_LT(second.it->surface.generation, first.it->surface.generation);
    update(first);
    update(second);
    const snapshot s = plain();
    EXPECT_EQ(draw(s).apart(draw_fresh(s, second)), 0);
}

TEST_F(view_upload, a_full_page_is_followed_by_another)
{
    const uint32_t count = BERTH_UNITS / 2 + 10;
    upload_device_surface s(count, PACKED_UNIT_VERTICES * 2); /* two units each */
    upload u;
    upload_init(&u, false);
    ASSERT_TRUE(upload_update(&u, &s.it, UPLOAD_ALL, &trouble)) << trouble;
    EXPECT_EQ(u.pages.size(), 2u);
    EXPECT_EQ(u.pages[0].units.top, BERTH_UNITS);
    EXPECT_EQ(u.pages[1].units.top, 20);
    EXPECT_EQ(u.counts.held, count);
    EXPECT_EQ(upload_device_draw(upload_device_calls(u)), upload_device_expected(s.it));
    EXPECT_EQ(upload_device_calls(u).size(), 2u) << "a call a page";

    /* room that comes free in a page that was full is found again */
    for (uint32_t n = 0; n < 10; n++)
        s.remove(n);
    ASSERT_TRUE(upload_update(&u, &s.it, UPLOAD_ALL, &trouble)) << trouble;
    EXPECT_EQ(u.counts.held, count - 10);
    EXPECT_EQ(upload_device_draw(upload_device_calls(u)), upload_device_expected(s.it));
    for (uint32_t n = 0; n < 10; n++)
        s.change(n, PACKED_UNIT_VERTICES * 2);
    ASSERT_TRUE(upload_update(&u, &s.it, UPLOAD_ALL, &trouble)) << trouble;
    for (uint32_t n = 0; n < 10; n++) {
        EXPECT_EQ(u.slots[n].shown.page, 0u);
        EXPECT_LT(u.slots[n].shown.first, 20);
    }
    EXPECT_EQ(u.pages[1].units.top, 20);
    EXPECT_EQ(upload_device_draw(upload_device_calls(u)), upload_device_expected(s.it));
    upload_finish(&u);
}

TEST_F(view_upload, freed_units_are_used_again)
{
    const uint32_t count = 300;
    upload_device_surface s(count, 3);
    upload u;
    upload_init(&u, true);
    std::mt19937 random(11);
    for (int round = 0; round < 60; round++) {
        for (uint32_t n = 0; n < count; n++)
            if (random() % 4 == 0)
                s.change(n, 3 + random() % 158); /* one to five units: 900 of 2,048 at the mean */
        ASSERT_TRUE(upload_update(&u, &s.it, UPLOAD_ALL, &trouble)) << trouble;
        ASSERT_EQ(u.counts.held, count);
        ASSERT_EQ(upload_device_draw(upload_device_calls(u)), upload_device_expected(s.it)) << round;
    }
    EXPECT_EQ(u.pages.size(), 1u);
    for (uint32_t n = 0; n < count; n++)
        s.remove(n);
    ASSERT_TRUE(upload_update(&u, &s.it, UPLOAD_ALL, &trouble)) << trouble;
    EXPECT_EQ(u.counts.held, 0u);
    ASSERT_TRUE(upload_update(&u, &s.it, UPLOAD_ALL, &trouble)) << trouble;
    EXPECT_EQ(u.pages[0].units.count, 0);
    EXPECT_EQ(u.pages[0].units.top, 0);
    EXPECT_TRUE(upload_device_calls(u).empty());
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    upload_finish(&u);
}

/* The order of vertices within a patch is the patch's own affair. */
void turn_vertices_round(patch *p)
{
    std::reverse(p->vertices, p->vertices + p->vertex_count);
    for (uint32_t t = 0; t < p->triangle_count; t++)
        for (uint16_t &v : p->triangles[t])
            v = static_cast<uint16_t>(p->vertex_count - 1 - v);
}

/* Lines are blended: a side drawn twice would show. */
TEST_F(view_upload, a_freeforms_sides_are_each_drawn_once)
{
    view_stage_piece piece;
    piece.ball({4, 4, 4}, 12, view_stage_rgba(255, 255, 255));
    for (uint32_t n = 0; n < surface_slots(&piece.it->surface); n += 2)
        turn_vertices_round(static_cast<patch *>(pool_at(&piece.it->surface.patches, n)));
    upload u;
    upload_init(&u, true);
    ASSERT_TRUE(upload_update(&u, &piece.it->surface, UPLOAD_ALL, &trouble)) << trouble;
    size_t lines = 0;
    for (const page &p : u.pages) {
        const size_t bytes = static_cast<size_t>(p.drawn) * PACKED_LINE_BYTES;
        glBindBuffer(GL_COPY_READ_BUFFER, p.buffers[2]);
        const auto *index = static_cast<const uint16_t *>(
            glMapBufferRange(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(bytes), GL_MAP_READ_BIT));
        ASSERT_NE(index, nullptr);
        for (size_t n = 0; n < bytes / sizeof(uint16_t); n += 2)
            lines += index[n] != index[n + 1];
        glUnmapBuffer(GL_COPY_READ_BUFFER);
    }
    EXPECT_EQ(lines, piece.it->surface.triangles * 3 / 2) << "a closed surface has three sides for two triangles";
    upload_finish(&u);
}

} // namespace
