/* SPDX-License-Identifier: Apache-2.0 */
#include "view/overlay_pen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace {

constexpr double quarter = 1.5707963267948966;

/* Without a font file there are no letters beyond ASCII. */
std::string plain(std::string text)
{
    constexpr std::array<std::pair<const char *, const char *>, 4> signs = {
        {{"\xe2\x80\xa6", "..."}, {"\xe2\x80\xba", ">"}, {"\xe2\x80\x93", "-"}, {"\xc2\xb0", " degrees"}}};
    for (const auto &[sign, instead] : signs)
        for (size_t at = text.find(sign); at != std::string::npos; at = text.find(sign))
            text.replace(at, std::string(sign).size(), instead);
    return text;
}

std::vector<std::string> words_of(const std::string &text)
{
    std::vector<std::string> words(1);
    for (const char c : text)
        if (c == ' ')
            words.emplace_back();
        else
            words.back() += c;
    return words;
}

ImFont *font_of(const overlay_pen &p, bool bold, float size)
{
    return bold ? p.bold : size > p.size ? p.label : p.usual;
}

} // namespace

double overlay_pen_size(double width, double height, double pixels_per_mm)
{
    const double side = std::min(width, height);
    const double per_mm = pixels_per_mm > 0 ? pixels_per_mm : side / OVERLAY_PEN_SCREEN_MM;
    const double wanted = OVERLAY_PEN_CAP_MM * per_mm / OVERLAY_PEN_CAP;
    return std::max(OVERLAY_PEN_LEAST, std::round(std::min(wanted, side / OVERLAY_PEN_LINES)));
}

float overlay_pen_width(const overlay_pen &p, bool bold, float size, const std::string &text)
{
    const std::string said = p.ascii ? plain(text) : text;
    return font_of(p, bold, size)->CalcTextSizeA(size, 1e9f, 0, said.c_str()).x;
}

float overlay_pen_fit(const overlay_pen &p, bool bold, float size, const std::string &text, float most)
{
    const float width = overlay_pen_width(p, bold, size, text);
    return width > most ? size * std::max(most, 1.0f) / width : size;
}

void overlay_pen_text(const overlay_pen &p, bool bold, float size, float x, float y, float about, ImU32 colour,
                      const std::string &text)
{
    if (text.empty())
        return;
    const std::string said = p.ascii ? plain(text) : text;
    const float width = overlay_pen_width(p, bold, size, text);
    const ImVec2 at(std::round(x - about * width), std::round(y - size / 2));
    p.list->AddText(font_of(p, bold, size), size, at, colour, said.c_str());
    if (p.words)
        p.words->push_back({text, at.x, at.y, at.x + width, at.y + size});
}

std::vector<std::string> overlay_pen_broken(const overlay_pen &p, bool bold, float size, float most,
                                            const std::string &text)
{
    std::vector<std::string> lines;
    for (const std::string &word : words_of(text)) {
        const std::string longer = lines.empty() ? word : lines.back() + " " + word;
        if (!lines.empty() && overlay_pen_width(p, bold, size, longer) <= most)
            lines.back() = longer;
        else
            lines.push_back(word);
    }
    return lines;
}

void overlay_pen_lines(const overlay_pen &p, bool bold, float size, float x, float y, float most, ImU32 colour,
                       const std::string &text)
{
    const std::vector<std::string> lines = overlay_pen_broken(p, bold, size, most, text);
    float at = y - static_cast<float>(lines.size() - 1) * size / 2;
    for (const std::string &one : lines) {
        overlay_pen_text(p, bold, overlay_pen_fit(p, bold, size, one, most), x, at, 0.5f, colour, one);
        at += size;
    }
}

void overlay_pen_arc(const overlay_pen &p, ImVec2 middle, float inner, float outer, double from, double to,
                     ImU32 colour)
{
    const int parts = std::max(2, static_cast<int>(std::ceil(std::fabs(to - from) * outer / 4)));
    p.list->PathArcTo(middle, (inner + outer) / 2, static_cast<float>(from - quarter), static_cast<float>(to - quarter),
                      parts);
    p.list->PathStroke(colour, 0, outer - inner);
}

ImVec2 overlay_pen_round(ImVec2 middle, double radius, double angle)
{
    return ImVec2(middle.x + static_cast<float>(radius * std::sin(angle)),
                  middle.y - static_cast<float>(radius * std::cos(angle)));
}

ImU32 overlay_pen_rgb(unsigned rgb, unsigned alpha)
{
    return IM_COL32(rgb >> 16 & 255, rgb >> 8 & 255, rgb & 255, alpha);
}
