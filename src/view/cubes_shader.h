/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The stages for cubes: one instance a face, a square made from nothing but its number, shaded flat, with its
 *          sides drawn as lines.
 * Is not:  Which faces there are (cubes.h). The fragment stage needs colour_shader.h before it.
 * Shape:   a face is at a_face.xyz, in units of u_eye_from_units; a_face.w is its side: 2 axis + (1: the upper one).
 *          Lines are as wide in pixels however far they are, and fade where cubes are but a few pixels: they would fill
 *          the picture.
 * Units:   cubes in, linear light out.
 */
#ifndef GLAISE_VIEW_CUBES_SHADER_H
#define GLAISE_VIEW_CUBES_SHADER_H

inline constexpr char cubes_shader_vertex[] = R"(
layout(location = 0) in uvec4 a_face;
uniform mat4 u_eye_from_units;
uniform mat3 u_eye_normal;
uniform mat4 u_clip_from_eye;
out vec3 v_eye;
out vec2 v_place;
flat out vec3 v_normal;

void main()
{
    int axis = int(a_face.w >> 1u), upper = int(a_face.w & 1u);
    v_place = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    vec2 along = upper == 1 ? v_place : v_place.yx; /* counter-clockwise from outside on either side */
    vec3 at = vec3(a_face.xyz), normal = vec3(0.0);
    at[axis] += float(upper);
    at[(axis + 1) % 3] += along.x;
    at[(axis + 2) % 3] += along.y;
    normal[axis] = float(2 * upper - 1);
    vec4 eye = u_eye_from_units * vec4(at, 1.0);
    v_eye = eye.xyz;
    v_normal = u_eye_normal * normal;
    gl_Position = u_clip_from_eye * eye;
}
)";

inline constexpr char cubes_shader_fragment[] = R"(
in vec3 v_eye;
in vec2 v_place;
flat in vec3 v_normal;
layout(location = 0) out vec4 f_colour;
uniform vec3 u_colour;
uniform int u_light_count;
uniform vec3 u_light_place[4];
uniform vec3 u_light_colour[4];

const vec3 SKY = vec3(0.15, 0.165, 0.185);
const vec3 GROUND = vec3(0.045, 0.04, 0.035);
const float LINE = 0.22; /* of the light that is left on a line */

void main()
{
    vec3 n = normalize(v_normal);
    vec3 light = mix(GROUND, SKY, 0.5 + 0.5 * n.y) + 0.06 * max(dot(n, -normalize(v_eye)), 0.0);
    for (int i = 0; i < u_light_count; i++)
        light += 0.72 * u_light_colour[i] * max(dot(n, normalize(u_light_place[i] - v_eye)), 0.0);
    vec2 pixel = max(fwidth(v_place), vec2(1e-6));
    vec2 away = min(v_place, 1.0 - v_place) / pixel;
    float line = 1.0 - smoothstep(0.4, 1.2, min(away.x, away.y));
    line *= smoothstep(2.5, 7.0, 1.0 / max(pixel.x, pixel.y));
    f_colour = vec4(highlight(u_colour * light) * mix(1.0, LINE, line), 1.0);
}
)";

#endif
