/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The fragment stage for clay in the look of today: physically based, lit by the scenery and the lamps, then
 *          brought under the screen's white as film does.
 * Is not:  The light that arrives (lighting_shader.h); the papers' look (plain_shader.h); the vertex stage
 *          (patch_shader.h). It needs colour_shader.h, layer_shader.h and lighting_shader.h before it.
 * Shape:   everything in eye space; v is the unit vector to the eye, n the normal.
 *              diffuse    of the scenery: its irradiance, less where the sky is hidden, and there tinted by the clay
 *                         itself, as light goes to and fro; of the lamps: wrapped a little round the terminator, red
 *                         furthest, since light wanders in clay
 *              specular   GGX with Smith's visibility and Schlick's Fresnel; alpha = sqrt(2 / (shininess + 2)),
 *                         F0 = 0.08 specular, and at grazing angles the less
 *                         the duller it is; of the scenery: its map's level of that roughness
 *              bend       hollows a little darker, ridges a little lighter, so that fine marks are read
 *          u_look picks: 0 clay; 2 silhouette: one flat dark; 3 raking: grey, one lamp that grazes.
 * Units:   millimetres, linear light.
 * Source:  Walter et al. 2007 (GGX); Karis 2014 (the split sum's scale and bias, as a polynomial); Jimenez et al. 2016
 *          (light to and fro in hollows); 000 section 5 names shadows as future work.
 */
#ifndef GLAISE_VIEW_CLAY_SHADER_H
#define GLAISE_VIEW_CLAY_SHADER_H

inline constexpr char clay_shader_fragment[] = R"(
uniform int u_look;      /* as enum snapshot_look */
uniform vec3 u_material; /* specular, shininess, ambient */

uniform sampler2D u_rough; /* the scenery, by roughness */

const float SCENERY_ROUGHEST = 6.0; /* as scenery.h has it */
const vec3 WRAP = vec3(0.20, 0.14, 0.11);
const vec3 RAKING_CLAY = vec3(0.42);
const vec3 SILHOUETTE_CLAY = vec3(0.012);

float visibility(float to_eye, float to_lamp, float alpha)
{
    float a = alpha * alpha;
    float eye = to_lamp * sqrt(to_eye * to_eye * (1.0 - a) + a);
    float lamp = to_eye * sqrt(to_lamp * to_lamp * (1.0 - a) + a);
    return 0.5 / max(eye + lamp, 1e-5);
}

/* A lamp's light on the surface: x the matt part's, y the shine's. */
void lamp(vec3 n, vec3 v, vec3 toward, vec3 light, float seen, float alpha, vec2 f, inout vec3 matt, inout vec3 shine)
{
    float to_lamp = dot(n, toward), to_eye = max(dot(n, v), 1e-3);
    vec3 wrapped = clamp((to_lamp + WRAP) / (1.0 + WRAP), 0.0, 1.0);
    matt += light * wrapped * mix(wrapped, vec3(1.0), 0.35) * mix(1.0, seen, smoothstep(-0.15, 0.2, to_lamp));
    if (to_lamp <= 0.0)
        return;
    vec3 h = normalize(toward + v);
    float half_n = max(dot(n, h), 0.0), half_v = max(dot(v, h), 0.0), a = alpha * alpha;
    float round = half_n * half_n * (a - 1.0) + 1.0;
    float fresnel = f.x + (f.y - f.x) * pow(1.0 - half_v, 5.0);
    shine += light * (seen * fresnel * to_lamp * a / (round * round) * visibility(to_eye, to_lamp, alpha));
}

vec3 lit(vec3 n, vec3 v, vec3 albedo, vec2 open)
{
    float alpha = sqrt(2.0 / (u_material.y + 2.0)), rough = sqrt(alpha), f0 = 0.08 * u_material.x;
    float f90 = max(f0, min(2.0 * u_material.x, 1.0) * (1.0 - rough)); /* dull clay has no hot rim */
    float to_eye = max(dot(n, v), 1e-3), sky = u_material.z * SKY_STRENGTH;
    vec3 to_and_fro = max(vec3(open.x), ((2.0404 * albedo - 0.3324) * open.x * open.x * open.x) +
        (-4.7951 * albedo + 0.6417) * open.x * open.x + (2.7552 * albedo + 0.6903) * open.x);
    vec3 matt = irradiance(n) * sky * to_and_fro, shine = vec3(0.0);
    for (int i = 0; i < u_light_count; i++) {
        vec3 toward = normalize(u_light_place[i] - v_eye);
        float seen = i == 0 ? shadowed(v_eye, n, toward) : 1.0;
        lamp(n, v, toward, u_light_colour[i], seen * mix(1.0, open.x, 0.35), alpha, vec2(f0, f90), matt, shine);
    }
    vec4 r = rough * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float edge = min(r.x * r.x, exp2(-9.28 * to_eye)) * r.x + r.y;
    vec2 split = vec2(-1.04, 1.04) * edge + r.zw;
    float hidden = clamp(pow(to_eye + open.x, exp2(-16.0 * rough - 1.0)) - 1.0 + open.x, 0.0, 1.0);
    vec3 around = textureLod(u_rough, scenery_place(reflect(-v, n)), rough * SCENERY_ROUGHEST).rgb;
    shine += around * (f0 * split.x + f90 * split.y) * min(sky, 1.0) * hidden;
    return albedo * matt + shine;
}

void main()
{
    if (u_look == 2) {
        f_colour = vec4(ringed(SILHOUETTE_CLAY), 1.0);
        return;
    }
    vec3 u = normalize(v_eye);
    vec3 n = normalize(v_normal);
    /* An interpolated normal may point away from the eye at the rim: turn it back just as far as can be seen. */
    n = normalize(n - u * max(dot(n, u), 0.0));
    vec2 open = hollow(-v_eye.z);
    float bend = clamp(1.0 + (open.y - 0.5) * 1.5, 0.55, 1.35);
    vec3 colour;
    if (u_look == 3) {
        vec3 toward = normalize(u_light_place[0] - v_eye);
        float graze = max(dot(n, toward), 0.0) * shadowed(v_eye, n, toward);
        colour = RAKING_CLAY * (2.4 * graze + 0.06 * open.x) * bend;
    } else {
        colour = lit(n, -u, v_colour * bend, open);
        if (u_environment != 0)
            colour = mix(colour, mirrored(n, u) * mix(1.0, open.x, 0.6), layer(dot(n, u)));
    }
    f_colour = vec4(ringed(film(colour)), 1.0);
}
)";

#endif
