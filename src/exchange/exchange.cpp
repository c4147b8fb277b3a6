/* SPDX-License-Identifier: Apache-2.0 */
#include "exchange/exchange.h"

#include "exchange/inventor.h"
#include "exchange/obj.h"
#include "exchange/ply.h"
#include "exchange/stl.h"

#include <charconv>
#include <memory>

namespace {

using mesh_writer = status (*)(const mesh_file &f, checkpoint_sink sink, void *self);

struct format_row {
    exchange_format format;
    std::string_view ending; /* lower case */
    mesh_writer write;       /* null: not a mesh */
    double vertex_bytes, triangle_bytes; /* about as many as the file will have: for progress */
};

constexpr format_row formats[] = {
    {EXCHANGE_GLAISE, ".glaise", nullptr, 0, 0},
    {EXCHANGE_STL, ".stl", stl_write, 0, 50},
    {EXCHANGE_PLY, ".ply", ply_write, 28, 13},
    {EXCHANGE_OBJ, ".obj", obj_write, 90, 45},
    {EXCHANGE_INVENTOR, ".iv", inventor_write, 100, 26},
};

std::string_view last_part(std::string_view path)
{
    return path.substr(path.rfind('/') + 1); /* npos + 1 is 0 */
}

std::string_view ending_of(std::string_view file_name)
{
    const std::string_view name = last_part(file_name);
    const size_t dot = name.rfind('.');
    return dot == std::string_view::npos ? std::string_view() : name.substr(dot);
}

bool same_ending(std::string_view a, std::string_view lower)
{
    if (a.size() != lower.size())
        return false;
    for (size_t n = 0; n < a.size(); n++) {
        const char c = a[n] >= 'A' && a[n] <= 'Z' ? static_cast<char>(a[n] - 'A' + 'a') : a[n];
        if (c != lower[n])
            return false;
    }
    return true;
}

const format_row *row_of(std::string_view file_name)
{
    const std::string_view ending = ending_of(file_name);
    for (const format_row &row : formats)
        if (same_ending(ending, row.ending))
            return &row;
    return nullptr;
}

std::string number(double value)
{
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

exchange_outcome outcome_of(status state)
{
    return {state, state == STATUS_OK ? std::string() : std::string(status_text(state))};
}

exchange_outcome unknown_ending(std::string_view file_name)
{
    const std::string_view ending = ending_of(file_name);
    std::string text(last_part(file_name));
    text += ending.empty() ? ": a name without an ending" : ": no format with the ending " + std::string(ending);
    return {STATUS_BAD_PARAMETER, text + "; known are " + exchange_endings()};
}

exchange_outcome reading_outcome(status state, const checkpoint_trouble &trouble)
{
    if ((state != STATUS_CORRUPT && state != STATUS_NEWER) || trouble.expected[0] == '\0')
        return outcome_of(state);
    std::string text = "offset " + std::to_string(trouble.offset) + ": expected " + trouble.expected;
    if (state == STATUS_NEWER)
        text += std::string(" (") + status_text(state) + ")";
    return {state, text};
}

/* A sink that hears how much went through it. */
struct metered_sink {
    checkpoint_sink sink;
    void *self;
    const std::function<void(double)> &progress;
    double expected, sent = 0;
};

status metered_put(void *self, const void *bytes, size_t n)
{
    metered_sink &m = *static_cast<metered_sink *>(self);
    m.sent += static_cast<double>(n);
    if (m.progress)
        m.progress(m.sent < m.expected ? m.sent / m.expected : 1);
    return m.sink(m.self, bytes, n);
}

double native_bytes(const clay &c)
{
    constexpr double a_header = CHECKPOINT_HEADER_BYTES, a_brick = 80, a_corner = 8; /* checkpoint.h */
    constexpr double packed = 0.35; /* about what packing leaves of a field */
    return a_header + packed * (a_brick * clay_brick_count(&c) + a_corner * static_cast<double>(c.corners));
}

struct clay_finisher {
    void operator()(clay *c) const
    {
        clay_finish(c);
        delete c;
    }
};

std::string box_text(const clay &c, double step_mm)
{
    const box b = clay_box(&c);
    if (box_is_empty(b))
        return "empty";
    const int64_t lo[3] = {b.min.i, b.min.j, b.min.k}, hi[3] = {b.max.i, b.max.j, b.max.k};
    std::string from, to, size;
    for (int n = 0; n < 3; n++) {
        from += (n ? " " : "") + std::to_string(lo[n]);
        to += (n ? " " : "") + std::to_string(hi[n]);
        size += (n ? " x " : "") + number(static_cast<double>(hi[n] - lo[n]) * step_mm);
    }
    return from + " to " + to + " (" + size + " mm)";
}

std::string digest_text(uint64_t digest)
{
    char digits[16];
    const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, digest, 16);
    const size_t n = static_cast<size_t>(end.ptr - digits);
    return std::string(sizeof digits - n, '0') + std::string(digits, n);
}

} // namespace

exchange_format exchange_format_of(std::string_view file_name)
{
    const format_row *row = row_of(file_name);
    return row ? row->format : EXCHANGE_UNKNOWN;
}

std::string exchange_endings()
{
    std::string all;
    for (const format_row &row : formats)
        all += (all.empty() ? "" : " ") + std::string(row.ending);
    return all;
}

exchange_outcome exchange_write(still &s, std::string_view file_name, checkpoint_sink sink, void *self,
                                const std::function<void(double)> &progress)
{
    const format_row *row = row_of(file_name);
    if (row == nullptr)
        return unknown_ending(file_name);
    if (row->write == nullptr) {
        metered_sink metered = {sink, self, progress, native_bytes(s.field.still)};
        return outcome_of(still_write(&s, metered_put, &metered));
    }
    mesh m;
    const status made = still_mesh(&s, &m);
    if (made == STATUS_TOO_LARGE)
        return {made, "the surface has more vertices than a mesh file can number"};
    if (made != STATUS_OK)
        return outcome_of(made);
    metered_sink metered = {sink, self, progress,
                            row->vertex_bytes * m.vertex_count + row->triangle_bytes * m.triangle_count};
    const exchange_outcome written = exchange_write_mesh(m, s.step_mm, file_name, metered_put, &metered);
    mesh_finish(&m);
    return written;
}

exchange_outcome exchange_write_mesh(const mesh &m, double step_mm, std::string_view file_name, checkpoint_sink sink,
                                     void *self)
{
    const format_row *row = row_of(file_name);
    if (row == nullptr)
        return unknown_ending(file_name);
    const std::string ending(row->ending);
    if (row->write == nullptr)
        return {STATUS_BAD_PARAMETER, "a mesh cannot become a " + ending + " file, which holds the field"};
    if (m.triangle_count == 0)
        return {STATUS_BAD_PARAMETER, "the sculpture is empty: an " + ending + " file without triangles would be "
                                      "taken for a damaged one"};
    std::string_view name = last_part(file_name);
    name.remove_suffix(ending.size());
    const status state = row->write({&m, step_mm, name}, sink, self);
    if (state == STATUS_TOO_LARGE)
        return {state, "the surface has more triangles than a mesh file can number"};
    return outcome_of(state);
}

exchange_outcome exchange_read(sculpture &s, checkpoint_source source, void *self)
{
    checkpoint_trouble trouble = {};
    const status state = sculpture_read(&s, source, self, &trouble);
    checkpoint_facts facts = {};
    if (state == STATUS_BAD_PARAMETER && checkpoint_read_facts(&facts, source, self, &trouble) == STATUS_OK)
        return {state, "the file's step is " + number(facts.step_mm) + " mm, the sculpture's is " + number(s.step_mm) +
                           " mm: read it into a new sculpture"};
    return reading_outcome(state, trouble);
}

exchange_outcome exchange_info(checkpoint_source source, void *self)
{
    std::unique_ptr<clay, clay_finisher> read(new clay());
    status state = clay_init(read.get(), CAPACITY_BRICKS);
    if (state != STATUS_OK)
        return outcome_of(state);
    checkpoint_trouble trouble = {};
    checkpoint_facts facts = {};
    state = checkpoint_read(read.get(), &facts, source, self, &trouble);
    if (state != STATUS_OK)
        return reading_outcome(state, trouble);
    std::string text = "glaise sculpture\n";
    text += "version " + std::to_string(facts.version) + "\n";
    text += "step    " + number(facts.step_mm) + " mm\n";
    text += "bricks  " + std::to_string(clay_brick_count(read.get())) + "\n";
    text += "corners " + std::to_string(read->corners) + "\n";
    text += "box     " + box_text(*read, facts.step_mm) + "\n";
    text += "digest  " + digest_text(facts.digest) + "\n";
    return {STATUS_OK, text};
}
