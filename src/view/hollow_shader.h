/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The stages that find how open the sky is at each point that is seen, and how the surface bends there: a
 *          relief of what is seen at half the size, what hides the sky in it, and the noise taken out.
 * Is not:  Who draws them (hollow.h); what the light makes of it (lighting_shader.h).
 * Shape:   relief     RGBA16UI: normal, octahedral, 2 x 16 bit; depth from near to far, 16 bit; 65535: nothing
 *          hidden     RGBA8: how open, 0..1; bend, 1/2 flat; depth as before, high and low byte
 *          smoothed   the same, the mean of 4 x 4 that lie about as deep
 *
 *          A point p with normal n is hidden by what lies over its plane near it: of TAPS points q on a spiral round it
 *              hidden = (k / TAPS) sum part (1 - d^2) max(0, (q - p).n / r - slack) / (d^2 + 0.015)
 *          where d = |q - p| / r <= 1, and part is how far out q is on the spiral: out there its points
 *          are farther apart.
 *          The spiral is turned from pixel to pixel; 4 x 4 turns are one another's complement.
 *          The bend is how far the neighbours' normals lean apart, a few pixels to either side.
 * Units:   millimetres, eye space.
 * Source:  McGuire et al. 2011 (the estimator).
 */
#ifndef GLAISE_VIEW_HOLLOW_SHADER_H
#define GLAISE_VIEW_HOLLOW_SHADER_H

inline constexpr char hollow_shader_relief[] = R"(
in vec3 v_eye;
centroid in vec3 v_normal;
uniform vec2 u_depth_range;
layout(location = 0) out uvec4 f_relief;

void main()
{
    vec3 n = normalize(v_normal);
    n /= abs(n.x) + abs(n.y) + abs(n.z);
    vec2 e = n.z >= 0.0 ? n.xy : (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
    float deep = clamp((-v_eye.z - u_depth_range.x) / (u_depth_range.y - u_depth_range.x), 0.0, 1.0);
    f_relief = uvec4(uvec2(e * 32767.0 + 32767.5), uint(deep * 65534.0), 0u);
}
)";

inline constexpr char hollow_shader_hidden[] = R"(
uniform highp usampler2D u_relief;
uniform vec2 u_depth_range;
uniform vec4 u_clip;   /* of the projection: x and y scales, x and y shifts by depth */
uniform vec2 u_reach;  /* mm; and no wider than so many pixels */
uniform int u_taps;
uniform ivec2 u_origin; /* of this part of the picture: turns go on from the next part's */
layout(location = 0) out vec4 f_hollow;

float deep(uint d) { return mix(u_depth_range.x, u_depth_range.y, float(d) / 65534.0); }

vec3 place(vec2 pixel, float depth)
{
    vec2 ndc = pixel / vec2(textureSize(u_relief, 0)) * 2.0 - 1.0;
    return vec3((ndc + u_clip.zw) * depth / u_clip.xy, -depth);
}

vec3 normal(uvec2 pair)
{
    vec2 e = (vec2(pair) - 32767.0) / 32767.0;
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float fold = max(-n.z, 0.0);
    n.x += n.x >= 0.0 ? -fold : fold;
    n.y += n.y >= 0.0 ? -fold : fold;
    return normalize(n);
}

/* How far a neighbour's normal leans along the way to it; none across an edge. */
float lean(ivec2 at, ivec2 off, vec3 p, vec3 n)
{
    ivec2 last = textureSize(u_relief, 0) - 1;
    uvec4 r = texelFetch(u_relief, clamp(at + off, ivec2(0), last), 0);
    if (r.b == 65535u)
        return 0.0;
    float depth = deep(r.b);
    vec3 way = place(vec2(at + off) + 0.5, depth) - p;
    float far = length(way);
    if (far > 0.02 * -p.z || far == 0.0)
        return 0.0;
    return dot(normal(r.rg) - n, way / far);
}

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy), size = textureSize(u_relief, 0);
    uvec4 r = texelFetch(u_relief, at, 0);
    if (r.b == 65535u) {
        f_hollow = vec4(1.0, 0.5, 1.0, 1.0);
        return;
    }
    float depth = deep(r.b), slack = 0.002 * u_reach.x + 0.00004 * depth;
    vec3 p = place(gl_FragCoord.xy, depth), n = normal(r.rg);
    float pixels = min(u_reach.x * abs(u_clip.y) * 0.5 * float(size.y) / depth, u_reach.y);
    ivec2 turns = (at + u_origin) & 3;
    int turn = turns.x * 4 + turns.y;
    float angle = 6.2831853 * float(turn * 7 & 15) / 16.0, hidden = 0.0;
    for (int k = 0; k < u_taps; k++) {
        float part = (float(k) + 0.5 + float(turn & 1) * 0.4) / float(u_taps);
        float around = angle + float(k) * 6.2831853 * 5.0 / float(u_taps);
        vec2 off = pixels * part * vec2(cos(around), sin(around));
        ivec2 there = clamp(ivec2(gl_FragCoord.xy + off), ivec2(0), size - 1);
        uvec4 q = texelFetch(u_relief, there, 0);
        if (q.b == 65535u)
            continue;
        vec3 way = place(vec2(there) + 0.5, deep(q.b)) - p;
        float square = dot(way, way) / (u_reach.x * u_reach.x);
        float over = max(dot(way, n) - slack, 0.0) / u_reach.x;
        hidden += part * max(1.0 - square, 0.0) * over / (square + 0.015);
    }
    float open = max(1.0 - 5.5 * hidden / float(u_taps), 0.0);
    float bend = lean(at, ivec2(2, 0), p, n) + lean(at, ivec2(-2, 0), p, n) + lean(at, ivec2(0, 2), p, n) +
                 lean(at, ivec2(0, -2), p, n);
    uint coded = r.b;
    f_hollow = vec4(open, clamp(0.5 + 0.55 * bend, 0.0, 1.0), float(coded >> 8) / 255.0, float(coded & 255u) / 255.0);
}
)";

inline constexpr char hollow_shader_smoothed[] = R"(
uniform sampler2D u_hidden;
layout(location = 0) out vec4 f_hollow;

float deep(vec4 t) { return t.b * 255.0 * 256.0 + t.a * 255.0; }

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(u_hidden, 0) - 1;
    vec4 mine = texelFetch(u_hidden, at, 0);
    vec2 sum = vec2(0.0, 0.0);
    float weights = 0.0;
    for (int y = -2; y < 2; y++) {
        for (int x = -2; x < 2; x++) {
            vec4 t = texelFetch(u_hidden, clamp(at + ivec2(x, y), ivec2(0), last), 0);
            float weight = 1.0 / (1.0 + abs(deep(t) - deep(mine)) * 0.01);
            sum.x += t.r * weight;
            weights += weight;
        }
    }
    f_hollow = vec4(sum.x / weights, mine.g, mine.ba);
}
)";

#endif
