/* SPDX-License-Identifier: Apache-2.0 */
#include "bench_record.h"

#include <cstdio>

void bench_record::add(const char *section, const std::vector<word> &words, const std::vector<number> &numbers)
{
    std::string row = std::string("{\"section\": \"") + section + "\"";
    for (const word &w : words)
        row += std::string(", \"") + w.first + "\": \"" + w.second + "\"";
    for (const number &n : numbers) {
        char text[48];
        std::snprintf(text, sizeof text, "%.9g", n.second);
        row += std::string(", \"") + n.first + "\": " + text;
    }
    rows.push_back(row + "}");
}

bool bench_record::write(const std::string &file) const
{
    std::FILE *to = std::fopen(file.c_str(), "w");
    if (!to)
        return false;
    std::fputs("[\n", to);
    for (size_t n = 0; n < rows.size(); n++)
        std::fprintf(to, "%s%s\n", rows[n].c_str(), n + 1 < rows.size() ? "," : "");
    std::fputs("]\n", to);
    return std::fclose(to) == 0;
}
