/* SPDX-License-Identifier: Apache-2.0 */
#include "peer_judge.h"

#include "../unit/exchange/soup.h"

#include <cstdio>
#include <gtest/gtest.h>

namespace {

/* A float of these sizes is good to 1e-6 mm; peers parse decimals with an error of their own. */
constexpr double place_tolerance_mm = 1e-5;
constexpr double normal_tolerance = 1e-5;
constexpr double colour_tolerance = 0.5 / 255;
constexpr double volume_tolerance = 1e-5; /* relative */

soup welded(const peer_judge_corners &seen)
{
    soup s;
    s.at = seen.at;
    for (uint32_t n = 0; n + 2 < seen.at.size(); n += 3)
        s.triangles.push_back({n, n + 1, n + 2});
    return soup_weld(s);
}

void judge_corner(const mesh_vertex &v, size_t n, const peer_judge_corners &seen)
{
    double steps[3];
    mesh_position(&v, steps);
    for (size_t c = 0; c < 3; c++)
        ASSERT_NEAR(seen.at[n][c], steps[c] * clay_piece_step_mm, place_tolerance_mm) << "corner " << n;
    for (size_t c = 0; c < 3 && !seen.normal.empty(); c++)
        ASSERT_NEAR(seen.normal[n][c], static_cast<double>(v.normal[c]), normal_tolerance) << "corner " << n;
    for (int c = 0; c < (seen.has_alpha ? 4 : 3) && !seen.colour.empty(); c++)
        ASSERT_NEAR(seen.colour[n][static_cast<size_t>(c)], colour_channel(v.rgba, c) / 255.0, colour_tolerance)
            << "corner " << n << " channel " << c;
}

} // namespace

bool peer_judge_closed(const peer_judge_corners &seen)
{
    return soup_is_closed(welded(seen));
}

void peer_judge(const char *peer, const clay_piece &piece, const peer_judge_corners &seen)
{
    const mesh &m = piece.surface;
    const soup s = welded(seen);
    std::printf("%s: %s: %zu triangles (mesh %u), %zu vertices (mesh %u), %s, volume %.6f mm3 (mesh %.6f)\n", peer,
                piece.name.c_str(), s.triangles.size(), m.triangle_count, s.at.size(), m.vertex_count,
                soup_is_closed(s) ? "closed" : "open", soup_volume(s), piece.volume_mm3());
    ASSERT_EQ(seen.at.size(), size_t{m.triangle_count} * 3);
    ASSERT_TRUE(seen.normal.empty() || seen.normal.size() == seen.at.size());
    ASSERT_TRUE(seen.colour.empty() || seen.colour.size() == seen.at.size());
    EXPECT_EQ(s.at.size(), m.vertex_count);
    EXPECT_TRUE(soup_is_closed(s));
    EXPECT_GT(soup_volume(s), 0);
    EXPECT_NEAR(soup_volume(s), piece.volume_mm3(), volume_tolerance * piece.volume_mm3());
    for (size_t n = 0; n < seen.at.size() && !testing::Test::HasFatalFailure(); n++)
        judge_corner(m.vertices[m.triangles[n / 3][n % 3]], n, seen);
}
