/* SPDX-License-Identifier: Apache-2.0 */
#include "readback.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace {

[[noreturn]] void complain(size_t at, const std::string &expected)
{
    throw std::runtime_error("at " + std::to_string(at) + ": expected " + expected);
}

struct binary {
    std::string_view bytes;
    size_t at = 0;

    uint32_t little(size_t n)
    {
        if (bytes.size() - at < n)
            complain(at, "more bytes");
        uint32_t value = 0;
        for (size_t b = 0; b < n; b++)
            value |= static_cast<uint32_t>(static_cast<unsigned char>(bytes[at + b])) << (8 * b);
        at += n;
        return value;
    }
    std::array<double, 3> triple()
    {
        std::array<double, 3> p{};
        for (double &x : p)
            x = static_cast<double>(std::bit_cast<float>(little(4)));
        return p;
    }
    std::string_view line()
    {
        const size_t end = bytes.find('\n', at);
        if (end == std::string_view::npos)
            complain(at, "a line");
        const std::string_view text = bytes.substr(at, end - at);
        at = end + 1;
        return text;
    }
    void end() const
    {
        if (at != bytes.size())
            complain(at, "the end");
    }
};

/* Words between blanks, commas and brackets; the latter two are words of their own, a quoted string is one word. */
struct words {
    std::string_view text;
    size_t at = 0;

    std::string_view next()
    {
        while (at < text.size() && (text[at] == ' ' || text[at] == '\n'))
            at++;
        const size_t begin = at;
        if (at == text.size())
            return {};
        if (text[at] == '"') {
            at = text.find('"', at + 1);
            if (at == std::string_view::npos)
                complain(begin, "a closing quote");
            return text.substr(begin, ++at - begin);
        }
        if (mark(text[at]))
            return text.substr(at++, 1);
        while (at < text.size() && text[at] != ' ' && text[at] != '\n' && !mark(text[at]))
            at++;
        return text.substr(begin, at - begin);
    }
    static bool mark(char c) { return c == ',' || c == '[' || c == ']' || c == '{' || c == '}'; }
    void expect(std::string_view word)
    {
        const size_t before = at;
        if (next() != word)
            complain(before, std::string(word));
    }
    double decimal()
    {
        const size_t before = at;
        const std::string_view word = next();
        float value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
            complain(before, "a decimal number, not '" + std::string(word) + "'");
        return static_cast<double>(value);
    }
    int64_t integer(int base = 10)
    {
        const size_t before = at;
        std::string_view word = next();
        if (base == 16) {
            if (word.substr(0, 2) != "0x")
                complain(before, "0x");
            word.remove_prefix(2);
        }
        int64_t value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, base);
        if (error != std::errc() || end != word.data() + word.size())
            complain(before, "an integer, not '" + std::string(word) + "'");
        return value;
    }
};

void check_indices(const soup &s)
{
    for (const auto &t : s.triangles)
        for (uint32_t v : t)
            if (v >= s.at.size())
                complain(v, "an index of a vertex");
}

size_t counted(std::string_view line, std::string_view before)
{
    if (line.substr(0, before.size()) != before)
        complain(0, std::string(before));
    words w{line.substr(before.size())};
    return static_cast<size_t>(w.integer());
}

uint32_t swap_bytes(uint32_t x)
{
    return x >> 24 | (x >> 8 & 0xff00u) | (x << 8 & 0xff0000u) | x << 24;
}

} // namespace

soup readback_stl(std::string_view bytes)
{
    soup s;
    if (bytes.substr(0, 5) == "solid")
        complain(0, "a header that does not claim to be ASCII");
    binary b{bytes, 80};
    const uint32_t count = b.little(4);
    for (uint32_t t = 0; t < count; t++) {
        s.normal.push_back(b.triple());
        for (int c = 0; c < 3; c++)
            s.at.push_back(b.triple());
        s.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
        if (b.little(2) != 0)
            complain(b.at, "no attribute");
    }
    b.end();
    return s;
}

soup readback_ply(std::string_view bytes)
{
    soup s;
    binary b{bytes};
    for (std::string_view expected : {"ply", "format binary_little_endian 1.0", "comment glaise, millimetres"})
        if (b.line() != expected)
            complain(b.at, std::string(expected));
    s.name = b.line().substr(8);
    const size_t vertices = counted(b.line(), "element vertex ");
    for (std::string_view expected :
         {"property float x", "property float y", "property float z", "property float nx", "property float ny",
          "property float nz", "property uchar red", "property uchar green", "property uchar blue",
          "property uchar alpha"})
        if (b.line() != expected)
            complain(b.at, std::string(expected));
    const size_t faces = counted(b.line(), "element face ");
    for (std::string_view expected : {"property list uchar int vertex_indices", "end_header"})
        if (b.line() != expected)
            complain(b.at, std::string(expected));
    for (size_t v = 0; v < vertices; v++) {
        s.at.push_back(b.triple());
        s.normal.push_back(b.triple());
        s.rgba.push_back(b.little(4));
    }
    for (size_t t = 0; t < faces; t++) {
        if (b.little(1) != 3)
            complain(b.at, "three corners");
        const uint32_t x = b.little(4), y = b.little(4), z = b.little(4);
        s.triangles.push_back({x, y, z});
    }
    b.end();
    check_indices(s);
    return s;
}

soup readback_obj(std::string_view bytes)
{
    soup s;
    binary b{bytes};
    while (b.at < bytes.size()) {
        const size_t before = b.at;
        words w{b.line()};
        const std::string_view kind = w.next();
        if (kind == "v") {
            s.at.push_back({w.decimal(), w.decimal(), w.decimal()});
            uint32_t rgba = 0xff000000u;
            for (int c = 0; c < 3; c++)
                rgba |= static_cast<uint32_t>(std::lround(w.decimal() * 255)) << (8 * c);
            s.rgba.push_back(rgba);
        } else if (kind == "vn") {
            s.normal.push_back({w.decimal(), w.decimal(), w.decimal()});
        } else if (kind == "f") {
            std::array<uint32_t, 3> t{};
            for (uint32_t &v : t) {
                const std::string pair(w.next());
                v = static_cast<uint32_t>(std::stoul(pair)) - 1;
                if (pair != std::to_string(v + 1) + "//" + std::to_string(v + 1))
                    complain(before, "a//a");
            }
            s.triangles.push_back(t);
        } else if (kind == "o") {
            s.name = w.text.substr(2);
        } else if (kind != "#") {
            complain(before, "v, vn, f, o or #");
        }
        if (kind != "#" && kind != "o" && !w.next().empty())
            complain(before, "nothing more on the line");
    }
    check_indices(s);
    return s;
}

namespace {

/* "[ x y z, ... ]" with a comma behind every triple. */
std::vector<std::array<double, 3>> triples(words &w)
{
    std::vector<std::array<double, 3>> all;
    w.expect("[");
    for (;;) {
        words peek = w;
        if (peek.next() == "]") {
            w = peek;
            return all;
        }
        all.push_back({w.decimal(), w.decimal(), w.decimal()});
        w.expect(",");
    }
}

void field(words &w, soup &s, std::string_view node)
{
    if (node == "PackedColor") {
        w.expect("orderedRGBA");
        w.expect("[");
        for (words peek = w; peek.next() != "]"; peek = w) {
            s.rgba.push_back(swap_bytes(static_cast<uint32_t>(w.integer(16))));
            w.expect(",");
        }
        w.expect("]");
    } else if (node == "Normal") {
        w.expect("vector");
        s.normal = triples(w);
    } else if (node == "Coordinate3") {
        w.expect("point");
        s.at = triples(w);
    } else if (node == "IndexedFaceSet") {
        w.expect("coordIndex");
        w.expect("[");
        for (words peek = w; peek.next() != "]"; peek = w) {
            std::array<uint32_t, 3> t{};
            for (uint32_t &v : t) {
                v = static_cast<uint32_t>(w.integer());
                w.expect(",");
            }
            w.expect("-1");
            w.expect(",");
            s.triangles.push_back(t);
        }
        w.expect("]");
    } else if (node == "Info") {
        w.expect("string");
        s.name = w.next();
    } else if (node == "MaterialBinding" || node == "NormalBinding") {
        w.expect("value");
        w.expect("PER_VERTEX_INDEXED");
    } else if (node == "ShapeHints") {
        for (std::string_view word : {"vertexOrdering", "COUNTERCLOCKWISE", "shapeType", "SOLID", "faceType", "CONVEX",
                                      "creaseAngle", "0"})
            w.expect(word);
    } else if (node == "Material") {
        for (std::string_view name : {"ambientColor", "specularColor"}) {
            w.expect(name);
            for (int c = 0; c < 3; c++)
                w.decimal();
        }
        w.expect("shininess");
        w.decimal();
    } else {
        complain(w.at, "a known node, not '" + std::string(node) + "'");
    }
}

} // namespace

soup readback_inventor(std::string_view bytes, std::vector<std::string> *nodes_out)
{
    soup s;
    constexpr std::string_view first = "#Inventor V2.1 ascii\n";
    if (bytes.substr(0, first.size()) != first)
        complain(0, "the header line");
    words w{bytes.substr(first.size())};
    w.expect("Separator");
    w.expect("{");
    for (std::string_view node = w.next(); node != "}"; node = w.next()) {
        if (nodes_out)
            nodes_out->emplace_back(node);
        w.expect("{");
        field(w, s, node);
        w.expect("}");
    }
    w.expect("");
    check_indices(s);
    return s;
}
