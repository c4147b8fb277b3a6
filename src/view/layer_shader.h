/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What lies over the clay in every look: the layer that mirrors the scenery, and the ring where the tool's
 *          limit of influence meets the clay.
 * Is not:  The clay beneath (clay_shader.h, plain_shader.h); the scenery's picture (scenery.h).
 * Shape:   everything in eye space; u is the unit vector from the eye, n the normal.
 *              environment colour = (1 - w) lit + w map(r); none: w = 0, opaque: 1, semi: constant, clear coat:
 *                          w = F0 + (1 - F0) (1 - |n.v|)^5
 * Units:   millimetres, linear light.
 * Source:  000 section 5; Schlick 1994 for the clear coat's weight, F0 of glass (index 1.5).
 */
#ifndef GLAISE_VIEW_LAYER_SHADER_H
#define GLAISE_VIEW_LAYER_SHADER_H

inline constexpr char layer_shader_text[] = R"(
in vec3 v_eye;
centroid in vec3 v_normal;
centroid in vec3 v_colour;
layout(location = 0) out vec4 f_colour;

uniform int u_environment;  /* as enum snapshot_environment */
uniform float u_environment_strength;
uniform sampler2D u_mirror;
uniform mat4 u_tool_from_eye;
uniform vec4 u_ring; /* alpha 0: none */

const float COAT_F0 = 0.04;

vec2 scenery_place(vec3 r)
{
    float m = 2.0 * sqrt(r.x * r.x + r.y * r.y + (r.z + 1.0) * (r.z + 1.0));
    return r.xy / max(m, 1e-4) + 0.5;
}

vec3 mirrored(vec3 n, vec3 u) { return texture(u_mirror, scenery_place(reflect(u, n))).rgb; }

float schlick(float facing) { return COAT_F0 + (1.0 - COAT_F0) * pow(1.0 - min(abs(facing), 1.0), 5.0); }

float layer(float facing)
{
    if (u_environment == 1)
        return 1.0;
    return u_environment == 2 ? u_environment_strength : schlick(facing);
}

/* The line where the clay crosses the limit of the tool's influence, some two pixels wide. At the clay's rim a pixel
   spans much of the clay: what lies far from the limit is no part of the line there. */
vec3 ringed(vec3 colour)
{
    if (u_ring.a == 0.0)
        return colour;
    float rho = length((u_tool_from_eye * vec4(v_eye, 1.0)).xyz);
    float away = abs(rho - 1.0);
    float line = (1.0 - smoothstep(0.5, 1.5, away / max(fwidth(rho), 1e-6))) * (1.0 - smoothstep(0.08, 0.16, away));
    return mix(colour, u_ring.rgb, u_ring.a * line);
}
)";

#endif
