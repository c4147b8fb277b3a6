/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Triangles as read back from a file, and what can be measured on them.
 * Is not:  surface/mesh.h: this one shares no code with what it judges.
 * Shape:   colours have red in the lowest byte; normals per vertex, or per triangle where a format has facets.
 */
#ifndef GLAISE_EXCHANGE_SOUP_H
#define GLAISE_EXCHANGE_SOUP_H

#include <array>
#include <cstdint>
#include <string>
#include <vector>

struct soup {
    std::vector<std::array<double, 3>> at;
    std::vector<std::array<double, 3>> normal;
    std::vector<uint32_t> rgba;
    std::vector<std::array<uint32_t, 3>> triangles;
    std::string name;
};

/* Vertices at exactly equal places become one. Normals and colours are dropped. */
soup soup_weld(const soup &s);
/* Every edge is used once each way. */
bool soup_is_closed(const soup &s);
double soup_volume(const soup &s);

#endif
