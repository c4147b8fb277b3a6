/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The vertex stage for whatever covers the screen: one triangle, without a buffer.
 * Is not:  A fragment stage.
 * Shape:   v_place is -1..1 across and up, as gl_Position is; depth the farthest.
 * Units:   of the clip volume.
 */
#ifndef GLAISE_VIEW_SCREEN_SHADER_H
#define GLAISE_VIEW_SCREEN_SHADER_H

inline constexpr char screen_shader_vertex[] = R"(
out vec2 v_place;
void main()
{
    v_place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(v_place, 1.0, 1.0);
}
)";

#endif
