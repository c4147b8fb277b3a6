/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What all stages share: sRGB to linear light and back, and how bright light is brought under a
 *          screen's white.
 * Is not:  The encoding of the finished picture: the sRGB framebuffer does that (canvas.h).
 * Shape:   highlight() leaves light under KNEE as it is, channel by channel, and bends the rest smoothly towards 1: for
 *          the papers' look and for what is drawn beside the clay.
 *          film() is the clay's: as film has them, a toe that deepens what is dark and a shoulder that bends what is
 *          bright, of the brightest channel, so that the hue stays; what would have gone far over white pales.
 *
 *              toe        x^2 / (x + TOE)
 *              shoulder   over KNEE: KNEE + (1 - KNEE) (1 - exp(-(x - KNEE) / (1 - KNEE)))
 *              paling     towards white by 1 - 1 / (1 + PALING (x before - x after))
 *
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
/* Even noise in 0..1, the same for the same pixel. */
float unrest(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }
const float KNEE = 0.55;
vec3 highlight(vec3 light)
{
    vec3 over = max(light - KNEE, 0.0) / (1.0 - KNEE);
    return min(light, KNEE) + (1.0 - KNEE) * (1.0 - exp(-over));
}
const float TOE = 0.012;
const float PALING = 0.35;
vec3 film(vec3 light)
{
    light = max(light, 0.0);
    light = light * light / (light + TOE);
    float brightest = max(max(light.r, light.g), light.b);
    if (brightest <= KNEE)
        return light;
    float bent = KNEE + (1.0 - KNEE) * (1.0 - exp(-(brightest - KNEE) / (1.0 - KNEE)));
    float pale = 1.0 - 1.0 / (1.0 + PALING * (brightest - bent));
    return mix(light * (bent / brightest), vec3(bent), pale);
}
)";

#endif
