/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The fragment stage for clay in the papers' look: its colour under the lights, the environment over it, and
 *          the ring where the tool's limit of influence meets it.
 * Is not:  The vertex stage (patch_shader.h); what surrounds the piece (scenery.h); the look of today (clay_shader.h).
 *          It needs colour_shader.h and layer_shader.h before it.
 * Shape:   everything in eye space; u is the unit vector from the eye, v = -u, n the normal, r = u - 2 n (n.u).
 *              diffuse     wrapped a little round the terminator, red furthest: light wanders in clay
 *              specular    Blinn-Phong, and a broad faint sheen of a fifth of its exponent
 *              ambient     hemisphere: cool from above, warm from below; a little less where the clay turns away
 *              environment colour = (1 - w) lit + w map(r); none: w = 0, opaque: 1, semi: constant, clear coat:
 *                          w = F0 + (1 - F0) (1 - |n.v|)^5
 *          Lights do not fade with distance: moving one changes direction, not exposure.
 * Units:   millimetres, linear light.
 * Source:  000 sections 2 and 5; Schlick 1994 for the clear coat's weight, F0 of glass (index 1.5).
 */
#ifndef GLAISE_VIEW_PLAIN_SHADER_H
#define GLAISE_VIEW_PLAIN_SHADER_H

inline constexpr char plain_shader_fragment[] = R"(
uniform int u_light_count;
uniform vec3 u_light_place[4];
uniform vec3 u_light_colour[4];
uniform vec3 u_material;    /* specular, shininess, ambient */

const vec3 WRAP = vec3(0.30, 0.24, 0.20);
const vec3 SKY = vec3(0.98, 1.06, 1.16);
const vec3 GROUND = vec3(0.44, 0.38, 0.33);
const float SHEEN_EXPONENT = 0.2; /* of the specular's */
const float SHEEN_WEIGHT = 0.20;
const float GLOSS_TINT = 0.4; /* clay is no varnish: some of its colour is in its shine */

vec3 lit(vec3 n, vec3 v)
{
    float facing = max(dot(n, v), 0.0);
    vec3 light = u_material.z * mix(GROUND, SKY, 0.5 + 0.5 * n.y) * (0.62 + 0.38 * facing);
    vec3 gloss = vec3(0.0);
    for (int i = 0; i < u_light_count; i++) {
        vec3 l = normalize(u_light_place[i] - v_eye);
        float toward = dot(n, l);
        vec3 wrapped = clamp((toward + WRAP) / (1.0 + WRAP), 0.0, 1.0);
        light += u_light_colour[i] * wrapped * mix(wrapped, vec3(1.0), 0.35);
        float half_toward = max(dot(n, normalize(l + v)), 0.0);
        float shine = pow(half_toward, u_material.y) + SHEEN_WEIGHT * pow(half_toward, u_material.y * SHEEN_EXPONENT);
        gloss += u_light_colour[i] * shine * smoothstep(0.0, 0.3, toward);
    }
    return v_colour * light + u_material.x * gloss * mix(vec3(1.0), v_colour, GLOSS_TINT);
}

void main()
{
    vec3 u = normalize(v_eye);
    vec3 n = normalize(v_normal);
    /* An interpolated normal may point away from the eye at the rim: turn it back just as far as can be seen. */
    n = normalize(n - u * max(dot(n, u), 0.0));
    vec3 colour = lit(n, -u);
    if (u_environment != 0)
        colour = mix(colour, mirrored(n, u), layer(dot(n, u)));
    colour = highlight(colour);
    f_colour = vec4(ringed(colour), 1.0);
}
)";

#endif
