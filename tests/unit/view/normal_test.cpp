/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the normals that clay is lit by are those of the shape that was sampled: their error falls with the square of
 *       the lattice step, and packing them for the device adds nothing that is seen. Where the field goes from full to
 *       empty in less than four steps, central differences reach into its flat ends: there the error stays, and has a
 *       bound.
 * Method: a ball and a torus, whose normals are known everywhere, sampled at several steps, off the lattice's middle;
 *         every vertex's normal against the true one there, before and after packing. The packed form is decoded by the
 *         octahedral map's definition, written once more here. The table is printed with the test's output. */
#include "field_fill.h"
#include "view/packed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace {

using point = std::array<double, 3>;

constexpr double degrees = 180 / M_PI;

/* Of size 1: lattice steps are made of it by a row's `scale`. */
struct shape_known {
    const char *name;
    double reach;    /* holds it */
    double tightest; /* smallest radius of curvature */
    double least_steps, most_steps; /* that radius, sampled */
    std::function<double(const point &)> away; /* signed distance, positive outside */
    std::function<point(const point &)> normal;
};

double length_of(const point &p) { return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]); }

point scaled(const point &p, double by) { return {p[0] * by, p[1] * by, p[2] * by}; }

constexpr double tube = 0.4, wheel = 0.8; /* radii of the torus: its tightest curve is that of the tube */

/* From the nearest point of the circle that the tube runs along. */
point from_wheel(const point &p)
{
    const double round = std::hypot(p[0], p[1]);
    const double part = round > 0 ? 1 - wheel / round : 0;
    return {p[0] * part, p[1] * part, p[2]};
}

shape_known ball()
{
    return {"ball", 1, 1, 6, 48, [](const point &p) { return length_of(p) - 1; },
            [](const point &p) { return scaled(p, 1 / length_of(p)); }};
}

shape_known torus()
{
    return {"torus", wheel + tube, tube, 6, 24, [](const point &p) { return length_of(from_wheel(p)) - tube; },
            [](const point &p) { return scaled(from_wheel(p), 1 / length_of(from_wheel(p))); }};
}

/* Potential of a distance in steps: how clay falls off. */
using fall = std::function<double(double away_steps, double scale)>;

/* From full to empty over `width` steps, as a small tool leaves it. */
fall band(double width)
{
    return [width](double away, double) { return POTENTIAL_ISO - away * POTENTIAL_MAX / width; };
}

double wyvill(double rho)
{
    const double q = rho * rho;
    return q >= 1 ? 0 : POTENTIAL_MAX * (1 - q) * (1 - q) * (9 - 4 * q) / 9;
}

/* Toothpaste from Wyvill's ellipsoid, `dabs` times at one place: what is over the maximum is lost. The tool is as large
   as it must be for the surface to lie where the ball's is (surface_at 1), or the torus's about its circle. */
fall wyvill_of(double surface_at, int dabs)
{
    double lo = 0, hi = 1; /* of the tool's reach: where the surface lies */
    for (int n = 0; n < 60; n++) {
        const double at = (lo + hi) / 2;
        (dabs * wyvill(at) > POTENTIAL_ISO ? lo : hi) = at;
    }
    return [surface_at, dabs, lo](double away, double scale) {
        const double rho = std::max(away / scale + surface_at, 0.0) * lo / surface_at;
        return dabs * wyvill(rho);
    };
}

struct errors {
    size_t count = 0;
    double mean = 0, p99 = 0, most = 0;
};

errors summed(std::vector<double> angles)
{
    std::sort(angles.begin(), angles.end());
    errors e;
    e.count = angles.size();
    for (const double a : angles)
        e.mean += a / static_cast<double>(angles.size());
    e.p99 = angles.empty() ? 0 : angles[angles.size() * 99 / 100];
    e.most = angles.empty() ? 0 : angles.back();
    return e;
}

double angle_between(const point &a, const point &b)
{
    const point cross = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return degrees * std::atan2(length_of(cross), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/* Cigolle et al. 2014: the square unfolded on the octahedron. */
point unfolded(const packed_vertex &v)
{
    const double x = std::max(v.normal[0] / 32767.0, -1.0), y = std::max(v.normal[1] / 32767.0, -1.0);
    point n = {x, y, 1 - std::abs(x) - std::abs(y)};
    if (n[2] < 0) {
        n[0] = (1 - std::abs(y)) * (x >= 0 ? 1 : -1);
        n[1] = (1 - std::abs(x)) * (y >= 0 ? 1 : -1);
    }
    return scaled(n, 1 / length_of(n));
}

struct measured {
    double radius = 0;
    errors made, as_packed, packing;
};

const point middle = {0.31, -0.17, 0.43}; /* of the shape: no symmetry of the lattice helps */

struct angles {
    std::vector<double> made, as_packed, packing;
};

void add_patch(angles *to, const patch &p, const std::function<point(const point &)> &right)
{
    packed bytes;
    packed_make(&bytes, p, 0, packed_units(p, false), false);
    for (uint32_t n = 0; n < p.vertex_count; n++) {
        const patch_vertex &v = p.vertices[n];
        const point at = {8.0 * p.at.i + v.position[0], 8.0 * p.at.j + v.position[1], 8.0 * p.at.k + v.position[2]};
        const point is = {v.normal[0], v.normal[1], v.normal[2]}, sent = unfolded(bytes.vertices[n]);
        to->made.push_back(angle_between(is, right(at)));
        to->as_packed.push_back(angle_between(sent, right(at)));
        to->packing.push_back(angle_between(sent, is));
    }
}

/* radius: in steps, the smallest of the shape's radii of curvature. */
measured measure(const shape_known &shape, const fall &falls, double radius)
{
    const double scale = radius / shape.tightest;
    const auto of_size_1 = [&](const point &p) {
        return point{(p[0] - middle[0]) / scale, (p[1] - middle[1]) / scale, (p[2] - middle[2]) / scale};
    };
    /* Wyvill's field goes on as far again as the surface lies from the middle of what it is about. */
    const int32_t reach = static_cast<int32_t>(std::ceil(shape.reach * scale + radius)) + 8;
    const int32_t height = shape.tightest < 1 ? static_cast<int32_t>(2 * radius) + 8 : reach;
    field_fill_piece piece(20000);
    piece.fill({{-reach, -reach, -height}, {reach, reach, height}}, 0xff808080, [&](double x, double y, double z) {
        return falls(shape.away(of_size_1({x, y, z})) * scale, scale);
    });
    piece.finish();
    angles all;
    for (uint32_t slot = 0; slot < surface_slots(&piece.it->surface); slot++)
        if (const patch *p = surface_patch(&piece.it->surface, slot))
            add_patch(&all, *p, [&](const point &at) { return shape.normal(of_size_1(at)); });
    return {radius, summed(all.made), summed(all.as_packed), summed(all.packing)};
}

std::vector<measured> measure_all(const shape_known &shape, const std::string &field, const fall &falls)
{
    std::vector<measured> rows;
    for (double radius = shape.least_steps; radius <= shape.most_steps; radius *= 2) {
        rows.push_back(measure(shape, falls, radius));
        const measured &m = rows.back();
        std::printf("%-6s %-15s %4.0f %7zu   %8.4f %8.4f %8.4f   %8.4f %8.4f %8.4f   %8.5f\n", shape.name,
                    field.c_str(), radius, m.made.count, m.made.mean, m.made.p99, m.made.most, m.as_packed.mean,
                    m.as_packed.p99, m.as_packed.most, m.packing.most);
    }
    return rows;
}

void print_head()
{
    std::printf("%-6s %-15s %4s %7s   %26s   %26s   %8s\n%35s   %8s %8s %8s   %8s %8s %8s   %8s\n", "shape", "field",
                "r", "normals", "the normal's error, degrees", "as the device has it", "packing", "", "mean", "99 %",
                "max", "mean", "99 %", "max", "max");
}

/* A coordinate of the square is off by half a step of 1/32767 at most. On the octahedron's face that is a way of
   sqrt(1 + 1 + 4) half steps, and the face is 1/sqrt(3) away from the middle. */
const double packing_most = degrees * std::sqrt(6.0) * std::sqrt(3.0) * 0.5 / 32767 * 1.01;

void expect_packing_unseen(const std::vector<measured> &rows)
{
    for (const measured &m : rows) {
        EXPECT_GT(m.made.count, 100u);
        EXPECT_LE(m.packing.most, packing_most);
        EXPECT_GT(m.packing.most, 0.5 * packing_most) << "the bound is not an idle one";
    }
}

/* r: smallest radius of curvature, h = 1 step. Central differences of a distance are off by h^2/6 of its third
   derivatives, across the normal 1/8 (h/r)^2 at most; going linearly from one end of an edge to the other costs h^2/8 of
   the gradient's second derivative, again 1/8 (h/r)^2 at most. Where the surface bends both ways, as the torus inside
   its ring, either can be twice that. Wyvill's field stays below the distance's two terms. */
double error_most(const shape_known &shape, double radius)
{
    return degrees * 0.25 / (radius * radius) * (shape.tightest < 1 ? 2 : 1);
}

void expect_second_order(const shape_known &shape, const std::vector<measured> &rows)
{
    for (size_t n = 0; n < rows.size(); n++) {
        EXPECT_LE(rows[n].made.most, error_most(shape, rows[n].radius)) << shape.name << " " << rows[n].radius;
        EXPECT_LE(rows[n].as_packed.most, error_most(shape, rows[n].radius) + packing_most);
        if (n == 0)
            continue;
        /* second order says 4 a halving of the step */
        EXPECT_GT(rows[n - 1].made.mean / rows[n].made.mean, 3.4) << shape.name << " " << rows[n].radius;
        EXPECT_GT(rows[n - 1].made.p99 / rows[n].made.p99, 3.4) << shape.name << " " << rows[n].radius;
        EXPECT_GT(rows[n - 1].made.most / rows[n].made.most, 3.4) << shape.name << " " << rows[n].radius;
    }
}

TEST(view_normal, of_a_smooth_field_errs_by_the_square_of_the_step)
{
    print_head();
    for (const shape_known &s : {ball(), torus()}) {
        const std::vector<std::vector<measured>> fields = {
            measure_all(s, "6 steps", band(6)),
            measure_all(s, "4 steps", band(4)),
            measure_all(s, "Wyvill", wyvill_of(s.tightest, 1)),
        };
        for (const std::vector<measured> &rows : fields) {
            expect_second_order(s, rows);
            expect_packing_unseen(rows);
        }
    }
}

/* A difference along an axis can lose the half that reaches into the flat end, and another axis nothing: a normal whose
   slope against the axes is t then turns by atan(t) - atan(t/2), at most 19.5 degrees, at t = sqrt(2). */
const double flat_most = degrees * (std::atan(std::sqrt(2.0)) - std::atan(std::sqrt(0.5)));

TEST(view_normal, of_a_field_with_near_flat_ends_errs_within_bounds)
{
    print_head();
    for (const shape_known &s : {ball(), torus()}) {
        std::vector<measured> before;
        for (const double width : {3.0, 2.0, 1.0}) {
            const std::vector<measured> rows =
                measure_all(s, std::to_string(static_cast<int>(width)) + (width > 1 ? " steps" : " step"), band(width));
            expect_packing_unseen(rows);
            for (size_t n = 0; n < rows.size(); n++) {
                EXPECT_LE(rows[n].made.most, flat_most);
                if (!before.empty()) {
                    EXPECT_GT(rows[n].made.mean, before[n].made.mean) << "the nearer, the worse";
                }
            }
            before = rows;
        }
    }
}

/* A tool held at one place steepens what it leaves: its size decides how many steps are between full and empty. */
TEST(view_normal, of_a_tool_held_long_errs_less_the_more_steps_it_has)
{
    /* Differences have the right signs at least: at worst one axis alone is left of three that are equal. */
    const double signs_most = degrees * std::acos(1 / std::sqrt(3.0));
    print_head();
    for (const int dabs : {4, 16, 64}) {
        const std::vector<measured> rows =
            measure_all(ball(), std::to_string(dabs) + " dabs", wyvill_of(1, dabs));
        expect_packing_unseen(rows);
        for (size_t n = 0; n < rows.size(); n++) {
            EXPECT_LE(rows[n].made.most, signs_most);
            if (n > 0) {
                EXPECT_LT(rows[n].made.mean * 1.4, rows[n - 1].made.mean) << dabs;
            }
        }
    }
}

} // namespace
