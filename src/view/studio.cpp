/* SPDX-License-Identifier: Apache-2.0 */
#include "view/studio.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

struct soft_box {
    glm::dvec3 toward;    /* where its middle is */
    glm::dvec2 half_size; /* as seen on a plane at distance 1 */
    double edge;          /* width of its soft edge, likewise */
    glm::dvec3 light;
};

const soft_box boxes[] = {
    {{-0.62, 0.62, 0.62}, {0.50, 0.62}, 0.22, {2.70, 2.60, 2.45}}, /* key: large, left of the camera */
    {{0.97, 0.20, -0.05}, {0.16, 0.80}, 0.13, {1.30, 1.40, 1.60}}, /* rim: a tall strip on the right */
    {{0.10, 0.98, -0.35}, {0.80, 0.26}, 0.22, {0.50, 0.50, 0.50}}, /* top: faint, wide */
};

const glm::dvec3 zenith{0.060, 0.068, 0.082}, wall{0.46, 0.45, 0.43}, floor_near{0.060, 0.050, 0.043},
    floor_far{0.29, 0.255, 0.225};

double step_smooth(double from, double to, double x)
{
    double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

glm::dvec3 box_light(const soft_box &b, const glm::dvec3 &r)
{
    const glm::dvec3 out = glm::normalize(b.toward);
    const double ahead = glm::dot(r, out);
    if (ahead <= 0)
        return glm::dvec3(0);
    const glm::dvec3 across = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), out));
    const glm::dvec3 up = glm::cross(out, across);
    const glm::dvec2 at(glm::dot(r, across) / ahead, glm::dot(r, up) / ahead);
    const glm::dvec2 over = glm::max(glm::abs(at) - b.half_size + b.edge, glm::dvec2(0)); /* rounded corners */
    const double inside = 1 - step_smooth(0, b.edge, glm::length(over));
    const double hot = 1 - 0.6 * glm::dot(at / b.half_size, at / b.half_size) / 2; /* the lamp behind the cloth */
    return b.light * (inside * hot);
}

glm::dvec3 room_light(const glm::dvec3 &r)
{
    /* Both halves meet within a few degrees of the horizon: a paper roll has no corner. */
    const glm::dvec3 above = glm::mix(wall, zenith, step_smooth(-0.1, 0.75, r.y));
    const glm::dvec3 below = glm::mix(floor_far, floor_near, step_smooth(0.0, 0.75, -r.y));
    return glm::mix(below, above, step_smooth(-0.06, 0.06, r.y));
}

using level = std::vector<glm::vec4>;

level first_level()
{
    const double side = STUDIO_SIDE;
    level texels(size_t{STUDIO_SIDE} * STUDIO_SIDE);
    for (int y = 0; y < STUDIO_SIDE; y++) {
        for (int x = 0; x < STUDIO_SIDE; x++) {
            const auto light = studio_light(studio_direction({(x + 0.5) / side, (y + 0.5) / side}));
            texels[static_cast<size_t>(y) * STUDIO_SIDE + static_cast<size_t>(x)] =
                glm::vec4(light[0], light[1], light[2], 1);
        }
    }
    return texels;
}

/* By the mean of four: OpenGL makes no mipmaps of half floats everywhere. */
level halved(const level &fine, size_t side)
{
    const size_t half = side / 2;
    level texels(half * half);
    for (size_t y = 0; y < half; y++)
        for (size_t x = 0; x < half; x++)
            texels[y * half + x] = 0.25f * (fine[2 * y * side + 2 * x] + fine[2 * y * side + 2 * x + 1] +
                                            fine[(2 * y + 1) * side + 2 * x] + fine[(2 * y + 1) * side + 2 * x + 1]);
    return texels;
}

} // namespace

std::array<double, 3> studio_light(const std::array<double, 3> &direction)
{
    const glm::dvec3 r(direction[0], direction[1], direction[2]);
    glm::dvec3 light = room_light(r);
    for (const soft_box &b : boxes)
        light += box_light(b, r);
    return {light.x, light.y, light.z};
}

std::array<double, 2> studio_place(const std::array<double, 3> &r)
{
    const double m = 2 * std::sqrt(r[0] * r[0] + r[1] * r[1] + (r[2] + 1) * (r[2] + 1));
    if (m < 1e-12)
        return {1, 0.5};
    return {r[0] / m + 0.5, r[1] / m + 0.5};
}

std::array<double, 3> studio_direction(const std::array<double, 2> &place)
{
    const double x = 2 * place[0] - 1, y = 2 * place[1] - 1;
    const double square = x * x + y * y;
    if (square >= 1)
        return {0, 0, -1}; /* the corners of the map: what the whole rim shows */
    const double z = std::sqrt(1 - square);
    return {2 * z * x, 2 * z * y, 2 * z * z - 1};
}

bool studio_open(GLuint *texture_out, std::string *trouble_out)
{
    while (glGetError() != GL_NO_ERROR) {
    }
    GLint levels = 1;
    while ((STUDIO_SIDE >> levels) > 0)
        levels++;
    glGenTextures(1, texture_out);
    glBindTexture(GL_TEXTURE_2D, *texture_out);
    glTexStorage2D(GL_TEXTURE_2D, levels, GL_RGBA16F, STUDIO_SIDE, STUDIO_SIDE);
    level texels = first_level();
    for (GLint i = 0, side = STUDIO_SIDE; i < levels; i++, side /= 2) {
        if (i > 0)
            texels = halved(texels, static_cast<size_t>(side) * 2);
        glTexSubImage2D(GL_TEXTURE_2D, i, 0, 0, side, side, GL_RGBA, GL_FLOAT, texels.data());
    }
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
    if (glGetError() == GL_NO_ERROR)
        return true;
    *trouble_out = "the device has no memory for the environment's picture";
    glDeleteTextures(1, texture_out);
    *texture_out = 0;
    return false;
}
