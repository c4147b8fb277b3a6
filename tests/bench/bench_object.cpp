/* SPDX-License-Identifier: Apache-2.0 */
#include "bench_object.h"

#include "clay/colour.h"

#include <cmath>

const bench_object_pose bench_object_poses[bench_object_pose_count] = {
    {"small best", 2.96, {0, 0, 0}, {0, 0, 0}, 216, 125, 93, 184, "19-23"},
    {"small worst", 2.96, {.6036, .3678, .0491}, {-2.4302, .5819, .6214}, 1331, 203, 110, 209, "19-23"},
    {"medium best", 4.95, {.7401, .0320, .9664}, {.0040, -.0037, -.0305}, 1452, 887, 501, 751, "7-8"},
    {"medium worst", 4.95, {.5241, .8226, .9114}, {-.9053, 1.8323, 1.0283}, 4352, 975, 508, 771, "7-8"},
    {"large best", 6.21, {0, 0, 0}, {0, 0, 0}, 2744, 2197, 1021, 1424, "3-4"},
    {"large worst", 6.21, {.1221, .6884, .1044}, {-.2548, .4656, .9051}, 8316, 1919, 1003, 1407, "3-4"},
};

namespace {

constexpr double pi = 3.14159265358979323846;

/* splitmix64: the same numbers everywhere. */
struct seeded {
    uint64_t state;
    double next(double from, double to)
    {
        uint64_t z = state += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        z ^= z >> 31;
        return from + (to - from) * static_cast<double>(z >> 11) * 0x1p-53;
    }
};

/* Golden-angle spiral from pole to pole: n of count directions, evenly spread. */
void direction(int n, int count, double out[3])
{
    const double z = 1 - (2 * n + 1.0) / count, ring = std::sqrt(1 - z * z), turn = n * pi * (3 - std::sqrt(5.0));
    out[0] = ring * std::cos(turn);
    out[1] = ring * std::sin(turn);
    out[2] = z;
}

/* Distance from the origin at which a ray enters the clay from outside; 0 when it never does. */
double distance_to_surface(const clay &c, const double towards[3], double from)
{
    for (double r = from; r > 0; r -= 0.25) {
        const key at = {static_cast<int32_t>(std::lround(towards[0] * r)),
                        static_cast<int32_t>(std::lround(towards[1] * r)),
                        static_cast<int32_t>(std::lround(towards[2] * r))};
        if (clay_read(&c, at, nullptr) >= POTENTIAL_ISO)
            return r;
    }
    return 0;
}

double radius_of(const clay &c)
{
    const box b = clay_box(&c);
    double r = 0;
    for (const int32_t k : {b.min.i, b.min.j, b.min.k, b.max.i, b.max.j, b.max.k})
        r = std::fmax(r, std::fabs(static_cast<double>(k)));
    return r * std::sqrt(3.0) + 1;
}

struct blob {
    double centre[3], semi[3];
    int dabs;
    uint32_t rgba;
};

/* Belly, head, ears, nose, arms, legs, round the origin. Times `scale` it has as many corners as the paper's object. */
constexpr double scale = 1.0353;
const blob character[] = {
    {{0, 0, 0}, {12.6, 11.4, 12.6}, 6, colour_pack(200, 120, 80, 255)},
    {{0, 0, 15.5}, {9, 8.6, 9}, 6, colour_pack(220, 180, 150, 255)},
    {{6.5, 0, 23}, {3.6, 3, 4.4}, 5, colour_pack(180, 90, 70, 255)},
    {{-6.5, 0, 23}, {3.6, 3, 4.4}, 5, colour_pack(180, 90, 70, 255)},
    {{0, -9, 15}, {3, 3.4, 3}, 5, colour_pack(230, 40, 40, 255)},
    {{13, -3, 4}, {7.4, 4, 4.4}, 6, colour_pack(200, 120, 80, 255)},
    {{-13, -3, 4}, {7.4, 4, 4.4}, 6, colour_pack(200, 120, 80, 255)},
    {{6, -8, -11}, {4.8, 7.6, 4.6}, 6, colour_pack(90, 110, 200, 255)},
    {{-6, -8, -11}, {4.8, 7.6, 4.6}, 6, colour_pack(90, 110, 200, 255)},
};

bench_object_dab dab_of(const double centre[3], const double semi[3], const double turn[3], action kind, double amount,
                        uint32_t rgba)
{
    return {kind, rgba, {bench_object_frame(centre, semi, turn), amount, 0}};
}

} // namespace

frame bench_object_frame(const double centre[3], const double semi[3], const double turn[3])
{
    const double angle = std::sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]);
    const double u[3] = {angle > 0 ? turn[0] / angle : 1, angle > 0 ? turn[1] / angle : 0,
                         angle > 0 ? turn[2] / angle : 0};
    const double cosine = std::cos(angle), sine = std::sin(angle);
    frame f;
    for (int a = 0; a < 3; a++) {
        f.origin[a] = centre[a];
        /* Column a of the rotation (Rodrigues): where tool axis a points. */
        for (int c = 0; c < 3; c++) {
            const int other = 3 - a - c;
            const double across = a == c ? 0 : ((c - a + 3) % 3 == 1 ? u[other] : -u[other]);
            f.axis[a][c] = semi[a] * (u[a] * u[c] * (1 - cosine) + (a == c ? cosine : 0) + across * sine);
        }
    }
    return f;
}

bench_object_dab bench_object_pose_dab(const bench_object_pose &pose, key at, action kind, double amount)
{
    const double centre[3] = {pose.centre[0] + at.i, pose.centre[1] + at.j, pose.centre[2] + at.k};
    const double semi[3] = {pose.radius, pose.radius, pose.radius};
    return dab_of(centre, semi, pose.turn, kind, amount, colour_pack(240, 200, 60, 255));
}

std::vector<bench_object_dab> bench_object_character()
{
    seeded random{2000};
    std::vector<bench_object_dab> dabs;
    for (const blob &part : character)
        for (int n = 0; n < part.dabs; n++) {
            double centre[3], semi[3], turn[3];
            for (int a = 0; a < 3; a++) {
                centre[a] = scale * part.centre[a] + random.next(-0.6, 0.6);
                semi[a] = scale * part.semi[a];
                turn[a] = random.next(-0.2, 0.2);
            }
            dabs.push_back(dab_of(centre, semi, turn, ACTION_TOOTHPASTE, 2.0, part.rgba));
        }
    return dabs;
}

std::vector<bench_object_dab> bench_object_million(double times)
{
    seeded random{1};
    std::vector<bench_object_dab> dabs;
    for (int n = 0; n < 500; n++) {
        double towards[3], centre[3], semi[3], turn[3];
        direction(n, 500, towards);
        const double depth = 48 * std::cbrt(random.next(0, 1));
        const uint32_t rgba = colour_pack(static_cast<unsigned>(random.next(60, 255)),
                                          static_cast<unsigned>(random.next(60, 255)), 120, 255);
        for (int a = 0; a < 3; a++) {
            centre[a] = times * towards[a] * depth;
            semi[a] = times * random.next(14, 24);
            turn[a] = random.next(-pi, pi);
        }
        dabs.push_back(dab_of(centre, semi, turn, ACTION_TOOTHPASTE, 1.5, rgba));
    }
    return dabs;
}

std::vector<key> bench_object_sites(const clay &c, int count)
{
    std::vector<key> sites;
    const double from = radius_of(c);
    for (int n = 0; n < count; n++) {
        double towards[3];
        direction(n, count, towards);
        const double r = distance_to_surface(c, towards, from);
        sites.push_back({static_cast<int32_t>(std::lround(towards[0] * r)),
                         static_cast<int32_t>(std::lround(towards[1] * r)),
                         static_cast<int32_t>(std::lround(towards[2] * r))});
    }
    return sites;
}

std::vector<bench_object_dab> bench_object_spiral(const clay &c, double radius, double amount, int count)
{
    constexpr double step = 0.76, climb = 0.02; /* lattice steps between dabs; radians up per radian round */
    seeded random{static_cast<uint64_t>(radius * 1000)};
    const double semi[3] = {1.25 * radius, radius, 0.8 * radius}, from = radius_of(c);
    double round = random.next(0, 2 * pi), up = random.next(-0.5, 0.5), turn[3] = {0, 0, 0};
    std::vector<bench_object_dab> dabs;
    for (int n = 0; n < count; n++) {
        const double towards[3] = {std::cos(up) * std::cos(round), std::cos(up) * std::sin(round), std::sin(up)};
        const double r = distance_to_surface(c, towards, from);
        const double centre[3] = {towards[0] * r, towards[1] * r, towards[2] * r};
        for (double &t : turn)
            t += random.next(0, 0.1);
        const unsigned shade = static_cast<unsigned>(n) * 40 & 255u;
        dabs.push_back(dab_of(centre, semi, turn, ACTION_TOOTHPASTE, amount, colour_pack(shade, 255 - shade, 90, 255)));
        const double turned = step / (r > 1 ? r * std::cos(up) : 1);
        round += turned;
        up += climb * turned;
    }
    return dabs;
}
