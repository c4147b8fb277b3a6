/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A PNG from outside as pixels: what a person brings as scenery.
 * Is not:  The writing of pictures (picture.h); what is done with one (view).
 * Shape:   any PNG that there is (1 to 16 bits; grey, palette, colour; with or without alpha or a transparent colour;
 *          interlaced or not) becomes width x height RGBA, 8 bits each, straight alpha, top row first. Without alpha it
 *          is 255. The bytes are taken as sRGB whatever the file says of gamma and profiles: those chunks, like texts
 *          and times, are passed over unread.
 * Owner:   the picture is a value.
 * Errors:  an exchange_outcome: STATUS_CORRUPT for what is no sound PNG, STATUS_TOO_LARGE for sides above
 *          PICTURE_SIDE_MAX or more bytes than the limit, STATUS_IO from the source, STATUS_NO_MEMORY. The text is
 *          "offset N: expected ..."; whoever knows the file's name puts it before that. The picture is then empty.
 *          Sizes are looked at before memory is taken for them: a small file cannot take more than the limit.
 * Cost:    zlib's: about 10 ns a pixel. Not for the frame path.
 */
#ifndef GLAISE_EXCHANGE_PICTURE_SOURCE_H
#define GLAISE_EXCHANGE_PICTURE_SOURCE_H

#include "exchange/exchange.h"

#include <vector>

/* As pixels: 8192 x 4096 of them, finer than any scenery that is mirrored in clay needs to be. */
constexpr size_t PICTURE_SOURCE_BYTES_MAX = size_t{8192} * 4096 * 4;

struct picture_source {
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> rgba;
};

exchange_outcome picture_source_read(checkpoint_source source, void *self, picture_source *out,
                                     size_t bytes_max = PICTURE_SOURCE_BYTES_MAX);

#endif
