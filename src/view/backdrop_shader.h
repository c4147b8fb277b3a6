/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The ground a picture stands on: dark warm grey, a little lighter behind the piece, as a studio's paper roll;
 *          paper white behind a silhouette.
 * Is not:  The environment that clay mirrors (scenery.h). It needs colour_shader.h before it.
 * Shape:   screen_shader.h covers the screen. A dither of half a display step hides the bands that
 *          eight bits would show in so slow a gradient.
 * Units:   linear light.
 */
#ifndef GLAISE_VIEW_BACKDROP_SHADER_H
#define GLAISE_VIEW_BACKDROP_SHADER_H

inline constexpr char backdrop_shader_fragment[] = R"(
in vec2 v_place;
layout(location = 0) out vec4 f_colour;
uniform float u_aspect;
uniform vec4 u_part;  /* of the whole picture: x, y of its middle, half its width and height, all of the whole's half */
uniform float u_shift; /* of what is infinitely far, for an eye beside the middle */
uniform int u_look;   /* as enum snapshot_look */

const vec3 MIDDLE = vec3(0.082, 0.075, 0.067);
const vec3 TOP = vec3(0.026, 0.0235, 0.021);
const vec3 BOTTOM = vec3(0.0145, 0.0128, 0.0113);
const vec3 PAPER = vec3(0.72, 0.71, 0.69);

void main()
{
    vec2 place = u_part.xy + (v_place - vec2(u_shift, 0.0)) * u_part.zw;
    float wide = mix(1.0, u_aspect, 0.5);
    float away = length(vec2(place.x * wide * 0.62, place.y * 0.72 - 0.08));
    vec3 edge = mix(BOTTOM, TOP, smoothstep(-1.0, 1.0, place.y));
    vec3 light = u_look == 2 ? PAPER * (1.0 - 0.12 * away) : mix(MIDDLE, edge, smoothstep(0.0, 1.25, away));
    vec3 shown = encoded_of(light) + (unrest(floor(gl_FragCoord.xy)) - 0.5) / 255.0;
    f_colour = vec4(linear_of(shown), 1.0);
}
)";

#endif
