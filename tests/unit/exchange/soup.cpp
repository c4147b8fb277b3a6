/* SPDX-License-Identifier: Apache-2.0 */
#include "soup.h"

#include <map>

soup soup_weld(const soup &s)
{
    soup out;
    std::map<std::array<double, 3>, uint32_t> places;
    for (const auto &t : s.triangles) {
        std::array<uint32_t, 3> welded{};
        for (size_t c = 0; c < 3; c++) {
            const auto [place, fresh] = places.try_emplace(s.at[t[c]], static_cast<uint32_t>(out.at.size()));
            if (fresh)
                out.at.push_back(s.at[t[c]]);
            welded[c] = place->second;
        }
        out.triangles.push_back(welded);
    }
    return out;
}

bool soup_is_closed(const soup &s)
{
    std::map<std::pair<uint32_t, uint32_t>, int> uses;
    for (const auto &t : s.triangles)
        for (size_t c = 0; c < 3; c++)
            uses[{t[c], t[(c + 1) % 3]}]++;
    for (const auto &[edge, count] : uses) {
        const auto back = uses.find({edge.second, edge.first});
        if (count != 1 || back == uses.end() || edge.first == edge.second)
            return false;
    }
    return !uses.empty();
}

double soup_volume(const soup &s)
{
    double six = 0;
    for (const auto &t : s.triangles) {
        const auto &a = s.at[t[0]], &b = s.at[t[1]], &c = s.at[t[2]];
        six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return six / 6;
}
