/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The last pass of a stereo picture: for each of its pixels, which eye it belongs to, or both eyes' light
 *          mixed for coloured glasses.
 * Is not:  The choice of an eye's place and size (stereo.h); what the eyes see.
 * Shape:   screen_shader.h covers the framebuffer. `at` counts from the top left of the part, `on_screen` from that
 *          of the whole; texels are fetched, never filtered.
 * Units:   pixels; linear light: sRGB textures are decoded when read, the framebuffer encodes again.
 * Source:  Dubois 2009, red and cyan glasses for LCD screens. The rows' sums are 1, 0.999, 1: white stays white.
 */
#ifndef GLAISE_VIEW_STEREO_SHADER_H
#define GLAISE_VIEW_STEREO_SHADER_H

inline constexpr char stereo_shader_fragment[] = R"(
layout(location = 0) out vec4 f_colour;

uniform sampler2D u_first;
uniform sampler2D u_second;
uniform ivec4 u_first_share; /* x, y, width, height in the part */
uniform ivec4 u_second_share;
uniform ivec3 u_part;        /* x, y in the whole; height */
uniform int u_way;

const int APART = 0, ROWS = 1, COLUMNS = 2, CHECKER = 3, ANAGLYPH = 4;

/* By rows: red, green, blue. */
const vec3 FIRST_RED = vec3(0.437, 0.449, 0.164), SECOND_RED = vec3(-0.011, -0.032, -0.007);
const vec3 FIRST_GREEN = vec3(-0.062, -0.062, -0.024), SECOND_GREEN = vec3(0.377, 0.761, 0.009);
const vec3 FIRST_BLUE = vec3(-0.048, -0.050, -0.017), SECOND_BLUE = vec3(-0.026, -0.093, 1.234);

bool holds(ivec4 share, ivec2 at)
{
    return all(greaterThanEqual(at, share.xy)) && all(lessThan(at, share.xy + share.zw));
}

/* OpenGL has the bottom row first. */
ivec2 texel(ivec4 share, ivec2 at) { return ivec2(at.x - share.x, share.w - 1 - (at.y - share.y)); }
vec3 first(ivec2 at) { return texelFetch(u_first, texel(u_first_share, at), 0).rgb; }
vec3 second(ivec2 at) { return texelFetch(u_second, texel(u_second_share, at), 0).rgb; }

vec3 anaglyph(vec3 l, vec3 r)
{
    return vec3(dot(FIRST_RED, l) + dot(SECOND_RED, r), dot(FIRST_GREEN, l) + dot(SECOND_GREEN, r),
                dot(FIRST_BLUE, l) + dot(SECOND_BLUE, r));
}

vec3 apart(ivec2 at)
{
    if (holds(u_first_share, at))
        return first(at);
    return holds(u_second_share, at) ? second(at) : vec3(0.0);
}

void main()
{
    ivec2 at = ivec2(int(gl_FragCoord.x), u_part.z - 1 - int(gl_FragCoord.y));
    ivec2 on_screen = at + u_part.xy;
    int step_of = u_way == ROWS ? on_screen.y : u_way == COLUMNS ? on_screen.x : on_screen.x + on_screen.y;
    vec3 colour;
    if (u_way == APART)
        colour = apart(at);
    else if (u_way == ANAGLYPH)
        colour = clamp(anaglyph(first(at), second(at)), 0.0, 1.0);
    else
        colour = (step_of & 1) == 0 ? first(at) : second(at);
    f_colour = vec4(colour, 1.0);
}
)";

#endif
