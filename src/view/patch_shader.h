/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The vertex stage for patches: from packed vertices (upload.h) to eye space. Clay and freeform tools share
 *          it.
 * Is not:  A fragment stage (clay_shader.h, marker_shader.h). It needs colour_shader.h before it.
 * Shape:   brick keys are subtracted as integers, and offsets inside a brick are multiples of 2^-12: two patches that
 *          share a vertex compute it with the same bits, so that no background shines through between them, and a piece
 *          a million bricks out stands as still as one at the origin.
 * Units:   lattice steps in, millimetres of eye space out.
 */
#ifndef GLAISE_VIEW_PATCH_SHADER_H
#define GLAISE_VIEW_PATCH_SHADER_H

inline constexpr char patch_shader_vertex[] = R"(
layout(location = 0) in uvec4 a_place; /* offset in the brick / 4096 steps; w: where u_bricks has the brick */
layout(location = 1) in vec2 a_normal; /* octahedral */
layout(location = 2) in vec4 a_colour; /* sRGB */
uniform isampler2D u_bricks;
uniform ivec3 u_middle;         /* the brick that u_eye_from_steps starts from */
uniform mat4 u_eye_from_steps;
uniform mat3 u_eye_normal;
uniform mat4 u_clip_from_eye;
out vec3 v_eye;
centroid out vec3 v_normal;
centroid out vec3 v_colour;

vec3 decoded_normal(vec2 e)
{
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float fold = max(-n.z, 0.0);
    n.x += n.x >= 0.0 ? -fold : fold;
    n.y += n.y >= 0.0 ? -fold : fold;
    return normalize(n);
}

void main()
{
    ivec3 brick = texelFetch(u_bricks, ivec2(int(a_place.w), 0), 0).xyz - u_middle;
    vec3 steps = vec3(brick) * 8.0 + vec3(a_place.xyz) * (1.0 / 4096.0);
    vec4 eye = u_eye_from_steps * vec4(steps, 1.0);
    v_eye = eye.xyz;
    v_normal = u_eye_normal * decoded_normal(a_normal);
    v_colour = linear_of(a_colour.rgb);
    gl_Position = u_clip_from_eye * eye;
}
)";

#endif
