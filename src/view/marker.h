/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Everything in the picture that is not clay: the tool, the lights as small yellow balls, the workspace box.
 * Is not:  The ring on the clay where the tool meets it (clay_shader.h, drawn with the clay); menus.
 * Shape:   all are drawn after the clay, against its depth:
 *
 *              tool, wire         lines behind clay faint, then lines before it; an ellipsoid shows the limit of its
 *                                 influence by circles of latitude and longitude, a freeform its triangles' sides
 *              tool, transparent  what clay hides faint, far side, near side (nearest layer only)
 *              pedal down         the tool turns towards MARKER's working colour and grows more opaque
 *
 * Units:   millimetres; colours in linear light.
 * Owner:   the caller owns the struct. The context must be current throughout.
 * Errors:  marker_open false: the trouble holds the compiler's words. A tool whose frame is flat or not finite is not
 *          drawn.
 * Cost:    a few draw calls.
 * Source:  000 section 2, figures 2 and 3.
 */
#ifndef GLAISE_VIEW_MARKER_H
#define GLAISE_VIEW_MARKER_H

#include "view/projection.h"
#include "view/upload.h"

#include <string>

constexpr double MARKER_LIGHT_RADIUS = 0.009; /* of camera_distance */

struct marker_program {
    GLuint program = 0;
    GLint eye_from_marker, eye_normal, clip_from_eye, style, colour, alpha;
    GLint middle; /* patches only */
};

struct marker {
    marker_program globes, patches;
    GLuint vertices = 0, indices = 0, array = 0;
    GLsizei ball_indices = 0;                     /* triangles of the unit ball */
    GLint circles_first = 0, box_first = 0;       /* lines: circles on the unit ball, the unit cube's sides */
    GLsizei circles_count = 0, box_count = 0;
    float line_width_max = 1;
};

[[nodiscard]] bool marker_open(marker *m, std::string *trouble_out);
void marker_close(marker *m);

/* Tool space to eye space; false when the tool cannot be drawn. */
bool marker_eye_from_tool(const snapshot &s, const projection &p, glm::dmat4 *eye_from_tool_out);
/* The colour lines and ring take: the tool's own, lifted so that it shows on a dark ground; warm while working. */
glm::vec3 marker_tool_colour(const snapshot &s);

void marker_draw_box(const marker &m, const snapshot &s, const projection &p);
void marker_draw_lights(const marker &m, const snapshot &s, const projection &p);
/* patches: those of s.tool_surface, made with lines; NULL for an ellipsoid. height: of the picture, pixels. */
void marker_draw_tool(const marker &m, const snapshot &s, const projection &p, const upload *patches, int height);

#endif
