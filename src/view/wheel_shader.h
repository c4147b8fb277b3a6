/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The stages for the turntable: a banding wheel of slate under the piece, grooved in rings as a lathe
 *          leaves it.
 * Is not:  The light (lighting_shader.h); where it lies (wheel.h). The fragment stage needs colour_shader.h and
 *          lighting_shader.h before it.
 * Shape:   no buffers: WHEEL_SIDES triangles for the top, twice as many for the rim. In its own space the top is the
 *          unit disc at y = 0, and the rim goes down to y = -1.
 * Units:   eye space mm; linear light.
 */
#ifndef GLAISE_VIEW_WHEEL_SHADER_H
#define GLAISE_VIEW_WHEEL_SHADER_H

inline constexpr char wheel_shader_vertex[] = R"(
uniform mat4 u_eye_from_wheel;
uniform mat3 u_eye_normal;
uniform mat4 u_clip_from_eye;
uniform int u_sides;
out vec3 v_eye;
centroid out vec3 v_normal;
out vec3 v_place;

void main()
{
    int triangle = gl_VertexID / 3, corner = gl_VertexID % 3;
    bool top = triangle < u_sides;
    int side = top ? triangle : (triangle - u_sides) / 2;
    bool second = !top && ((triangle - u_sides) & 1) == 1;
    /* top: middle, next, this; rim: this, next, this below; next, next below, this below */
    bool next = top ? corner == 1 : (second ? corner != 2 : corner == 1);
    bool low = !top && (second ? corner != 0 : corner == 2);
    float angle = 6.28318531 * float(side + (next ? 1 : 0)) / float(u_sides);
    vec3 round = vec3(sin(angle), 0.0, cos(angle));
    v_place = top && corner == 0 ? vec3(0.0) : round + vec3(0.0, low ? -1.0 : 0.0, 0.0);
    v_normal = u_eye_normal * (top ? vec3(0.0, 1.0, 0.0) : round);
    vec4 eye = u_eye_from_wheel * vec4(v_place, 1.0);
    v_eye = eye.xyz;
    gl_Position = u_clip_from_eye * eye;
}
)";

inline constexpr char wheel_shader_fragment[] = R"(
in vec3 v_eye;
centroid in vec3 v_normal;
in vec3 v_place;
uniform float u_ambient; /* of the material, as on clay */
uniform int u_look; /* as enum snapshot_look */
layout(location = 0) out vec4 f_colour;

const vec3 SLATE = vec3(0.050, 0.048, 0.047);

void main()
{
    vec3 n = normalize(v_normal), v = -normalize(v_eye);
    float out_at = length(v_place.xz), ring = out_at * 14.0, wide = fwidth(ring);
    float groove = v_place.y < 0.0 ? 0.0 : 1.0 - smoothstep(0.03, 0.03 + wide + 0.02, abs(fract(ring) - 0.5));
    float edge = smoothstep(0.985 - fwidth(out_at), 0.985, out_at);
    vec3 slate = SLATE * (1.0 - 0.16 * groove * (1.0 - smoothstep(0.25, 0.8, wide))) * (1.0 + 0.8 * edge);
    vec2 open = hollow(-v_eye.z);
    vec3 light = irradiance(n) * u_ambient * SKY_STRENGTH * open.x;
    if (u_look == 3)
        light = vec3(0.06 * open.x);
    for (int i = 0; i < u_light_count; i++) {
        vec3 toward = normalize(u_light_place[i] - v_eye);
        float seen = i == 0 ? shadowed(v_eye, n, toward) : 1.0;
        float shine = pow(max(dot(n, normalize(toward + v)), 0.0), 24.0) * 0.5;
        light += u_light_colour[i] * (max(dot(n, toward), 0.0) * seen * mix(1.0, open.x, 0.4) + shine * seen);
    }
    f_colour = vec4(film(slate * light), 1.0);
}
)";

#endif
