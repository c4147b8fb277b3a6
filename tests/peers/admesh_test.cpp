/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   admesh, which printers' people trust, finds nothing to mend in our STL and the same count and volume.
 * Method: the program is run on both pieces and its report read. A piece with a hole shows that the report is read
 *         right.
 */
#include "clay_piece.h"

#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>

#ifdef PEERS_ADMESH

namespace {

std::string report_on(const std::string &path)
{
    const std::string command = std::string("LC_ALL=C '") + PEERS_ADMESH + "' '" + path + "' 2>&1";
    FILE *pipe = popen(command.c_str(), "r");
    if (pipe == nullptr)
        return "";
    std::string report;
    char piece[4096];
    for (size_t n; (n = std::fread(piece, 1, sizeof piece, pipe)) > 0;)
        report.append(piece, n);
    return pclose(pipe) == 0 ? report : "failed: " + report;
}

/* "Label   :  12   12": the first number behind the label's colon; NaN where the label is missing. */
double number_behind(const std::string &report, const std::string &label)
{
    const size_t at = report.find(label);
    const size_t colon = at == std::string::npos ? at : report.find(':', at);
    return colon == std::string::npos ? std::strtod("nan", nullptr) : std::strtod(&report[colon + 1], nullptr);
}

void expect_nothing_to_mend(const char *kind)
{
    const clay_piece piece(kind);
    const clay_piece_file file(piece, ".stl");
    const std::string report = report_on(file.path);
    std::printf("admesh: %s: %.0f facets (mesh %u), %.0f disconnected, volume %.6f mm3 (mesh %.6f)\n", kind,
                number_behind(report, "Number of facets"), piece.surface.triangle_count,
                number_behind(report, "Total disconnected facets"), number_behind(report, "Volume "),
                piece.volume_mm3());
    EXPECT_NE(report.find("Binary STL"), std::string::npos) << report;
    EXPECT_EQ(number_behind(report, "Number of facets"), piece.surface.triangle_count) << report;
    EXPECT_EQ(number_behind(report, "Number of parts"), 1) << report;
    for (const char *label : {"Facets with 1 disconnected edge", "Facets with 2 disconnected edges",
                              "Facets with 3 disconnected edges", "Total disconnected facets", "Degenerate facets",
                              "Edges fixed", "Facets removed", "Facets added", "Facets reversed", "Backwards edges",
                              "Normals fixed"})
        EXPECT_EQ(number_behind(report, label), 0) << label << "\n" << report;
    /* admesh sums in float. */
    EXPECT_NEAR(number_behind(report, "Volume "), piece.volume_mm3(), 1e-4 * piece.volume_mm3());
}

TEST(admesh, blob_needs_no_mending)
{
    expect_nothing_to_mend("blob");
}

TEST(admesh, torus_needs_no_mending)
{
    expect_nothing_to_mend("torus");
}

TEST(admesh, hole_is_noticed)
{
    const clay_piece piece("torus");
    const clay_piece_file file(piece, ".stl", 1);
    EXPECT_EQ(number_behind(report_on(file.path), "Total disconnected facets"), 3);
}

} // namespace

#else

TEST(admesh, blob_needs_no_mending)
{
    GTEST_SKIP() << "admesh was not found when this was configured (package admesh)";
}

#endif
