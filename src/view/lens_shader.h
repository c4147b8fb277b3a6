/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The stage for depth of field: what lies nearer or farther than the work is spread over a disc.
 * Is not:  Who draws it (lens.h). It needs colour_shader.h before it.
 * Shape:   a point at depth d is spread over a disc of radius  widest |d - focus| / d  pixels, LIMIT at most. Each
 *          pixel gathers those around it whose disc reaches it; what lies behind it reaches no farther than its own
 *          disc, so that a sharp rim stays sharp before a blurred ground.
 * Units:   pixels, millimetres.
 */
#ifndef GLAISE_VIEW_LENS_SHADER_H
#define GLAISE_VIEW_LENS_SHADER_H

inline constexpr char lens_shader_fragment[] = R"(
uniform sampler2D u_sharp;
uniform sampler2D u_hollow;
uniform vec2 u_depth_range;
uniform vec2 u_origin; /* of this part of the picture, pixels */
uniform vec3 u_lens; /* focus mm, widest pixels, limit pixels */
layout(location = 0) out vec4 f_colour;
const int TAPS = 32;

float deep(ivec2 pixel)
{
    vec4 t = texelFetch(u_hollow, clamp(pixel / 2, ivec2(0), textureSize(u_hollow, 0) - 1), 0);
    return mix(u_depth_range.x, u_depth_range.y, (t.b * 255.0 * 256.0 + t.a * 255.0) / 65535.0);
}

float disc(float depth) { return min(u_lens.y * abs(depth - u_lens.x) / depth, u_lens.z); }

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(u_sharp, 0) - 1;
    float depth = deep(at), mine = disc(depth), turn = 6.2831853 * unrest(floor(gl_FragCoord.xy) + u_origin);
    vec3 sum = texelFetch(u_sharp, at, 0).rgb;
    float weights = 1.0;
    for (int k = 0; k < TAPS; k++) {
        float away = sqrt((float(k) + 0.5) / float(TAPS)) * u_lens.z, angle = float(k) * 2.3999632 + turn;
        ivec2 there = clamp(at + ivec2(away * vec2(cos(angle), sin(angle))), ivec2(0), last);
        float d = deep(there), reach = disc(d);
        if (d > depth)
            reach = min(reach, mine);
        float weight = smoothstep(away - 1.0, away + 1.0, reach);
        sum += texelFetch(u_sharp, there, 0).rgb * weight;
        weights += weight;
    }
    f_colour = vec4(sum / weights, 1.0);
}
)";

#endif
