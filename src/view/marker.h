/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Everything in the picture that is not clay: the tool, the lights, the workspace box.
 * Is not:  The ring on the clay where an ellipsoid meets it (layer_shader.h, drawn with the clay); the tool's place
 *          over the floor (plumb.h, drawn here with it); lines themselves (hairline.h); menus (overlay.h).
 * Shape:   all are drawn after the clay, against its depth:
 *
 *              tool, wire         an ellipsoid shows the limit of its influence by circles of latitude and longitude,
 *                                 a freeform its triangles' sides
 *              tool, transparent  far side, near side (nearest layer only)
 *              behind the clay    or in it: blue, in stripes
 *              meeting            a freeform's line with the clay's surface: where the tool moved a hair towards the
 *                                 eye is before the clay, and moved a hair away is behind it. Needs a stencil
 *                                 buffer; where the framebuffer has none the line is left out
 *              pedal down         the tool turns towards MARKER's working colour and grows more opaque
 *              box                sides behind the piece fainter, a mark every 10 mm, a longer one every 50
 *              light              a ball and a halo of its own colour; with a ring where it goes with the viewer
 *
 * Units:   millimetres; colours in linear light.
 * Owner:   the caller owns the struct. The context must be current throughout.
 * Errors:  marker_open false: the trouble holds the compiler's words. A tool whose frame is flat or not finite is not
 *          drawn.
 * Cost:    some ten draw calls; a freeform's triangles up to eight times.
 * Source:  000 section 2, figures 2 and 3; we differ: the paper's lights are all yellow.
 */
#ifndef GLAISE_VIEW_MARKER_H
#define GLAISE_VIEW_MARKER_H

#include "view/hairline.h"
#include "view/projection.h"
#include "view/upload.h"

#include <string>

constexpr double MARKER_LIGHT_RADIUS = 0.009; /* of camera_distance; of its ball */
constexpr double MARKER_LIGHT_REACH = 2.8 * MARKER_LIGHT_RADIUS; /* of its halo */
constexpr double MARKER_TICK_MM = 10;         /* from mark to mark on the box; ten times that on very large ones */

struct marker_program {
    GLuint program = 0;
    GLint eye_from_marker, eye_normal, clip_from_eye, style, colour, alpha, hatch;
    GLint middle; /* patches only */
};

struct marker {
    marker_program globes, patches;
    GLuint vertices = 0, indices = 0, array = 0;
    GLsizei ball_indices = 0;                     /* triangles of the unit ball */
    hairline lines;                               /* those kept: circles on the unit ball */
    float line_width_max = 1;                     /* of the device's own, for a freeform's sides */
};

[[nodiscard]] bool marker_open(marker *m, std::string *trouble_out);
void marker_close(marker *m);

/* Tool space to eye space; false when the tool cannot be drawn. */
bool marker_eye_from_tool(const snapshot &s, const projection &p, glm::dmat4 *eye_from_tool_out);
/* The colour lines and ring take: the tool's own, lifted so that it shows on a dark ground; warm while working. */
glm::vec3 marker_tool_colour(const snapshot &s);

void marker_draw_box(const marker &m, const snapshot &s, const projection &p);
void marker_draw_lights(const marker &m, const snapshot &s, const projection &p);
/* patches: those of s.tool_surface, made with lines; NULL for an ellipsoid. A stencil buffer is cleared and
   left zero. */
void marker_draw_tool(const marker &m, const snapshot &s, const projection &p, const upload *patches);

#endif
