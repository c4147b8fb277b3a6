/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/statistics.h"

#include <algorithm>
#include <cinttypes>
#include <cstdarg>
#include <cstdio>

namespace {

__attribute__((format(printf, 2, 3))) void put(std::string *out, const char *format, ...)
{
    char text[512];
    va_list list;
    va_start(list, format);
    int n = vsnprintf(text, sizeof text, format, list);
    va_end(list);
    assert(n >= 0 && n < static_cast<int>(sizeof text));
    out->append(text, static_cast<size_t>(n));
}

double percentile_us(std::vector<float> v, double part)
{
    if (v.empty())
        return 0;
    auto at = v.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(v.size() - 1));
    std::nth_element(v.begin(), at, v.end());
    return static_cast<double>(*at);
}

void line_put(std::string *out, const statistics_line &l)
{
    const tool_counts &t = l.dab.counts.tool;
    put(out, "{\"time_ms\": %.3f, \"stroke\": %" PRIu64 ", \"refused\": %s, ",
        static_cast<double>(l.dab.time_us) / 1000, l.dab.stroke, l.dab.outcome == STATUS_OK ? "false" : "true");
    put(out, "\"visited\": %" PRIu64 ", \"computed\": %" PRIu64 ", \"dirtied\": %" PRIu64 ", \"treated\": %" PRIu64
             ", \"triangles\": %" PRIu64 ", ",
        t.visited, t.computed, t.dirtied, l.dab.counts.surface.treated, l.triangles);
    put(out,
        "\"field_us\": %.3f, \"surface_us\": %.3f, \"field_digest\": \"%016" PRIx64 "\", \"mesh_digest\": \"%016" PRIx64
        "\"}",
        static_cast<double>(l.dab.field_ns) / 1000, static_cast<double>(l.dab.surface_ns) / 1000, l.field_digest,
        l.mesh_digest);
}

} // namespace

void statistics_dab(statistics *s, const station_dab &d, sculpture *piece)
{
    s->dabs++;
    s->strokes = d.stroke;
    s->refused += d.outcome != STATUS_OK;
    s->visited += d.counts.tool.visited;
    s->computed += d.counts.tool.computed;
    s->dirtied += d.counts.tool.dirtied;
    s->treated += d.counts.surface.treated;
    s->field_us += static_cast<double>(d.field_ns) / 1000;
    s->surface_us += static_cast<double>(d.surface_ns) / 1000;
    s->dab_us.push_back(static_cast<float>(static_cast<double>(d.field_ns + d.surface_ns) / 1000));
    if (s->every_dab)
        s->lines.push_back({d, piece->surface.triangles, sculpture_digest(piece), surface_digest(&piece->surface)});
}

void statistics_stroke(statistics *s, int64_t history_ns)
{
    s->history_steps++;
    s->history_us += static_cast<double>(history_ns) / 1000;
}

std::string statistics_json(const statistics &s, sculpture *piece)
{
    std::string out;
    put(&out, "{\n\"glaise\": \"%s\", \"step_mm\": %.17g,\n", GLAISE_VERSION, piece->step_mm);
    put(&out, "\"strokes\": %" PRIu64 ", \"dabs\": %" PRIu64 ", \"refused\": %" PRIu64 ",\n", s.strokes, s.dabs,
        s.refused);
    put(&out,
        "\"visited\": %" PRIu64 ", \"computed\": %" PRIu64 ", \"dirtied\": %" PRIu64 ", \"treated\": %" PRIu64 ",\n",
        s.visited, s.computed, s.dirtied, s.treated);
    put(&out, "\"corners\": %" PRIu64 ", \"bricks\": %u, \"triangles\": %" PRIu64 ",\n", piece->clay.corners,
        clay_brick_count(&piece->clay), piece->surface.triangles);
    put(&out, "\"field_us\": %.3f, \"surface_us\": %.3f, \"history_us\": %.3f,\n", s.field_us, s.surface_us,
        s.history_us);
    put(&out, "\"dab_us_median\": %.3f, \"dab_us_p99\": %.3f,\n", percentile_us(s.dab_us, 0.5),
        percentile_us(s.dab_us, 0.99));
    put(&out, "\"field_digest\": \"%016" PRIx64 "\", \"mesh_digest\": \"%016" PRIx64 "\",\n\"dab\": [",
        sculpture_digest(piece), surface_digest(&piece->surface));
    for (size_t n = 0; n < s.lines.size(); n++) {
        out += n ? ",\n" : "\n";
        line_put(&out, s.lines[n]);
    }
    out += "\n]}\n";
    return out;
}

std::string statistics_text(const statistics &s, const sculpture *piece)
{
    std::string out;
    put(&out, "strokes   %" PRIu64 "\ndabs      %" PRIu64, s.strokes, s.dabs);
    if (s.refused)
        put(&out, " (%" PRIu64 " refused)", s.refused);
    put(&out, "\ncorners   %" PRIu64 " in %u bricks\ntriangles %" PRIu64 "\n", piece->clay.corners,
        clay_brick_count(&piece->clay), piece->surface.triangles);
    double dabs = s.dabs ? static_cast<double>(s.dabs) : 1;
    put(&out, "per dab   median %.0f us, p99 %.0f us; mean %.0f us field + %.0f us surface\n",
        percentile_us(s.dab_us, 0.5), percentile_us(s.dab_us, 0.99), s.field_us / dabs, s.surface_us / dabs);
    if (s.history_steps)
        put(&out, "history   mean %.0f us per stroke, undo or redo\n",
            s.history_us / static_cast<double>(s.history_steps));
    return out;
}
