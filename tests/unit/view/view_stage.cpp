/* SPDX-License-Identifier: Apache-2.0 */
#include "view_stage.h"

#include <cstring>

view_stage_piece::view_stage_piece() : it(std::make_unique<sculpture>())
{
    std::memset(static_cast<void *>(it.get()), 0, sizeof *it);
    it->step_mm = 1;
    EXPECT_EQ(clay_init(&it->clay, 20000), STATUS_OK);
    EXPECT_EQ(surface_init(&it->surface, 40000), STATUS_OK);
}

view_stage_piece::~view_stage_piece()
{
    surface_finish(&it->surface);
    clay_finish(&it->clay);
}

void view_stage_piece::ball(key middle, double radius, uint32_t rgba)
{
    const int reach = static_cast<int>(std::ceil(radius)) + 3;
    for (int i = -reach; i <= reach; i++) {
        for (int j = -reach; j <= reach; j++) {
            for (int k = -reach; k <= reach; k++) {
                const key at = key_add(middle, i, j, k);
                const double away = std::sqrt(double{1} * i * i + double{1} * j * j + double{1} * k * k);
                const float potential = static_cast<float>(POTENTIAL_ISO + 0.6 * (radius - away));
                if (potential > clay_read(&it->clay, at, nullptr)) {
                    ASSERT_EQ(clay_write(&it->clay, at, potential, rgba), STATUS_OK);
                }
            }
        }
    }
    update();
}

void view_stage_piece::empty()
{
    const box all = clay_box(&it->clay);
    for (int32_t i = all.min.i; i <= all.max.i; i++)
        for (int32_t j = all.min.j; j <= all.max.j; j++)
            for (int32_t k = all.min.k; k <= all.max.k; k++)
                ASSERT_EQ(clay_write(&it->clay, {i, j, k}, 0, COLOUR_NONE), STATUS_OK);
    update();
}

void view_stage_piece::update()
{
    surface_counts counts;
    ASSERT_EQ(surface_update(&it->surface, &it->clay, &counts), STATUS_OK);
    dirt_clear(&it->clay.dirty);
}

void view_stage::SetUp()
{
    display_trouble missing;
    screen = display_open(DISPLAY_HEADLESS, &missing);
    ASSERT_NE(screen, nullptr) << missing.text;
    ASSERT_TRUE(display_make_current(screen, &missing)) << missing.text;
    it = view_open(&trouble);
    ASSERT_NE(it, nullptr) << trouble;
}

void view_stage::TearDown()
{
    view_close(it);
    display_close(screen);
}

view_stage_picture view_stage::draw(const snapshot &s, int w, int h)
{
    view_stage_picture p{w, h, {}};
    EXPECT_TRUE(view_draw(it, s, w, h, &trouble)) << trouble;
    EXPECT_TRUE(view_pixels(it, &p.rgba, &trouble)) << trouble;
    p.rgba.resize(static_cast<size_t>(w) * static_cast<size_t>(h) * 4);
    return p;
}

void view_stage::update(const view_stage_piece &piece)
{
    ASSERT_TRUE(view_update(it, piece.it.get(), &trouble)) << trouble;
}

view_stage_picture view_stage::draw_empty(const snapshot &s)
{
    view_stage_piece nothing;
    return draw_fresh(s, nothing);
}

view_stage_picture view_stage::draw_fresh(const snapshot &s, const view_stage_piece &piece)
{
    view *used = it;
    it = view_open(&trouble);
    EXPECT_NE(it, nullptr) << trouble;
    update(piece);
    view_stage_picture p = draw(s);
    view_close(it);
    it = used;
    return p;
}

snapshot_light view_stage::light_at(double x, double y, double z)
{
    snapshot_light light;
    light.lit = true;
    light.position = {x, y, z};
    return light;
}

snapshot view_stage::plain()
{
    snapshot s;
    s.camera_distance = 150;
    s.field_of_view = 0.5;
    s.tool_style = SNAPSHOT_TOOL_HIDDEN;
    s.box_shown = false;
    s.lights_shown = false;
    s.lights[0] = light_at(-100, 120, 200);
    return s;
}

snapshot view_stage::ambient()
{
    snapshot s = plain();
    s.lights = {};
    s.material.specular = 0;
    s.material.ambient = 0.4f;
    return s;
}
