/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The stages for everything drawn that is not clay: the tool, the lights, a shadow on the floor.
 * Is not:  What is drawn, and in which order (marker.h). The fragment stage needs colour_shader.h before it, and serves
 *          patch_shader.h's vertices as well as its own.
 * Shape:   u_style picks one of six: see STYLE_ in marker.cpp. Alpha is straight. Stripes lie across the screen, not on
 *          the thing, so that they are as wide near and far and do not swim when it turns.
 * Units:   millimetres, linear light.
 */
#ifndef GLAISE_VIEW_MARKER_SHADER_H
#define GLAISE_VIEW_MARKER_SHADER_H

inline constexpr char marker_shader_vertex[] = R"(
layout(location = 0) in vec3 a_place; /* on the unit sphere it is its own normal */
uniform mat4 u_eye_from_marker;
uniform mat3 u_eye_normal;
uniform mat4 u_clip_from_eye;
out vec3 v_eye;
centroid out vec3 v_normal;

void main()
{
    vec4 eye = u_eye_from_marker * vec4(a_place, 1.0);
    v_eye = eye.xyz;
    v_normal = u_eye_normal * a_place;
    gl_Position = u_clip_from_eye * eye;
}
)";

inline constexpr char marker_shader_fragment[] = R"(
in vec3 v_eye;
centroid in vec3 v_normal;
layout(location = 0) out vec4 f_colour;
uniform int u_style;
uniform vec4 u_colour;
uniform vec2 u_alpha; /* turned away from the viewer, at the rim: parts of u_colour's */
uniform float u_hatch; /* pixels from stripe to stripe; 0: none */

void main()
{
    vec3 v = -normalize(v_eye);
    float facing = dot(v_normal, v) * inversesqrt(max(dot(v_normal, v_normal), 1e-20));
    vec3 colour = u_colour.rgb;
    float alpha = u_colour.a;
    if (u_style == 1) {
        alpha *= mix(u_alpha.x, 1.0, smoothstep(-0.25, 0.25, facing));
    } else if (u_style == 2) {
        float rim = 1.0 - abs(facing);
        alpha = min(alpha * mix(1.0, u_alpha.y, rim * rim * rim), 1.0) * (facing < 0.0 ? u_alpha.x : 1.0);
        float top = 0.5 + 0.5 * normalize(v_normal).y;
        colour *= mix(0.55, 1.1, top);
        colour += 0.35 * pow(max(dot(normalize(v_normal), normalize(vec3(-0.45, 0.65, 0.75))), 0.0), 40.0);
    } else if (u_style == 3) {
        colour *= mix(0.45, 1.15, smoothstep(0.0, 0.9, facing));
    } else if (u_style == 4) {
        float core = max(facing, 0.0) * max(facing, 0.0); /* 1 - (distance from the middle)^2 */
        alpha *= core * core;
    } else if (u_style == 5) {
        alpha *= v_normal.y * v_normal.y; /* likewise, of a ball pressed flat */
    }
    if (u_hatch > 0.0) {
        float at = abs(2.0 * fract((gl_FragCoord.x + gl_FragCoord.y) / u_hatch) - 1.0);
        alpha *= mix(0.25, 1.0, smoothstep(0.5 - 1.5 / u_hatch, 0.5 + 1.5 / u_hatch, at));
    }
    f_colour = vec4(highlight(colour), alpha);
}
)";

#endif
