/* SPDX-License-Identifier: Apache-2.0 */
#include "clay_piece.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <stdexcept>
#include <unistd.h>

namespace {

constexpr int reach = 24; /* corners from the origin on each axis */

/* Lattice steps inside the surface, roughly. */
double depth_of_blob(double x, double y, double z)
{
    x -= 1.3, y += 2.2, z -= 0.7;
    const double radius = std::sqrt(x * x + y * y + z * z);
    const double bumps = std::sin(0.5 * x) * std::sin(0.4 * y + 1) * std::sin(0.6 * z - 0.5);
    return 14.2 + 2.5 * bumps - radius;
}

double depth_of_torus(double x, double y, double z)
{
    const double ring = std::sqrt(x * x + (y + 0.6) * (y + 0.6)) - 14.3;
    return 5.1 - std::sqrt(ring * ring + (z - 0.2) * (z - 0.2));
}

unsigned channel(int place)
{
    return static_cast<unsigned>(std::clamp(128 + 5 * place, 0, 255));
}

void demand(status state, const char *what)
{
    if (state != STATUS_OK)
        throw std::runtime_error(std::string(what) + ": " + status_text(state));
}

void fill(clay &c, double (*depth)(double, double, double))
{
    key at;
    for (at.i = -reach; at.i <= reach; at.i++)
        for (at.j = -reach; at.j <= reach; at.j++)
            for (at.k = -reach; at.k <= reach; at.k++) {
                const double potential = 1.5 + 0.8 * depth(at.i, at.j, at.k);
                if (potential > 0)
                    demand(clay_write(&c, at, static_cast<float>(potential),
                                      colour_pack(channel(at.i), channel(at.j), channel(at.k), channel(at.i + at.j))),
                           "clay_write");
            }
}

} // namespace

clay_piece::clay_piece(const std::string &kind) : name(kind)
{
    clay c;
    struct surface s;
    surface_counts counts;
    demand(clay_init(&c, 4096), "clay_init");
    fill(c, kind == "blob" ? depth_of_blob : depth_of_torus);
    demand(surface_init(&s, 8192), "surface_init");
    demand(surface_rebuild(&s, &c, &counts), "surface_rebuild");
    demand(mesh_init(&surface, &s), "mesh_init");
    surface_finish(&s);
    clay_finish(&c);
}

clay_piece::~clay_piece()
{
    mesh_finish(&surface);
}

double clay_piece::volume_mm3() const
{
    return mesh_volume(&surface) * std::pow(clay_piece_step_mm, 3);
}

namespace {

status into_file(void *self, const void *bytes, size_t n)
{
    return std::fwrite(bytes, 1, n, static_cast<FILE *>(self)) == n ? STATUS_OK : STATUS_IO;
}

} // namespace

clay_piece_file::clay_piece_file(const clay_piece &piece, const std::string &ending, uint32_t left_out)
{
    /* The process number keeps test programs that run at the same time apart. */
    path = testing::TempDir() + "glaise_" + std::to_string(getpid()) + "_" + piece.name + ending;
    FILE *file = std::fopen(path.c_str(), "wb");
    if (file == nullptr)
        throw std::runtime_error(path + ": cannot be made");
    mesh shown = piece.surface;
    shown.triangle_count -= left_out;
    const exchange_outcome outcome = exchange_write_mesh(shown, clay_piece_step_mm, path, into_file, file);
    if (std::fclose(file) != 0 || outcome.state != STATUS_OK)
        throw std::runtime_error(path + ": " + outcome.text);
}

clay_piece_file::~clay_piece_file()
{
    std::remove(path.c_str());
}
