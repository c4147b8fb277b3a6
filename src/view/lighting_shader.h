/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The light that reaches a point of the clay or of the turntable, in the look of today: from the scenery all
 *          around, from up to four lamps, less what hollows keep out and what stands in the way.
 * Is not:  What the clay makes of it (clay_shader.h); the shadow map (shadow.h); the occlusion's picture (hollow.h).
 * Shape:   everything in eye space.
 *              irradiance(n)     of the scenery, over pi: nine coefficients
 *              hollow()          x: how open the sky is, 0..1; y: how the surface bends, 1/2 flat, less in hollows,
 *                                more on ridges. Taken from a picture of half the size, of its four nearest pixels
 *                                those that lie as deep as the point
 *              shadowed(e, n)    how much of the first lamp is seen, 0..1. What stands in the way is looked for first:
 *                                the farther it is from the point, the wider the shadow's edge
 * Units:   millimetres, linear light.
 * Source:  Ramamoorthi and Hanrahan 2001; Fernando 2005 (edges by the distance of what is in the way).
 */
#ifndef GLAISE_VIEW_LIGHTING_SHADER_H
#define GLAISE_VIEW_LIGHTING_SHADER_H

inline constexpr char lighting_shader_text[] = R"(
uniform vec2 u_origin; /* of this part of the picture, pixels: its unrest goes on from the next part's */
uniform vec3 u_irradiance[9];
uniform int u_light_count;
uniform vec3 u_light_place[4];
uniform vec3 u_light_colour[4];

uniform int u_shadow_taps; /* 0: no shadows */
uniform mat4 u_shadow_from_eye;
uniform vec4 u_shadow;     /* a texel in the map's 0..1; a texel's mm, 1 mm from the lamp; the lamp's half width, mm;
                              (far - near) / far */
uniform highp sampler2DShadow u_shadow_map;
uniform sampler2D u_shadow_depth;

uniform float u_hollow_strength; /* 0: none */
uniform vec2 u_depth_range;      /* of the hollow's picture: near, far mm */
uniform sampler2D u_hollow;

const float SKY_STRENGTH = 1.7; /* the scenery's light for ambient 1 */

vec3 irradiance(vec3 n)
{
    vec3 sum = u_irradiance[0] * 0.282095;
    sum += 0.488603 * (u_irradiance[1] * n.y + u_irradiance[2] * n.z + u_irradiance[3] * n.x);
    sum += 1.092548 * (u_irradiance[4] * n.x * n.y + u_irradiance[5] * n.y * n.z + u_irradiance[7] * n.x * n.z);
    sum += u_irradiance[6] * 0.315392 * (3.0 * n.z * n.z - 1.0) + u_irradiance[8] * 0.546274 * (n.x * n.x - n.y * n.y);
    return max(sum, 0.0);
}

vec2 hollow(float depth)
{
    if (u_hollow_strength == 0.0)
        return vec2(1.0, 0.5);
    vec2 at = gl_FragCoord.xy * 0.5 - 0.5;
    ivec2 low = ivec2(floor(at)), last = textureSize(u_hollow, 0) - 1;
    vec2 part = at - vec2(low);
    vec3 sum = vec3(0.0);
    float wanted = (depth - u_depth_range.x) / (u_depth_range.y - u_depth_range.x);
    for (int n = 0; n < 4; n++) {
        ivec2 off = ivec2(n & 1, n >> 1);
        vec4 t = texelFetch(u_hollow, clamp(low + off, ivec2(0), last), 0);
        float away = abs((t.b * 255.0 * 256.0 + t.a * 255.0) / 65535.0 - wanted);
        vec2 near = mix(1.0 - part, part, vec2(off));
        float weight = (near.x * near.y + 1e-3) / (away * 400.0 + 0.02);
        sum += vec3(t.rg, 1.0) * weight;
    }
    vec2 found = sum.xy / sum.z;
    return vec2(mix(1.0, found.x, u_hollow_strength), mix(0.5, found.y, u_hollow_strength));
}

/* The nth of `count` places in the unit disc, evenly spread, turned by `turn`. */
vec2 spread(int n, int count, float turn)
{
    float angle = float(n) * 2.3999632 + turn;
    return sqrt((float(n) + 0.5) / float(count)) * vec2(cos(angle), sin(angle));
}

vec3 in_map(vec3 eye)
{
    vec4 s = u_shadow_from_eye * vec4(eye, 1.0);
    return s.w > 0.0 ? s.xyz / s.w * 0.5 + 0.5 : vec3(-1.0);
}

/* How the surface's own depth changes across the map: without it a wide look finds the surface in its own way. */
vec2 slope_of(vec3 at, vec3 eye, vec3 n, float step_mm)
{
    vec3 across = normalize(abs(n.x) < 0.8 ? cross(n, vec3(1.0, 0.0, 0.0)) : cross(n, vec3(0.0, 1.0, 0.0)));
    vec3 a = in_map(eye + across * step_mm) - at, b = in_map(eye + cross(n, across) * step_mm) - at;
    float area = a.x * b.y - a.y * b.x;
    if (abs(area) < 1e-12)
        return vec2(0.0);
    return vec2(a.z * b.y - b.z * a.y, b.z * a.x - a.z * b.x) / area;
}

float shadowed(vec3 eye, vec3 n, vec3 toward)
{
    if (u_shadow_taps == 0)
        return 1.0;
    float facing = clamp(dot(n, toward), 0.0, 1.0);
    if (facing == 0.0)
        return 0.0;
    float deep = (u_shadow_from_eye * vec4(eye, 1.0)).w, texel_mm = u_shadow.y * deep;
    eye += n * (texel_mm * mix(2.5, 0.75, facing));
    vec3 at = in_map(eye);
    if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at.xy, vec2(1.0))))
        return 1.0;
    at.z = min(at.z, 1.0); /* behind all that throws shadows */
    vec2 slope = slope_of(at, eye, n, texel_mm);
    float steepest = 6.0 * u_shadow.w * texel_mm / max(deep * u_shadow.x * facing * facing, 1e-9);
    slope *= min(1.0, steepest / max(length(slope), 1e-9));
    float turn = unrest(floor(gl_FragCoord.xy) + u_origin) * 6.2831853;
    float wide = 1.5 * u_shadow.x, sure = 1.0; /* of the edge, in the map */
    if (u_shadow_taps > 6) {
        /* The map's depth d is a perspective's: near / z = 1 - d (far - near) / far. As wide as the lamp is seen
           through the near plane, a point of which stands farthest from here. */
        float mine = 1.0 / max(1.0 - at.z * u_shadow.w, 1e-5), lamp = u_shadow.z / deep * u_shadow.x / u_shadow.y;
        float reach = min(0.75 * lamp * (mine - 1.0), 48.0 * u_shadow.x);
        float blockers = 0.0, sum = 0.0;
        for (int k = 0; k < 7; k++) {
            vec2 off = reach * spread(k, 7, turn);
            float d = textureLod(u_shadow_depth, at.xy + off, 0.0).r;
            if (d < at.z + dot(slope, off)) {
                sum += 1.0 / max(1.0 - d * u_shadow.w, 1e-5);
                blockers += 1.0;
            }
        }
        if (blockers == 0.0)
            return 1.0;
        sure = min(1.0, blockers / 2.5);
        float before = sum / blockers;
        wide = clamp(lamp * (mine - before) / before, 1.2 * u_shadow.x, 28.0 * u_shadow.x);
    }
    float seen = 0.0; /* where hardly anything is in the way the shadow is faint, so that its rim does not sparkle */
    for (int k = 0; k < u_shadow_taps; k++) {
        vec2 off = wide * spread(k, u_shadow_taps, turn);
        seen += texture(u_shadow_map, vec3(at.xy + off, at.z + dot(slope, off)));
    }
    return mix(1.0, seen / float(u_shadow_taps), sure);
}
)";

#endif
