/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The stages for thin lines: each a rectangle on the screen whose long borders fade out, one instance a line.
 * Is not:  Which lines (hairline.h). The fragment stage needs colour_shader.h before it.
 * Shape:   a rectangle is a pixel wider than the line: half a pixel on either side is where the line fades, so that it
 *          is smooth without multisampling, and any width can be had where the device draws lines of one pixel only.
 *          What of a line lies before the near plane is cut off here: behind the eye there is no place on the screen.
 * Units:   pixels, millimetres, linear light.
 */
#ifndef GLAISE_VIEW_HAIRLINE_SHADER_H
#define GLAISE_VIEW_HAIRLINE_SHADER_H

inline constexpr char hairline_shader_vertex[] = R"(
layout(location = 0) in vec3 a_from; /* on the unit sphere it is its own normal */
layout(location = 1) in vec3 a_into;
layout(location = 2) in vec4 a_colour;
uniform mat4 u_eye_from_lines;
uniform mat3 u_eye_normal;
uniform mat4 u_clip_from_eye;
uniform vec2 u_viewport; /* pixels */
uniform float u_width;   /* likewise */
out vec3 v_eye;
out vec3 v_normal;
out vec4 v_colour;
out float v_across; /* pixels from the line's middle */

void main()
{
    vec4 eye[2], clip[2];
    eye[0] = u_eye_from_lines * vec4(a_from, 1.0);
    eye[1] = u_eye_from_lines * vec4(a_into, 1.0);
    clip[0] = u_clip_from_eye * eye[0];
    clip[1] = u_clip_from_eye * eye[1];
    vec2 ahead = vec2(clip[0].z + clip[0].w, clip[1].z + clip[1].w); /* negative: before the near plane */
    int end = gl_VertexID >> 1, other = 1 - end;
    vec4 at[2];
    for (int n = 0; n < 2; n++)
        at[n] = ahead[n] < 0.0 && ahead[1 - n] > 0.0 ? mix(clip[n], clip[1 - n], ahead[n] / (ahead[n] - ahead[1 - n]))
                                                     : clip[n];
    v_eye = eye[end].xyz;
    v_normal = u_eye_normal * (end == 0 ? a_from : a_into);
    v_colour = a_colour;
    float half_width = 0.5 * u_width + 0.5;
    v_across = half_width * float(2 * (gl_VertexID & 1) - 1);
    vec2 along = (at[1].xy / at[1].w - at[0].xy / at[0].w) * u_viewport;
    vec2 across = vec2(-along.y, along.x) * inversesqrt(max(dot(along, along), 1e-12));
    gl_Position = at[end];
    gl_Position.xy += across * v_across * 2.0 / u_viewport * at[end].w;
    if (max(ahead.x, ahead.y) <= 0.0)
        gl_Position = vec4(0.0, 0.0, 2.0, 1.0); /* all of it: drawn nowhere */
}
)";

inline constexpr char hairline_shader_fragment[] = R"(
in vec3 v_eye;
in vec3 v_normal;
in vec4 v_colour;
in float v_across;
layout(location = 0) out vec4 f_colour;
uniform float u_width;
uniform float u_away; /* part of the alpha that is left where the normal turns away from the viewer */
uniform float u_dash; /* pixels; 0: no dashes */

void main()
{
    float alpha = v_colour.a * clamp(0.5 * u_width + 0.5 - abs(v_across), 0.0, 1.0);
    if (u_away < 1.0) {
        float facing = dot(v_normal, -normalize(v_eye)) * inversesqrt(max(dot(v_normal, v_normal), 1e-20));
        alpha *= mix(u_away, 1.0, smoothstep(-0.25, 0.25, facing));
    }
    if (u_dash > 0.0) {
        float at = abs(2.0 * fract((gl_FragCoord.x + gl_FragCoord.y) / u_dash) - 1.0);
        alpha *= smoothstep(0.30, 0.30 + 2.0 / u_dash, at);
    }
    f_colour = vec4(highlight(v_colour.rgb), alpha);
}
)";

#endif
