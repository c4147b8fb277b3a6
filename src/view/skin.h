/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The clay's patches drawn, in any look: the programs for it and what they are told.
 * Is not:  The patches on the device (upload.h); the light (lighting.h).
 * Shape:
 *              plain    the papers' look                     must compile: without it there is no picture
 *              clay     today's, silhouette, raking          where it does not compile, plain is drawn instead
 *              relief   normals and depths (hollow.h)
 *              depth    depths alone (shadow.h)
 *
 * Units:   millimetres.
 * Owner:   the caller owns the struct; a zeroed one is closed. The context must be current throughout.
 * Errors:  skin_open false: the plain look does not compile. Else what could not be had is in the trouble, and the
 *          program of it 0.
 * Cost:    draw: one call a page.
 */
#ifndef GLAISE_VIEW_SKIN_H
#define GLAISE_VIEW_SKIN_H

#include "view/lighting.h"
#include "view/projection.h"
#include "view/upload.h"

struct skin_program {
    GLuint program = 0;
    GLint middle = -1, eye_from_steps = -1, eye_normal = -1, clip_from_eye = -1;
};

/* What layer_shader.h wants. */
struct skin_layer {
    GLint environment = -1, strength = -1, tool_from_eye = -1, ring = -1;
};

struct skin {
    skin_program plain, clay, relief, depth;
    skin_layer plain_layer, clay_layer;
    GLint plain_count = -1, plain_place = -1, plain_colour = -1, plain_material = -1;
    lighting_uniforms clay_light;
    GLint clay_look = -1, clay_material = -1;
    GLint relief_range = -1;
};

[[nodiscard]] bool skin_open(skin *k, std::string *trouble_out);
void skin_close(skin *k);

/* The look that is drawn for the one that is wanted. */
snapshot_look skin_look(const skin &k, snapshot_look wanted);
void skin_draw(const skin &k, const upload &patches, const snapshot &s, const projection &p, const lighting &light);
void skin_draw_relief(const skin &k, const upload &patches, const snapshot &s, const projection &p);
/* Both sides: what is seen from behind throws a shadow too. */
void skin_draw_depth(const skin &k, const upload &patches, const snapshot &s, const projection &p);

#endif
