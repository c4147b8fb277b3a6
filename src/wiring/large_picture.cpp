/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/large_picture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>

namespace {

constexpr size_t PIXEL_BYTES = 4;
constexpr int PATTERN_PIXELS = 4;
static_assert(LARGE_PICTURE_TILE_PIXELS % 12 == 0);

double light_of(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

struct encoding {
    std::array<float, 256> light;      /* of each byte */
    std::array<float, 255> byte_after; /* from this light on it is the next byte */
};

const encoding &encoding_of_srgb()
{
    static const encoding made = [] {
        encoding e;
        for (size_t n = 0; n < e.light.size(); n++)
            e.light[n] = static_cast<float>(light_of(static_cast<double>(n) / 255));
        for (size_t n = 0; n < e.byte_after.size(); n++)
            e.byte_after[n] = static_cast<float>(light_of((static_cast<double>(n) + 0.5) / 255));
        return e;
    }();
    return made;
}

bool is_one_part(const large_picture_size &s)
{
    return std::max(s.width, s.height) * s.supersample <= LARGE_PICTURE_WHOLE_PIXELS;
}

/* Rows of the picture that a band has. */
int band_rows_of(const large_picture_size &s)
{
    if (is_one_part(s))
        return s.height;
    const size_t room = LARGE_PICTURE_BAND_BYTES / (static_cast<size_t>(s.width) * PIXEL_BYTES);
    return std::clamp(static_cast<int>(room), 1, LARGE_PICTURE_TILE_PIXELS / s.supersample);
}

/* Draws a tile with its margins and keeps of it what is the tile's, at `out` in the band. */
bool tile_draw(const large_picture &p, const large_picture_part &tile, uint8_t *out, std::string *text_out)
{
    const int n = p.size.supersample, whole_width = p.size.width * n, whole_height = p.size.height * n;
    const int margin = large_picture_margin(p.size);
    const int left = std::max(tile.x - margin, 0), top = std::max(tile.y - margin, 0);
    const large_picture_part part = {left, top, std::min(tile.x + tile.width + margin, whole_width) - left,
                                     std::min(tile.y + tile.height + margin, whole_height) - top};
    std::vector<uint8_t> rgba;
    if (!p.draw(whole_width, whole_height, part, &rgba, text_out))
        return false;
    const size_t row_bytes = static_cast<size_t>(part.width) * PIXEL_BYTES;
    assert(rgba.size() == row_bytes * static_cast<size_t>(part.height));
    const uint8_t *first = rgba.data() + static_cast<size_t>(tile.y - top) * row_bytes +
                           static_cast<size_t>(tile.x - left) * PIXEL_BYTES;
    large_picture_average(first, row_bytes, n, tile.width / n, tile.height / n, out,
                          static_cast<size_t>(p.size.width) * PIXEL_BYTES);
    return true;
}

bool band_draw(large_picture *p, int y, std::string *text_out)
{
    const int n = p->size.supersample, whole_width = p->size.width * n;
    const int most = is_one_part(p->size) ? whole_width : LARGE_PICTURE_TILE_PIXELS;
    p->band_y = y;
    p->band_rows = 0;
    const int rows = std::min(band_rows_of(p->size), p->size.height - y);
    p->band.resize(static_cast<size_t>(rows) * static_cast<size_t>(p->size.width) * PIXEL_BYTES);
    for (int x = 0; x < whole_width; x += most) {
        const large_picture_part tile = {x, y * n, std::min(most, whole_width - x), rows * n};
        if (!tile_draw(*p, tile, p->band.data() + static_cast<size_t>(x / n) * PIXEL_BYTES, text_out))
            return false;
    }
    p->band_rows = rows;
    return true;
}

} // namespace

std::string large_picture_trouble(const large_picture_size &s)
{
    const std::string size = std::to_string(s.width) + " x " + std::to_string(s.height);
    if (s.supersample < 1 || s.supersample > LARGE_PICTURE_SUPERSAMPLE_MAX)
        return "a picture drawn " + std::to_string(s.supersample) + " times as large: expected 1 to " +
               std::to_string(LARGE_PICTURE_SUPERSAMPLE_MAX);
    const int most = LARGE_PICTURE_SIDE_MAX / s.supersample;
    if (s.width >= 1 && s.width <= most && s.height >= 1 && s.height <= most)
        return "";
    return "a picture of " + size + " pixels" +
           (s.supersample > 1 ? ", drawn " + std::to_string(s.supersample) + " times as large" : "") +
           ": expected sides of 1 to " + std::to_string(most);
}

int large_picture_margin(const large_picture_size &s)
{
    const double wanted = LARGE_PICTURE_MARGIN_PART * s.height * s.supersample;
    return std::clamp(static_cast<int>(std::ceil(wanted / PATTERN_PIXELS)) * PATTERN_PIXELS,
                      LARGE_PICTURE_MARGIN_PIXELS, LARGE_PICTURE_MARGIN_MOST_PIXELS);
}

const uint8_t *large_picture_row(large_picture *p, int y, std::string *text_out)
{
    assert(y >= 0 && y < p->size.height && large_picture_trouble(p->size).empty());
    const bool there = y >= p->band_y && y < p->band_y + p->band_rows;
    if (!there && !band_draw(p, y, text_out))
        return nullptr;
    return p->band.data() + static_cast<size_t>(y - p->band_y) * static_cast<size_t>(p->size.width) * PIXEL_BYTES;
}

void large_picture_average(const uint8_t *rgba, size_t row_bytes, int n, int width, int height, uint8_t *out,
                           size_t out_row_bytes)
{
    const encoding &e = encoding_of_srgb();
    const auto side = static_cast<size_t>(n), across = static_cast<size_t>(width);
    const float share = 1.0f / static_cast<float>(n * n);
    for (int y = 0; y < height; y++, rgba += side * row_bytes, out += out_row_bytes) {
        if (n == 1) {
            std::memcpy(out, rgba, across * PIXEL_BYTES);
            continue;
        }
        for (size_t x = 0; x < across * PIXEL_BYTES; x++) {
            const size_t channel = x % PIXEL_BYTES;
            const uint8_t *from = rgba + x / PIXEL_BYTES * side * PIXEL_BYTES + channel;
            float sum = 0;
            for (size_t b = 0; b < side; b++)
                for (size_t a = 0; a < side; a++) {
                    const uint8_t v = from[b * row_bytes + a * PIXEL_BYTES];
                    sum += channel == 3 ? v : e.light[v];
                }
            const float mean = sum * share;
            out[x] = channel == 3 ? static_cast<uint8_t>(mean + 0.5f)
                                  : static_cast<uint8_t>(
                                        std::upper_bound(e.byte_after.begin(), e.byte_after.end(), mean) -
                                        e.byte_after.begin());
        }
    }
}
