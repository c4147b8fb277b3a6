/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:   A picture out of a PNG file, and how two of them differ.
 * Is not: The program's own writer (src/exchange/picture.h): what is tested must not read its own hand.
 * Shape:  8-bit R, G, B, rows from the top, no gaps.
 * Errors: a sentence; the picture is empty then.
 */
#ifndef GLAISE_GOLDEN_GOLDEN_PICTURE_H
#define GLAISE_GOLDEN_GOLDEN_PICTURE_H

#include <cstdint>
#include <string>
#include <vector>

struct golden_picture {
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> rgb;
};

struct golden_picture_difference {
    size_t pixels = 0, failing = 0; /* failing: a channel is further off than was allowed */
    int largest = 0;                /* of all channels of all pixels */
    golden_picture shown;           /* failing pixels white, the others their difference, four times as bright */
};

[[nodiscard]] bool golden_picture_read(const std::string &path, golden_picture *out, std::string *text_out);
[[nodiscard]] bool golden_picture_write(const std::string &path, const golden_picture &picture, std::string *text_out);
/* Pictures of different sizes fail in every pixel. */
golden_picture_difference golden_picture_compare(const golden_picture &expected, const golden_picture &actual,
                                                 int channel_tolerance);

#endif
