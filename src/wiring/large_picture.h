/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A picture of any size out of parts that a device can draw: which parts, what of each is kept, and how
 *          several drawn pixels become one.
 * Is not:  The drawing (view/view.h: view_draw_part); the file (exchange/picture.h); the two joined (stage.h).
 * Shape:   the whole is drawn `supersample` times as wide and as high as it will be: drawn pixels. It is cut into tiles,
 *          and each tile is drawn with a margin round it, as far as the picture goes. The margin is thrown away: effects
 *          on the screen look that far for their neighbours. How dark a hollow is depends on what lies within an eighth
 *          of the picture's height (view/hollow.h), so that the margin grows with it, from LARGE_PICTURE_MARGIN_PIXELS
 *          to LARGE_PICTURE_MARGIN_MOST_PIXELS: what is missed beyond that is faint, and to draw it would cost more than
 *          the picture.
 *
 *              +-------------+      the tiles of one band are drawn, left to right, when its first row is asked for;
 *              | m a r g i n |      a band is as many rows as LARGE_PICTURE_BAND_BYTES have room for, and no more than
 *              |  +-------+  |      a tile is high
 *              |  | tile  |  |      a picture up to LARGE_PICTURE_WHOLE_PIXELS a side is one part, without margins;
 *              |  +-------+  |      no part has more than LARGE_PICTURE_PART_PIXELS a side
 *              +-------------+
 *
 *          supersample x supersample drawn pixels become one by the mean of their light: decoded from sRGB, averaged,
 *          encoded again, to the nearest of 256.
 * Units:   pixels; bytes RGBA8, sRGB, top row first.
 * Owner:   the caller; a value.
 * Errors:  large_picture_trouble says what is wrong with a size. A part that cannot be drawn: its sentence comes back
 *          from large_picture_row, and there is no picture.
 * Cost:    memory: a part and a band, whatever the size. With its margins a picture 2160 high is drawn 1.6 times over,
 *          one 8192 high 4.3 times.
 * Source:  IEC 61966-2-1 for the encoding.
 */
#ifndef GLAISE_WIRING_LARGE_PICTURE_H
#define GLAISE_WIRING_LARGE_PICTURE_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

constexpr int LARGE_PICTURE_SIDE_MAX = 65536; /* in drawn pixels */
constexpr int LARGE_PICTURE_SUPERSAMPLE_MAX = 4;
constexpr int LARGE_PICTURE_MARGIN_PIXELS = 64, LARGE_PICTURE_MARGIN_MOST_PIXELS = 1024;
constexpr double LARGE_PICTURE_MARGIN_PART = 0.125; /* of the height, in between */
constexpr int LARGE_PICTURE_WHOLE_PIXELS = 2048;    /* OpenGL ES 3.1 promises that much of a picture's side */
constexpr int LARGE_PICTURE_TILE_PIXELS = 1920;     /* a multiple of 1, 2, 3 and 4: no tile cuts a pixel */
/* Devices that we know have 4096 and more; one that has not says so. */
constexpr int LARGE_PICTURE_PART_PIXELS = LARGE_PICTURE_TILE_PIXELS + 2 * LARGE_PICTURE_MARGIN_MOST_PIXELS;
constexpr size_t LARGE_PICTURE_BAND_BYTES = size_t{128} << 20;

/* As it will be. */
struct large_picture_size {
    int width = 1280, height = 960;
    int supersample = 1;
};

/* A rectangle of drawn pixels, from the whole's top left corner. */
struct large_picture_part {
    int x, y, width, height;
};

/* Draws a part of a whole of so many drawn pixels; false, and a sentence. */
using large_picture_draw = std::function<bool(int width, int height, const large_picture_part &part,
                                              std::vector<uint8_t> *rgba_out, std::string *text_out)>;

struct large_picture {
    large_picture_size size;
    large_picture_draw draw;
    int band_y = 0, band_rows = 0; /* rows of the picture that `band` has */
    std::vector<uint8_t> band;
};

/* Empty where a picture of this size can be made. */
std::string large_picture_trouble(const large_picture_size &size);
/* In drawn pixels; a multiple of 4, as patterns on the screen are. */
int large_picture_margin(const large_picture_size &size);
/* The row y; those above the last band are gone. It holds until the next is asked for. NULL: why not. */
const uint8_t *large_picture_row(large_picture *p, int y, std::string *text_out);

/* n x n pixels out of `rgba` (row_bytes apart) become each of width x height pixels at `out`. */
void large_picture_average(const uint8_t *rgba, size_t row_bytes, int n, int width, int height, uint8_t *out,
                           size_t out_row_bytes);

#endif
