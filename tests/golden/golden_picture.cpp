/* SPDX-License-Identifier: Apache-2.0 */
#include "golden_picture.h"

#include <png.h>

#include <algorithm>
#include <cstdlib>

bool golden_picture_read(const std::string &path, golden_picture *out, std::string *text_out)
{
    *out = {};
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.c_str())) {
        image.format = PNG_FORMAT_RGB;
        out->rgb.resize(PNG_IMAGE_SIZE(image));
        const png_color black{0, 0, 0};
        if (png_image_finish_read(&image, &black, out->rgb.data(), 0, nullptr)) {
            out->width = image.width;
            out->height = image.height;
            return true;
        }
    }
    *text_out = path + ": " + image.message;
    png_image_free(&image);
    *out = {};
    return false;
}

bool golden_picture_write(const std::string &path, const golden_picture &picture, std::string *text_out)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = picture.width;
    image.height = picture.height;
    image.format = PNG_FORMAT_RGB;
    if (png_image_write_to_file(&image, path.c_str(), 0, picture.rgb.data(), 0, nullptr))
        return true;
    *text_out = path + ": " + image.message;
    return false;
}

golden_picture_difference golden_picture_compare(const golden_picture &expected, const golden_picture &actual,
                                                 int channel_tolerance)
{
    golden_picture_difference d;
    d.pixels = size_t{actual.width} * actual.height;
    if (expected.width != actual.width || expected.height != actual.height) {
        d.failing = d.pixels = std::max(d.pixels, size_t{expected.width} * expected.height);
        d.largest = 255;
        d.shown = actual;
        return d;
    }
    d.shown = {actual.width, actual.height, std::vector<uint8_t>(actual.rgb.size())};
    for (size_t p = 0; p < d.pixels; p++) {
        int off[3], most = 0;
        for (size_t c = 0; c < 3; c++) {
            off[c] = std::abs(expected.rgb[3 * p + c] - actual.rgb[3 * p + c]);
            most = std::max(most, off[c]);
        }
        const bool fails = most > channel_tolerance;
        d.failing += fails;
        d.largest = std::max(d.largest, most);
        for (size_t c = 0; c < 3; c++)
            d.shown.rgb[3 * p + c] = static_cast<uint8_t>(fails ? 255 : std::min(255, 4 * off[c]));
    }
    return d;
}
