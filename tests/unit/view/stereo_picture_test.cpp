/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the finished picture: every pixel comes from its own eye and its own place in it, unmixed, in every layout,
 *       both orders, odd sizes and parts; what no eye has is black; anaglyph mixes as the published matrix says; and
 *       what is drawn through the eyes' projections lies where stereo demands.
 * Method: textures whose every texel has a colour of its own, composed and read back, against a loop over pixels that
 *         knows layouts by heart; anaglyph against products worked out by hand; bars drawn at known depths. */
#include "view/canvas.h"
#include "view/program.h"
#include "view/stereo.h"
#include "view_stage.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace {

using rgb = std::array<int, 3>;

class stereo_picture : public view_stage {
  protected:
    stereo composer;
    std::vector<GLuint> textures;

    void SetUp() override
    {
        view_stage::SetUp();
        ASSERT_TRUE(stereo_open(&composer, &trouble)) << trouble;
    }
    void TearDown() override
    {
        stereo_close(&composer);
        glDeleteTextures(static_cast<GLsizei>(textures.size()), textures.data());
        view_stage::TearDown();
    }

    /* of: colour of the texel x, y from the top left */
    template <class colour_of> GLuint texture(int w, int h, const colour_of &of)
    {
        if (w == 0 || h == 0)
            return 0;
        std::vector<uint8_t> bytes;
        for (int y = h - 1; y >= 0; y--) {
            for (int x = 0; x < w; x++) {
                const rgb c = of(x, y);
                for (int channel : c)
                    bytes.push_back(static_cast<uint8_t>(channel));
                bytes.push_back(255);
            }
        }
        GLuint name = 0;
        glGenTextures(1, &name);
        textures.push_back(name);
        glBindTexture(GL_TEXTURE_2D, name);
        glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, w, h);
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, w, h, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR); /* as a canvas's */
        glBindTexture(GL_TEXTURE_2D, 0);
        return name;
    }

    view_stage_picture compose(const stereo_screen &whole, const projection_part &part, GLuint left, GLuint right)
    {
        canvas_target target;
        view_stage_picture p{part.width, part.height, {}};
        EXPECT_TRUE(canvas_target_size(&target, part.width, part.height, &trouble)) << trouble;
        glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
        glClearColor(1, 0, 1, 1); /* whatever is left of this is wrong */
        glClear(GL_COLOR_BUFFER_BIT);
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, 0, 1, 1);
        stereo_compose(composer, whole, part, left, right);
        EXPECT_TRUE(canvas_read(target, &p.rgba, &trouble)) << trouble;
        canvas_target_close(&target);
        return p;
    }

    /* Textures that say for every texel of an eye's whole picture whose it is and which. */
    static rgb mark(stereo_eye eye, int x, int y)
    {
        return {eye == STEREO_LEFT ? 255 : 20, 40 + 4 * (x % 50), 30 + 4 * (y % 50)};
    }
    view_stage_picture compose_marked(const stereo_screen &whole, const projection_part &part)
    {
        std::array<GLuint, 2> eyes{};
        for (stereo_eye eye : {STEREO_LEFT, STEREO_RIGHT}) {
            const projection_part of = stereo_share_of(whole, eye, part).of_eye;
            eyes[eye] = texture(of.width, of.height, [&](int x, int y) { return mark(eye, of.x + x, of.y + y); });
        }
        return compose(whole, part, eyes[STEREO_LEFT], eyes[STEREO_RIGHT]);
    }
};

/* What the pixel x, y of the finished picture must be: layouts by heart, w and h of the whole. */
struct wanted {
    bool black;
    bool second;
    int x, y; /* in the eye's picture */
};

wanted want(const stereo_screen &s, int x, int y)
{
    const int half_w = s.width / 2, half_h = s.height / 2, packed_h = (s.height - s.gap) / 2;
    switch (s.layout) {
    case SNAPSHOT_LAYOUT_SIDE_HALF:
    case SNAPSHOT_LAYOUT_SIDE_FULL: return {x >= 2 * half_w, x >= half_w, x % half_w, y};
    case SNAPSHOT_LAYOUT_TOP_HALF:
    case SNAPSHOT_LAYOUT_TOP_FULL: return {y >= 2 * half_h, y >= half_h, x, y % half_h};
    case SNAPSHOT_LAYOUT_ROWS: return {false, y % 2 == 1, x, y};
    case SNAPSHOT_LAYOUT_COLUMNS: return {false, x % 2 == 1, x, y};
    case SNAPSHOT_LAYOUT_CHECKER: return {false, (x % 2 == 1) != (y % 2 == 1), x, y};
    case SNAPSHOT_LAYOUT_PACKED:
        if (y < packed_h)
            return {false, false, x, y};
        return {y < packed_h + s.gap, true, x, y - packed_h - s.gap};
    default: return {false, false, x, y};
    }
}

constexpr snapshot_layout unmixed[] = {SNAPSHOT_LAYOUT_MONO,     SNAPSHOT_LAYOUT_SIDE_HALF, SNAPSHOT_LAYOUT_SIDE_FULL,
                                       SNAPSHOT_LAYOUT_TOP_HALF, SNAPSHOT_LAYOUT_TOP_FULL,  SNAPSHOT_LAYOUT_ROWS,
                                       SNAPSHOT_LAYOUT_COLUMNS,  SNAPSHOT_LAYOUT_CHECKER,   SNAPSHOT_LAYOUT_PACKED};

/* The first pixel that is not what it must be, in words; empty when all are right. */
std::string wrong_pixel(const view_stage_picture &got, const stereo_screen &whole, const projection_part &part,
                        const std::function<rgb(stereo_eye, int, int)> &colour_of)
{
    for (int y = 0; y < part.height; y++) {
        for (int x = 0; x < part.width; x++) {
            const wanted w = want(whole, part.x + x, part.y + y);
            const bool right = w.second != (whole.swapped && whole.layout != SNAPSHOT_LAYOUT_MONO);
            const rgb c = w.black ? rgb{0, 0, 0} : colour_of(right ? STEREO_RIGHT : STEREO_LEFT, w.x, w.y);
            for (int n = 0; n < 4; n++) {
                const int must = n < 3 ? c[static_cast<size_t>(n)] : 255;
                if (std::abs(got.byte(x, y, n) - must) > (must == 0 ? 0 : 1))
                    return "pixel " + std::to_string(x) + ", " + std::to_string(y) + ", channel " + std::to_string(n) +
                           ": " + std::to_string(got.byte(x, y, n)) + ", not " + std::to_string(must);
            }
        }
    }
    return "";
}

TEST_F(stereo_picture, every_pixel_is_its_own_eyes_in_every_layout_part_and_order)
{
    const projection_part parts[] = {{0, 0, 46, 33}, {0, 0, 9, 7},   {1, 0, 8, 8},     {0, 1, 8, 8},
                                     {3, 5, 20, 11}, {19, 11, 9, 13}, {21, 14, 25, 19}, {45, 32, 1, 1}};
    for (snapshot_layout layout : unmixed)
        for (bool swapped : {false, true})
            for (const projection_part &part : parts)
                for (int odd : {0, 1}) { /* a whole of 46 x 33, or 47 x 34 */
                    const stereo_screen whole = {layout, swapped, 46 + odd, 33 + odd,
                                                 layout == SNAPSHOT_LAYOUT_PACKED ? 5 + 3 * odd : 0};
                    ASSERT_EQ(stereo_trouble({}, whole), "");
                    ASSERT_EQ(wrong_pixel(compose_marked(whole, part), whole, part, mark), "")
                        << "layout " << layout << (swapped ? ", swapped" : "") << ", part at " << part.x << ", "
                        << part.y << (odd ? ", odd" : "");
                }
}

TEST_F(stereo_picture, pure_eyes_stay_pure)
{
    const auto red = [](int, int) { return rgb{255, 0, 0}; };
    const auto blue = [](int, int) { return rgb{0, 0, 255}; };
    for (snapshot_layout layout : {SNAPSHOT_LAYOUT_ROWS, SNAPSHOT_LAYOUT_COLUMNS, SNAPSHOT_LAYOUT_CHECKER}) {
        const stereo_screen whole = {layout, false, 31, 17, 0};
        const view_stage_picture got =
            compose(whole, {0, 0, 31, 17}, texture(31, 17, red), texture(31, 17, blue));
        int reds = 0, blues = 0;
        for (int y = 0; y < 17; y++) {
            for (int x = 0; x < 31; x++) {
                reds += got.byte(x, y, 0) == 255 && got.byte(x, y, 2) == 0;
                blues += got.byte(x, y, 0) == 0 && got.byte(x, y, 2) == 255;
            }
        }
        EXPECT_EQ(reds + blues, 31 * 17) << "layout " << layout;
        EXPECT_EQ(got.byte(0, 0, 0), 255) << "the first eye has the top left";
        const int rows = 9 * 31, columns = 16 * 17, squares = (31 * 17 + 1) / 2; /* the odd one is the first's */
        EXPECT_EQ(reds, layout == SNAPSHOT_LAYOUT_ROWS ? rows : layout == SNAPSHOT_LAYOUT_COLUMNS ? columns : squares);
    }
}

TEST_F(stereo_picture, leaves_nothing_bound)
{
    compose_marked({SNAPSHOT_LAYOUT_ROWS, false, 8, 8, 0}, {0, 0, 8, 8});
    for (GLenum what : {GL_CURRENT_PROGRAM, GL_VERTEX_ARRAY_BINDING, GL_TEXTURE_BINDING_2D}) {
        GLint bound = -1;
        glGetIntegerv(what, &bound);
        EXPECT_EQ(bound, 0) << what;
    }
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

/* --- anaglyph --- */

double encoded(double light)
{
    light = std::clamp(light, 0.0, 1.0);
    return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

/* Products by hand of Dubois's red-cyan matrix for LCD screens with light 1 or 0.2140 (byte 127.5; 127: 0.2122). */
TEST_F(stereo_picture, anaglyph_mixes_light_as_published)
{
    struct row {
        rgb left, right;
        std::array<double, 3> light;
        const char *what;
    };
    const row rows[] = {
        {{255, 255, 255}, {255, 255, 255}, {1.000, 0.999, 1.000}, "white is white"},
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, "black is black"},
        {{255, 255, 255}, {0, 0, 0}, {1.050, 0, 0}, "the left eye's white is red"},
        {{0, 0, 0}, {255, 255, 255}, {0, 1.147, 1.115}, "the right eye's is cyan"},
        {{255, 0, 0}, {0, 0, 0}, {0.437, 0, 0}, "left red"},
        {{0, 255, 0}, {0, 0, 0}, {0.449, 0, 0}, "left green"},
        {{0, 0, 255}, {0, 0, 0}, {0.164, 0, 0}, "left blue"},
        {{0, 0, 0}, {255, 0, 0}, {0, 0.377, 0}, "right red"},
        {{0, 0, 0}, {0, 255, 0}, {0, 0.761, 0}, "right green"},
        {{0, 0, 0}, {0, 0, 255}, {0, 0.009, 1.234}, "right blue"},
        {{255, 0, 0}, {255, 255, 255}, {0.387, 1.085, 1.067}, "left red takes its leak from green and blue"},
        {{0, 0, 0}, {0, 255, 255}, {0, 0.770, 1.141}, "right cyan"},
        {{127, 127, 127}, {127, 127, 127}, {0.2122, 0.2120, 0.2122}, "grey is grey: it is light that is mixed"},
        {{127, 127, 127}, {0, 0, 0}, {0.2228, 0, 0}, "half the byte is a fifth of the light"},
        {{0, 0, 0}, {127, 0, 0}, {0, 0.0800, 0}, "0.377 x 0.2122"},
    };
    const stereo_screen whole = {SNAPSHOT_LAYOUT_ANAGLYPH, false, 3, 3, 0};
    stereo_screen turned = whole;
    turned.swapped = true;
    for (const row &r : rows) {
        const GLuint left = texture(3, 3, [&](int, int) { return r.left; });
        const GLuint right = texture(3, 3, [&](int, int) { return r.right; });
        const view_stage_picture got = compose(whole, {0, 0, 3, 3}, left, right);
        const view_stage_picture other = compose(turned, {0, 0, 3, 3}, right, left);
        for (int channel = 0; channel < 3; channel++)
            EXPECT_NEAR(got.byte(1, 1, channel), encoded(r.light[static_cast<size_t>(channel)]), 1)
                << r.what << ", channel " << channel;
        EXPECT_EQ(got.apart(other), 0) << "swapped: red for the right eye";
    }
}

TEST_F(stereo_picture, anaglyph_mixes_the_same_place_of_both_eyes)
{
    const stereo_screen whole = {SNAPSHOT_LAYOUT_ANAGLYPH, false, 9, 7, 0};
    const projection_part part = {2, 3, 6, 4};
    const auto spot = [](int at_x, int at_y) {
        return [=](int x, int y) { return x == at_x && y == at_y ? rgb{255, 255, 255} : rgb{0, 0, 0}; };
    };
    const view_stage_picture got = compose(whole, part, texture(6, 4, spot(1, 0)), texture(6, 4, spot(4, 3)));
    for (int y = 0; y < 4; y++) {
        for (int x = 0; x < 6; x++) {
            EXPECT_EQ(got.byte(x, y, 0) > 200, x == 1 && y == 0) << x << ", " << y;
            EXPECT_EQ(got.byte(x, y, 1) > 200, x == 4 && y == 3) << x << ", " << y;
        }
    }
}

/* --- drawn through the eyes --- */

constexpr char bar_vertex[] = R"(
uniform mat4 u_clip_from_world;
uniform vec4 u_bar; /* x, half width, half height, z in the world */
void main()
{
    vec2 corner = vec2((gl_VertexID & 1) == 0 ? -1.0 : 1.0, (gl_VertexID & 2) == 0 ? -1.0 : 1.0);
    gl_Position = u_clip_from_world * vec4(u_bar.x + corner.x * u_bar.y, corner.y * u_bar.z, u_bar.w, 1.0);
}
)";
constexpr char bar_fragment[] = R"(
layout(location = 0) out vec4 f_colour;
void main() { f_colour = vec4(1.0); }
)";

/* The eyes' canvases with an upright white bar on black. */
class stereo_bar : public stereo_picture {
  protected:
    static constexpr double plane = 200;
    GLuint program = 0, array = 0;
    snapshot s;

    void SetUp() override
    {
        stereo_picture::SetUp();
        ASSERT_TRUE(program_open("bar", {bar_vertex}, {bar_fragment}, &program, &trouble)) << trouble;
        glGenVertexArrays(1, &array);
        s.camera_distance = 200;
    }
    void TearDown() override
    {
        program_close(program);
        glDeleteVertexArrays(1, &array);
        stereo_picture::TearDown();
    }

    void draw_bar(const canvas &c, const canvas_target &into, const stereo_seen &seen, double x, double z)
    {
        canvas_begin(c);
        glClearColor(0, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_BLEND);
        glUseProgram(program);
        const glm::mat4 clip(seen.seen.clip_from_eye * seen.seen.eye_from_world);
        glUniformMatrix4fv(program_uniform(program, "u_clip_from_world"), 1, GL_FALSE, glm::value_ptr(clip));
        glUniform4f(program_uniform(program, "u_bar"), static_cast<float>(x), 2.0f, 9.0f, static_cast<float>(z));
        glBindVertexArray(array);
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        glBindVertexArray(0);
        glUseProgram(0);
        canvas_end(c, into);
    }

    view_stage_picture finished(const stereo_screen &whole, double x, double z, bool mirrored = false)
    {
        return finished_part(whole, {0, 0, whole.width, whole.height}, x, z, mirrored);
    }
    view_stage_picture finished_part(const stereo_screen &whole, const projection_part &part, double x, double z,
                                     bool mirrored = false)
    {
        const stereo_size looks = stereo_shape(whole), size = stereo_eye_size(whole);
        projection mono = projection_make(s, looks.width, looks.height, {{{0, 0, -200}, 100}});
        if (mirrored)
            mono.clip_from_eye[0][0] = -mono.clip_from_eye[0][0];
        canvas drawn;
        std::array<canvas_target, 2> eyes;
        for (stereo_eye eye : {STEREO_LEFT, STEREO_RIGHT}) {
            const projection_part of = stereo_share_of(whole, eye, part).of_eye;
            if (of.width == 0)
                continue;
            EXPECT_TRUE(canvas_size(&drawn, of.width, of.height, CANVAS_SAMPLES, &trouble)) << trouble;
            EXPECT_TRUE(canvas_target_size(&eyes[eye], of.width, of.height, &trouble)) << trouble;
            const projection own = projection_of_part(mono, size.width, size.height, of);
            draw_bar(drawn, eyes[eye], stereo_see(own, plane, 8, eye), x, z);
        }
        const view_stage_picture p = compose(whole, part, eyes[STEREO_LEFT].texture, eyes[STEREO_RIGHT].texture);
        canvas_close(&drawn);
        for (canvas_target &t : eyes)
            canvas_target_close(&t);
        return p;
    }

    /* Mean column of the light between two columns, counted from the first of them. */
    static double column(const view_stage_picture &p, int from, int to)
    {
        double sum = 0, weighted = 0;
        for (int y = 0; y < p.height; y++) {
            for (int x = from; x < to; x++) {
                sum += p.linear(x, y, 1);
                weighted += p.linear(x, y, 1) * (x + 0.5 - from);
            }
        }
        EXPECT_GT(sum, 1);
        return weighted / sum;
    }
    /* Rows of the bar's middle: all that differs down a column that lies wholly in the bar. */
    static std::vector<int> rows(const view_stage_picture &p, int from, int to)
    {
        const int middle = from + static_cast<int>(column(p, from, to));
        std::vector<int> light;
        for (int y = 0; y < p.height; y++)
            light.push_back(p.byte(middle, y, 1));
        return light;
    }
};

TEST_F(stereo_bar, on_the_plane_both_eyes_draw_the_same_pixels)
{
    for (snapshot_layout layout : {SNAPSHOT_LAYOUT_SIDE_HALF, SNAPSHOT_LAYOUT_SIDE_FULL}) {
        const stereo_screen whole = {layout, false, 640, 240, 0};
        for (double x : {-35.0, 0.0, 21.0}) {
            const view_stage_picture p = finished(whole, x, 200 - plane);
            for (int j = 0; j < 240; j++)
                for (int i = 0; i < 320; i++)
                    ASSERT_NEAR(p.byte(i, j, 1), p.byte(320 + i, j, 1), 2) << "column " << i << ", row " << j;
            EXPECT_GT(column(p, 0, 320), 0);
        }
    }
}

TEST_F(stereo_bar, before_the_plane_is_crossed_behind_it_is_not_by_as_much_as_geometry_says)
{
    for (bool mirrored : {false, true}) {
        for (snapshot_layout layout : {SNAPSHOT_LAYOUT_SIDE_HALF, SNAPSHOT_LAYOUT_SIDE_FULL}) {
            const stereo_screen whole = {layout, false, 640, 240, 0};
            for (double z : {60.0, -80.0}) {
                const view_stage_picture p = finished(whole, 5, z, mirrored);
                const double aspect = layout == SNAPSHOT_LAYOUT_SIDE_HALF ? 640.0 / 240 : 320.0 / 240;
                const double wide_mm = 2 * plane * std::tan(s.field_of_view / 2) * aspect; /* what is seen of it */
                const double depth = 200 - z, crossed_mm = 8 * (plane - depth) / depth;    /* similar triangles */
                /* four samples a pixel: each of the four sides is known to an eighth, of which half is in a mean */
                EXPECT_NEAR(column(p, 0, 320) - column(p, 320, 640), crossed_mm / wide_mm * 320, 0.25)
                    << "z " << z << (mirrored ? " mirrored" : "");
                EXPECT_EQ(rows(p, 0, 320), rows(p, 320, 640)) << "nothing is higher in one eye";
            }
        }
    }
}

TEST_F(stereo_bar, parts_meet_without_a_seam)
{
    for (snapshot_layout layout : {SNAPSHOT_LAYOUT_SIDE_HALF, SNAPSHOT_LAYOUT_TOP_HALF, SNAPSHOT_LAYOUT_PACKED,
                                   SNAPSHOT_LAYOUT_CHECKER, SNAPSHOT_LAYOUT_ANAGLYPH}) {
        const stereo_screen whole = {layout, false, 151, 103, layout == SNAPSHOT_LAYOUT_PACKED ? 3 : 0};
        const view_stage_picture all = finished(whole, 1, 70);
        int lit = 0;
        for (int top = 0; top < 103; top += 37) {
            for (int left = 0; left < 151; left += 63) {
                const projection_part part = {left, top, std::min(63, 151 - left), std::min(37, 103 - top)};
                const view_stage_picture some = finished_part(whole, part, 1, 70);
                for (int y = 0; y < part.height; y++) {
                    for (int x = 0; x < part.width; x++) {
                        /* at the bar's sides one sample of four may fall otherwise */
                        ASSERT_NEAR(some.light(x, y), all.light(left + x, top + y), 0.26)
                            << "layout " << layout << ", part at " << left << ", " << top << ", " << x << ", " << y;
                        lit += some.light(x, y) > 0.15; /* red alone is 0.21 */
                    }
                }
            }
        }
        EXPECT_GT(lit, 80) << "layout " << layout;
    }
}

TEST_F(stereo_bar, swapped_changes_the_sides)
{
    const view_stage_picture p = finished({SNAPSHOT_LAYOUT_SIDE_FULL, true, 640, 240, 0}, 5, 60);
    EXPECT_LT(column(p, 0, 320), column(p, 320, 640) - 1) << "before the plane, the right eye's picture on the left";
}

} // namespace
