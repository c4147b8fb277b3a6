/* SPDX-License-Identifier: Apache-2.0 */
#include "view/stereo.h"

#include "view/program.h"
#include "view/screen_shader.h"
#include "view/stereo_shader.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace {

enum way { WAY_APART, WAY_ROWS, WAY_COLUMNS, WAY_CHECKER, WAY_ANAGLYPH }; /* as in stereo_shader.h */

way way_of(snapshot_layout layout)
{
    switch (layout) {
    case SNAPSHOT_LAYOUT_ROWS: return WAY_ROWS;
    case SNAPSHOT_LAYOUT_COLUMNS: return WAY_COLUMNS;
    case SNAPSHOT_LAYOUT_CHECKER: return WAY_CHECKER;
    case SNAPSHOT_LAYOUT_ANAGLYPH: return WAY_ANAGLYPH;
    default: return WAY_APART;
    }
}

/* How many eyes' pictures lie beside each other, and above each other. */
struct arrangement {
    int across, down;
    bool half; /* each is shown as large as the finished picture */
};

arrangement arrangement_of(snapshot_layout layout)
{
    switch (layout) {
    case SNAPSHOT_LAYOUT_SIDE_HALF: return {2, 1, true};
    case SNAPSHOT_LAYOUT_SIDE_FULL: return {2, 1, false};
    case SNAPSHOT_LAYOUT_TOP_HALF: return {1, 2, true};
    case SNAPSHOT_LAYOUT_TOP_FULL:
    case SNAPSHOT_LAYOUT_PACKED: return {1, 2, false};
    default: return {1, 1, false};
    }
}

int gap_of(const stereo_screen &whole) { return whole.layout == SNAPSHOT_LAYOUT_PACKED ? whole.gap : 0; }

/* One eye has no order: swapped means nothing to it. */
bool is_second(const stereo_screen &whole, stereo_eye eye)
{
    return (eye == STEREO_RIGHT) != (whole.swapped && whole.layout != SNAPSHOT_LAYOUT_MONO);
}

/* Where the eye's picture lies in the whole. */
projection_part place_of(const stereo_screen &whole, stereo_eye eye)
{
    const stereo_size size = stereo_eye_size(whole);
    const arrangement a = arrangement_of(whole.layout);
    if (!is_second(whole, eye))
        return {0, 0, size.width, size.height};
    if (whole.layout == SNAPSHOT_LAYOUT_MONO)
        return {0, 0, 0, 0};
    return {a.across == 2 ? size.width : 0, a.down == 2 ? size.height + gap_of(whole) : 0, size.width, size.height};
}

std::string pixels(const stereo_screen &whole)
{
    return "a stereo picture of " + std::to_string(whole.width) + " x " + std::to_string(whole.height) + " pixels";
}

void bind_eye(GLenum unit, GLuint texture)
{
    glActiveTexture(unit);
    glBindTexture(GL_TEXTURE_2D, texture);
}

void set_share(GLint at, const stereo_share &share)
{
    glUniform4i(at, share.x, share.y, share.of_eye.width, share.of_eye.height);
}

} // namespace

/* --- the eyes --- */

double stereo_separation_mm(const snapshot_eyes &eyes, const projection &whole, double nearest_mm, double farthest_mm)
{
    assert(eyes.plane_mm > 0 && nearest_mm > 0 && farthest_mm >= nearest_mm);
    /* Parallax is the separation, times this, times the difference of the inverse depths; half, because the clip volume
       is 2 wide. */
    const double widths = std::abs(whole.clip_from_eye[0][0]) / 2;
    const double crossed = 1 / nearest_mm - 1 / eyes.plane_mm, uncrossed = 1 / eyes.plane_mm - 1 / farthest_mm;
    const double most_per_mm = widths * std::max({crossed, uncrossed, 0.0});
    const double asked = eyes.separation * eyes.plane_mm;
    return asked * most_per_mm > STEREO_PARALLAX_MAX ? STEREO_PARALLAX_MAX / most_per_mm : asked;
}

stereo_seen stereo_see(const projection &mono, double plane_mm, double separation_mm, stereo_eye eye)
{
    const glm::dmat4 &clip = mono.clip_from_eye;
    assert(plane_mm > 0 && separation_mm >= 0);
    assert(clip[0][1] == 0 && clip[0][2] == 0 && clip[0][3] == 0); /* else a shift along x would be seen in y */
    const bool to_the_left = (eye == STEREO_LEFT) == (clip[0][0] > 0);
    const double x = separation_mm * (to_the_left ? -0.5 : 0.5);
    stereo_seen out;
    out.eye_from_mono = glm::translate(glm::dmat4(1), glm::dvec3(-x, 0, 0));
    out.seen = mono;
    out.seen.eye_from_world = out.eye_from_mono * mono.eye_from_world;
    glm::dmat4 shear(1);
    shear[2][0] = -x / plane_mm;
    out.seen.clip_from_eye = clip * shear;
    out.far_shift = clip[0][0] * x / plane_mm;
    return out;
}

/* --- layouts --- */

std::string stereo_trouble(const snapshot_eyes &eyes, const stereo_screen &whole)
{
    if (!std::isfinite(eyes.plane_mm) || eyes.plane_mm <= 0)
        return "snapshot: eyes.plane_mm must be more than 0";
    if (!std::isfinite(eyes.separation) || eyes.separation < 0)
        return "snapshot: eyes.separation must be 0 or more";
    if (whole.layout < 0 || whole.layout >= SNAPSHOT_LAYOUTS)
        return "snapshot: eyes.layout is none of the layouts";
    const arrangement a = arrangement_of(whole.layout);
    const int gap = gap_of(whole);
    if (gap < 0)
        return pixels(whole) + " cannot have a gap of " + std::to_string(gap) + " rows";
    if (whole.width < a.across || whole.height - gap < a.down)
        return pixels(whole) + " has no room for both eyes";
    if (whole.layout == SNAPSHOT_LAYOUT_PACKED && (whole.height - gap) % 2 != 0)
        return pixels(whole) + " with a gap of " + std::to_string(gap) +
               " rows is not packed: the rows beside the gap must be an even number";
    return "";
}

stereo_size stereo_eye_size(const stereo_screen &whole)
{
    const arrangement a = arrangement_of(whole.layout);
    return {whole.width / a.across, (whole.height - gap_of(whole)) / a.down};
}

stereo_size stereo_shape(const stereo_screen &whole)
{
    const arrangement a = arrangement_of(whole.layout);
    const stereo_size size = stereo_eye_size(whole);
    return a.half ? stereo_size{size.width * a.across, size.height * a.down} : size;
}

stereo_size stereo_finished(snapshot_layout layout, int width, int height, int gap)
{
    const arrangement a = arrangement_of(layout);
    if (a.half)
        return {width, height};
    return {width * a.across, height * a.down + (layout == SNAPSHOT_LAYOUT_PACKED ? gap : 0)};
}

int stereo_gap_usual(int height)
{
    const int gap = height / 49;
    return gap + (height - gap) % 2;
}

stereo_share stereo_share_of(const stereo_screen &whole, stereo_eye eye, const projection_part &part)
{
    const projection_part place = place_of(whole, eye);
    const int left = std::max(place.x, part.x), right = std::min(place.x + place.width, part.x + part.width);
    const int top = std::max(place.y, part.y), bottom = std::min(place.y + place.height, part.y + part.height);
    if (left >= right || top >= bottom)
        return {{0, 0, 0, 0}, 0, 0};
    return {{left - place.x, top - place.y, right - left, bottom - top}, left - part.x, top - part.y};
}

/* --- the finished picture --- */

bool stereo_open(stereo *c, std::string *trouble_out)
{
    *c = stereo{};
    if (!program_open("stereo", {screen_shader_vertex}, {stereo_shader_fragment}, &c->program, trouble_out))
        return false;
    c->part = program_uniform(c->program, "u_part");
    c->way = program_uniform(c->program, "u_way");
    c->first_share = program_uniform(c->program, "u_first_share");
    c->second_share = program_uniform(c->program, "u_second_share");
    glGenVertexArrays(1, &c->array);
    glUseProgram(c->program);
    glUniform1i(program_uniform(c->program, "u_first"), 0);
    glUniform1i(program_uniform(c->program, "u_second"), 1);
    glUseProgram(0);
    return true;
}

void stereo_close(stereo *c)
{
    program_close(c->program);
    if (c->array != 0)
        glDeleteVertexArrays(1, &c->array);
    *c = stereo{};
}

void stereo_compose(const stereo &c, const stereo_screen &whole, const projection_part &part, GLuint left,
                    GLuint right)
{
    assert(c.program != 0);
    const bool turned = is_second(whole, STEREO_LEFT);
    const stereo_share first = stereo_share_of(whole, turned ? STEREO_RIGHT : STEREO_LEFT, part);
    const stereo_share second = stereo_share_of(whole, turned ? STEREO_LEFT : STEREO_RIGHT, part);
    glViewport(0, 0, part.width, part.height);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glUseProgram(c.program);
    glUniform1i(c.way, way_of(whole.layout));
    glUniform3i(c.part, part.x, part.y, part.height);
    set_share(c.first_share, first);
    set_share(c.second_share, second);
    bind_eye(GL_TEXTURE1, turned ? left : right);
    bind_eye(GL_TEXTURE0, turned ? right : left);
    glBindVertexArray(c.array);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    bind_eye(GL_TEXTURE1, 0);
    bind_eye(GL_TEXTURE0, 0); /* and leaves unit 0 the active one */
    glUseProgram(0);
}
