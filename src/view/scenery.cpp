/* SPDX-License-Identifier: Apache-2.0 */
#include "view/scenery.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using glm::dvec2;
using glm::dvec3;

/* A lamp with a rectangular cloth before it, or a window. */
struct soft_box {
    dvec3 toward;    /* where its middle is */
    dvec2 half_size; /* as seen on a plane at distance 1 */
    double edge;     /* width of its soft edge, likewise */
    dvec3 light;
    double hot;      /* how much darker its corners are: the lamp behind the cloth */
};

double step_smooth(double from, double to, double x)
{
    double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/* Where a direction meets the plane of a box, in the box's own axes; false: behind it. */
bool on_plane(const dvec3 &toward, const dvec3 &r, dvec2 *at_out)
{
    const dvec3 out = glm::normalize(toward);
    const double ahead = glm::dot(r, out);
    if (ahead <= 0)
        return false;
    const dvec3 across = glm::normalize(glm::cross(dvec3(0, 1, 0), out));
    *at_out = dvec2(glm::dot(r, across) / ahead, glm::dot(r, glm::cross(out, across)) / ahead);
    return true;
}

dvec3 box_light(const soft_box &b, const dvec3 &r)
{
    dvec2 at;
    if (!on_plane(b.toward, r, &at))
        return dvec3(0);
    const dvec2 over = glm::max(glm::abs(at) - b.half_size + b.edge, dvec2(0)); /* rounded corners */
    const double inside = 1 - step_smooth(0, b.edge, glm::length(over));
    return b.light * (inside * (1 - b.hot * glm::dot(at / b.half_size, at / b.half_size) / 2));
}

/* A room without lamps: both halves meet within a few degrees of the horizon, as a paper roll has no corner. */
struct walls {
    dvec3 zenith, wall, floor_far, floor_near;
};

dvec3 walls_light(const walls &w, const dvec3 &r)
{
    const dvec3 above = glm::mix(w.wall, w.zenith, step_smooth(-0.1, 0.75, r.y));
    const dvec3 below = glm::mix(w.floor_far, w.floor_near, step_smooth(0.0, 0.75, -r.y));
    return glm::mix(below, above, step_smooth(-0.06, 0.06, r.y));
}

/* A photographer's: a large soft key left of the camera, a tall strip on the right, a faint wide one above. */
dvec3 studio(const dvec3 &r)
{
    static const soft_box boxes[] = {
        {{-0.62, 0.62, 0.62}, {0.50, 0.62}, 0.22, {2.70, 2.60, 2.45}, 0.6},
        {{0.97, 0.20, -0.05}, {0.16, 0.80}, 0.13, {1.30, 1.40, 1.60}, 0.6},
        {{0.10, 0.98, -0.35}, {0.80, 0.26}, 0.22, {0.50, 0.50, 0.50}, 0.6},
    };
    dvec3 light =
        walls_light({{0.060, 0.068, 0.082}, {0.46, 0.45, 0.43}, {0.29, 0.255, 0.225}, {0.060, 0.050, 0.043}}, r);
    for (const soft_box &b : boxes)
        light += box_light(b, r);
    return light;
}

/* A white room by day: one tall window with a cross of bars, its light on the opposite wall, a wooden floor. */
dvec3 window(const dvec3 &r)
{
    static const dvec3 toward(-0.80, 0.36, 0.46);
    static const soft_box panes{toward, {0.46, 0.62}, 0.03, {4.2, 4.7, 5.6}, 0.15};
    static const soft_box glow{{0.9, 0.1, 0.3}, {0.9, 0.7}, 0.6, {0.34, 0.31, 0.26}, 0.2};
    dvec3 light = walls_light({{0.20, 0.21, 0.23}, {0.27, 0.26, 0.25}, {0.22, 0.16, 0.11}, {0.13, 0.085, 0.052}}, r);
    dvec2 at;
    if (on_plane(toward, r, &at)) {
        const double bars = step_smooth(0.012, 0.03, std::abs(at.x)) * step_smooth(0.012, 0.03, std::abs(at.y - 0.18));
        const double ground = step_smooth(-0.35, -0.2, at.y); /* what is outside: hedge below, sky above */
        light += box_light(panes, r) * bars * glm::mix(dvec3(0.20, 0.26, 0.16), dvec3(1), ground);
    }
    return light + box_light(glow, r);
}

/* Parallel tubes in the dark, as inspectors of car bodies have them: where they bend, the clay bends. */
dvec3 strips(const dvec3 &r)
{
    const double across = std::asin(std::clamp(r.x, -1.0, 1.0)) * (180 / std::numbers::pi);
    const double wave = std::abs(std::remainder(across - 7.5, 15.0)); /* degrees from a tube; none right behind */
    const double tube = 1 - step_smooth(2.2, 3.2, wave);
    const double high = 0.35 + 0.65 * step_smooth(-0.9, 0.2, r.y);
    return dvec3(0.030, 0.032, 0.036) + dvec3(1.75, 1.78, 1.85) * (tube * high);
}

/* One warm lamp from above right, a cold moon far left behind, and nothing else. */
dvec3 night(const dvec3 &r)
{
    static const soft_box lamp{{0.55, 0.70, 0.46}, {0.24, 0.24}, 0.12, {9.5, 6.1, 2.9}, 0.4};
    static const soft_box moon{{-0.85, 0.42, -0.32}, {0.20, 0.55}, 0.16, {0.55, 0.85, 1.60}, 0.3};
    const dvec3 dark =
        walls_light({{0.010, 0.013, 0.022}, {0.030, 0.030, 0.040}, {0.060, 0.042, 0.027}, {0.085, 0.055, 0.030}}, r);
    return dark + box_light(lamp, r) + box_light(moon, r);
}

double linear_of(double encoded) /* IEC 61966-2-1 */
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

dvec3 pixel_light(const scenery_picture &own, int x, int y)
{
    x = std::clamp(x, 0, own.width - 1);
    y = std::clamp(y, 0, own.height - 1);
    const size_t at = (static_cast<size_t>(y) * static_cast<size_t>(own.width) + static_cast<size_t>(x)) * 4;
    dvec3 light;
    for (int c = 0; c < 3; c++)
        light[c] = linear_of(own.rgba[at + static_cast<size_t>(c)] / 255.0);
    const double brightest = std::max({light.x, light.y, light.z});
    return light * (1 + 3 * std::pow(brightest, 8)); /* nearly white: a lamp */
}

bool is_panorama(const scenery_picture &own) { return own.width * 10 > own.height * 15; }

dvec3 vector_of(const scenery_vector &v) { return {v[0], v[1], v[2]}; }
scenery_vector array_of(const dvec3 &v) { return {v.x, v.y, v.z}; }

/* --- the map's levels --- */

struct level {
    int side;
    std::vector<glm::vec4> texels;

    const glm::vec4 &at(int x, int y) const
    {
        x = std::clamp(x, 0, side - 1);
        y = std::clamp(y, 0, side - 1);
        return texels[static_cast<size_t>(y) * static_cast<size_t>(side) + static_cast<size_t>(x)];
    }
    dvec3 light(const dvec3 &r) const
    {
        const auto place = scenery_place(array_of(r));
        const double x = place[0] * side - 0.5, y = place[1] * side - 0.5;
        const int left = static_cast<int>(std::floor(x)), low = static_cast<int>(std::floor(y));
        const auto a = static_cast<float>(x - left), b = static_cast<float>(y - low);
        return dvec3(glm::mix(glm::mix(at(left, low), at(left + 1, low), a),
                              glm::mix(at(left, low + 1), at(left + 1, low + 1), a), b));
    }
};

level level_make(int side, const std::function<dvec3(const dvec3 &)> &light)
{
    level l{side, std::vector<glm::vec4>(static_cast<size_t>(side) * static_cast<size_t>(side))};
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++) {
            const dvec3 r = vector_of(scenery_direction({(x + 0.5) / side, (y + 0.5) / side}));
            l.texels[static_cast<size_t>(y) * static_cast<size_t>(side) + static_cast<size_t>(x)] =
                glm::vec4(glm::vec3(light(r)), 1);
        }
    return l;
}

/* Directions of a GGX lobe seen along its own normal, about +z, by their weight; a lattice of points, not chance. */
std::vector<dvec3> lobe(double roughness, int count)
{
    std::vector<dvec3> out;
    const double alpha = roughness * roughness, golden = std::numbers::phi;
    for (int n = 0; n < count; n++) {
        const double u = (n + 0.5) / count, turn = 2 * std::numbers::pi * std::fmod(n * golden, 1.0);
        const double half = std::sqrt((1 - u) / (1 + (alpha * alpha - 1) * u)); /* cosine of the half vector */
        const double sine = std::sqrt(std::max(0.0, 1 - half * half));
        const dvec3 h(sine * std::cos(turn), sine * std::sin(turn), half);
        const dvec3 l = 2 * h.z * h - dvec3(0, 0, 1);
        if (l.z > 0)
            out.push_back(l);
    }
    return out;
}

/* From the level before: it is smooth already, so that few directions do. What is widened twice is a little too wide,
   so the lobe is that of the difference. */
level level_rough(const level &finer, double roughness_before, double roughness)
{
    const double a = roughness * roughness, b = roughness_before * roughness_before;
    const std::vector<dvec3> around = lobe(std::sqrt(std::sqrt(a * a - b * b)), 40);
    return level_make(finer.side / 2, [&](const dvec3 &r) {
        const dvec3 aside = glm::normalize(glm::cross(std::abs(r.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0), r));
        const dvec3 up = glm::cross(r, aside);
        dvec3 sum(0);
        double weight = 0;
        for (const dvec3 &l : around) {
            sum += l.z * finer.light(l.x * aside + l.y * up + l.z * r);
            weight += l.z;
        }
        return sum / weight;
    });
}

/* By the mean of four: OpenGL makes no mipmaps of half floats everywhere. */
level level_halved(const level &fine)
{
    level l{fine.side / 2, {}};
    for (int y = 0; y < l.side; y++)
        for (int x = 0; x < l.side; x++)
            l.texels.push_back(0.25f * (fine.at(2 * x, 2 * y) + fine.at(2 * x + 1, 2 * y) + fine.at(2 * x, 2 * y + 1) +
                                        fine.at(2 * x + 1, 2 * y + 1)));
    return l;
}

GLuint texture_of(const std::vector<level> &levels)
{
    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexStorage2D(GL_TEXTURE_2D, static_cast<GLsizei>(levels.size()), GL_RGBA16F, levels[0].side, levels[0].side);
    for (size_t n = 0; n < levels.size(); n++)
        glTexSubImage2D(GL_TEXTURE_2D, static_cast<GLint>(n), 0, 0, levels[n].side, levels[n].side, GL_RGBA, GL_FLOAT,
                        levels[n].texels.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
    return name;
}

/* The nine real functions, to the second order. */
std::array<double, SCENERY_COEFFICIENTS> harmonics(const dvec3 &n)
{
    return {0.282095,
            0.488603 * n.y,
            0.488603 * n.z,
            0.488603 * n.x,
            1.092548 * n.x * n.y,
            1.092548 * n.y * n.z,
            0.315392 * (3 * n.z * n.z - 1),
            1.092548 * n.x * n.z,
            0.546274 * (n.x * n.x - n.y * n.y)};
}

} // namespace

scenery_vector scenery_light(snapshot_scenery which, const scenery_vector &direction)
{
    const dvec3 r = vector_of(direction);
    switch (which) {
    case SNAPSHOT_SCENERY_WINDOW: return array_of(window(r));
    case SNAPSHOT_SCENERY_STRIPS: return array_of(strips(r));
    case SNAPSHOT_SCENERY_NIGHT: return array_of(night(r));
    default: return array_of(studio(r));
    }
}

scenery_vector scenery_light_own(const scenery_picture &own, const scenery_vector &direction)
{
    double s, t; /* 0..1, t from the top */
    if (is_panorama(own)) {
        s = 0.5 + std::atan2(direction[0], -direction[2]) / (2 * std::numbers::pi);
        t = std::acos(std::clamp(direction[1], -1.0, 1.0)) / std::numbers::pi;
    } else {
        const auto place = scenery_place(direction);
        s = place[0];
        t = 1 - place[1];
    }
    const double x = s * own.width - 0.5, y = t * own.height - 0.5;
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
    const dvec3 upper = glm::mix(pixel_light(own, left, top), pixel_light(own, left + 1, top), x - left);
    const dvec3 lower = glm::mix(pixel_light(own, left, top + 1), pixel_light(own, left + 1, top + 1), x - left);
    return array_of(glm::mix(upper, lower, y - top));
}

std::array<std::array<float, 3>, SCENERY_COEFFICIENTS>
scenery_irradiance(const std::function<scenery_vector(const scenery_vector &)> &light)
{
    constexpr int count = 8192;
    /* The cosine's own coefficients over pi: 1, 2/3, 1/4 by order. */
    constexpr double cosine[SCENERY_COEFFICIENTS] = {1, 2. / 3, 2. / 3, 2. / 3, .25, .25, .25, .25, .25};
    std::array<dvec3, SCENERY_COEFFICIENTS> sum{};
    for (int n = 0; n < count; n++) {
        const double z = 1 - (2 * n + 1.0) / count, aside = std::sqrt(1 - z * z);
        const double turn = 2 * std::numbers::pi * std::fmod(n * std::numbers::phi, 1.0);
        const dvec3 r(aside * std::cos(turn), aside * std::sin(turn), z);
        const auto y = harmonics(r);
        const dvec3 l = vector_of(light(array_of(r)));
        for (size_t i = 0; i < SCENERY_COEFFICIENTS; i++)
            sum[i] += l * (y[i] * 4 * std::numbers::pi / count);
    }
    std::array<std::array<float, 3>, SCENERY_COEFFICIENTS> out{};
    for (size_t i = 0; i < SCENERY_COEFFICIENTS; i++)
        for (int c = 0; c < 3; c++)
            out[i][static_cast<size_t>(c)] = static_cast<float>(sum[i][c] * cosine[i]);
    return out;
}

std::array<double, 2> scenery_place(const scenery_vector &r)
{
    const double m = 2 * std::sqrt(r[0] * r[0] + r[1] * r[1] + (r[2] + 1) * (r[2] + 1));
    if (m < 1e-12)
        return {1, 0.5};
    return {r[0] / m + 0.5, r[1] / m + 0.5};
}

scenery_vector scenery_direction(const std::array<double, 2> &place)
{
    const double x = 2 * place[0] - 1, y = 2 * place[1] - 1;
    const double square = x * x + y * y;
    if (square >= 1)
        return {0, 0, -1}; /* the corners of the map: what the whole rim shows */
    const double z = std::sqrt(1 - square);
    return {2 * z * x, 2 * z * y, 2 * z * z - 1};
}

bool scenery_open(scenery *s, snapshot_scenery which, const scenery_picture &own, std::string *trouble_out)
{
    const bool brought = which == SNAPSHOT_SCENERY_OWN && own.width > 0;
    const auto light = [&](const scenery_vector &r) {
        return brought ? scenery_light_own(own, r) : scenery_light(which, r);
    };
    const double roughest = SCENERY_ROUGHEST;
    *s = {};
    while (glGetError() != GL_NO_ERROR) {
    }
    level l = level_make(SCENERY_SIDE, [&](const dvec3 &r) { return vector_of(light(array_of(r))); });
    s->irradiance = scenery_irradiance([&](const scenery_vector &r) { return array_of(l.light(vector_of(r))); });
    std::vector<level> levels{l};
    while (levels.back().side > 1)
        levels.push_back(level_halved(levels.back()));
    s->mirror = texture_of(levels);
    levels = {levels[1]}; /* a blur needs no finer beginning */
    for (int n = 1; n <= SCENERY_ROUGHEST; n++)
        levels.push_back(level_rough(levels.back(), (n - 1) / roughest, n / roughest));
    s->rough = texture_of(levels);
    if (glGetError() == GL_NO_ERROR)
        return true;
    *trouble_out = "the device has no memory for the scenery's picture";
    scenery_close(s);
    return false;
}

void scenery_close(scenery *s)
{
    glDeleteTextures(1, &s->mirror);
    glDeleteTextures(1, &s->rough);
    *s = {};
}
