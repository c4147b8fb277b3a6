/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The stages for what stands on the screen: Dear ImGui's vertices, one font texture.
 * Is not:  What is drawn (overlay_ring.h, overlay_strip.h). The vertex stage needs colour_shader.h before it.
 * Shape:   a vertex's colour is sRGB, straight alpha; it is decoded here, so that blending happens in linear light and
 *          the framebuffer encodes the result.
 * Units:   pixels from the top left corner; u_scale, u_shift bring them to clip space.
 */
#ifndef GLAISE_VIEW_OVERLAY_SHADER_H
#define GLAISE_VIEW_OVERLAY_SHADER_H

inline constexpr char overlay_shader_vertex[] = R"(
layout(location = 0) in vec2 a_place;
layout(location = 1) in vec2 a_letter;
layout(location = 2) in vec4 a_colour;
uniform vec2 u_scale;
uniform vec2 u_shift;
out vec2 v_letter;
out vec4 v_colour;

void main()
{
    v_letter = a_letter;
    v_colour = vec4(linear_of(a_colour.rgb), a_colour.a);
    gl_Position = vec4(a_place * u_scale + u_shift, 0.0, 1.0);
}
)";

inline constexpr char overlay_shader_fragment[] = R"(
in vec2 v_letter;
in vec4 v_colour;
layout(location = 0) out vec4 f_colour;
uniform sampler2D u_letters;

void main()
{
    f_colour = vec4(v_colour.rgb, v_colour.a * texture(u_letters, v_letter).r);
}
)";

#endif
