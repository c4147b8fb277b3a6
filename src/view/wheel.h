/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The turntable under the piece, which takes its shadow: a disc of slate at the workspace's bottom.
 * Is not:  The workspace box (marker.h). It bounds nothing, clay goes through it.
 * Shape:   round the box's middle, WHEEL_WIDER times as wide as its wider side, WHEEL_THICK of its radius thick. It is
 *          not drawn when looked at from below: the piece's foot is seen then.
 * Units:   millimetres.
 * Owner:   the caller owns the struct; a zeroed one is closed. The context must be current throughout.
 * Errors:  wheel_open false: the trouble holds the compiler's words; pictures then go without.
 * Cost:    one draw call of 288 triangles, and one in the relief (hollow.h).
 */
#ifndef GLAISE_VIEW_WHEEL_H
#define GLAISE_VIEW_WHEEL_H

#include "view/lighting.h"
#include "view/projection.h"

enum { WHEEL_SIDES = 96 };
constexpr double WHEEL_WIDER = 0.78, WHEEL_THICK = 0.045;

struct wheel_program {
    GLuint program = 0;
    GLint eye_from_wheel = -1, eye_normal = -1, clip_from_eye = -1;
};

struct wheel {
    wheel_program shown, relief;
    lighting_uniforms light;
    GLint ambient = -1, look = -1, depth_range = -1;
    GLuint empty_array = 0;
};

[[nodiscard]] bool wheel_open(wheel *w, std::string *trouble_out);
void wheel_close(wheel *w);
/* Is there one in this look? */
bool wheel_is_wanted(const snapshot &s);
/* And is it to be drawn, seen so? */
bool wheel_is_seen(const snapshot &s, const projection &p);
/* What must lie between the near and the far plane. */
projection_ball wheel_ball(const snapshot &s, const glm::dmat4 &eye_from_world);
void wheel_draw(const wheel &w, const snapshot &s, const projection &p, const lighting &light);
void wheel_draw_relief(const wheel &w, const snapshot &s, const projection &p);

#endif
