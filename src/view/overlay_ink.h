/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Draws what Dear ImGui has laid out, with OpenGL ES 3.1, into the framebuffer that is bound.
 * Is not:  ImGui's own renderer: that loads desktop OpenGL and writes encoded colours. Nothing is clipped.
 * Shape:   one buffer of vertices, one of indices, written anew for every picture; one texture of letters, R8.
 * Units:   pixels from the top left corner.
 * Owner:   the caller owns the struct; a zeroed one is closed. The context must be current throughout.
 * Errors:  overlay_ink_open false: the trouble holds the compiler's words.
 * Cost:    two uploads of some 100 KB and one draw call a list.
 */
#ifndef GLAISE_VIEW_OVERLAY_INK_H
#define GLAISE_VIEW_OVERLAY_INK_H

#include <GLES3/gl31.h>
#include <imgui/imgui.h>

#include <cstdint>
#include <string>

struct overlay_ink {
    GLuint program = 0, array = 0, vertices = 0, indices = 0, letters = 0;
    GLint scale = -1, shift = -1;
};

/* Layout pixels to those of a viewport of width x height: place * times + plus. */
struct overlay_ink_fit {
    double times_x, times_y, plus_x, plus_y;
    int width, height;
};

[[nodiscard]] bool overlay_ink_open(overlay_ink *k, std::string *trouble_out);
void overlay_ink_close(overlay_ink *k);
/* coverage: width x height bytes. */
void overlay_ink_letters(overlay_ink *k, const uint8_t *coverage, int width, int height);
/* Leaves blending, depth test and culling off, nothing bound. */
void overlay_ink_draw(const overlay_ink &k, const ImDrawData *data, const overlay_ink_fit &fit);

#endif
