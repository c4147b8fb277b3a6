/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What all stages share: sRGB to linear light and back, and the roll-off of bright light.
 * Is not:  The encoding of the finished picture: the sRGB framebuffer does that (canvas.h).
 * Shape:   highlight() leaves light under KNEE as it is, so that clay in ordinary light shows the colour that was
 *          chosen, and bends the rest smoothly towards 1, as film does.
 * Units:   linear light, 1 = the brightest a screen shows.
 */
#ifndef GLAISE_VIEW_COLOUR_SHADER_H
#define GLAISE_VIEW_COLOUR_SHADER_H

inline constexpr char colour_shader_text[] = R"(
vec3 linear_of(vec3 encoded)
{
    return mix(encoded / 12.92, pow((encoded + 0.055) / 1.055, vec3(2.4)), step(0.04045, encoded));
}
vec3 encoded_of(vec3 light)
{
    return mix(light * 12.92, 1.055 * pow(max(light, 0.0), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light));
}
const float KNEE = 0.55;
vec3 highlight(vec3 light)
{
    vec3 over = max(light - KNEE, 0.0) / (1.0 - KNEE);
    return min(light, KNEE) + (1.0 - KNEE) * (1.0 - exp(-over));
}
)";

#endif
